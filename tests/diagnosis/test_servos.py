"""Servos and joints: near misses, healthy models that look ill, and elements without a place."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import Diagnosis
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.rules.servo.control_range_too_narrow import ungeared
from clinic.diagnosis.source import read_source
from clinic.diagnosis.start import Start
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
    ("actuator", "told"),
    [
        pytest.param('position kp="500" forcerange="0 120"', [("forcerange", "-120 0")], id="servo"),
        pytest.param('position kp="500" forcerange="-120 0"', [], id="servo-that-pulls"),
        pytest.param('position kp="500" gear="-1" forcerange="-120 0"', [("forcerange", "0 120")], id="turned-round"),
        pytest.param('position kp="500" forcerange="-120 120"', [], id="both-ways"),
        pytest.param('position kp="500"', [], id="no-limit"),
        pytest.param('motor ctrlrange="0 50"', [("gear", "-1")], id="motor"),
        pytest.param('muscle force="300" lengthrange="0.5 1.5" forcerange="0 500"', [], id="muscle-that-cannot"),
    ],
)
def test_a_winch_that_may_only_push_its_rope_is_told(actuator: str, told: list[tuple[str, str]]) -> None:
    text = (
        rules()["rope-pushes"]
        .example("Bad")
        .replace('motor tendon="rope" ctrlrange="0 50"', f'{actuator} tendon="rope"')
    )
    assert [(each.attribute, each.value) for each in hints(text, "rope-pushes")] == told


def test_two_limits_before_the_gear_become_one_behind_it() -> None:
    text = rules()["limits-apart"].example("Bad")
    for now, then in (('kp="1000"', 'gear="10" kp="10"'), ('kv="90"', 'gear="10" kv="0.9"'), ("-340 340", "-34 34")):
        text = text.replace(now, then)
    (found,) = hints(text, "limits-apart")
    assert found.edit[-1].value == "-340 340"


def test_a_servo_behind_a_gear_gets_the_controls_that_reach_its_joints_range() -> None:
    text = rules()["control-range-forgotten"].example("Bad").replace('kp="100" kv="10"', 'kp="25" kv="2.5" gear="2"')
    assert [each.value for each in hints(text, "control-range-forgotten")] == ["-2.094 2.094"]


def test_a_servo_of_a_negative_gain_is_said_to_hold_the_other_side() -> None:
    arm = '<body><joint name="a" axis="0 0 1"/><geom size=".02" pos=".1 0 0"/></body>'
    servo = '<general joint="a" gainprm="-20" biastype="affine" biasprm="0 -20 -2"/>'
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator>{servo}</actuator></mujoco>"
    (found,) = findings(text, "target-not-held")
    assert found.says.endswith("holds the joint at minus its control.")


@pytest.mark.parametrize(("kv", "told"), [("0", ['actuator "winch"']), ("100", [])])
def test_a_servo_of_a_tendon_that_swings_on_is_told(kv: str, told: list[str]) -> None:
    load = '<body pos="0 0 1"><joint type="slide" axis="0 0 1"/><geom size="0.05" mass="2"/><site name="hook"/></body>'
    text = f"""<mujoco><worldbody><site name="top" pos="0 0 2"/>{load}</worldbody>
    <tendon><spatial name="rope"><site site="top"/><site site="hook"/></spatial></tendon>
    <actuator><position name="winch" tendon="rope" kp="2000" kv="{kv}"/></actuator></mujoco>"""
    assert [each.elements[0] for each in hints(text, "undamped-servo")] == told
