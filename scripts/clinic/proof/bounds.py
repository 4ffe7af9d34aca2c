"""Laws of what a check, a trial and a sweep can tell: bounds near what is measured, situations that differ."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING, Literal

from clinic.engine.checks import expected, satisfies
from clinic.engine.variant import variants
from clinic.proof.trials import changed_numbers, checks_in, far
from clinic.record.case import Case
from clinic.record.expression import parse
from clinic.record.fields import Trial
from clinic.record.parts import Check
from clinic.record.problem import Problem
from clinic.record.sweep import Sweep
from clinic.record.yaml_lines import Where

if TYPE_CHECKING:
    from clinic.proof.evidence import Evidence, VariantEvidence
    from clinic.proof.sweep import Point

Kind = Literal["broken", "fixed"]
REACH = 12.0  # how many times the number that it admits a bound may be
BESIDE = 0.4  # the part of `within` by which an `equals` may differ from what is measured
SEEN = 0.01  # the share by which the outcome of a sweep changes
APART = 0.25  # the share of its range by which a mark's outcome may differ: a sweep may be shorter than the run
DISTINCT = 0.05  # the share by which numbers of broken and fixed differ, if they do
MOVED = 0.1  # the share by which a trial changes some number that is checked


def bounded(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 1, bounds. A check's bound is near some number that it admits, or parts broken from fixed.

    A bound that is far away and parts nothing admits whatever comes. An `equals` is what is measured, up to a part
    of its `within`, and that is a quarter of it at most.
    """
    for trial in (None, *case.record.trials):
        kinds: tuple[Kind, Kind] = ("broken", "fixed")
        for kind in kinds:
            if trial is not None and (trial.checks is None or getattr(trial.checks, kind) is None):
                continue
            for index, check in enumerate(getattr(checks_in(case.record, trial), kind)):
                admitted, _ = _numbers(evidence, trial, kind, index)
                if not admitted or (check.equals is None and _parts(evidence, trial, kind, index)):
                    continue
                where: Where = ("checks", kind, index)
                if trial is not None:
                    where = ("trials", case.record.trials.index(trial), "checks", kind, index)
                shown, found = _listed(admitted), f"{check.signal} ({check.take}) {expected(check)}"
                if all(_loose(check, measured) for measured in admitted):
                    yield case.problem(where, found, f"a bound near what it admits: {shown}", "tighten the bound")
                elif check.within and all(_beside(check, measured) for measured in admitted):
                    yield case.problem(where, found, f"what is measured: {shown}", "write that number")


