"""Law 5, comparisons: words that put one number over another are held against the two."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from clinic.proof.evidence import Evidence, Samples
from clinic.proof.prose_laws import prose_of, spoken
from clinic.record.case import Case
from clinic.record.problem import Problem
from clinic.record.prose import CODE, FIELD
from clinic.record.yaml_lines import Where

SAME = 0.05  # the share by which two numbers that are called the same may differ
MORE = r"more than|larger than|greater than|longer than|higher than|faster than|above|exceeds?|over"
LESS = r"less than|smaller than|shorter than|lower than|slower than|fewer than|below|short of|under|falls short of"
OTHER = r"instead of|rather than|in place of|where it was|\bnot"
BETWEEN = re.compile(
    rf"\b(?:(?P<more>{MORE})|(?P<less>{LESS})|(?P<other>{OTHER}))\s+(?:the\s+|its\s+)?$", re.IGNORECASE
)
AGAINST = re.compile(rf"\b(?:{OTHER}|unlike|as against|compared with|from|without it)\s+(?:the\s+)?$", re.IGNORECASE)
DENIED = re.compile(r"\b(?:not|never|no|neither|nor|without|cannot)\b", re.IGNORECASE)
TO = re.compile(
    r"\b(?:(?P<more>rises|grows|climbs|increases|goes up)|(?P<less>falls|drops|shrinks|decreases|goes down)"
    r"|(?P<same>stays|remains|keeps))(?:\s+(?:to|at|on to))\s*$|\b(?P<still>is still|as much as|the same)\s*$",
    re.IGNORECASE,
)
AFTER = re.compile(
    r"^\s*,?\s*(?:(?P<same>(?:as before|as it was|still|again|all the same)(?=\s*[.,;:]|\s*$)))", re.IGNORECASE
)
NEXT = re.compile(r"\b(?:next|then|later|afterwards|after that)\b", re.IGNORECASE)
NOUN = re.compile(
    rf"\b(?:(?P<more>{MORE})|(?P<less>{LESS}))\s+(?:(?:the|its|their|this|that)\s+(?P<noun>[a-z]+)|\$(?P<symbol>\w+)\$)",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Said:
    """A number of a run in a sentence: its place there, whose it is, and what it is, in its signal's unit."""

    start: int
    end: int
    text: str
    variant: str
    signal: str
    take: str
    value: float
    unit: str


