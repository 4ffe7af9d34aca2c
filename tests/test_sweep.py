"""Sweeps: points, predictions and how they fare."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.case import Case
from clinic.record_sweep import Parameter
from clinic.sweep import agreement, grid, measure_points, numbers, summarise
from helpers import tiny_case

FALL = """\
sweep:
  fall:
    title: Gravity and the fall
    text: At {{ sweep.fall.points }} points.
    vary:
      - {name: g, find: '<option timestep="0.002"/>', replace: '<option timestep="0.002" gravity="0 0 -{}"/>',
         values: [1, 2, 4, 8], unit: m/s²}
    outcome: {signal: height}
    prediction:
      {label: "semi-implicit, a step behind", expr: 0.06 - g * 0.4 * 0.398 / 2, within: 1.0e-9, relative: false}
    rivals:
      - {id: textbook, label: half g t squared, expr: 0.06 - g * 0.4 ** 2 / 2, within: 0.005, relative: false}
"""


def falling(tmp_path: Path, *changes: tuple[str, str]) -> Case:
    text = FALL
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return tiny_case(tmp_path, ("no_sweep: The masks are not a number.\n", text))


def test_numbers_are_spaced_as_asked() -> None:
    common = {"name": "x", "find": "a", "replace": "{}"}
    assert numbers(Parameter(**common, start=0, stop=1, count=3)) == [0, 0.5, 1]
    assert numbers(Parameter(**common, start=1, stop=100, count=3, scale="log")) == [1, 10, 100]
    assert numbers(Parameter(**common, values=[3.0, 1.0])) == [1, 3]


def test_an_exact_prediction_agrees_and_the_textbook_misses_where_it_matters(tmp_path: Path) -> None:
    case = falling(tmp_path)
    sweep = case.record.sweep["fall"]

    found = summarise(case, sweep, measure_points(case, sweep, grid(sweep)))

    assert found.agreement["prediction"].wrong == 0
    assert found.agreement["prediction"].worst == pytest.approx(0, abs=1e-12)
    assert found.agreement["textbook"].wrong == 0
    assert found.agreement["textbook"].worst == pytest.approx(8 * 0.4 * 0.002 / 2)


def test_a_prediction_moved_by_a_twentieth_is_wrong(tmp_path: Path) -> None:
    case = falling(tmp_path)
    sweep = case.record.sweep["fall"]
    points = measure_points(case, sweep, grid(sweep))

    for factor in (0.95, 1.05):
        assert agreement(sweep, sweep.prediction, "prediction", points, factor).wrong == 4


def test_a_yes_or_no_is_judged_off_the_line(tmp_path: Path) -> None:
    case = falling(
        tmp_path,
        ("outcome: {signal: height}", "outcome: {signal: height}\n    holds: {above: -0.2583}"),
        ("0.06 - g * 0.4 * 0.398 / 2, within: 1.0e-9, relative: false", "'4', within: 0.01"),
        ("0.06 - g * 0.4 ** 2 / 2, within: 0.005, relative: false", "'1.5', within: 0.01"),
    )
    sweep = case.record.sweep["fall"]
    points = measure_points(case, sweep, grid(sweep))

    found = summarise(case, sweep, points)

    assert [point.holds for point in points] == [True, True, False, False]
    assert (found.agreement["prediction"].judged, found.agreement["prediction"].wrong) == (3, 0)
    assert (found.agreement["textbook"].judged, found.agreement["textbook"].wrong) == (4, 1)
    assert found.agreement["textbook"].good_from == 4


def test_the_broken_point_is_marked_where_the_text_shows_it(tmp_path: Path) -> None:
    case = falling(
        tmp_path,
        ("find: '<option timestep=\"0.002\"/>'", "find: '0.002'"),
        ('replace: \'<option timestep="0.002" gravity="0 0 -{}"/>\'', "replace: '{}'"),
        ("values: [1, 2, 4, 8]", "values: [0.001, 0.002]"),
    )
    sweep = case.record.sweep["fall"].model_copy(
        update={"vary": [case.record.sweep["fall"].vary[0].model_copy(update={"replace": 'timestep="{}"'})]}
    )

    found = summarise(case, sweep, [])

    assert found.marks == {"broken": {"g": 0.002}, "share-a-bit": {"g": 0.002}}
