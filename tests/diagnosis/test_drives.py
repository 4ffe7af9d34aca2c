"""What drives a joint, and what it cannot move: idle joints, springs, friction, motors of uneven strength."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import causes, findings, hints


@pytest.mark.parametrize(("kind", "told"), [("muscle", False), ("motor", True)])
def test_two_muscles_pull_one_joint_and_two_motors_do_not(kind, told):
    links = ""
    for name in ("wrist", "elbow", "shoulder"):
        joint = f'<joint name="{name}" axis="0 1 0" damping="1" range="-60 60"/>'
        links = f'<body pos="0.2 0 0">{joint}<geom type="capsule" size="0.02" fromto="0 0 0 0.2 0 0"/>{links}</body>'
    lengths = ' lengthrange="-1 1"' if kind == "muscle" else ""
    both = (f'<{kind} joint="{joint}" gear="{gear}"{lengths}/>' for joint in ("shoulder", "elbow") for gear in (5, -5))
    text = f"<mujoco><worldbody>{links}</worldbody><actuator>{''.join(both)}</actuator></mujoco>"
    assert ("driven-twice" in [each.rule for each in hints(text)]) is told


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
    return [(each.rule, each.elements) for each in findings(ROLLERS.format(bodies=bodies, motors=lines))]


def test_rollers_that_stand_by_themselves_are_compared():
    assert rollers() == []
    assert rollers(m3='joint="r3" kv="0.001" ctrlrange="-5 5"')[0] == ("strength-unlike-others", ('actuator "m3"',))
    ((rule, elements), *_) = rollers(m3='joint="r2" kv="1" ctrlrange="-5 5"')
    assert (rule, elements) == ("driven-twice", ('actuator "m3"', 'actuator "m2"', 'joint "r2"'))


def test_an_actuator_that_is_called_like_the_beginning_of_an_idle_joint_was_meant_for_it():
    pole = '<body><joint name="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 0.5" size="0.02"/></body>'
    cart = f'<body pos="0 0 1"><joint name="slider" type="slide" axis="1 0 0"/><geom size="0.1"/>{pole}</body>'
    text = f'<mujoco><worldbody>{cart}</worldbody><actuator><motor name="slide" joint="{{}}"/></actuator></mujoco>'
    found = {joint: [each.rule for each in causes(text.format(joint))] for joint in ("hinge", "slider")}
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
    found = findings(f"<mujoco><worldbody>{boom}</worldbody>{driven}{sensed}</mujoco>")
    assert [each.rule for each in found if "another-joint" in each.rule] == told


@pytest.mark.parametrize(("mass", "told"), [(0.5, True), (0.02, False)])
def test_a_gripper_may_be_weaker_than_the_arm_that_carries_it(mass: float, told: bool):
    text = rules()["strength-unlike-others"].example("Good").replace('gear="20"', 'gear="0.9"')
    text = text.replace('fromto="0 0 0 0.05 0 0"', f'fromto="0 0 0 0.05 0 0" mass="{mass}"')
    assert [each.elements for each in hints(text, "strength-unlike-others")] == [('actuator "toe"',)] * told


@pytest.mark.parametrize(
    ("forces", "told"),
    [
        ((600, 500), []),
        ((6, 500), [("600", "hint")]),
        ((600, 9), [("900", "hint")]),
        ((40, 500), []),
        ((900, 800, 70000), [("700", "hint")]),
        ((900, 800, -1), []),
    ],
)
def test_a_muscle_that_is_a_hundred_times_weaker_or_stronger_is_told(forces, told):
    parts = "".join(f'<muscle joint="elbow" gear="0.03" force="{force}" lengthrange="0 0.1"/>' for force in forces)
    arm = '<body><joint name="elbow" axis="0 1 0"/><geom size="0.1" pos="0 0 -0.3"/></body>'
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator>{parts}</actuator></mujoco>"
    assert [(each.value, each.level) for each in hints(text, "strength-unlike-others")] == told


@pytest.mark.parametrize(
    ("attribute", "given"),
    [("lengthrange", "0.6 0.9"), ("force", "0"), ("ctrlrange", "0 0.01"), ("range", "75 105"), ("forcerange", "0 500")],
)
def test_a_muscle_without_force_is_told_by_what_takes_it(attribute: str, given: str) -> None:
    good = {"force": "300", "lengthrange": "0.18 0.26", "range": "0.75 1.05"}
    now, then = (" ".join(f'{name}="{x}"' for name, x in each.items()) for each in (good, {**good, attribute: given}))
    text = rules()["muscle-gives-no-force"].example("Good")
    assert now in text
    assert [each.attribute for each in hints(text.replace(now, then), "muscle-gives-no-force")] == [attribute]


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
    found = hints(f"{text}</worldbody><actuator>{servos}</actuator></mujoco>", "strength-unlike-others")
    assert [name for each in found for name in each.elements] == told


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
    (told,) = hints(text, "motor-for-position")
    assert [each.value for each in told.edit] == mended


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
    assert [each.elements for each in hints(text, "joint-not-driven")] == [('joint "waist"',)] * told


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
    assert [each.elements for each in hints(text, "joint-not-driven")] == [('joint "right_arm"',)] * told


@pytest.mark.parametrize(
    ("gear", "twist", "told"),
    [
        pytest.param("0 0 -1", "handle", ["0 -1 0 0 0 0"], id="turns the handle"),
        pytest.param("0 -1 0", "handle", [], id="opens the door"),
        pytest.param("0 0 -1", "door", [], id="the door has its own"),
        pytest.param("-1 0 0", "handle", [], id="moves nothing"),
    ],
)
def test_a_motor_at_a_site_that_turns_what_is_driven_anyhow_is_told(gear: str, twist: str, told: list[str]) -> None:
    handle = (
        '<body pos="0.8 0 0"><joint name="handle" axis="0 -1 0" range="-5 40"/><site name="grip" pos="-0.1 0 0"/>'
        '<geom type="capsule" fromto="0 0 0 -0.12 0 0" size="0.01"/></body>'
    )
    text = f"""<mujoco><worldbody><body pos="0 0 1"><joint name="door" axis="0 0 1" range="-90 0"/>
      <geom type="box" size="0.45 0.02 0.9" pos="0.45 0 0" mass="20" contype="0"/>{handle}</body></worldbody>
      <actuator><motor joint="{twist}" ctrlrange="-1 1"/><motor site="grip" gear="{gear} 0 0 0" ctrlrange="-40 40"/>
      </actuator></mujoco>"""
    assert [each.value for each in hints(text, "driven-twice")] == told


@pytest.mark.parametrize(
    ("winch", "joint", "told"),
    [
        pytest.param('gear="1" ctrlrange="0 100"', "", [], id="lifts"),
        pytest.param('gear="-1" ctrlrange="0 100"', "", ["1"], id="pushes down"),
        pytest.param('gear="-1" ctrlrange="-100 100"', "", [], id="both ways"),
        pytest.param('gear="-1" ctrlrange="0 100"', 'stiffness="500"', [], id="a spring lifts"),
        pytest.param('gear="-1" ctrlrange="0 100"', 'range="0 1"', [], id="presses on its stop"),
        pytest.param('gear="-1" ctrlrange="0 10"', "", [], id="weaker than the weight"),
    ],
)
def test_a_motor_of_one_side_that_pushes_with_the_weight_is_told(winch: str, joint: str, told: list[str]) -> None:
    load = f'<body pos="0 0 1"><joint name="lift" type="slide" axis="0 0 1" damping="5" {joint}/><geom size="0.1"'
    text = f"""<mujoco><worldbody>{load} mass="5"/></body></worldbody>
      <actuator><motor joint="lift" {winch}/></actuator></mujoco>"""
    assert [each.value for each in hints(text, "servo-one-sided")] == told


def test_a_motor_of_one_side_is_right_where_gravity_points_up():
    lift = (
        '<body pos="0 0 1"><joint name="lift" type="slide" axis="0 0 1" damping="5"/><geom size="0.1" mass="5"/></body>'
    )
    text = (
        f'<mujoco><option gravity="0 0 9.81"/><worldbody>{lift}</worldbody>'
        '<actuator><motor joint="lift" ctrlrange="0 100"/></actuator></mujoco>'
    )
    assert not hints(text, "servo-one-sided")


@pytest.mark.parametrize(
    ("coefficients", "actuator", "more", "told"),
    [
        pytest.param((1, 1), '<motor tendon="{}"/>', "", True, id="motors"),
        pytest.param((2, 2), '<position tendon="{}" kp="9" ctrlrange="0 1"/>', "", True, id="servos"),
        pytest.param((1, -1), '<motor tendon="{}"/>', "", False, id="a difference"),
        pytest.param((1, 1), '<motor tendon="{}" ctrlrange="-1 0"/>', "", False, id="two that only pull"),
        pytest.param((1, 1), '<motor tendon="{}"/>', '<motor joint="y"/>', False, id="a third motor"),
    ],
)
def test_two_motors_that_move_two_joints_in_one_proportion_are_told(coefficients, actuator, more, told):
    joints = "".join(
        f'<joint name="{axis}" type="slide" axis="{way}"/>' for axis, way in (("x", "1 0 0"), ("y", "0 1 0"))
    )
    fixed = '<fixed name="{}"><joint joint="x" coef="{}"/><joint joint="y" coef="{}"/></fixed>'
    tendons = fixed.format("a", 1, 1) + fixed.format("b", *coefficients)
    driven = actuator.format("a") + actuator.format("b") + more
    text = f"<mujoco><worldbody><body>{joints}<geom size='0.1'/></body></worldbody>"
    text += f"<tendon>{tendons}</tendon><actuator>{driven}</actuator></mujoco>"
    found = hints(text, "tendons-in-proportion")
    assert [(each.elements[0], each.value) for each in found] == [('tendon "b"', f"{-coefficients[1]}")] * told


@pytest.mark.parametrize(
    ("motor", "joint", "told"),
    [
        pytest.param('ctrlrange="0 1"', 'range="-1 1"', ["-1 1"], id="one side"),
        pytest.param('ctrlrange="-1 1"', 'range="-1 1"', [], id="both sides"),
        pytest.param('ctrlrange="0 1"', 'range="0 1"', [], id="begins at its stop"),
        pytest.param('ctrlrange="0 1"', 'range="-1 1" stiffness="5"', [], id="a spring"),
        pytest.param('ctrlrange="0 1"', 'range="-1 1" axis="1 0 1"', [], id="a weight"),
        pytest.param('ctrlrange="0 1"', 'limited="false"', [], id="no range"),
    ],
)
def test_a_motor_of_one_side_that_nothing_brings_back_is_told(motor: str, joint: str, told: list[str]) -> None:
    axis = "" if "axis" in joint else 'axis="1 0 0"'
    cart = f'<body><joint name="rail" type="slide" damping="1" {axis} {joint}/><geom size="0.1" mass="1"/></body>'
    text = f"<mujoco><worldbody>{cart}</worldbody><actuator><motor joint='rail' gear='20' {motor}/></actuator></mujoco>"
    assert [each.value for each in hints(text, "servo-one-sided")] == told


@pytest.mark.parametrize(
    ("drives", "told"),
    [
        pytest.param("q1 q3 q2", ['actuator "v2"'], id="two-exchanged"),
        pytest.param("q1 q2 q3", [], id="in-order"),
        pytest.param("q2 q3 q1", [], id="all-otherwise"),
        pytest.param("q1 q3 q4", [], id="other-numbers"),
    ],
)
def test_two_numbered_actuators_on_joints_of_each_others_number_are_told(drives: str, told: list[str]) -> None:
    joints = "".join(f'<body pos="{i} 0 1"><joint name="q{i}" axis="0 1 0"/><geom size=".1"/></body>' for i in range(5))
    motors = "".join(f'<motor name="v{i}" joint="{joint}"/>' for i, joint in enumerate(drives.split(), 1))
    text = f"<mujoco><worldbody>{joints}</worldbody><actuator>{motors}</actuator></mujoco>"
    assert [each.elements[0] for each in findings(text, "actuator-on-another-joint")] == told
