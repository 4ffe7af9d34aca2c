"""A variant: the broken text of a case, or that text after the edits of a fix or a refuted remedy."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from clinic.record.case import Case
from clinic.record.fields import Remedy
from clinic.record.parts import Edit
from clinic.record.problem import CaseError, Problem
from clinic.record.yaml_lines import Where

Kind = Literal["broken", "fix", "refuted"]
BROKEN = "broken"


@dataclass(eq=False)
class EditError(ValueError):
    """An edit whose text does not occur exactly once: which edit of the sequence, and how often its text occurs."""

    index: int
    count: int

    def __str__(self) -> str:
        return f"edit {self.index} matches {self.count} times"


@dataclass(frozen=True)
class Variant:
    """One text of a case to run.

    Args:
        kind: What the variant is meant to show.
        id: `broken`, or the remedy's id.
        title: What the edits do; empty for the broken variant.
        edits: What was applied to the broken text, in order.
        text: The text after the edits.
    """

    kind: Kind
    id: str
    title: str
    edits: tuple[Edit, ...]
    text: str


def apply_edits(text: str, edits: Sequence[Edit]) -> str:
    """Applies the edits in order and gives the text after them.

    Raises:
        EditError: If an edit's text does not occur exactly once.
    """
    for index, edit in enumerate(edits):
        if (count := len(re.findall(f"(?={re.escape(edit.find)})", text))) != 1:  # overlaps included
            raise EditError(index, count)
        text = text.replace(edit.find, edit.replace)
    return text


def variants(case: Case) -> list[Variant]:
    """The broken variant, then every fix, then every refuted remedy.

    Raises:
        CaseError: With every edit that does not match exactly once.
    """
    made = [Variant("broken", BROKEN, "", (), case.text)]
    problems: list[Problem] = []
    for where, kind, remedy in remedies(case):
        try:
            text = apply_edits(case.text, remedy.edits)
            made.append(Variant(kind, remedy.id, remedy.title, tuple(remedy.edits), text))
        except EditError as error:
            problems.append(_edit_problem(case, where, remedy, error))
    if problems:
        raise CaseError(problems)
    return made


def remedies(case: Case) -> Iterator[tuple[Where, Kind, Remedy]]:
    """Every fix, then every refuted remedy, each with its place in the record."""
    for index, fix in enumerate(case.record.fixes):
        yield ("fixes", index), "fix", fix
    for index, refuted in enumerate(case.record.refuted):
        yield ("refuted", index), "refuted", refuted


def place_of(case: Case, variant: str) -> Where:
    """Where the record has a variant's remedy; empty for the broken variant."""
    return next((where for where, _, remedy in remedies(case) if remedy.id == variant), ())


def diff(before: str, after: str, name: str, context: int = 1) -> str:
    """A unified diff without the file header's dates."""
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), name, name, lineterm="", n=context)
    return "\n".join(list(lines)[2:])


def changed_lines(before: str, after: str) -> int:
    """Counts the lines that the diff removes, or those that it adds, whichever are more."""
    lines = diff(before, after, "", 0).splitlines()
    return max(sum(line.startswith(sign) for line in lines) for sign in "-+")


def _edit_problem(case: Case, where: Where, remedy: Remedy, error: EditError) -> Problem:
    name = case.record.source
    occurs = f"occurs {error.count} times" if error.count else "does not occur"
    before = " after the edits before it" if error.index else ""
    repair = f"copy the text from {name}, character by character"
    if error.count:
        repair = "lengthen `find` until it names one place"
    found = f"text that {occurs} in {name}{before}: {remedy.edits[error.index].find!r}"
    return case.problem((*where, "edits", error.index, "find"), found, "text that occurs exactly once", repair)
