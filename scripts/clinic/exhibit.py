"""Exhibits: everything a case's page shows that had to be run or drawn, as files.

The work is cut into tasks. A task's result is kept under a key made of all it depends on, so that a change of prose
runs nothing and a change of one case runs that case's tasks alone. Tasks that are not kept run in parallel; what they
alone need is imported by them.
"""

from __future__ import annotations

import logging
import os
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache, partial

import mujoco
from pydantic import TypeAdapter

from clinic import node
from clinic.cache import Cache, Files, key_of
from clinic.case import Case
from clinic.cluster import parallel
from clinic.evidence import Evidence, collect, lack
from clinic.folder import RECORD
from clinic.problem import CaseError, LackError, Problem
from clinic.render import Image, RenderError, image
from clinic.robust import Robustness, robustness
from clinic.simulate import compile_model, state_at
from clinic.sweep import Point, grid, measure_points, summarise
from clinic.variant import Variant, variants

PROSE = {"number", "title", "symptom", "diagnosis", "cause", "fix", "lesson", "no_sweep"}
PROSE |= {"tags", "phrases", "looks", "manual", "see", "alike", "exempt"}
SLICE = 60
MANY = 10
LONG = ("film", "robustness", "sweeps", "pictures")  # kinds of measuring, by the longest task of each
EVIDENCE = "evidence.json"
POINTS = TypeAdapter(list[Point])
ROBUST = TypeAdapter(dict[str, Robustness])
log = logging.getLogger("mkdocs.clinic")


@dataclass(frozen=True)
class Task:
    """Work for one case: `make` gives files, kept under `key`."""

    slug: str
    kind: str
    key: str
    make: Callable[[], Files]


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
    yield _task(case, "pictures", partial(pictures, case))


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


def run_tasks(tasks: list[Task], cache: Cache) -> tuple[dict[str, Files], list[Problem]]:
    """The files of all tasks by slug, and the problems of the slugs left out.

    What is not kept is run in parallel, and kept as soon as it is made.
    """
    done = {task.key: files for task in tasks if (files := cache.get(task.key)) is not None}
    missing = [task for task in tasks if task.key not in done]
    if len(missing) >= MANY:
        log.info("%d cases are run and drawn: of a whole site that takes minutes, once", len({t.slug for t in missing}))
    problems: list[Problem] = []
    unseen: set[str] = set()
    failed: set[str] = set()
    for k, (files, wrong, blind) in parallel(_attempt, list(enumerate(missing))):
        done[missing[k].key] = files
        if wrong:
            problems += wrong
            failed.add(missing[k].slug)
        elif blind:
            unseen.add(blind)
        else:
            cache.put(missing[k].key, files)
    for reason in sorted(unseen):
        say_lack(reason)
    merged: dict[str, Files] = {}
    for task in tasks:
        if task.slug not in failed:
            merged.setdefault(task.slug, {}).update(done[task.key])
    return merged, problems


@lru_cache
def say_lack(reason: str) -> None:
    """Says once what is left out; a warning in CI, where a strict build then fails."""
    log.log(logging.WARNING if os.environ.get("CI") else logging.INFO, reason)


def pictures(case: Case) -> Files:
    """The still images: `broken.webp`, and `fixed.webp` of the first fix where the model is the case's.

    Raises:
        RenderError: If images cannot be drawn on this machine.
    """
    from clinic.film import webp

    if case.record.model is not None:
        broken, fixed, *_ = variants(case)
        return {"broken.webp": webp(still(case, broken)), "fixed.webp": webp(still(case, fixed))}
    return {"broken.webp": webp(scene_image(case))} if case.record.picture.scene is not None else {}


def still(case: Case, variant: Variant) -> Image:
    """A variant at the picture's time, from the picture's camera."""
    record = case.record
    assert record.run is not None
    model = compile_model(variant.text)
    return image(model, state_at(model, record.run, record.picture.time), record.picture.camera)


def scene_image(case: Case) -> Image:
    """A code case's scene, in its first keyframe where it has one."""
    picture = case.record.picture
    assert picture.scene is not None
    model = compile_model(case.texts[picture.scene])
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    return image(model, data, picture.camera)


def _task(case: Case, kind: str, make: Callable[[], Files], *part: object) -> Task:
    experiment = case.record.model_dump(mode="json", exclude=PROSE)
    engine = [node.version(node.MUJOCO), node.release()] if case.record.language == "javascript" else []
    whole = (*part, *engine, case.slug, case.record.number, experiment, case.texts)
    return Task(case.slug, kind, key_of(kind, *whole), make)


def _attempt(k: int, task: Task) -> tuple[int, tuple[Files, tuple[Problem, ...], str]]:
    try:
        return k, (task.make(), (), "")
    except CaseError as error:
        return k, ({}, error.problems, "")
    except RenderError as error:
        return k, ({}, (), f"no pictures and no films: {error}")
    except LackError as error:
        return k, ({}, (), str(error))
    except Exception as error:  # one case, whatever it does to the engine, leaves the others alone
        found = f"{type(error).__name__}: {error}".strip(": ")
        place = f"{traceback.extract_tb(error.__traceback__)[-1].name} of the {task.kind}"
        expected, repair = f"{place} to come to an end", "correct what the message names"
        return k, ({}, (Problem(f"cases/{task.slug}/{RECORD}", 1, "", found, expected, repair),), "")


def _collect(case: Case) -> Files:
    return {EVIDENCE: collect(case).model_dump_json().encode()}


def _slice(case: Case, name: str, k: int) -> Files:
    sweep = case.record.sweep[name]
    return {_points_file(name, k): POINTS.dump_json(measure_points(case, sweep, grid(sweep)[k : k + SLICE]))}


def _film(case: Case) -> Files:
    from clinic.film import film

    return film(case)


def _figure_task(case: Case, evidence: str) -> Task:
    return _task(case, "plots", partial(_figures, case, evidence), evidence)


def _figures(case: Case, evidence: str) -> Files:
    from clinic.plots import figures

    return figures(case, Evidence.model_validate_json(evidence))


def _robustness(case: Case) -> Files:
    return {"robustness.json": ROBUST.dump_json(robustness(case))}


def _points_file(name: str, k: int) -> str:
    return f"sweep-{name}-{k}.json"
