"""Ranges of joints and of targets: their units, and what begins outside of them."""

from __future__ import annotations

import pytest
from diagnosed import causes, diagnosed, hints


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
    assert [each.value for each in hints(text, "control-range-too-narrow")] == values


@pytest.mark.parametrize(
    ("narrow", "other", "key", "told"),
    [
        pytest.param("-7.5 11.5", "-75 115", 'qpos="80 80" ctrl="80 80"', ["-75 115"], id="as the other's"),
        pytest.param("-7.5 11.5", "-75 50", 'qpos="80 0" ctrl="80 0"', ["-7.5 80"], id="as far as the keyframe"),
        pytest.param("-75 115", "-75 115", 'qpos="80 80" ctrl="80 80"', [], id="wide enough"),
        pytest.param("-7.5 11.5", "-75 115", 'qpos="0 80" ctrl="80 80"', [], id="the keyframe is elsewhere"),
        pytest.param("-75 79", "-75 115", 'qpos="80 80" ctrl="80 80"', [], id="by a little"),
    ],
)
def test_a_control_range_that_a_keyframe_is_outside_of_is_told(narrow: str, other: str, key: str, told: list[str]):
    screws = "".join(f'<body pos="{x} 0 0"><joint name="z{x}" axis="0 0 1"/><geom size="0.1"/></body>' for x in (0, 1))
    servos = "".join(
        f'<position joint="z{x}" kp="2" kv="0.01" ctrlrange="{ends}"/>' for x, ends in enumerate((narrow, other))
    )
    text = f"""<mujoco><compiler angle="radian"/><worldbody>{screws}</worldbody><actuator>{servos}</actuator>
      <keyframe><key {key}/></keyframe></mujoco>"""
    assert [each.value for each in hints(text, "control-range-too-narrow")] == told


FOREARM = """<mujoco><worldbody><site name="front" pos=".025 0 1.39"/><site name="back" pos="-.025 0 1.34"/>
  <geom name="wrap" type="cylinder" size=".022 .02" pos="0 0 1.1" euler="90 0 0" contype="0" conaffinity="0"/>
  <site name="behind" pos="-.06 0 1.1"/>
  <body pos="0 0 1.1"><joint name="elbow" axis="0 -1 0" {range}/><geom size=".02" pos="0 0 -.25"/>
    <site name="in_front" pos=".018 0 -.05"/><site name="at_the_back" pos="-.022 0 .015"/></body></worldbody>
<tendon><spatial name="flexor"><site site="front"/><site site="in_front"/></spatial>
  <spatial name="extensor"><site site="back"/><geom geom="wrap" sidesite="behind"/><site site="at_the_back"/></spatial>
</tendon><actuator>{drive}</actuator></mujoco>"""
MUSCLES = '<muscle tendon="flexor" lengthrange=".2 .4"/><muscle tendon="extensor" lengthrange=".2 .3"/>'


@pytest.mark.parametrize(
    ("turn", "drive", "told"),
    [
        pytest.param('range="-140 0"', MUSCLES, ["0 140"], id="backwards"),
        pytest.param('range="0 140"', MUSCLES, [], id="right"),
        pytest.param('range="-140 140"', MUSCLES, [], id="both ways"),
        pytest.param("", MUSCLES, [], id="without limits"),
        pytest.param('range="-140 0"', MUSCLES.partition("/>")[0] + "/>", [], id="one muscle"),
        pytest.param('range="-140 0"', '<motor tendon="flexor"/><motor tendon="extensor"/>', [], id="motors"),
    ],
)
def test_an_elbow_that_bends_the_other_way_than_its_muscles_are_for_is_told(turn, drive, told):
    found = hints(FOREARM.format(range=turn, drive=drive), "tendon-turns-back")
    assert [each.value for each in found] == told


def test_a_range_of_a_class_that_a_joint_takes_back_is_a_hint():
    def arm(own: str) -> str:
        joint = f'<joint name="table" axis="0 0 1" {own} limited="false"/>'
        return f"""<mujoco><default><joint range="-60 60"/></default><worldbody><body pos="0 0 1">{joint}
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/></body></worldbody></mujoco>"""

    (hint,) = hints(arm(""), "range-not-applied")
    assert "-60 to 60 degrees" in hint.says
    assert [each.level for each in causes(arm('range="-30 30"'), "range-not-applied")] == ["cause"]


def test_a_urdf_in_degrees_is_told_to_change_its_limits():
    inertial = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    text = f"""<robot name="arm"><link name="base"/><link name="upper">{inertial}</link>
      <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
        <limit lower="-90" upper="90" effort="20" velocity="3"/></joint></robot>"""
    (found,) = hints(text, "range-in-the-wrong-unit")
    assert (found.attribute, found.value) == ("range", "-1.571 1.571")
    assert {(each.element, each.attribute) for each in found.edit} == {("limit", "lower"), ("limit", "upper")}
