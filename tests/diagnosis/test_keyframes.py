"""Keyframes: which of the numbers that disagree is the wrong one, and how it is mended."""

from __future__ import annotations

import pytest
from clinic.diagnosis.finding import Finding
from diagnosed import causes, diagnosed, findings, hints, with_edits

ARM = """
<mujoco>
  <compiler angle="degree"/>
  <worldbody>
    <body pos="0 0 1" gravcomp="1">
      <joint name="shoulder" axis="0 1 0" range="-90 90" damping="2"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1"/>
      <body pos="0.3 0 0" gravcomp="1">
        <joint name="elbow" axis="0 1 0" range="{range}" damping="2"/>
        <geom type="capsule" fromto="0.05 0 0 0.3 0 0" size="0.03" mass="1"/>
        <body pos="0.35 0 0" gravcomp="1">
          <joint name="wrist" axis="0 1 0" range="-90 90" damping="2"/>
          <geom type="capsule" fromto="0.05 0 0 0.1 0 0" size="0.03" mass="0.5"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <position joint="shoulder" kp="100" ctrlrange="-1.57 1.57"/>
    <position joint="elbow" kp="100" ctrlrange="-0.1 2.5"/>
    <position joint="wrist" kp="100" ctrlrange="-1.57 1.57"/>
  </actuator>
  <keyframe>
    <key name="home" qpos="{qpos}" ctrl="{ctrl}"/>
  </keyframe>
</mujoco>
"""


def told(qpos: str, ctrl: str, elbow: str = "-5.73 143.2") -> list[Finding]:
    return causes(ARM.format(range=elbow, qpos=qpos, ctrl=ctrl))


def test_a_keyframe_within_all_ranges_is_well():
    assert told("0.3 1.2 0.4", "0.3 1.2 0.4") == []


@pytest.mark.parametrize(
    ("qpos", "meant"),
    [
        pytest.param("20 70 0", "0.349066 1.22173 0", id="degrees"),
        pytest.param("0.3 -1.2 0.4", "0.3 1.2 0.4", id="sign"),
        pytest.param("2 -0.5 0.4", "-0.5 2 0.4", id="two-in-each-others-place"),
        pytest.param("1.75 1.2 0.4", "1.5708 1.2 0.4", id="a-little-too-far"),
    ],
)
def test_a_pose_outside_of_its_ranges_is_mended_by_what_was_meant(qpos, meant):
    (found,) = told(qpos, meant)
    assert (found.rule, found.attribute, found.value) == ("key-outside-range", "qpos", meant)


@pytest.mark.parametrize(("second", "causes"), [("0.3 0.5 0.2", 1), ("0.3 2.6 0.2", 0), ("0.3 -0.5 0.2", 2)])
def test_where_no_keyframe_keeps_to_a_range_it_is_the_range_that_is_told(second: str, causes: int) -> None:
    text = ARM.format(range="0 57", qpos="0.3 2.6 0.2", ctrl="0.3 0.5 0.2")
    text = text.replace("<key ", f'<key qpos="{second}"/><key ', 1)
    found = diagnosed(text, "key-outside-range")
    assert [each.attribute for each in found.causes] == ["qpos"] * causes
    assert [each.attribute for each in found.hints] == ["range"] * (not causes)


def test_two_targets_in_each_others_place_are_exchanged():
    (found,) = told("0.3 1.2 0.4", "0.3 0.4 1.2")
    assert (found.rule, found.value) == ("key-targets-elsewhere", "0.3 1.2 0.4")


def test_where_keyframe_and_control_agree_the_range_is_the_wrong_one():
    found = told("0.3 1.2 0.4", "0.3 1.2 0.4", elbow="-143.2 5.73")
    assert [(each.rule, each.attribute, each.value) for each in found] == [
        ("key-outside-range", "range", "-5.73 143.2")
    ]
    assert found[0].elements[0] == 'joint "elbow"'


