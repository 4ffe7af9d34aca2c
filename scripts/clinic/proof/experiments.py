"""Every experiment on a case, cut into tasks: the variants, sweeps, other starts, and the comparison of look-alikes.

A task's result is kept under a key made of all that it depends on, so that a change of prose runs nothing, and a change
of one case runs that case's tasks alone. Tasks that are not kept run in parallel.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from functools import partial

from pydantic import TypeAdapter

from clinic.engine import node
from clinic.engine.signals import SignalError
from clinic.proof.evidence import Evidence, collect, lack
from clinic.proof.lookalike import Matrix, group, matrix, unclear
from clinic.proof.robustness import Robustness, robustness
from clinic.proof.sweep import Point, grid, measure_points, summarise
from clinic.record.case import Case
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, Files, key_of
from clinic.work.task import Task, run_tasks

EVIDENCE = "evidence.json"
WORDS = {"number", "title", "symptom", "diagnosis", "cause", "fix", "lesson", "no_sweep"}
WORDS |= {"tags", "phrases", "looks", "manual", "see", "alike", "exempt"}
SLICE = 60  # points of a sweep in one task
POINTS = TypeAdapter(list[Point])
ROBUST = TypeAdapter(dict[str, Robustness])


def measure_cases(cases: Iterable[Case], cache: Cache) -> tuple[dict[str, Files], list[Problem]]:
    """The file EVIDENCE of every case that can be run, by slug, and the problems of the others.

    A case has neither on a machine that lacks what its runs need.
    """
    cases = sorted(cases, key=lambda case: case.record.run is not None)  # what takes long goes first, not last
    first, problems = run_tasks([evidence_task(case) for case in cases], cache)
    cases = [case for case in cases if EVIDENCE in first.get(case.slug, {})]
    measuring = [task for case in cases for task in measuring_tasks(case)]
    rest, more = run_tasks(sorted(measuring, key=lambda task: task.kind), cache)
    failed = {task.slug for task in measuring} - rest.keys()
    made: dict[str, Files] = {}
    for case in cases:
        if case.slug not in failed:
            made[case.slug] = assembled(case, first[case.slug], rest.get(case.slug, {}))
    return made, problems + more


def measure_case(case: Case, cache: Cache, kinds: Container[str] = ("sweeps", "robustness")) -> Evidence:
    """What the runs of one case show; of those beside its variants, the kinds asked for.

    Raises:
        CaseError: If the case cannot be run, on this machine or on any.
    """
    first = of_one(case, *run_tasks([evidence_task(case)], cache))
    tasks = [task for task in measuring_tasks(case) if task.kind in kinds]
    return evidence_of(assembled(case, first, of_one(case, *run_tasks(tasks, cache))) if tasks else first)


def of_one(case: Case, made: Mapping[str, Files], problems: Iterable[Problem]) -> Files:
    """The files of the only case asked for.

    Raises:
        CaseError: If there are none, with the problems or with what this machine lacks.
    """
    if case.slug not in made:
        raise CaseError([*problems] or [missing for missing in [lack(case)] if missing])
    return made[case.slug]


def evidence_of(files: Files) -> Evidence:
    """The evidence among a case's files."""
    return Evidence.model_validate_json(files[EVIDENCE])


def evidence_task(case: Case) -> Task:
    """Runs every variant and the snippet."""
    return case_task(case, "evidence", partial(_collect, case))


def measuring_tasks(case: Case) -> Iterator[Task]:
    """Run what needs the variants to be sound: the sweeps in slices, and the variants from other starts."""
    for name, sweep in case.record.sweep.items():
        for k in range(0, len(grid(sweep)), SLICE):
            yield case_task(case, "sweeps", partial(_slice, case, name, k), name, k)
    if case.record.run is not None:
        yield case_task(case, "robustness", partial(_robustness, case))


def assembled(case: Case, first: Files, rest: Files) -> Files:
    """The file EVIDENCE, whole, from the files of `evidence_task` and those of `measuring_tasks`."""
    sweeps = {}
    for name, sweep in case.record.sweep.items():
        slices = [rest[_points_file(name, k)] for k in range(0, len(grid(sweep)), SLICE)]
        sweeps[name] = summarise(case, sweep, [point for part in slices for point in POINTS.validate_json(part)])
    robust = ROBUST.validate_json(rest["robustness.json"]) if "robustness.json" in rest else {}
    whole = evidence_of(first).model_copy(update={"sweep": sweeps, "robustness": robust})
    return {EVIDENCE: f"{whole.model_dump_json()}\n".encode()}


def case_task(case: Case, kind: str, make: Callable[[], Files], *part: object, of: str = "proof") -> Task:
    """A task of a case, whose result depends on all of the record but its words, and on `part`.

    Args:
        case: The case.
        kind: What is made.
        make: Makes it.
        part: Which part of it, as JSON takes it.
        of: The folder of the package that does the work.
    """
    experiment = case.record.model_dump(mode="json", exclude=WORDS)
    engine = [node.version(node.MUJOCO), node.release()] if case.record.language == "javascript" else []
    whole = (*part, *engine, case.slug, case.record.number, experiment, case.texts)
    return Task(case.slug, kind, key_of(kind, *whole, of=of), make)


def compare_alike(case: Case, cases: Mapping[str, Case], cache: Cache) -> tuple[Matrix | None, list[Problem]]:
    """The measurements that tell a case from its look-alikes, None if it has none, and what they do not tell apart."""
    if case.record.alike is None:
        return None, []
    members = group(case, cases)
    asked = [[m.slug, m.text, m.record.model_dump(mode="json", include={"run", "alike"})] for m in members]
    key = key_of("alike", asked, of="proof")
    try:
        files = cache.remember(key, lambda: {"matrix.json": matrix(members).model_dump_json().encode()})
    except SignalError as error:
        return None, [case.problem(("alike", "path"), error.found, error.expected, error.repair)]
    made = Matrix.model_validate_json(files["matrix.json"])
    return made, list(unclear(case, made))


def _collect(case: Case) -> Files:
    return {EVIDENCE: collect(case).model_dump_json().encode()}


def _slice(case: Case, name: str, k: int) -> Files:
    sweep = case.record.sweep[name]
    return {_points_file(name, k): POINTS.dump_json(measure_points(case, sweep, grid(sweep)[k : k + SLICE]))}


def _robustness(case: Case) -> Files:
    return {"robustness.json": ROBUST.dump_json(robustness(case))}


def _points_file(name: str, k: int) -> str:
    return f"sweep-{name}-{k}.json"
