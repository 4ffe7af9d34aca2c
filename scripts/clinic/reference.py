"""The record's reference, made from the fields' own descriptions."""

from __future__ import annotations

import inspect
import types
import typing
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

from clinic import record, record_parts, record_sweep, signals

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
    return "\n".join([*parts, "### Signal paths", "", paths.partition("\n\n")[2]])


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
