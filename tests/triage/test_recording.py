"""Recordings of a model under a budget of time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from clinic.engine.simulate import RunError
from clinic.triage.recording import distance, record_run, scale
from helpers import BALL, PENDULUM, RESTING
from subjects import subject


def test_a_recording_samples_positions_at_even_times() -> None:
    ball = subject(BALL)
    made = record_run(ball)
    assert made.time == pytest.approx(1.0)
    assert np.shape(made.points) == (100, 3, 3)
    times = np.arange(1, 101) * 0.01
    assert np.array(made.points)[:, 1, 2] == pytest.approx(1 - 9.81 / 2 * times * (times + 0.001))


def test_a_finer_recording_has_samples_at_the_same_times() -> None:
    ball = subject(BALL)
    one, other = record_run(ball), record_run(ball, finer=4)
    assert len(one.points) == len(other.points)
    assert distance(one, other) == pytest.approx(9.81 / 2 * (0.001 - 0.00025), rel=1e-6)


def test_controls_and_keyframes_of_the_run_apply() -> None:
    driven = subject(PENDULUM, keyframe="hanging", ctrl={"motor": 1.0})
    assert driven.data.qpos[0] == pytest.approx(np.pi / 2)
    assert driven.data.ctrl[0] == 1.0


def test_a_recording_ends_with_the_numbers() -> None:
    broken = subject("<mujoco><worldbody><body pos='nan 0 0'><freejoint/><geom size='.1'/></body></worldbody></mujoco>")
    made = record_run(broken)
    assert not made.finite
    assert made.points == []
    assert scale(broken, made) > 0


def test_a_timestep_of_zero_is_refused_with_a_reason() -> None:
    still = subject("<mujoco><option timestep='0'/></mujoco>")
    with pytest.raises(RunError, match="timestep of 0 s"):
        record_run(still)


def test_time_cuts_the_recording_and_distance_compares_what_both_have(monkeypatch: pytest.MonkeyPatch) -> None:
    ball = subject(BALL)
    whole = record_run(ball)
    monkeypatch.setattr("clinic.triage.recording.perf_counter", iter(range(1000)).__next__)
    cut = record_run(replace(ball, end=300))
    assert 0 < len(cut.points) < len(whole.points)
    assert 0 < cut.steps < cut.planned
    assert distance(cut, whole) == 0


def test_elements_are_called_by_name_or_number() -> None:
    model = subject("<mujoco><worldbody><body name='hand'><joint/><geom size='.1'/></body></worldbody></mujoco>")
    assert model.called("body", 1) == "body hand"
    assert model.called("geom", 0) == "geom 0 of body hand"


def test_contacts_are_seen() -> None:
    run = subject(RESTING).watched
    assert (0, 1) in run.touching


def test_a_fall_turns_potential_into_kinetic_energy() -> None:
    run = subject(BALL).watched
    assert np.ptp(np.sum(run.energies, axis=1)) < 0.002 * np.max(run.energies, axis=0)[1]
    assert run.supplied[-1] == 0
    assert run.fastest.max() == pytest.approx(9.81)


def test_the_work_of_a_motor_is_the_energy_gained() -> None:
    run = subject(PENDULUM, duration=0.2, ctrl={"motor": -1.0}).watched
    total = np.sum(run.energies, axis=1)
    assert total[-1] - total[0] == pytest.approx(run.supplied[-1], rel=2e-2)
