"""Tags that are closed by another name or not at all: how the text may have been meant."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from dataclasses import dataclass

TOKEN = re.compile(
    r"<!--.*?(?:-->|\Z)|<\?.*?\?>|<!\[CDATA\[.*?\]\]>|<(/?)([A-Za-z_][\w.:-]*)((?:\"[^\"]*\"|'[^']*'|[^'\"<>])*?)(/?)>",
    re.S,
)
SECTIONS = (  # what stands right below `<mujoco>`, and nowhere else
    {"option", "compiler", "statistic", "asset", "worldbody", "actuator", "sensor", "keyframe", "default", "custom"}
)
ALIKE = 0.6  # from which on a name is a misspelt other one
DEEPER = 0.8  # of the elements are indented below their parents, where lines are indented at all


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


def closed(text: str) -> Iterator[tuple[str, str]]:
    """The text with one tag added, dropped or renamed, and what was done, the likeliest first."""
    open_: list[_Tag] = []
    last: _Tag | None = None  # the tag before, where it opened an element
    sure: list[tuple[str, str]] = []  # what the tags themselves tell
    odd: list[tuple[str, str]] = []  # where first the lines are not indented as the tags have it
    pairs = deeper = 0
    for found in TOKEN.finditer(text):
        closing, name, _, empty = found.groups()
        if name is None:
            continue
        tag = _Tag(name, found.start(), found.end(), _margin(text, found.start()))
        if not closing:
            if last and text[last.start : last.end] == found[0] and not empty:
                said = f"<{name}> of line {last.line(text)} is opened twice"
                sure.append((text[: last.end] + text[found.end() :], said))
            outer = open_[-1] if open_ else None
            if outer and outer.indent is not None and tag.indent is not None:
                pairs, deeper = pairs + 1, deeper + (tag.indent > outer.indent)
                if not odd and tag.indent <= outer.indent:
                    odd.append(_close(text, outer, tag.start))
            if outer and len(open_) > 1 and open_[0].name == "mujoco" and name in SECTIONS and outer.name != name:
                sure.append(_close(text, outer, tag.start))
            if not empty:
                open_.append(tag)
            last = None if empty else tag
            continue
        last = None
        if not open_:
            yield _dropped(text, tag)
            return
        outer = open_[-1]
        if outer.name == name:
            open_.pop()
            if not odd and outer.indent is not None and tag.indent is not None and outer.indent != tag.indent:
                if outer.indent > tag.indent:
                    odd.append(_close(text, outer, _after(text, outer, tag.start)))
                else:
                    odd += [*_opened(text, tag), _dropped(text, tag)]
            continue
        yield from sure + odd * (0 < DEEPER * pairs <= deeper)
        yield from _mismatched(text, open_, tag)
        return
    if open_:
        yield from sure + odd * (0 < DEEPER * pairs <= deeper)
        names = [each.name for each in reversed(open_)]
        said = f"<{names[0]}> of line {open_[-1].line(text)} is still open where the text ends"
        said += ", as if the rest of the file were missing" if len(names) > 1 else ""
        yield text.rstrip() + "".join(f"\n</{each}>" for each in names) + "\n", said


def _mismatched(text: str, open_: list[_Tag], tag: _Tag) -> Iterator[tuple[str, str]]:
    """What may be done where a tag closes another element than the innermost."""
    outer, names = open_[-1], [each.name for each in open_]
    renamed = text[: tag.start] + f"</{outer.name}>" + text[tag.end :]
    if tag.name not in names and difflib.SequenceMatcher(None, tag.name, outer.name).ratio() >= ALIKE:
        yield renamed, f"<{outer.name}> of line {outer.line(text)} is closed as </{tag.name}>"
    if tag.name in names:
        yield _close(text, outer, tag.start)
    else:
        yield from _opened(text, tag)
    yield _dropped(text, tag)
    yield renamed, f"<{outer.name}> of line {outer.line(text)} is closed as </{tag.name}>"


def _close(text: str, tag: _Tag, at: int) -> tuple[str, str]:
    """An element closed before a place: in itself, where nothing would be inside."""
    said = f"<{tag.name}> of line {tag.line(text)} is not closed"
    inside = text[tag.end : at]
    if not re.sub(r"<!--.*?-->", "", inside, flags=re.S).strip():
        return text[: tag.end - 1].rstrip() + "/>" + text[tag.end :], said
    here = _margin(text, at)
    if here is None:
        return f"{text[:at]}</{tag.name}>{text[at:]}", said
    begin = at - len(here)
    return f"{text[:begin]}{tag.margin or ''}</{tag.name}>\n{text[begin:]}", said


def _after(text: str, tag: _Tag, before: int) -> int:
    """Where the first tag below an opening one stands that is not indented deeper."""
    for found in TOKEN.finditer(text, tag.end, before):
        below = _Tag(found[2] or "", found.start(), found.end(), _margin(text, found.start()))
        if below.name and below.indent is not None and tag.indent is not None and below.indent <= tag.indent:
            return below.start
    return before


def _opened(text: str, tag: _Tag) -> Iterator[tuple[str, str]]:
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
        yield f"{text[:at]}{tag.margin}<{tag.name}>\n{text[at:]}", said


def _dropped(text: str, tag: _Tag) -> tuple[str, str]:
    """The text without a tag, and without its line where nothing else is there."""
    said = f"</{tag.name}> of line {tag.line(text)} closes nothing"
    if tag.margin is not None and text[tag.end : tag.end + 1] == "\n":
        return text[: tag.start - len(tag.margin)] + text[tag.end + 1 :], said
    return text[: tag.start] + text[tag.end :], said


def _margin(text: str, at: int) -> str | None:
    """The white space before a place in its line; None where something else stands there."""
    before = text[text.rfind("\n", 0, at) + 1 : at]
    return None if before.strip() else before
