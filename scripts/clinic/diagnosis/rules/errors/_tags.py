"""Tags that are closed by another name or not at all: how the text may have been meant."""

from __future__ import annotations

import difflib
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from clinic.diagnosis.rules.errors import unknown_element

NAME = r"(?:[^\W\d]|:)[\w:.-]*"
VALUE = r"""(?:"[^"<]*(?:<[^"=\s<]*)*"|'[^'<]*(?:<[^'=\s<]*)*')"""
ATTRIBUTES = rf"(?:\s*{NAME}\s*=\s*{VALUE})*"
PIECE = re.compile(  # what XML is made of, as far as MuJoCo reads it
    rf"<!--(?:(?!<!--).)*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|<![A-Z][^<>]*>|(?P<text>[^<>]+)(?=<|\Z)"
    rf"|<(?P<close>/?)\s*(?P<name>{NAME})(?=[\s/>])(?P<attributes>{ATTRIBUTES})\s*(?P<empty>/?)>",
    re.S,
)
SECTIONS = (  # what stands right below `<mujoco>`, and nowhere else
    {"option", "compiler", "statistic", "asset", "worldbody", "actuator", "sensor", "keyframe", "default", "custom"}
)
EMPTY = (  # as a rule
    *("joint", "freejoint", "geom", "site", "camera", "light", "inertial"),
    *("motor", "position", "key", "mesh", "texture", "material"),
)
MOST = 9  # how often a name is used that is known
ROOTS = {"mujoco", "robot"}
KNOWN_TAGS = {
    *ROOTS,
    *" ".join((unknown_element.KNOWN, unknown_element.SECTIONS, *unknown_element.HOME.values())).split(),
}
ALIKE = 0.6  # from which on a name is a misspelt other one
WIDEST = 1000  # characters of white space before a tag
DEEPER = 0.8  # of the elements but one have what is inside indented deeper, where lines are indented at all


class Slip(NamedTuple):
    """What stands between two places of a text, what is meant there, and what is wrong in words, where they help."""

    start: int
    end: int
    meant: str
    said: str = ""

    def mended(self, text: str) -> str:
        return text[: self.start] + self.meant + text[self.end :]


@dataclass(frozen=True)
class _Tag:
    """An opening or closing tag; `margin` is the white space before it, None within a line."""

    name: str
    start: int
    end: int
    margin: str | None

    @property
    def indent(self) -> int | None:
        """How wide the white space before it is, a tab as four."""
        return None if self.margin is None else len(self.margin.expandtabs(4))

    def line(self, text: str) -> int:
        return text[: self.start].count("\n") + 1


def closed(text: str) -> Iterator[Slip]:
    """One tag added, dropped or renamed, the likeliest first."""
    open_: list[_Tag] = []
    last: _Tag | None = None  # the tag before, where it opened an element
    sure: list[Slip] = []  # what the tags themselves tell
    odd: dict[int, tuple[_Tag, _Tag]] = {}  # elements, by place, with a tag that is not indented as inside of them
    deeper: dict[int, bool] = {}  # whether the first line inside of an element is indented deeper
    leaves = _leaves(text)
    for found in PIECE.finditer(text):
        closing, name, empty = found["close"], found["name"], found["empty"]
        if name is None:
            continue
        tag = _Tag(name, found.start(), found.end(), _margin(text, found.start()))
        if not closing:
            outer = open_[-1] if open_ else None
            if last and text[last.start : last.end] == found[0] and not empty:
                sure.append(Slip(last.end, found.end(), "", f"<{name}> of line {last.line(text)} is opened twice"))
            elif outer and outer.name == name and not found["attributes"] and tag.indent in (None, outer.indent):
                said = f"<{name}> of line {outer.line(text)} is closed as {found[0]}"
                sure.append(Slip(tag.start, tag.end, f"</{name}>", said))
            if outer and outer.indent is not None and tag.indent is not None:
                deeper.setdefault(outer.start, tag.indent > outer.indent)
                if tag.indent <= outer.indent:
                    odd.setdefault(outer.start, (outer, tag))
            if outer and outer.name in leaves:
                sure.append(_close(text, outer, outer.end))
            if outer and len(open_) > 1 and open_[0].name == "mujoco" and name in SECTIONS and outer.name != name:
                sure.append(_close(text, outer, tag.start))
            if not empty:
                open_.append(tag)
            last = None if empty else tag
            continue
        last = None
        if not open_:
            yield from _rooted(text, tag)
            yield _dropped(text, tag)
            return
        outer = open_[-1]
        if outer.name == name:
            open_.pop()
            if outer.indent is not None and tag.indent is not None and outer.indent != tag.indent:
                odd.setdefault(outer.start, (outer, tag))
            continue
        yield from sure
        yield from _indented(text, odd, deeper, open_)
        yield from _mismatched(text, open_, tag)
        return
    if open_:
        yield from sure
        yield from _indented(text, odd, deeper, open_)
        names = [each.name for each in reversed(open_)]
        said = f"<{names[0]}> of line {open_[-1].line(text)} is still open where the text ends"
        said += ", as if the rest of the file were missing" if len(names) > 1 else ""
        yield Slip(len(text.rstrip()), len(text), "".join(f"\n</{each}>" for each in names) + "\n", said)


