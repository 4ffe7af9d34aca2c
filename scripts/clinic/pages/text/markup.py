"""Text as Markdown that shows it to the letter."""

from __future__ import annotations

import re

MARKDOWN = "[]{}|\\`*_"


def escaped(text: str, characters: str = MARKDOWN) -> str:
    """The text with each of these characters written as a character reference."""
    return "".join(f"&#{ord(c)};" if c in characters else c for c in text)


def line(text: str) -> str:
    """A title, a label or a phrase: plain text, on one line."""
    return escaped(" ".join(text.strip().split("\n")), MARKDOWN + "<&")


def code(text: str) -> str:
    """A span of code, on one line; also in a cell of a table."""
    return f"<code>{line(text)}</code>"


def fence(text: str, language: str = "text") -> str:
    """A block of code, whatever fences stand in it."""
    bars = "`" * (1 + max([2, *map(len, re.findall("`+", text))]))
    return f"{bars}{language}\n{text.rstrip(chr(10))}\n{bars}"
