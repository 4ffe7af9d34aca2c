"""Servos, joints and time: near misses, healthy models that look ill, and elements without a place."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest
from clinic.diagnosis.diagnose import Diagnosis, examine
from clinic.diagnosis.edit import Edit
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.rules.servo.control_range_too_narrow import ungeared
from clinic.diagnosis.simulation import Start
from clinic.diagnosis.source import read_source
from clinic.diagnosis.suspect import Probe

ARM = """
<mujoco>
  {above}
  <worldbody>
    <geom type="plane" size="1 1 0.1"/>
    <body pos="0 0 1">
      <joint name="shoulder" axis="0 1 0" {joint}/>
      <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="1"/>
    </body>
  </worldbody>
  <actuator>
    {actuator}
  </actuator>
</mujoco>
"""


def diagnosed(text: str) -> Diagnosis:
    return examine(NativeEngine(), {"model.xml": text})


def arm(actuator: str, joint: str = "", above: str = "") -> Diagnosis:
    return diagnosed(ARM.format(actuator=actuator, joint=joint, above=above))


def causes(found: Diagnosis) -> list[str]:
    return [each.rule for each in found.causes]


@pytest.mark.parametrize(
    ("actuator", "joint"),
    [
        ('<position joint="shoulder" kp="200" dampratio="0.5"/>', ""),  # overshoots by 16 %
        ('<position joint="shoulder" kp="200"/>', 'damping="10"'),  # the joint has the damping
        ('<position joint="shoulder" kp="200" kv="10" ctrlrange="-2 2"/>', 'range="-100 100"'),  # 15 % beyond
        ('<position joint="shoulder" kp="200" kv="10" ctrlrange="-0.8 0.8"/>', 'range="-90 90"'),  # half of the range
        ('<position joint="shoulder" kp="20" kv="3"/>', ""),  # sags by 0.12 rad
        ('<position joint="shoulder" kp="200" kv="10" forcerange="-4 4"/>', ""),  # the weight is 2.5 N m
        ('<position joint="shoulder" kp="200" kv="10"/>', 'range="-720 720"'),  # two turns each way
        ('<motor joint="shoulder" ctrlrange="-1 1" gear="5"/>', 'frictionloss="3" damping="1"'),
        ('<general joint="shoulder" biastype="affine" gainprm="50" biasprm="0 0 -50"/>', 'damping="1"'),  # a velocity
        ('<motor joint="shoulder"/>', 'range="-180 540" limited="false"'),  # the numbers of a turn
    ],
)
def test_a_model_that_only_looks_ill_has_no_cause(actuator, joint):
    assert causes(arm(actuator, joint)) == []


@pytest.mark.parametrize(
    ("rule", "actuator", "joint"),
    [
        ("undamped-servo", '<general joint="shoulder" biastype="affine" gainprm="200" biasprm="0 -200 0"/>', ""),
        ("undamped-servo", '<position joint="shoulder" kp="200" kv="0.1"/>', ""),
        ("weak-servo", '<general joint="shoulder" biastype="affine" gainprm="2" biasprm="0 -2 -1"/>', ""),
        ("weak-servo", '<position joint="shoulder" kp="20" kv="40"/>', ""),
        ("no-armature", '<velocity joint="shoulder" kv="2000"/>', ""),
        ("force-range-too-small", '<position joint="shoulder" kp="200" kv="10"/>', 'actuatorfrcrange="-1 1"'),
        (
            "control-range-too-wide",
            '<position joint="shoulder" kp="200" kv="10" ctrlrange="-90 90"/>',
            'range="-90 90"',
        ),
        (
            "control-range-too-narrow",
            '<position joint="shoulder" kp="200" kv="10" ctrlrange="-1 1" gear="20"/>',
            'range="-60 60"',
        ),
        ("joint-frozen", '<motor joint="shoulder" ctrlrange="-1 1" gear="5"/>', 'frictionloss="8"'),
        ("target-not-held", '<general joint="shoulder" biastype="affine" gainprm="9" biasprm="0 9 -1"/>', ""),
        (
            "target-not-held",
            '<general tendon="cable" biastype="affine" gainprm="9" biasprm="0 9 -1"/></actuator>'
            '<tendon><fixed name="cable"><joint joint="shoulder" coef="0.5"/></fixed></tendon><actuator>',
            "",
        ),
    ],
)
def test_a_fault_is_named_however_the_actuator_is_written(rule, actuator, joint):
    found = arm(actuator, joint)
    assert rule in {each.rule for each in (found.hints if rules()[rule].level == "hint" else found.causes)}


@pytest.mark.parametrize(
    ("symptom", "actuator", "told"),
    [
        ("sags", 'kp="60" kv="10"', "weak-servo"),
        ("oscillates", 'kp="60" kv="10"', ""),
        ("", 'kp="60" kv="10"', ""),
        ("oscillates", 'kp="2000" dampratio="0.3"', "undamped-servo"),
        ("sags", 'kp="2000" dampratio="0.3"', ""),
        ("oscillates", 'kp="2000" dampratio="0.7"', ""),
    ],
)
def test_what_explains_the_symptom_that_is_named_is_told_from_smaller_numbers_on(symptom, actuator, told):
    text = ARM.format(above="", joint="", actuator=f'<position joint="shoulder" {actuator}/>')
    found = examine(NativeEngine(), {"model.xml": text}, symptom=symptom, select=["weak-servo", "undamped-servo"])
    assert [each.rule for each in found.hints] == [told] * bool(told)
    assert not found.causes


@pytest.mark.parametrize(("targets", "told"), [("-200 300", True), ("-1 1.5", False)])
def test_targets_in_mm_of_a_slide_with_a_limited_force_are_told(targets, told):
    rams = "".join(
        f'<body pos="0 {i} 1"><joint name="ram{i}" type="slide" axis="1 0 0" range="-0.2 0.3" damping="50"/>'
        '<geom size="0.05" mass="5"/></body>'
        for i in range(2)
    )
    servos = "".join(
        f'<position joint="ram{i}" kp="5000" kv="300" ctrlrange="{each}" forcerange="-300 300"/>'
        for i, each in enumerate((targets, "-0.2 0.3"))
    )
    text = f"<mujoco><worldbody>{rams}</worldbody><actuator>{servos}</actuator></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["control-range-too-wide"]).hints
    assert [each.value for each in found] == ["-0.2 0.3"] * told


def test_a_servo_in_a_default_class_is_mended_there():
    text = ARM.format(
        above='<default><position kp="200"/></default>', joint="", actuator='<position joint="shoulder"/>'
    )
    found = next(each for each in diagnosed(text).causes if each.rule == "undamped-servo")
    assert found.after is not None
    assert found.after < 0.1 < found.before


def test_a_gain_that_only_the_timestep_cannot_follow_is_the_timesteps_fault():
    calm = arm('<position joint="shoulder" kp="200" kv="40"/>')
    long = arm('<position joint="shoulder" kp="200" kv="40"/>', above='<option timestep="0.02"/>')
    assert causes(calm) == []
    assert causes(long) == ["timestep-too-long"]


def test_the_start_outside_of_a_range_is_a_hint_and_a_keyframes_is_a_cause():
    joint, key = 'range="30 90"', '<keyframe><key qpos="0"/></keyframe>'
    without, with_key = arm("", joint), arm("", joint, above=key)
    assert (causes(without), [each.rule for each in without.hints]) == ([], ["start-outside-range"])
    assert causes(with_key) == ["key-outside-range"]


@pytest.mark.parametrize(
    ("knee", "others", "told"),
    [
        pytest.param('range="30 150"', 3, False, id="a-robot-as-it-is-drawn"),
        pytest.param('range="120 180"', 3, True, id="farther-than-any-knee"),
        pytest.param('range="30 150" ref="10"', 3, True, id="put-there"),
        pytest.param('range="30 150"', 1, True, id="no-robot"),
    ],
)
def test_the_pose_in_which_a_robot_is_drawn_may_be_outside_of_its_ranges(knee: str, others: int, told: bool):
    link = '<joint axis="0 1 0" range="-90 90"/><geom size="0.05"/>'
    bodies = "".join(f'<body pos="{x} 0 1">{link}</body>' for x in range(others))
    bodies += f'<body pos="-1 0 1"><joint name="knee" axis="0 1 0" {knee}/><geom size="0.05"/></body>'
    found = diagnosed(f"<mujoco><worldbody>{bodies}</worldbody></mujoco>")
    assert ("start-outside-range" in [each.rule for each in found.hints]) == told


def test_a_part_for_another_model_is_told_of_its_units_in_a_hint():
    text = ARM.format(above="", joint='range="-1.5 1.5"', actuator="")
    part = diagnosed(text.replace('<geom type="plane" size="1 1 0.1"/>', ""))
    assert causes(diagnosed(text)) == ["range-in-the-wrong-unit"]
    assert (causes(part), [each.rule for each in part.hints]) == ([], ["range-in-the-wrong-unit"])


def test_ranges_in_degrees_are_mended_one_by_one_where_other_angles_are_in_radians():
    text = ARM.format(above='<compiler angle="radian"/>', joint='range="-90 90"', actuator="")
    alone, turned = diagnosed(text), diagnosed(text.replace("<body ", '<body euler="0 0.5 0" ', 1))
    assert [(each.attribute, each.now, each.value) for each in alone.causes] == [("angle", "radian", "degree")]
    assert [(each.attribute, each.now, each.value) for each in turned.causes] == [("range", "-90 90", "-1.571 1.571")]


def test_a_urdf_is_mended_in_its_mimic_or_in_its_limit():
    text = """
