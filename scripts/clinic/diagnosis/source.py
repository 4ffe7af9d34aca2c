"""A model's XML with the place of everything in it: files, lines, and which default gives a value."""

from __future__ import annotations

import posixpath
import re
from bisect import bisect_left
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from xml.parsers import expat

from clinic.diagnosis.texts import beside, well_formed

HEAD = re.compile(rb"""<[^\s/>]+(?:\s*[^\s=/>]+\s*=\s*(?:"[^"]*"|'[^']*'))*\s*/?>""")
ATTRIBUTE = re.compile(rb"""\s*(?P<name>[^\s=/>"']+)\s*=\s*(?:"[^"]*"|'[^']*')""")
TRANSPARENT = {"frame"}  # its children belong to the body around it
ORIENTATIONS = ("quat", "euler", "axisangle", "xyaxes", "zaxis")  # attributes, of which an element has one
REPEATING = {"replicate", "composite", "flexcomp", "attach"}  # what they make has no line of its own


class SourceError(ValueError):
    """Text that is not well-formed XML; `line` counts from 1."""

    def __init__(self, file: str, line: int, found: str) -> None:
        self.file, self.line, self.found = file, line, found
        super().__init__(file, line, found)

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.found}"


@dataclass(eq=False)
class Element:
    """An element of the XML: where it stands, and what is written in it. Offsets are in bytes."""

    tag: str
    file: str
    line: int
    attributes: dict[str, str]
    parent: Element | None = None
    children: list[Element] = field(default_factory=list)
    start: int = 0
    head_end: int = 0
    end: int = 0

    @property
    def empty(self) -> bool:
        """Whether it is written as `<tag/>`."""
        return self.head_end == self.end

    def get(self, attribute: str, otherwise: str = "") -> str:
        """What is written for an attribute here."""
        return self.attributes.get(attribute, otherwise)

    def walk(self) -> Iterator[Element]:
        """This element and all inside, in the order of the text."""
        yield self
        for child in self.children:
            yield from child.walk()

    def first(self, tag: str) -> Element | None:
        """The first child of that kind."""
        return next((child for child in self.children if child.tag == tag), None)

    def around(self) -> Iterator[Element]:
        """The elements around it, innermost first."""
        outer = self.parent
        while outer is not None:
            yield outer
            outer = outer.parent


@dataclass(frozen=True, eq=False)
class Comment:
    """A comment: what it says, and the element that follows it, which is None at the end of the one around it."""

    text: str
    file: str
    line: int
    start: int
    following: Element | None


def stem(path: str) -> str:
    """The name of a file without its folders and its ending."""
    return posixpath.splitext(posixpath.basename(path))[0]


def asset_name(element: Element) -> str:
    """An asset's name; that of its file where none is written."""
    return element.get("name") or stem(element.get("file"))


