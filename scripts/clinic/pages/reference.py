"""The record's reference, made from the fields' own descriptions."""

from __future__ import annotations

import inspect
import types
import typing
from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from clinic.engine import signals
from clinic.engine.checks import TAKES
from clinic.engine.measure import MODEL_NUMBERS
from clinic.record import closed_forms
from clinic.record.expression import FUNCTIONS
from clinic.record.fields import Record
from clinic.record.prose import CONVERSIONS

WORDS: dict[object, str] = {str: "text", int: "whole number", float: "number", bool: "true or false"}


def chapters(kind: Any = Record) -> dict[str, type[BaseModel]]:
    """The classes that a type is made of, by name: a class stands before those of its fields."""
    if not (isinstance(kind, type) and issubclass(kind, BaseModel)):
        return {name: found for part in typing.get_args(kind) for name, found in chapters(part).items()}
    made: dict[str, type[BaseModel]] = {kind.__name__: kind}
    for field in kind.model_fields.values():
        made |= chapters(field.annotation)
    return made


def reference() -> str:
    """Every field of the record with its type and meaning, and the signal paths, as Markdown."""
    parts = [line for title, model in chapters().items() for line in _chapter(title, model)]
    paths = inspect.getdoc(signals) or ""
    return "\n".join([*parts, *_fields(), *_arithmetic(), "### Signal paths", "", paths.partition("\n\n")[2]])


def _fields() -> list[str]:
    """What prose may ask of the runs."""
    filters = ", ".join(f"`{name}` (of {unit or 'a share'})" for name, (unit, _, _) in CONVERSIONS.items())
    rows = {
        "`{{ ID.SIGNAL.TAKE }}`": f"Of a variant: one of {', '.join(f'`{take}`' for take in TAKES)}.",
        "`{{ ID.timestep }}`, `{{ ID.duration }}`, `{{ ID.warning }}`": "Of a variant of a model.",
        "`{{ sweep.ID.points }}`": "How many points there are.",
        "`{{ sweep.ID.worst }}`, `.wrong`, `.judged`, `.good_from`": "How the prediction fared.",
        "`{{ sweep.ID.RIVAL.wrong }}`, ...": "How a rival fared.",
        "`{{ engine }}`": "The version of MuJoCo.",
    }
    said = (
        f"A filter after `|` converts, or sets the digits, as in `{{{{ broken.height.final | mm | 2 }}}}`: {filters}."
    )
    return ["### fields in prose", "", said, "", *_list(rows)]


def _arithmetic() -> list[str]:
    """The functions of expressions, and the numbers that a prediction can take from the model."""
    own = {f"`{name}(...)`": _summary(function) for name, function in closed_forms.FUNCTIONS.items()}
    own |= {f"`{name}`": f"{_summary(number)} In a prediction." for name, number in MODEL_NUMBERS.items()}
    usual = ", ".join(f"`{name}`" for name in FUNCTIONS if name not in closed_forms.FUNCTIONS)
    return ["### arithmetic in `expr`", "", f"`+ - * / **`, `pi`, and as in NumPy {usual}.", "", *_list(own)]


def _summary(function: object) -> str:
    return " ".join((inspect.getdoc(function) or "").partition("\n\n")[0].split())


def _list(rows: Mapping[str, str]) -> list[str]:
    return [*(f"- {name}: {said}" for name, said in rows.items()), ""]


def _chapter(title: str, model: type[BaseModel]) -> Iterator[str]:
    yield from (f"### {title}", "", inspect.getdoc(model) or "", "", "| field | type | meaning |", "|---|---|---|")
    for name, field in model.model_fields.items():
        needed = "**required.** " if field.is_required() else ""
        meaning = (field.description or "").replace("|", "\\|")
        yield f"| `{name}` | {_type(field.annotation)} | {needed}{meaning} |"
    yield ""


def _type(annotation: Any) -> str:
    """The type in words."""
    parts = [_type(part) for part in typing.get_args(annotation) if part is not type(None)]
    match typing.get_origin(annotation):
        case typing.Annotated:
            return parts[0]
        case typing.Union | types.UnionType:
            return " or ".join(parts)
        case typing.Literal:
            return ", ".join(f"`{value}`" for value in typing.get_args(annotation))
        case builtin if builtin is list:
            return f"list of {parts[0]}"
        case builtin if builtin is tuple:
            return f"[{', '.join(parts)}]"
        case builtin if builtin is dict:
            return f"mapping of {parts[0]} to {parts[1]}"
    return WORDS.get(annotation, getattr(annotation, "__name__", ""))
