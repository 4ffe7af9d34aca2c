"""Which step would have caught which case: the six steps on every case's broken model, and on its first repair."""

from __future__ import annotations

import inspect
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import partial

from pydantic import BaseModel

from clinic.engine.variant import variants
from clinic.record.case import Case
from clinic.triage import model_rules, scene_rules
from clinic.triage.findings import Finding
from clinic.triage.steps import STEPS, Observation, subject_of_case, triage
from clinic.work.cache import Files, key_of
from clinic.work.task import Task

FILE = "triage.json"
MARK = "The table is made by the build."
LENGTH = 90
MARKDOWN_ESCAPES = str.maketrans({"|": "\\|", "[": "\\[", "]": "\\]", "<": "&lt;", "*": "\\*"})


class Screening(BaseModel, frozen=True):
    """What each step saw in a case's broken model, and in the model after its first repair."""

    broken: list[Observation]
    fixed: list[Observation]

    def seen(self, step: str) -> tuple[list[Finding], list[Finding]]:
        """What the step found in the broken model: what it no longer finds after the repair, and the rest."""
        before, after = (next(o.findings for o in made if o.step == step) for made in (self.broken, self.fixed))
        left = {(finding.rule, finding.element) for finding in after}
        caught = [finding for finding in before if (finding.rule, finding.element) not in left]
        return caught, [finding for finding in before if finding not in caught]


def screening_tasks(cases: Iterable[Case]) -> Iterator[Task]:
    """Tasks that take the steps on every case that has a model."""
    for case in cases:
        if case.record.run is not None:
            run, texts = case.record.run.model_dump(mode="json"), [variant.text for variant in variants(case)[:2]]
            key = key_of("triage", case.record.number, case.record.title, run, texts, of="triage")
            yield Task(case.slug, "triage", key, partial(screen, case))


def screen(case: Case) -> Files:
    """The screening of one case, as a file; bounded by steps alone, so that it is the same on every machine."""
    broken, fixed = (list(triage(subject_of_case(case, variant.text))) for variant in variants(case)[:2])
    return {FILE: (Screening(broken=broken, fixed=fixed).model_dump_json() + "\n").encode()}


def table(cases: Iterable[Case], files: Mapping[str, Files]) -> str:
    """The table of cases by steps, what it adds up to, and the rules, as Markdown."""
    cases = list(cases)
    found = {slug: Screening.model_validate_json(made[FILE]) for slug, made in files.items()}
    titles = [f"{n}. [{title}](#{step})" for n, (step, (title, _)) in enumerate(STEPS.items(), 1)]
    lines = [f"| case | {' | '.join(titles)} |", "|---" * (1 + len(STEPS)) + "|"]
    for case in cases:
        link = f"cases/{case.slug}/index.md"
        name = case.record.heading.translate(MARKDOWN_ESCAPES)
        cells = [f"[{text}]({link})" for text in (name, *(cell(found.get(case.slug), step) for step in STEPS))]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(
        ['<div class="triage" markdown>', "", *lines, "", "</div>", "", _sum(cases, found.values()), "", *_rules()]
    )


def cell(screening: Screening | None, step: str) -> str:
    """What a step saw in a case: bold where the repair made it go away."""
    if screening is None:
        return "code"
    caught, stayed = screening.seen(step)
    if caught:
        return f"**{_said(caught)}**"
    return f"{_said(stayed)} (after the repair too)" if stayed else "nothing"


def _said(findings: list[Finding]) -> str:
    first = f"{findings[0].element}: {findings[0].text}"
    if len(first) > LENGTH:
        first = first[: first.rindex(" ", 0, LENGTH)] + " …"
    more = f" (and {len(findings) - 1} more)" if len(findings) > 1 else ""
    return first.translate(MARKDOWN_ESCAPES) + more


def _sum(cases: list[Case], screenings: Collection[Screening]) -> str:
    caught = [[step for step in STEPS if screening.seen(step)[0]] for screening in screenings]
    counts = ", ".join(f"{title} {sum(step in steps for steps in caught)}" for step, (title, _) in STEPS.items())
    said = f"Of {len(caught)} cases with a model, {sum(map(bool, caught))} are caught by at least one step: {counts}."
    if others := len(cases) - len(caught):
        said += f" The other {others} are bugs in code: no step that looks at a model can see them."
    return said


def _rules() -> Iterator[str]:
    yield from ('??? info "What steps 2 and 3 look for"', "")
    for module in (model_rules, scene_rules):
        for rule in module.RULES:
            yield f"    - {' '.join((inspect.getdoc(rule) or '').split())}"
        yield ""
