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
from clinic.record import fields as record
from clinic.record import parts as record_parts
from clinic.record import predictions
from clinic.record import sweep as record_sweep
from clinic.record.expression import FUNCTIONS
from clinic.record.prose import CONVERSIONS

CHAPTERS: dict[str, type[BaseModel]] = {
    "case.yaml": record.Record,
    "run": record.RunSpec,
    "signals: a path": record.PathSignal,
    "signals: arithmetic": record.ExpressionSignal,
    "signals: measure: fraction_of_starts": record.StartsSignal,
    "signals: measure: image_row": record.RowSignal,
    "checks": record.Checks,
    "a check": record.Check,
    "fixes": record.Fix,
    "refuted": record.Refuted,
    "trials": record.Trial,
    "checks of a trial": record.TrialChecks,
    "task": record.Task,
    "an edit": record_parts.Edit,
    "film": record.Film,
    "sweep": record_sweep.Sweep,
    "holds in a sweep": record_sweep.Side,
    "vary": record_sweep.Parameter,
    "prediction": record_sweep.Prediction,
    "rivals": record_sweep.Rival,
    "alike": record.Alike,
    "picture": record.Picture,
}


WORDS: dict[object, str] = {str: "text", int: "whole number", float: "number", bool: "true or false"}


def reference() -> str:
    """Every field of the record with its type and meaning, and the signal paths, as Markdown."""
    parts = [line for title, model in CHAPTERS.items() for line in _chapter(title, model)]
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
    own = {f"`{name}(...)`": _summary(function) for name, function in predictions.FUNCTIONS.items()}
    own |= {f"`{name}`": f"{_summary(number)} In a prediction." for name, number in predictions.MODEL_NUMBERS.items()}
    usual = ", ".join(f"`{name}`" for name in FUNCTIONS if name not in predictions.FUNCTIONS)
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
