"""The harm of a fault: none where nothing changed, and the one that is meant where something did."""

from __future__ import annotations

import mujoco
import pytest
from clinic.diagnosis.bench.behaviour import Behaviour
from clinic.diagnosis.bench.harm import HARMS

MODEL = """
<mujoco>
  <option timestep="0.002" gravity="0 0 -9.81"/>
  <worldbody>
    <camera name="side" pos="0 -2 1" xyaxes="1 0 0 0 0 1"/>
    <geom name="floor" type="plane" size="5 5 0.1"/>
    <body name="arm" pos="0 0 1">
      <joint name="hinge" axis="0 1 0" range="-90 90" damping="0.2"/>
      <geom name="link" type="capsule" fromto="0 0 0 0.4 0 0" size="0.02" mass="0.5"/>
    </body>
    <body name="box" pos="1 1 0.1">
      <freejoint/>
      <geom name="block" type="box" size="0.1 0.1 0.1" mass="1"/>
      <site name="pad" type="box" size="0.1 0.1 0.02" pos="0 0 -0.1"/>
    </body>
  </worldbody>
  <actuator><position name="servo" joint="hinge" kp="80" kv="5" ctrlrange="-1.5 1.5"/></actuator>
  <sensor><touch name="foot" site="pad"/></sensor>
</mujoco>
"""
FAULTS = [
    ("unstable", 'damping="0.2"', 'damping="-400"'),
    ("faster", 'kp="80" kv="5"', 'kp="5000" kv="0"'),
    ("strays", 'gravity="0 0 -9.81"', 'gravity="0 0 9.81"'),
    ("sinks", 'size="0.1 0.1 0.1"', 'size="0.1 0.1 0.1" solref="2 1"'),
    ("jumps", 'pos="1 1 0.1"', 'pos="1 1 0.02"'),
    ("reaches", 'range="-90 90"', 'range="-1.57 1.57"'),
    ("commands", 'ctrlrange="-1.5 1.5"', 'ctrlrange="-90 90"'),
    ("misses", 'kp="80"', 'kp="3"'),
    ("weighs", 'mass="0.5"', 'mass="1"'),
    ("accelerates", 'mass="0.5"', 'mass="1"'),
    ("reads", 'size="0.1 0.1 0.02"', 'size="0.001 0.001 0.001"'),
    ("looks", "1 0 0 0 0 1", "-1 0 0 0 0 -1"),
]


def behaviour(xml: str, like: Behaviour | None = None) -> Behaviour:
    return Behaviour(mujoco.MjModel.from_xml_string(xml), like)


@pytest.fixture(scope="module")
def healthy():
    mujoco.set_mju_user_warning(lambda _: None)
    return behaviour(MODEL)


def test_the_same_model_does_itself_no_harm(healthy):
    assert {name: harm(healthy, behaviour(MODEL, healthy)) for name, harm in HARMS.items()} == {
        name: pytest.approx(0, abs=0.99) for name in HARMS
    }


@pytest.mark.parametrize(("name", "find", "replace"), FAULTS, ids=[name for name, *_ in FAULTS])
def test_a_fault_does_the_harm_that_is_meant(name, find, replace, healthy):
    assert find in MODEL
    assert HARMS[name](healthy, behaviour(MODEL.replace(find, replace), healthy)) >= 1


def test_a_change_too_small_to_matter_is_no_harm(healthy):
    changed = behaviour(MODEL.replace('mass="0.5"', 'mass="0.51"').replace('kp="80"', 'kp="81"'), healthy)
    assert max(harm(healthy, changed) for harm in HARMS.values()) < 1
