"""Suspects judged by the counterfactual: only an edit that makes the measured symptom go away names a cause."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.probes.run import resets
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import Rule
from clinic.diagnosis.suspect import Level, Suspect

MASS, ABSURD = "mass", 2.0  # tens: a hundred times the limit
PLACES = {"structure", "twins"}  # rules, by area, that tell of a part that is not where it belongs
OVERLAPS = {"overlap-at-start", "overlap-of-relatives", "key-in-the-floor"}
LITTLE = 0.01  # of a symptom: as much may be left that another edit takes away
AS_GOOD = 1.5  # a rival whose number is within this factor helps as much


@dataclass(frozen=True)
class Judged:
    """A suspect with the probe's numbers without and with its edit; `after` is None where no edit was tried.

    `keyframe` is the number of that from which the runs began, None for the model's own start; `silenced` is why a
    comment in the model silences it; `follows` whether another one's edit would take it away.
    """

    rule: Rule
    suspect: Suspect
    level: Level
    before: float
    after: float | None
    keyframe: int | None = None
    silenced: str = ""
    follows: bool = False

    @property
    def proved(self) -> bool:
        """Whether it is a cause that nothing silences."""
        return self.level == "cause" and not self.silenced

    @property
    def severity(self) -> float:
        """How far the symptom is beyond its limit, on a scale of tens; what explodes is worst."""
        if math.isinf(self.before):
            return 9.0
        return min(8.0, math.log10(max(self.before, 1e-9) / max(self.suspect.limit, 1e-9)))


def judge(model: ReaderModel, rule: Rule, suspect: Suspect) -> Judged | None:
    """The verdict on a suspect; None where the symptom does not show, or where its edit does harm."""
    before, key = model.measured(suspect.probe), model.start.key if model.start.key >= 0 else None
    if not before > suspect.limit:
        return None
    if not suspect.edits or suspect.level == "hint":
        return Judged(rule, suspect, "hint", before, None, key)
    after = model.measured(suspect.probe, suspect.edits)
    helps = after <= suspect.limit or (after <= suspect.share * before and math.isfinite(after))
    mends = helps and _calm(model, suspect)
    if not mends and rule.level == "cause":
        return None
    return Judged(rule, suspect, rule.level, before, after if mends else None, key)


def _calm(model: ReaderModel, suspect: Suspect) -> bool:
    """Whether the model runs with the edit: where it exploded before, a symptom that takes steps says nothing."""
    was, now = model.measured(resets()), model.measured(resets(), suspect.edits)
    if was > 0 and suspect.probe.dynamic:
        return now == 0
    return now <= was


def without_rivals(found: Sequence[Judged]) -> list[Judged]:
    """The causes but for those whose symptom another edit mends clearly better, or as well with a stronger reason."""
    made = []
    for each in found:
        if each.level == "cause":
            rivals = [other for other in found if other is not each and _same_symptom(each, other)]
            if any(_beats(other, each) for other in rivals):
                made.append(replace(each, level="hint"))
                continue
        made.append(each)
    return made


def without_consequences(found: Sequence[Judged], model_of: Callable[[Rule], ReaderModel]) -> list[Judged]:
    """The causes but for those whose symptom goes away with another's edit, and not the other way round.

    A mass that is only hinted at, and beyond all measure, is a cause too where it is the reason of one. An overlap that
    goes away with the place of a part, which is hinted at, follows from it; where it was a cause, that place is one.
    """

    def ends(one: Sequence[Judged], other: Judged, rest: float = 0.0) -> bool:
        edits = [edit for each in one for edit in each.suspect.edits]
        left = model_of(other.rule).measured(other.suspect.probe, edits)
        return left <= other.suspect.limit or (math.isfinite(other.before) and left <= rest * other.before)

    causes = [each for each in found if each.level == "cause"]
    reasons, follows = list[Judged](), list[Judged]()
    for rule in {each.rule.id: each.rule for each in found if each.rule.area == MASS}.values():
        alike = [each for each in found if each.rule is rule and _beyond_measure(each)]
        ended = [each for each in causes if alike and each.rule.area != MASS and ends(alike, each)]
        reasons += alike if ended else []
        follows += ended
    follows += [each for each in causes if any(ends([one], each, LITTLE) and not ends([each], one) for one in causes)]
    displaced = [each for each in found if _displaced(each)]
    overlaps = [each for each in found if each.rule.id in OVERLAPS and any(ends([one], each) for one in displaced)]
    follows += overlaps
    sunk = [each for each in overlaps if each.level == "cause"]
    reasons += [each for each in displaced if each.after is not None and any(ends([each], one) for one in sunk)]
    lowered, raised = {id(each) for each in follows}, {id(each) for each in reasons}

    def level(each: Judged) -> Level:
        return "hint" if id(each) in lowered else "cause" if id(each) in raised else each.level

    return [replace(each, level=level(each), follows=any(each is one for one in overlaps)) for each in found]


def _displaced(each: Judged) -> bool:
    """Whether it tells of a part that is not where it belongs, or twice as large, with an edit that puts it there."""
    smaller = each.rule.id == "full-lengths"
    placed = each.rule.area in PLACES and (smaller or each.suspect.attribute != "size")
    return placed and bool(each.suspect.edits) and not each.silenced


def _beyond_measure(each: Judged) -> bool:
    return each.level == "hint" and each.after is not None and not each.silenced and each.severity > ABSURD


def grouped(found: Sequence[Judged]) -> list[Judged]:
    """The verdicts, those that say the same of several elements as one: of the worst, with the edits of all.

    Alike are those that measure one attribute by one rule. Two causes also have to write one value for another.
    """
    groups: dict[tuple[object, ...], list[Judged]] = {}
    for each in found:
        suspect = each.suspect
        told = (each.rule.id, each.level, suspect.attribute, suspect.probe.measure, each.keyframe, each.silenced)
        groups.setdefault((*told, each.after is None, bool(suspect.edits), _about(suspect)), []).append(each)
    return [each for alike in groups.values() for each in _together(alike)]


def _about(suspect: Suspect) -> str:
    """What is said where no attribute tells what it is about, without names and numbers."""
    return "" if suspect.attribute else re.sub(r"'[^']*'|\"[^\"]*\"|\d+", "", suspect.says)


def _together(alike: Sequence[Judged]) -> Sequence[Judged]:
    written = {(each.suspect.now, each.suspect.value) for each in alike if each.suspect.attribute}
    if len(alike) == 1 or (alike[0].level == "cause" and len(alike) == len(written) == 2):
        return alike
    worst = max(alike, key=lambda each: each.before)
    all_of_them = [worst, *(each for each in alike if each is not worst)]
    firsts = [name for each in all_of_them for name in each.suspect.elements[:1]]
    elements = tuple(dict.fromkeys(firsts + [name for each in all_of_them for name in each.suspect.elements]))
    edits = tuple(dict.fromkeys(edit for each in all_of_them for edit in each.suspect.edits))
    says = f"{worst.suspect.says} So it is with {len(alike) - 1} more."
    return [replace(worst, suspect=replace(worst.suspect, elements=elements, edits=edits, says=says))]


def _same_symptom(one: Judged, other: Judged) -> bool:
    same = (one.suspect.probe.measure, one.suspect.probe.of) == (other.suspect.probe.measure, other.suspect.probe.of)
    return other.level == "cause" and same and other.rule.id != one.rule.id


def _beats(one: Judged, other: Judged) -> bool:
    assert one.after is not None
    assert other.after is not None
    if one.after * AS_GOOD < other.after and other.after > other.suspect.limit:
        return True
    as_good = one.after <= max(other.after * AS_GOOD, one.suspect.limit)
    return as_good and one.suspect.excess > other.suspect.excess


def order(found: Sequence[Judged], families: Sequence[str]) -> list[Judged]:
    """The worst first; hints by how often their rules were right, and then those that an edit mends.

    Those of the symptom that the reader names come before all others, minor ones last. What a rule says after its worst
    comes after the worst of the other rules.
    """

    def key(each: Judged) -> tuple[bool, bool, float, bool, float, float]:
        named, odds = bool(set(each.rule.families) & set(families)), -each.rule.odds if each.level == "hint" else -1.0
        return (
            not named,
            each.rule.minor or each.follows,
            odds,
            each.after is None,
            -each.severity,
            -each.suspect.excess,
        )

    placed, said = [], set()
    for each in sorted(found, key=key):
        placed.append((key(each)[:2], (each.level, each.rule.id) in said, each))
        said.add((each.level, each.rule.id))
    return [each for *_, each in sorted(placed, key=lambda one: one[:2])]


def suspects_of(model: ReaderModel, rule: Rule, tell: Callable[[str], None]) -> Iterator[Suspect]:
    """What a rule suspects; one that stumbles over the model says so and finds nothing."""
    try:
        yield from rule.suspects(model)
    except (ArithmeticError, LookupError, ValueError, CompileError) as error:
        tell(f"{rule.id}: {type(error).__name__}: {error}")
