"""Sweeps: points, predictions and how they fare."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from clinic.proof.sweep import grid, measure_sweep, parameter_values, substituted, summarise
from clinic.record.case import Case
from clinic.record.problem import CaseError, Problem
from clinic.record.sweep import Parameter
from helpers import SWEEP, changed, tiny_case


def falling(tmp_path: Path, *changes: tuple[str, str]) -> Case:
    return tiny_case(tmp_path, ("no_sweep: The masks are not a number.\n", changed(SWEEP, *changes)))


def test_numbers_are_spaced_as_asked() -> None:
    common = {"name": "x", "find": "a", "replace": "{}"}
    assert parameter_values(Parameter(**common, start=0, stop=1, count=3)) == [0, 0.5, 1]
    assert parameter_values(Parameter(**common, start=1, stop=100, count=3, scale="log")) == [1, 10, 100]
    assert parameter_values(Parameter(**common, values=[3.0, 1.0])) == [1, 3]


def test_an_exact_prediction_agrees_and_the_textbook_misses_where_it_matters(tmp_path: Path) -> None:
    found = measure_sweep(falling(tmp_path), "fall")

    assert found.agreement["prediction"].wrong == 0
    assert found.agreement["prediction"].worst == pytest.approx(0, abs=1e-12)
    assert found.agreement["textbook"].wrong == 0
    assert found.agreement["textbook"].worst == pytest.approx(8 * 0.4 * 0.002 / 2)


def test_a_yes_or_no_is_judged_off_the_line(tmp_path: Path) -> None:
    case = falling(
        tmp_path,
        ("outcome: {signal: height}", "outcome: {signal: height}\n    holds: {above: -0.2583}"),
        ("0.06 - g * 0.4 * 0.398 / 2, within: 1.0e-9, relative: false", "'4', within: 0.01"),
        ("0.06 - g * 0.4 ** 2 / 2, within: 0.005, relative: false", "'1.5', within: 0.01"),
    )
    found = measure_sweep(case, "fall")

    assert [point.holds for point in found.points] == [True, True, False, False]
    assert (found.agreement["prediction"].judged, found.agreement["prediction"].wrong) == (3, 0)
    assert (found.agreement["textbook"].judged, found.agreement["textbook"].wrong) == (4, 1)
    assert found.agreement["textbook"].good_from == 4


def test_a_variant_is_marked_where_the_sweep_has_its_text(tmp_path: Path) -> None:
    case = falling(
        tmp_path,
        ("find: '<option timestep=\"0.002\"/>'", "find: 'timestep=\"0.002\"'"),
        ('replace: \'<option timestep="0.002" gravity="0 0 -{}"/>\'', "replace: 'timestep=\"{}\"'"),
        ("values: [1, 2, 4, 8]", "values: [0.001, 0.002]"),
    )
    found = summarise(case, case.record.sweep["fall"], [])
    assert found.marks == {"broken": {"g": 0.002}}  # the fix has the same timestep, and other masks


def test_a_number_may_be_written_more_than_once(tmp_path: Path) -> None:
    case = falling(tmp_path, ('gravity="0 0 -{}"/>', 'gravity="-{} 0 -{}"/>'))
    text = substituted(case.text, case.record.sweep["fall"], {"g": 4.0})
    assert 'gravity="-4 0 -4"' in text


def spaced(first: int, second: int) -> list[tuple[str, str]]:
    """Changes after which the sweep varies two parameters, at so many numbers of each."""
    other = f"- {{name: h, find: '\"0.002\"', replace: '{{}}', start: 0.001, stop: 0.002, count: {second}}}"
    return [
        ("values: [1, 2, 4, 8]", f"start: 1, stop: 2, count: {first}"),
        ("    outcome", f"      {other}\n    outcome"),
    ]


def test_the_points_are_as_many_as_the_sweep_says(tmp_path: Path) -> None:
    sweep = falling(tmp_path, *spaced(7, 3)).record.sweep["fall"]
    assert len(grid(sweep)) == 21


@pytest.mark.parametrize(
    ("change", "found"),
    [
        pytest.param(
            ("find: '<option timestep=\"0.002\"/>'", "find: '<opt '"),
            "at g = 1: '<opt ' occurs 0 times in the text of broken",
            id="nowhere",
        ),
        pytest.param(
            ('gravity="0 0 -{}"', 'gravity="x{}"'),
            "at g = 1: XML Error: bad format in attribute 'gravity'",
            id="no-model",
        ),
    ],
)
def test_a_text_that_cannot_be_made_or_run(tmp_path: Path, change: tuple[str, str], found: str) -> None:
    case = falling(tmp_path, change)
    told = refused(lambda: measure_sweep(case, "fall"))
    assert told.where == "sweep.fall"
    assert told.found.startswith(found)


def refused(act: Callable[[], object]) -> Problem:
    """The only problem of a case."""
    with pytest.raises(CaseError) as caught:
        act()
    (found,) = caught.value.problems
    return found


@pytest.mark.parametrize("name", ["prediction", "rivals"])
def test_a_prediction_that_cannot_be_computed_is_told(tmp_path: Path, name: str) -> None:
    case = falling(tmp_path)
    sweep = case.record.sweep["fall"]
    form = sweep.prediction if name == "prediction" else sweep.rivals[0]
    wrong = form.model_copy(update={"expr": "servo_sag(0, g)"})
    sweep = sweep.model_copy(update={name: wrong if name == "prediction" else [wrong]})
    case = replace(case, record=case.record.model_copy(update={"sweep": {"fall": sweep}}))
    told = refused(lambda: measure_sweep(case, "fall"))
    assert (told.where, told.found) == ("sweep.fall", "at g = 1: servo_sag(0, g)")
    assert told.expected == "numbers that servo_sag can take: float division by zero"
