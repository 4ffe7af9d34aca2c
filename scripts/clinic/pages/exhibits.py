"""Exhibits: everything a case's page shows that had to be run or drawn, as files.

The work is cut into tasks. A task's result is kept under a key made of all it depends on, so that a change of prose
runs nothing and a change of one case runs that case's tasks alone. Tasks that are not kept run in parallel; what they
alone need is imported by them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial

from pydantic import TypeAdapter

from clinic.engine import node
from clinic.proof.evidence import Evidence, collect, lack
from clinic.proof.robustness import Robustness, robustness
from clinic.proof.sweep import Point, grid, measure_points, summarise
from clinic.record.case import Case
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, Files, key_of
from clinic.work.task import Task, run_tasks

PROSE = {"number", "title", "symptom", "diagnosis", "cause", "fix", "lesson", "no_sweep"}
PROSE |= {"tags", "phrases", "looks", "manual", "see", "alike", "exempt"}
SLICE = 60
LONG = ("film", "robustness", "sweeps", "pictures")  # kinds of measuring, by the longest task of each
DRAWN = {"film", "pictures", "plots"}
EVIDENCE = "evidence.json"
POINTS = TypeAdapter(list[Point])
ROBUST = TypeAdapter(dict[str, Robustness])


def all_exhibits(cases: Iterable[Case], cache: Cache) -> dict[str, Files]:
    """The exhibits of every case, by slug.

    Raises:
        CaseError: With the problems of all cases that cannot be run.
    """
    cases = list(cases)
    made, problems = possible_exhibits(cases, cache)
    problems = problems or [missing for case in cases if case.slug not in made and (missing := lack(case))]
    if problems:
        raise CaseError(problems)
    return made


def possible_exhibits(cases: Iterable[Case], cache: Cache) -> tuple[dict[str, Files], list[Problem]]:
    """The exhibits of every case that can be run, by slug, and the problems of the others.

    A case has neither on a machine that lacks what its runs need.
    """
    cases = sorted(cases, key=lambda case: case.record.run is not None)  # what takes long goes first, not last
    first, problems = run_tasks([evidence_task(case) for case in cases], cache)
    cases = [case for case in cases if EVIDENCE in first.get(case.slug, {})]
    measuring = [task for case in cases for task in measuring_tasks(case)]
    rest, more = run_tasks(sorted(measuring, key=lambda task: LONG.index(task.kind)), cache)
    cases = [case for case in cases if case.slug in rest]
    whole = {case.slug: assembled(case, first[case.slug], rest[case.slug]).model_dump_json() for case in cases}
    drawn, others = run_tasks([_figure_task(case, whole[case.slug]) for case in cases], cache)
    made = {
        slug: {
            EVIDENCE: (whole[slug] + "\n").encode(),
            **figures,
            **{name: content for name, content in rest[slug].items() if not name.endswith(".json")},
        }
        for slug, figures in drawn.items()
    }
    return made, problems + more + others


def exhibits(case: Case, cache: Cache) -> Files:
    """The exhibits of one case.

    Raises:
        CaseError: If the case cannot be run.
    """
    return all_exhibits([case], cache)[case.slug]


def measured(case: Case, cache: Cache, sweeps: bool = True) -> Evidence:
    """What the case's runs show, with nothing drawn and without robustness; without its sweeps unless asked for.

    Raises:
        CaseError: If the case cannot be run.
    """
    first, problems = run_tasks([evidence_task(case)], cache)
    if EVIDENCE not in first.get(case.slug, {}):
        raise CaseError(problems or [missing for missing in [lack(case)] if missing])
    rest, problems = run_tasks([t for t in measuring_tasks(case) if sweeps and t.kind == "sweeps"], cache)
    if problems:
        raise CaseError(problems)
    return assembled(case, first[case.slug], rest[case.slug]) if rest else evidence_of(first[case.slug])


def evidence_of(files: Files) -> Evidence:
    """The evidence among a case's exhibits."""
    return Evidence.model_validate_json(files[EVIDENCE])


def evidence_task(case: Case) -> Task:
    """Runs every variant and the snippet."""
    return _task(case, "evidence", partial(_collect, case))


def measuring_tasks(case: Case) -> Iterator[Task]:
    """The sweeps in slices, the robustness, the film and the pictures."""
    for name, sweep in case.record.sweep.items():
        points = grid(sweep)
        for k in range(0, len(points), SLICE):
            yield _task(case, "sweeps", partial(_slice, case, name, k), name, k)
    if case.record.run is not None:
        yield _task(case, "robustness", partial(_robustness, case))
    if case.record.film is not None:
        yield _task(case, "film", partial(_film, case))
    yield _task(case, "pictures", partial(_pictures, case))


def figure_task(case: Case, evidence: Evidence) -> Task:
    """Draws the plots."""
    return _figure_task(case, evidence.model_dump_json())


def assembled(case: Case, first: Files, rest: Files) -> Evidence:
    """The evidence with the sweeps' and the robustness' results."""
    sweeps = {}
    for name, sweep in case.record.sweep.items():
        slices = [rest[_points_file(name, k)] for k in range(0, len(grid(sweep)), SLICE)]
        sweeps[name] = summarise(case, sweep, [point for part in slices for point in POINTS.validate_json(part)])
    robust = ROBUST.validate_json(rest["robustness.json"]) if "robustness.json" in rest else {}
    return evidence_of(first).model_copy(update={"sweep": sweeps, "robustness": robust})


def _task(case: Case, kind: str, make: Callable[[], Files], *part: object) -> Task:
    experiment = case.record.model_dump(mode="json", exclude=PROSE)
    engine = [node.version(node.MUJOCO), node.release()] if case.record.language == "javascript" else []
    whole = (*part, *engine, case.slug, case.record.number, experiment, case.texts)
    return Task(case.slug, kind, key_of(kind, *whole, of="pages/figures" if kind in DRAWN else "proof"), make)


def _collect(case: Case) -> Files:
    return {EVIDENCE: collect(case).model_dump_json().encode()}


def _slice(case: Case, name: str, k: int) -> Files:
    sweep = case.record.sweep[name]
    return {_points_file(name, k): POINTS.dump_json(measure_points(case, sweep, grid(sweep)[k : k + SLICE]))}


def _film(case: Case) -> Files:
    from clinic.pages.figures.film import film

    return film(case)


def _pictures(case: Case) -> Files:
    from clinic.pages.figures.pictures import pictures

    return pictures(case)


def _figure_task(case: Case, evidence: str) -> Task:
    return _task(case, "plots", partial(_figures, case, evidence), evidence)


def _figures(case: Case, evidence: str) -> Files:
    from clinic.pages.figures.plots import plots

    return plots(case, Evidence.model_validate_json(evidence))


def _robustness(case: Case) -> Files:
    return {"robustness.json": ROBUST.dump_json(robustness(case))}


def _points_file(name: str, k: int) -> str:
    return f"sweep-{name}-{k}.json"