@pytest.mark.parametrize(("other", "told"), [("0", ("range", "hint")), ("1.2", ("qpos", "cause"))])
def test_a_door_that_one_keyframe_opens_the_other_way_has_a_wrong_sign_somewhere(other, told):
    door = '<body><joint name="hinge" axis="0 0 1" range="-1 90"/><geom type="box" size="0.4 0.02 1"/></body>'
    keys = f'<key name="shut" qpos="{other}"/><key name="ajar" qpos="-0.6"/>'
    text = f"<mujoco><worldbody>{door}</worldbody><keyframe>{keys}</keyframe></mujoco>"
    (one,) = findings(text, "key-outside-range")
    assert (one.attribute, one.level) == told
    assert bool(one.edit) == (one.level == "cause")


@pytest.mark.parametrize(
    ("low", "at", "told"),
    [
        pytest.param(-1, -0.05, False, id="at its end"),
        pytest.param(-1, -0.02, False, id="by 3 cm"),
        pytest.param(-1, 0.0, True, id="by 5 cm"),
        pytest.param(-0.08, -0.04, False, id="by a third of its width"),
        pytest.param(-0.08, -0.03, True, id="by two thirds of its width"),
    ],
)
def test_a_slide_is_outside_of_its_range_by_four_centimetres_or_half_its_width(low: float, at: float, told: bool):
    cart = f'<body><joint name="x" type="slide" axis="1 0 0" range="{low} -0.05"/><geom size="0.1"/></body>'
    text = f'<mujoco><worldbody>{cart}</worldbody><keyframe><key qpos="{at}"/></keyframe></mujoco>'
    assert bool(findings(text, "key-outside-range")) is told


@pytest.mark.parametrize(
    ("qpos", "other", "meant"),
    [
        pytest.param("0.2 180 30", "0 0.3 0", "0.2 3.14159 0.523599", id="degrees"),
        pytest.param("0.2 3.14 0.5", "0 0.3 0", "", id="radians"),
        pytest.param("0.2 180 0", "0 -50.3 0", "", id="of-a-hinge-that-turns-for-ever"),
        pytest.param("0.2 181.3 0", "0 0.3 0", "", id="no-whole-number"),
    ],
)
def test_a_keyframe_in_degrees_is_told_of_hinges_without_a_range(qpos: str, other: str, meant: str):
    pole = '<body name="pole"><joint name="hinge" axis="0 1 0"/><geom size="0.1" pos="0 0 0.5"/>{}</body>'
    tip = '<body name="tip"><joint axis="0 1 0"/><geom size="0.1" pos="0 0 0.9"/></body>'
    cart = f'<body><joint type="slide" axis="1 0 0"/><geom size="0.1"/>{pole.format(tip)}</body>'
    keys = f'<key name="down" qpos="{qpos}"/><key name="other" qpos="{other}"/>'
    text = f"<mujoco><worldbody>{cart}</worldbody><keyframe>{keys}</keyframe></mujoco>"
    assert [each.value for each in hints(text, "key-outside-range")] == [meant] * bool(meant)


THIGH = '<joint name="{0}" axis="0 1 0"/><geom size="0.05" pos="0 0 -0.3"/>'
LEG = '<body name="{0}_thigh" pos="0 {1} -0.1">' + THIGH + "{2}</body>"
SHIN = '<body name="{0}_shin" pos="0 0 -0.3"><geom size="0.05" pos="0 0 -0.1"/></body>'
BALL = '<body name="ball" pos="1 0 {0}"><geom size="0.1" mass="1"/></body>'
TWICE = '<joint name="a" type="slide"/><joint name="b" type="slide"/>'
CRATE = f'<body name="crate" pos="0 2 1">{TWICE}<geom size="0.1"/></body>'
TABLE = '<body name="table" pos="0 -2 1"><freejoint/><geom size="0.1"/></body>'


