"""The pages of cases that are in error or could not be measured."""

from __future__ import annotations

import json
from collections.abc import Iterable
from html import escape
from pathlib import PurePosixPath
from textwrap import indent

from clinic.pages.text.markup import fence, line
from clinic.record.problem import Problem


def by_case(problems: Iterable[Problem]) -> dict[str, list[Problem]]:
    """The problems of each case, by slug; those of other files are under ``""``."""
    made: dict[str, list[Problem]] = {}
    for problem in problems:
        parts = PurePosixPath(problem.file).parts
        slug = parts[1] if len(parts) > 1 and parts[0] == "cases" else ""
        made.setdefault(slug, []).append(problem)
    return made


def notice(problems: Iterable[Problem]) -> str:
    """The problems as an admonition, to the letter of the terminal's message."""
    texts = [indent(fence(str(problem)), "    ") for problem in sorted(set(problems))]
    return "\n\n".join(['!!! failure "In error: the strict build refuses this page until it is mended"', *texts, ""])


def error_page(title: str, problems: Iterable[Problem]) -> str:
    """The page that takes the place of one that cannot be made; its title is text."""
    return plain_page(title, notice(problems))


def unmeasured_page(title: str, lack: Problem | None) -> str:
    """The page of a case that was not measured, for want of something on the machine that built the site."""
    why = f": {line(lack.found)}. Needed is {line(lack.expected)}" if lack else ""
    return plain_page(title, f"The machine that built this page could not measure this case{why}.")


def with_problems(page: str, problems: Iterable[Problem]) -> str:
    """A page with its problems below its heading."""
    heading = next(row for row in page.splitlines() if row.startswith("# "))
    return page.replace(f"{heading}\n", f"{heading}\n\n{notice(problems)}\n", 1)


def plain_page(title: str, text: str) -> str:
    """A page that the search leaves out; its title is text."""
    front = f"---\ntitle: {json.dumps(escape(title, quote=False))}\nsearch:\n  exclude: true\n---"
    return f"{front}\n\n# {line(title)}\n\n{text}\n"
