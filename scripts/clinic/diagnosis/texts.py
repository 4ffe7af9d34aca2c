"""A model's texts before they are read as XML: their bytes, what they include, and what MuJoCo lets pass."""

from __future__ import annotations

import codecs
import posixpath
import re
from collections.abc import Callable
from difflib import SequenceMatcher
from pathlib import Path

PART = re.compile(
    rb"""<!--(?P<comment>.*?)(?P<end>-->|\Z)|(?P<head><[^\s!?/>](?:"[^"]*"|'[^']*'|[^"'<>])*>)""", re.DOTALL
)
VALUE = re.compile(rb"""=\s*(?P<value>"[^"]*"|'[^']*')(?P<near>(?=[^\s/>]))?""")
DASH = re.compile(rb"-(?=-)")
BARE = re.compile(rb"<|&(?!(?:amp|lt|gt|quot|apos|#\d+|#x[0-9A-Fa-f]+);)")
CONTROL = bytes.maketrans(bytes(range(1, 32)), bytes(each if each in b"\t\n\r" else 63 for each in range(1, 32)))
END = re.compile(r"\r\n?|\n")
FRONT = re.compile(rb"(?:\xef\xbb\xbf)?[^<]*(?:<\?xml.*?\?>)?", re.DOTALL)


def well_formed(text: bytes) -> tuple[bytes, list[int]]:
    """A text without what MuJoCo's parser lets pass and XML does not, and where bytes were added.

    `--` in a comment, attributes without a blank between, a bare `&` or `<` in a value, a control character, something
    before the declaration. All else stays where it is.
    """
    made, added, seen = bytearray(), list[int](), 0
    text = text.translate(CONTROL)

    def add(piece: bytes) -> None:
        added.extend(range(len(made), len(made) + len(piece)))
        made.extend(piece)

    front = FRONT.match(text)
    if front:
        seen = front.end()
        made += re.sub(rb"[^\n]", b" ", front.group())
    for part in PART.finditer(text, seen):
        made += text[seen : part.start()]
        seen = part.end()
        if part["comment"] is not None:
            made += b"<!--" + DASH.sub(b" ", part["comment"] + b"-")[:-1] + part["end"]
            continue
        head, read = part["head"], 0
        for value in VALUE.finditer(head):
            for bare in BARE.finditer(head, value.start("value"), value.end("value")):
                made += head[read : bare.start()]
                made += b"&"
                add(b"lt;" if bare.group() == b"<" else b"amp;")
                read = bare.end()
            made += head[read : value.end()]
            read = value.end()
            if value["near"] is not None:
                add(b" ")
        made += head[read:]
    return bytes(made + text[seen:]), added


def decoded(content: bytes) -> tuple[str, str]:
    """A text in UTF-8, or byte by byte where it is none, as MuJoCo reads it; and its encoding.

    Raises:
        ValueError: If it is no text: it has a byte 0.
    """
    if 0 in content:
        line = content[: content.index(0)].count(b"\n") + 1
        raise ValueError(f"byte 0x00 in line {line}")
    try:
        encoding = "utf-8-sig" if content.startswith(codecs.BOM_UTF8) else "utf-8"
        text = content.decode(encoding)
    except UnicodeDecodeError:
        text, encoding = content.decode("latin-1"), "latin-1"
    return END.sub("\n", text), encoding


def encoded(text: str, content: bytes) -> bytes:
    """A text made of another by edits, in the encoding of its bytes and with their line ends; a new line has the first.

    A character that the encoding lacks is written as `&#..;`.
    """
    before, encoding = decoded(content)
    ends = END.findall(content.decode(encoding))
    old, new, made = before.split("\n"), text.split("\n"), list[str]()
    for _, start, end, first, last in SequenceMatcher(None, old, new).get_opcodes():
        kept = ends[start:end][: last - first]
        made += kept + (ends[:1] or ["\n"]) * (last - first - len(kept))
    whole = "".join(line + end for line, end in zip(new, [*made[: len(new) - 1], ""], strict=True))
    return whole.encode(encoding, "xmlcharrefreplace")


def read_texts(main: str, name: str, read: Callable[[str], str | None]) -> dict[str, str]:
    """The text of a model and those that it includes, by their paths from the model's folder.

    Args:
        main: The model's text.
        name: What to call it.
        read: Gives a file's text by its path, as seen from the model's folder; None where there is none.
    """
    texts, left = {name: main}, [(name, main)]
    while left:
        around, text = left.pop()
        for found in re.findall(r"<include\s[^<>]*?file\s*=\s*[\"']([^\"']+)[\"']", text):
            for path in (found, found if around == name else beside(around, found)):
                if path in texts:
                    break
                if (inner := read(path)) is not None:
                    texts[path] = inner
                    left.append((path, inner))
                    break
    return texts


def beside(file: str, named: str) -> str:
    """The path of a file that another one names, where it lies beside that."""
    return posixpath.join(posixpath.dirname(file), named)


def read_file(name: str) -> str | None:
    """The text of a file; None where there is none that is text."""
    try:
        return decoded(Path(name).read_bytes())[0]
    except (OSError, ValueError):
        return None
