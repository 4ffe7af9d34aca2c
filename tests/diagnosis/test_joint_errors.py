"""Joints that keep a model from compiling: of a type or in a body that cannot be, or without what they need."""

from __future__ import annotations

import pytest
from diagnosed import causes, diagnosed

pytestmark = pytest.mark.usefixtures("folder")

GRIPPER = """<mujoco>
  <compiler angle="degree"/>
  <default>
    <default class="finger">
      <joint type="slide" axis="0 1 0" range="0 0.04"/>
      <geom type="box" size="0.01 0.01 0.03"/>
    </default>
    <default class="cable"><joint type="ball"/></default>
  </default>
  <worldbody>
    <body name="hand" pos="0 0 1">
      <geom size="0.03"/>
      <body name="lfinger" pos="0 0.03 0.05" childclass="finger"><joint name="lf"/><geom name="l"/></body>
      <body name="rfinger" pos="0 -0.03 0.05" childclass="finger">
        <joint name="rf" axis="0 -1 0"/>
        <geom name="r"/>
      </body>
    </body>
    <body name="rope" pos="1 0 1" childclass="cable"><joint name="j2"/><geom size="0.01"/></body>
  </worldbody>
  <equality><joint joint1="lf" joint2="rf"/></equality>
  <actuator><position joint="rf" kp="10"/><motor joint="j2"/></actuator>
</mujoco>
"""


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        pytest.param('pos="0 0.03 0.05" childclass="finger"', 'pos="0 0.03 0.05"', id="childclass-of-the-twin"),
        pytest.param('<joint name="rf"', '<joint name="lf"', id="name-that-is-missed"),
        pytest.param('<motor joint="j2"', '<motor joint="joint2"', id="abbreviation"),
    ],
)
def test_what_the_rest_of_the_text_tells_is_put_back(right, wrong):
    assert not diagnosed(GRIPPER).error
    assert GRIPPER.count(right) == 1
    found = diagnosed(GRIPPER.replace(right, wrong))
    (mended,) = found.fixed.values()
    assert sorted(mended.split()) == sorted(GRIPPER.split())


def test_a_free_joint_inside_is_what_its_class_says():
    inner = '<geom size="0.01"/><body><joint name="j3" type="free"/><geom size="0.01"/></body>'
    text = GRIPPER.replace('<geom size="0.01"/>', inner)
    (cause,) = causes(text)
    assert (cause.attribute, cause.value) == ("type", "ball")


def test_seven_numbers_more_that_begin_with_a_pose_are_those_of_a_lost_free_joint():
    leg = '<body pos="0 0 -0.1"><joint name="knee" axis="0 1 0"/><geom size="0.05"/></body>'
    text = '<mujoco><worldbody><body name="trunk" pos="0 0 1">{}<geom size="0.1"/>' + leg + "</body></worldbody>"
    text += '<keyframe><key name="home" qpos="0 0 0.4 1 0 0 0 0.3"/></keyframe></mujoco>'
    (cause,) = causes(text.format(""))
    assert (cause.attribute, cause.elements) == ("freejoint", ('<body name="trunk">',))
    assert not causes(text.format("<freejoint/>"))


LEG = '<body><joint axis="0 1 0"/><geom size="0.1"/></body>'


@pytest.mark.parametrize(
    ("around", "beside", "value"),
    [
        ("", "", 'moved into <body name="frame">'),
        (
            '<geom size="0.1"/>',
            '<body><joint axis="0 1 0"/><geom size="0.1"/></body>',
            'moved into <body name="frame">',
        ),
        ('<geom size="0.1"/>', "", "removed"),  # a table with a cube on it does not fly
        ('<joint axis="0 1 0"/><geom size="0.1"/>', "", "removed"),
    ],
)
def test_a_free_joint_is_put_into_the_body_that_carries_its_own(around, beside, value):
    inner = '<body name="inner"><freejoint/><geom size="0.1"/></body>'
    text = f'<mujoco><worldbody><body name="frame" pos="0 0 1">{around}{inner}{beside}</body></worldbody></mujoco>'
    (cause,) = causes(text)
    assert (cause.rule, cause.value) == ("misplaced-joint", value)


@pytest.mark.parametrize(
    ("tray", "qpos", "moved"),
    [
        pytest.param("", "0.1 0 0 0.1 1 0 0 0", '<body name="ball"><freejoint/>', id="at-the-origin"),
        pytest.param('pos="0 0 1"', "0.1 0 0 1.1 1 0 0 0", '<frame pos="0 0 1"><body name="ball">', id="above-it"),
        pytest.param("", "0.1", "", id="keyframes-without-it"),
    ],
)
def test_a_ball_inside_its_tray_is_put_into_the_world_where_keyframes_have_it(tray, qpos, moved):
    ball = '<body name="ball"><freejoint/><geom size="0.1"/></body>'
    body = f'<body name="tray" {tray}><joint axis="0 1 0"/><geom type="box" size="1 1 0.01"/>{ball}</body>'
    text = f'<mujoco><worldbody>{body}</worldbody><keyframe><key qpos="{qpos}"/></keyframe></mujoco>'
    (found,) = causes(text)
    inserted = [edit.value for edit in found.edit if edit.action == "insert"]
    assert (found.rule, len(inserted)) == ("misplaced-joint", bool(moved))
    assert not moved or inserted[0].startswith(moved)
