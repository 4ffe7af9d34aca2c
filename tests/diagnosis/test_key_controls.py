"""The controls and velocities of keyframes: what they hold, and whose they are."""

from __future__ import annotations

import pytest
from diagnosed import causes, findings, hints, with_edits


@pytest.mark.parametrize(("kind", "says"), [("velocity", "as speeds."), ("motor", "as torques.")])
def test_angles_are_no_control_of_a_motor_or_a_velocity_servo(kind: str, says: str) -> None:
    arm = "".join(f'<body><joint name="j{i}" axis="0 1 0"/><geom size="0.02" pos="0.1 0 0"/></body>' for i in range(3))
    actuators = "".join(f'<{kind} joint="j{i}"/>' for i in range(3))
    key = '<keyframe><key qpos="0.3 0.5 -0.7" ctrl="0.3 0.5 -0.7"/></keyframe>'
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator>{actuators}</actuator>{key}</mujoco>"
    (found,) = hints(text, "key-angles-for-motors")
    assert found.says.endswith(says)


@pytest.mark.parametrize(
    ("ctrl", "mended"),
    [("0.1 90", "0.00174533 1.5708"), ("0.1 1.5", "0.1 1.5"), ("0 0", "0 0")],
    ids=["degrees", "radians", "elsewhere"],
)
def test_controls_that_hold_a_keyframe_in_degrees_are_mended_with_it(ctrl: str, mended: str):
    joint = '<joint name="{0}" axis="0 1 0" range="-115 115"/><geom size="0.1" pos="0 0 0.3"/>'
    arm = f'<body name="a">{joint.format("one")}<body name="b" pos="0 0 0.6">{joint.format("two")}</body></body>'
    servos = "".join(f'<position joint="{name}" kp="90"/>' for name in ("one", "two"))
    key = f'<keyframe><key name="home" qpos="0.1 90" ctrl="{ctrl}"/></keyframe>'
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator>{servos}</actuator>{key}</mujoco>"
    (each,) = findings(text, "key-outside-range")
    assert f'ctrl="{mended}"' in with_edits(text, each)


@pytest.mark.parametrize(
    ("acts", "ctrl", "told"),
    [
        pytest.param("0.1 0.1 1 0.1 0.2", "0.1 0.1 0.1 0.1 0.2", "0.1", id="one-of-five"),
        pytest.param("0.1 0.1 0.1 0.1 0.2", "0.1 0.1 0.1 0.1 0.2", None, id="all-alike"),
        pytest.param("0.1 1 1 0.1 0.2", "0.1 0.1 0.1 0.1 0.2", None, id="two"),
    ],
)
def test_the_one_state_of_a_keyframe_that_is_not_its_control_is_told(acts: str, ctrl: str, told: str | None):
    links = "".join(f'<body><joint name="j{i}" axis="0 1 0"/><geom size="0.1"/></body>' for i in range(5))
    muscles = "".join(f'<muscle joint="j{i}" lengthrange="0.1 1"/>' for i in range(5))
    key = f'<key qpos="0 0 0 0 0" act="{acts}" ctrl="{ctrl}"/>'
    body = f"<worldbody>{links}</worldbody><actuator>{muscles}</actuator><keyframe>{key}</keyframe>"
    found = hints(f"<mujoco>{body}</mujoco>", "key-targets-elsewhere")
    assert [(each.attribute, each.value) for each in found] == [("act", told)] * (told is not None)


@pytest.mark.parametrize(
    ("gear", "rest", "ctrl", "floor", "told"),
    [
        pytest.param("2", "-0.25", "0.34", "", [], id="in balance"),
        pytest.param("-2", "-0.25", "0.34", "", [("gear", "2")], id="gear"),
        pytest.param("2", "-0.25", "-0.34", "", [("ctrl", "0.34")], id="control"),
        pytest.param("2", "0.25", "0.34", "", [("springref", "-0.25")], id="spring"),
        pytest.param("-2", "-0.25", "0.1", "", [], id="no sign would do"),
        pytest.param("-2", "-0.25", "0.34", '<geom size="0.05" pos="0.05 0 1"/>', [], id="touches something"),
    ],
)
def test_a_motor_that_pushes_a_keyframe_off_is_told_by_the_sign_that_would_hold_it(
    gear: str, rest: str, ctrl: str, floor: str, told: list[tuple[str, str]]
) -> None:
    hinge = f'<joint name="lever" axis="0 0 1" stiffness="0.8" springref="{rest}" range="-1 1" damping="0.01"/>'
    text = f"""<mujoco><compiler angle="radian"/><worldbody>{floor}
      <body pos="0 0 1">{hinge}<geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01"/></body></worldbody>
      <actuator><motor joint="lever" gear="{gear}"/></actuator>
      <keyframe><key qpos="0.6" ctrl="{ctrl}"/></keyframe></mujoco>"""
    assert [(each.attribute, each.value) for each in hints(text, "key-out-of-balance")] == told


def test_a_keyframe_with_one_servo_that_opens_a_gripper_is_meant():
    joints = "".join(
        f'<body pos="{i} 0 1"><joint name="j{i}" axis="0 1 0" damping="1" armature="0.1"/><geom size="0.05"/></body>'
        for i in range(3)
    )
    servos = "".join(f'<position joint="j{i}" kp="20" kv="2"/>' for i in range(3))
    model = "<mujoco><worldbody>{}</worldbody><actuator>{}</actuator><keyframe>{}</keyframe></mujoco>"
    assert not causes(model.format(joints, servos, '<key qpos="1 1 0" ctrl="1 1 0.5"/>'))
    (found,) = causes(model.format(joints, servos, '<key qpos="1 0 0.5" ctrl="0 0.5 1"/>'))
    assert found.rule == "key-targets-elsewhere"


