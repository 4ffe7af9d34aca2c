"""The files beside a case's page that had to be made: the evidence, and the plots, film and pictures drawn from it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial

from clinic.proof.experiments import EVIDENCE, case_task, evidence_of, measure_cases, only_case
from clinic.record.case import Case
from clinic.record.problem import Problem
from clinic.work.cache import Cache, Files
from clinic.work.task import Task, run_tasks

DRAWING = "pages/figures"


def files_of_cases(cases: Iterable[Case], cache: Cache) -> tuple[dict[str, Files], list[Problem]]:
    """The files of every case that can be run, by slug, and the problems of the others.

    A case has neither on a machine that lacks what its runs need.
    """
    cases = list(cases)
    measured, problems = measure_cases(cases, cache)
    tasks = [task for case in cases if case.slug in measured for task in drawing_tasks(case, measured[case.slug])]
    drawn, more = run_tasks(sorted(tasks, key=lambda task: task.kind), cache)
    return {slug: measured[slug] | files for slug, files in drawn.items()}, problems + more


def files_of_case(case: Case, cache: Cache) -> Files:
    """The files of one case.

    Raises:
        CaseError: If the case cannot be run, on this machine or on any.
    """
    return only_case(case, *files_of_cases([case], cache))


def drawing_tasks(case: Case, measured: Files) -> Iterator[Task]:
    """Tasks that draw the film, the pictures and the plots, by what was measured."""
    yield from picture_tasks(case)
    evidence = measured[EVIDENCE].decode()
    if case.record.picture.shows:
        yield case_task(case, "replay", partial(_replay, case, measured), evidence, case.record.title, of=DRAWING)
    yield case_task(case, "plots", partial(_plots, case, measured), evidence, of=DRAWING)


def picture_tasks(case: Case) -> Iterator[Task]:
    """Tasks that draw the film and the pictures, which depend on the case alone."""
    if case.record.filmed is not None:
        yield case_task(case, "film", partial(_film, case), of=DRAWING)
    if not case.record.picture.shows:
        yield case_task(case, "pictures", partial(_pictures, case), case.record.title, of=DRAWING)  # on the card


def _film(case: Case) -> Files:
    from clinic.pages.figures.film import film  # what draws is slow to import

    return film(case)


def _pictures(case: Case) -> Files:
    from clinic.pages.figures.pictures import pictures

    return pictures(case)


def _replay(case: Case, measured: Files) -> Files:
    from clinic.pages.figures.replay import replay

    return replay(case, evidence_of(measured))


def _plots(case: Case, measured: Files) -> Files:
    from clinic.pages.figures.plots import plots

    return plots(case, evidence_of(measured))
