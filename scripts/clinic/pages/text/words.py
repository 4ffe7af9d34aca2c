"""The words that a newcomer misses, and an extension of Python-Markdown that explains the first of each on a page."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element

from markdown import Markdown
from markdown.extensions import Extension
from markdown.treeprocessors import Treeprocessor
from markdown.util import AtomicString

FILE = Path(__file__).with_suffix(".toml")
LEFT = {"a", "abbr", "h1", "h2", "h3", "h4", "h5", "h6", "math", "pre", "summary"}  # elements that stay as they are


class Word(NamedTuple):
    """A word: its forms, what it means, where MuJoCo's manual has more, and whether it counts in code alone."""

    forms: tuple[str, ...]
    says: str
    manual: str
    code: bool


@cache
def words() -> dict[str, Word]:
    """All words, in the order of the file."""
    read = tomllib.loads(FILE.read_text(encoding="utf-8"))
    return {
        key: Word((key, *each.get("also", ())), each["says"], each["manual"], "code" in each)
        for key, each in read.items()
    }


class _Explain(Treeprocessor):  # type: ignore[misc]
    def run(self, root: Element) -> None:
        self.left = {form: word for word in words().values() for form in word.forms}
        self._element(root)

    def _element(self, element: Element) -> None:
        if element.tag == "code":
            if word := self._take((element.text or "").strip()):
                element.set("title", word.says)
                element.set("class", "word")
        elif element.tag not in LEFT:
            self._text(element, 0, element.text, None)
            for child in list(element):
                self._element(child)
                self._text(element, list(element).index(child) + 1, child.tail, child)

    def _text(self, parent: Element, at: int, text: str | None, before: Element | None) -> None:
        """Explains the first word of a text that stands in `parent` after `before`, and goes on behind it."""
        forms = [re.escape(form) for form, word in self.left.items() if not word.code]
        if not text or not forms or isinstance(text, AtomicString):
            return
        found = re.search(rf"(?<![\w-])(?:{'|'.join(forms)})(?![\w-])", text)
        if not found or not (word := self._take(found[0])):
            return
        made = Element("abbr", {"title": word.says})
        made.text, made.tail = AtomicString(found[0]), text[found.end() :]
        if before is None:
            parent.text = text[: found.start()]
        else:
            before.tail = text[: found.start()]
        parent.insert(at, made)
        self._text(parent, at + 1, made.tail, made)

    def _take(self, form: str) -> Word | None:
        """The word of which this is a form, which is explained once."""
        word = self.left.get(form)
        for each in word.forms if word else ():
            del self.left[each]
        return word


class Explain(Extension):  # type: ignore[misc]
    """The extension: it comes after code, links and attributes have been found."""

    def extendMarkdown(self, md: Markdown) -> None:  # noqa: D102, N802
        md.treeprocessors.register(_Explain(md), "words", 1)
