"""A case's page: the record and the evidence of its runs go in, Markdown comes out."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping
from typing import Any

from clinic.engine.checks import expected, satisfies
from clinic.engine.variant import diff, variants
from clinic.pages.error_page import plain_page
from clinic.pages.text import manual
from clinic.pages.text.claim import taken
from clinic.pages.text.prose import markdown, opening, prose_problems
from clinic.pages.text.template import render
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.proof.procedure import Answer, Differential
from clinic.proof.prose_laws import PROSE
from clinic.proof.releases import differing
from clinic.proof.robustness import NUDGE, STARTS
from clinic.record.case import Case
from clinic.record.families import families
from clinic.record.fields import Check
from clinic.record.parts import Interval
from clinic.record.problem import CaseError
from clinic.record.prose import plain, quantity
from clinic.work.cache import Files

STILL = 1e-3  # of a signal; less is no motion
NOTHING = 1e-9  # of what a check allows; less is what rounding left of zero
Column = tuple[str, str, Interval | None]  # a number taken from a signal: the signal, which number, over which window


def case_page(
    case: Case, evidence: Evidence, files: Files, others: Mapping[str, Case], told: Differential | None
) -> str:
    """The Markdown of a case's page.

    Raises:
        CaseError: With every template field that resolves to nothing.
    """
    if problems := list(prose_problems(case, evidence)):
        raise CaseError(problems)
    record = case.record
    return render(
        "case",
        case=case,
        record=record,
        evidence=evidence,
        broken=evidence.variants["broken"],
        description=json.dumps(html.escape(opening(case, evidence)), ensure_ascii=False),
        title=json.dumps(html.escape(record.title, quote=False), ensure_ascii=False),
        prose={name: markdown(getattr(record, name), evidence, case) for name in PROSE},
        whys={remedy.id: markdown(remedy.why, evidence, case) for remedy in record.refuted},
        diffs={variant.id: diff(case.text, variant.text, record.source) for variant in variants(case)},
        files=files,
        summary=_summary(case, evidence),
        film_alt=f"Film, broken beside {record.fixes[0].id}. {_summary(case, evidence)}",
        sweeps=[_sweep(case, evidence, name) for name in record.sweep],
        smaller_steps=_smaller_steps(case, evidence),
        releases=_releases(case, evidence),
        steady=_steady(case, evidence),
        family=None if record.family is None else families()[record.family],
        telling=telling(case, evidence),
        row=_row(case, told, others),
        table=_table(case, evidence),
        manual=[(manual.title(page), manual.address(page)) for page in record.manual],
        others=[others[slug] for slug in record.see],
    )


def interim_page(case: Case, evidence: Evidence) -> str:
    """The Markdown of a case's page while what takes long is being measured."""
    text = '!!! info "Being measured"\n\n    Plots, pictures and what else takes longer appear here by themselves.\n\n'
    table = render("table", table=_table(case, evidence))
    return plain_page(case.record.heading, f"{text}What was measured:\n\n{table}")


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
    columns: dict[Column, dict[str, list[Check]]] = {}
    for kind, checks in case.record.checks:
        for check in checks:
            column = columns.setdefault((check.signal, check.take, check.window), {"broken": [], "fixed": []})
            column[kind].append(check)
    made: dict[str, Any] = {"heads": [taken(case, *column) for column in columns], "rows": []}
    for kind in ("broken", "fixed"):
        made[kind] = ["; ".join(_expected(check, case) for check in column[kind]) for column in columns.values()]
    for key, variant in evidence.variants.items():
        cells = [_cell(variant, column, checks["fixed"]) for column, checks in columns.items()]
        made["rows"].append({"id": key, "kind": variant.kind, "cells": cells})
    return made


def _expected(check: Check, case: Case) -> str:
    unit = "s" if check.take == "onset" else case.record.signals[check.signal].unit
    return f"{expected(check, plain)} {unit}".strip()


