"""Tightness: a number that matters, halved or doubled, is noticed by a check.

What matters is a number of the broken text that prose quotes, that a fix edits away or that a sweep varies, and one
that a fix writes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from difflib import SequenceMatcher
from typing import Literal

from clinic.engine.checks import judge
from clinic.engine.variant import BROKEN, EditError, apply_edits, variants
from clinic.proof.prose_laws import ATTRIBUTE, quotations
from clinic.proof.trials import checks_in, run_trial
from clinic.record.case import Case
from clinic.record.parts import Edit, Strict

FACTORS = {"halved": 0.5, "doubled": 2.0}
NUMBER = re.compile(r"(?<![\w.])\d[\d_]*(?:\.\d*)?(?:[eE][-+]?\d+)?(?!\w)|(?<![\w.])\.\d+")
TOKEN = re.compile(rf"{NUMBER.pattern}|\w+|\S")


class Number(Strict):
    """A number in a file of a case, as a variant has it.

    Attributes:
        variant: Whose text it stands in.
        start: Where in the text it begins.
        end: Where it ends.
    """

    variant: str
    file: str
    start: int
    end: int


class Loose(Number):
    """A number that may be changed without a check that notices; `change` is a key of FACTORS."""

    change: str


def numbers(case: Case) -> list[Number]:
    """The numbers that matter, zeros left out, for these stay what they are."""
    made = {*_quoted(case), *_edited(case), *_swept(case)}
    texts = _texts(case)
    return sorted((n for n in made if _value(texts[n.variant][n.file], n)), key=lambda n: (*n.model_dump().values(),))


def loose_numbers(case: Case, asked: list[Number]) -> list[Loose]:
    """Those of the numbers asked for that no check notices, once for each change that passes."""
    changes = ((number, change) for number in asked for change in FACTORS)
    return [Loose(**n.model_dump(), change=change) for n, change in changes if not _noticed(case, n, FACTORS[change])]


def value_of(case: Case, number: Number) -> str:
    """The number as it is written."""
    return _texts(case)[number.variant][number.file][number.start : number.end]


def words_of(case: Case, number: Number) -> str:
    """The attribute that holds a number, or else its line."""
    text = _texts(case)[number.variant][number.file]
    for found in ATTRIBUTE.finditer(text):
        if found.start() <= number.start and number.end <= found.end():
            return found.group()
    begin, end = text.rfind("\n", 0, number.start) + 1, text.find("\n", number.end)
    return text[begin:end].strip()


def covers(case: Case, words: str, number: Number) -> bool:
    """Whether the number stands within these words."""
    text = _texts(case)[number.variant][number.file]
    spans = (match.span() for match in re.finditer(re.escape(words), text))
    return any(start <= number.start and number.end <= end for start, end in spans)


def _noticed(case: Case, number: Number, factor: float) -> bool:
    """Whether a check of the broken variant or of a fix fails once the number is multiplied."""
    text = _texts(case)[number.variant][number.file]
    made = f"{text[: number.start]}{_value(text, number) * factor:.12g}{text[number.end :]}"
    if number.variant != BROKEN:
        return not _stays(case, made, "fixed")
    case = replace(case, texts={**case.texts, number.file: made})
    if not _stays(case, case.text, "broken"):
        return True
    for fix in case.record.fixes:
        try:
            text = apply_edits(case.text, fix.edits)
        except EditError:  # the edit takes the number away
            continue
        if not _stays(case, text, "fixed"):
            return True
    return False


def _stays(case: Case, text: str, kind: Literal["broken", "fixed"]) -> bool:
    """Whether the checks of a kind hold in every situation, with no warning but those that belong to it."""
    for trial in (None, *case.record.trials):
        try:
            warnings, traces = run_trial(case, text, trial)
        except EditError:  # the trial changes this very number
            continue
        except ValueError:
            return False
        named = case.record.warnings if kind == "broken" else []
        if trial is None and sorted(warnings) != sorted(named):
            return False
        if not all(judge(check, traces).holds for check in getattr(checks_in(case.record, trial), kind)):
            return False
    return True


def _quoted(case: Case) -> Iterator[Number]:
    """The numbers of attributes that prose quotes: where the broken text has them, or else where a fix does."""
    texts = _texts(case)
    for attribute in {quotation for _, quotation in quotations(case)}:
        standing = re.compile(rf"(?<!\w){re.escape(attribute)}")
        found = [
            Number(variant=variant, file=file, start=match.start() + inner.start(), end=match.start() + inner.end())
            for variant, files in texts.items()
            for file, text in files.items()
            for match in standing.finditer(text)
            for inner in NUMBER.finditer(attribute)
        ]
        yield from [number for number in found if number.variant == BROKEN] or found


def _edited(case: Case) -> Iterator[Number]:
    """The numbers that a fix takes away from the broken text, and those that it writes."""
    for fix in case.record.fixes:
        taken, written = _differing(case.text, apply_edits(case.text, fix.edits))
        yield from (Number(variant=BROKEN, file=case.record.source, start=a, end=b) for a, b in taken)
        yield from (Number(variant=fix.id, file=case.record.source, start=a, end=b) for a, b in written)


def _swept(case: Case) -> Iterator[Number]:
    """The numbers that a sweep takes away from its base."""
    for sweep in case.record.sweep.values():
        text = _texts(case)[sweep.base][case.record.source]
        edits = [*sweep.edits, *(Edit(find=each.find, replace=each.replace) for each in sweep.vary)]
        try:
            taken, _ = _differing(text, apply_edits(text, edits))
        except EditError:  # the sweep's own run tells of it
            continue
        yield from (Number(variant=sweep.base, file=case.record.source, start=a, end=b) for a, b in taken)


def _differing(before: str, after: str) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Where the numbers stand that one text has and the other has not: of the first, and of the second."""
    old, new = list(TOKEN.finditer(before)), list(TOKEN.finditer(after))
    steps = SequenceMatcher(None, [m.group() for m in old], [m.group() for m in new], autojunk=False).get_opcodes()
    changes = [step for step in steps if step[0] != "equal"]
    sides = ([m for _, a, b, _, _ in changes for m in old[a:b]], [m for _, _, _, a, b in changes for m in new[a:b]])
    taken, written = ([m.span() for m in side if NUMBER.fullmatch(m.group())] for side in sides)
    return taken, written


def _texts(case: Case) -> dict[str, dict[str, str]]:
    """The files of the broken variant and of every fix, by variant and name."""
    made = [variant for variant in variants(case) if variant.kind != "refuted"]
    return {variant.id: {**case.texts, case.record.source: variant.text} for variant in made}


def _value(text: str, number: Number) -> float:
    return float(text[number.start : number.end])
