"""The cases' own pages with the files beside them, and what a build refuses to publish."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from clinic.pages.case_files import files_of_cases
from clinic.pages.case_page import case_page
from clinic.pages.playground import FILE as PLAYGROUND
from clinic.pages.playground import playground
from clinic.pages.text.manual import manual_problems
from clinic.pages.text.prose import opening
from clinic.proof.experiments import compare_alike, evidence_of
from clinic.proof.laws import breaches
from clinic.proof.lookalike import alike_problems
from clinic.record.case import Case
from clinic.record.folder import RECORD
from clinic.record.problem import CaseError, Problem, problems_by_case
from clinic.work.cache import Cache, Files

FOLDER = "cases/{slug}"
PAGE = f"{FOLDER}/index.md"
BUILD_LAWS = ("quoted", "typed", "verdicts", "warned", "lasting", "steady", "swept")  # laws for every page


@dataclass(frozen=True)
class CasePage:
    """A case that has a page: the page's text, what lists say of the symptom, and the files beside the page by name."""

    case: Case
    page: str
    symptom: str
    files: Files


def case_pages(
    root: Path, read: Iterable[Case], unread: set[str], cache: Cache, with_playground: bool
) -> tuple[list[CasePage], list[Problem]]:
    """The cases that can be shown, and the problems of all.

    Args:
        root: The checkout.
        read: The cases whose records can be read.
        unread: The others' slugs.
        cache: Where finished work is kept.
        with_playground: Whether the site has a playground.
    """
    known = {case.slug: case for case in read}
    problems = [problem for problem in alike_problems(known) if problem.found not in unread]
    left_out = set(problems_by_case(problems))
    made, failed = files_of_cases(known.values(), cache)
    problems += failed
    left_out |= known.keys() - made.keys()
    cases = {slug: keep_relations(case, left_out, known) for slug, case in known.items() if slug in made}
    shown = []
    for slug, case in cases.items():
        evidence = evidence_of(made[slug])  # of one case at a time: a thousand would fill the memory
        alike, unclear = compare_alike(case, cases, cache)
        problems += [*manual_problems(case), *breaches(case, evidence, *BUILD_LAWS), *unclear]
        files = dict(made[slug])
        if with_playground and case.record.model is not None:
            files[PLAYGROUND] = playground(case, known.values())
        try:
            page = case_page(case, evidence, files, known | cases, alike)
            sources = {name: (root / "cases" / slug / name).read_bytes() for name in (RECORD, *case.texts)}
        except CaseError as error:
            problems += error.problems
        except OSError as error:  # renamed or deleted since it was read
            problems.append(case.problem((), type(error).__name__, "the folder as it was read", "build again"))
        else:
            shown.append(CasePage(case, page, opening(case, evidence), files | sources))
    return shown, problems


def keep_relations(case: Case, left_out: Container[str], known: Mapping[str, Case]) -> Case:
    """The case with those relations alone whose cases can be shown, and without `alike` if it is left out itself."""
    record = case.record
    see = [slug for slug in record.see if slug in known and slug != case.slug]
    alike = None if case.slug in left_out else record.alike
    if alike is not None:
        others = [slug for slug in alike.cases if slug in known and slug not in left_out]
        alike = alike.model_copy(update={"cases": others}) if others else None
    return replace(case, record=record.model_copy(update={"see": see, "alike": alike}))
