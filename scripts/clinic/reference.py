"""The record's reference, made from the fields' own descriptions."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator

from pydantic import BaseModel

from clinic import record, signals

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
    "an edit": record.Edit,
    "film": record.Film,
    "sweep": record.Sweep,
    "vary": record.Parameter,
    "prediction": record.Prediction,
    "rivals": record.Rival,
    "alike": record.Alike,
    "picture": record.Picture,
}


def reference() -> str:
    """Every field of the record with its type and meaning, and the signal paths, as Markdown."""
    parts = [line for title, model in CHAPTERS.items() for line in _chapter(title, model)]
    paths = inspect.getdoc(signals) or ""
    return "\n".join([*parts, "### Signal paths", "", paths.partition("\n\n")[2].replace("A path is", "A path is", 1)])


def _chapter(title: str, model: type[BaseModel]) -> Iterator[str]:
    yield from (f"### {title}", "", inspect.getdoc(model) or "", "", "| field | type | meaning |", "|---|---|---|")
    for name, field in model.model_fields.items():
        kind = re.sub(r"clinic\.record\.|typing\.", "", _type(field.annotation))
        needed = "**required.** " if field.is_required() else ""
        yield f"| `{name}` | {kind} | {needed}{field.description or ''} |"
    yield ""


def _type(annotation: object) -> str:
    text = (
        getattr(annotation, "__name__", "")
        if isinstance(annotation, type) and not hasattr(annotation, "__args__")
        else ""
    )
    text = text or re.sub(r"Annotated\[(\w+), .*?\]\)?", r"\1", str(annotation))
    return text.replace("|", "or")
