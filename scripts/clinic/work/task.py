"""Tasks: work for one case whose result is kept; what is not kept is done in parallel."""

from __future__ import annotations

import logging
import os
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from clinic.engine.render import RenderError
from clinic.record.folder import RECORD
from clinic.record.problem import CaseError, MissingRequirementError, Problem
from clinic.work.cache import Cache, Files
from clinic.work.parallel import parallel

MANY = 10  # tasks: so many take minutes, and it is said how many are done
log = logging.getLogger("mkdocs.clinic")


@dataclass(frozen=True)
class Task:
    """Work for one case: `make` gives files, kept under `key`."""

    slug: str
    kind: str
    key: str
    make: Callable[[], Files]


def run_tasks(tasks: list[Task], cache: Cache) -> tuple[dict[str, Files], list[Problem]]:
    """The files of all tasks by slug, and the problems of the slugs left out.

    What is not kept is run in parallel, and kept as soon as it is made.
    """
    done = {task.key: files for task in tasks if (files := cache.get(task.key)) is not None}
    missing = [task for task in tasks if task.key not in done]
    if len(missing) >= MANY:
        kinds, cases = sorted({task.kind for task in missing}), {task.slug for task in missing}
        log.info("%s of %d cases: of a whole site that takes minutes, once", ", ".join(kinds), len(cases))
    problems: list[Problem] = []
    for count, (key, made) in enumerate(parallel(_attempt, [(task,) for task in missing]), start=1):
        if count % MANY == 0:
            log.info("%d of %d parts are made", count, len(missing))
        if isinstance(made, CaseError):
            problems += made.problems
        elif isinstance(made, MissingRequirementError):
            done[key], cache.incomplete = {}, True
            log_missing_once(str(made))
        else:
            done[key] = made
            cache.put(key, made)
    failed = {task.slug for task in tasks if task.key not in done}
    merged: dict[str, Files] = {}
    for task in tasks:
        if task.slug not in failed:
            merged.setdefault(task.slug, {}).update(done[task.key])
    return merged, problems


@lru_cache
def log_missing_once(reason: str) -> None:
    """Says once what is left out; a warning in CI, where a strict build then fails."""
    log.log(logging.WARNING if os.environ.get("CI") else logging.INFO, reason)


def _attempt(task: Task) -> tuple[str, Files | CaseError | MissingRequirementError]:
    """The task's key, and its files or why there are none."""
    try:
        return task.key, task.make()
    except RenderError as error:
        return task.key, MissingRequirementError(f"no pictures and no films: {error}")
    except (CaseError, MissingRequirementError) as error:
        return task.key, error
    except Exception as error:  # one case, whatever it does to the engine, leaves the others alone
        found = f"{type(error).__name__}: {error}".strip(": ")
        expected = f"{traceback.extract_tb(error.__traceback__)[-1].name} of the {task.kind} to come to an end"
        where = f"cases/{task.slug}/{RECORD}"
        return task.key, CaseError([Problem(where, 1, "", found, expected, "correct what the message names")])
