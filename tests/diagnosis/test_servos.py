"""Servos and joints: near misses, healthy models that look ill, and elements without a place."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import Diagnosis
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.rules.servo.control_range_too_narrow import ungeared
from clinic.diagnosis.simulation import Start
from clinic.diagnosis.source import read_source
from diagnosed import causes, diagnosed, findings, hints

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


def arm(actuator: str, joint: str = "", above: str = "") -> Diagnosis:
    return diagnosed(ARM.format(actuator=actuator, joint=joint, above=above))


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
    assert not arm(actuator, joint).causes


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
    found = diagnosed(text, "weak-servo", "undamped-servo", symptom=symptom)
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
    assert [each.value for each in hints(text, "control-range-too-wide")] == ["-0.2 0.3"] * told


def test_a_servo_in_a_default_class_is_mended_there():
    text = ARM.format(
        above='<default><position kp="200"/></default>', joint="", actuator='<position joint="shoulder"/>'
    )
    found = next(each for each in causes(text) if each.rule == "undamped-servo")
    assert found.after is not None
    assert found.after < 0.1 < found.before


def test_a_gain_that_only_the_timestep_cannot_follow_is_the_timesteps_fault():
    calm = arm('<position joint="shoulder" kp="200" kv="40"/>')
    long = arm('<position joint="shoulder" kp="200" kv="40"/>', above='<option timestep="0.02"/>')
    assert not calm.causes
    assert [each.rule for each in long.causes] == ["timestep-too-long"]


def test_the_start_outside_of_a_range_is_a_hint_and_a_keyframes_is_a_cause():
    joint, key = 'range="30 90"', '<keyframe><key qpos="0"/></keyframe>'
    without, with_key = arm("", joint), arm("", joint, above=key)
    assert not without.causes
    assert [each.rule for each in without.hints] == ["start-outside-range"]
    assert [each.rule for each in with_key.causes] == ["key-outside-range"]


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
    part = text.replace('<geom type="plane" size="1 1 0.1"/>', "")
    assert [each.rule for each in causes(text)] == ["range-in-the-wrong-unit"]
    assert [(each.rule, each.level) for each in findings(part)] == [("range-in-the-wrong-unit", "hint")]


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
    (found,) = (each for each in causes(text) if each.rule == "follower-out-of-range")
    assert [(each.element, each.attribute, each.value) for each in found.edit] == [
        ("limit", "lower", "-0.8"),
        ("limit", "upper", "0"),
    ]

    turned = '<child link="right"/><axis xyz="0 0 -1"/>'  # with the other sign the fingers close against each other
    against = text.replace('<child link="right"/><axis xyz="0 0 1"/>', turned)
    (found,) = (each for each in causes(against) if each.rule == "follower-out-of-range")
    assert [(each.element, each.attribute, each.value) for each in found.edit] == [("mimic", "multiplier", "1")]


@pytest.mark.parametrize(("damping", "named"), [(10000, ["weak-servo"]), (200, [])])
def test_a_slide_that_its_damping_all_but_holds_has_too_weak_a_servo(damping, named):
    body = f'<joint name="way" type="slide" axis="1 0 0" damping="{damping}" range="-1 1"/><geom size="0.1" mass="5"/>'
    servo = '<actuator><position joint="way" kp="50" ctrlrange="-1 1"/></actuator>'
    found = diagnosed(f'<mujoco><worldbody><body pos="0 0 1">{body}</body></worldbody>{servo}</mujoco>')
    assert [each.rule for each in found.causes if each.rule == "weak-servo"] == named


@pytest.mark.parametrize(("times", "told"), [("10 40", True), ("0.01 0.04", False)])
def test_a_muscle_whose_times_are_in_milliseconds_lags(times, told):
    muscle = f'<muscle joint="shoulder" timeconst="{times}" lengthrange="-1 1"/>'
    hints = [each for each in arm(muscle, 'range="-60 60"').hints if each.rule == "slow-filter"]
    assert [(each.attribute, each.value) for each in hints] == [("timeconst", "0.01 0.04")] * told


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
    found = hints(
        ARM.format(above='<option gravity="0 0 0"/>', joint='frictionloss="0.4"', actuator=actuator),
        "speed-not-reached",
    )
    assert [(each.attribute, each.value) for each in found] == [told]
    assert 'Told 3 rad/s, joint "shoulder" misses' in found[0].says


@pytest.mark.parametrize(
    ("force", "told"), [pytest.param(0.5, True, id="a weak servo"), pytest.param(1.2, False, id="a strong one")]
)
def test_wheels_that_are_blocked_are_not_told_a_greater_force(force, told):
    text = rules()["speed-not-reached"].example("Good").replace('kv="0.2"', f'kv="200" forcerange="-{force} {force}"')
    text = text.replace('mass="3"', 'mass="30"').replace('ctrlrange="-20 20"', 'ctrlrange="-6 6"')
    text = text.replace('euler="90 0 0"', 'euler="90 0 0" friction="1 0.005 0.01" condim="6"')  # rolls hard
    assert [each.attribute for each in hints(text, "speed-not-reached")] == ["forcerange"] * told


@pytest.mark.parametrize(("beside", "told"), [("", True), ('<motor joint="shoulder"/>', False)])
def test_a_servo_beside_a_motor_need_not_carry_the_weight(beside, told):
    found = arm(f'<position joint="shoulder" kp="1" kv="0.1"/>{beside}', joint='damping="0.2"')
    assert ("weak-servo" in [each.rule for each in found.causes]) == told


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
    assert [each.rule for each in causes(text)] == told


@pytest.mark.parametrize(
    ("kp", "kv", "told"),
    [
        pytest.param(400, 400, True, id="a second"),
        pytest.param(400, 80, False, id="a fifth"),
        pytest.param(20, 20, False, id="a weak servo, whose kp is too small"),
    ],
)
def test_a_servo_whose_kv_is_that_of_a_second_lags(kp, kv, told):
    found = arm(f'<position joint="shoulder" kp="{kp}" kv="{kv}"/>', 'damping="0.1"')
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


@pytest.mark.parametrize(
    ("kp", "symptom", "told"), [(10, "", True), (20, "", False), (20, "sags", True), (100, "sags", False)]
)
def test_a_robot_that_falls_after_a_while_has_too_little_stiffness(kp, symptom, told):
    legs = "".join(
        f'<body pos="0 {y} -0.1"><joint name="hip{y}" axis="0 1 0" damping="3"/>'
        '<geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="1"/>'
        f'<body pos="0 0 -0.3"><joint name="ankle{y}" axis="0 1 0" damping="3"/>'
        '<geom type="box" size="0.08 0.03 0.02" pos="0 0 -0.3" mass="0.5"/></body></body>'
        for y in (-0.1, 0.1)
    )
    names = [f"{name}{y}" for y in (-0.1, 0.1) for name in ("hip", "ankle")]
    servos = "".join(f'<position joint="{name}" kp="{kp}" kv="2"/>' for name in names)
    text = STOOL.format(legs=legs, servos=servos)
    found = diagnosed(text, symptom=symptom)
    said = [each for each in (*found.causes, *found.hints) if "falls within 5 s" in each.says]
    assert [each.rule for each in said] == ["weak-servo"] * told, found.text()


@pytest.mark.parametrize(("kp", "told"), [(100, True), (200, False)])
def test_a_finger_may_sag_by_a_tenth_of_its_way(kp: float, told: bool):
    slide = '<body pos="0 0 1"><joint name="finger" type="slide" axis="0 0 1" range="0 0.04" damping="2"/>'
    text = f'<mujoco><worldbody>{slide}<geom size="0.01" mass="0.05"/></body></worldbody>'
    text += f'<actuator><position joint="finger" kp="{kp}"/></actuator></mujoco>'
    assert [each.attribute for each in hints(text, "weak-servo")] == ["kp"] * told


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
    (found,) = causes(text, "undamped-servo")
    assert found.elements == ('actuator "s0"', 'actuator "s1"')


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
    (found,) = (each for each in causes(text) if each.attribute in ("forcerange", "kp"))
    place = text.index("<worldbody>")
    assert {("of the class" if each.start < place else "its own"): each.value for each in found.edit} == written
    assert len(found.edit) == len(written)


def test_a_servo_that_rings_beside_its_twin_of_the_same_gains_moves_what_is_unlike() -> None:
    def leg(side: str, y: float, far: float) -> str:
        return f'<body pos="0 {y} 1"><joint name="{side}_hip" axis="0 1 0"/><geom size="0.05" pos="{far} 0 0"/></body>'

    drive = '<position name="{0}" joint="{0}" kp="50" kv="1.5"/>'
    driven = "".join(drive.format(f"{side}_hip") for side in ("left", "right"))
    text = "<mujoco><worldbody>{}{}</worldbody><actuator>{}</actuator></mujoco>"
    found = {
        far: findings(text.format(leg("left", 0.1, 3), leg("right", -0.1, far), driven), "undamped-servo")
        for far in (0.3, 3)
    }
    assert {far: [each.level for each in told] for far, told in found.items()} == {0.3: ["hint"], 3: ["cause"]}


@pytest.mark.parametrize(
    ("force", "told"),
    [pytest.param(0.6, [("hint", "forcerange", "3")], id="stands-on-it"), pytest.param(6, [], id="has-some-left")],
)
def test_motors_that_give_all_they_can_to_stand_still_are_told(force: float, told: list[tuple[str, str, str]]) -> None:
    legs = "".join(
        f'<body pos="{x} {y} 0" euler="0 0 {turn}"><joint name="leg{i}" axis="0 1 0" range="-60 60" damping="0.1" '
        'armature="0.004"/><geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.05" contype="0"/>'
        '<geom type="capsule" fromto="0.2 0 0 0.2 0 -0.08" size="0.02" mass="0.05"/></body>'
        for i, (x, y, turn) in enumerate(((0.1, 0.1, 45), (0.1, -0.1, -45), (-0.1, 0.1, 135), (-0.1, -0.1, -135)))
    )
    trunk = f'<body pos="0 0 0.1"><freejoint/><geom type="box" size="0.1 0.1 0.02" mass="2" contype="0"/>{legs}</body>'
    servos = "".join(f'<position joint="leg{i}" kp="40" kv="1" forcerange="-{force} {force}"/>' for i in range(4))
    floor = '<geom type="plane" size="2 2 0.1"/>'
    text = f"<mujoco><worldbody>{floor}{trunk}</worldbody><actuator>{servos}</actuator></mujoco>"
    assert [(each.level, each.attribute, each.value) for each in findings(text, "force-range-too-small")] == told


@pytest.mark.parametrize(
    ("force", "open_by", "told"),
    [(300, 0, ["1500"]), (3000, 0, []), (300, 0.2, [])],
    ids=["too weak", "strong", "not closed at the start"],
)
def test_a_ram_that_cannot_carry_what_its_loop_puts_on_it_is_told(
    force: float, open_by: float, told: list[str]
) -> None:
    rod = (
        '<body pos="0 0 0.3"><joint name="ram" type="slide" axis="0 0 1" range="-0.1 0.1" damping="100"/>'
        '<geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.01" mass="1"/>'
        f'<site name="eye" pos="0 0 {0.2 + open_by}"/></body>'
    )
    text = f"""<mujoco><worldbody>
      <body pos="0 0 1.5"><joint axis="0 1 0" range="-40 40"/><site name="lug" pos="0.3 0 0"/>
        <geom type="capsule" fromto="0 0 0 1 0 0" size="0.03" mass="20"/></body>
      <body pos="0.3 0 1"><joint axis="0 1 0" damping="1"/>
        <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02" mass="1"/>{rod}</body></worldbody>
      <equality><connect site1="eye" site2="lug"/></equality>
      <actuator><position joint="ram" kp="60000" kv="2000" forcerange="-{force} {force}"/></actuator></mujoco>"""
    assert [each.value for each in causes(text, "force-range-too-small")] == told


@pytest.mark.parametrize(("elbow", "told"), [("3", [("actuatorfrcrange", "15")]), ("20", [])])
def test_a_motor_far_harder_pressed_than_the_one_that_carries_it_is_told(
    elbow: str, told: list[tuple[str, str]]
) -> None:
    link = '<joint name="{0}" axis="0 1 0" range="-90 90" damping="1" actuatorfrcrange="-{1} {1}"/>'
    link += '<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>'
    forearm = f'<body pos="0.3 0 0">{link.format("elbow", elbow)}</body>'
    text = f"""<mujoco><worldbody><body pos="0 0 1">{link.format("shoulder", 60)}{forearm}</body></worldbody>
      <actuator><position joint="shoulder" kp="200" kv="10"/><position joint="elbow" kp="100" kv="5"/></actuator>
    </mujoco>"""
    found = diagnosed(text, "force-range-too-small")
    assert not found.causes
    assert [(each.attribute, each.value) for each in found.hints] == told


@pytest.mark.parametrize(
    ("force", "ratio", "spring", "more", "told"),
    [
        pytest.param(0.004, 785, "", "", True, id="weak"),
        pytest.param(0.02, 785, "", "", False, id="strong"),
        pytest.param(0.004, 785, "", '<motor joint="bed"/>', False, id="beside a motor"),
        pytest.param(0.004, 785, 'stiffness="100"', "", False, id="on a spring"),
        pytest.param(1.57, 2, "", "", True, id="another ratio"),
        pytest.param(3.14, 1, "", "", False, id="the ratio was left at 1"),
        pytest.param(
            1.57,
            2,
            "",
            '</actuator><keyframe><key qpos="0.1 78.5 78.5"/></keyframe><actuator>',
            False,
            id="a keyframe has another ratio",
        ),
    ],
)
def test_servos_of_screws_that_together_do_not_hold_a_bed_are_told(force, ratio, spring, more, told):
    screw = '<body pos="{1} 0 0"><joint name="{0}" axis="0 0 1" armature="0.00002"/><geom size="0.01"/></body>'
    servo = '<position joint="{0}" kp="2" kv="0.01" forcerange="-{1} {1}"/>'
    nut = '<joint joint1="{}" joint2="bed" polycoef="0 {} 0 0 0"/>'
    sides = (("left", -1), ("right", 1))
    text = f"""<mujoco><worldbody><body><joint name="bed" type="slide" axis="0 0 1" {spring}/>
      <geom size="0.1" mass="1"/></body>{"".join(screw.format(*side) for side in sides)}</worldbody>
      <equality>{"".join(nut.format(side, ratio) for side, _ in sides)}</equality>
      <actuator>{"".join(servo.format(side, force) for side, _ in sides)}{more}</actuator></mujoco>"""
    assert [each.value for each in causes(text, "force-range-too-small")] == [f"{14.8 / ratio:.2g}"] * told


@pytest.mark.parametrize(
    ("joint", "ctrl", "told"),
    [
        ("0 0.2356195", "0 2.356195", ("range", "0 2.3562")),
        ("-0.1 0.23", "-1 2.3", ("ctrlrange", "-0.1 0.23")),
        ("0 0.1745329", "0 1.745329", ("ctrlrange", "0 0.1745")),
        ("0 0.2356195", "0 2.618", ("ctrlrange", "0 0.2356")),
    ],
    ids=["135 degrees", "of no whole degrees", "10 degrees too", "another factor"],
)
def test_a_range_that_is_a_tenth_of_whole_degrees_is_told_in_place_of_the_targets(joint, ctrl, told):
    body = f'<body pos="0 0 1"><joint name="j" axis="0 1 0" range="{joint}" damping="1"/><geom size="0.05"/></body>'
    servo = f'<actuator><position joint="j" kp="20" ctrlrange="{ctrl}"/></actuator>'
    text = f'<mujoco><compiler angle="radian"/><worldbody>{body}</worldbody>{servo}</mujoco>'
    assert [(each.attribute, each.value) for each in hints(text, "control-range-too-wide")] == [told]


@pytest.mark.parametrize(
    ("kv", "others", "told"),
    [(400, 2.2, ("kv", "2.2")), (400, 400, ("kp", "8000")), (400, 40, ("kp", "8000"))],
    ids=["one of many", "as all are", "ten times the others'"],
)
def test_a_servo_that_is_late_by_its_own_kv_is_told_to_have_less_of_that(kv, others, told):
    arms = "".join(
        f'<body pos="0 {each} 1"><joint name="j{each}" axis="0 0 1"/>'
        '<geom type="capsule" fromto="0 0 0 0.6 0 0" size="0.06"/></body>'
        for each in range(5)
    )
    servos = "".join(f'<position joint="j{each}" kp="190" kv="{others if each else kv}"/>' for each in range(5))
    text = f"<mujoco><worldbody>{arms}</worldbody><actuator>{servos}</actuator></mujoco>"
    (found,) = causes(text, "weak-servo")
    assert (found.attribute, found.value) == told
    assert found.after < found.before / 2
