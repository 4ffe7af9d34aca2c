"""Markdown rendered as the site does, and the HTML that comes of it looked through for what acts."""

from __future__ import annotations

import re
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import markdown
import yaml

ROOT = Path(__file__).parent.parent
ADDRESSES = ("href", "src", "poster", "action", "formaction", "data", "xlink:href", "srcset")
SCHEME = re.compile(r"[a-z][a-z0-9+.-]*:")
ACTING = "script style iframe object embed form base link svg input template textarea foreignobject"


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
    """The HTML of a page's Markdown, without its front matter."""
    names, options = extensions()
    body = text.split("\n---\n", 1)[1] if text.startswith("---\n") else text
    return markdown.Markdown(extensions=names, extension_configs=options).convert(body)


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag in ACTING.split():
            self.found.append(f"<{tag} {attrs}>")
        for name, value in attrs:
            address = "".join((value or "").split()).lower()
            scheme = SCHEME.match(address) and not address.startswith(("http://", "https://"))
            abroad = tag != "a" and "//" in address
            styled = name in ("style", "srcdoc") and not address.startswith("text-align:")
            if name.startswith("on") or name == "http-equiv" or styled or (name in ADDRESSES and (scheme or abroad)):
                self.found.append(f"<{tag} {name}={value}>")

    def handle_data(self, data: str) -> None:
        if self.lasttag in ("script", "style") and self.cdata_elem:
            self.found.append(data)


def acting(html: str) -> list[str]:
    """What acts in HTML: elements, handlers, styles and addresses that no text needs."""
    reader = _Reader()
    reader.feed(html)
    reader.close()
    return reader.found
