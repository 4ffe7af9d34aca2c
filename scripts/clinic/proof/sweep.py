"""A sweep: the model's parameters varied, an outcome measured at every point, predictions held against it."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from pydantic import BaseModel, ConfigDict

from clinic.engine.checks import take
from clinic.engine.measure import measure_model, measure_output
from clinic.engine.script import ScriptError, run_script
from clinic.engine.simulate import compile_model
from clinic.engine.variant import Variant, apply_edits, variants
from clinic.record.case import Case
from clinic.record.expression import ExpressionError, evaluate, names, parse
from clinic.record.fields import ExpressionSignal, PathSignal, Record
from clinic.record.parts import Edit
from clinic.record.predictions import MODEL_NUMBERS
from clinic.record.problem import CaseError
from clinic.record.sweep import Parameter, Prediction, Rival, Side, Sweep
from clinic.record.yaml_lines import Where


class Plain(BaseModel):
    """Frozen data without unknown fields."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Point(Plain):
    """One point: the parameters, the outcome, and what each prediction said, by `prediction` or the rival's id."""

    at: dict[str, float]
    outcome: float | None
    holds: bool | None
    predicted: dict[str, float | None]


class Agreement(Plain):
    """How a prediction fared.

    Attributes:
        judged: How many points were judged.
        wrong: How many of them it misses by more than `within`, or, for a yes or no, gets wrong.
        worst: Its largest error over the judged points; None for a yes or no.
        good_from: The smallest first parameter from which on it is never wrong; None if there is none.
        unit: The unit of `worst`; empty where it is a share.
    """

    judged: int
    wrong: int
    worst: float | None
    good_from: float | None
    unit: str = ""


class SweepEvidence(Plain):
    """All points of a sweep and how its predictions fared.

    Attributes:
        marks: The parameters of the broken variant and of fixes that lie in the sweep, by variant.
    """

    points: list[Point]
    agreement: dict[str, Agreement]
    marks: dict[str, dict[str, float]]


def numbers(parameter: Parameter) -> list[float]:
    """The parameter's values, increasing."""
    if parameter.values:
        return sorted(parameter.values)
    assert parameter.start is not None
    assert parameter.stop is not None
    assert parameter.count is not None
    spaced = np.geomspace if parameter.scale == "log" else np.linspace
    return [float(f"{value:.12g}") for value in spaced(parameter.start, parameter.stop, parameter.count)]


def grid(sweep: Sweep) -> list[dict[str, float]]:
    """Every combination of the parameters' values, the last parameter changing fastest."""
    columns = [numbers(parameter) for parameter in sweep.vary]
    keys = [parameter.name for parameter in sweep.vary]
    return [dict(zip(keys, values, strict=True)) for values in itertools.product(*columns)]


def substituted(text: str, sweep: Sweep, at: Mapping[str, float]) -> str:
    """The base text with every parameter's number written in.

    Raises:
        EditError: If a parameter's `find` does not occur exactly once.
    """
    edits = [*sweep.edits] + [
        Edit.model_construct(find=p.find, replace=p.replace.replace("{}", f"{at[p.name]:.12g}")) for p in sweep.vary
    ]
    return apply_edits(text, edits)


def measure_points(case: Case, sweep: Sweep, points: Sequence[Mapping[str, float]]) -> list[Point]:
    """The outcome and the predictions at each of the points.

    Raises:
        CaseError: If a point's script does not end well, or a prediction cannot be computed there.
        EditError, ValueError: If a point's text cannot be made or compiled.
    """
    base = next(variant for variant in variants(case) if variant.id == sweep.base)
    return [_attempt(case, sweep, base, dict(at)) for at in points]


def summarise(case: Case, sweep: Sweep, points: Sequence[Point]) -> SweepEvidence:
    """The points with every prediction's agreement and the variants' marks."""
    predictions: dict[str, Prediction] = {"prediction": sweep.prediction, **{r.id: r for r in sweep.rivals}}
    unit = "s" if sweep.outcome.take == "onset" else case.record.signals[sweep.outcome.signal].unit
    return SweepEvidence(
        points=list(points),
        agreement={key: agreement(sweep, form, key, points, unit=unit) for key, form in predictions.items()},
        marks=marks(case, sweep),
    )


def agreement(
    sweep: Sweep, prediction: Prediction, key: str, points: Sequence[Point], factor: float = 1.0, unit: str = ""
) -> Agreement:
    """How the prediction, multiplied by `factor`, fares against the points; `unit` is the outcome's."""
    first = sweep.vary[0].name
    errors = [(point.at[first], error) for point, error in _errors(sweep, prediction, key, points, factor)]
    bad = [at for at, error in errors if error > prediction.within]
    good = sorted({at for at, _ in errors if not bad or at > max(bad)})
    finite = [error for _, error in errors if math.isfinite(error)]
    return Agreement(
        judged=len(errors),
        wrong=len(bad),
        worst=max(finite, default=None) if sweep.holds is None else None,
        good_from=good[0] if good else None,
        unit="" if prediction.relative else unit,
    )


def misses(sweep: Sweep, prediction: Prediction, key: str, points: Sequence[Point]) -> list[tuple[Point, float]]:
    """The points that the prediction misses, each with its error; infinite where a yes or no is wrong."""
    errors = _errors(sweep, prediction, key, points)
    return [(point, error) for point, error in errors if error > prediction.within]