<robot name="gripper">
  <link name="palm"/>
  <link name="left"><inertial><mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="right"><inertial><mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="leader" type="revolute">
    <parent link="palm"/><child link="left"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.8" effort="1" velocity="1"/>
  </joint>
  <joint name="follower" type="revolute">
    <parent link="palm"/><child link="right"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.8" effort="1" velocity="1"/>
    <mimic joint="leader" multiplier="-1"/>
  </joint>
</robot>
"""  # noqa: E501
    (found,) = (each for each in diagnosed(text).causes if each.rule == "follower-out-of-range")
    assert [(each.element, each.attribute, each.value) for each in found.edit] == [
        ("limit", "lower", "-0.8"),
        ("limit", "upper", "0"),
    ]

    turned = '<child link="right"/><axis xyz="0 0 -1"/>'  # with the other sign the fingers close against each other
    against = text.replace('<child link="right"/><axis xyz="0 0 1"/>', turned)
    (found,) = (each for each in diagnosed(against).causes if each.rule == "follower-out-of-range")
    assert [(each.element, each.attribute, each.value) for each in found.edit] == [("mimic", "multiplier", "1")]


@pytest.mark.parametrize(("damping", "named"), [(10000, ["weak-servo"]), (200, [])])
def test_a_slide_that_its_damping_all_but_holds_has_too_weak_a_servo(damping, named):
    body = f'<joint name="way" type="slide" axis="1 0 0" damping="{damping}" range="-1 1"/><geom size="0.1" mass="5"/>'
    servo = '<actuator><position joint="way" kp="50" ctrlrange="-1 1"/></actuator>'
    found = diagnosed(f'<mujoco><worldbody><body pos="0 0 1">{body}</body></worldbody>{servo}</mujoco>')
    assert [each for each in causes(found) if each == "weak-servo"] == named


@pytest.mark.parametrize(("damping", "named"), [(100, ["servo-held-back"]), (6, [])])
def test_what_a_joint_has_of_damping_is_not_said_of_a_stiff_servo(damping, named):
    body = f'<joint name="way" axis="0 0 1" damping="{damping}" range="-60 60"/><geom size="0.1" mass="5"/>'
    servo = '<actuator><position joint="way" kp="50" ctrlrange="-1 1"/></actuator>'
    found = diagnosed(f'<mujoco><worldbody><body pos="0 0 1">{body}</body></worldbody>{servo}</mujoco>')
    assert [each.rule for each in (*found.causes, *found.hints)] == named


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
    found = diagnosed(text)
    assert "no-armature" in causes(found)
    assert "timestep-too-long" not in causes(found)
    assert "no-armature" not in causes(diagnosed(text.replace('range="-30 30"', 'range="-30 30" armature="0.01"')))


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


def test_the_damping_of_a_joint_is_explicit_beyond_what_the_joints_around_it_leave():
    link = '<body pos="0 0 {}"><joint damping="2" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 .5" size=".02"'
    text = '<mujoco><option timestep="0.01" integrator="RK4"/><worldbody>' + link.format(0) + ' mass=".2"/>'
    text += (
        link.format(0.5) + ' mass=".15"/></body></body></worldbody><actuator><motor joint="one" gear="9"/></actuator>'
    )
    assert "damping-explicit" in causes(diagnosed(text.replace("<joint", '<joint name="one"', 1) + "</mujoco>"))


@pytest.mark.parametrize(("integrator", "told"), [("Euler", True), ("implicitfast", False)])
def test_damping_of_a_servo_is_explicit_but_for_the_implicit_integrators(integrator, told):
    found = diagnosed(FOREARM.format(integrator=integrator, kv=5, force=""))
    assert ("damping-explicit" in [each.rule for each in found.hints]) is told, found.text()


@pytest.mark.parametrize(("times", "told"), [("10 40", True), ("0.01 0.04", False)])
def test_a_muscle_whose_times_are_in_milliseconds_lags(times, told):
    muscle = f'<muscle joint="shoulder" timeconst="{times}" lengthrange="-1 1"/>'
    hints = [each for each in arm(muscle, 'range="-60 60"').hints if each.rule == "slow-filter"]
    assert [(each.attribute, each.value) for each in hints] == [("timeconst", "0.01 0.04")] * told


@pytest.mark.parametrize(("kind", "told"), [("muscle", False), ("motor", True)])
def test_two_muscles_pull_one_joint_and_two_motors_do_not(kind, told):
    links = ""
    for name in ("wrist", "elbow", "shoulder"):
        joint = f'<joint name="{name}" axis="0 1 0" damping="1" range="-60 60"/>'
        links = f'<body pos="0.2 0 0">{joint}<geom type="capsule" size="0.02" fromto="0 0 0 0.2 0 0"/>{links}</body>'
    lengths = ' lengthrange="-1 1"' if kind == "muscle" else ""
    both = (f'<{kind} joint="{joint}" gear="{gear}"{lengths}/>' for joint in ("shoulder", "elbow") for gear in (5, -5))
    text = f"<mujoco><worldbody>{links}</worldbody><actuator>{''.join(both)}</actuator></mujoco>"
    assert ("driven-twice" in [each.rule for each in diagnosed(text).hints]) is told


ROLLERS = """
<mujoco>
  <worldbody>
    {bodies}
  </worldbody>
  <actuator>
    {motors}
  </actuator>
