"""Closed forms against numbers with known answers."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from clinic.record.closed_forms import (
    bits,
    held_share,
    impedance,
    servo_sag,
    thrown_back,
    upright_time,
)


@pytest.mark.parametrize("kp", [0.01, 1.0, 4.9, 500.0])
def test_servo_sag_balances_the_torques(kp: float) -> None:
    angle = servo_sag(kp, 4.905)

    assert kp * angle == pytest.approx(4.905 * math.cos(angle), rel=1e-12)
    assert 0 < angle < math.pi / 2


def test_bits_are_those_that_both_masks_hold() -> None:
    assert [bits(mask, 2) for mask in range(5)] == [0, 0, 2, 2, 0]


def test_impedance_rises_from_its_first_to_its_second_value_over_a_millimetre() -> None:
    assert impedance(0.0) == pytest.approx(0.9)
    assert impedance(0.0005) == pytest.approx(0.925)
    assert impedance(0.001) == impedance(0.1) == pytest.approx(0.95)


def test_a_slow_ball_is_thrown_back_and_a_fast_one_is_not() -> None:
    assert thrown_back(0.1, -1.0, 0.013, 0.02, 0.002)
    assert not thrown_back(0.1, -8.0, 0.013, 0.02, 0.002)


def test_a_step_longer_than_the_room_misses_some_starts() -> None:
    assert held_share(0.1, -8, 0.013, 0.002, 0.001, 0.04, 40) == 1.0
    assert held_share(0.1, -8, 0.013, 0.002, 0.002, 0.04, 40) == pytest.approx(0.013 / (8.1 * 0.002), abs=0.05)


def test_a_time_constant_below_two_steps_changes_nothing() -> None:
    assert held_share(0.1, -8, 0.013, 1e-4, 0.001, 0.04, 40) == held_share(0.1, -8, 0.013, 2e-3, 0.001, 0.04, 40)


def upright(period: float, kd: float = 0.5) -> float:
    return upright_time(2.7, 0.134, 6.0, kd, period, 0.02, 0.3, 10.0)


def test_a_pendulum_left_alone_after_one_call_falls_to_the_other_side() -> None:
    a, offset = math.sqrt(2.7 / 0.134), 6.0 * 0.02 / 2.7
    assert upright(5.0) == pytest.approx(math.acosh((0.3 + offset) / (offset - 0.02)) / a, rel=1e-6)


@pytest.mark.parametrize("kd", [0.2, 0.5, 1.5])
def test_a_pendulum_stays_upright_up_to_the_period_that_jurys_criterion_gives(kd: float) -> None:
    a = math.sqrt(2.7 / 0.134)
    limit = 2 / a * math.atanh(min(a * kd / 6.0, a * 0.134 / kd))
    assert upright(0.9 * limit, kd) == 10.0
    assert upright(1.4 * limit, kd) < 10.0


@pytest.mark.parametrize(
    "ask",
    [
        lambda: held_share(0.1, -8, 0.013, 0.002, 1e-12, 0.04, 2),
        lambda: held_share(1, 0, 0.01, 0.1, 0, 1, 2),
        lambda: upright(0),
        lambda: upright(1e-9),
    ],
)
def test_numbers_that_lead_to_no_end_are_refused(ask: Callable[[], float]) -> None:
    with pytest.raises(ValueError, match=r"above 0|a fall of at most"):
        ask()


def test_a_period_beyond_all_measure_ends() -> None:
    a, period = 1e-12, 1e13
    assert upright_time(a * a, 1.0, 0.0, 0.0, period, 0.02, 0.3, 10 * period) == pytest.approx(math.acosh(15) / a)
