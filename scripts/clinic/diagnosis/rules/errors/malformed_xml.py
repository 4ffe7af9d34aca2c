"""The text is not well-formed XML.

A tag is closed by another name or not at all, an attribute lacks its quotes or stands twice, a `<` or `&` stands bare
in a value, or a comment holds `--`.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm">
          <geom name="link" size="0.1"/>
        </bodi>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="arm">
          <geom name="link" size="0.1"/>
        </body>
      </worldbody>
    </mujoco>

The number: none; the text is read with the edit.

When it is wrong: where a closing tag is missing, the place is guessed: it is closed where the next one fits.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.parsers import expat

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.compiled import COMPILES
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Malformed XML"
FAMILIES = ("will-not-compile",)
SINCE = "0.1"

TOKEN = re.compile(
    r"<!--.*?-->|<\?.*?\?>|<!\[CDATA\[.*?\]\]>|<(/?)([A-Za-z_][\w.:-]*)((?:\"[^\"]*\"|'[^']*'|[^'\">])*?)(/?)>", re.S
)
BARE = re.compile(r"(\s[\w:.-]+\s*=\s*)([^\s\"'<>/][^\s\"'<>]*)")
MOST = 20  # mistakes that are mended in turn


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The first line that changes when the text is mended."""
    if model.source is not None:
        return
    for file, text in model.texts.items():
        mended, says = text, ""
        for _ in range(MOST):
            wrong = _mistake(mended)
            if wrong is None:
                break
            says = says or wrong[1]
            mended = next((made for made in _tries(mended, wrong[0]) if _further(made, wrong[0])), mended)
        if mended != text and _mistake(mended) is None:
            edits = _by_line(file, text, mended)
            first = edits[0]
            now = text.encode()[first.start : first.end].decode().strip()
            yield Suspect(
                (f"line {first.line}",), "", now, first.value.strip(), edits, COMPILES, 0.0, f"{file}: {says}."
            )


def _mistake(text: str) -> tuple[int, str] | None:
    """The line of the first mistake, and what it is."""
    parser = expat.ParserCreate()
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        return error.lineno, expat.errors.messages[error.code]
    return None


def _further(text: str, line: int) -> bool:
    found = _mistake(text)
    return found is None or found[0] > line


def _tries(text: str, line: int) -> Iterator[str]:
    lines = text.split("\n")
    here = lines[line - 1] if line <= len(lines) else ""

    def with_line(new: str, at: int = line) -> str:
        return "\n".join([*lines[: at - 1], new, *lines[at:]])

    yield with_line(BARE.sub(r'\1"\2"', here))
    yield with_line(re.sub(r"&(?!#?\w+;)", "&amp;", here))
    yield with_line(re.sub(r"(=\s*\"[^\"]*)$", r'\1"', here))
    yield with_line(re.sub(r"(=\s*\"[^\"<>=]*?)(\s*/?>)", r'\1"\2', here))
    yield with_line(re.sub(r"(\")([A-Za-z_]\w*\s*=)", r"\1 \2", here))
    yield with_line(_once(here))
    yield re.sub(r"<!--(.*?)-->", lambda found: "<!--" + found[1].replace("--", "- -") + "-->", text, flags=re.S)
    for back in range(1, 4):
        if line - back >= 1 and not lines[line - back - 1].rstrip().endswith(">"):
            before = lines[line - back - 1].rstrip()
            yield with_line(before + ("/>" if before.lstrip().startswith("<") else ">"), line - back)
    yield text.lstrip()
    yield from _closed(text)
    yield with_line("")


def _once(line: str) -> str:
    """The line without the second of two equal attributes of an element."""

    def tidied(found: re.Match[str]) -> str:
        seen: set[str] = set()

        def kept(each: re.Match[str]) -> str:
            again = each[1] in seen
            seen.add(each[1])
            return "" if again else each[0]

        return re.sub(r"\s+([\w:.-]+)\s*=\s*(?:\"[^\"]*\"|'[^']*')", kept, found[0])

    return re.sub(r"<[^<>]*>", tidied, line)


def _closed(text: str) -> Iterator[str]:
    """The text with its tags closed as they were opened: first by renaming or dropping one, then by adding one."""
    open_: list[str] = []
    for found in TOKEN.finditer(text):
        closing, name, _, empty = found.groups()
        if name is None or empty:
            continue
        if not closing:
            open_.append(name)
        elif open_ and open_[-1] == name:
            open_.pop()
        else:
            if open_ and name not in open_:
                yield f"{text[: found.start()]}</{open_[-1]}>{text[found.end() :]}"
            if name in open_:
                yield f"{text[: found.start()]}</{open_[-1]}>\n{text[found.start() :]}"
            yield text[: found.start()] + text[found.end() :]
            return
    if open_:
        yield text.rstrip() + "".join(f"\n</{name}>" for name in reversed(open_)) + "\n"


def _by_line(file: str, text: str, mended: str) -> tuple[Edit, ...]:
    """One edit that replaces the lines that differ."""
    old, new = text.split("\n"), mended.split("\n")
    same = next((i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
    tail = 0
    while tail < min(len(old), len(new)) - same and old[-1 - tail] == new[-1 - tail]:
        tail += 1
    start = len("\n".join(old[:same]).encode()) + (1 if same else 0)
    end = start + len("\n".join(old[same : len(old) - tail]).encode())
    value = "\n".join(new[same : len(new) - tail])
    return (Edit(file, same + 1, "text", "replace", "", value, start, end, end),)
