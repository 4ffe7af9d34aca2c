"""Natural frequencies and servos at the start."""

from __future__ import annotations

import math

import pytest
from clinic.triage.stiffness import highest_frequency, inertias, joint_servos
from subjects import arm, subject

INERTIA = 0.4 * 0.1**2 + 0.3**2


def test_the_frequency_of_a_spring_and_a_servo_add_up() -> None:
    made = subject(arm('axis="0 1 0" stiffness="30"', servo='kp="5" gear="2"'))
    assert inertias(made)[0] == pytest.approx(INERTIA)
    assert highest_frequency(made) == pytest.approx(math.sqrt((30 + 20) / INERTIA))
    assert list(joint_servos(made)) == [(0, 0, 20.0)]


def test_without_springs_there_is_no_frequency() -> None:
    assert highest_frequency(subject(arm())) == 0
    assert highest_frequency(subject("<mujoco/>")) == 0