class Source:
    """The texts of a model and their elements.

    Args:
        texts: The texts by file, the main one first; an included one by its path from the model's folder.

    Attributes:
        comments: The comments by file and offset.
        included: The `<include>` that an included file's elements have taken the place of, by file.
    """

    def __init__(self, texts: Mapping[str, str]) -> None:
        self.texts = dict(texts)
        self.comments: dict[tuple[str, int], Comment] = {}
        self.included: dict[str, Element] = {}
        self.main = next(iter(self.texts))
        self.root = self._parsed(self.main)
        self._includes(self.root, 0)
        self.urdf = self.root.tag == "robot"
        self._classes: dict[str, Element] = {}
        for each in self.elements("default"):
            for name in (each.get("class"), *([""] if each.parent is self.root else [])):
                self._classes.setdefault(name, each)

    def elements(self, *tags: str) -> Iterator[Element]:
        """All elements of these kinds, in the order of the text."""
        return (element for element in self.root.walk() if element.tag in tags)

    def section(self, tag: str) -> Iterator[Element]:
        """What stands in the sections of that name: `actuator`, `sensor`, `keyframe`, ..."""
        for outer in self.root.children:
            if outer.tag == tag:
                yield from outer.children

    def bodies(self) -> list[Element]:
        """`<worldbody>` and the bodies, in the order in which MuJoCo numbers them."""
        made: list[Element] = []
        worlds = [child for child in self.root.children if child.tag == "worldbody"]

        def visit(element: Element) -> None:
            for child in element.children:
                if child.tag == "body":
                    made.append(child)
                if child.tag in {"body", *TRANSPARENT}:
                    visit(child)

        for world in worlds:
            visit(world)
        return [*worlds[:1], *made]

    def of_bodies(self, *tags: str) -> list[Element]:
        """Joints, geoms, sites, ... in the order in which MuJoCo numbers them: body by body."""
        worlds = [child for child in self.root.children if child.tag == "worldbody"]
        made: list[Element] = []
        for body in [*worlds, *self.bodies()[1:]]:
            made += self.direct(body, *tags)
        return made

    def direct(self, body: Element, *tags: str) -> list[Element]:
        """What a body has of these kinds, frames seen through."""
        made = []
        for child in body.children:
            if child.tag in tags:
                made.append(child)
            if child.tag in TRANSPARENT:
                made += self.direct(child, *tags)
        return made

    def written(self, element: Element, attribute: str) -> tuple[Element, str] | None:
        """The element that gives a value to an attribute, and the value: itself, or an element of a default class."""
        if attribute in element.attributes:
            return element, element.attributes[attribute]
        for holder in self._defaults(element):
            if attribute in holder.attributes:
                return holder, holder.attributes[attribute]
        return None

    def value(self, element: Element, attribute: str) -> str | None:
        """The value that is written for an attribute, here or in a default class."""
        found = self.written(element, attribute)
        return found[1] if found else None

    def _defaults(self, element: Element) -> Iterator[Element]:
        """The elements of default classes that apply to an element, the nearest first."""
        outer: Element | None = self._class_of(element)
        while outer is not None and outer.tag == "default":
            for child in outer.children:
                if child.tag == element.tag:
                    yield child
            outer = outer.parent

    def _class_of(self, element: Element) -> Element | None:
        name = element.get("class")
        if not name:
            name = next((outer.get("childclass") for outer in element.around() if outer.get("childclass")), "")
        return self._classes.get(name)

    def _parsed(self, file: str) -> Element:
        text = self.texts[file].encode()
        allowed, added = well_formed(text)
        parser = expat.ParserCreate("utf-8")  # whatever the text says of itself, as MuJoCo reads it
        roots: list[Element] = []
        open_: list[Element] = []
        said: list[tuple[str, int, int]] = []

        def place() -> int:
            return parser.CurrentByteIndex - bisect_left(added, parser.CurrentByteIndex)

        def comment(text: str) -> None:
            said.append((text, parser.CurrentLineNumber, place()))

        def keep(following: Element | None) -> None:
            for words, line, at in said:
                self.comments[file, at] = Comment(words, file, line, at, following)
            said.clear()

        def begin(tag: str, attributes: dict[str, str]) -> None:
            start = place()
            head = HEAD.match(text, start)
            end = head.end() if head else text.find(b">", start) + 1
            made = Element(tag, file, parser.CurrentLineNumber, attributes, start=start, head_end=end, end=end)
            if open_:
                made.parent = open_[-1]
                open_[-1].children.append(made)
            else:
                roots.append(made)
            open_.append(made)
            keep(made)

        def finish(tag: str) -> None:
            keep(None)
            made = open_.pop()
            if not text[made.start : made.head_end].endswith(b"/>"):
                made.end = text.find(b">", place()) + 1

        parser.StartElementHandler, parser.EndElementHandler, parser.CommentHandler = begin, finish, comment
        try:
            parser.Parse(allowed, True)
        except expat.ExpatError as error:
            raise SourceError(file, error.lineno, expat.errors.messages[error.code]) from None
        keep(None)
        return roots[0]

    def _includes(self, element: Element, depth: int) -> None:
        made: list[Element] = []
        for child in element.children:
            name = child.get("file")
            if name not in self.texts and child.file != self.main:
                name = beside(child.file, name)
            if child.tag == "include" and name in self.texts and depth < 20:
                self.included.setdefault(name, child)
                root = self._parsed(name)
                self._includes(root, depth + 1)
                for inner in root.children:
                    inner.parent = element
                made += root.children
            else:
                self._includes(child, depth)
                made.append(child)
        element.children = made


def read_source(texts: Mapping[str, str]) -> Source | None:
    """The elements of texts; None where one is not well-formed XML."""
    try:
        return Source(texts)
    except SourceError:
        return None
