"""Pages: a case's Markdown, and the home page, from records and evidence."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import jinja2

from clinic.cache import Files
from clinic.case import Case
from clinic.checks import expected, satisfies
from clinic.evidence import Evidence, VariantEvidence
from clinic.problem import CaseError, Problem
from clinic.prose import field_errors, fill, markdown, quantity
from clinic.record import Check
from clinic.variant import diff, remedies, variants
from clinic.yamlmap import Where

TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("clinic"), undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
)
PROSE = ("symptom", "diagnosis", "cause", "fix", "lesson")
TAKES = {
    "final": "at the end",
    "first": "after one step",
    "min": "lowest",
    "max": "highest",
    "mean": "mean",
    "span": "span",
    "onset": "first differs from zero at",
}


@dataclass(frozen=True)
class Card:
    """What other pages say about a case."""

    slug: str
    number: int
    title: str
    symptom: str
    picture: str
    alt: str


def case_page(case: Case, evidence: Evidence, files: Files, others: Mapping[str, Case]) -> str:
    """The Markdown of a case's page.

    Raises:
        CaseError: With every template field that resolves to nothing.
    """
    if problems := list(_field_problems(case, evidence)):
        raise CaseError(problems)
    record = case.record
    made = {variant.id: variant for variant in variants(case)}
    return TEMPLATES.get_template("case.md.j2").render(
        case=case,
        record=record,
        evidence=evidence,
        broken=evidence.variants["broken"],
        fixed=evidence.variants[record.fixes[0].id],
        description=json.dumps(_first_sentence(fill(record.symptom, evidence)), ensure_ascii=False),
        title=json.dumps(record.title, ensure_ascii=False),
        prose={name: markdown(getattr(record, name), evidence) for name in PROSE},
        whys={remedy.id: markdown(remedy.why, evidence) for remedy in record.refuted},
        diffs={key: diff(case.text, variant.text, record.source) for key, variant in made.items()},
        language="xml" if record.model else "python",
        pictures=[name for name in ("broken.webp", "fixed.webp") if name in files],
        summary=_summary(case, evidence),
        table=_table(case, evidence),
        others=[others[slug] for slug in record.see],
    )


def card(case: Case, evidence: Evidence, files: Files) -> Card:
    """The case's card on the home page."""
    symptom = _first_sentence(fill(case.record.symptom, evidence))
    picture = "broken.webp" if "broken.webp" in files else "plot-light.svg"
    return Card(
        case.slug, case.record.number, case.record.title, symptom, picture, f"Case {case.record.number}: {symptom}"
    )


def home_page(cards: Iterable[Card], engine: str) -> str:
    """The Markdown of the home page."""
    return TEMPLATES.get_template("home.md.j2").render(cards=list(cards), engine=engine)


def _summary(case: Case, evidence: Evidence) -> str:
    """The plot in words, with its numbers."""
    name, signal = next(iter(case.record.signals.items()))
    parts = []
    for key, variant in evidence.variants.items():
        if variant.kind != "refuted":
            final = variant.values[name]["final"]
            parts.append(f"{key} {'not measured' if final is None else quantity(final, signal.unit)}")
    return f"{(signal.label or name).capitalize()} at the end: " + ", ".join(parts) + "."


def _table(case: Case, evidence: Evidence) -> dict[str, Any]:
    """The checks as a table: a column for each number taken, a row for each variant."""
    record = case.record
    columns: dict[tuple[object, ...], dict[str, list[Check]]] = {}
    for kind in ("broken", "fixed"):
        for check in getattr(record.checks, kind):
            columns.setdefault((check.signal, check.take, check.window), {"broken": [], "fixed": []})[kind].append(
                check
            )
    heads = [_head(record.signals[str(signal)], str(signal), str(take), window) for signal, take, window in columns]

    def meaning(kind: str) -> list[str]:
        return ["; ".join(_expected(check, case) for check in column[kind]) for column in columns.values()]

    rows = []
    for key, variant in evidence.variants.items():
        cells = [_cell(variant, column["broken"] + column["fixed"], column["fixed"]) for column in columns.values()]
        rows.append({"id": key, "kind": variant.kind, "title": variant.title, "cells": cells, "well": variant.well})
    return {"heads": heads, "broken": meaning("broken"), "fixed": meaning("fixed"), "rows": rows}


def _head(signal: Any, name: str, take: str, window: Any) -> str:
    words = TAKES[take] if not hasattr(signal, "measure") else ""
    span = f", {window[0]:g} to {window[1]:g} s" if window else ""
    return f"{signal.label or name}" + (f", {words}" if words else "") + span


def _expected(check: Check, case: Case) -> str:
    unit = "s" if check.take == "onset" else case.record.signals[check.signal].unit
    return f"{expected(check)} {unit}".strip()


def _cell(variant: VariantEvidence, checks: list[Check], wanted: list[Check]) -> str:
    results = variant.checks["broken"] + variant.checks["fixed"]
    first = checks[0]
    result = next(r for r in results if (r.signal, r.take, r.window) == (first.signal, first.take, first.window))
    unit = "s" if first.take == "onset" else variant.traces[first.signal].unit
    value = "not measured" if result.measured is None else quantity(result.measured, unit, 4)
    if not wanted:
        return value
    holds = result.measured is not None and all(satisfies(check, result.measured) for check in wanted)
    return f"{value} {'✓' if holds else '✗'}"


def _field_problems(case: Case, evidence: Evidence) -> Iterable[Problem]:
    texts: dict[Where, str] = {(name,): getattr(case.record, name) for name in PROSE}
    texts |= {(*where, "why"): getattr(remedy, "why", "") for where, _, remedy in remedies(case)}
    for where, text in texts.items():
        for error in field_errors(text, evidence):
            yield case.problem(where, error.found, error.expected, error.repair)


def _first_sentence(text: str) -> str:
    flat = " ".join(text.split())
    end = flat.find(". ")
    return flat if end < 0 else flat[: end + 1]
