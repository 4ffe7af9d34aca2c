"""Checks: a number taken from a trace, compared with a bound."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from clinic.engine.checks import TAKES, Trace, expected, judge, satisfies, take
from clinic.record.parts import Check

NAN = math.nan


def trace(*value: float) -> Trace:
    return Trace(np.arange(1, len(value) + 1) * 0.1, np.array(value, dtype=float))


def check(**fields: Any) -> Check:
    return Check.model_validate({"signal": "x", **fields}, strict=False)


@pytest.mark.parametrize(
    ("which", "number", "with_holes"),
    [
        ("final", 4, NAN),
        ("first", 0, NAN),
        ("min", -2, 1),
        ("max", 4, 3),
        ("mean", 0.8, 2),
        ("span", 6, 2),
        ("onset", 0.3, 0.2),
    ],
)
def test_take(which: Any, number: float, with_holes: float) -> None:
    assert take(trace(0, 0, 2, -2, 4), which) == pytest.approx(number)
    assert take(trace(NAN, 1, NAN, 3, NAN), which) == pytest.approx(with_holes, nan_ok=True)


@pytest.mark.parametrize("which", TAKES)
def test_nothing_to_take_is_not_a_number(which: Any) -> None:
    assert math.isnan(take(trace(), which))
    assert math.isnan(take(trace(NAN, NAN), which))
    assert math.isnan(take(trace(0, 0), "onset"))


@pytest.mark.parametrize(
    ("window", "number"),
    [
        pytest.param((0.2, 0.4), 5, id="inside"),
        pytest.param((0.15, 0.35), 5, id="between-samples"),
        pytest.param((0.0, 9.0), 9, id="wider-than-the-run"),
        pytest.param((0.6, 0.7), NAN, id="after-the-run"),
    ],
)
def test_window(window: tuple[float, float], number: float) -> None:
    ends = Trace(np.array([0.1, 0.2, 0.3, 0.4, 0.5]), np.array([9.0, 1.0, 5.0, 2.0, 0.0]))
    assert take(ends, "max", window) == pytest.approx(number, nan_ok=True)


@pytest.mark.parametrize(
    ("comparison", "holds", "fails"),
    [
        pytest.param({"above": 1}, [1.001, math.inf], [1, -5], id="above"),
        pytest.param({"below": 1}, [0.999, -math.inf], [1, 5], id="below"),
        pytest.param({"between": (1, 2)}, [1, 1.5, 2], [0.999, 2.001], id="between-with-its-ends"),
        pytest.param({"equals": 1}, [1], [1 + 1e-15], id="equals-exactly"),
        pytest.param({"equals": 1, "within": 0.5}, [0.5, 1, 1.5], [0.499, 1.501], id="equals-within"),
        pytest.param({"equals": 0}, [0, -0.0], [5e-324], id="zero"),
    ],
)
def test_satisfies(comparison: dict[str, Any], holds: list[float], fails: list[float]) -> None:
    assert [satisfies(check(**comparison), number) for number in holds] == [True] * len(holds)
    assert [satisfies(check(**comparison), number) for number in fails] == [False] * len(fails)
    assert not satisfies(check(**comparison), NAN)


def test_judge_takes_from_the_named_signal() -> None:
    verdict = judge(check(take="max", below=3, window=(0.0, 0.2)), {"y": trace(9), "x": trace(1, 2, 7)})
    assert (verdict.measured, verdict.holds) == (2, True)


@pytest.mark.parametrize(
    ("comparison", "words"),
    [
        ({"above": 0.5}, "above 0.5"),
        ({"below": -3}, "below -3"),
        ({"between": (0.505, 0.52)}, "between 0.505 and 0.52"),
        ({"equals": 4}, "exactly 4"),
        ({"equals": 0.05, "within": 0.001}, "0.05 ± 0.001"),
    ],
)
def test_expected_in_words(comparison: dict[str, Any], words: str) -> None:
    assert expected(check(**comparison)) == words
