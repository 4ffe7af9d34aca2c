"""What a diagnosis says: findings, and the whole of them as data and as text."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from clinic.diagnosis.edit import Edit, diff
from clinic.diagnosis.judge import Judged
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Level, spoken

CAUSES_SHOWN = 3
LONG = 200  # characters of a value that a terminal shows
FEW = 12  # rules whose names are told where nothing was found
DIES = "engine-dies"
FAILS = "rule-fails"
LATE = "rule-too-slow"
KILLED = "rule-killed"
NOISE = 1e-12  # what rounding leaves
SITE = "CLINIC_SITE"  # the environment variable with the address of the site


@dataclass(frozen=True)
class Finding:
    """One finding. `before` and `after` are the probe's number without and with the edit, in `unit`.

    A number that is not finite, such as the speed of a simulation that explodes, is infinity; None in JSON. `keyframe`
    is the number of the one that the runs began from, None for the model's own start; `silenced` why a comment in the
    model silences the finding.
    """

    rule: str
    title: str
    level: Level
    elements: tuple[str, ...]
    file: str
    line: int | None
    attribute: str
    now: str
    value: str
    edit: tuple[Edit, ...]
    probe: str
    unit: str
    before: float
    after: float | None
    says: str
    healthy: str
    page: str | None = None
    keyframe: int | None = None
    silenced: str = ""

    def data(self) -> dict[str, Any]:
        """The finding as JSON has it."""
        made = asdict(self)
        for name in ("before", "after"):
            if made[name] is not None and not math.isfinite(made[name]):
                made[name] = None
        kept = ("file", "line", "element", "action", "attribute", "value")
        made["edit"] = [{name: getattr(each, name) for name in kept} for each in self.edit]
        return made


@dataclass(frozen=True)
class Measured:
    """What the program of a symptom's page says of a model (`proof/procedure.py`).

    Attributes:
        family: The symptom.
        values: What each case's measurement gives, by case.
        told: The cases whose measurements apply.
        printed: The program's lines; why it ended, where it did not go through.
    """

    family: str
    values: Mapping[str, float]
    told: tuple[str, ...]
    printed: str


@dataclass(frozen=True)
class Diagnosis:
    """What was found in a model.

    Attributes:
        engine: The release that ran it.
        file: The model.
        causes: Proved by an edit, the most telling first.
        hints: What intent decides, what no edit here mends, or what its rule finds too seldom to call a cause.
        silenced: What comments in the model silence (`ignores`).
        ruled_out: Rules that found nothing.
        error: Why it does not compile; empty where it does.
        texts: The model's texts by file.
        fixed: The same with the edits of all causes that go together.
        measured: What the measurements of the symptom that the reader names give; None without one.
        untried: Rules for which no time was left, from one start at least.
    """

    engine: str
    file: str
    causes: tuple[Finding, ...]
    hints: tuple[Finding, ...]
    silenced: tuple[Finding, ...]
    ruled_out: tuple[str, ...]
    error: str = ""
    texts: Mapping[str, str] = field(default_factory=dict)
    fixed: Mapping[str, str] = field(default_factory=dict)
    measured: Measured | None = None
    untried: tuple[str, ...] = ()

    def data(self) -> dict[str, Any]:
        """The public contract, as JSON has it."""
        return {
            "engine": self.engine,
            "file": self.file,
            "causes": [each.data() for each in self.causes],
            "hints": [each.data() for each in self.hints],
            "silenced": [each.data() for each in self.silenced],
            "ruled_out": list(self.ruled_out),
            "untried": list(self.untried),
            "error": self.error,
            "measured": asdict(self.measured) if self.measured else None,
        }

    def diff(self) -> str:
        """The edits of all causes as a unified diff."""
        return diff(self.texts, self.fixed)

    def text(self, every: bool = False) -> str:
        """The diagnosis for a terminal: three causes, then hints in a line each, then what was ruled out."""
        if self.error and not self.causes and not self.hints:
            return f"It does not compile, and no rule knows why: {self.error.strip()}"
        shown = self.causes if every else self.causes[:CAUSES_SHOWN]
        lines = [line for number, each in enumerate(shown, 1) for line in _cause(number, each)]
        if len(shown) < len(self.causes):
            lines.append(f"   and {len(self.causes) - len(shown)} more: --all")
        for each in self.hints:
            place = (each.rule, f"{each.file}:{each.line}" if each.line else "", _elements(each.elements))
            lines.append(f"hint     {'  '.join(filter(None, place))}: {each.says}{_edited(each)}")
        if self.ruled_out:
            tried = _tried(self.ruled_out, every)
            lines.append(f"ruled out: {tried}" if self.causes or self.hints else f"Nothing found, by {tried}.")
        elif not lines and not self.untried:
            lines.append("Nothing found, for no chosen rule is about a model that compiles.")
        if self.untried:
            lines.append(f"no time for {_tried(self.untried, every)}")
        if self.silenced:
            told = (f"{each.rule} {each.file}" + (f":{each.line}" if each.line else "") for each in self.silenced)
            lines.append(f"silenced ({len(self.silenced)}): {', '.join(told)}")
        if self.measured:
            lines.append(f"{self.measured.family}, measured in this model as on the symptom's page:")
            lines += [f"   {line}" for line in self.measured.printed.splitlines()]
        return "\n".join(lines)


def finding_of(judged: Judged, model: ReaderModel) -> Finding:
    """What is said of a judged suspect of a model."""
    rule, suspect = judged.rule, judged.suspect
    first: Edit | Element | None = next(iter(suspect.edits), suspect.at)
    if first is None and not model.error:
        first = next((place for each in suspect.elements if (place := model.named(each))), None)
    told = str if suspect.edits else spoken  # what an edit writes is copied from here
    site = os.environ.get(SITE, "").rstrip("/")
    page = f"{site}/cases/{rule.case}/" if rule.case else f"{site}/rules/{rule.id}/"
    return Finding(
        rule=rule.id,
        title=rule.title,
        level=judged.level,
        elements=suspect.elements,
        file=first.file if first else next(iter(model.texts)),
        line=first.line if first else None,
        attribute=suspect.attribute,
        now=told(suspect.now) or _written(model, first, suspect.attribute),
        value=told(suspect.value),
        edit=suspect.edits,
        probe=suspect.probe.title,
        unit=suspect.probe.unit,
        before=judged.before,
        after=judged.after,
        says=spoken(suspect.says),
        healthy=spoken(suspect.healthy),
        page=page if site else None,
        keyframe=judged.keyframe,
        silenced=judged.silenced,
    )


def _written(model: ReaderModel, first: Edit | Element | None, attribute: str) -> str:
    """What the text has for the attribute that an edit sets, as it is written."""
    if model.source is None or not isinstance(first, Edit) or (first.action, first.attribute) != ("set", attribute):
        return ""
    places = (each for each in model.source.root.walk() if (each.file, each.start) == (first.file, first.start))
    element = next(places, None)
    found = model.source.value(element, attribute) if element else None
    return " ".join(found.split()) if found else "left out"


def ending(of: Diagnosis, died: Mapping[str, str], file: str) -> Diagnosis:
    """A diagnosis with what its failed rules say: the clinic's own mistake, or nothing where the engine ended."""
    ends = [_end(rule, said, file) for rule, said in died.items()]
    causes, hints = ([each for each in ends if each.level == level] for level in ("cause", "hint"))
    return replace(of, causes=(*causes, *of.causes), hints=(*hints, *of.hints))


