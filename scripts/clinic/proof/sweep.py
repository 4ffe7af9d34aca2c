"""A sweep: the model's parameters varied, an outcome measured at every point, predictions held against it."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from clinic.engine.checks import Trace, satisfies, take
from clinic.engine.measure import measure_model, measure_output
from clinic.engine.script import run_script
from clinic.engine.simulate import compile_model
from clinic.engine.variant import EditError, Variant, apply_edits, variants
from clinic.record.case import Case
from clinic.record.expression import ExpressionError, evaluate, names, parse
from clinic.record.fields import Comparison
from clinic.record.parts import Edit, Strict
from clinic.record.predictions import MODEL_NUMBERS
from clinic.record.problem import CaseError
from clinic.record.sweep import Parameter, Prediction, Sweep
from clinic.record.yaml_lines import Where


class Point(Strict):
    """One point: the parameters, the outcome, and what each prediction said, by `prediction` or the rival's id."""

    at: dict[str, float]
    outcome: float | None
    holds: bool | None
    predicted: dict[str, float | None]


class Agreement(Strict):
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


class SweepEvidence(Strict):
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


def predictions(sweep: Sweep) -> dict[str, Prediction]:
    """The prediction, by `prediction`, then its rivals, by id."""
    return {"prediction": sweep.prediction, **{rival.id: rival for rival in sweep.rivals}}


def names_read(sweep: Sweep) -> set[str]:
    """The names that a sweep's outcome and predictions read."""
    return {sweep.outcome.signal}.union(*(names(parse(form.expr)) for form in predictions(sweep).values()))


def measure_points(case: Case, sweep: Sweep, points: Sequence[Mapping[str, float]]) -> list[Point]:
    """Measures the outcome and computes the predictions at each of the points.

    Raises:
        CaseError: If a point's text cannot be made or run, or a prediction cannot be computed there.
    """
    base = next(variant.text for variant in variants(case) if variant.id == sweep.base)
    return [_measure(case, sweep, base, dict(at)) for at in points]


def summarise(case: Case, sweep: Sweep, points: Sequence[Point]) -> SweepEvidence:
    """The points with every prediction's agreement and the variants' marks."""
    unit = "s" if sweep.outcome.take == "onset" else case.record.signals[sweep.outcome.signal].unit
    return SweepEvidence(
        points=list(points),
        agreement={key: agreement(sweep, key, points, unit=unit) for key in predictions(sweep)},
        marks=marks(case, sweep),
    )


def agreement(sweep: Sweep, key: str, points: Sequence[Point], factor: float = 1.0, unit: str = "") -> Agreement:
    """How a prediction, multiplied by `factor`, fares against the points; `unit` is the outcome's."""
    prediction, first = predictions(sweep)[key], sweep.vary[0].name
    errors = [(point.at[first], error) for point, error in errors_at(sweep, key, points, factor)]
    bad = [at for at, error in errors if error > prediction.within]
    finite = [error for _, error in errors if math.isfinite(error)]
    return Agreement(
        judged=len(errors),
        wrong=len(bad),
        worst=max(finite, default=None) if sweep.holds is None else None,
        good_from=min((at for at, _ in errors if at > max(bad, default=-math.inf)), default=None),
        unit="" if prediction.relative else unit,
    )


def errors_at(sweep: Sweep, key: str, points: Sequence[Point], factor: float = 1.0) -> Iterator[tuple[Point, float]]:
    """The error of a prediction, multiplied by `factor`, at every point that is judged.

    For a yes or no it is 0 where the answer is right, and infinite where it is wrong.
    """
    prediction, first = predictions(sweep)[key], sweep.vary[0].name
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