@pytest.mark.parametrize(
    ("qvel", "told"),
    [
        pytest.param("0 70 0 2 0 0", True, id="exchanged"),
        pytest.param("2 0 0 0 70 0", False, id="rolls"),
        pytest.param("0 0 0 0 70 0", False, id="spins"),
        pytest.param("2 0 0 0 0 0", False, id="slides"),
        pytest.param("0 30 0 2 0 0", False, id="with side"),
    ],
)
def test_a_ball_that_would_roll_with_its_velocities_exchanged_is_told(qvel: str, told: bool) -> None:
    text = (
        '<mujoco><worldbody><geom type="plane" size="1 1 .1"/><body pos="0 0 .0286"><freejoint/><geom size=".0286"/>'
        f'</body></worldbody><keyframe><key name="break" qvel="{qvel}"/></keyframe></mujoco>'
    )
    found = hints(text, "key-in-another-order")
    assert [each.value for each in found] == ["2 0 0 0 70 0"] * told


@pytest.mark.parametrize(
    ("qpos", "ctrl", "told"),
    [
        pytest.param("0.3 0.5 0.2 1", "0.3 1.2 0.4 1", ["hint"], id="of-another-key"),
        pytest.param("0.3 0.5 0.2 1", "0.3 1.3 0.4 1", [], id="its-own"),
        pytest.param("0.3 0.5 0.4 1", "0.3 1.2 0.4 1", [], id="one-that-moves"),
    ],
)
def test_controls_of_another_keyframe_are_told_though_most_servos_stay(qpos: str, ctrl: str, told: list[str]) -> None:
    links = "".join(
        f'<body pos="{i} 0 1" gravcomp="1"><joint name="j{i}" axis="0 1 0" damping="2"/><geom size="0.1"/></body>'
        for i in range(5)
    )
    servos = "".join(f'<position joint="j{i}" kp="100" kv="10"/>' for i in range(5))
    home = "0.3 1.2 0.4 1 0"
    keys = f'<key name="home" qpos="{home}" ctrl="{home}"/><key name="bent" qpos="{qpos} 0" ctrl="{ctrl} 0"/>'
    text = f"<mujoco><worldbody>{links}</worldbody><actuator>{servos}</actuator><keyframe>{keys}</keyframe></mujoco>"
    found = findings(text, "key-targets-elsewhere")
    assert [each.level for each in found] == told
    assert [each.value for each in found] == [f"{qpos} 0"] * len(told)


@pytest.mark.parametrize(
    ("winch", "ctrl", "told"),
    [
        pytest.param("position", "", ["1.41421 1.41421"], id="left-out"),
        pytest.param("position", 'ctrl="1.4142 1.4142"', [], id="held"),
        pytest.param("position", 'ctrl="0.4 0.4"', ["1.41421 1.41421"], id="elsewhere"),
        pytest.param("motor", "", [], id="motors"),
    ],
)
def test_winches_that_a_keyframe_does_not_hold_are_told(winch: str, ctrl: str, told: list[str]) -> None:
    sites = "".join(f'<site name="top{i}" pos="{x} 0 2"/>' for i, x in enumerate((-1, 1)))
    ropes = "".join(f'<spatial name="rope{i}"><site site="top{i}"/><site site="eye"/></spatial>' for i in range(2))
    kp = 'kp="900"' if winch == "position" else ""
    winches = "".join(f'<{winch} tendon="rope{i}" {kp}/>' for i in range(2))
    text = f"""<mujoco><worldbody>{sites}<body pos="0 0 1"><freejoint/><geom size="0.1" mass="3"/><site name="eye"/>
      </body></worldbody><tendon>{ropes}</tendon><actuator>{winches}</actuator>
      <keyframe><key name="work" qpos="0 0 1 1 0 0 0" {ctrl}/></keyframe></mujoco>"""
    assert [each.value for each in findings(text, "key-targets-elsewhere")] == told


def test_a_servo_keeps_its_target_where_motors_are_told_angles() -> None:
    arm = "".join(f'<body><joint name="j{i}" axis="0 1 0"/><geom size="0.02" pos="0.1 0 0"/></body>' for i in range(3))
    actuators = '<motor joint="j0"/><motor joint="j1"/><position joint="j2" kp="20" kv="1"/>'
    key = '<keyframe><key qpos="0.3 0.5 -0.7" ctrl="0.3 0.5 -0.7"/></keyframe>'
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator>{actuators}</actuator>{key}</mujoco>"
    (found,) = hints(text, "key-angles-for-motors")
    assert found.says.endswith("as torques.")
    assert 'ctrl="0 0 -0.7"' in with_edits(text, found)


def test_the_control_that_holds_a_servo_takes_its_constant_force_off() -> None:
    arm = "".join(f'<body><joint name="j{i}" axis="0 0 1"/><geom size="0.02" pos="0.1 0 0"/></body>' for i in range(2))
    servo = '<general joint="j{}" gainprm="20" biastype="affine" biasprm="10 -20 -2"/>'
    key = '<keyframe><key qpos="0.8 1.2" ctrl="-0.8 0"/></keyframe>'
    actuators = servo.format(0) + servo.format(1)
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator>{actuators}</actuator>{key}</mujoco>"
    (found,) = causes(text, "key-targets-elsewhere")
    assert 'ctrl="0.3 0.7"' in with_edits(text, found)
