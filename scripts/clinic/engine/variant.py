"""A variant: the broken text of a case, or that text after the edits of a fix or a refuted remedy."""

from __future__ import annotations

import difflib
import re
from collections.abc import Sequence
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


@dataclass(frozen=True)
class Variant:
    """One text of a case to run.

    Args:
        kind: What the variant is meant to show.
        id: `broken`, or the remedy's id.
        title: What the edits do; empty for the broken variant.
        edits: What was applied to the broken text, in order.
        text: The text after the edits.
        where: Where the record has the remedy; empty for the broken variant.
    """

    kind: Kind
    id: str
    title: str
    edits: tuple[Edit, ...]
    text: str
    where: Where = ()


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
    remedies: list[tuple[Where, Kind, Remedy]] = [(("fixes", k), "fix", fix) for k, fix in enumerate(case.record.fixes)]
    remedies += [(("refuted", k), "refuted", refuted) for k, refuted in enumerate(case.record.refuted)]
    for where, kind, remedy in remedies:
        try:
            text = apply_edits(case.text, remedy.edits)
            made.append(Variant(kind, remedy.id, remedy.title, tuple(remedy.edits), text, where))
        except EditError as error:
            before = " after the edits before it" if error.index else ""
            occurs, repair = "does not occur", f"copy the text from {case.record.source}, character by character"
            if error.count:
                occurs, repair = f"occurs {error.count} times", "lengthen `find` until it names one place"
            found = f"text that {occurs} in {case.record.source}{before}: {remedy.edits[error.index].find!r}"
            place = (*where, "edits", error.index, "find")
            problems.append(case.problem(place, found, "text that occurs exactly once", repair))
    if problems:
        raise CaseError(problems)
    return made


def diff(before: str, after: str, name: str, context: int = 1) -> str:
    """A unified diff without the file header's dates."""
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), name, name, lineterm="", n=context)
    return "\n".join(list(lines)[2:])


def changed_lines(before: str, after: str) -> int:
    """Counts the lines that the diff removes, or those that it adds, whichever are more."""
    lines = diff(before, after, "", 0).splitlines()
    return max(sum(line.startswith(sign) for line in lines) for sign in "-+")
