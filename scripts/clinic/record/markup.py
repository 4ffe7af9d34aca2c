"""An author's text as Markdown that shows it and does nothing else: no HTML, no attributes, no address but a plain one.

Python-Markdown is read as its extensions here read it: `<` starts HTML, `{` an attribute list, `](` a link, `]:` the
address of one, and three backticks or tildes a fence. Each is written as a character reference unless it is understood.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from clinic.record.prose import CODE

LANGUAGE = re.compile(r"[a-z]+")
LINK = re.compile(r"!?\[(?P<text>[^\[\]]*)\]\((?P<address>[^()\s]*)\)")
LINKING = re.compile(r"!?\[(?:[^\[\]\n]|\[[^\[\]\n]*\])*\]\([^)\n]*\)?|\]\([^)\n]*\)?")
ADDRESS = re.compile(r"(?:https?://[\w.-]+(?:/[\w./~%+@,-]*)?(?:\?[\w=.&%+-]*)?|(?!//)[\w./-]*)(?:#[\w.%-]*)?")
ACTIVE = re.compile(r"[<{|`]|\][(:\[]")
MARKUP = frozenset("<[]{}|\\`*_&")


def reference(text: str) -> str:
    """Each character of the text that means something to Markdown or HTML as a character reference."""
    return "".join(_entity(c) if c in MARKUP else c for c in text)


def code(text: str) -> str:
    """A span of code that shows the text, on one line; also in a cell of a table."""
    text = " ".join(text.split("\n")).strip()
    return f"<code>{reference(text)}</code>" if ACTIVE.search(text) or text.endswith("\\") else f"`{text}`"


def fence(text: str, language: str = "text") -> str:
    """A block of code that shows the text, whatever fences stand in it."""
    marks = max((len(run) for run in re.findall(r"`+", text)), default=0)
    bars = "`" * max(3, marks + 1)
    return f"{bars}{language}\n{text.rstrip(chr(10))}\n{bars}"


def line(text: str) -> str:
    """A title, a label or a phrase, which is no Markdown but may hold spans of code."""
    return outside_code(re.sub(r"\s*\n\s*", " ", text), lambda part: re.sub(r"[<\[\]{}|\\`]", _referred, part))


def outside_code(text: str, change: Callable[[str], str]) -> str:
    """The text with `change` applied to everything but code, which is written anew as `code` and `fence` do."""
    made, end = [], 0
    for match in CODE.finditer(text):
        made += [change(text[end : match.start()]), _again(match)]
        end = match.end()
    return "".join([*made, change(text[end:])])


def harmless(text: str) -> str:
    """Markdown outside code, without HTML, attributes and strange addresses."""
    made, end = [], 0
    for match in LINK.finditer(text):
        if _plain(match):
            made += [_literal(text[end : match.start()]), re.sub(r"[<{]", _referred, match[0])]
            end = match.end()
    return "".join([*made, _literal(text[end:])])


def strange_links(text: str) -> Iterator[str]:
    """Every link or image of a Markdown text that leads to no plain address."""
    for match in LINKING.finditer(CODE.sub("", text)):
        known = LINK.fullmatch(match[0])
        if known is None or not _plain(known):
            yield match[0]


def _plain(link: re.Match[str]) -> bool:
    """Whether the address is a page of this site or of the web; an image only of this site."""
    address = link["address"]
    return ADDRESS.fullmatch(address) is not None and not (link[0].startswith("!") and "//" in address)


def _literal(text: str) -> str:
    text = re.sub(r"`{3,}|~{3,}", lambda match: f"&#{ord(match[0][0])};" * len(match[0]), text)
    return re.sub(r"[<{]|(?<=\])[(:\[]", _referred, text)


def _again(match: re.Match[str]) -> str:
    if match["span"] is not None:
        return code(match["span"])
    margin, head = match["indent"], LANGUAGE.match(match["head"])
    body = [row if row.startswith(margin) else row.lstrip(" ") for row in match["body"].split("\n")]
    rows = fence("\n".join(row.removeprefix(margin) for row in body), head[0] if head else "").split("\n")
    return "\n".join(margin + row for row in rows)


def _referred(match: re.Match[str]) -> str:
    return _entity(match[0])


def _entity(character: str) -> str:
    return {"<": "&lt;", "&": "&amp;"}.get(character, f"&#{ord(character)};")