</mujoco>
"""


def rollers(**change: str) -> list[tuple[str, tuple[str, ...]]]:
    """What is found of five rollers, each by itself; `m3` is the line of a motor in place of its own."""
    numbers = range(5)
    bodies = "".join(
        f'<body pos="{0.2 * each} 0 1"><joint name="r{each}" axis="0 1 0" damping="0.01" armature="0.01"/>'
        '<geom type="cylinder" size="0.05 0.2" zaxis="0 1 0"/></body>'
        for each in numbers
    )
    motors = {f"m{each}": f'joint="r{each}" kv="1" ctrlrange="-5 5"' for each in numbers} | change
    lines = "".join(f'<velocity name="{name}" {rest}/>' for name, rest in motors.items())
    found = diagnosed(ROLLERS.format(bodies=bodies, motors=lines))
    return [(each.rule, each.elements) for each in (*found.causes, *found.hints)]


def test_rollers_that_stand_by_themselves_are_compared():
    assert rollers() == []
    assert rollers(m3='joint="r3" kv="0.001" ctrlrange="-5 5"')[0] == ("strength-unlike-others", ('actuator "m3"',))
    ((rule, elements), *_) = rollers(m3='joint="r2" kv="1" ctrlrange="-5 5"')
    assert (rule, elements) == ("driven-twice", ('actuator "m3"', 'actuator "m2"', 'joint "r2"'))


def test_an_actuator_that_is_called_like_the_beginning_of_an_idle_joint_was_meant_for_it():
    pole = '<body><joint name="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 0.5" size="0.02"/></body>'
    cart = f'<body pos="0 0 1"><joint name="slider" type="slide" axis="1 0 0"/><geom size="0.1"/>{pole}</body>'
    text = f'<mujoco><worldbody>{cart}</worldbody><actuator><motor name="slide" joint="{{}}"/></actuator></mujoco>'
    found = {joint: causes(diagnosed(text.format(joint))) for joint in ("hinge", "slider")}
    assert found == {"hinge": ["actuator-on-another-joint"], "slider": []}


@pytest.mark.parametrize(
    ("ram", "told"),
    [("boom_cylinder", []), ("stick_cylinder", ["actuator-on-another-joint", "sensor-on-another-joint"])],
)
def test_a_hinge_that_a_ram_of_its_name_moves_is_not_the_one_that_was_meant(ram, told):
    rod = f'<joint name="{ram}" type="slide"/><geom size="0.1"/>'
    boom = f'<body pos="0 0 1"><joint name="boom" axis="0 1 0"/><geom size="0.1" pos="1 0 0"/><body>{rod}</body></body>'
    joint = f'joint="{ram}"'
    driven = f'<actuator><position name="boom" kp="1e4" {joint}/></actuator>'
    sensed = f'<sensor><jointpos name="boom_stroke" {joint}/></sensor>'
    found = diagnosed(f"<mujoco><worldbody>{boom}</worldbody>{driven}{sensed}</mujoco>")
    assert [each.rule for each in (*found.causes, *found.hints) if "another-joint" in each.rule] == told


def test_a_gear_goes_without_the_gains_that_the_others_have_as_well():
    actuators = '<position joint="shoulder" kp="200" kv="9" gear="50" ctrlrange="-1.5 1.5"/>'
    actuators += '<position joint="shoulder" kp="{kp}" kv="9" ctrlrange="-1.5 1.5"/>'
    edits = {}
    for kp in ("200", "100"):
        text = ARM.format(above="", joint='range="-90 90"', actuator=actuators.format(kp=kp))
        model = ReaderModel(NativeEngine(), {"model.xml": text}, read_source({"model.xml": text}), Start())
        edits[kp] = {edit.attribute: edit.value for edit in ungeared(model, servos(model.simulation)[0])}
    assert edits["200"] == {"gear": "1"}
    assert edits["100"]["kp"] == "500000"


@pytest.mark.parametrize(
    ("wheel", "told"),
    [
        pytest.param('kv="0.1" forcerange="-5 5"', ("kv", "2"), id="gain"),
        pytest.param('kv="20" forcerange="-0.3 0.3"', ("forcerange", "6"), id="force"),
    ],
)
def test_a_wheel_below_its_speed_is_told_by_what_helps(wheel, told):
    actuator = f'<velocity joint="shoulder" {wheel} ctrlrange="-6 6"/>'
    found = examine(
        NativeEngine(),
        {"model.xml": ARM.format(above='<option gravity="0 0 0"/>', joint='frictionloss="0.4"', actuator=actuator)},
        select=["speed-not-reached"],
    )
    assert [(each.attribute, each.value) for each in found.hints] == [told]
    assert 'Told 3 rad/s, joint "shoulder" misses' in found.hints[0].says


@pytest.mark.parametrize(("mass", "told"), [(0.5, True), (0.02, False)])
def test_a_gripper_may_be_weaker_than_the_arm_that_carries_it(mass: float, told: bool):
    text = rules()["strength-unlike-others"].example("Good").replace('gear="20"', 'gear="0.9"')
    text = text.replace('fromto="0 0 0 0.05 0 0"', f'fromto="0 0 0 0.05 0 0" mass="{mass}"')
    found = examine(NativeEngine(), {"model.xml": text}, select=["strength-unlike-others"]).hints
    assert [each.elements for each in found] == [('actuator "toe"',)] * told


@pytest.mark.parametrize(("driven", "told"), [("wrist", []), ("f1", ['actuator "A_f1"'])])
def test_a_wrist_may_be_stronger_than_the_fingers_that_it_carries(driven, told):
    fingers = "".join(
        f'<body pos="0.1 {0.03 * each} 0"><joint name="f{each}" axis="0 1 0" damping="0.1" armature="0.002"/>'
        '<geom type="capsule" fromto="0 0 0 0.06 0 0" size="0.008" mass="0.02"/></body>'
        for each in range(4)
    )
    names = ("wrist", *(f"f{each}" for each in range(4)))
    servos = "".join(
        f'<position name="A_{name}" joint="{name}" kp="{20 if name == driven else 2}" kv="0.1"/>' for name in names
    )
    text = '<mujoco><option gravity="0 0 0"/><worldbody><body pos="0 0 1"><joint name="wrist" axis="0 1 0" damping="1" '
    text += f'armature="0.01"/><geom type="box" size="0.05 0.05 0.01" pos="0.05 0 0" mass="0.1"/>{fingers}</body>'
    found = examine(
        NativeEngine(),
        {"model.xml": f"{text}</worldbody><actuator>{servos}</actuator></mujoco>"},
        select=["strength-unlike-others"],
    )
    assert [name for each in found.hints for name in each.elements] == told


@pytest.mark.parametrize(("rest", "told"), [("-75", False), ("160", True)])
def test_a_spring_that_holds_a_door_shut_is_well(rest, told):
    doors = "".join(
        f'<body pos="{x} 0 1"><joint name="d{x}" axis="0 1 0" range="0 85" stiffness="5" damping="1" springref="{{}}"/>'
        '<geom type="box" size="0.2 0.3 0.01" pos="0.2 0 0" mass="1"/></body>'
        for x in range(3)
    )
    text = f"<mujoco><worldbody>{doors.format('0', '0', rest)}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["spring-far-off"])
    assert bool(found.hints or found.causes) == told


@pytest.mark.parametrize(("beside", "told"), [("", True), ('<motor joint="shoulder"/>', False)])
def test_a_servo_beside_a_motor_need_not_carry_the_weight(beside, told):
    found = arm(f'<position joint="shoulder" kp="1" kv="0.1"/>{beside}', joint='damping="0.2"')
    assert ("weak-servo" in causes(found)) == told


@pytest.mark.parametrize(("armature", "told"), [("0", ["no-armature"]), ("1", [])])
def test_a_gripper_that_begins_shut_is_nudged_within_its_range(armature, told):
    text = f"""
