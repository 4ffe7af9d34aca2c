"""What the bench measured, kept in a lock file, and the law that it gives: a cause is found, or it is a hint."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pydantic import Field

from clinic.diagnosis.bench.faults import kinds
from clinic.diagnosis.bench.table import SIDES, Bench, beside, false
from clinic.diagnosis.rules import Rule, rules
from clinic.record.parts import Strict

LOCK = "bench.lock.json"
LETTERS = {"cause": "c", "later": "l", "hint": "h", "missed": "m"}
HARMLESS, NO_PLACE = "-", "."
LEAST, ENOUGH = 0.8, 3  # of the harmful plants, of which there are so many
FURTHER = 0.35  # as far may the held-out share be below that of the models that were looked at, of FEW plants and more
FEW = 4
MEND = "`clinic bench-rules --write` measures it anew; commit bench.lock.json"


class KindKept(Strict):
    """What became of the plants of a kind.

    Attributes:
        rule: The rule that it measures.
        seen: A letter for each plant in the models that rules are made with: `LETTERS`, HARMLESS or NO_PLACE.
        held_out: The same in those that no rule is made with.
        beside: Other rules that were named a cause on its plants, and how often.
    """

    rule: str
    seen: str
    held_out: str
    beside: dict[str, int] = Field(default={})


class Kept(Strict):
    """The lock file.

    Attributes:
        engine: The release of MuJoCo.
        seed: Of the plants.
        healthy: How many healthy models there are, by side.
        false: The rules that name a cause in a healthy model, by model.
        seconds: The longest that a rule took in one model, on the machine that ran it.
        kinds: By name.
    """

    engine: str = ""
    seed: int = 0
    healthy: dict[str, int] = Field(default={})
    false: dict[str, list[str]] = Field(default={})
    seconds: dict[str, float] = Field(default={})
    kinds: dict[str, KindKept] = Field(default={})


@dataclass(frozen=True)
class Score:
    """How a rule does.

    Attributes:
        plants: Faults planted for it.
        harmful: Those that measurably harm the model.
        found: Those named as a cause among the first three.
        told: Those named as a cause further down, or as a hint.
        seen: Found, and harmful, in the models that rules are made with.
        held_out: The same in those that no rule is made with.
        false: The healthy models in which it names a cause.
        beside: How often it is named a cause beside another fault.
    """

    plants: int
    harmful: int
    found: int
    told: int
    seen: tuple[int, int]
    held_out: tuple[int, int]
    false: tuple[str, ...]
    beside: int

    @property
    def share(self) -> float:
        """Of the harmful plants, found."""
        return self.found / self.harmful if self.harmful else 0.0


def kept(bench: Bench, plants: int) -> Kept:
    """A measurement as the lock has it, of so many plants of each kind on each side."""
    letters = dict.fromkeys(bench.no_place, NO_PLACE)
    letters |= {
        (plant.kind, plant.held_out, plant.number): LETTERS[plant.outcome] if plant.harm else HARMLESS
        for plant in bench.plants
    }
    own = {model.name: false(model, told) for model, told in bench.healthy}
    made = {}
    for kind in kinds().values():
        row = {
            side: "".join(letters.get((kind.name, out, n), "") for n in range(plants)) for side, out in SIDES.items()
        }
        if any(row.values()):
            others = sum((beside(plant, own) for plant in bench.plants if plant.kind == kind.name), Counter[str]())
            made[kind.name] = KindKept(rule=kind.rules[0], beside=dict(others.most_common()), **row)
    return Kept(
        engine=bench.engine,
        seed=bench.seed,
        healthy={side: sum(model.held_out == out for model, _ in bench.healthy) for side, out in SIDES.items()},
        false={name: found for name, found in own.items() if found},
        seconds={name: round(bench.longest(name), 2) for name in rules()},
        kinds=made,
    )


def with_kinds(old: Kept, new: Kept) -> Kept:
    """A lock with the kinds of a later measurement, and what it says of all else."""
    kept_kinds = {name: row for name, row in (old.kinds | new.kinds).items() if name in kinds()}
    seconds = {name: max(old.seconds.get(name, 0.0), value) for name, value in new.seconds.items()}
    return old.model_copy(update={"kinds": kept_kinds, "seconds": seconds})


def read_lock(root: Path) -> Kept:
    """The lock file of a checkout; empty where there is none.

    Raises:
        ValueError: If it is not one.
    """
    path = root / LOCK
    return Kept.model_validate_json(path.read_bytes()) if path.is_file() else Kept()


def lock_text(of: Kept) -> str:
    """The lock file's text, with a line for each kind and each rule, so that a difference shows where it is."""
    lines = []
    for name, value in json.loads(of.model_dump_json()).items():
        if isinstance(value, dict) and value:
            inner = [f"  {json.dumps(key)}: {json.dumps(value[key])}" for key in sorted(value)]
            lines.append(f" {json.dumps(name)}: {{\n" + ",\n".join(inner) + "\n }")
        else:
            lines.append(f" {json.dumps(name)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def score(of: Kept, rule: str) -> Score:
    """How a rule does on the faults that are planted for it."""
    rows = [row for row in of.kinds.values() if row.rule == rule]
    sides = [Counter("".join(getattr(row, side) for row in rows)) for side in SIDES]
    pairs = [(side["c"], sum(side[letter] for letter in LETTERS.values())) for side in sides]
    all_ = sides[0] + sides[1]
    return Score(
        plants=sum(all_.values()) - all_[NO_PLACE],
        harmful=pairs[0][1] + pairs[1][1],
        found=pairs[0][0] + pairs[1][0],
        told=all_["l"] + all_["h"],
        seen=pairs[0],
        held_out=pairs[1],
        false=tuple(sorted(name for name, found in of.false.items() if rule in found)),
        beside=sum(row.beside.get(rule, 0) for row in of.kinds.values()),
    )


def unlawful(of: Kept) -> Iterator[str]:
    """The rules that are called causes and are not found often enough, and those that nothing is planted for."""
    for rule in rules().values():
        yield from (f"{rule.id}: {said}" for said in _unlawful(rule, score(of, rule.id)))


def _unlawful(rule: Rule, found: Score) -> Iterator[str]:
    planted = any(kind.rules[0] == rule.id for kind in kinds().values())
    if planted and rule.unplanted:
        yield "faults are planted for it, and UNPLANTED in its module says why not: take that out"
    if not planted and not rule.unplanted:
        yield "no fault is planted for it: plant some in bench/faults, or say why not as UNPLANTED in its module"
    if not planted or rule.level == "hint":
        return
    if found.harmful < ENOUGH:
        yield f'{found.harmful} harmful faults are planted for it, {ENOUGH} are needed: LEVEL = "hint" in its module'
    elif found.share < LEAST and found.harmful - found.found > 1:  # of three or four, one may be missed
        yield (
            f"it finds {found.found} of {found.harmful} harmful faults, a cause finds {LEAST:.0%}: "
            'mend it, or LEVEL = "hint" in its module'
        )
    (seen, of_seen), (held_out, of_held_out) = found.seen, found.held_out
    if min(of_seen, of_held_out) >= FEW and held_out / of_held_out < seen / of_seen - FURTHER:
        yield (
            f"it finds {held_out} of {of_held_out} faults in held-out models, and {seen} of {of_seen} in those that "
            "it was made with: it knows those models"
        )


def stale(of: Kept) -> Iterator[str]:
    """What the lock does not know, or knows otherwise than the code has it."""
    now = {kind.name: kind.rules[0] for kind in kinds().values()}
    for name in sorted(now.keys() ^ of.kinds.keys()):
        yield f"the kind {name} is in {'the code' if name in now else LOCK} alone: {MEND}"
    for name in sorted(now.keys() & of.kinds.keys()):
        if now[name] != of.kinds[name].rule:
            yield f"{name} measures {now[name]}, and {LOCK} has {of.kinds[name].rule}: {MEND}"
    for name in sorted(rules().keys() ^ of.seconds.keys()):
        yield f"the rule {name} is in {'the code' if name in rules() else LOCK} alone: {MEND}"


def differing(of: Kept, bench: Bench) -> Iterator[str]:
    """What a measurement of some of it says otherwise than the lock."""
    for plant in bench.plants:
        row = of.kinds.get(plant.kind)
        known = (row.held_out if plant.held_out else row.seen) if row else ""
        letter = LETTERS[plant.outcome] if plant.harm else HARMLESS
        if known[plant.number : plant.number + 1] != letter:
            words = {each: word for word, each in LETTERS.items()} | {HARMLESS: "harmless"}
            was = words.get(known[plant.number : plant.number + 1], "nothing")
            where = f"plant {plant.number} of {plant.kind} in {plant.model}"
            yield f"{where}: {LOCK} has {was}, it is {words[letter]}: {MEND}"
    for model, told in bench.healthy:
        if sorted(false(model, told)) != sorted(of.false.get(model.name, [])):
            yield (
                f"{model.name} is healthy: {LOCK} has {of.false.get(model.name, [])} as its causes, "
                f"it is {false(model, told)}: {MEND}"
            )
