"""The text is not well-formed XML.

A tag is closed by another name or not at all, an attribute lacks its equals sign or its quotes or stands twice, a `<`,
`/` or `>` is missing, doubled or mistyped, a comment has no end, a merge has left the marks of a conflict, or the text
ends before its last tag.

Where reading stops, every change of one mark around is tried, and a few of more. Told is the one with which all is
read, names are known and the fewest characters change, of those with which MuJoCo compiles the model.

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
where the next one fits. Of a text that was cut off the rest is not known, nor are the attributes of a `<mujoco>` that
is missing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.parsers import expat

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.compiled import COMPILES
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._marks import ATTRIBUTE, marked, strange
from clinic.diagnosis.rules.errors._tags import KNOWN_TAGS, NAME, PIECE, Slip, closed
from clinic.diagnosis.rules.errors.unknown_attribute import KNOWN
from clinic.diagnosis.suspect import Suspect
from clinic.diagnosis.texts import well_formed

TITLE = "Malformed XML"
FAMILIES = ("will-not-compile",)

CONFLICT = re.compile(r"(?ms)^<{7}[^\n]*\n(.*?)^={7}[^\n]*\n(.*?)^>{7}[^\n]*\n")  # as git marks it
MARKER = re.compile(r"(?m)^[ \t]*(?:<{7}|={7}|>{7})(?: .*)?\n")
TYPESET = re.compile("=([ \\t]*)[\u2018-\u201f]([^\u2018-\u201f\"'<>\\n]*)[\u2018-\u201f\"']")
TOGETHER = (  # what is mended at once: where it stands, what becomes of it, and what it is
    (CONFLICT, r"\1", "a merge has left both sides of a conflict; the first is kept"),
    (CONFLICT, r"\2", "a merge has left both sides of a conflict; the second is kept"),
    (MARKER, "", "a merge has left the marks of a conflict"),
    (TYPESET, r'=\1"\2"', "quotation marks of prose"),
)
KNOWS = re.compile(rf"<{NAME}(?=[\s/>])|{NAME}(?=\s*=\s*[\"\'])")
MOST, FEW = 16, 4  # ways to mend a mark that are tried on the whole text, and that are tried on MuJoCo
UNSEEN = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")  # characters that no terminal shows
NEAR = 40  # characters around a mark that are shown
JUNK, TWICE = 9, 8  # expat's numbers of text after the root, and of an attribute given twice

Mistake = tuple[int, int, int]  # the line of it, from the end; its column; and expat's number of what it is


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What mends the first mistake: first what leaves no other, then what comes further."""
    for file, text in model.texts.items():
        mistake = _mistake(text)
        if (mistake is None and model.source is None) or not re.search(r"<\s*/?\w", text):
            continue
        whole, further = 0, list[Slip]()
        for slip in _slips(text, mistake):
            after = _mistake(slip.mended(text))
            if after is None:
                yield _suspect(file, text, slip)
                if (whole := whole + 1) == FEW:
                    break
            elif mistake and after[:2] > mistake[:2]:
                further.append(slip)
        yield from (_suspect(file, text, slip) for slip in further[:FEW])


def _mistake(text: str) -> Mistake | None:
    """The first mistake of a text."""
    parser = expat.ParserCreate("utf-8")  # whatever the text says of itself, as MuJoCo reads it
    try:
        parser.Parse(well_formed(text.encode())[0], True)
    except expat.ExpatError as error:
        return error.lineno - text.count("\n") - 1, error.offset, error.code
    return None


def _slips(text: str, mistake: Mistake | None) -> Iterator[Slip]:
    """What may be meant, the likeliest first."""
    lines = text.split("\n")
    line = mistake[0] + len(lines) if mistake else len(lines)
    until = sum(len(each) + 1 for each in lines[:line])
    for pattern, kept, said in TOGETHER:
        if places := [each.span() for each in pattern.finditer(text)]:
            begin, end = places[0][0], places[-1][1]
            yield Slip(begin, end, pattern.sub(kept, text[begin:end]), said)
    for wrong, begin in strange(text, until):
        here = text[:begin] + text[text.find(">", wrong + 1) + 1 :]
        known = {*KNOWN.split(), *(f"<{each}" for each in KNOWN_TAGS), *KNOWS.findall(here)}
        yield from marked(text, wrong, begin, known)[:MOST]
    if mistake is None:
        return
    if mistake[2] == TWICE:
        yield from _again(text, until - len(lines[line - 1]) - 1, until)
    yield from closed(text)
    if (cut := text.rfind("<")) > text.rfind(">"):
        kept = text[:cut].rstrip()
        said = f"the text ends inside of a tag in line {text[:cut].count(chr(10)) + 1}"
        for slip in closed(kept):
            if slip.end == len(kept):
                yield Slip(slip.start, len(text), slip.meant, f"{said}, as if the rest of the file were missing")
    if mistake[2] == JUNK and "<" not in text[until - len(lines[line - 1]) - 1 :]:
        yield Slip(until - len(lines[line - 1]) - 1, len(text), "")


def _again(text: str, begin: int, end: int) -> Iterator[Slip]:
    """The second of two equal attributes of an element in a line, left out."""
    for piece in PIECE.finditer(text, max(text.rfind("<", 0, begin), 0)):
        if piece.start() >= end:
            return
        names = set[str]()
        for each in ATTRIBUTE.finditer(text, *piece.span("attributes")):
            if each["name"] in names:
                yield Slip(*each.span(), "", f"{each['name']} stands twice in <{piece['name']}>")
            names.add(each["name"])


def _suspect(file: str, text: str, slip: Slip) -> Suspect:
    begin, end = slip.start, slip.end
    if "\n" not in text[begin:end] + slip.meant:  # the words around it
        begin -= len(re.findall(r"<?[^\s<>]*\Z", text[max(begin - NEAR, 0) : begin])[0])
        end += len(re.findall(r"\A[^\s<>]*>?", text[end : end + NEAR])[0])
    now = UNSEEN.sub(lambda found: f"\\x{ord(found[0]):02x}", text[begin:end].strip())
    value = (text[begin : slip.start] + slip.meant + text[slip.end : end]).strip() or "removed"
    line = text[: slip.start].count("\n") + 1
    start, stop = (len(text[:place].encode()) for place in (slip.start, slip.end))
    edit = Edit(file, line, "text", "replace", "", slip.meant, start, stop, stop)
    says = slip.said or f"found `{now}`, expected {f'`{value}`' if value != 'removed' else 'nothing'}"
    return Suspect((f"line {line}",), "", now, value, (edit,), COMPILES, 0.0, f"{file}: {says}.")
