"""Markdown rendered as the site does, and the HTML that comes of it looked through for what acts."""

from __future__ import annotations

import re
from collections import Counter
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import markdown
import yaml

ROOT = Path(__file__).parent.parent
ELEMENTS = re.compile(
    "a|abbr|blockquote|br|button|code|dd|del|details|div|dl|dt|em|figcaption|figure|h1|h2|h3|h4|"
    "h5|h6|hr|img|li|math|mfrac|menclose|mfenced|mi|mn|mo|mover|mpadded|mphantom|mroot|mrow|mspace|"
    "msqrt|mstyle|msub|msubsup|msup|mtable|mtd|mtext|mtr|munder|munderover|ol|p|pre|source|span|"
    "strong|summary|sub|sup|table|tbody|td|th|thead|tr|ul|video"
)
ADDRESSES = ("href", "src", "poster", "action", "formaction", "data", "xlink:href", "srcset")


class Settings(yaml.SafeLoader):
    """Reads mkdocs.yml, whose tags are those of MkDocs."""


Settings.add_multi_constructor("", lambda loader, suffix, node: None)


@cache
def extensions() -> tuple[list[str], dict[str, Any]]:
    """The Markdown extensions of mkdocs.yml, and their options."""
    given = yaml.load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"), Settings)["markdown_extensions"]
    options = {name: what for item in given if isinstance(item, dict) for name, what in item.items()}
    return [item if isinstance(item, str) else next(iter(item)) for item in given], options


def rendered(text: str) -> str:
    """The HTML of a page."""
    names, options = extensions()
    return markdown.Markdown(extensions=names, extension_configs=options).convert(text)


class Elements(HTMLParser):
    """Collects what acts: elements that are not of a page of prose, handlers, styles, addresses of other kinds."""

    def __init__(self) -> None:
        super().__init__()
        self.wrong: str | None = None

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            address = (value or "").replace("\t", "").replace("\n", "").strip().lower()
            strange = ":" in address.split("/")[0] and not address.startswith(("http://", "https://"))
            abroad = tag != "a" and "//" in address
            if name.startswith("on") or (name in ("style", "srcdoc", "http-equiv") and tag != "td"):
                self.wrong = f"<{tag} {name}={value}>"
            if name in ADDRESSES and (strange or abroad):
                self.wrong = f"<{tag} {name}={value}>"
        if not ELEMENTS.fullmatch(tag):
            self.wrong = f"<{tag}>"

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)

    def handle_comment(self, data: str) -> None:
        self.wrong = f"<!--{data}-->"

    def handle_decl(self, decl: str) -> None:
        self.wrong = f"<!{decl}>"

    def handle_pi(self, data: str) -> None:
        self.wrong = f"<?{data}>"

    def unknown_decl(self, data: str) -> None:
        self.wrong = f"<![{data}]>"


def elements(html: str) -> str | None:
    """The last thing of a page that acts, or None."""
    reader = Elements()
    reader.feed(html)
    reader.close()
    return reader.wrong


class Active(HTMLParser):
    """Counts the elements that are not text's, the handlers, and the addresses that are not of pages."""

    def __init__(self) -> None:
        super().__init__()
        self.seen: Counter[str] = Counter()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag in ("script", "style", "iframe", "object", "embed", "form", "base", "link", "svg", "input", "template"):
            self.seen[tag] += 1
        for name, value in attrs:
            if name.startswith("on") or (name in ADDRESSES and "script:" in (value or "").lower()):
                self.seen[f"{tag} {name}"] += 1


def active(html: str) -> Counter[str]:
    """How many of each kind of active thing a whole page holds, its theme's included."""
    reader = Active()
    reader.feed(html)
    reader.close()
    return reader.seen
