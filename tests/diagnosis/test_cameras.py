"""Cameras: what is cut away before them."""

from __future__ import annotations

import pytest
from diagnosed import hints

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
