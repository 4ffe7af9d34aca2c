"""Runs of a model: how they begin, how they are driven, how long they may take."""

from __future__ import annotations

import mujoco
import pytest
from clinic.diagnosis import engine
from clinic.diagnosis.judge import suspects_of
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.run import model_size
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import read_source
from clinic.diagnosis.start import Start

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


SUNK = """<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 1"/>
    <body name="torso" pos="0 0 0.3">
      <freejoint/>
      <geom type="box" size="0.2 0.1 0.05"/>
      <body name="left_leg" pos="0 0.1 0"><joint name="left" axis="0 1 0" range="-60 60" damping="1"/>
        <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.35"/></body>
      <body name="right_leg" pos="0 -0.1 0"><joint name="right" axis="0 1 0" range="-60 30" damping="2"/>
        <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.35"/></body>
    </body>
  </worldbody>
  <actuator><position name="left" joint="left" kp="5"/><position name="right" joint="right" kp="5"/></actuator>
  <keyframe><key name="sunk" qpos="0 0 0.3 1 0 0 0 0 0"/></keyframe>
</mujoco>
"""


@pytest.mark.parametrize("key", [-1, 0])
def test_what_a_rule_says_does_not_depend_on_where_another_left_the_model(key):
    def said(*, moved: bool) -> dict[str, list[object]]:
        model, made = ReaderModel(NativeEngine(), {"": SUNK}, read_source({"": SUNK}), Start(key=key)), {}
        engine = model.simulation.engine
        for rule in (each for each in rules().values() if not each.of_errors):
            model.simulation.begin()
            if moved:
                engine.write("qpos", [1.0, -0.5, 2.0, 0.8, 0.6, 0.0, 0.0, 0.4, -0.3], 0)
                engine.write("qvel", [3.0] * model.simulation.count("dof"), 0)
                engine.forward()
            found = suspects_of(model, rule, lambda _: None)
            made[rule.id] = [(each.elements, each.says, model.measured(each.probe)) for each in found]
        return made

    at_the_start = said(moved=False)
    assert any(at_the_start.values())
    assert said(moved=True) == at_the_start


def test_a_written_extent_makes_no_model_smaller_than_its_bodies():
    legs = "".join(f'<body pos="{x} 0 -0.4"><joint axis="0 1 0"/><geom size="0.02"/></body>' for x in (-0.3, 0.3))
    text = f'<mujoco>{{}}<worldbody><body pos="0 0 1"><freejoint/><geom size="0.05"/>{legs}</body></worldbody></mujoco>'
    small = '<statistic extent="0.1"/>'
    sizes = [model_size(Simulation(NativeEngine().compile(text.format(each), {}), Start())) for each in ("", small)]
    assert sizes == pytest.approx([0.64, 0.6])


@pytest.mark.parametrize(
    ("prefix", "kind"),
    [
        ("TRN_", "mjtTrn"),
        ("GAIN_", "mjtGain"),
        ("BIAS_", "mjtBias"),
        ("DYN_", "mjtDyn"),
        ("OBJ_", "mjtObj"),
        ("WRAP_", "mjtWrap"),
        ("SENS_", "mjtSensor"),
    ],
)
def test_the_numbers_of_enumerations_are_mujocos(prefix: str, kind: str) -> None:
    members = getattr(mujoco, kind).__members__
    known = {name: value for name, value in vars(engine).items() if name.startswith(prefix)}
    theirs = {name: int(members[f"mj{name.replace('TRN_IN_PARENT', 'TRN_JOINTINPARENT')}"]) for name in known}
    assert known
    assert known == theirs