<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <joint name="finger" type="slide" axis="0 1 0" range="0 0.03" armature="{armature}"/>
      <geom type="box" size="0.04 0.006 0.01" mass="0.04"/>
    </body>
  </worldbody>
  <actuator>
    <position joint="finger" kp="1000" kv="100" ctrlrange="0 0.03" forcerange="-50 50"/>
  </actuator>
</mujoco>
"""
    assert causes(diagnosed(text)) == told


@pytest.mark.parametrize(("kv", "told"), [("20", True), ("4", False)])
def test_a_servo_whose_kv_is_that_of_a_second_lags(kv, told):
    found = arm(f'<position joint="shoulder" kp="20" kv="{kv}"/>', 'damping="0.1"')
    assert ("slow-filter" in [each.rule for each in found.hints]) is told, found.text()


def row(joints: list[str], servo: str) -> Diagnosis:
    """Levers side by side on a free base, a servo each."""
    links = "".join(
        f'<body pos="0 {0.2 * index} 0"><joint name="j{index}" axis="0 0 1" damping="1" {joint}/>'
        '<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/></body>'
        for index, joint in enumerate(joints)
    )
    drives = "".join(f'<position joint="j{index}" kp="20" kv="2" {servo}/>' for index in range(len(joints)))
    robot = f'<body><freejoint/><geom type="box" size="0.1 1.5 0.1"/>{links}</body>'
    return diagnosed(f"<mujoco><worldbody>{robot}</worldbody><actuator>{drives}</actuator></mujoco>")


@pytest.mark.parametrize(("bare", "told"), [(1, True), (4, False)])
def test_one_servo_without_armature_among_many_is_told(bare, told):
    found = row([f'armature="{0.01 * (index >= bare)}"' for index in range(8)], "")
    assert ("armature-unlike-others" in [each.rule for each in found.hints]) is told, found.text()


STOOL = """
<mujoco>
  <worldbody>
    <geom type="plane" size="3 3 0.1"/>
    <body name="trunk" pos="0 0 0.72">
      <freejoint/>
      <geom type="box" size="0.1 0.1 0.1" mass="10" pos="0.01 0 0"/>
      {legs}
    </body>
  </worldbody>
  <actuator>{servos}</actuator>
