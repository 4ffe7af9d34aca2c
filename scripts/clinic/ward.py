"""Cases in error: what is known of them, and their pages; the other cases do without them."""

from __future__ import annotations

import json
import re
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

from clinic.case import RECORD, Case
from clinic.problem import Problem

NUMBER = re.compile(r"^number:\s*(\d+)", re.MULTILINE)
TITLE = re.compile(r"^title:\s*(?P<quote>[\"']?)(?P<title>.+?)(?P=quote)\s*$", re.MULTILINE)
LAST = 10**6


@dataclass(frozen=True)
class Name:
    """What a case is called; `number` is None where the record does not tell."""

    slug: str
    number: int | None
    title: str

    @property
    def heading(self) -> str:
        """`7. A fast ball passes through a shelf`."""
        return self.title if self.number is None else f"{self.number}. {self.title}"


def name_of(case: Case) -> Name:
    """A case's name."""
    return Name(case.slug, case.record.number, case.record.title)


def read_name(folder: Path) -> Name:
    """The name of a case whose record may be unreadable: the folder's where it is."""
    try:
        text = (folder / RECORD).read_text(encoding="utf-8", errors="replace")
    except OSError:
        text = ""
    number, title = NUMBER.search(text), TITLE.search(text)
    return Name(folder.name, int(number[1]) if number else None, title["title"] if title else folder.name)


def ordered(names: Iterable[Name]) -> list[Name]:
    """By number; those without one at the end."""
    return sorted(names, key=lambda name: (LAST if name.number is None else name.number, name.slug))


def by_case(problems: Iterable[Problem]) -> dict[str, list[Problem]]:
    """The problems of each case, by slug; those of other files are under ``""``."""
    made: dict[str, list[Problem]] = {}
    for problem in problems:
        parts = PurePosixPath(problem.file).parts
        slug = parts[1] if len(parts) > 1 and parts[0] == "cases" else ""
        made.setdefault(slug, []).append(problem)
    return made


def without(case: Case, out: Container[str], known: Mapping[str, Case]) -> Case:
    """The case with its relations to those alone that can be shown, its `alike` left out where it is to blame."""
    record = case.record
    see = [slug for slug in record.see if slug in known and slug != case.slug]
    alike = record.alike
    if alike is not None:
        others = [] if case.slug in out else [slug for slug in alike.cases if slug in known and slug not in out]
        alike = alike.model_copy(update={"cases": others}) if others else None
    if see == record.see and alike == record.alike:
        return case
    return replace(case, record=record.model_copy(update={"see": see, "alike": alike}))


def notice(problems: Iterable[Problem]) -> str:
    """The problems as an admonition, to the letter of the terminal's message."""
    return "\n".join(_notice([str(problem) for problem in sorted(set(problems))]))


def error_page(title: str, problems: Iterable[Problem]) -> str:
    """The page that takes the place of one that cannot be made."""
    return f"---\ntitle: {json.dumps(title)}\nsearch:\n  exclude: true\n---\n\n# {title}\n\n{notice(problems)}\n"


def marked(page: str, problems: Iterable[Problem]) -> str:
    """A page with its problems below its heading."""
    heading = next(line for line in page.splitlines() if line.startswith("# "))
    return page.replace(f"{heading}\n", f"{heading}\n\n{notice(problems)}\n", 1)


def _notice(texts: list[str]) -> Iterator[str]:
    yield '!!! failure "In error: the strict build refuses this page until it is mended"'
    for text in texts:
        fence = "`" * (1 + max([2, *map(len, re.findall("`+", text))]))
        yield from ("", *(f"    {line}".rstrip() for line in (f"{fence}text", *text.splitlines(), fence)))
    yield ""
