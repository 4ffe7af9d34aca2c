"""Numbers of a model against models with known answers."""

from __future__ import annotations

import mujoco
import pytest
from clinic.engine.model_numbers import MODEL_NUMBERS, omega_max, omega_one_link
from clinic.record import closed_forms

PENDULA = """
<mujoco>
  <worldbody>
    <body>
      <joint axis="0 1 0" stiffness="8"/>
      <inertial pos="0 0 0" mass="1" diaginertia="2 2 2"/>
    </body>
    <body>
      <joint axis="0 1 0" stiffness="18"/>
      <inertial pos="0 0 0" mass="1" diaginertia="2 2 2"/>
    </body>
  </worldbody>
</mujoco>
"""


def test_uncoupled_springs_have_the_frequencies_of_each() -> None:
    model = mujoco.MjModel.from_xml_string(PENDULA)

    assert omega_max(model) == pytest.approx(3.0)
    assert omega_one_link(model) == pytest.approx(3.0)


def test_the_fast_joint_decides_wherever_it_stands() -> None:
    model = mujoco.MjModel.from_xml_string(PENDULA.replace('"8"', '"32"'))

    assert omega_max(model) == pytest.approx(4.0)
    assert omega_one_link(model) == pytest.approx(3.0)


def test_a_record_may_name_each_of_them() -> None:
    assert tuple(MODEL_NUMBERS) == closed_forms.MODEL_NUMBERS
