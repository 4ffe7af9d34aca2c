"""The text is not well-formed XML.

A tag is closed by another name or not at all, an attribute lacks its quotes or stands twice, a comment has no end, a
merge has left both sides of a conflict, or the text ends before its last tag.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm">
          <geom name="link" size="0.1"/>
        </bodi>
      </worldbody>
    </mujoco>

Good:

    -     </bodi>
    +     </body>

The number: none; the text is read with the edit.

When it is wrong: where a tag is missing, the place is guessed: by how the lines are indented, where they are, or else
where the next one fits. Of a text that was cut off the rest is not known.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from xml.parsers import expat

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.compiled import COMPILES
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._tags import closed
from clinic.diagnosis.suspect import Suspect
from clinic.diagnosis.texts import well_formed

TITLE = "Malformed XML"
FAMILIES = ("will-not-compile",)

BARE = re.compile(r"(\s[\w:.-]+\s*=\s*)([^\s\"'<>/][^\s\"'<>]*)")
UNCLOSED = re.compile(r"(=\s*\"[^\"=<>]*?)(\s+[\w:.-]+\s*=\s*\")")
CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")
NAKED = re.compile(
    r"(?m)^[ \t]*(?=/?[a-z]\w*(?:\s+[\w:.-]+\s*=\s*\"[^\"<>]*\")*\s*/?>[ \t]*$)"
)  # a tag without its `<`
CONFLICT = re.compile(r"(?ms)^<{7}[^\n]*\n(.*?)^={7}[^\n]*\n.*?^>{7}[^\n]*\n")  # as git marks it
CUT = re.compile(r"<[^<>]*\Z")
MOST = 20  # mistakes that are mended in turn
MANY = 2000  # lines, beyond which a change is one from the first of them to the last

Try = tuple[str, str]  # a text, and what was done to it where expat's words do not tell


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
            made = _mended(mended, wrong[0])
            if made is None:
                break
            mended, said = made
            says = says or (f"{wrong[1]}: {said}" if said else wrong[1])
        if mended != text and _mistake(mended) is None:
            edits = _by_line(file, text, mended)
            first = edits[0]
            now = text.encode()[first.start : first.end].decode().strip()
            yield Suspect(
                (f"line {first.line}",),
                "",
                now,
                first.value.strip() or "removed",
                edits,
                COMPILES,
                0.0,
                f"{file}: {says}.",
            )


def _mistake(text: str) -> tuple[int, str] | None:
    """The line of the first mistake, and what it is."""
    parser = expat.ParserCreate("utf-8")  # whatever the text says of itself, as MuJoCo reads it
    try:
        parser.Parse(well_formed(text.encode())[0], True)
    except expat.ExpatError as error:
        return error.lineno, expat.errors.messages[error.code]
    return None


def _mended(text: str, line: int) -> Try | None:
    """The first try that leaves no mistake, or else the first of which the next mistake is further on."""
    further = None
    for made in _tries(text, line):
        found = _mistake(made[0]) if made[0] != text else (0, "")
        if found is None:
            return made
        if found[0] > line:
            further = further or made
    return further


def _tries(text: str, line: int) -> Iterator[Try]:
    if CONFLICT.search(text):
        yield CONFLICT.sub(r"\1", text), "a merge has left both sides of a conflict; the first is kept"
    for made in _of_characters(text, line):
        yield made, ""
    yield from closed(text)
    if cut := CUT.search(text):
        at = text[: cut.start()].count("\n") + 1
        kept = text[: cut.start()].rstrip() + "\n"
        said = f"the text ends inside of a tag in line {at}, as if the rest of the file were missing"
        yield kept, said
        yield from ((made, said) for made, _ in closed(kept))
    here = text.split("\n")[line - 1 : line]
    if here and "<" not in here[0]:  # what is no tag is not XML's
        yield _with_line(text, line, ""), ""


def _with_line(text: str, at: int, new: str) -> str:
    lines = text.split("\n")
    return "\n".join([*lines[: at - 1], new, *lines[at:]])


def _of_characters(text: str, line: int) -> Iterator[str]:
    """The text with quotes and other marks of a line mended."""
    lines = text.split("\n")
    here = lines[line - 1] if line <= len(lines) else ""

    def with_line(new: str, at: int = line) -> str:
        return _with_line(text, at, new)

    yield CONTROL.sub("", text)
    yield with_line(re.sub(r"(\s[\w:.-]+\s*=\s*)([^\s\"'<>/=][^\"'<>=]*\")", r'\1"\2', here))
    yield with_line(BARE.sub(r'\1"\2"', here))
    for at in range(line, max(line - 4, 0), -1):  # expat stumbles over the `<` of a later line
        if (row := "".join(lines[at - 1 : at])).count('"') % 2:
            yield with_line(UNCLOSED.sub(r'\1"\2', row), at)
            yield with_line(re.sub(r"(=\s*\"[^\"<>=]*?)(\s*/?>)", r'\1"\2', row), at)
            yield with_line(re.sub(r"(=\s*\"[^\"]*)$", r'\1"', row), at)
    yield _once(text, line)
    for at in range(line, max(line - 4, 0), -1):
        row, below = lines[at - 1].rstrip() if at <= len(lines) else "", "".join(lines[at : at + 2]).lstrip()
        if row and below.startswith("<") and row.rfind("<") >= row.rfind(">"):  # a tag that has no end
            yield from (with_line(row + end, at) for end in ("/>", ">") if not (row.endswith("/") and end == "/>"))
    yield from (text[: found.end()] + "<" + text[found.end() :] for found in list(NAKED.finditer(text))[:3])
    if (begun := text.rfind("<!--")) > text.rfind("-->"):
        end = text.find("\n", begun) if "\n" in text[begun:] else len(text)
        yield text[:end] + " -->" + text[end:]


def _once(text: str, line: int) -> str:
    """The text without the second of two equal attributes of the elements that are open in a line."""

    def tidied(found: re.Match[str]) -> str:
        seen: set[str] = set()

        def kept(each: re.Match[str]) -> str:
            again = each[1] in seen
            seen.add(each[1])
            return "" if again else each[0]

        return re.sub(r"\s+([\w:.-]+)\s*=\s*(?:\"[^\"]*\"|'[^']*')", kept, found[0])

    begin = sum(len(each) + 1 for each in text.split("\n")[: line - 1])
    end = text.find("\n", begin) if "\n" in text[begin:] else len(text)
    begin = max(text.rfind("<", 0, begin), 0) if text.rfind("<", 0, begin) > text.rfind(">", 0, begin) else begin
    end = max(text.find(">", end) + 1, end) if text.rfind("<", 0, end) > text.rfind(">", 0, end) else end
    return text[:begin] + re.sub(r"<[^<>]*>", tidied, text[begin:end]) + text[end:]


def _by_line(file: str, text: str, mended: str) -> tuple[Edit, ...]:
    """Edits that replace the lines that differ."""
    old, new = text.split("\n"), mended.split("\n")
    same = next((i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
    tail = 0
    while tail < min(len(old), len(new)) - same and old[-1 - tail] == new[-1 - tail]:
        tail += 1
    spans = [(same, len(old) - tail, same, len(new) - tail)]
    if max(len(old), len(new)) - same - tail < MANY:
        matched = difflib.SequenceMatcher(None, old[same : len(old) - tail], new[same : len(new) - tail], False)
        spans = [
            (i + same, j + same, k + same, m + same) for what, i, j, k, m in matched.get_opcodes() if what != "equal"
        ]
    made, size = [], [len(each.encode()) + 1 for each in old]
    for begin, end, first, last in spans:
        start = sum(size[:begin])
        stop = start + max(sum(size[begin:end]) - 1, 0) if end > begin else start
        value = "\n".join(new[first:last])
        if end == begin:  # what is put in before a line, or after the last
            value = value + "\n" if begin < len(old) else "\n" + value
            start = stop = start if begin < len(old) else start - 1
        elif first == last and end < len(old):  # the lines go with their break
            stop += 1
        made.append(Edit(file, begin + 1, "text", "replace", "", value, start, stop, stop))
    return tuple(made)
