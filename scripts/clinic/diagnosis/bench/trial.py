"""One healthy model, or one fault planted in it, diagnosed; what is told is compared with what is true."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from difflib import SequenceMatcher
from functools import lru_cache
from pathlib import Path
from random import Random
from time import perf_counter
from typing import Any

from clinic.diagnosis.bench.behaviour import Behaviour
from clinic.diagnosis.bench.faults import DOES_NOT_COMPILE, Fault, Kind, kinds
from clinic.diagnosis.bench.faults.servo import with_servos
from clinic.diagnosis.bench.faults.twins import TWINS
from clinic.diagnosis.bench.harm import HARMS
from clinic.diagnosis.bench.healthy import Healthy
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.edit import apply, diff
from clinic.diagnosis.finding import Finding
from clinic.diagnosis.native import NativeEngine, NativeModel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.source import Source
from clinic.diagnosis.start import Start
from clinic.diagnosis.texts import read_file, read_texts

ATTEMPTS = 8  # models tried for a plant that does harm
STRIDE = 4  # robots from one plant of a kind to the next
NAMED_FIRST = 3  # causes that a reader looks at


@dataclass
class Told:
    """What a diagnosis said: its findings, the time each rule took in s, rules that stumbled, rules left untried.

    A finding is its rule, its level, its first element and, for a plant, whether it is right.
    """

    findings: list[dict[str, Any]] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)
    stumbled: list[str] = field(default_factory=list)
    untried: list[str] = field(default_factory=list)

    def rules(self, level: str) -> list[str]:
        """The rules with a finding of that level, each once."""
        return list(dict.fromkeys(each["rule"] for each in self.findings if each["level"] == level))


@dataclass
class Plant:
    """A fault planted in a healthy model.

    Attributes:
        kind: What was planted.
        model: Where.
        held_out: Whether that model is one of those that no rule was made with.
        elements: What it is about, as findings name it.
        attribute: The attribute that is wrong.
        strength: How much, as the kind counts it.
        harm: The name of the first harm that is measured; empty where none is measured: then it is not diagnosed.
        harmless: How many plants of this kind, in other models or strengths, did no harm before this one.
        told: What was found.
        patch: What was changed in the healthy model's text, as a unified diff.
        number: Which plant of its kind and side it is.
    """

    kind: str
    model: str
    held_out: bool
    elements: list[str]
    attribute: str
    strength: float
    harm: str
    harmless: int
    told: Told
    patch: str = ""
    number: int = 0

    @property
    def outcome(self) -> str:
        """How it was found: as a cause among the first three, as a later cause, as a hint, or not at all."""
        for name, level, among in (("cause", "cause", NAMED_FIRST), ("later", "cause", None), ("hint", "hint", None)):
            if any(each["right"] for each in [f for f in self.told.findings if f["level"] == level][:among]):
                return name
        return "missed"


@dataclass
class Host:
    """A healthy model ready for planting."""

    texts: dict[str, str]
    model: ReaderModel
    behaviour: Behaviour


def diagnose_healthy(model: Healthy) -> dict[str, Any]:
    """What is told of a healthy model, as data."""
    with _inside(model):
        return asdict(_diagnosed(_texts(model)))


def plant_one(models: Sequence[Healthy], kind_name: str, seed: int, number: int) -> dict[str, Any] | None:
    """The first of up to ATTEMPTS plants of a kind that does harm, diagnosed, as data; the last, if none does.

    Robots are as likely as each other, however many models a package has of one. None where no model has a place.
    """
    kind, made, harmless = kinds()[kind_name], None, 0
    for model in _drawn(models, Random(f"{seed} {kind_name}"), number):
        if harmless == ATTEMPTS:
            break
        with _inside(model):
            tried = _planted(model, kind, Random(f"{seed} {kind_name} {number} {model.name}"), harmless)
        if tried is not None:
            made, harmless = tried, harmless + 1
            if tried.harm:
                break
    return asdict(made) if made else None


def _drawn(models: Sequence[Healthy], random: Random, number: int) -> list[Healthy]:
    """A model of each robot; the n-th plant begins elsewhere in their order than the one before it."""
    robots: dict[str, list[Healthy]] = {}
    for model in models:
        robots.setdefault(model.robot, []).append(model)
    order = [random.choice(robots[name]) for name in random.sample(sorted(robots), len(robots))]
    begin = STRIDE * number % len(order)
    return order[begin:] + order[:begin]


def _planted(model: Healthy, kind: Kind, random: Random, harmless: int) -> Plant | None:
    host = _host(model, kind.servos)
    fault = kind.plant(host.model, random) if host else None
    if host is None or fault is None or not fault.edits:
        return None
    texts = apply(host.texts, fault.edits)
    now = ReaderModel(NativeEngine(), texts, None, Start())
    if kind.harms == DOES_NOT_COMPILE:
        harm = "does not compile" if now.error else ""
    elif now.error:
        return None
    else:
        behaviour = Behaviour(_compiled(now), host.behaviour)
        harm = next((name for name in kind.harms if HARMS[name](host.behaviour, behaviour) >= 1), "")
    told = _diagnosed(texts) if harm else Told()
    lines = _changed_lines(host.texts, texts)
    for finding in told.findings:
        finding["right"] = _right(finding, kind, fault, lines)
    return Plant(
        kind.name,
        model.name,
        model.held_out,
        list(fault.elements),
        fault.attribute,
        fault.strength,
        harm,
        harmless,
        told,
        diff(_texts(model), texts) if harm else "",
    )


def _right(finding: dict[str, Any], kind: Kind, fault: Fault, lines: set[tuple[str, int]]) -> bool:
    """Whether a finding names the fault: by one of its rules, its attribute or its twin, in the right place."""
    what = finding["rule"] in kind.rules or (fault.attribute and finding["attribute"] == fault.attribute)
    here = {tuple(line) for line in finding["lines"]} & lines or set(finding["elements"]) & set(fault.elements)
    return bool((what and not fault.elements) or (here and (what or finding["rule"] in TWINS)))


def _diagnosed(texts: Mapping[str, str]) -> Told:
    made, running, since = Told(), "", perf_counter()

    def tell(said: str) -> None:
        nonlocal running, since
        if said and said not in rules():
            made.stumbled.append(said)
            return
        if running:
            made.seconds[running] = made.seconds.get(running, 0.0) + perf_counter() - since
        running, since = said, perf_counter()

    try:
        found = examine(NativeEngine(), dict(texts), tell=tell, limit=math.inf)
    except Exception as error:  # a rule in the making leaves the others measurable
        made.stumbled.append(f"{running}: {type(error).__name__}: {error}")
        return made
    tell("")
    made.untried = [] if found.error else [rule for rule in found.ruled_out if rule not in made.seconds]
    made.findings = [_finding(each) for each in (*found.causes, *found.hints)]
    return made


def _finding(found: Finding) -> dict[str, Any]:
    lines = [(each.file, each.line) for each in found.edit] or [(found.file, found.line or 0)]
    kept = {"rule": found.rule, "level": found.level, "attribute": found.attribute, "elements": list(found.elements)}
    return {**kept, "lines": lines, "right": False}


def _changed_lines(before: Mapping[str, str], after: Mapping[str, str]) -> set[tuple[str, int]]:
    """The lines of the planted text that differ, and those beside a line that is gone."""
    made = set()
    for file, text in after.items():
        matcher = SequenceMatcher(None, before[file].splitlines(), text.splitlines(), autojunk=False)
        for what, _, _, first, last in matcher.get_opcodes() if before[file] != text else []:
            if what != "equal":
                made |= {(file, line) for line in range(first + (first < last), max(last, first + 1) + 1)}
    return made


@lru_cache(maxsize=12)
def _host(model: Healthy, servos: bool) -> Host | None:
    """The model as faults are planted in it; None where the core cannot read it."""
    engine, texts = NativeEngine(), _texts(model)
    made = ReaderModel(engine, texts, Source(texts), Start())
    if not made.error and servos and (edits := with_servos(made)):
        texts = apply(texts, edits)
        made = ReaderModel(engine, texts, Source(texts), Start())
    return None if made.error else Host(texts, made, Behaviour(_compiled(made)))


def _compiled(model: ReaderModel) -> Any:
    engine = model.simulation.engine
    assert isinstance(engine, NativeModel)
    return engine.mj


def _texts(model: Healthy) -> dict[str, str]:
    path = Path(model.path)
    return read_texts(path.read_text(encoding="utf-8"), path.name, read_file)


@contextmanager
def _inside(model: Healthy) -> Iterator[None]:
    """The model's folder as the current one, for what the text names is found from there."""
    before = Path.cwd()
    os.chdir(Path(model.path).parent)
    try:
        yield
    finally:
        os.chdir(before)