def _rooted(text: str, tag: _Tag) -> Iterator[Slip]:
    """The root opened before all else, where a closing tag is all that is left of it."""
    if tag.name in ROOTS and not re.search(rf"<{tag.name}\b", text):
        begin = text.index("<", text.find("?>") + 1)
        begin -= len(_margin(text, begin) or "")
        yield Slip(begin, begin, f"<{tag.name}>\n", f"</{tag.name}> of line {tag.line(text)} is not opened")


def _indented(
    text: str, odd: dict[int, tuple[_Tag, _Tag]], deeper: dict[int, bool], open_: list[_Tag]
) -> Iterator[Slip]:
    """What the lines' indents tell: of the innermost element that is open, and of the first that is not as its tags."""
    if not 0 < DEEPER * (len(deeper) - 1) <= sum(deeper.values()):
        return
    for outer, tag in [odd[each] for each in (open_[-1].start, *list(odd)[:1]) if each in odd]:
        assert outer.indent is not None
        assert tag.indent is not None
        if text[tag.start + 1] != "/":
            yield _close(text, outer, tag.start)
        elif outer.indent > tag.indent:
            yield _close(text, outer, _after(text, outer, tag.start))
        else:
            yield from (*_opened(text, tag), _dropped(text, tag))


def _leaves(text: str) -> set[str]:
    """The elements that have nothing inside, as far as most of them tell."""
    alone, opened = Counter(EMPTY if "<robot" not in text else ()), Counter[str]()
    for found in PIECE.finditer(text):
        if found["name"] and not found["close"]:
            (alone if found["empty"] else opened)[found["name"]] += bool(found["attributes"] or not found["empty"])
    return {name for name, count in alone.items() if count >= opened[name]}


def _mismatched(text: str, open_: list[_Tag], tag: _Tag) -> Iterator[Slip]:
    """What may be done where a tag closes another element than the innermost."""
    outer, names = open_[-1], [each.name for each in open_]
    said = f"<{outer.name}> of line {outer.line(text)} is closed as </{tag.name}>"
    renamed = Slip(tag.start, tag.end, f"</{outer.name}>", said)
    alike = difflib.SequenceMatcher(None, tag.name, outer.name).ratio() >= ALIKE
    uses = [len(re.findall(rf"<{name}\b", text)) + MOST * (name in KNOWN_TAGS) for name in (outer.name, tag.name)]
    if alike and uses[0] < uses[1]:
        yield Slip(outer.start + 1, outer.start + 1 + len(outer.name), tag.name, said)
    if tag.name not in names and alike:
        yield renamed
    if tag.name in names:
        yield _close(text, outer, tag.start)
    else:
        yield from _opened(text, tag)
    yield _dropped(text, tag)
    yield renamed


def _close(text: str, tag: _Tag, at: int) -> Slip:
    """An element closed before a place: in itself, where nothing would be inside."""
    said = f"<{tag.name}> of line {tag.line(text)} is not closed"
    inside = text[tag.end : at]
    if not re.sub(r"<!--.*?-->", "", inside, flags=re.S).strip():
        if text.endswith('/">', 0, tag.end):
            return Slip(tag.end - 3, tag.end, '"/>', said)
        return Slip(len(text[: tag.end - 1].rstrip()), tag.end, "/>", said)
    here = _margin(text, at)
    if here is None:
        return Slip(at, at, f"</{tag.name}>", said)
    begin = at - len(here)
    return Slip(begin, begin, f"{tag.margin or ''}</{tag.name}>\n", said)


def _after(text: str, tag: _Tag, before: int) -> int:
    """Where the first tag below an opening one stands that is not indented deeper."""
    for found in PIECE.finditer(text, tag.end, before):
        below = _Tag(found["name"] or "", found.start(), found.end(), _margin(text, found.start()))
        if below.name and below.indent is not None and tag.indent is not None and below.indent <= tag.indent:
            return below.start
    return before


def _opened(text: str, tag: _Tag) -> Iterator[Slip]:
    """The element of a closing tag opened above the lines that are indented deeper, where it takes no attributes."""
    bare = len(re.findall(rf"<{tag.name}\s*>", text))
    if tag.margin is None or not bare or 2 * bare <= len(re.findall(rf"<{tag.name}[\s/>]", text)):
        return
    begin = at = tag.start - len(tag.margin)
    while begin > 0:
        begin = text.rfind("\n", 0, begin - 1) + 1
        first = re.compile(r"\s*").match(text, begin)
        line = _margin(text, first.end()) if first else None
        if line is None or len(line.expandtabs(4)) <= (tag.indent or 0):
            break
        at = begin
    if at < tag.start - len(tag.margin):
        said = f"</{tag.name}> of line {tag.line(text)} is not opened"
        yield Slip(at, at, f"{tag.margin}<{tag.name}>\n", said)


def _dropped(text: str, tag: _Tag) -> Slip:
    """The text without a tag, and without its line where nothing else is there."""
    said = f"</{tag.name}> of line {tag.line(text)} closes nothing"
    if tag.margin is not None and text[tag.end : tag.end + 1] == "\n":
        return Slip(tag.start - len(tag.margin), tag.end + 1, "", said)
    return Slip(tag.start, tag.end, "", said)


def _margin(text: str, at: int) -> str | None:
    """The white space before a place in its line; None where something else stands there."""
    begin = max(at - WIDEST, 0)
    before = text[begin:at].rpartition("\n")
    return None if before[2].strip() or (begin and not before[1]) else before[2]
