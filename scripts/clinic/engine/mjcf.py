"""Checks of a case's model as text, before MuJoCo reads it: it is XML, and names no file that is not in its folder.

So a case's key in the build cache covers all that its model is made of, and the browser can compile it. The release of
MuJoCo that a text needs follows from the attributes and elements that came after 3.3.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

SINCE: dict[str, list[str]] = json.loads(Path(__file__).with_name("since.json").read_text(encoding="utf-8"))
"""`element.attribute`, or an element, by the release whose schema was the first to have it, oldest release first."""
UNKNOWN = re.compile(r"unrecognized (?:attribute: '(?P<attribute>[^']*)'|element)\s+Element '(?P<element>[^']*)'")


class ModelError(ValueError):
    """A model's text that is refused; `line` counts from 1."""

    def __init__(self, line: int, found: str, expected: str, repair: str) -> None:
        self.line, self.found, self.expected, self.repair = line, found, expected, repair
        super().__init__(line, found, expected, repair)

    def __str__(self) -> str:
        return f"line {self.line}: {self.found}; expected {self.expected}"


def check_text(xml: str) -> None:
    """Refuses a text that is not well-formed XML, of which MuJoCo's own parser accepts some, or that names a file.

    Raises:
        ModelError: For the first mistake.
    """
    around: list[str] = []  # the elements that are open

    def check_element(element: str, attributes: dict[str, str]) -> None:
        around.append(f", in the <{element}> of line {parser.CurrentLineNumber}")
        for name, value in attributes.items():
            if name.startswith("file"):
                repair = "write out what it names: elements, `vertex` of a mesh, `builtin` of a texture"
                found = f'<{element} {name}="{value}">'
                raise ModelError(parser.CurrentLineNumber, found, "a model in one file", repair)

    parser = expat.ParserCreate("utf-8")
    parser.StartElementHandler = check_element
    parser.EndElementHandler = lambda _: around.pop()
    try:
        parser.Parse(xml.encode(), True)
    except expat.ExpatError as error:
        found = expat.errors.messages[error.code] + (around[-1] if around else "")
        raise ModelError(error.lineno, found, "well-formed XML", "correct the model") from None


def release_needed(xml: str) -> str:
    """The first release of MuJoCo that reads all elements and attributes of a text, as `4.0`; empty for 3.3."""
    elements = [*ElementTree.fromstring(xml).iter()]
    used = {name for one in elements for name in (one.tag, *(f"{one.tag}.{key}" for key in one.attrib))}
    return next((release for release, names in reversed(SINCE.items()) if used & {*names}), "")


def newer_release(error: str, version: str) -> str:
    """The sentence that says which release knows what `version` of MuJoCo calls unrecognized; empty if none does."""
    if found := UNKNOWN.search(error):
        attribute, element = found["attribute"], found["element"]
        for release, names in SINCE.items():
            if (f"{element}.{attribute}" if attribute else element) in names:
                return f"This is MuJoCo {version}, which does not know `{attribute or element}`; MuJoCo {release} does."
    return ""
