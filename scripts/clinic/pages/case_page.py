"""Pages: a case's Markdown, and the home page, from records and evidence."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import jinja2

from clinic.engine.checks import expected, satisfies
from clinic.engine.variant import diff, remedies, variants
from clinic.pages.text import manual
from clinic.pages.text.claim import TAKES, taken
from clinic.pages.text.prose import field_errors, fill, markdown
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.proof.lookalike import Matrix
from clinic.proof.prose_laws import PROSE
from clinic.proof.robustness import NUDGE, STARTS
from clinic.record.case import Case
from clinic.record.fields import Check
from clinic.record.markup import code, fence, line
from clinic.record.parts import Interval
from clinic.record.problem import CaseError, Problem
from clinic.record.prose import plain, quantity
from clinic.record.yaml_lines import Where
from clinic.work.cache import Files

TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("clinic.pages"), undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
)
TEMPLATES.filters |= {"code": code, "fence": fence, "line": line}


@dataclass(frozen=True)
class Card:
    """What other pages say about a case."""

    slug: str
    number: int
    title: str
    symptom: str
    picture: str
    alt: str


def case_page(case: Case, evidence: Evidence, files: Files, others: Mapping[str, Case], alike: Matrix | None) -> str:
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
        description=json.dumps(html.escape(_opening(fill(record.symptom, evidence))), ensure_ascii=False),
        title=json.dumps(record.title, ensure_ascii=False),
        prose={name: markdown(getattr(record, name), evidence) for name in PROSE},
        whys={remedy.id: markdown(remedy.why, evidence) for remedy in record.refuted},
        diffs={key: diff(case.text, variant.text, record.source) for key, variant in made.items()},
        files=files,
        summary=_summary(case, evidence),
        film_alt=f"Film, broken beside {record.fixes[0].id}. {_summary(case, evidence)}",
        sweeps=[_sweep(case, evidence, name) for name in record.sweep],
        numerical=_numerical(evidence),
        steady=_steady(case, evidence),
        matrix=None if alike is None else _matrix(alike, others),
        table=_table(case, evidence),
        manual=[(manual.title(page), manual.address(page)) for page in record.manual],
        others=[others[slug] for slug in record.see],
    )


def interim_page(case: Case, evidence: Evidence) -> str:
    """The Markdown of a case's page while what takes long is being measured."""
    return TEMPLATES.get_template("interim.md.j2").render(
        record=case.record,
        broken=evidence.variants["broken"],
        title=json.dumps(case.record.title, ensure_ascii=False),
        table=_table(case, evidence),
    )


def card(case: Case, evidence: Evidence, files: Files) -> Card:
    """The case's card on the home page."""
    symptom = line(_opening(fill(case.record.symptom, evidence)))
    picture = "broken.webp" if "broken.webp" in files else "plot.svg"
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
    columns: dict[tuple[str, str, Interval | None], dict[str, list[Check]]] = {}
    for kind in ("broken", "fixed"):
        for check in getattr(record.checks, kind):
            columns.setdefault((check.signal, check.take, check.window), {"broken": [], "fixed": []})[kind].append(
                check
            )
    heads = [taken(case, *column) for column in columns]

    def meaning(kind: str) -> list[str]:
        return ["; ".join(_expected(check, case) for check in column[kind]) for column in columns.values()]

    rows = []
    for key, variant in evidence.variants.items():
        cells = [_cell(variant, column["broken"] + column["fixed"], column["fixed"]) for column in columns.values()]
        rows.append({"id": key, "kind": variant.kind, "title": variant.title, "cells": cells, "well": variant.well})
    return {"heads": heads, "broken": meaning("broken"), "fixed": meaning("fixed"), "rows": rows}


def _expected(check: Check, case: Case) -> str:
    unit = "s" if check.take == "onset" else case.record.signals[check.signal].unit
    return f"{expected(check, plain)} {unit}".strip()


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


