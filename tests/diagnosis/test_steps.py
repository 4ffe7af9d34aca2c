"""What a timestep can follow: damping, stiffness and light links."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest
from clinic.diagnosis.edit import Edit
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.drive import commanded
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.source import read_source
from clinic.diagnosis.start import Start
from clinic.diagnosis.suspect import Probe
from diagnosed import causes, diagnosed, findings, hints


@pytest.mark.parametrize(("damping", "named"), [(100, ["servo-held-back"]), (6, [])])
def test_what_a_joint_has_of_damping_is_not_said_of_a_stiff_servo(damping, named):
    body = f'<joint name="way" axis="0 0 1" damping="{damping}" range="-60 60"/><geom size="0.1" mass="5"/>'
    servo = '<actuator><position joint="way" kp="50" ctrlrange="-1 1"/></actuator>'
    found = findings(f'<mujoco><worldbody><body pos="0 0 1">{body}</body></worldbody>{servo}</mujoco>')
    assert [each.rule for each in found] == named


def test_a_light_foot_without_armature_is_not_the_timesteps_fault():
    text = """
<mujoco>
  <option timestep="0.004"/>
  <worldbody>
    <geom type="plane" size="2 2 0.1"/>
    <body pos="0 0 0.5">
      <freejoint/>
      <geom type="box" size="0.1 0.1 0.05" mass="10"/>
      <body pos="0 0 -0.1">
        <joint name="ankle" axis="0 1 0" range="-30 30"/>
        <inertial pos="0 0 0" mass="0.02" diaginertia="1e-5 1e-5 1e-5"/>
        <geom type="box" size="0.08 0.02 0.005" pos="0.02 0 -0.3"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="ankle"/></actuator>
</mujoco>
"""
    named = {each.rule for each in causes(text)}
    assert "no-armature" in named
    assert "timestep-too-long" not in named
    heavier = text.replace('range="-30 30"', 'range="-30 30" armature="0.01"')
    assert "no-armature" not in {each.rule for each in causes(heavier)}


FOREARM = """
<mujoco>
  <option integrator="{integrator}"/>
  <worldbody>
    <body pos="0 0 1">
      <joint name="forearm" axis="0 0 1" damping="0.4"/>
      <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.03" mass="0.3"/>
    </body>
  </worldbody>
  <actuator>
    <position name="forearm" joint="forearm" kp="80" kv="{kv}" {force}/>
  </actuator>
