"""Marks of XML that are left out, doubled or mistyped: how the text may have been meant."""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

from clinic.diagnosis.rules.errors._tags import ATTRIBUTES, NAME, PIECE, VALUE, Slip

BEGUN = re.compile(rf"(?P<name><?/?\s*(?:{NAME})?)(?P<attributes>{ATTRIBUTES})")
ATTRIBUTE = re.compile(rf"(?P<gap>\s*)(?P<name>{NAME})(?P<is>\s*=\s*)(?P<value>{VALUE})")
NAKED = re.compile(rf"=\s*([^\s\"'<>=][^\"'<>=]*?)(?=\s+{NAME}\s*=|\s*/?>)")  # a value without quotes
LONE = re.compile(rf"\s+{NAME}(?=\s|/?>)")  # an attribute without a value
NEXT = re.compile(rf"(?=\s+{NAME}\s*=|/?>|<|\n)")  # where one may read on
ADDED = ('"', "'", "=", ">", "/", "<", " ", "/>", '="')
FAR, FARTHEST = 300, 10_000  # characters around the first that is wrong, where it is mended and to its tag's end
MARK, TAG = re.compile(r"[\s<>/=\"']"), re.compile(r"</?\s*\w")
RARELY = re.compile(r"\w|\s[^=]")  # what is rarely typed by mistake: a letter, or a blank but for an equals sign
STRAY = 4  # how odd it is that words stand between tags, or what is meant for a program
GONE = 2  # how odd it is that more than a mark is too much
MOST = 5  # places in a text, and ends of what is too much


def strange(text: str, until: int) -> Iterator[tuple[int, int]]:
    """Where a text is none of XML's pieces, before a place, and where the piece begins that goes wrong there."""
    at = before = found = 0
    begun = False
    while at < min(len(text), until) and found < MOST:
        piece = PIECE.match(text, at)
        if piece and not (begun and piece[0].startswith("<?")):
            before, at, begun = at, piece.end(), begun or piece["name"] is not None
            continue
        yield at, at if text[at] == "<" else before
        found += 1
        following = text.find("<", at + 1)
        before = at = following if following >= 0 else len(text)


def marked(text: str, wrong: int, begin: int, known: Set[str]) -> list[Slip]:
    """What may be meant where a text is strange, the least odd with the least change first."""
    if text.startswith("<!--", begin):
        return list(_ended(text, begin))
    begun = BEGUN.match(text, begin)
    assert begun is not None
    stop = begun.end() if text[wrong] == "<" else max(begun.end(), wrong)
    end = min(text.find(">", max(stop, wrong + 1)) + 1 or len(text), stop + FARTHEST)
    last = min(end, stop + FAR)
    tail = text[end : min(text.find(">", end) + 1 or len(text), end + FARTHEST)]
    written = [each.start() for each in ATTRIBUTE.finditer(text, *begun.span("attributes"))]
    first, lead = (written[-2], begun["name"]) if len(written) > 1 else (begin, "")  # what is before is well
    found = list[tuple[int, int, int, bool, Slip]]()
    for slip in dict.fromkeys(_slips(text, max(first, stop - FAR), stop, last, wrong)):
        tried = lead + text[first : slip.start] + slip.meant + text[slip.end : end]
        left, odd = _read(tried + tail, len(tried), known)
        if left < end - begin:
            gone = text[slip.start : slip.end]
            odd += slip.start < begun.end()  # in what can be read as it is
            odd += GONE * (len(gone) > 1 and not slip.meant) + ("=" in gone and "=" not in slip.meant)
            found.append((left, odd, _cost(gone, slip.meant), len(gone) == 2, slip))
    alike = dict[str, Slip]()  # those that differ in white space are one
    for *_, slip in sorted(found):
        alike.setdefault("".join((text[first : slip.start] + slip.meant + text[slip.end : last]).split()), slip)
    return list(alike.values())


def _cost(gone: str, meant: str) -> int:
    """How many marks are changed; two that are swapped are one, a letter in the place of a mark is two."""
    if len(gone) == 2 and gone == meant[::-1]:
        return 1
    return max(len(gone), len(meant)) + (meant == "'") + bool(RARELY.match(gone + meant))


def _slips(text: str, first: int, stop: int, last: int, wrong: int) -> Iterator[Slip]:
    """Every change of one mark between two places, and the changes of more that are usual where reading stops."""
    for at in range(first, last + 1):
        for mark in (*ADDED, *("!" * (text[at - 1 : at] == "<" and text.startswith("--", at)))):
            yield Slip(at, at, mark)
            if at < last and len(mark) == 1 and text[at] != mark:
                yield Slip(at, at + 1, mark)
        if at < last:
            yield Slip(at, at + 1, "")
        if at + 1 < last and MARK.search(text, at, at + 2):
            yield Slip(at, at + 2, text[at : at + 2][::-1])
    for found in NAKED.finditer(text, first, last + 1):
        yield Slip(*found.span(1), f'"{found[1]}"')
    if lone := LONE.match(text, stop):
        yield Slip(lone.end(), lone.end(), '="true"')
    for begin in {stop, stop if TAG.match(text, wrong) else wrong}:
        ends = [found.end() for found in NEXT.finditer(text, begin + 1, last)][:MOST]
        yield from (Slip(begin, at, "") for at in (*ends, *([last] * (text[last - 1] == ">"))))


def _ended(text: str, begin: int) -> Iterator[Slip]:
    """A comment with an end: at an arrow, at the end of its line, or before the next tag."""
    following = text.find("<!--", begin + 4)
    for pattern, mark in ((r"-+[ \t]*>", "-->"), (r"[ \t]*(?=\n)", " -->"), (r"\s*(?=<)", " -->")):
        if found := re.compile(pattern).search(text, begin + 4, following + 4 if following >= 0 else len(text)):
            yield Slip(*found.span(), mark, f"the comment of line {text[:begin].count(chr(10)) + 1} has no end")


def _read(text: str, enough: int, known: Set[str]) -> tuple[int, int]:
    """How much of a text is left where it is none of XML's pieces, and how odd it is up to there."""
    at = odd = 0
    while at < enough and (piece := PIECE.match(text, at)):
        at = piece.end()
        if piece["text"]:
            odd += STRAY * bool(piece["text"].strip())
        elif piece["name"]:
            odd += f"<{piece['name']}" not in known
            names = set[str]()
            for each in ATTRIBUTE.finditer(piece["attributes"]):
                odd += each["name"] not in known
                odd += each["name"] in names
                odd += not each["gap"]
                odd += each["is"] != "="
                odd += bool(re.search("[=<>\"']", each["value"][1:-1]))
                names.add(each["name"])
            odd += piece[0][1].isspace()
        elif piece[0].startswith("<?"):
            odd += STRAY
    return max(enough - at, 0), odd
