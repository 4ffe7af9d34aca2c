"""Cameras: what is cut away before them."""

from __future__ import annotations

import pytest
from diagnosed import findings, hints
from scenery import ARM, FLOOR

HALL = """<mujoco>{0}<worldbody><light pos="0 0 3"/>
  <geom type="plane" size="0 0 1"/><geom type="box" size=".1 100 2" pos="100 0 2"/>
  <camera name="side" pos="0 -{1} 1" xyaxes="1 0 0 0 .3 1"/>
  <body name="car" pos="0 0 .1"><freejoint/><geom type="box" size=".4 .2 .05"/></body>
</worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("visual", "away", "told"),
    [
        pytest.param("", 1, True, id="cut away"),
        pytest.param("", 6, False, id="beyond the plane"),
        pytest.param('<visual><map znear="0.001"/></visual>', 1, False, id="a nearer plane"),
        pytest.param("", -1, False, id="behind the camera"),
    ],
)
def test_a_camera_of_the_world_whose_near_plane_cuts_the_robot_away_is_told(visual: str, away: int, told: bool) -> None:
    model = HALL.format(visual, away).replace("--", "")
    found = hints(model, "near-plane-far")
    assert [each.elements for each in found] == [('camera "side"',)] * told
    assert all(each.after is not None and each.after < 0.5 < each.before for each in found)


@pytest.mark.parametrize(
    ("left", "right", "told"),
    [
        ("1 0 0 0 0 1", "-1 0 0 0 0 1", None),
        ("1 0 0 0 0 1", "1 0 0 0 0 1", ('camera "eye_r"', "-1 0 0 0 0 1")),
        ("-1 0 0 0 0 1", "-1 0 0 0 0 1", ('camera "eye_l"', "1 0 0 0 0 1")),
        ("0 -1 0 0 0 1", "0 -1 0 0 0 1", None),
    ],
    ids=["to both sides", "both to the left", "both to the right", "both ahead"],
)
def test_an_eye_that_is_turned_as_the_other_one_and_looks_at_it_is_told(left, right, told):
    eyes = (
        f'<camera name="eye_l" pos=".1 .03 0" xyaxes="{left}"/><camera name="eye_r" pos=".1 -.03 0" xyaxes="{right}"/>'
    )
    text = f"<mujoco><worldbody><body><freejoint/><geom size='.02'/>{eyes}</body></worldbody></mujoco>"
    assert [(each.elements[0], each.value) for each in hints(text, "camera-blocked")] == ([told] if told else [])


@pytest.mark.parametrize(
    ("place", "told"),
    [("0 -750 550", "0 -0.75 0.55"), ("0 -75 55", "0 -0.75 0.55"), ("0 -0.75 0.55", None), ("0 -15 11", None)],
    ids=["mm", "cm", "m", "far"],
)
def test_a_camera_from_which_the_model_is_a_dot_is_brought_near(place: str, told: str | None) -> None:
    camera = f'<camera name="web" pos="{place}" xyaxes="1 0 0 0 .4 .92"/>'
    text = f"<mujoco><worldbody>{camera}<body><joint/><geom size='.15'/></body></worldbody></mujoco>"
    assert [each.value for each in hints(text, "camera-sees-nothing")] == ([told] if told else [])


@pytest.mark.parametrize(
    ("axes", "fingers", "told"),
    [
        ("0 1 0 .2 0 .98", 2, "0 -1 0 0.2 0 0.9798"),
        ("0 -1 0 .2 0 .98", 2, None),
        ("0 1 0 .2 0 .98", 1, None),
        ("1 0 0 0 0 1", 2, None),
    ],
    ids=["backwards", "ahead", "a probe", "sideways"],
)
def test_a_camera_on_a_hand_that_looks_away_from_its_fingers_is_told(axes, fingers, told):
    slide = '<joint type="slide" axis="0 1 0"/>'
    finger = f'<body name="finger{{0}}" pos=".05 {{1}} 0">{slide}<geom size=".01" pos=".03 0 0"/></body>'
    both = "".join(finger.format(*each) for each in (("_l", 0.02), ("_r", -0.02))[:fingers])
    camera = f'<camera name="wrist" pos="0 0 .06" xyaxes="{axes}"/>'
    hand = f'<body name="hand" pos="0 0 1"><joint/><geom size=".02"/>{camera}{both}'
    text = f"<mujoco><worldbody>{hand}</body></worldbody></mujoco>"
    assert [each.value for each in hints(text, "camera-blocked")] == ([told] if told else [])


@pytest.mark.parametrize(("body", "told"), [("head", True), ("hand", False)])
@pytest.mark.parametrize("axes", ["0 0 1 0 1 0", "0 -1 0 0 0 -1"], ids=["on its side", "upside down"])
def test_the_image_of_a_head_is_level_and_that_of_a_hand_as_it_likes(body, told, axes):
    camera = f'<body name="{body}" pos="0 0 1">{ARM}<camera name="eye" xyaxes="{axes}"/></body>'
    text = f"<mujoco><worldbody>{FLOOR}{camera}</worldbody></mujoco>"
    assert [each.elements for each in hints(text, "camera-upside-down")] == [('camera "eye"',)] * told


@pytest.mark.parametrize(("chest", "told"), [("0.1 0 0.1", True), ("-0.3 0 -0.1", False)])
def test_a_head_that_sees_its_own_chest_alone_is_told(chest, told):
    eye = '<camera name="eye" xyaxes="0 -1 0 0.6 0 0.8" fovy="20"/><geom type="sphere" size="0.03"/>'
    head = f'<body name="head" pos="0 0 0.25">{ARM}{eye}</body>'
    trunk = f'<geom type="box" size="0.3 0.2 0.05" pos="{chest}"/>'
    text = f'<mujoco><worldbody>{FLOOR}<body name="torso" pos="0 0 1">{trunk}{head}</body></worldbody></mujoco>'
    assert [each.elements for each in hints(text, "camera-blocked")] == [('camera "eye"',)] * told


@pytest.mark.parametrize(
    ("place", "camera", "told"),
    [
        pytest.param("0 0 0.1", 'pos="0.2 0 -0.13"', ["0.2 0 0.13"], id="sign"),
        pytest.param("0 0 0.1", 'pos="0.2 0 -0.05"', [], id="above"),
        pytest.param("0 0 0.1", 'pos="0.2 0 -0.13" euler="180 0 0"', [], id="looks-up"),
        pytest.param("0 0 -0.01", "", [], id="lies-in-the-floor"),
    ],
)
def test_a_camera_below_the_floor_is_told(place, camera, told):
    car = f'<freejoint/><geom type="box" size="0.1 0.05 0.09"/><camera {{}}{camera}/>'
    body = car.format("" if "euler" in camera or not camera else 'xyaxes="0 -1 0 0 0 1" ')
    text = f'<mujoco><worldbody>{FLOOR}<body pos="{place}">{body}</body></worldbody></mujoco>'
    assert [each.value for each in hints(text, "camera-blocked") if each.attribute == "pos"] == told


ROVER = """<mujoco><worldbody><geom type="plane" size="3 3 .1"/><body name="rover" pos="0 0 .1">{joint}
  <geom type="box" size=".2 .1 .03"/><camera name="{name}" pos="{at}" xyaxes="{axes}"/></body></worldbody></mujoco>"""
REAR, AHEAD, ASIDE = "0 1 0 0 0 1", "0 -1 0 0 0 1", "1 0 0 0 0 1"


@pytest.mark.parametrize(
    ("joint", "at", "axes", "told"),
    [
        pytest.param("<freejoint/>", ".12 0 .05", REAR, True, id="back"),
        pytest.param("<freejoint/>", ".12 0 .05", AHEAD, False, id="ahead"),
        pytest.param("<freejoint/>", ".12 0 .1", REAR, False, id="on a mast"),
        pytest.param("<freejoint/>", "-.12 0 .05", REAR, False, id="at the rear"),
        pytest.param("<freejoint/>", ".12 0 .05", ASIDE, False, id="aside"),
        pytest.param("<freejoint/>", ".05 0 .05", REAR, False, id="in the middle"),
        pytest.param("<freejoint/>", ".8 0 .3", REAR, False, id="from outside"),
        pytest.param("<freejoint/>", ".12 0 .05", "0 1 0 -1 0 .3", False, id="down"),
        pytest.param('<joint axis="0 0 1"/>', ".12 0 .05", REAR, False, id="of an arm"),
    ],
)
def test_a_camera_near_the_front_that_looks_back_over_its_robot_is_told(joint, at, axes, told):
    found = hints(ROVER.format(joint=joint, at=at, axes=axes, name="dash"), "camera-blocked")
    assert any("looks back" in each.says for each in found) == told


@pytest.mark.parametrize(
    ("name", "wide", "told"), [("eye", ".1", True), ("driver", ".1", False), ("eye", ".04", False)]
)
def test_a_camera_that_looks_across_a_narrow_robot_or_is_its_drivers_is_left_alone(name, wide, told):
    text = ROVER.format(joint="<freejoint/>", at="0 .03 .05", axes=ASIDE.replace("1 0 0", "-1 0 0"), name=name)
    text = text.replace('size=".2 .1 .03"', f'size=".11 {wide} .03"').replace(
        "0 .03 .05", f"0 {0.8 * float(wide)} .035"
    )
    assert any("looks back" in each.says for each in hints(text, "camera-blocked")) == told


WRIST = """<mujoco><worldbody><body name="flange" pos="0 0 .5"><joint axis="0 0 1"/><geom size=".02"/>
  <camera name="{name}" pos=".05 0 0" xyaxes="{axes}"/>
  <body pos="0 0 .1"><geom size=".02"/>
  <body pos="0 .03 .02">{joint}<geom size=".01" pos="0 0 .03"/></body>
  <body pos="0 -.03 .02">{joint}<geom size=".01" pos="0 0 .03"/></body></body></body></worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("name", "axes", "joint", "told"),
    [
        ("wrist_cam", "0 -1 0 1 0 0", '<joint axis="1 0 0"/>', True),
        ("wrist_cam", "0 -1 0 -1 0 0", '<joint axis="1 0 0"/>', False),
        ("wrist_cam", "0 -1 0 0 0 1", '<joint axis="1 0 0"/>', False),
        ("wrist_cam", "0 -1 0 1 0 0", "", False),
        ("watcher", "0 -1 0 1 0 0", '<joint axis="1 0 0"/>', False),
    ],
    ids=["back", "ahead", "aside", "nothing beyond", "another name"],
)
def test_a_camera_of_a_wrist_that_looks_away_from_its_gripper_is_told(name, axes, joint, told):
    found = hints(WRIST.format(name=name, axes=axes, joint=joint), "camera-blocked")
    assert ["beyond" in each.says for each in found] == [True] * told


@pytest.mark.parametrize(
    ("lens", "told"),
    [('projection="orthographic" fovy="4"', 0), ('fovy="4"', 1)],
    ids=["4 m high", "4 degrees high"],
)
def test_the_view_of_an_orthographic_camera_is_a_length(lens: str, told: int) -> None:
    camera, box = f'<camera pos="0 0 5" {lens}/>', '<geom type="box" size=".1 .1 .1" pos="1 0 .1"/>'
    text = f"<mujoco><worldbody>{camera}{FLOOR}{box}</worldbody></mujoco>"
    assert len(findings(text, "camera-sees-nothing")) == told