</mujoco>
"""


@pytest.mark.parametrize(
    ("kv", "force", "told"),
    [(5, 'forcerange="-15 15"', True), (5, "", False), (0.05, 'forcerange="-15 15"', False)],
    ids=["clamped", "not clamped", "as much as the inertia bears"],
)
@pytest.mark.parametrize("integrator", ["implicit", "implicitfast"])
def test_a_clamped_force_has_no_implicit_damping(integrator, kv, force, told):
    found = diagnosed(FOREARM.format(integrator=integrator, kv=kv, force=force))
    assert ("servo-is-a-switch" in [each.rule for each in found.hints]) is told, found.text()


@pytest.mark.parametrize("well_up_to", [0.0018, 0.00195])
def test_a_step_beside_which_all_is_well_is_not_too_long(well_up_to: float, monkeypatch: pytest.MonkeyPatch) -> None:
    def measured(_: ReaderModel, __: Probe, edits: Sequence[Edit] = ()) -> float:
        return 0.0 if edits and float(edits[0].value) <= well_up_to else math.inf

    text = {"model.xml": FOREARM.format(integrator="Euler", kv=0.05, force="")}
    monkeypatch.setattr(ReaderModel, "measured", measured)
    model = ReaderModel(NativeEngine(), text, read_source(text), Start())
    assert bool(list(rules()["timestep-too-long"].suspects(model))) is (well_up_to < 0.0019)


@pytest.mark.parametrize(("calm", "told"), [(0.3, True), (30.0, False)])
def test_a_step_beside_which_it_just_holds_is_too_long(calm: float, told: bool, monkeypatch: pytest.MonkeyPatch):
    """At 0.95 of the step 60 rad/s are below the limit, and far above what a quarter of the step leaves."""

    def measured(_: ReaderModel, __: Probe, edits: Sequence[Edit] = ()) -> float:
        return math.inf if not edits else 60.0 if float(edits[0].value) > 0.0015 else calm

    text = {"model.xml": FOREARM.format(integrator="Euler", kv=0.05, force="")}
    monkeypatch.setattr(ReaderModel, "measured", measured)
    model = ReaderModel(NativeEngine(), text, read_source(text), Start())
    assert bool(list(rules()["timestep-too-long"].suspects(model))) is told


@pytest.mark.parametrize(("step", "level"), [(0.002, "hint"), (0.004, "cause")])
def test_what_explodes_only_under_command_at_the_usual_step_is_a_hint(step, level, monkeypatch):
    def measured(_: ReaderModel, probe: Probe, edits: Sequence[Edit] = ()) -> float:
        return math.inf if probe == commanded() and (not edits or float(edits[0].value) > 0.9 * step) else 0.0

    text = FOREARM.format(integrator="Euler", kv=0.05, force="").replace("<option", f'<option timestep="{step}"')
    monkeypatch.setattr(ReaderModel, "measured", measured)
    model = ReaderModel(NativeEngine(), {"model.xml": text}, read_source({"model.xml": text}), Start())
    assert [each.level for each in rules()["timestep-too-long"].suspects(model)] == [level]


def test_the_damping_of_a_joint_is_explicit_beyond_what_the_joints_around_it_leave():
    link = '<body pos="0 0 {}"><joint damping="2" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 .5" size=".02"'
    text = '<mujoco><option timestep="0.01" integrator="RK4"/><worldbody>' + link.format(0) + ' mass=".2"/>'
    text += (
        link.format(0.5) + ' mass=".15"/></body></body></worldbody><actuator><motor joint="one" gear="9"/></actuator>'
    )
    text = text.replace("<joint", '<joint name="one"', 1) + "</mujoco>"
    assert "damping-explicit" in [each.rule for each in causes(text)]


@pytest.mark.parametrize(("integrator", "told"), [("Euler", True), ("implicitfast", False)])
def test_damping_of_a_servo_is_explicit_but_for_the_implicit_integrators(integrator, told):
    found = diagnosed(FOREARM.format(integrator=integrator, kv=5, force=""))
    assert ("damping-explicit" in [each.rule for each in found.hints]) is told, found.text()


def test_a_gain_that_neither_its_damping_nor_the_timestep_bears_is_too_large():
    chain = "".join(
        f'<body pos="{-0.1 * (i > 0)} 0 0"><joint name="j{i}" axis="0 0 1" damping="1e-3"/>'
        '<geom type="capsule" fromto="0 0 0 -0.08 0 0" size="0.015"/>'
        for i in range(3)
    )
    driven = "".join(f'<position joint="j{i}"/>' for i in range(3))
    text = (
        '<mujoco><option timestep="0.004" gravity="0 0 0" integrator="implicitfast"/>'
        '<default><position kp="{}" kv="0.05"/></default>'
        f"<worldbody>{chain}{'</body>' * 3}</worldbody><actuator>{driven}</actuator></mujoco>"
    )
    found = {kp: [(each.rule, each.value) for each in causes(text.format(kp))] for kp in ("40", "0.4")}
    assert found == {"40": [("undamped-servo", "0.4")], "0.4": []}


@pytest.mark.parametrize(("damping", "told"), [("8e5", True), ("800", False)])
def test_damping_against_which_no_equality_holds_is_told_and_not_the_timestep(damping: str, told: bool) -> None:
    text = f"""