def marks(case: Case, sweep: Sweep) -> dict[str, dict[str, float]]:
    """Where the broken variant and the fixes stand: where the record says so, or the sweep has the variant's text."""
    made = {}
    texts = {variant.id: variant.text for variant in variants(case)}
    for variant in variants(case):
        at = {p.name: value for p in sweep.vary if (value := _mark(p, variant)) is not None}
        if variant.kind == "refuted" or len(at) < len(sweep.vary):
            continue
        told = any(variant.id in parameter.marks for parameter in sweep.vary)
        if told or _shape(substituted(texts[sweep.base], sweep, at), sweep) == _shape(variant.text, sweep):
            made[variant.id] = at
    return made


def names_read(record: Record, prediction: Prediction) -> tuple[set[str], set[str], set[str]]:
    """The names a prediction reads: signals, model numbers, and those left over."""
    read = names(parse(prediction.expr))
    signals = {n for n in read if isinstance(record.signals.get(n), PathSignal | ExpressionSignal)}
    return signals, read & MODEL_NUMBERS.keys() - signals, read - signals - MODEL_NUMBERS.keys()


def asked_of(sweep: Sweep) -> set[str]:
    """The names that a sweep's outcome and predictions read."""
    return {sweep.outcome.signal}.union(*(names(parse(form.expr)) for form in (sweep.prediction, *sweep.rivals)))


def _errors(
    sweep: Sweep, prediction: Prediction, key: str, points: Sequence[Point], factor: float = 1.0
) -> Iterator[tuple[Point, float]]:
    """The error at every point that is judged."""
    first = sweep.vary[0].name
    low, high = prediction.over or (-math.inf, math.inf)
    for point in points:
        predicted = point.predicted[key]
        if predicted is None or not low <= point.at[first] <= high:
            continue
        predicted *= factor
        if sweep.holds is None:
            error = math.inf if point.outcome is None else abs(point.outcome - predicted)
            yield point, error / abs(predicted) if prediction.relative and predicted else error
        elif abs(point.at[first] / predicted - 1) > prediction.within:
            yes = point.at[first] < predicted if sweep.side == "below" else point.at[first] > predicted
            yield point, 0.0 if yes == point.holds else math.inf


def _attempt(case: Case, sweep: Sweep, base: Variant, at: dict[str, float]) -> Point:
    try:
        return _measure(case, sweep, base, at)
    except ScriptError as error:
        point = ", ".join(f"{key} = {value:g}" for key, value in at.items())
        found = f"at {point}: {error.found}"
        raise CaseError(
            [case.problem(_place(case, sweep), found, "a script that ends by itself", error.repair)]
        ) from None


def _measure(case: Case, sweep: Sweep, base: Variant, at: dict[str, float]) -> Point:
    record, text = case.record, substituted(base.text, sweep, at)
    predictions: dict[str, Prediction | Rival] = {"prediction": sweep.prediction, **{r.id: r for r in sweep.rivals}}
    needed = {key: names_read(record, prediction) for key, prediction in predictions.items()}
    signals = {sweep.outcome.signal}.union(*(names for names, _, _ in needed.values()))
    values: dict[str, float] = {}
    if record.run is not None:
        model = compile_model(text)
        spec = record.run.model_copy(update={"duration": sweep.duration} if sweep.duration else {})
        _, traces = measure_model(record, model, spec, signals, last=sweep.outcome.last)
        values = {n: MODEL_NUMBERS[n](model) for n in set().union(*(numbers for _, numbers, _ in needed.values()))}
    else:
        traces = measure_output(record, run_script(text, case.texts, name=record.source))
    values |= {name: take(traces[name], "final") for name in signals} | at
    outcome = take(traces[sweep.outcome.signal], sweep.outcome.take, sweep.outcome.window)
    predicted = {key: _predicted(case, sweep, key, form, values) for key, form in predictions.items()}
    return Point(
        at=at,
        outcome=outcome if math.isfinite(outcome) else None,
        holds=None if sweep.holds is None else _holds(sweep.holds, outcome),
        predicted={key: value if math.isfinite(value) else None for key, value in predicted.items()},
    )


def _predicted(case: Case, sweep: Sweep, key: str, form: Prediction, values: Mapping[str, float]) -> float:
    try:
        with np.errstate(all="ignore"):
            return float(evaluate(parse(form.expr), values))
    except ExpressionError as error:
        part: Where = ("prediction",)
        if key != "prediction":
            part = ("rivals", [rival.id for rival in sweep.rivals].index(key))
        given = ", ".join(f"{read} = {values[read]:g}" for read in sorted(names(parse(form.expr))))
        found = form.expr + (f" with {given}" if given else "")
        repair = "correct the expression"
        raise CaseError([case.problem((*_place(case, sweep), *part, "expr"), found, str(error), repair)]) from None


def _place(case: Case, sweep: Sweep) -> Where:
    """Where the sweep stands in the record."""
    return "sweep", next(name for name, other in case.record.sweep.items() if other is sweep)


def _holds(side: Side, outcome: float) -> bool:
    if side.above is not None:
        return outcome > side.above
    assert side.below is not None
    return outcome < side.below


def _mark(parameter: Parameter, variant: Variant) -> float | None:
    if variant.id in parameter.marks:
        return parameter.marks[variant.id]
    found = set(_written(parameter).findall(variant.text))
    return float(found.pop()) if len(found) == 1 else None


def _written(parameter: Parameter) -> re.Pattern[str]:
    """The text that a parameter's number is written in, the same number wherever it occurs in it."""
    first, *rest = (re.escape(part) for part in parameter.replace.split("{}"))
    return re.compile(first + r"([-+0-9.eE]+)" + r"\1".join(rest))


def _shape(text: str, sweep: Sweep) -> str:
    """The text without the parameters' numbers."""
    for parameter in sweep.vary:
        text = _written(parameter).sub(parameter.name, text)
    return text
