"""The pages of cases that are in error or could not be measured."""

from __future__ import annotations

import json
from collections.abc import Iterable
from html import escape
from textwrap import indent

from clinic.pages.text.markup import fence, line
from clinic.record.problem import Problem


def notice(problems: Iterable[Problem]) -> str:
    """The problems as an admonition, to the letter of the terminal's message."""
    texts = [indent(fence(str(problem)), "    ") for problem in sorted(set(problems))]
    return "\n\n".join(['!!! failure "In error: the strict build refuses this page until it is mended"', *texts, ""])


def error_page(title: str, problems: Iterable[Problem]) -> str:
    """The page that takes the place of one that cannot be made; its title is text."""
    return plain_page(title, notice(problems))


def unmeasured_page(title: str, missing: Problem | None) -> str:
    """The page of a case that was not measured, for want of something on the machine that built the site."""
    why = f": {line(missing.found)}. Needed is {line(missing.expected)}" if missing else ""
    return plain_page(title, f"The machine that built this page could not measure this case{why}.")


def with_problems(page: str, problems: Iterable[Problem]) -> str:
    """A page with its problems below its heading."""
    heading = next(row for row in page.splitlines() if row.startswith("# "))
    return page.replace(f"{heading}\n", f"{heading}\n\n{notice(problems)}\n", 1)


def plain_page(title: str, text: str) -> str:
    """A page that the search leaves out; its title is text."""
    front = f"---\ntitle: {json.dumps(escape(title, quote=False))}\nsearch:\n  exclude: true\n---"
    return f"{front}\n\n# {line(title)}\n\n{text}\n"
