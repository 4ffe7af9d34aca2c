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
from clinic.record.problem import CaseError, LackError, Problem
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
        log.info("%d cases are run and drawn: of a whole site that takes minutes, once", len({t.slug for t in missing}))
    problems: list[Problem] = []
    lacks: set[str] = set()
    failed: set[str] = set()
    for count, (k, files, wrong, lack) in enumerate(parallel(_attempt, list(enumerate(missing))), start=1):
        task = missing[k]
        done[task.key] = files
        if count % MANY == 0:
            log.info("%d of %d parts are made", count, len(missing))
        if wrong:
            problems += wrong
            failed.add(task.slug)
        elif lack:
            lacks.add(lack)
        else:
            cache.put(task.key, files)
    for lack in sorted(lacks):
        cache.incomplete = True
        say_lack(lack)
    merged: dict[str, Files] = {}
    for task in tasks:
        if task.slug not in failed:
            merged.setdefault(task.slug, {}).update(done[task.key])
    return merged, problems


@lru_cache
def say_lack(reason: str) -> None:
    """Says once what is left out; a warning in CI, where a strict build then fails."""
    log.log(logging.WARNING if os.environ.get("CI") else logging.INFO, reason)


def _attempt(k: int, task: Task) -> tuple[int, Files, tuple[Problem, ...], str]:
    """The task's index and files, or the problems it has, or what this machine lacks for it."""
    try:
        return k, task.make(), (), ""
    except CaseError as error:
        return k, {}, error.problems, ""
    except RenderError as error:
        return k, {}, (), f"no pictures and no films: {error}"
    except LackError as error:
        return k, {}, (), str(error)
    except Exception as error:  # one case, whatever it does to the engine, leaves the others alone
        found = f"{type(error).__name__}: {error}".strip(": ")
        place = f"{traceback.extract_tb(error.__traceback__)[-1].name} of the {task.kind}"
        expected, repair = f"{place} to come to an end", "correct what the message names"
        return k, {}, (Problem(f"cases/{task.slug}/{RECORD}", 1, "", found, expected, repair),), ""
