"""A sweep: the model's parameters varied, an outcome measured at every point, predictions held against it."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from clinic.engine.checks import Trace, satisfies, take
from clinic.engine.measure import MODEL_NUMBERS, measure_model, measure_output
from clinic.engine.script import run_script
from clinic.engine.simulate import compile_model
from clinic.engine.variant import EditError, Variant, apply_edits, variants
from clinic.record.case import Case
from clinic.record.expression import ExpressionError, evaluate, names, parse
from clinic.record.parts import Edit, Strict
from clinic.record.problem import CaseError
from clinic.record.sweep import Parameter, Prediction, Sweep


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


def parameter_values(parameter: Parameter) -> list[float]:
    """The parameter's values, increasing."""
    if parameter.start is None or parameter.stop is None or parameter.count is None:
        return sorted(parameter.values)
    spaced = np.geomspace if parameter.scale == "log" else np.linspace
    return [float(f"{value:.12g}") for value in spaced(parameter.start, parameter.stop, parameter.count)]


def grid(sweep: Sweep) -> list[dict[str, float]]:
    """Every combination of the parameters' values, the last parameter changing fastest."""
    columns = {parameter.name: parameter_values(parameter) for parameter in sweep.vary}
    return [dict(zip(columns, values, strict=True)) for values in itertools.product(*columns.values())]


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


def measure_sweep(case: Case, name: str) -> SweepEvidence:
    """Measures the outcome at every point of a sweep of the case, and holds the predictions against it.

    Raises:
        CaseError: If a point's text cannot be made or run, or a prediction cannot be computed there.
    """
    sweep = case.record.sweep[name]
    base = next(variant.text for variant in variants(case) if variant.id == sweep.base)
    return summarise(case, sweep, [_measure(case, name, base, at) for at in grid(sweep)])


def summarise(case: Case, sweep: Sweep, points: list[Point]) -> SweepEvidence:
    """The points with every prediction's agreement and the variants' marks."""
    unit = "s" if sweep.outcome.take == "onset" else case.record.signals[sweep.outcome.signal].unit
    agreement = {}
    for key, prediction in predictions(sweep).items():
        errors = [(point.at[sweep.vary[0].name], error) for point, error in errors_at(sweep, key, points)]
        bad = [at for at, error in errors if error > prediction.within]
        finite = [error for _, error in errors if math.isfinite(error)]
        agreement[key] = Agreement(
            judged=len(errors),
            wrong=len(bad),
            worst=max(finite, default=None) if sweep.holds is None else None,
            good_from=min((at for at, _ in errors if at > max(bad, default=-math.inf)), default=None),
            unit="" if prediction.relative else unit,
        )
    return SweepEvidence(points=points, agreement=agreement, marks=marks(case, sweep))


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


def unjudged_sides(sweep: Sweep, points: Sequence[Point]) -> list[str]:
    """The sides of the line, `below` and `above`, on which no point within twice `within` of it is judged."""
    first, reach = sweep.vary[0].name, 2 * sweep.prediction.within
    judged = (point for point, _ in errors_at(sweep, "prediction", points))
    shares = [point.at[first] / predicted - 1 for point in judged if (predicted := point.predicted["prediction"])]
    sides = {
        "below": any(-reach <= share < 0 for share in shares),
        "above": any(0 < share <= reach for share in shares),
    }
    return [side for side, there in sides.items() if not there]


def marks(case: Case, sweep: Sweep) -> dict[str, dict[str, float]]:
    """Where the broken variant and the fixes stand: where the record says so, or the sweep has the variant's text."""
    texts, made = {variant.id: variant.text for variant in variants(case)}, {}
    for variant in variants(case):
        at = {p.name: value for p in sweep.vary if (value := _mark(p, variant)) is not None}
        if variant.kind != "refuted" and len(at) == len(sweep.vary):
            told = any(variant.id in parameter.marks for parameter in sweep.vary)
            if told or substituted(texts[sweep.base], sweep, at) == variant.text:
                made[variant.id] = at
    return made


def _measure(case: Case, name: str, base: str, at: dict[str, float]) -> Point:
    sweep = case.record.sweep[name]

    def error(found: str, expected: str, repair: str, quoted: str = "") -> CaseError:
        return CaseError([case.problem(("sweep", name), f"at {format_values(at)}: {found}", expected, repair, quoted)])

    try:
        traces, values = _run(case, sweep, substituted(base, sweep, at))
    except EditError as wrong:
        find = [*(edit.find for edit in sweep.edits), *(parameter.find for parameter in sweep.vary)][wrong.index]
        found = f"{find!r} occurs {wrong.count} times in the text of {sweep.base}"
        raise error(found, "text that occurs once", "correct `find`", find) from None
    except ValueError as wrong:
        raise error(" ".join(str(wrong).split()), "a text that runs to its end", "correct `replace`") from None
    outcome = take(traces[sweep.outcome.signal], sweep.outcome.take, sweep.outcome.window)
    predicted = {}
    for key, prediction in predictions(sweep).items():
        try:
            with np.errstate(all="ignore"):
                value = float(evaluate(parse(prediction.expr), values | at))
        except ExpressionError as wrong:
            raise error(prediction.expr, str(wrong), "correct the expression", prediction.expr) from None
        predicted[key] = value if math.isfinite(value) else None
    return Point(
        at=at,
        outcome=outcome if math.isfinite(outcome) else None,
        holds=None if sweep.holds is None else satisfies(sweep.holds, outcome),
        predicted=predicted,
    )


def _run(case: Case, sweep: Sweep, text: str) -> tuple[dict[str, Trace], dict[str, float]]:
    """The signals of a text, and the numbers that predictions may read: their last values, and the model's numbers."""
    record, read = case.record, names_read(sweep)
    numbers = {}
    if record.run is not None:
        model = compile_model(text)
        spec = record.run.model_copy(update={"duration": sweep.duration or record.run.duration})
        _, traces = measure_model(record, model, spec, read & record.signals.keys())
        numbers = {name: MODEL_NUMBERS[name](model) for name in read & MODEL_NUMBERS.keys()}
    else:
        traces = measure_output(record, run_script(text, case.texts, name=record.source))
    return traces, numbers | {name: take(traces[name], "final") for name in read & traces.keys()}


def format_values(values: Mapping[str, float]) -> str:
    """Numbers in words: `g = 9.81, h = 0.002`."""
    return ", ".join(f"{name} = {value:g}" for name, value in values.items())


def _mark(parameter: Parameter, variant: Variant) -> float | None:
    """The parameter's number in a variant: the record's mark, or what stands in the text, once or always the same."""
    if variant.id in parameter.marks:
        return parameter.marks[variant.id]
    first, *rest = (re.escape(part) for part in parameter.replace.split("{}"))
    found = set(re.findall(first + r"([-+0-9.eE]+)" + r"\1".join(rest), variant.text))
    return float(found.pop()) if len(found) == 1 else None