@pytest.mark.parametrize(
    ("rule", "parts", "qpos", "kept"),
    [
        ("object-without-joint", BALL.format(1), "1 2 3 4", "1 0 1 1 0 0 0 1 2 3 4"),
        ("root-is-fixed", "", "1 2 3 4", "1 2 0 0 0.5 1 0 0 0 3 4"),
        ("joints-on-one-line", "", "1 2 3 4", "1 3 4"),
        ("scenery-moves", TABLE, "1 2 3 4 0 0 1 1 0 0 0", "1 2 3 4"),
    ],
)
def test_keyframes_stay_as_long_as_the_model_that_an_edit_gives_a_joint_or_takes_one(rule, parts, qpos, kept):
    legs = "".join(LEG.format(name, y, SHIN.format(name)) for name, y in (("left", 0.2), ("right", -0.2)))
    robot = f'<body name="robot" pos="0 0 0.5"><geom size="0.1"/>{legs}</body>'
    floor = '<geom type="plane" size="5 5 1"/>'
    order = (parts, CRATE, robot) if parts != TABLE else (CRATE, robot, parts)
    text = f"<mujoco><worldbody>{floor}{''.join(order)}</worldbody><keyframe>"
    text += f'<key qpos="{qpos}"/><key/></keyframe></mujoco>'
    (told,) = findings(text, rule)
    mended = with_edits(text, told)
    assert f'<key qpos="{kept}"/><key/>' in mended
    assert not diagnosed(mended, rule).error


def test_room_for_keyframes_of_which_none_is_written_is_no_finding() -> None:
    text = '<mujoco><size nkey="5"/><worldbody><body><joint range="1 2"/><geom size="1"/></body></worldbody></mujoco>'
    assert not hints(text, "keys-not-written")


@pytest.mark.parametrize(
    ("qpos", "more", "level"),
    [
        pytest.param("0 0 0.05 0 0 0 1", "", "hint", id="a-box-half-a-turn-round"),
        pytest.param("0 0 0.05 0 0 0 1", '<geom size="0.01" pos="0.05 0 0"/>', "cause", id="a-box-with-a-knob"),
        pytest.param("0 0 0.05 0 0 0.707 0.707", "", "cause", id="a-box-turned-over"),
    ],
)
def test_half_a_turn_that_nobody_sees_is_a_hint(qpos: str, more: str, level: str):
    box = f'<body pos="0 0 0.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/>{more}</body>'
    text = f'<mujoco><worldbody>{box}</worldbody><keyframe><key qpos="{qpos}"/></keyframe></mujoco>'
    assert [each.level for each in findings(text, "key-quaternion")] == [level]


@pytest.mark.parametrize(("heights", "level"), [((0.05, 0.01), "hint"), ((0.01, 0.05), "cause")])
def test_a_key_in_the_floor_behind_one_that_stands_is_a_hint(heights: tuple[float, float], level: str):
    keys = "".join(f'<key qpos="0 0 {height} 1 0 0 0"/>' for height in heights)
    box = '<body pos="0 0 0.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/></body>'
    world = f'<worldbody><geom type="plane" size="5 5 0.1"/>{box}</worldbody>'
    found = findings(f"<mujoco>{world}<keyframe>{keys}</keyframe></mujoco>")
    assert [each.level for each in found if each.rule == "key-in-the-floor"] == [level]


@pytest.mark.parametrize(
    ("size", "height", "told"),
    [
        pytest.param("0.008 0.032 0.06", 0.238, [("size", "0.06 0.032 0.008")], id="on edge"),
        pytest.param("0.06 0.032 0.008", 0.238, [], id="flat"),
        pytest.param("0.008 0.032 0.06", 0.25, [("qpos", "height 0.29")], id="as high as none of its sizes"),
    ],
)
def test_feet_that_stand_on_edge_in_the_floor_are_told(size: str, height: float, told: list[tuple[str, str]]):
    feet = "".join(
        f'<body pos="0 {y} -0.2"><joint axis="0 1 0"/><geom type="box" size="{size}" pos="0 0 -0.03"/></body>'
        for y in (0.1, -0.1)
    )
    pelvis = f'<body pos="0 0 1"><freejoint/><geom type="box" size="0.05 0.1 0.05"/>{feet}</body>'
    key = f'<keyframe><key qpos="0 0 {height} 1 0 0 0 0 0"/></keyframe>'
    text = f'<mujoco><worldbody><geom type="plane" size="2 2 1"/>{pelvis}</worldbody>{key}</mujoco>'
    found = diagnosed(text, "key-in-the-floor").causes
    assert [(each.attribute, each.value) for each in found] == told
