"""Robots that are sold: what of a model must be as its data sheet has it."""

from __future__ import annotations

import pytest
from clinic.diagnosis.finding import Finding
from clinic.diagnosis.probes.robots import known_robots
from clinic.diagnosis.rules import rules
from diagnosed import hints

GO2 = rules()["robot-unlike-data-sheet"].example("Good")


def told(text: str) -> list[Finding]:
    return list(hints(text, "robot-unlike-data-sheet"))


@pytest.mark.parametrize("robot", known_robots(), ids=lambda robot: robot.names[0])
def test_a_data_sheet_has_ranges_and_efforts_that_can_be(robot):
    assert all(line.low < line.high and line.effort >= 0 for line in robot.joints)
    assert all(name == name.lower() and "-" not in name for name in robot.names)


@pytest.mark.parametrize(
    ("now", "wrong", "elements", "value"),
    [
        (
            'FL_hip_joint" axis="1 0 0" range="-60 60',
            'FL_hip_joint" axis="1 0 0" range="-06 60',
            'joint "FL_hip_joint"',
            "-60 60",
        ),
        ('FL_calf_joint" ctrlrange="-45.43 45.43', 'FL_calf_joint" ctrlrange="-23.7 23.7', "actuator 2", "45.43"),
    ],
    ids=["range", "effort"],
)
def test_one_number_that_is_not_the_data_sheets_is_told_and_mended(now, wrong, elements, value):
    assert now in GO2
    (found,) = told(GO2.replace(now, wrong))
    assert (found.elements, found.value) == ((elements,), value)
    assert [each.attribute for each in found.edit] == [found.attribute]


@pytest.mark.parametrize(
    ("now", "other"),
    [
        ("-45.43 45.43", "-35.55 35.55"),
        ('axis="1 0 0" range="-60 60"', 'axis="-1 0 0" range="-60 60"'),
        ("23.7", "5"),
        ('model="go2"', 'model="dog"'),
    ],
    ids=["another release", "the other way", "all scaled", "no name"],
)
def test_what_no_single_number_contradicts_is_not_told(now, other):
    text = GO2.replace(now, other)
    assert text != GO2
    assert told(text) == []


def test_a_robot_of_another_weight_is_told() -> None:
    (found,) = told(GO2.replace('mass="7"', 'mass="70"'))
    assert found.says == "It weighs 76 kg, and go2 weighs 15.4 kg."


def panda(way: str, finger: str = "finger_joint") -> str:
    """The axes of a Panda, and a hand whose fingers slide along `way`."""
    links = ("0 0 .333", "0 0 1"), ("0 0 0", "0 1 0"), ("0 0 .316", "0 0 1"), (".0825 0 0", "0 -1 0")
    links += ("-.0825 0 .384", "0 0 1"), ("0 0 0", "0 -1 0"), (".088 0 0", "0 0 -1")
    opened = "".join(
        f'<body name="panda_link{i}" pos="{pos}"><joint name="panda_joint{i}" axis="{axis}"/><geom size=".02"/>'
        for i, (pos, axis) in enumerate(links, 1)
    )
    hand = "".join(
        f'<body name="f{i}"><joint name="{finger}{i}" type="slide" axis="{way}"/><geom size=".01"/></body>'
        for i in (1, 2)
    )
    key = '<keyframe><key name="home" qpos="0 0 0 0 0 0 -.785 0 0"/></keyframe>'
    body = f'{opened}<body name="hand" pos="0 0 -.107"><geom size=".02"/>{hand}</body>{"</body>" * len(links)}'
    return f'<mujoco model="panda"><worldbody><body name="panda_link0">{body}</body></worldbody>{key}</mujoco>'


@pytest.mark.parametrize(
    ("way", "finger", "told"),
    [
        ("1 -1 0", "finger_joint", False),
        ("0 1 0", "finger_joint", True),
        ("1 1 0", "panda_finger_joint", True),
        ("0 1 0", "wsg50_joint", False),
        ("0 0 1", "finger_joint", False),
    ],
)
def test_the_hand_of_a_panda_is_mounted_at_45_degrees(way: str, finger: str, told: bool) -> None:
    found = hints(panda(way, finger), "arm-unlike-data-sheet")
    assert [each.elements[0] for each in found if each.attribute == "quat"] == ['body "hand"'] * told


@pytest.mark.parametrize("name", ["a1", "b2", "spot"])
def test_an_everyday_name_makes_no_robot(name: str) -> None:
    leg = '<body name="{0}"><joint name="{0}_hip" range="-60 60"/><geom size="0.1" mass="10"/></body>'
    legs = "".join(leg.format(side) for side in ("left", "right", "middle", "hind"))
    body = f'<body name="{name}"><freejoint/><geom size="0.1"/>{legs}</body>'
    assert told(f"<mujoco><worldbody>{body}</worldbody></mujoco>") == []


def test_a_ball_joint_is_none_of_the_data_sheet() -> None:
    ball = GO2.replace(
        '<joint name="FL_hip_joint" axis="1 0 0" range="-60 60"/>', '<joint name="FL_hip_joint" type="ball"/>'
    )
    assert ball != GO2
    assert told(ball.replace('<motor joint="FL_hip_joint" ctrlrange="-23.7 23.7"/>', "")) == []


@pytest.mark.parametrize(("elbow", "values"), [(56, ["28"]), (28, [])])
def test_an_arm_whose_elbow_has_the_torque_of_its_shoulder_is_told(elbow: int, values: list[str]) -> None:
    torques = {"shoulder_pan": 56, "shoulder_lift": 56, "elbow": elbow, "wrist_1": 12, "wrist_2": 12, "wrist_3": 12}
    links = "".join(f'<body pos="0 0 0.1"><joint name="{name}" axis="0 1 0"/><geom size="0.04"/>' for name in torques)
    motors = "".join(f'<motor joint="{name}" ctrlrange="-{most} {most}"/>' for name, most in torques.items())
    arm = f"<worldbody>{links}{6 * '</body>'}</worldbody><actuator>{motors}</actuator>"
    assert [each.value for each in told(f'<mujoco model="ur3e">{arm}</mujoco>')] == values
