"""The rules measured: what they name on healthy models and on planted faults, as plain data."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

import mujoco

from clinic.diagnosis.bench.faults import Kind, kinds
from clinic.diagnosis.bench.healthy import Healthy, survey
from clinic.diagnosis.bench.trial import Plant, Told, diagnose_healthy, plant_one
from clinic.diagnosis.rules import rules
from clinic.work.cache import Cache, key_of
from clinic.work.parallel import parallel

MOST_DOFS = 64  # of a model that faults are planted in; a larger one takes minutes to measure the harm
SIDES = {"seen": False, "held_out": True}
SIDE = {out: side for side, out in SIDES.items()}
OUTCOMES = ("cause", "later", "hint", "missed")


@dataclass(frozen=True)
class Task:
    """A healthy model to diagnose, or a kind of fault to plant for the n-th time in the models of a side."""

    models: tuple[Healthy, ...]
    kind: str = ""
    seed: int = 0
    number: int = 0

    @property
    def key(self) -> str:
        """Where its result is kept."""
        files = [[model.name, Path(model.path).stat().st_size] for model in self.models]
        return key_of("bench", self.kind, self.seed, self.number, files, of="diagnosis")

    def run(self) -> dict[str, Any] | None:
        """The result as data; None where no model has a place for the fault."""
        if self.kind:
            return plant_one(self.models, self.kind, self.seed, self.number)
        return diagnose_healthy(self.models[0])


@dataclass
class Bench:
    """What was measured: healthy models with what was told of them, plants, and kinds that found no place."""

    seed: int
    healthy: list[tuple[Healthy, Told]]
    plants: list[Plant]
    no_place: list[tuple[str, bool, int]]
    left_out: dict[str, str]
    engine: str = mujoco.__version__

    def longest(self, rule: str) -> float:
        """The longest that a rule took in one model, in s."""
        return max((told.seconds[rule] for told in _all(self) if rule in told.seconds), default=0.0)


def tasks(models: Sequence[Healthy], seed: int, plants: int, held_out: bool = True) -> list[Task]:
    """All of it: every healthy model, and every kind of fault planted so often on each side."""
    made = [Task((model,)) for model in models if held_out or not model.held_out]
    for side in SIDES.values() if held_out else (False,):
        hosts = tuple(model for model in models if model.held_out == side and model.dofs <= MOST_DOFS)
        made += [Task(hosts, kind, seed, number) for kind in kinds() for number in range(plants) if hosts]
    return made


def measure(
    root: Path,
    cache: Cache,
    choose: Callable[[list[Healthy]], list[Task]],
    seed: int = 0,
    tell: Callable[[int, int], None] = print,
) -> Bench:
    """Runs what is chosen of the tasks, in parallel; what was run before with these rules is kept.

    Args:
        root: The checkout, with the healthy models in it.
        cache: Where results are kept.
        choose: Gives the tasks for the healthy models; `tasks` gives all.
        seed: Of the plants; it is told with the results.
        tell: Is called with how many are done, of how many.

    Raises:
        MissingRequirementError: If the healthy models are not there.
    """
    models, left_out = survey(root, cache)
    chosen = choose(models)
    made = Bench(seed, [], [], [], left_out)
    for task, result in sorted(_results(chosen, cache, tell), key=lambda pair: chosen.index(pair[0])):
        if not task.kind:
            assert result is not None
            made.healthy.append((task.models[0], Told(**result)))
        elif result is None:
            made.no_place.append((task.kind, task.models[0].held_out, task.number))
        else:
            made.plants.append(Plant(**{**result, "told": Told(**result["told"]), "number": task.number}))
    return made


def _results(
    chosen: Sequence[Task], cache: Cache, tell: Callable[[int, int], None]
) -> Iterator[tuple[Task, dict[str, Any] | None]]:
    left = []
    for task in chosen:
        if (files := cache.get(task.key)) is not None:
            yield task, json.loads(files["result.json"])
        else:
            left.append(task)
    for task, result in parallel(_run, [(task,) for task in left]):
        cache.put(task.key, {"result.json": json.dumps(result).encode()})
        left.remove(task)
        tell(len(chosen) - len(left), len(chosen))
        yield task, result


def _run(task: Task) -> tuple[Task, dict[str, Any] | None]:
    return task, task.run()


def data(bench: Bench) -> dict[str, Any]:
    """The whole table, as JSON has it. Seconds are those of the machine that ran it; all else is the same anywhere."""
    own = {model.name: false(model, told) for model, told in bench.healthy}
    return {
        "engine": bench.engine,
        "seed": bench.seed,
        "healthy": {
            side: _healthy([pair for pair in bench.healthy if pair[0].held_out == out]) for side, out in SIDES.items()
        },
        "planted": {
            side: _counts(plant for plant in bench.plants if plant.held_out == out) for side, out in SIDES.items()
        },
        "rules": [_rule(bench, rule, own) for rule in rules()],
        "kinds": [_kind(bench, kind, own) for kind in kinds().values()],
        "models": {
            model.name: {"held_out": model.held_out, "causes": false(model, told), "hints": told.rules("hint")}
            for model, told in bench.healthy
        },
        "left_out": bench.left_out,
        "untried": sorted({model.name for model, told in bench.healthy if told.untried}),
        "stumbled": sorted({said for told in _all(bench) for said in told.stumbled}),
    }


def plants_text(bench: Bench) -> str:
    """The plants that do harm, a line of JSON each: what is wrong where, and the patch of the healthy model."""
    lines = []
    for plant in bench.plants:
        if plant.harm:
            truth: dict[str, Any] = {"id": f"{plant.kind}-{SIDE[plant.held_out]}-{plant.number}", "model": plant.model}
            truth |= {name: getattr(plant, name) for name in ("kind", "elements", "attribute", "strength", "harm")}
            truth |= {"rules": list(kinds()[plant.kind].rules), "found": plant.outcome, "patch": plant.patch}
            lines.append(json.dumps(truth, ensure_ascii=False) + "\n")
    return "".join(lines)


def _all(bench: Bench) -> list[Told]:
    return [*(told for _, told in bench.healthy), *(plant.told for plant in bench.plants)]


def false(model: Healthy, told: Told) -> list[str]:
    """The rules that name a cause in a healthy model, but for the faults that it is known to have."""
    return [rule for rule in told.rules("cause") if rule not in model.known]


def _healthy(told: Sequence[tuple[Healthy, Told]]) -> dict[str, Any]:
    counts = [len(each.findings) for _, each in told]
    named = sum(1 for model, each in told if false(model, each))
    return {"models": len(told), "with_a_cause": named, "median_findings": median(counts) if counts else 0}


def _counts(plants: Iterable[Plant]) -> dict[str, int]:
    all_ = list(plants)
    harmful = Counter(plant.outcome for plant in all_ if plant.harm)
    return {
        "harmful": sum(harmful.values()),
        **{name: harmful[name] for name in OUTCOMES},
        "harmless": sum(plant.harmless + (not plant.harm) for plant in all_),
    }


def _rule(bench: Bench, rule: str, own: dict[str, list[str]]) -> dict[str, Any]:
    by_it = {name for name, kind in kinds().items() if kind.rules[0] == rule}
    sides = {
        side: _counts(plant for plant in bench.plants if plant.kind in by_it and plant.held_out == out)
        for side, out in SIDES.items()
    }
    return {
        "rule": rule,
        "kinds": sorted(by_it),
        **sides,
        "false": [model for model, named in own.items() if rule in named],
        "beside": sum(beside(plant, own)[rule] for plant in bench.plants),
        "seconds": round(bench.longest(rule), 3),
    }


def _kind(bench: Bench, kind: Kind, own: dict[str, list[str]]) -> dict[str, Any]:
    planted = [plant for plant in bench.plants if plant.kind == kind.name]
    others = sum((beside(plant, own) for plant in planted), Counter[str]())
    return {
        "kind": kind.name,
        "text": kind.text,
        "rule": kind.rules[0],
        **{side: _counts(plant for plant in planted if plant.held_out == out) for side, out in SIDES.items()},
        "no_place": sum(name == kind.name for name, _, _ in bench.no_place),
        "beside": dict(others.most_common()),
    }


def beside(plant: Plant, own: dict[str, list[str]]) -> Counter[str]:
    """The causes named on a plant that are not the fault, and that the healthy model does not get anyway."""
    right = {each["rule"] for each in plant.told.findings if each["right"]}
    return Counter(
        rule for rule in plant.told.rules("cause") if rule not in right and rule not in own.get(plant.model, ())
    )
