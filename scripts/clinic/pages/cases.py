"""The cases' own pages with the files beside them, and what a build refuses to publish."""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from clinic.pages.brief import Brief, brief
from clinic.pages.case_files import files_of_cases
from clinic.pages.case_page import case_page, telling
from clinic.pages.playground import FILE as PLAYGROUND
from clinic.pages.playground import playground
from clinic.pages.text.manual import manual_problems
from clinic.pages.text.prose import opening
from clinic.proof.experiments import differential, evidence_of
from clinic.proof.laws import breaches
from clinic.proof.procedure import Differential
from clinic.record.case import Case
from clinic.record.claims import CLAIMS
from clinic.record.folder import RECORD
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, Files

FOLDER = "cases/{slug}"
PAGE = f"{FOLDER}/index.md"
BUILD_LAWS = ("quoted", "typed", "verdicts", "warned", "lasting", "steady", "swept")  # laws for every page


@dataclass(frozen=True)
class CasePage:
    """A case that has a page.

    Attributes:
        page: The page's text.
        symptom: What lists say of the symptom.
        files: The files beside the page by name.
        telling: What tells it from others of its family, in words; empty if nothing does.
        brief: What was measured of the broken and of the repaired model; None where no number differs.
    """

    case: Case
    page: str
    symptom: str
    files: Files
    telling: str = ""
    brief: Brief | None = None

    @property
    def playable(self) -> bool:
        """Whether its model can be run and mended in the page."""
        return PLAYGROUND in self.files


Differentials = dict[str | None, Differential | None]
"""What tells the causes of each family apart; the key None, of cases without a family, has None."""


def case_pages(
    root: Path, read: Iterable[Case], cache: Cache, with_playground: bool
) -> tuple[list[CasePage], Differentials, list[Problem]]:
    """The cases that can be shown, what tells the causes of their families apart, and the problems of all.

    Args:
        root: The checkout.
        read: The cases whose records can be read.
        cache: Where finished work is kept.
        with_playground: Whether the site has a playground.
    """
    known = {case.slug: case for case in read}
    made, problems = files_of_cases(known.values(), cache)
    cases = {slug: keep_relations(case, known) for slug, case in known.items() if slug in made}
    told: Differentials = {None: None}
    for family in {case.record.family for case in cases.values()} - {None}:
        told[family], unclear = differential(str(family), cases.values(), cache)
        problems += unclear
    shown = []
    for slug, case in cases.items():
        evidence = evidence_of(made[slug])  # of one case at a time: a thousand would fill the memory
        problems += [*manual_problems(case), *breaches(case, evidence, *BUILD_LAWS)]
        files = dict(made[slug])
        if with_playground and (content := playground(case, known.values(), evidence)) is not None:
            files[PLAYGROUND] = content
        try:
            page = case_page(case, evidence, files, known | cases, told[case.record.family])
            names = (RECORD, *([CLAIMS] if case.claims else []), *case.texts)
            sources = {name: (root / "cases" / slug / name).read_bytes() for name in names}
        except CaseError as error:
            problems += error.problems
        except OSError as error:  # renamed or deleted since it was read
            problems.append(case.problem((), type(error).__name__, "the folder as it was read", "build again"))
        else:
            words = opening(case, evidence), files | sources, telling(case, evidence), brief(case, evidence)
            shown.append(CasePage(case, page, *words))
    return shown, told, problems


def keep_relations(case: Case, known: Container[str]) -> Case:
    """The case with those relations alone whose cases can be shown."""
    see = [slug for slug in case.record.see if slug in known and slug != case.slug]
    return replace(case, record=case.record.model_copy(update={"see": see}))
