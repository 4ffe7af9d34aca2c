"""What is wrong with an author's input: where, what was found, what was expected, how to mend it."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from dataclasses import dataclass

LF = "\n"
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]")
"""Characters that no text needs: controls but for tab and line feed, and those that turn the reading direction."""


@dataclass(frozen=True, order=True)
class Problem:
    """One mistake in one file.

    Args:
        file: Path as the author knows it, relative to the project.
        line: Line in `file`, counted from 1.
        where: The field, as a path into the record (`fixes[0].edits[1].find`), or empty.
        found: What stands there.
        expected: What should stand there.
        repair: What to do about it.
    """

    file: str
    line: int
    where: str
    found: str
    expected: str
    repair: str

    def __str__(self) -> str:
        said = {"found: ": self.found, "expected:": self.expected, "repair: ": self.repair}
        rows = [f"{self.file}:{self.line}: {self.where}".rstrip()]
        rows += [f"  {name:9} {text.strip(LF).replace(LF, LF + ' ' * 12)}" for name, text in said.items()]
        return CONTROL.sub("?", LF.join(rows))


class MissingRequirementError(RuntimeError):
    """What this machine lacks, not the author's mistake."""


class CaseError(Exception):
    """All problems of one or more cases, sorted by file and line."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(sorted(set(problems)))
        super().__init__(self.problems)

    def __str__(self) -> str:
        return "\n".join(str(problem) for problem in self.problems)


def problems_by_case(problems: Iterable[Problem]) -> dict[str, list[Problem]]:
    """The problems of each case, by slug; those of other files are under ``""``."""
    made: dict[str, list[Problem]] = {}
    for problem in problems:
        slug = problem.file.split("/")[1] if problem.file.startswith("cases/") else ""
        made.setdefault(slug, []).append(problem)
    return made


def closest(word: str, known: Iterable[str], likeness: float = 0.6) -> str | None:
    """The member of `known` that `word` most likely misspells, or None if none is as like it, from 0 to 1."""
    matches = difflib.get_close_matches(word, list(known), n=1, cutoff=likeness)
    return matches[0] if matches else None


def article(noun: str) -> str:
    """The noun with `a` or `an`."""
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


def listed(names: Iterable[str], limit: int = 8) -> str:
    """`a, b, c`, cut after `limit` names; `none` when there are none."""
    names = list(names)
    shown = ", ".join(names[:limit]) or "none"
    return shown + (f", and {len(names) - limit} more" if len(names) > limit else "")
