"""Runs of a model: how they begin, how they are driven, how long they may take."""

from __future__ import annotations

import pytest
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.simulation import Simulation, Start

ARM = """<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <joint name="hinge" axis="0 0 1"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01" mass="0.05"/>
    </body>
  </worldbody>
  <actuator><motor name="motor" joint="hinge"/></actuator>
  <keyframe><key name="bent" qpos="0.5" ctrl="0.001"/></keyframe>
</mujoco>
"""


def speed(start: Start) -> float:
    made = Simulation(NativeEngine().compile(ARM, {}), start)
    made.begin()
    for _ in made.run(1.0):
        pass
    return made.data("qvel")[0]


def test_controls_hold_for_the_whole_run():
    assert speed(Start()) == 0
    assert speed(Start(ctrl={"motor": 0.002})) == pytest.approx(2 * speed(Start(key=0)))


def test_a_series_holds_each_control_from_its_time_on():
    half = speed(Start(series=((0.0, {"motor": 0.0}), (0.5, {"motor": 0.001}))))
    assert half == pytest.approx(0.5 * speed(Start(ctrl={"motor": 0.001})), rel=0.02)


def test_a_run_begins_at_its_keyframe():
    made = Simulation(NativeEngine().compile(ARM, {}), Start(key=0))
    made.begin()
    assert made.data("qpos") == [0.5]


def test_large_models_are_stepped_less():
    many = "".join('<body><freejoint/><geom size="0.1"/></body>' for _ in range(100))
    large = Simulation(NativeEngine().compile(f"<mujoco><worldbody>{many}</worldbody></mujoco>", {}), Start())
    small = Simulation(NativeEngine().compile(ARM, {}), Start())
    assert large.steps(10) * 20 < small.steps(10)