</mujoco>
"""


@pytest.mark.parametrize(("kp", "told"), [(10, True), (20, False), (100, False)])
def test_a_robot_that_falls_after_a_while_has_too_little_stiffness(kp, told):
    legs = "".join(
        f'<body pos="0 {y} -0.1"><joint name="hip{y}" axis="0 1 0" damping="3"/>'
        '<geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="1"/>'
        f'<body pos="0 0 -0.3"><joint name="ankle{y}" axis="0 1 0" damping="3"/>'
        '<geom type="box" size="0.08 0.03 0.02" pos="0 0 -0.3" mass="0.5"/></body></body>'
        for y in (-0.1, 0.1)
    )
    names = [f"{name}{y}" for y in (-0.1, 0.1) for name in ("hip", "ankle")]
    servos = "".join(f'<position joint="{name}" kp="{kp}" kv="2"/>' for name in names)
    found = diagnosed(STOOL.format(legs=legs, servos=servos))
    said = [each for each in (*found.causes, *found.hints) if "falls within 5 s" in each.says]
    assert [each.rule for each in said] == ["weak-servo"] * told, found.text()


@pytest.mark.parametrize(("kp", "told"), [(100, True), (200, False)])
def test_a_finger_may_sag_by_a_tenth_of_its_way(kp: float, told: bool):
    slide = '<body pos="0 0 1"><joint name="finger" type="slide" axis="0 0 1" range="0 0.04" damping="2"/>'
    text = f'<mujoco><worldbody>{slide}<geom size="0.01" mass="0.05"/></body></worldbody>'
    text += f'<actuator><position joint="finger" kp="{kp}"/></actuator></mujoco>'
    found = examine(NativeEngine(), {"model.xml": text}, select=["weak-servo"]).hints
    assert [each.attribute for each in found] == ["kp"] * told


@pytest.mark.parametrize(("servo", "told"), [("", True), ('ctrlrange="-1 1"', False)])
def test_no_servo_with_a_control_range_is_told_once(servo, told):
    found = row(4 * ['range="-60 60"'], servo)
    said = [each for each in found.hints if each.rule == "control-range-forgotten"]
    assert [len(each.edit) for each in said] == [4] * told, found.text()


def test_servos_that_damping_mends_are_told_without_one_that_it_does_not():
    """The third is thrown to and fro by its clipped force, whatever damps it."""
    arm = "".join(
        f'<body name="b{i}" pos="{i} 0 1"><joint name="j{i}" axis="0 0 1"/>'
        f'<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="{mass}"/></body>'
        for i, mass in enumerate((2, 2, 0.005))
    )
    servos = "".join(f'<position name="s{i}" joint="j{i}" kp="500" forcerange="-28 28"/>' for i in range(3))
    text = (
        f'<mujoco><option integrator="implicitfast"/><worldbody>{arm}</worldbody><actuator>{servos}</actuator></mujoco>'
    )
    (found,) = examine(NativeEngine(), {"model.xml": text}, select=["undamped-servo"]).causes
    assert found.elements == ('actuator "s0"', 'actuator "s1"')


@pytest.mark.parametrize(
    ("hip", "knee", "mended"),
    [
        ('position class="leg"', 'motor class="leg"', ['<position class="leg" joint="knee" ctrlrange="-0.5 1.4"/>']),
        ('position kp="20"', "motor", []),
        ('position class="leg" kp="20"', 'motor class="leg"', []),
    ],
)
def test_a_motor_of_a_class_that_gives_the_gains_of_servos_is_written_as_one(hip, knee, mended):
    link = '<body pos="0 0 1"><joint name="{0}" axis="0 1 0" range="{1}"/><geom size="0.1" mass="1"/>{2}</body>'
    text = (
        '<mujoco><compiler angle="radian"/><default><default class="leg"><position kp="20" kv="1"/></default></default>'
        f"<worldbody>{link.format('hip', '-1.1 0.7', link.format('knee', '-0.5 1.4', ''))}</worldbody><actuator>"
        f'<{hip} joint="hip" ctrlrange="-1.1 0.7"/><{knee} joint="knee" ctrlrange="-0.5 1.4"/></actuator></mujoco>'
    )
    (told,) = examine(NativeEngine(), {"model.xml": text}, select=["motor-for-position"]).hints
    assert [each.value for each in told.edit] == mended


@pytest.mark.parametrize(
    ("friction", "force", "kp", "value"),
    [
        pytest.param(10, 24, 60, "0.24", id="a-good-part-of-the-force"),
        pytest.param(30, 24, 60, "0.24", id="more-than-it"),
        pytest.param(1, 24, 60, None, id="a-little"),
        pytest.param(10, 24, 600, None, id="of-a-stiff-servo"),
        pytest.param(10, 200, 60, None, id="of-a-strong-servo"),
    ],
)
def test_friction_that_takes_a_good_part_of_a_servos_force_is_told(friction, force, kp, value):
    servo = f'<position joint="shoulder" kp="{kp}" kv="3" forcerange="-{force} {force}"/>'
    found = [each for each in arm(servo, f'frictionloss="{friction}"').hints if each.rule == "joint-frozen"]
    assert [(each.attribute, each.value) for each in found] == [("frictionloss", value)] * (value is not None)


@pytest.mark.parametrize(
    ("joint", "told"),
    [
        pytest.param('frictionloss="40"', [("joint-frozen", "frictionloss")], id="friction"),
        pytest.param('stiffness="150" springref="0.25"', [("spring-against-servo", "stiffness")], id="spring"),
        pytest.param('frictionloss="1" stiffness="2" springref="0.25"', [], id="well"),
    ],
)
def test_what_a_motor_at_a_site_cannot_move_is_told(joint, told):
    text = f"""<mujoco><compiler angle="radian"/><worldbody><body>
      <joint name="hinge" axis="0 0 1" range="-1.7 0" damping="1.2" {joint}/>
      <geom type="box" size="0.45 0.02 1" pos="0.45 0 1" mass="9"/><site name="grip" pos="0.74 0 1"/></body></worldbody>
    <actuator><motor site="grip" gear="0 -1 0 0 0 0" ctrlrange="-40 40"/></actuator></mujoco>"""
    found = examine(NativeEngine(), {"model.xml": text}, select=["joint-frozen", "spring-against-servo"]).hints
    assert [(each.rule, each.attribute) for each in found] == told
    assert all(each.after is not None for each in found)


@pytest.mark.parametrize(
    ("kv", "force", "told"),
    [
        pytest.param(0.02, 'forcerange="-8 8"', True, id="a-weak-gain-of-a-strong-servo"),
        pytest.param(0.02, 'forcerange="-1 1"', False, id="of-a-weak-one"),
        pytest.param(0.02, "", False, id="of-one-without-limits"),
        pytest.param(0.2, 'forcerange="-8 8"', False, id="a-gain-that-is-strong-enough"),
    ],
)
def test_a_wheel_that_needs_seconds_to_its_speed_is_told(kv, force, told):
    text = rules()["speed-not-reached"].example("Good").replace('kv="0.2"', f'kv="{kv}" {force}')
    text = text.replace('damping="0.01"', 'damping="0.001"').replace('mass="3"', 'mass="12"')
    found = examine(NativeEngine(), {"model.xml": text}, select=["speed-not-reached"]).hints
    assert [(each.attribute, each.value) for each in found] == [("kv", "0.4")] * told


@pytest.mark.parametrize(
    ("waist", "count", "told"),
    [
        pytest.param('range="-40 60"', 8, True, id="alone-among-eight"),
        pytest.param('range="-40 60"', 5, False, id="among-five"),
        pytest.param("", 8, False, id="without-a-range"),
        pytest.param('range="-40 60" stiffness="9"', 8, False, id="on-a-spring"),
    ],
)
def test_the_only_joint_of_a_robot_that_nothing_drives_is_told(waist: str, count: int, told: bool) -> None:
    names = ["neck", "hip", "knee", "ankle", "elbow", "shoulder", "wrist", "jaw"][:count]
    limbs = "".join(f'<body><joint name="{name}" axis="1 0 0"/><geom size="0.05"/></body>' for name in names)
    torso = f'<body><joint name="waist" axis="0 1 0" {waist}/><geom size="0.1"/></body>'
    servos = "".join(f'<position joint="{name}" kp="50"/>' for name in names)
    trunk = f'<body pos="0 0 1"><freejoint/><geom size="0.1"/>{torso}{limbs}</body>'
    text = f"<mujoco><worldbody>{trunk}</worldbody><actuator>{servos}</actuator></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["joint-not-driven"]).hints
    assert [each.elements for each in found] == [('joint "waist"',)] * told


@pytest.mark.parametrize(
    ("left", "right", "told"),
    [
        pytest.param("", 'stiffness="1"', False, id="a-spring-of-its-own"),
        pytest.param('stiffness="1"', 'stiffness="1"', True, id="the-spring-of-its-twin"),
    ],
)
def test_a_spring_that_the_driven_twin_has_too_moves_nothing(left: str, right: str, told: bool) -> None:
    text = rules()["joint-not-driven"].example("Bad")
    for side, spring in (("left", left), ("right", right)):
        text = text.replace(f'<joint name="{side}_arm"', f'<joint name="{side}_arm" {spring}')
    found = examine(NativeEngine(), {"model.xml": text}, select=["joint-not-driven"]).hints
    assert [each.elements for each in found] == [('joint "right_arm"',)] * told


@pytest.mark.parametrize(
    ("given", "own", "mass", "written"),
    [
        ('kp="500" dampratio="1" forcerange="-1 1"', "", 2, {"of the class": "-22 22"}),
        ('kp="500" dampratio="1" forcerange="-1 1"', 'forcerange="-2 2"', 2,
         {"of the class": "-22 22", "its own": "-15 15"}),
        ('kp="1"', "", 3, {"of the class": "368"}),
    ],
    ids=["the largest for the class", "one with its own", "one gain for the class"],
)  # fmt: skip
def test_what_servos_have_from_a_class_is_mended_there(given, own, mass, written):
    arms = "".join(
        f'<body pos="0 {each} 1"><joint name="{each}" axis="0 1 0"/>'
        f'<geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="{each}"/></body>'
        for each in (mass, 3.0)
    )
    servos = f'<actuator><position joint="{mass}" {own}/><position joint="3.0"/></actuator>'
    text = f"<mujoco><default><position {given}/></default><worldbody>{arms}</worldbody>{servos}</mujoco>"
    (found,) = (each for each in diagnosed(text).causes if each.attribute in ("forcerange", "kp"))
    place = text.index("<worldbody>")
    assert {("of the class" if each.start < place else "its own"): each.value for each in found.edit} == written
    assert len(found.edit) == len(written)


@pytest.mark.parametrize(
    ("nut", "ctrlrange", "values"),
    [
        pytest.param("", "-0.2 0.02", ["-20 2"], id="the-followers-own"),
        pytest.param("", "-20 2", [], id="what-leads-all-over"),
        pytest.param("", "-5 2", [], id="a-third"),
        pytest.param('range="-1146 115"', "-20 2", [], id="with-a-range"),
    ],
)
def test_a_servo_that_leads_another_joint_next_to_nowhere_is_told(nut: str, ctrlrange: str, values: list[str]) -> None:
    joints = f'<joint name="nut" {nut}/>', '<joint name="quill" type="slide" range="-0.2 0.02"/>'
    links = "".join(f'<body>{joint}<geom size="0.03"/></body>' for joint in joints)
    screw = '<equality><joint joint1="quill" joint2="nut" polycoef="0 0.01 0 0 0"/></equality>'
    servo = f'<actuator><position joint="nut" kp="2" kv="1" ctrlrange="{ctrlrange}"/></actuator>'
    text = f"<mujoco><worldbody>{links}</worldbody>{screw}{servo}</mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["control-range-too-narrow"])
    assert [each.value for each in found.hints] == values


def test_a_servo_that_rings_beside_its_twin_of_the_same_gains_moves_what_is_unlike() -> None:
    def leg(side: str, y: float, far: float) -> str:
        return f'<body pos="0 {y} 1"><joint name="{side}_hip" axis="0 1 0"/><geom size="0.05" pos="{far} 0 0"/></body>'

    drive = '<position name="{0}" joint="{0}" kp="50" kv="1.5"/>'
    driven = "".join(drive.format(f"{side}_hip") for side in ("left", "right"))
    text = "<mujoco><worldbody>{}{}</worldbody><actuator>{}</actuator></mujoco>"
    found = {
        far: [each.level for each in (*told.causes, *told.hints)]
        for far in (0.3, 3)
        for told in [
            examine(
                NativeEngine(),
                {"model.xml": text.format(leg("left", 0.1, 3), leg("right", -0.1, far), driven)},
                select=["undamped-servo"],
            )
        ]
    }
    assert found == {0.3: ["hint"], 3: ["cause"]}


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
    found = {kp: [(each.rule, each.value) for each in diagnosed(text.format(kp)).causes] for kp in ("40", "0.4")}
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
    found = examine(NativeEngine(), {"model.xml": text}, select=["damping-explicit", "timestep-too-long"])
    assert [(each.rule, each.elements) for each in (*found.causes, *found.hints)] == [
        ("damping-explicit", ('joint "ram"',))
    ] * told
