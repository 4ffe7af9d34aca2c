"""The cases' own pages with the files beside them, and what a build refuses to publish."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import mujoco

from clinic.pages.case_page import Card, card, case_page
from clinic.pages.error_page import by_case, without
from clinic.pages.exhibits import evidence_of, possible_exhibits
from clinic.pages.playground import FILE as PLAYGROUND
from clinic.pages.playground import playground
from clinic.pages.text.manual import manual_problems
from clinic.proof.evidence import Evidence
from clinic.proof.laws import breaches
from clinic.proof.lookalike import Matrix, alike_problems, group, matrix, unclear
from clinic.record.case import Case
from clinic.record.folder import RECORD
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, Files, key_of

FOLDER = "cases/{slug}"
PAGE = f"{FOLDER}/index.md"
AT_ONCE = ("quoted", "typed", "verdicts", "warned")  # laws that need the variants' runs alone


@dataclass(frozen=True)
class Shown:
    """A case that has a page: the page's text, and the files beside it by name."""

    case: Case
    page: str
    card: Card
    files: Files


def shown_cases(
    root: Path, read: Iterable[Case], unread: set[str], cache: Cache, live: bool
) -> tuple[list[Shown], list[Problem]]:
    """The cases that can be shown, and the problems of all.

    Args:
        root: The checkout.
        read: The cases whose records can be read.
        unread: The others' slugs.
        cache: Where finished work is kept.
        live: Whether the site has a playground.
    """
    known = {case.slug: case for case in read}
    blamed = [problem for problem in alike_problems(known) if problem.found not in unread]
    exhibits, failed = possible_exhibits(known.values(), cache)
    problems = [*blamed, *failed]
    out = by_case(blamed).keys() | known.keys() - exhibits.keys()
    cases = {slug: without(case, out, known) for slug, case in known.items() if slug in exhibits}
    everyone, warned = known | cases, [case for case in known.values() if case.record.warnings]
    shown = []
    for slug, case in cases.items():
        evidence = evidence_of(exhibits[slug])  # of one case at a time: a thousand would fill the memory
        alike, wrong = _alike(case, cases, cache)
        wrong += manual_problems(case)
        wrong += unproven(case, evidence, alike)
        files = dict(exhibits[slug])
        if live and case.record.model is not None:
            files[PLAYGROUND] = playground(case, mujoco.__version__, warned)
        try:
            page = case_page(case, evidence, files, everyone, alike)
            sources = {name: (root / "cases" / slug / name).read_bytes() for name in (RECORD, *case.texts)}
            shown.append(Shown(case, page, card(case, evidence, files), {**files, **sources}))
        except CaseError as error:
            wrong += error.problems
        except OSError as error:  # renamed or deleted since it was read
            wrong.append(case.problem((), type(error).__name__, "the folder as it was read", "build again"))
        problems += wrong
    return shown, problems


def unproven(case: Case, evidence: Evidence, alike: Matrix | None) -> Iterator[Problem]:
    """What a build refuses to publish: claims that the runs do not bear out."""
    yield from breaches(case, evidence, *AT_ONCE, "lasting", "steady", "swept")
    if alike is not None:
        yield from unclear(case, alike)


def _alike(case: Case, cases: Mapping[str, Case], cache: Cache) -> tuple[Matrix | None, list[Problem]]:
    """The matrix of a case that has look-alikes."""
    if case.record.alike is None:
        return None, []
    members = group(case, cases)
    asked = [[m.slug, m.text, m.record.model_dump(mode="json", include={"run", "alike"})] for m in members]
    key = key_of("alike", asked, of="proof")
    try:
        files = cache.remember(key, partial(_matrix_file, members))
    except ValueError as error:  # a path that one of the models lacks
        repair = "name what every model of the group has"
        return None, [case.problem(("alike",), str(error), "measurements of every model of the group", repair)]
    return Matrix.model_validate_json(files["matrix.json"]), []


def _matrix_file(members: list[Case]) -> Files:
    return {"matrix.json": matrix(members).model_dump_json().encode()}
