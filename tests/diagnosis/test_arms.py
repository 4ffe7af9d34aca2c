"""Arms that are sold, by the lengths, axes and places of their data sheets; the tools that they carry."""

from __future__ import annotations

import pytest
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules
from diagnosed import findings, hints, with_edits

UR5E = rules()["arm-unlike-data-sheet"].example("Good")


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("0.425 -0.131 0", "0.435 -0.131 0"), "mm; of ur5e it is 425 mm"),
        (("0 0 -0.0997", "0 0 -0.0946"), "is 94.6 mm; of ur5e it is 99.7 mm"),
        (('name="wrist_2" axis="0 0 -1"', 'name="wrist_2" axis="0 0 1"'), "turns about z as the arm stands at 0"),
        (('mass="8.058"', 'mass="7.358"'), "It is what those of ur5 weigh."),
    ],
)
def test_a_length_or_an_axis_of_an_arm_that_is_sold_is_told(change, says):
    assert change[0] in UR5E
    (told,) = findings(UR5E.replace(*change), "arm-unlike-data-sheet")
    assert says in told.says


@pytest.mark.parametrize(
    "change",
    [
        ("0 0 -0.0997", "0 0 -0.099"),  # rounded
        ('model="ur5e"', 'model="my arm"'),
        ('model="ur5e"', 'model="ur5ex"'),
        ('axis="0 1 0"', 'axis="0 -1 0"'),  # the frames of all are turned
        ("0.425 -0.131 0", "0.435 -0.133 0.02"),  # with what follows, another arm
    ],
)
def test_an_arm_within_its_data_sheet_and_one_of_another_name_are_let_be(change):
    text = UR5E.replace(*change)
    if "0.02" in change[1]:
        text = text.replace("0 0 -0.0997", "0 0 -0.2").replace("0.3922 0 0", "0.5 0 0.1")
    assert findings(text, "arm-unlike-data-sheet") == []


def test_the_arm_may_stand_on_another_place_and_be_turned():
    turned = UR5E.replace(
        '<body name="shoulder" pos="0 0 0.1625">', '<body name="shoulder" pos="1 2 0.5" euler="0 90 30">'
    )
    assert findings(turned.replace("0 0 -0.0997", "0 0 -0.0946"), "arm-unlike-data-sheet") != []


@pytest.mark.parametrize(
    ("hand", "told"),
    [
        ('<body name="hand"><geom size="0.02"/></body>', True),
        ('<body name="hand" euler="0 0 0"><geom size="0.02"/></body>', True),
        ('<body name="hand"><geom size="0.02" pos="0 0.1 0"/></body>', False),
        (
            '<body name="hand" pos="0 0.1 0"><geom size="0.02"/></body><body name="imu"><geom size="0.01"/></body>',
            False,
        ),
        ('<body name="skin"><geom size="0.02" contype="0" conaffinity="0"/></body>', False),
    ],
    ids=["at the origin", "with a turn", "drawn at the site", "at the site", "only seen"],
)
def test_a_tool_that_is_not_at_the_site_for_it_is_told(hand: str, told: bool) -> None:
    site = '<site name="attachment_site" pos="0 0.1 0" quat="-1 1 0 0"/>'
    wrist = f'<body name="wrist"><joint axis="0 1 0"/><geom size="0.04"/>{site}{hand}</body>'
    text = f"<mujoco><worldbody>{wrist}</worldbody></mujoco>"
    found = hints(text, "mount-off-its-site")
    assert [each.elements[0] for each in found] == ['body "hand"'] * told
    for each in found:
        assert NativeEngine().compile(with_edits(text, each), {}).count("body") == 3


@pytest.mark.parametrize(
    ("axes", "odd"),
    [
        ("z z x z z z", 2),
        ("z z z z x z z", 4),
        ("z z -z z z z", None),
        ("z x z z z z z", None),
        ("z z x z z", None),
        ("z z x z z x z z", None),
        ("z y x z y x", None),
    ],
    ids=["six", "seven", "the other way", "near the end", "too few", "two of them", "in turn"],
)
def test_the_one_axis_of_a_row_that_is_unlike_the_others_is_told(axes, odd):
    ways = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1", "-z": "0 0 -1"}
    bodies = "".join(
        f'<body pos="0.1 0 0"><joint name="{each}" axis="{ways[way]}"/><geom size="0.02"/>'
        for each, way in enumerate(axes.split())
    )
    ends = "</body>" * len(axes.split())
    text = f"<mujoco><worldbody>{bodies}{ends}</worldbody></mujoco>"
    found = hints(text, "axis-unlike-row")
    assert [(each.elements[0], each.value) for each in found] == ([(f'joint "{odd}"', "0 0 1")] if odd else [])


@pytest.mark.parametrize(("mass", "value"), [("80.58", "8.058 kg"), ("60", None)])
def test_the_link_with_a_misplaced_point_is_told_of_an_arm_that_is_too_heavy(mass, value):
    (found,) = hints(UR5E.replace('mass="8.058"', f'mass="{mass}"'), "arm-unlike-data-sheet")
    assert (len(found.elements) == 1) == bool(value)
    assert value in (None, found.value)
