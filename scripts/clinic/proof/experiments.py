"""Every experiment on a case, cut into tasks: variants, sweeps, other starts, and what tells a family's causes apart.

A task's result is kept under a key made of all that it depends on, so that a change of prose runs nothing, and a change
of one case runs that case's tasks alone. Tasks that are not kept run in parallel.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from functools import partial

from pydantic import TypeAdapter
from pydantic_core import to_json

from clinic.engine import node
from clinic.engine.script import ScriptError
from clinic.proof.claims import unshown
from clinic.proof.evidence import Evidence, collect, missing_requirement
from clinic.proof.model_problems import check_against_model
from clinic.proof.procedure import (
    Answer,
    Differential,
    asked,
    members,
    procedure,
    procedure_problems,
    run_procedure,
)
from clinic.proof.releases import on_releases
from clinic.proof.robustness import Robustness, robustness
from clinic.proof.sweep import SweepEvidence, measure_sweep
from clinic.proof.tightness import Loose, loose_numbers, numbers
from clinic.record.case import Case
from clinic.record.fields import WORDS
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, Files, key_of
from clinic.work.task import Task, run_tasks

EVIDENCE = "evidence.json"
ANSWERS = TypeAdapter(dict[str, Answer])
ROBUST = TypeAdapter(dict[str, Robustness])
CLAIMED = TypeAdapter(dict[int, str] | None)
LOOSE = TypeAdapter(list[Loose] | None)
SHOWN = ("sweeps", "robustness")  # what a page shows, beside the variants
ALL = (*SHOWN, "tightness", "claims")


def measure_cases(
    cases: Iterable[Case], cache: Cache, kinds: Container[str] = SHOWN
) -> tuple[dict[str, Files], list[Problem]]:
    """The file EVIDENCE of every case that can be run, by slug, and the problems of the others.

    A case has neither on a machine that lacks what its runs need. Beside the variants, what is of `kinds` is run.
    """
    cases = sorted(cases, key=lambda case: case.record.run is not None)  # what takes long goes first, not last
    first, problems = run_tasks([evidence_task(case) for case in cases], cache)
    cases = [case for case in cases if EVIDENCE in first.get(case.slug, {})]
    measuring = [task for case in cases for task in measuring_tasks(case, kinds)]
    if "claims" in kinds:
        measuring += [claims_task(case, first[case.slug]) for case in cases if case.claims]
    rest, more = run_tasks(sorted(measuring, key=lambda task: task.kind), cache)
    failed = {task.slug for task in measuring} - rest.keys()
    sound = [case for case in cases if case.slug not in failed]
    return {c.slug: whole_evidence(c, first[c.slug], rest.get(c.slug, {})) for c in sound}, problems + more


def measure_case(case: Case, cache: Cache, kinds: Container[str] = SHOWN) -> Evidence:
    """What the runs of one case show; of those beside its variants, the kinds asked for.

    Raises:
        CaseError: If the case cannot be run, on this machine or on any.
    """
    return evidence_of(only_case(case, *measure_cases([case], cache, kinds)))


def only_case(case: Case, made: Mapping[str, Files], problems: Iterable[Problem]) -> Files:
    """The files of the only case asked for.

    Raises:
        CaseError: If there are none, with the problems or with what this machine lacks.
    """
    if case.slug not in made:
        raise CaseError([*problems] or [missing for missing in [missing_requirement(case)] if missing])
    return made[case.slug]


def evidence_of(files: Files) -> Evidence:
    """The evidence among a case's files."""
    return Evidence.model_validate_json(files[EVIDENCE])


def evidence_task(case: Case) -> Task:
    """The task that runs every variant and the snippet."""
    return case_task(case, "evidence", partial(_json_file, EVIDENCE, collect, case))


def measuring_tasks(case: Case, kinds: Container[str] = SHOWN) -> Iterator[Task]:
    """Tasks that run what needs the variants to be sound: sweeps, other starts, and numbers halved and doubled."""
    for name in case.record.sweep if "sweeps" in kinds else ():
        yield case_task(case, "sweeps", partial(_json_file, f"sweep-{name}.json", measure_sweep, case, name), name)
    if case.record.run is not None and "robustness" in kinds:
        yield case_task(case, "robustness", partial(_json_file, "robustness.json", robustness, case))
    if case.record.loose is not None and "tightness" in kinds:
        asked = numbers(case)
        make = partial(_json_file, "loose.json", loose_numbers, case, asked)
        yield case_task(case, "tightness", make, [number.model_dump() for number in asked])


def claims_task(case: Case, first: Files) -> Task:
    """The task that runs the code of a case's claims, with what `evidence_task` made."""
    assert case.claims is not None
    codes = [claim.python for claim in case.claims.claims]
    return case_task(case, "claims", partial(_json_file, "claims.json", unshown, case, evidence_of(first)), codes)


def whole_evidence(case: Case, first: Files, rest: Files) -> Files:
    """The file EVIDENCE, whole, from the files of `evidence_task` and those of `measuring_tasks`."""
    files = {name: f"sweep-{name}.json" for name in case.record.sweep}
    sweeps = {key: SweepEvidence.model_validate_json(rest[name]) for key, name in files.items() if name in rest}
    robust = ROBUST.validate_json(rest.get("robustness.json", "{}"))
    loose = LOOSE.validate_json(rest.get("loose.json", "null"))
    wrong = CLAIMED.validate_json(rest.get("claims.json", "null"))
    made = {"sweep": sweeps, "robustness": robust, "releases": on_releases(case), "loose": loose, "claims": wrong}
    whole = evidence_of(first).model_copy(update=made)
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


def differential(family: str, cases: Iterable[Case], cache: Cache) -> tuple[Differential, list[Problem]]:
    """What tells the causes of a family apart, and where it does not.

    Cases whose models cannot be compiled, or whose measurement does not run, are left out.
    """
    own = [case for case in members(family, cases) if _compiles(case)]
    try:
        made = _answers(family, own, cache)
    except ScriptError:
        problems: list[Problem] = []
        sound = []
        for case in own:
            try:
                _answers(family, [case], cache)
                sound.append(case)
            except ScriptError as error:
                wanted = "an expression that runs on every model of the family"
                problems.append(
                    case.problem(("telling", "expr"), error.found, wanted, "correct it, or the family's probe")
                )
        if len(sound) == len(own):
            raise
        told, more = differential(family, sound, cache)
        return told, problems + more
    return made, list(procedure_problems(own, made.answers))


def _answers(family: str, cases: list[Case], cache: Cache) -> Differential:
    code, models = procedure(family, cases), asked(cases)
    if not models:
        return Differential(code="", answers={})
    make = partial(_json_file, "answers.json", run_procedure, code, models)
    files = cache.remember(key_of("family", code, models, of="proof"), make)
    return Differential(code=code, answers=ANSWERS.validate_json(files["answers.json"]))


def _compiles(case: Case) -> bool:
    try:
        check_against_model(case)
    except CaseError:
        return False
    return True


def _json_file(name: str, make: Callable[..., object], *of: object) -> Files:
    return {name: to_json(make(*of))}