def _sweep(case: Case, evidence: Evidence, name: str) -> dict[str, str]:
    """A sweep's title, prose, and its figure in words."""
    sweep, found = case.record.sweep[name], evidence.sweep[name]
    own = found.agreement["prediction"]
    if own.worst is None:
        result = f"{sweep.prediction.label} is right at {own.judged - own.wrong} of {own.judged} points"
    else:
        relative = sweep.prediction.relative
        error = quantity(100 * own.worst, "%", 2) if relative else quantity(own.worst, own.unit, 2)
        result = f"{sweep.prediction.label} is within {error} of the measurement at all {own.judged} points"
    rivals = [f"; {r.label} is wrong at {found.agreement[r.id].wrong}" for r in sweep.rivals]
    return {
        "name": name,
        "title": sweep.title,
        "text": markdown(sweep.text, evidence),
        "alt": f"{sweep.title}: {len(found.points)} points. {result}{''.join(rivals)}.",
    }


def _numerical(evidence: Evidence) -> str:
    """The answer to *shrink the timestep*, from the runs."""
    if "broken" not in evidence.robustness:
        return ""
    words = {"broken": "as broken as before", "well": "well", "neither": "neither broken in the same way nor well"}
    half, twentieth = evidence.robustness["broken"].shrunk.values()
    if half == twentieth:
        said = f"at half the timestep and at a twentieth of it the broken model is {words[half]}"
    else:
        said = f"at half the timestep the broken model is {words[half]}, at a twentieth {words[twentieth]}"
    if half == twentieth == "broken":
        return f"No: {said}. The cause is in the model."
    return f"{'Yes' if 'well' in (half, twentieth) else 'In part'}: {said}."


def _steady(case: Case, evidence: Evidence) -> str:
    """How firmly the verdicts stand, in a sentence or two."""
    if not evidence.robustness:
        return ""
    total = sum(robust.runs for robust in evidence.robustness.values())
    same = sum(robust.same for robust in evidence.robustness.values())
    said = (
        f"Each variant was run again from {STARTS} starts changed by up to {quantity(NUDGE, 'm', 1)} or rad in "
        f"position and as much per second in velocity; the broken model and the fixes with half the timestep too: "
        f"{same} of {total} runs kept their verdict."
    )
    if all(robust.longer is not False for robust in evidence.robustness.values()):
        said += " Every fix still holds after ten times the duration."
    shaken = [
        f"`{key}` {robust.same} of {robust.runs}"
        for key, robust in evidence.robustness.items()
        if robust.same < robust.runs
    ]
    reasons = [
        markdown(case.record.exempt[law], evidence) for law in ("steady", "lasting") if law in case.record.exempt
    ]
    return " ".join([said, *([f"({', '.join(shaken)}.)"] if shaken else []), *reasons])


def _matrix(made: Matrix, cases: Mapping[str, Case]) -> dict[str, Any]:
    """The matrix of look-alikes as a table."""
    members = [cases[slug] for slug in made.cases]
    heads = [f"[{case.record.number}. {line(case.record.title)}](../{case.slug}/index.md)" for case in members]
    rows = []
    for case, values, holds in zip(members, made.measured, made.holds, strict=True):
        alike = case.record.alike
        assert alike is not None
        cells = [
            f"{'not measured' if value is None else quantity(value, '', 4)} {'✓' if hold else ''}".strip()
            for value, hold in zip(values, holds, strict=True)
        ]
        rows.append([f"{line(alike.says)}: {code(alike.path)} {TAKES[alike.take]} is {expected(alike, plain)}", *cells])
    return {"heads": heads, "rows": rows}


def _field_problems(case: Case, evidence: Evidence) -> Iterable[Problem]:
    texts: dict[Where, str] = {(name,): getattr(case.record, name) for name in PROSE}
    texts |= {("sweep", name, "text"): sweep.text for name, sweep in case.record.sweep.items()}
    texts |= {(*where, "why"): getattr(remedy, "why", "") for where, _, remedy in remedies(case)}
    for where, text in texts.items():
        for error in field_errors(text, evidence):
            yield case.problem(where, error.found, error.expected, error.repair, quoted=error.found)


def _opening(text: str, length: int = 150) -> str:
    """The first sentences, until they are long enough to say something."""
    sentences = re.split(r"(?<=[.?!]) ", " ".join(text.replace("`", "").split()))
    kept = ""
    for sentence in sentences:
        kept = f"{kept} {sentence}".strip()
        if len(kept) >= length:
            break
    return kept
