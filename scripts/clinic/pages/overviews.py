"""The pages about all cases, and those written by hand that the build completes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

from clinic.diagnosis.bench.lock import read_lock
from clinic.pages.about import about_pages
from clinic.pages.cases import CasePage, Differentials
from clinic.pages.code_fences import NAMED, run_fences
from clinic.pages.error_page import error_page
from clinic.pages.home import home
from clinic.pages.messages import load_messages, messages_page, provoke_messages, read_heard
from clinic.pages.reference import reference
from clinic.pages.rules import rule_pages
from clinic.pages.search_index import search_files
from clinic.pages.storeys import storeys
from clinic.pages.symptoms import symptom_pages
from clinic.pages.text.addresses import MARK as REPOSITORY_MARK
from clinic.pages.text.addresses import repository
from clinic.record.case import Case
from clinic.record.families import families
from clinic.record.problem import CaseError, Problem
from clinic.triage.table import MARK as TRIAGE_MARK
from clinic.triage.table import screening_tasks, table
from clinic.work.cache import STOREYS, Cache, Files
from clinic.work.task import run_tasks

REFERENCE_MARK = "This part is made from the fields' own descriptions; `clinic reference` prints it."
STOREYS_MARK = "The picture is made by the build."


def overviews(
    root: Path, shown: Sequence[CasePage], told: Differentials, known: Mapping[str, Case], cache: Cache
) -> tuple[Files, list[Problem]]:
    """The files, and the problems of those that cannot be made, which hold these problems instead.

    Args:
        root: The checkout.
        shown: The cases that have a page.
        told: What tells the causes of each family apart.
        known: Every case whose record can be read, by slug.
        cache: Where finished work is kept.
    """
    cases = [one.case for one in shown]
    screenings, problems = run_tasks(list(screening_tasks(cases)), cache)
    made = {f"cases/{slug}/{name}": text for slug, files in screenings.items() for name, text in files.items()}
    made["index.md"] = home(shown).encode()
    made |= rule_pages(known, cache, read_lock(root))
    made |= symptom_pages(shown, told)
    made |= about_pages(cases[0].slug if cases else "")
    screened = [case for case in cases if case.record.run is None or case.slug in screenings]
    parts = {
        TRIAGE_MARK: lambda: table(screened, screenings),
        REFERENCE_MARK: reference,
        STOREYS_MARK: lambda: storeys("clinic", STOREYS),
        REPOSITORY_MARK: lambda: repository() or REPOSITORY_MARK,
    }
    pages: dict[str, tuple[str, Callable[[], str]]] = {
        "messages.md": ("What MuJoCo says", partial(_messages, root, known, cache)),
    }
    for page in sorted((root / "docs").rglob("*.md")):
        name, text = page.relative_to(root / "docs").as_posix(), page.read_text(encoding="utf-8")
        title = next((line[2:] for line in text.splitlines() if line.startswith("# ")), name)
        pages[name] = title, partial(_completed, root, f"docs/{name}", text, parts, screened, cache)
    for path, (title, make) in pages.items():
        try:
            made[path] = make().encode()
        except CaseError as error:
            problems += error.problems
            made[path] = error_page(title, error.problems).encode()
    said = load_messages() if not problems else []
    return made | search_files(shown, families(), said, made), problems


def _messages(root: Path, known: Mapping[str, Case], cache: Cache) -> str:
    messages = load_messages()
    heard = read_heard(root, messages)
    return messages_page(messages, provoke_messages(messages, cache), known, heard)


def _completed(
    root: Path, file: str, text: str, parts: Mapping[str, Callable[[], str]], cases: list[Case], cache: Cache
) -> str:
    """A page written by hand with the parts that the build makes; its code is run if the cases that it names can be."""
    by_slug = {case.slug: case for case in cases}
    named = {slug for slug in NAMED.findall(text) if (root / "cases" / slug).is_dir()}
    made = run_fences(file, text, by_slug, cache) if named <= by_slug.keys() else text
    for mark, make in parts.items():
        made = made.replace(mark, make()) if mark in made else made
    return made