<mujoco>
  <option timestep="0.002" integrator="implicitfast"/>
  <worldbody>
    <body pos="0 0 1">
      <joint name="boom" axis="0 1 0" damping="15"/>
      <geom type="capsule" fromto="0 0 0 2 0 0" size="0.08" mass="100"/>
      <site name="lug" pos="1 0 0"/>
    </body>
    <body pos="0.5 0 0.2" zaxis="0.5 0 0.8">
      <joint name="barrel" axis="0 1 0" damping="15"/>
      <geom type="cylinder" fromto="0 0 0 0 0 0.5" size="0.05" mass="10" contype="0" conaffinity="0"/>
      <body pos="0 0 0.5">
        <joint name="ram" type="slide" axis="0 0 1" damping="{damping}" armature="8"/>
        <geom type="cylinder" fromto="0 0 0 0 0 0.44340" size="0.03" mass="5" contype="0" conaffinity="0"/>
        <site name="eye" pos="0 0 0.4434"/>
      </body>
    </body>
  </worldbody>
  <equality><connect site1="eye" site2="lug" solref="0.008 1" solimp="0.95 0.99 0.001"/></equality>
</mujoco>"""
    found = findings(text, "damping-explicit", "timestep-too-long")
    assert [(each.rule, each.elements) for each in found] == [("damping-explicit", ('joint "ram"',))] * told


@pytest.mark.parametrize(
    ("step", "stiffness", "told"),
    [
        pytest.param(0.02, 420, ["0.002"], id="five steps a period"),
        pytest.param(0.002, 420, [], id="forty-seven steps"),
        pytest.param(0.02, 40, [], id="a soft spring"),
        pytest.param(0.02, 0, [], id="no spring"),
    ],
)
def test_a_spring_of_which_a_period_has_few_steps_is_told(step: float, stiffness: float, told: list[str]) -> None:
    slide = f'<joint type="slide" axis="0 0 1" range="-0.02 0.02" stiffness="{stiffness}" springref="0.01"/>'
    text = f"""<mujoco><option timestep="{step}" integrator="implicitfast"/><worldbody>
      <body pos="0 0 1">{slide}<geom size="0.02" mass="0.1"/></body></worldbody></mujoco>"""
    assert [each.value for each in hints(text, "timestep-too-long")] == told


@pytest.mark.parametrize(("links", "told"), [(3, True), (14, False)], ids=["whole", "cut short"])
def test_a_command_for_which_a_shorter_step_leaves_no_time_is_no_proof(links: int, told: bool, monkeypatch) -> None:
    calm = 0.0006  # s: the step from which on nothing is fast

    def measured(model: ReaderModel, probe: Probe, edits: Sequence[Edit] = ()) -> float:
        step = float(edits[0].value) if edits else model.simulation.timestep
        return 300.0 if probe == commanded() and step > calm else 0.0

    chain = ""
    for number in range(links):
        chain = f'<body pos="0 0 .1"><joint name="j{number}" type="ball"/><geom size=".02"/>{chain}</body>'
    motor = '<actuator><motor joint="j0" gear="0 0 1" ctrlrange="-1 1"/></actuator>'
    option = '<option timestep="0.002"/>'
    text = {"model.xml": f"<mujoco>{option}<worldbody>{chain}</worldbody>{motor}</mujoco>"}
    monkeypatch.setattr(ReaderModel, "measured", measured)
    model = ReaderModel(NativeEngine(), text, read_source(text), Start())
    assert bool(list(rules()["timestep-too-long"].suspects(model))) is told


@pytest.mark.parametrize("step", ["0", "-0.002"])
def test_a_timestep_that_is_not_above_zero_is_told(step: str) -> None:
    ball = '<body pos="0 0 1"><freejoint/><geom size="0.1"/></body>'
    text = f'<mujoco><option timestep="{step}"/><worldbody>{ball}</worldbody></mujoco>'
    (hint,) = hints(text, "timestep-too-short")
    assert (hint.now, hint.value) == (step, "0.002")
