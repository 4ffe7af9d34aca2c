"""Recordings of a model under a budget of time."""

from __future__ import annotations

import copy

import numpy as np
import pytest
from clinic.engine.simulate import RunError
from clinic.triage.run import Budget, distance, record, scale
from helpers import BALL, PENDULUM
from subjects import Ticks, subject


def test_a_recording_samples_positions_at_even_times() -> None:
    ball = subject(BALL)
    made = record(ball, ball.model, Budget())
    assert made.time == pytest.approx(1.0)
    assert made.points.shape == (100, 3, 3)
    times = np.arange(1, 101) * 0.01
    assert made.points[:, 1, 2] == pytest.approx(1 - 9.81 / 2 * times * (times + 0.001))


def test_a_finer_recording_has_samples_at_the_same_times() -> None:
    ball = subject(BALL)
    finer = copy.copy(ball.model)
    finer.opt.timestep /= 4
    one, other = record(ball, ball.model, Budget()), record(ball, finer, Budget(), finer=4)
    assert len(one.points) == len(other.points)
    assert distance(one, other) == pytest.approx(9.81 / 2 * (0.001 - 0.00025), rel=1e-6)


def test_controls_and_keyframes_of_the_run_apply() -> None:
    driven = subject(PENDULUM, keyframe="hanging", ctrl={"motor": 1.0})
    assert driven.data.qpos[0] == pytest.approx(np.pi / 2)
    assert driven.data.ctrl[0] == 1.0


def test_a_part_of_a_budget_ends_earlier_and_no_budget_never() -> None:
    clock = Ticks()
    whole = Budget(100, clock)
    assert whole.part(0.1).left < 10
    assert whole.left > 80
    assert Budget().part(0.1).left == np.inf


def test_a_recording_ends_with_the_numbers() -> None:
    broken = subject("<mujoco><worldbody><body pos='nan 0 0'><freejoint/><geom size='.1'/></body></worldbody></mujoco>")
    made = record(broken, broken.model, Budget())
    assert not made.finite
    assert made.points.shape[0] == 0
    assert scale(broken, made) > 0


def test_a_timestep_of_zero_is_refused_with_a_reason() -> None:
    still = subject("<mujoco><option timestep='0'/></mujoco>")
    with pytest.raises(RunError, match="timestep of 0 s"):
        record(still, still.model, Budget())


def test_a_budget_that_ends_cuts_the_recording_and_distance_compares_what_both_have() -> None:
    ball = subject(BALL)
    cut = record(ball, ball.model, Budget(300, Ticks()))
    whole = record(ball, ball.model, Budget())
    assert 0 < len(cut.points) < len(whole.points)
    assert 0 < cut.steps < cut.planned
    assert distance(cut, whole) == 0


def test_elements_are_called_by_name_or_number() -> None:
    model = subject("<mujoco><worldbody><body name='hand'><joint/><geom size='.1'/></body></worldbody></mujoco>")
    assert model.called("body", 1) == "body hand"
    assert model.called("geom", 0) == "geom 0 of body hand"
