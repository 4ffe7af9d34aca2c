"""Cases in error, or not measured: what is known of them, and their pages; the other cases do without them."""

from __future__ import annotations

import json
import re
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path, PurePosixPath

from clinic.pages.text.markup import line
from clinic.record.case import Case
from clinic.record.folder import RECORD, unreadable
from clinic.record.problem import Problem

NUMBER = re.compile(r"^number: *(\d{1,6})\b", re.MULTILINE)
TITLE = re.compile(r"^title:(.+)$", re.MULTILINE)
LONGEST = 90
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
    """The name of a case whose record may be refused: the folder's where it is no plain file, or says nothing."""
    record = folder / RECORD
    text = "" if folder.is_symlink() or unreadable(record) else record.read_text(encoding="utf-8")
    number, title = NUMBER.search(text), TITLE.search(text)
    said = _unquoted(title[1].strip())[:LONGEST] if title else ""
    return Name(folder.name, int(number[1]) if number else None, said or folder.name)


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
    """The page that takes the place of one that cannot be made; its title is text."""
    return _page(title, notice(problems))


def lacking_page(title: str, lack: Problem | None) -> str:
    """The page of a case that was not measured, for want of something on the machine that built the site."""
    why = f": {line(lack.found)}. Needed is {line(lack.expected)}" if lack else ""
    return _page(title, f"The machine that built this page could not measure this case{why}.")


def marked(page: str, problems: Iterable[Problem]) -> str:
    """A page with its problems below its heading."""
    heading = next(row for row in page.splitlines() if row.startswith("# "))
    return page.replace(f"{heading}\n", f"{heading}\n\n{notice(problems)}\n", 1)


def _page(title: str, text: str) -> str:
    front = f"---\ntitle: {json.dumps(escape(title, quote=False))}\nsearch:\n  exclude: true\n---"
    return f"{front}\n\n# {line(title)}\n\n{text}\n"


def _unquoted(text: str) -> str:
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] and text[0] in "\"'" else text


def _notice(texts: list[str]) -> Iterator[str]:
    yield '!!! failure "In error: the strict build refuses this page until it is mended"'
    for text in texts:
        fence = "`" * (1 + max([2, *map(len, re.findall("`+", text))]))
        yield from ("", *(f"    {row}".rstrip() for row in (f"{fence}text", *text.splitlines(), fence)))
    yield ""
