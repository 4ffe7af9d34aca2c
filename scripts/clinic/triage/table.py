"""Which step would have caught which case: the six steps on every case's broken model, and on its first repair."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator, Mapping
from functools import partial

from pydantic import BaseModel, ConfigDict

from clinic.engine.variant import variants
from clinic.record.case import Case
from clinic.triage import model, scene
from clinic.triage.steps import STEPS, Finding, Observation, subject_of_case, triage
from clinic.work.cache import Files, key_of
from clinic.work.task import Task

FILE = "triage.json"
MARK = "The table is made by the build."
LENGTH = 90


class Screening(BaseModel):
    """What each step saw in a case's broken model, and in the model after its first repair."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    broken: list[Observation]
    fixed: list[Observation]

    def caught(self, step: str) -> list[Finding]:
        """What the step found in the broken model and no longer finds after the repair."""
        left = {(f.rule, f.element) for f in self._of(self.fixed, step)}
        return [f for f in self._of(self.broken, step) if (f.rule, f.element) not in left]

    def stayed(self, step: str) -> list[Finding]:
        """What the step finds in both: nothing that the repair has to do with."""
        caught = self.caught(step)
        return [f for f in self._of(self.broken, step) if f not in caught]

    def _of(self, observations: list[Observation], step: str) -> list[Finding]:
        return next(o.findings for o in observations if o.step == step)


def screening_tasks(cases: Iterable[Case]) -> Iterator[Task]:
    """The work for every case that has a model."""
    for case in cases:
        if case.record.run is not None:
            run, texts = case.record.run.model_dump(mode="json"), [variant.text for variant in variants(case)[:2]]
            key = key_of("triage", case.record.number, case.record.title, run, texts, of="triage")
            yield Task(case.slug, "triage", key, partial(screen, case))


def screen(case: Case) -> Files:
    """The screening of one case, as a file; bounded by steps alone, so that it is the same on every machine."""
    broken, fixed, *_ = variants(case)
    made = Screening(
        broken=list(triage(subject_of_case(case, broken.text))), fixed=list(triage(subject_of_case(case, fixed.text)))
    )
    return {FILE: (made.model_dump_json() + "\n").encode()}


def table(cases: Iterable[Case], files: Mapping[str, Files]) -> str:
    """The table of cases by steps, what it adds up to, and the rules, as Markdown."""
    cases = list(cases)
    found = {slug: Screening.model_validate_json(made[FILE]) for slug, made in files.items()}
    lines = [
        f"| case | {' | '.join(f'{n}. [{title}](#{step})' for n, (step, (title, _)) in enumerate(STEPS.items(), 1))} |",
        "|---" * (1 + len(STEPS)) + "|",
    ]
    for case in cases:
        link = f"cases/{case.slug}/index.md"
        cells = [f"[{cell(found.get(case.slug), step)}]({link})" for step in STEPS]
        lines.append(f"| [{case.record.number}. {_safe(case.record.title)}]({link}) | {' | '.join(cells)} |")
    return "\n".join(['<div class="triage" markdown>', "", *lines, "", "</div>", "", _sum(cases, found), "", *_rules()])


def cell(screening: Screening | None, step: str) -> str:
    """What a step saw in a case: bold where the repair made it go away."""
    if screening is None:
        return "code"
    if caught := screening.caught(step):
        return f"**{_said(caught)}**"
    if stayed := screening.stayed(step):
        return f"{_said(stayed)} (after the repair too)"
    return "nothing"


def _said(findings: list[Finding]) -> str:
    first = f"{findings[0].element}: {findings[0].text}"
    if len(first) > LENGTH:
        first = first[: first.rindex(" ", 0, LENGTH)] + " …"
    more = f" (and {len(findings) - 1} more)" if len(findings) > 1 else ""
    return _safe(first) + more


def _sum(cases: list[Case], found: Mapping[str, Screening]) -> str:
    models = [case for case in cases if case.slug in found]
    by_step = {step: sum(bool(found[case.slug].caught(step)) for case in models) for step in STEPS}
    missed = [case for case in models if not any(found[case.slug].caught(step) for step in STEPS)]
    first = next((step for step in STEPS if by_step[step]), None)
    counts = ", ".join(f"{STEPS[step][0]} {count}" for step, count in by_step.items())
    said = [
        f"Of {len(models)} cases with a model, {len(models) - len(missed)} are caught by at least one step: {counts}."
    ]
    if first is not None and missed:
        names = ", ".join(f"[{case.record.number}](cases/{case.slug}/index.md)" for case in missed)
        said.append(f"No step sees anything that the repair removes in {names}.")
    if len(models) < len(cases):
        said.append(
            f"The other {len(cases) - len(models)} are bugs in code: no step that looks at a model can see them."
        )
    return " ".join(said)


def _rules() -> Iterator[str]:
    yield from ('??? info "What steps 2 and 3 look for"', "")
    for module in (model, scene):
        for rule in module.RULES:
            yield f"    - {' '.join((inspect.getdoc(rule) or '').split())}"
        yield ""


def _safe(text: str) -> str:
    """Text that means nothing to Markdown's tables and links."""
    return text.replace("|", "\\|").replace("[", "\\[").replace("]", "\\]").replace("<", "&lt;").replace("*", "\\*")
