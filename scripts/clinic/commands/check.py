"""The checking of cases: all that is wrong with a record and every law that it breaks, whatever state others are in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from clinic.pages.case_files import files_of_case
from clinic.pages.case_page import case_page
from clinic.pages.text.manual import manual_problems
from clinic.proof.evidence import Evidence
from clinic.proof.experiments import ALL, differential, measure_case
from clinic.proof.filing import filing_problems
from clinic.proof.laws import LAWS, breaches
from clinic.proof.model_problems import check_against_model
from clinic.record.case import Case, Reading, read_case, read_cases
from clinic.record.problem import CaseError, Problem, problems_by_case
from clinic.work.cache import Cache


@dataclass(frozen=True)
class Report:
    """What was found about one case.

    Attributes:
        case: None if its record could not be read.
        evidence: What its runs showed; None if it could not be run.
        problems: Mistakes in its files, and those of other cases that concern it.
        breaches: Of laws.
    """

    slug: str
    case: Case | None
    evidence: Evidence | None
    problems: tuple[Problem, ...]
    breaches: tuple[Problem, ...] = ()

    @property
    def sound(self) -> bool:
        """Whether nothing was found."""
        return not (self.problems or self.breaches)

    @property
    def grade(self) -> str | None:
        """A, or B where the record is without something that A asks for; None if it could not be read."""
        return None if self.case is None else "B" if self.case.lacking else "A"


def check_cases(root: Path, slugs: Iterable[str], cache: Cache) -> Iterator[Report]:
    """Reads, runs and judges the cases of a checkout, one after the other."""
    read, problems = read_cases(root / "cases")
    known = {case.slug: case for case in read}
    found = problems_by_case([*problems, *filing_problems(known)])
    for slug in slugs:
        yield _check(root, slug, known, found.get(slug, []), cache)


def report_data(report: Report) -> dict[str, Any]:
    """The report as data: the public form of `clinic check --json`."""
    variants = report.evidence.variants if report.evidence else {}
    return {
        "case": report.slug,
        "number": report.case.record.number if report.case else None,
        "title": report.case.record.title if report.case else None,
        "sound": report.sound,
        "grade": report.grade,
        "problems": [asdict(problem) for problem in report.problems],
        "breaches": [asdict(problem) for problem in report.breaches],
        "variants": {
            key: variant.model_dump(mode="json", include={"kind", "title", "warnings", "checks"})
            for key, variant in variants.items()
        },
    }


def _further_problems(reading: Reading) -> list[Problem]:
    """What the models of a case that could not be read say about it all the same."""
    case = reading.case
    if case is None or case.record.source not in case.texts:
        return []
    try:
        check_against_model(case)
    except CaseError as error:
        return reading.own(error.problems)
    return []


def _check(root: Path, slug: str, known: Mapping[str, Case], problems: list[Problem], cache: Cache) -> Report:
    case = known.get(slug)
    if case is None:
        return Report(
            slug, None, None, tuple(sorted({*problems, *_further_problems(read_case(root / "cases" / slug))}))
        )
    problems = [*problems, *manual_problems(case)]
    try:
        files = files_of_case(case, cache)
    except CaseError as error:
        return Report(slug, case, None, tuple(sorted({*problems, *error.problems})))
    evidence = measure_case(case, cache, ALL)
    family = case.record.family
    told, unclear = (None, []) if family is None else differential(family, known.values(), cache)
    broken = [*breaches(case, evidence, *LAWS), *problems_by_case(unclear).get(slug, [])]
    if set(case.record.see) <= known.keys():
        try:
            case_page(case, evidence, files, known, told)
        except CaseError as error:
            problems += error.problems
    return Report(slug, case, evidence, tuple(sorted(set(problems))), tuple(sorted(set(broken))))
