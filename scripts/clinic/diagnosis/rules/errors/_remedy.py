"""What to do about a message of MuJoCo, as a row of a table."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from clinic.diagnosis.edit import Edit, delete, remove_attribute, set_attribute
from clinic.diagnosis.probes.compiled import COMPILES
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence, told
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

MINUS = re.compile(r"(?<!\w)-")


class Remedy(NamedTuple):
    """A row: what the message says, as a pattern; what to do, in a sentence; and edits, one after the other to try.

    An edit is `name=value`, `-name`, which takes the attribute off, `name<`, which puts its numbers in order, `name+`,
    which takes off their signs, or `delete`, which takes the element out; several go together with `;`. In front of
    `/` stands the tag of an element inside. `{0}`, `{1}` are the pattern's groups.
    """

    said: str
    says: str
    tries: tuple[str, ...] = ()


def remedied(model: ReaderModel, table: Iterable[Remedy]) -> Iterator[Suspect]:
    """What the table says to the model's message; a hint where no edit is possible."""
    said = sentence(model)
    for row in table:
        if found := re.search(row.said, said):
            groups = [each or "" for each in found.groups()]
            elements = meant(model)
            for element in elements or (None,):
                yield from _row(model, row, groups, element)
            return


def _row(model: ReaderModel, row: Remedy, groups: list[str], element: Element | None) -> Iterator[Suspect]:
    says = f"{sentence(model).rstrip('.')}. {row.says.format(*groups)}"
    made = [] if element is None else [_edits(element, each.format(*groups)) for each in row.tries]
    for edits in filter(None, made):
        assert element is not None
        first = edits[0]
        owner = next(each for each in element.walk() if each.start == first.start and each.file == first.file)
        value = {"set": first.value, "remove": "left out"}.get(first.action, "removed")
        now = owner.get(first.attribute) if first.attribute else ""
        yield mends(owner, edits, says, attribute=first.attribute, now=now, value=value)
    if not any(made):
        yield advised(element, says)


def advised(element: Element | None, says: str, attribute: str = "") -> Suspect:
    """A hint: what to do, and where."""
    now = element.get(attribute) if element and attribute else ""
    return Suspect(
        (told(element),) if element else (), attribute, now, "", (), COMPILES, 0.0, says, level="hint", at=element
    )


def _edits(element: Element, plan: str) -> tuple[Edit, ...]:
    """The edits of a row's plan; none where one of them would change nothing."""
    made = []
    for step in plan.split(";"):
        inner, _, change = step.strip().rpartition("/") if "/" in step else ("", "", step.strip())
        for each in [one for one in element.walk() if one.tag == inner] if inner else [element]:
            if (one := _edit(each, change)) is not None:
                made.append(one)
    return tuple(made)


def _edit(element: Element, change: str) -> Edit | None:
    if change == "delete":
        return delete(element)
    name, equals, value = change.partition("=")
    if equals:
        return set_attribute(element, name, value) if element.get(name) != value else None
    if change.startswith("-"):
        return remove_attribute(element, change[1:]) if change[1:] in element.attributes else None
    name, now = change[:-1], element.get(change[:-1])
    if not now:
        return None
    value = MINUS.sub("", now) if change.endswith("+") else " ".join(sorted(now.split(), key=float))
    return set_attribute(element, name, value) if value != now else None