def marks(case: Case, sweep: Sweep) -> dict[str, dict[str, float]]:
    """Where the broken variant and the fixes stand: where the record says so, or the sweep has the variant's text."""
    made, texts = {}, {variant.id: variant.text for variant in variants(case)}
    for variant in variants(case):
        at = {p.name: value for p in sweep.vary if (value := _mark(p, variant)) is not None}
        if variant.kind != "refuted" and len(at) == len(sweep.vary):
            told = any(variant.id in parameter.marks for parameter in sweep.vary)
            if told or substituted(texts[sweep.base], sweep, at) == variant.text:
                made[variant.id] = at
    return made


def _measure(case: Case, sweep: Sweep, base: str, at: dict[str, float]) -> Point:
    try:
        traces, values = _run(case, sweep, substituted(base, sweep, at))
    except EditError as error:
        k = error.index - len(sweep.edits)
        place: Where = ("edits", error.index, "find") if k < 0 else ("vary", k, "find")
        found, expected = f"text that occurs {error.count} times in the text of {sweep.base}", "text that occurs once"
        raise _error(case, sweep, place, found, expected, "correct `find`") from None
    except ValueError as error:
        found = f"at {with_names(at)}: {' '.join(str(error).split())}"
        raise _error(case, sweep, ("vary",), found, "a text that runs to its end", "correct `replace`") from None
    values |= at
    outcome = take(traces[sweep.outcome.signal], sweep.outcome.take, sweep.outcome.window)
    predicted = {key: _predicted(case, sweep, key, values) for key in predictions(sweep)}
    return Point(
        at=at,
        outcome=outcome if math.isfinite(outcome) else None,
        holds=None if sweep.holds is None else satisfies(Comparison(**sweep.holds.model_dump()), outcome),
        predicted={key: value if math.isfinite(value) else None for key, value in predicted.items()},
    )


def _run(case: Case, sweep: Sweep, text: str) -> tuple[dict[str, Trace], dict[str, float]]:
    """The signals of a text, and the numbers that predictions may read: their last values, and the model's numbers."""
    record, read = case.record, names_read(sweep)
    numbers = {}
    if record.run is not None:
        model = compile_model(text)
        spec = record.run.model_copy(update={"duration": sweep.duration} if sweep.duration else {})
        _, traces = measure_model(record, model, spec, read & record.signals.keys())
        numbers = {name: MODEL_NUMBERS[name](model) for name in read & MODEL_NUMBERS.keys()}
    else:
        traces = measure_output(record, run_script(text, case.texts, name=record.source))
    return traces, numbers | {name: take(traces[name], "final") for name in read & traces.keys()}


def _predicted(case: Case, sweep: Sweep, key: str, values: Mapping[str, float]) -> float:
    prediction = predictions(sweep)[key]
    tree = parse(prediction.expr)
    try:
        with np.errstate(all="ignore"):
            return float(evaluate(tree, values))
    except ExpressionError as error:
        given = with_names({name: values[name] for name in sorted(names(tree))})
        found = prediction.expr + (f" with {given}" if given else "")
        index = list(predictions(sweep)).index(key)
        place: Where = ("rivals", index - 1, "expr") if index else ("prediction", "expr")
        raise _error(case, sweep, place, found, str(error), "correct the expression") from None


def _error(case: Case, sweep: Sweep, place: Where, found: str, expected: str, repair: str) -> CaseError:
    """A problem at a place of the sweep."""
    name = next(name for name, other in case.record.sweep.items() if other is sweep)
    return CaseError([case.problem(("sweep", name, *place), found, expected, repair)])


def with_names(values: Mapping[str, float]) -> str:
    """Numbers in words: `g = 9.81, h = 0.002`."""
    return ", ".join(f"{name} = {value:g}" for name, value in values.items())


def _mark(parameter: Parameter, variant: Variant) -> float | None:
    """The parameter's number in a variant: the record's mark, or what stands in the text, once or always the same."""
    if variant.id in parameter.marks:
        return parameter.marks[variant.id]
    first, *rest = (re.escape(part) for part in parameter.replace.split("{}"))
    found = set(re.findall(first + r"([-+0-9.eE]+)" + r"\1".join(rest), variant.text))
    return float(found.pop()) if len(found) == 1 else None
