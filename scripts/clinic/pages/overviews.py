"""The pages about all cases, and those written by hand that the build completes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import Path

import mujoco

from clinic.pages.card import home_page
from clinic.pages.cases import Shown
from clinic.pages.error_page import error_page
from clinic.pages.messages import load_messages, messages_page, provoke_messages
from clinic.pages.reference import reference
from clinic.pages.snippets import NAMED, run_fences
from clinic.pages.symptoms import symptoms_page
from clinic.record.case import Case
from clinic.record.problem import CaseError, Problem
from clinic.triage.table import MARK as TRIAGE_MARK
from clinic.triage.table import screening_tasks, table
from clinic.work.cache import Cache, Files
from clinic.work.task import run_tasks

QUIET = "---\nsearch:\n  boost: 0.3\n---\n\n"
REFERENCE_MARK = "Print it with `clinic reference`."


def overviews(
    root: Path, shown: Iterable[Shown], known: Mapping[str, Case], cache: Cache
) -> tuple[Files, list[Problem]]:
    """The files, and the problems of those that cannot be made, which hold these problems instead.

    Args:
        root: The checkout.
        shown: The cases that have a page.
        known: Every case whose record can be read, by slug.
        cache: Where finished work is kept.
    """
    cards = {one.case.slug: one.card for one in shown}
    cases = [one.case for one in shown]
    screenings, problems = run_tasks(list(screening_tasks(cases)), cache)
    made = {f"cases/{slug}/{name}": text for slug, files in screenings.items() for name, text in files.items()}
    made["index.md"] = home_page(cards.values(), mujoco.__version__).encode()
    made["symptoms.md"] = symptoms_page(cases, cards).encode()
    contributing = (root / "CONTRIBUTING.md").read_text(encoding="utf-8")
    made["contributing.md"] = (QUIET + contributing.replace(REFERENCE_MARK, reference())).encode()
    pages: dict[str, tuple[str, Callable[[], str]]] = {
        "messages.md": ("What MuJoCo says", partial(_messages, known, cache)),
        "triage.md": ("Triage", partial(_triage, root, cases, screenings, cache)),
    }
    for path, (title, make) in pages.items():
        try:
            made[path] = make().encode()
        except CaseError as error:
            problems += error.problems
            made[path] = error_page(title, error.problems).encode()
    return made, problems


def _messages(known: Mapping[str, Case], cache: Cache) -> str:
    messages = load_messages()
    return messages_page(messages, provoke_messages(messages, cache), known)


def _triage(root: Path, cases: list[Case], screenings: Mapping[str, Files], cache: Cache) -> str:
    """The page of triage; its code is run if the cases that it names can be."""
    cases = [case for case in cases if case.record.run is None or case.slug in screenings]
    text = (root / "docs" / "triage.md").read_text(encoding="utf-8")
    by_slug = {case.slug: case for case in cases}
    said = text.replace(TRIAGE_MARK, table(cases, screenings))
    named = {slug for slug in NAMED.findall(text) if (root / "cases" / slug).is_dir()}
    return run_fences("docs/triage.md", said, by_slug, cache) if named <= by_slug.keys() else said
