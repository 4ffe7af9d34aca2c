"""Edits of a model's text, applied by place."""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from clinic.diagnosis.source import ATTRIBUTE, HEAD, ORIENTATIONS, Element

Action = Literal["set", "remove", "delete", "insert", "replace"]


@dataclass(frozen=True)
class Edit:
    """One change of the text.

    `set` and `remove` an attribute of an element, `delete` the element, `insert` XML as its last child, or `replace`
    the element by other XML. `attribute` is empty but for the first two; `value` is the new value or the XML.
    """

    file: str
    line: int
    element: str
    action: Action
    attribute: str
    value: str
    start: int
    head_end: int
    end: int

    def told(self) -> str:
        """The change in words."""
        at = f"<{self.element}> of line {self.line}"
        return {
            "set": f'{at}: {self.attribute}="{self.value}"',
            "remove": f"{at}: without {self.attribute}",
            "delete": f"{at}: removed",
            "insert": f"{at}: with {self.value}",
            "replace": f"{at}: {self.value}",
        }[self.action]


def edit(element: Element, action: Action, attribute: str = "", value: str = "") -> Edit:
    """A change of an element."""
    places = (element.start, element.head_end, element.end)
    return Edit(element.file, element.line, element.tag, action, attribute, value, *places)


def set_attribute(element: Element, attribute: str, value: str) -> Edit:
    """Gives an attribute a value, new or not."""
    return edit(element, "set", attribute, value)


def remove_attribute(element: Element, attribute: str) -> Edit:
    """Takes an attribute off."""
    return edit(element, "remove", attribute)


def orient(element: Element, attribute: str, value: str) -> tuple[Edit, ...]:
    """Gives an orientation, `quat`, `euler`, ..., in the place of what is written in another way."""
    others = (each for each in ORIENTATIONS if each in element.attributes and each != attribute)
    return *(remove_attribute(element, each) for each in others), set_attribute(element, attribute, value)


def delete(element: Element) -> Edit:
    """Takes an element out, with all inside."""
    return edit(element, "delete")


def insert(element: Element, xml: str) -> Edit:
    """Adds XML as the last child."""
    return edit(element, "insert", value=xml)


def replace(element: Element, xml: str) -> Edit:
    """Puts XML in the element's place."""
    return edit(element, "replace", value=xml)


def apply(texts: Mapping[str, str], edits: Sequence[Edit]) -> dict[str, str]:
    """The texts after all edits; those of one element are made together, those inside a deleted one are dropped."""
    made = {file: text.encode() for file, text in texts.items()}
    for file in {each.file for each in edits}:
        own = [each for each in edits if each.file == file]
        gone = [each for each in own if each.action in ("delete", "replace")]
        kept = [
            each
            for each in own
            if not any(other.start <= each.start < other.end and other is not each for other in gone)
        ]
        # `insert` of an outer element comes after what lies inside it: from the end of the text to its start
        for each in sorted(_together(kept), key=lambda each: (_place(each), each.start), reverse=True):
            made[file] = _changed(made[file], each)
    return {file: text.decode() for file, text in made.items()}


def _together(edits: Sequence[Edit]) -> list[Edit]:
    """The edits, each once, with those that insert into one element as one: the first makes its end another."""
    inserts: dict[int, list[Edit]] = {}
    for each in dict.fromkeys(edits):
        if each.action == "insert":
            inserts.setdefault(each.start, []).append(each)
    others = [each for each in dict.fromkeys(edits) if each.action != "insert"]
    return others + [
        dataclasses.replace(some[0], value="\n".join(each.value for each in some)) for some in inserts.values()
    ]


def _place(each: Edit) -> int:
    return each.end if each.action == "insert" and each.end != each.head_end else each.start


def _changed(text: bytes, each: Edit) -> bytes:
    start, end = each.start, each.end
    if each.action == "delete":
        return text[: _line_start(text, start)] + text[end:]
    if each.action == "replace":
        return text[:start] + each.value.encode() + text[end:]
    if each.action == "insert":
        return _inserted(text, each)
    # an earlier edit of the same element may have made the head longer
    head = _head(text, start)
    found = next((one for one in ATTRIBUTE.finditer(head) if one["name"] == each.attribute.encode()), None)
    value = each.value.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    new = f' {each.attribute}="{value}"'.encode() if each.action == "set" else b""
    if found:
        changed = head[: found.start()] + new + head[found.end() :]
    else:
        close = 2 if head.endswith(b"/>") else 1
        changed = head[:-close].rstrip() + new + head[-close:]
    return text[:start] + changed + text[start + len(head) :]


def _head(text: bytes, start: int) -> bytes:
    found = HEAD.match(text, start)
    return found.group() if found else text[start : text.find(b">", start) + 1]


def _inserted(text: bytes, each: Edit) -> bytes:
    margin = text[_line_start(text, each.start) : each.start].lstrip(b"\n")
    margin = margin if not margin.strip() else b""
    inner = b"".join(b"\n" + margin + b"  " + line for line in each.value.encode().split(b"\n"))
    if each.head_end == each.end:
        head = _head(text, each.start)
        opened = head[:-2].rstrip() + b">"
        closed = b"\n" + margin + f"</{each.element}>".encode()
        return text[: each.start] + opened + inner + closed + text[each.start + len(head) :]
    close = text.rfind(b"</", each.start, each.end)
    before = text[:close].rstrip()
    return before + inner + b"\n" + margin + text[close:]


def _line_start(text: bytes, start: int) -> int:
    """Where the line's white space before `start` begins, with the line break before it."""
    begin = start
    while begin > 0 and text[begin - 1 : begin] in (b" ", b"\t"):
        begin -= 1
    return begin - 1 if begin > 0 and text[begin - 1 : begin] == b"\n" else start


def diff(before: Mapping[str, str], after: Mapping[str, str]) -> str:
    """The unified diff of the texts."""
    made = ""
    for file, text in before.items():
        lines = difflib.unified_diff(
            text.splitlines(keepends=True), after[file].splitlines(keepends=True), file, file, n=1
        )
        made += "".join(line if line.endswith("\n") else line + "\n" for line in lines)
    return made
