"""The judgement of a case: every problem of its record and every law it breaks, whatever state other cases are in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from clinic.engine.signals import SignalError
from clinic.pages.case_page import case_page
from clinic.pages.exhibits import evidence_of, exhibits
from clinic.pages.symptoms import symptom_problems
from clinic.pages.text.manual import manual_problems
from clinic.proof.evidence import Evidence
from clinic.proof.laws import LAWS, breaches
from clinic.proof.lookalike import alike_problems, group, matrix, unclear
from clinic.record.case import Case, read_cases
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache

Tell = Callable[[str], None]


@dataclass(frozen=True)
class Judgement:
    """What was found about one case.

    Args:
        slug: The case's folder.
        case: The case; None if its record could not be read.
        evidence: What its runs showed; None if it could not be run.
        problems: Mistakes in its files.
        breaches: Of laws.
    """

    slug: str
    case: Case | None
    evidence: Evidence | None
    problems: tuple[Problem, ...]
    breaches: tuple[Problem, ...]

    @property
    def sound(self) -> bool:
        """Whether nothing was found."""
        return not (self.problems or self.breaches)


class Neighbours:
    """The cases around the one judged, as far as they can be read, and the problems of all."""

    def __init__(self, root: Path) -> None:
        cases, problems = read_cases(root / "cases")
        self.cases = {case.slug: case for case in cases}
        self.problems = [*problems, *alike_problems(self.cases)]

    def problems_of(self, slug: str) -> list[Problem]:
        """The problems in the files of one case, those of its relations included."""
        place = f"cases/{slug}"
        return [each for each in self.problems if each.file == place or each.file.startswith(f"{place}/")]


def judge_folder(folder: Path, neighbours: Neighbours, cache: Cache, tell: Tell = lambda said: None) -> Judgement:
    """Reads, runs and judges the case in `folder`; `tell` hears what is being done."""
    slug, case = folder.name, neighbours.cases.get(folder.name)
    problems = neighbours.problems_of(slug)
    if case is None:
        return Judgement(slug, None, None, tuple(problems), ())
    problems += [*manual_problems(case), *symptom_problems([case])]
    tell("runs, sweeps and film")
    try:
        files = exhibits(case, cache)
    except CaseError as error:
        return Judgement(slug, case, None, tuple(sorted({*problems, *error.problems})), ())
    evidence = evidence_of(files)
    tell("laws")
    broken = breaches(case, evidence, *LAWS)
    made = None
    if case.record.alike is not None and not problems:
        try:
            made = matrix(group(case, neighbours.cases))
            broken += unclear(case, made)
        except SignalError as error:
            problems.append(case.problem(("alike", "path"), error.found, error.expected, error.repair))
    if set(case.record.see) <= neighbours.cases.keys():
        try:
            case_page(case, evidence, files, neighbours.cases, made)
        except CaseError as error:
            problems += error.problems
    return Judgement(slug, case, evidence, tuple(sorted(set(problems))), tuple(sorted(set(broken))))


def plain(judgement: Judgement) -> dict[str, Any]:
    """The judgement as data: the public form of `clinic check --json`."""
    variants = judgement.evidence.variants if judgement.evidence else {}
    return {
        "case": judgement.slug,
        "number": judgement.case.record.number if judgement.case else None,
        "title": judgement.case.record.title if judgement.case else None,
        "sound": judgement.sound,
        "problems": [asdict(problem) for problem in judgement.problems],
        "breaches": [asdict(problem) for problem in judgement.breaches],
        "variants": {
            key: variant.model_dump(mode="json", include={"kind", "title", "warnings", "checks"})
            for key, variant in variants.items()
        },
    }