def parting(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 1, ends of bounds. Where the broken variant and the fixes differ, a bound keeps off the other kind.

    Its end lies a quarter of the way from the other kind at least, or half of its number.
    """
    for trial in (None, *case.record.trials):
        kinds: tuple[Kind, Kind] = ("broken", "fixed")
        for kind in kinds:
            for index, check in enumerate(getattr(checks_in(case.record, trial), kind)):
                own, others = _numbers(evidence, trial, kind, index)
                for end, sign in _ends(check) if own and others else ():
                    farthest = max(own, key=lambda number: sign * number)
                    beyond = [
                        each for each in others if sign * (each - farthest) > DISTINCT * max(abs(each), abs(farthest))
                    ]
                    nearest = min(beyond, key=lambda number: sign * number, default=None)
                    if nearest is not None and sign * (nearest - end) < min(
                        abs(nearest - farthest) / 4, abs(nearest) / 2 or abs(end)
                    ):
                        place: Where = ("checks", kind, index)
                        if trial is not None:
                            place = ("trials", case.record.trials.index(trial))
                        found = f"{check.signal} ({check.take}) {expected(check)}, and the other kind has {nearest:.4g}"
                        wanted = f"an end between {farthest:.4g} and that, and not close to that"
                        yield case.problem(place, found, wanted, "tighten the bound")


def windowed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 1, windows. None spares the broken variant a check of `fixed` that repairs pass in the whole run."""
    fixes = [each for each in evidence.variants.values() if each.kind == "fix"]
    broken = [each for each in evidence.variants.values() if each.kind == "broken"]
    for index, check in enumerate(case.record.checks.fixed):
        if check.window is None or not fixes or not all(each.checks["fixed"][index].holds for each in broken):
            continue
        well, ill = ([_whole(each, check) for each in some] for some in (fixes, broken))
        if all(well) and not all(ill):
            found = f"{check.signal} ({check.take}) from {check.window[0]:g} to {check.window[1]:g} s, when all is well"
            wanted = "the whole run, in which the repairs hold it and the broken one does not"
            yield case.problem(("checks", "fixed", index), found, wanted, "remove the window")


def _whole(variant: VariantEvidence, check: Check) -> bool:
    """Whether a check holds without its window."""
    measured = variant.values[check.signal].get(check.take)
    return measured is not None and satisfies(check, measured)


def _ends(check: Check) -> Iterator[tuple[float, float]]:
    """The ends of a bound, each with its direction: 1 for the upper, -1 for the lower."""
    low, high = check.between or (check.above, check.below)
    if low is not None:
        yield low, -1.0
    if high is not None:
        yield high, 1.0


def _numbers(evidence: Evidence, trial: Trial | None, kind: Kind, index: int) -> tuple[list[float], list[float]]:
    """What a check measured in the variants that it should hold for, and in those of the other kind."""
    own: list[float] = []
    others: list[float] = []
    for each in evidence.variants.values():
        measured = (each.checks if trial is None else each.trials[trial.id])[kind][index].measured
        if measured is not None and each.kind != "refuted":
            (own if (each.kind == "fix") == (kind == "fixed") else others).append(measured)
    return own, others


def differing(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 7, trials. Each changes a number by a factor of two, or in sign, or else some number that is checked."""
    made = variants(case)
    for index, trial in enumerate(case.record.trials):
        moved = (
            case.record.run is not None and trial.duration is not None and far(case.record.run.duration, trial.duration)
        )
        moved = moved or any(far(*pair) for variant in made for pair in changed_numbers(case, variant.text, trial))
        if not moved and not any(_moved(variant, trial) for variant in evidence.variants.values()):
            wanted = "a number twice as large, of the other sign, or a check that measures something else"
            found = f"{trial.id}: as the run, to within {100 * MOVED:g} %"
            yield case.problem(("trials", index), found, wanted, "change the situation further, or remove the trial")


def varied(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """A sweep's outcome changes with each parameter that its prediction has."""
    for name, sweep in case.record.sweep.items():
        points = evidence.sweep[name].points
        told = {node.id for node in ast.walk(parse(sweep.prediction.expr)) if isinstance(node, ast.Name)}
        for index, parameter in enumerate(sweep.vary):
            if parameter.name in told and not any(
                _apart(sweep, a, b, parameter.name) for a, b in combinations(points, 2)
            ):
                found = f"{parameter.name}: the same outcome whatever it is"
                wanted = "points at which the outcome changes"
                yield case.problem(("sweep", name, "vary", index), found, wanted, "vary it further, or leave it out")


def marked(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """A variant that is marked in a sweep has the outcome that was measured there."""
    for name, sweep in case.record.sweep.items():
        found, take = evidence.sweep[name], sweep.outcome.take
        outcomes = [point.outcome for point in found.points if point.outcome is not None]
        if sweep.edits or sweep.duration is not None or not outcomes or sweep.outcome.window is not None:
            continue
        reach = APART * (max(outcomes) - min(outcomes))
        for variant, at in found.marks.items():
            own = evidence.variants[variant].values[sweep.outcome.signal].get(take)
            there = [point.outcome for point in found.points if point.at == at and point.outcome is not None]
            if own is not None and there and abs(there[0] - own) > reach:
                said = (
                    f"{variant} at {', '.join(f'{value:g}' for value in at.values())}, where {there[0]:.4g} is measured"
                )
                wanted = f"a place with the outcome of {variant}: {own:.4g}"
                yield case.problem(("sweep", name, "vary"), said, wanted, "correct `marks`")


def _parts(evidence: Evidence, trial: Trial | None, kind: Kind, index: int) -> bool:
    """Whether a check of one kind fails in a variant of the other."""
    others = [each for each in evidence.variants.values() if each.kind == ("fix" if kind == "broken" else "broken")]
    return any(not (each.checks if trial is None else each.trials[trial.id])[kind][index].holds for each in others)


def _loose(check: Check, measured: float) -> bool:
    """Whether the bound is far from a number: more than REACH times it, or less than its part; 0 is near to all."""
    size = abs(measured)
    if not size:
        return False
    if check.equals is not None:
        return (check.within or 0.0) > max(size, abs(check.equals)) / 4 and check.equals != 0
    low, high = check.between or (check.above, check.below)
    ends = [end for end in (low, high) if end is not None]
    return any(not size / REACH <= abs(end) <= size * REACH for end in ends)


def _beside(check: Check, measured: float) -> bool:
    """Whether a number is not the one that an `equals` names: further from it than BESIDE of its `within`."""
    return check.equals is not None and abs(measured - check.equals) > BESIDE * (check.within or 0.0)


def _listed(numbers: list[float]) -> str:
    return " and ".join(dict.fromkeys(f"{number:.4g}" for number in numbers))


def _moved(variant: VariantEvidence, trial: Trial) -> bool:
    """Whether a number that a trial checks differs from that of the run."""
    results = [result for kind in variant.trials[trial.id].values() for result in kind]
    pairs = [(variant.values[each.signal].get(each.take), each.measured) for each in results if each.window is None]
    return any(a is None or b is None or abs(a - b) > MOVED * max(abs(a), abs(b)) for a, b in pairs)


def _apart(sweep: Sweep, here: Point, there: Point, name: str) -> bool:
    """Whether two points differ in one parameter alone, and in the outcome by more than the sweep leaves open."""
    if [key for key in here.at if here.at[key] != there.at[key]] != [name]:
        return False
    if sweep.holds is not None or here.outcome is None or there.outcome is None:
        return here.holds != there.holds if sweep.holds is not None else here.outcome != there.outcome
    largest, within = max(abs(here.outcome), abs(there.outcome)), sweep.prediction.within
    return abs(here.outcome - there.outcome) > max(
        SEEN * largest, 2 * within * (largest if sweep.prediction.relative else 1)
    )
