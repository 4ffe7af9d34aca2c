"""Keyframes that break what couples joints."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import causes, hints

SCREW = rules()["key-breaks-equality"].example("Good")
LED = 'polycoef="0 0.00254648 0 0 0"'
TURNED = ('qpos="-31.4159 -0.08"', 'qpos="31.4159 -0.08" ctrl="-31.4159"')
SERVO = ("<equality>", '<actuator><position joint="nut" kp="2"/></actuator><equality>')
DOOR = ("<worldbody>", '<worldbody><body name="door" pos="1 0 0"><joint name="door"/><geom size="0.1"/></body>')
TO_DOOR = ('joint2="nut"', 'joint2="door"')


@pytest.mark.parametrize(
    ("changes", "edits"),
    [
        pytest.param([(LED, 'polycoef="0 2.54648 0 0 0"')], [("polycoef", LED[10:-1])], id="in-mm"),
        pytest.param(
            [('joint1="quill" joint2="nut"', 'joint1="nut" joint2="quill"')],
            [("joint1", "quill"), ("joint2", "nut")],
            id="exchanged",
        ),
        pytest.param([TURNED, SERVO], [("qpos", "-31.4159 -0.08")], id="sign-of-the-keyframe"),
        pytest.param([DOOR, TO_DOOR, ('qpos="', 'qpos="0 ')], [("joint2", "nut")], id="another-leader"),
        pytest.param([('qpos="-31.4159 -0.08"', 'qpos="-31.4159 -0.05"')], [("qpos", "-31.4159 -0.08")], id="pose"),
        pytest.param([('qpos="-31.4159 -0.08"', 'qpos="-31.4159 -0.078"')], [], id="by-a-little"),
        pytest.param([("<joint joint1", '<joint active="false" joint1'), ("-0.08", "-0.05")], [], id="switched-off"),
    ],
)
def test_a_keyframe_tells_what_is_wrong_with_a_coupling_that_it_breaks(
    changes: list[tuple[str, str]], edits: list[tuple[str, str]]
) -> None:
    text = SCREW
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    assert [(each.attribute, each.value) for one in hints(text, "key-breaks-equality") for each in one.edit] == edits


@pytest.mark.parametrize(
    ("ctrl", "edit"),
    [
        pytest.param("50 50", ("polycoef", "0 500 0 0 0"), id="the servo agrees with the keyframe"),
        pytest.param("50 0", ("qpos", "0.1 50 -50"), id="the servo says nothing"),
    ],
)
def test_one_of_two_screws_of_a_bed_gets_the_sign_of_the_other(ctrl: str, edit: tuple[str, str]) -> None:
    screws = "".join(
        f'<body pos="{x} 0 0"><joint name="{name}" axis="0 0 1" armature="0.001"/><geom size="0.01"/></body>'
        for name, x in (("left", -1), ("right", 1))
    )
    text = f"""<mujoco><worldbody><body><joint name="bed" type="slide" axis="0 0 1"/><geom size="0.1"/></body>{screws}
      </worldbody><equality><joint joint1="left" joint2="bed" polycoef="0 500 0 0 0"/>
      <joint joint1="right" joint2="bed" polycoef="0 -500 0 0 0"/></equality>
      <actuator><position joint="left" kp="2"/><position joint="right" kp="2"/></actuator>
      <keyframe><key name="up" qpos="0.1 50 50" ctrl="{ctrl}"/></keyframe></mujoco>"""
    (found,) = hints(text, "key-breaks-equality")
    assert (found.attribute, found.value) == edit


def test_a_keyframe_that_tears_a_loop_open_is_told_and_one_that_turns_both_links_is_not() -> None:
    link = '<body name="{0}" pos="{1} 0 1"><joint axis="0 1 0"/><geom size="0.05" pos="0 0 0.3"/></body>'
    links = link.format("crank", 0) + link.format("rocker", 0.3)
    loop = '<equality><connect body1="crank" body2="rocker" anchor="0 0 0.2"/></equality>'
    keys = '<keyframe><key name="open" qpos="0.5 0"/><key name="turned" qpos="-0.01 -0.01"/></keyframe>'
    text = f"<mujoco><worldbody>{links}</worldbody>{loop}{keys}</mujoco>"
    (found,) = hints(text, "key-breaks-equality")
    assert found.elements[0] == 'key "open"'
    assert not any("turned" in each for each in found.elements)


def test_a_coupling_that_a_keyframe_tells_is_no_matter_of_the_followers_range() -> None:
    text = SCREW.replace(*DOOR).replace(*TO_DOOR).replace('qpos="', 'qpos="0 ')
    text = text.replace('<joint name="door"', '<joint name="door" range="0 20000"')
    assert not causes(text, "follower-out-of-range")
    text = text.replace("-31.4159 -0.08", "0 0")
    assert causes(text, "follower-out-of-range")