def compared(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, comparisons. *More than*, *below*, *falls to*, *as before*, *instead of*: the numbers are so."""
    for where, text in prose_of(case):
        for paragraph in re.split(r"\n[ \t]*\n", CODE.sub(_blank, text)):
            for one in numbers(paragraph, evidence):
                yield from _of_broken(case, where, paragraph[: one.start], one, evidence)
            for sentence in re.split(r"(?<=[.?!;])\s", paragraph):
                said = list(numbers(sentence, evidence))
                for left, right in pairwise(said):
                    yield from _two(case, where, sentence, left, right)
                for one in said:
                    yield from _of_one(case, where, sentence, one, evidence)
                    yield from _noun(case, where, sentence, one, said, evidence)


def ordered(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, order. A number of a signal after *next* or *later* is reached after the one before."""
    for where, text in prose_of(case):
        for paragraph in re.split(r"\n[ \t]*\n", CODE.sub(_blank, text)):
            for left, right in pairwise(numbers(paragraph, evidence)):
                found = NEXT.search(paragraph[left.end : right.start])
                if found is None or (left.variant, left.signal) != (right.variant, right.signal):
                    continue
                trace = evidence.variants[left.variant].traces[left.signal]
                here, there = _reached(trace, left), _reached(trace, right)
                if here is not None and there is not None and here >= there:
                    said = f"{found[0]}, though it is reached at {there:g} s"
                    yield _problem(case, where, right, said, f"after {here:g} s, where {left.text} is")


def _reached(trace: Samples, one: Said) -> float | None:
    """When a number of a run is first reached, in s; None for one that no sample has."""
    pairs = zip(trace.time, trace.value, strict=True)
    return next((time for time, value in pairs if value is not None and _same(value, one.value)), None)


def _two(case: Case, where: Where, sentence: str, left: Said, right: Said) -> Iterator[Problem]:
    """Two numbers of one unit with a comparison between them."""
    between = sentence[left.end : right.start]
    found = BETWEEN.search(between)
    if found is None or left.unit != right.unit or (not found["other"] and DENIED.search(between)):
        return
    if found["other"]:
        if _same(left.value, right.value):
            yield _problem(case, where, right, f"{found[0].strip()}, of two equal numbers", "numbers that differ")
    else:
        yield from _held(case, where, found, left, left.value, right.value)


def _of_broken(case: Case, where: Where, before: str, one: Said, evidence: Evidence) -> Iterator[Problem]:
    """The broken variant's number where a remedy is spoken of: words set it against the remedy's, if the two differ."""
    told = case.record.refuted[where[1]].id if where[0] == "refuted" and isinstance(where[1], int) else "broken"
    remedy = spoken(evidence.variants, told, before)
    if one.variant != "broken" or remedy == "broken":
        return
    own = evidence.variants[remedy].values[one.signal].get(one.take)
    if own is not None and not _same(own, one.value) and not AGAINST.search(before):
        wanted = (
            f"a number of the remedy, or words that set it against that: instead of, not; the remedy's is {own:.4g}"
        )
        yield _problem(case, where, one, "a number of broken", wanted)


def _of_one(case: Case, where: Where, sentence: str, one: Said, evidence: Evidence) -> Iterator[Problem]:
    """A remedy's number that is said to have risen, fallen or stayed, held against the broken variant's."""
    before = evidence.variants["broken"].values.get(one.signal, {}).get(one.take)
    found = TO.search(sentence[: one.start]) or AFTER.search(sentence[one.end :])
    if found is None or before is None or one.variant == "broken" or where[0] not in ("refuted", "fix"):
        return
    groups = found.groupdict()
    start = evidence.variants[one.variant].values[one.signal].get("first")
    if groups.get("same") or groups.get("still"):
        others = (
            each.values[one.signal].get(one.take) for key, each in evidence.variants.items() if key != one.variant
        )
        if not any(other is not None and _same(one.value, other) for other in (start, *others)):
            yield _problem(case, where, one, f"{found[0].strip(' ,')}: {one.value:.4g}", f"broken's, {before:.4g}")
    else:
        yield from _held(case, where, found, one, one.value, before)


def _noun(
    case: Case, where: Where, sentence: str, one: Said, said: list[Said], evidence: Evidence
) -> Iterator[Problem]:
    """*Above the limit*: a number held against the one signal of its variant that bears the name."""
    for found in NOUN.finditer(sentence):
        near = [each for each in said if each.end <= found.start()][-1:] or [
            each for each in said if each.start >= found.end()
        ][:1]
        direct = [each for each in said if 0 <= each.start - found.end() <= 6]
        if (direct or near)[:1] != [one] or DENIED.search(sentence[max(0, found.start() - 30) : found.start()]):
            continue
        variant = evidence.variants[one.variant]
        noun = (found["noun"] or "").lower()
        symbols = {each.where.get(found["symbol"] or "") for each in case.record.formulas.values()}
        named = [name for name in variant.values if name == noun or name in symbols]
        other = variant.timestep if noun == "timestep" else None
        unit = "s" if other is not None else ""
        if other is None and named and named != [one.signal]:
            other = variant.values[named[0]].get("final")
            unit = case.record.signals[named[0]].unit
        if other is not None and unit == one.unit:
            yield from _held(case, where, found, one, one.value, other)


def _held(case: Case, where: Where, found: re.Match[str], one: Said, here: float, there: float) -> Iterator[Problem]:
    more = bool(found.groupdict().get("more"))
    if (here <= there) if more else (here >= there):
        said = " ".join(found[0].split())
        yield _problem(
            case, where, one, f"{said}, though {here:.4g} is not", f"{'more' if more else 'less'} than {there:.4g}"
        )


def _problem(case: Case, where: Where, one: Said, found: str, wanted: str) -> Problem:
    return case.problem(where, f"{one.text}: {found}", wanted, "correct the words or the field", one.text)


def numbers(sentence: str, evidence: Evidence) -> Iterator[Said]:
    """The numbers of runs that a sentence has, in its order."""
    for field in FIELD.finditer(sentence):
        parts = field[1].partition("|")[0].strip().split(".")
        variant = evidence.variants.get(parts[0])
        if variant is None:
            continue
        value = variant.values[parts[1]].get(parts[2]) if len(parts) == 3 and parts[1] in variant.values else None
        if value is not None:
            unit = variant.traces[parts[1]].unit
            yield Said(field.start(), field.end(), field[0], parts[0], parts[1], parts[2], value, unit)


def _same(here: float, there: float) -> bool:
    return abs(here - there) <= SAME * max(abs(here), abs(there))


def _blank(code: re.Match[str]) -> str:
    return " " * len(code[0]) if "{{" not in code[0] else code[0]