def _end(rule: str, said: str, file: str) -> Finding:
    """How the trial of a rule on a model file ended: too late, by a mistake, or with the engine."""
    if said == LATE:
        says = f"{rule} gave no answer in time: whether it finds something is not known."
        return remark(LATE, "A rule takes too long", says, file)
    if said == KILLED:
        says = f"The system ended the process while {rule} was tried, as it does where memory runs out."
        return remark(KILLED, "A rule was ended by the system", says, file)
    if said:
        says = f"{rule} failed ({said}): a mistake of the clinic, not of the model."
        return remark(FAILS, "A rule failed", says, file)
    says = f"MuJoCo ended while {rule} was tried on this model."
    return remark(DIES, "The engine does not survive the model", says, file, level="cause")


def remark(rule: str, title: str, says: str, file: str, line: int | None = None, level: Level = "hint") -> Finding:
    """A finding of which no probe has a number."""
    return Finding(rule, title, level, (), file, line, "", "", "", (), "", "", 1.0, None, says, "")


def _cause(number: int, found: Finding) -> list[str]:
    where = f"{found.file}:{found.line}  " if found.line else ""
    now, value = shortened(found.now), shortened(found.value)
    change = f"{found.attribute} {now} -> {value}" if found.attribute else value
    after = "" if found.after is None else f" With the edit: {shown(found.after, found.unit)}."
    indent = "   "
    lines = [f"{number}  cause   {found.rule}  {where}{_elements(found.elements)}  {change}", f"{indent}{found.says}"]
    if found.probe and found.unit != "errors":
        begun = "" if found.keyframe is None else f", from keyframe {found.keyframe}"
        lines.append(f"{indent}{found.probe}{begun}: {shown(found.before, found.unit)}.{after}")
    if found.page:
        lines.append(f"{indent}{found.page}")
    return lines


def _tried(ids: Sequence[str], every: bool) -> str:
    """How many rules found nothing, with their names, or, where they are many, with what they are about."""
    count = f"{len(ids)} rule{'s' * (len(ids) > 1)}"
    if every or len(ids) <= FEW:
        return f"{count}: {', '.join(ids)}"
    areas = Counter(rules()[each].area for each in ids)
    return f"{count} ({', '.join(f'{area} {number}' for area, number in areas.most_common())}; --all names them)"


def _edited(hint: Finding) -> str:
    """What a hint's edit does to its symptom, where it mends it."""
    if hint.after is None:
        return ""
    numbers = " -> ".join(shown(value, hint.unit) for value in (hint.before, hint.after))
    change = " -> ".join(shortened(each) for each in (hint.now, hint.value) if each)
    edited = f"With {hint.attribute} {change}" if change else f"Without {hint.attribute}"
    return f" {edited}, {hint.probe}: {numbers}."


def _elements(elements: Sequence[str]) -> str:
    more = f" and {len(elements) - 3} more" if len(elements) > 3 else ""
    return ", ".join(elements[:3]) + more


def shortened(value: str) -> str:
    """What a terminal can show of a value: its beginning, where it is long."""
    return value if len(value) <= LONG else f"{value[:LONG]}... ({len(value)} characters)"


def shown(value: float, unit: str) -> str:
    """A number of three digits with its unit."""
    if not math.isfinite(value):
        return "beyond all bounds"
    return spoken(f"{value if abs(value) > NOISE else 0:.3g} {unit}").rstrip()