def _cell(variant: VariantEvidence, column: Column, wanted: list[Check]) -> str:
    """What was measured, and whether it is as the checks `wanted` ask."""
    signal, take, _ = column
    results = (result for kind in variant.checks.values() for result in kind)
    measured = next(result.measured for result in results if (result.signal, result.take, result.window) == column)
    unit = "s" if take == "onset" else variant.traces[signal].unit
    if measured is not None and any(abs(measured) < NOTHING * (check.within or 0.0) for check in wanted):
        measured = 0.0
    value = "not measured" if measured is None else quantity(measured, unit, 4)
    if not wanted:
        return value
    holds = measured is not None and all(satisfies(check, measured) for check in wanted)
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
        "text": markdown(sweep.text, evidence, case),
        "alt": f"{sweep.title}: {len(found.points)} points. {result}{''.join(rivals)}.",
    }


def _smaller_steps(case: Case, evidence: Evidence) -> str:
    """Whether a smaller timestep helps, from the runs; empty where nothing moves that the symptom is about."""
    spans = [evidence.variants["broken"].values[check.signal]["span"] or 0.0 for check in case.record.checks.broken]
    if "broken" not in evidence.robustness or max(spans) < STILL:
        return ""
    words = {"broken": "the symptom is the same", "well": "it is gone", "neither": "it is neither the same nor gone"}
    shrunk, step = evidence.robustness["broken"].shrunk, 1e3 * (evidence.variants["broken"].timestep or 0.0)
    half, twentieth = shrunk.values()
    at_half, at_twentieth = (f"({plain(step * float(share))}\u00a0ms)" for share in shrunk)
    answer = "No" if half == twentieth == "broken" else "Yes" if "well" in (half, twentieth) else "In part"
    if half == twentieth:
        return f"{answer}: at half of it {at_half} and at a twentieth {at_twentieth} {words[half]}."
    return f"{answer}: at half of it {at_half} {words[half]}, at a twentieth {at_twentieth} {words[twentieth]}."


def _releases(case: Case, evidence: Evidence) -> str:
    """On which releases of MuJoCo the case is the same, and why not on the others; empty if that was not measured."""
    told = differing(evidence)
    if not told:
        return ""
    releases = sorted(told, key=lambda release: [int(part) for part in release.split(".")])
    last = max((k for k, release in enumerate(releases) if told[release]), default=-1)
    said = "the same on every release measured" if last < 0 else "the same"
    reasons = [
        f"{spec.replace('<', 'Before ')}: {markdown(reason, evidence, case).strip()}"
        for spec, reason in case.record.older.items()
    ]
    return " ".join([f"{said} from {releases[last + 1]} on.", *reasons] if last + 1 < len(releases) else reasons)


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
    shaken = [f"`{key}` {one.same} of {one.runs}" for key, one in evidence.robustness.items() if one.same < one.runs]
    reasons = [
        markdown(reason, evidence, case) for law, reason in case.record.exempt.items() if law in ("steady", "lasting")
    ]
    return " ".join([said, *([f"({', '.join(shaken)}.)"] if shaken else []), *reasons])


def telling(case: Case, evidence: Evidence) -> str:
    """What tells the case from others of its family, as Markdown; empty if nothing does."""
    tells = case.record.telling
    if tells is None:
        return ""
    words = markdown(tells.says, evidence, case)
    words = words[0].upper() + words[1:]
    if tells.expr is None:
        return f"{words}."
    side, bound = ("above", tells.above) if tells.above is not None else ("below", tells.below)
    return f"{words}: {side} {plain(bound or 0.0)} {tells.unit}".rstrip() + "."


def _row(case: Case, told: Differential | None, others: Mapping[str, Case]) -> list[tuple[Case, str]]:
    """The models of the family, each with what the case's own measurement gives for it."""
    unit = case.record.telling.unit if case.record.telling else ""
    cases = {name: others[name] for name in told.answers if name in others} if told else {}
    return [(each, value_in(told.answers[name], case.slug, unit)) for name, each in cases.items() if told]


def value_in(answer: Answer, slug: str, unit: str = "") -> str:
    """What a case's measurement gives for a model."""
    if slug not in answer.values:
        return "\u2013"
    mark = "\u00a0✓" if slug in answer.told else ""
    return f"{quantity(answer.values[slug], unit, 3)}{mark}"
