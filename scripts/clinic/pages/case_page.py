"""A case's page: the record and the evidence of its runs go in, Markdown comes out."""

from __future__ import annotations

import html
import io
import json
from collections.abc import Mapping

from PIL import Image as Pictures

from clinic.engine.variant import diff, variants
from clinic.pages.certainty import releases, smaller_steps, steady, tried
from clinic.pages.error_page import plain_page
from clinic.pages.figures.film import HEIGHT, WIDTH
from clinic.pages.measured import measure, table
from clinic.pages.text import manual
from clinic.pages.text.prose import markdown, nine_digits, opening, prose_problems
from clinic.pages.text.template import render
from clinic.proof.evidence import Evidence
from clinic.proof.procedure import Answer, Differential
from clinic.proof.prose_laws import PROSE
from clinic.record.case import Case
from clinic.record.families import families
from clinic.record.problem import CaseError
from clinic.record.prose import plain, quantity, rounded_up
from clinic.work.cache import Files

MOMENTS = ("No", "One", "Two", "Three", "Four")


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
    trials, contrasts = tried(case, evidence)
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
        change=_change(case),
        outcome=_outcome(case, evidence),
        strip=_strip(files),
        summary=_summary(case, evidence),
        sweeps=[_sweep(case, evidence, name) for name in record.sweep],
        smaller_steps=smaller_steps(case, evidence),
        releases=releases(case, evidence),
        steady=steady(case, evidence),
        tried=trials,
        contrasts=contrasts,
        family=None if record.family is None else families()[record.family],
        procedure=told is not None and told.code,
        telling=telling(case, evidence),
        row=_row(case, told, others),
        table=table(case, evidence),
        manual=[(manual.title(page), manual.address(page)) for page in record.manual],
        others=[others[slug] for slug in record.see],
    )


def interim_page(case: Case, evidence: Evidence) -> str:
    """The Markdown of a case's page while what takes long is being measured."""
    text = '!!! info "Being measured"\n\n    Plots, pictures and what else takes longer appear here by themselves.\n\n'
    measured = render("table", table=table(case, evidence))
    return plain_page(case.record.heading, f"{text}What was measured:\n\n{measured}")


def _change(case: Case) -> dict[str, str]:
    """The first fix as the lines that differ alone, and those of them that it puts in, to be copied.

    A line that moves or is new is shown with its neighbours.
    """
    after = variants(case)[1].text
    changed = set(_lines(case.text, after, 0))
    moved = any(line.startswith("+") and f"-{line[1:]}" in changed for line in changed)
    new = not any(line.startswith("-") for line in changed)
    shown = [line for line in _lines(case.text, after, 1 if moved or new else 0) if line[1:].strip()]
    added = [line[1:] for line in shown if line.startswith("+")]
    indent = min(len(line) - len(line[1:].lstrip()) for line in shown)
    return {"diff": "\n".join(line[0] + line[indent:] for line in shown), "added": "\n".join(added)}


def _lines(before: str, after: str, context: int) -> list[str]:
    """The lines of a diff, without where they stand."""
    return [line for line in diff(before, after, "", context).splitlines() if not line.startswith("@@")]


def _strip(files: Files) -> dict[str, object]:
    """The size of a film's strip, and how many moments are on it; nothing where there is none."""
    if "strip.webp" not in files:
        return {}
    width, height = Pictures.open(io.BytesIO(files["strip.webp"])).size
    return {"width": width, "height": height, "count": MOMENTS[width * height // (2 * WIDTH * HEIGHT)]}


def _outcome(case: Case, evidence: Evidence) -> str:
    """What is seen, with its numbers, naming no remedy."""
    broken, repaired = (_measured(case, evidence, key) for key in ("broken", case.record.fixes[0].id))
    return f"{_first_label(case)}: broken {broken}, repaired {repaired}."


def _summary(case: Case, evidence: Evidence) -> str:
    """The plot in words, with its numbers."""
    kept = [key for key, variant in evidence.variants.items() if variant.kind != "refuted"]
    return f"{_first_label(case)}: {', '.join(f'{key} {_measured(case, evidence, key)}' for key in kept)}."


def _first_label(case: Case) -> str:
    name, signal = next(iter(case.record.signals.items()))
    label = signal.label or name
    return f"Span of the {label}" if case.record.warnings else f"{label.capitalize()} at the end"


def _measured(case: Case, evidence: Evidence, key: str) -> str:
    """The first signal of a variant: at the end, or its span where MuJoCo warns, for it may have reset the state."""
    name = next(iter(case.record.signals))
    return measure(evidence.variants[key].values[name]["span" if case.record.warnings else "final"], name, evidence, 3)


def _sweep(case: Case, evidence: Evidence, name: str) -> dict[str, str]:
    """A sweep's title, prose, and its figure in words."""
    sweep, found = case.record.sweep[name], evidence.sweep[name]
    own = found.agreement["prediction"]
    if own.worst is None:
        result = f"{sweep.prediction.label} is right at {own.judged - own.wrong} of {own.judged} points"
    elif own.worst < nine_digits(found, sweep.prediction.relative):
        result = f"{sweep.prediction.label} is right to nine digits at all {own.judged} points"
    else:
        relative = sweep.prediction.relative
        error = quantity(rounded_up(own.worst * (100 if relative else 1), 2), "%" if relative else own.unit, 2)
        result = f"{sweep.prediction.label} is within {error} of the measurement at all {own.judged} points"
    rivals = [f"; {r.label} is wrong at {found.agreement[r.id].wrong}" for r in sweep.rivals]
    return {
        "name": name,
        "title": sweep.title,
        "text": markdown(sweep.text, evidence, case),
        "alt": f"{sweep.title}: {len(found.points)} points. {result}{''.join(rivals)}.",
    }


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
