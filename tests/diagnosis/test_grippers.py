"""Fingers and what is coupled, beyond the laws: near misses, and healthy models that look ill."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import causes, diagnosed, findings, hints, with_edits

HAND = """
<mujoco>
  <worldbody>
    <body name="{hand}" pos="0 0 1">
      <geom type="box" size="0.05 0.05 0.01"/>
      <body name="{kind}_1" pos="0.03 0 0">
        <joint name="a" type="slide" axis="1 0 0" range="{range}"/>
        <geom type="box" size="0.01 0.01 0.04" pos="0 0 0.05"/>
      </body>
      <body name="{kind}_2" {place}>
        <joint name="b" type="slide" axis="{axis}" range="{other}"/>
        <geom type="box" size="0.01 0.01 0.04" pos="0 0 0.05"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <position joint="a" kp="100" kv="10"/>
    <position joint="b" kp="100" kv="10" {gear}/>
  </actuator>
  {more}
</mujoco>
"""
USUAL = {
    "hand": "palm",
    "kind": "finger",
    "range": "0 0.04",
    "other": "0 0.04",
    "place": 'pos="-0.03 0 0"',
    "axis": "1 0 0",
    "gear": "",
    "more": "",
}
TENDON = '<tendon><fixed><joint joint="a" coef="0.5"/><joint joint="b" coef="-0.5"/></fixed></tendon>'
COUPLED = ('joint1="a" joint2="b"', 'joint1="b" joint2="a"')
LINKS = """
<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <joint name="knuckle" axis="0 1 0" range="0 80"/>
      <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
    </body>
    <body pos="0 0.1 1">
      <joint name="tip" axis="0 1 0" range="0 80"/>
      <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
    </body>
  </worldbody>
  <equality>
    <joint joint1="tip" {coupling}/>
  </equality>
</mujoco>
"""


OTHER = '<joint joint1="tip" joint2="knuckle" polycoef="0 0.7 0 0 0"/>'


def told(text: str, rule: str) -> list[tuple[str, str, str]]:
    found = diagnosed(text)
    assert not found.error
    return [(each.level, each.attribute, each.value) for each in (*found.causes, *found.hints) if each.rule == rule]


@pytest.mark.parametrize(
    ("change", "ill"),
    [
        ({}, True),
        ({"hand": "world_hand", "kind": "part"}, True),
        ({"axis": "-1 0 0"}, False),
        ({"place": 'pos="-0.03 0 0" quat="0 0 0 1"'}, False),
        ({"other": "-0.04 0"}, False),
        ({"range": "-0.02 0.02", "other": "-0.02 0.02"}, False),
        ({"gear": 'gear="-1"'}, False),
        ({"more": TENDON}, False),
        ({"hand": "rail", "kind": "carriage"}, False),
        ({"place": 'pos="0.03 0.05 0"'}, False),
    ],
)
def test_fingers_that_nothing_couples_go_to_one_side(change, ill):
    found = told(HAND.format(**(USUAL | change)), "fingers-move-together")
    assert found == ([("hint", "axis", "-1 0 0")] if ill else [])


@pytest.mark.parametrize("more", ["", *(f"<equality><joint {ends}/></equality>" for ends in COUPLED)])
@pytest.mark.parametrize(
    ("change", "wrong"),
    [
        ({}, "b"),
        ({"axis": "-1 0 0", "place": 'pos="-0.03 0 0" quat="0 0 0 1"'}, "b"),
        ({"range": "-0.04 0", "other": "-0.04 0"}, "a"),
        ({"range": "0 0.02", "other": "0 0.02"}, ""),  # opens or closes
    ],
)
def test_the_finger_that_crosses_the_middle_is_the_one_to_turn(more, change, wrong):
    found = diagnosed(HAND.format(**(USUAL | change | {"more": more})))
    (told,) = (each for each in found.hints if each.rule == "fingers-move-together")
    assert told.elements[0] == f'joint "{wrong or ("a" if COUPLED[0] in more else "b")}"'


@pytest.mark.parametrize(
    ("coupling", "level", "value"),
    [
        ('joint2="knuckle" polycoef="1 0 0 0 0"', "cause", "0 1 0 0 0"),
        ('joint2="knuckle" polycoef="0.5 0 0 0 0"', "hint", "0 0.5 0 0 0"),
        ('joint2="knuckle" polycoef="0.02 0 0 0 0"', "hint", "0 1 0 0 0"),
        (
            f'joint2="knuckle" polycoef="0.5 0 0 0 0"/>{2 * OTHER}<joint joint1="tip" active="false"',
            "hint",
            "0 0.7 0 0 0",
        ),
        ('joint2="knuckle" polycoef="0 1 0 0 0"', "", ""),
        ('joint2="knuckle" polycoef="0 0 0.5 0 0"', "", ""),
        ('joint2="knuckle" polycoef="0 0 0 0 0"', "", ""),
        ('polycoef="1 0 0 0 0"', "", ""),
    ],
)
def test_a_coupling_of_a_constant_alone_leads_nowhere(coupling, level, value):
    found = told(LINKS.format(coupling=coupling), "follower-out-of-range")
    assert found == ([(level, "polycoef", value)] if level else [])


@pytest.mark.parametrize(
    ("leader", "other", "told"),
    [
        pytest.param("0 40", "0 0.04", ("a", "0 0.04"), id="mm"),
        pytest.param("0 0.2", "0 0.04", ("b", "0 0.2"), id="five times"),
        pytest.param("0 0.04", "0 0.00004", ("b", "0 0.04"), id="as wide as the hand"),
        pytest.param("0 0.04", "0 0.04", None, id="alike"),
    ],
)
def test_the_range_of_a_leader_in_mm_is_told_and_not_that_of_its_follower(leader, other, told):
    fingers = "".join(
        f'<body pos="0 {y} 0"><joint name="{name}" type="slide" axis="0 {y} 0" range="{ends}"/><geom size="1"/></body>'
        for name, y, ends in (("a", 0.1, leader), ("b", -0.1, other))
    )
    text = f"""<mujoco><compiler autolimits="true"/><worldbody>{fingers}</worldbody>
      <equality><joint joint1="b" joint2="a"/></equality></mujoco>"""
    found = causes(text, "follower-out-of-range")
    assert [(each.elements[0], each.value) for each in found] == ([(f'joint "{told[0]}"', told[1])] if told else [])


@pytest.mark.parametrize(
    ("adhesion", "chip", "told"),
    [
        pytest.param('body="cup" gain="5"', "<freejoint/>", [], id="lifts"),
        pytest.param('body="flange" gain="5"', "<freejoint/>", [("body", "cup", 0.0)], id="not-the-cup"),
        pytest.param('body="cup" gain="0.1"', "<freejoint/>", [("gain", "2", 0.1962)], id="weak"),
        pytest.param('body="cup" gain="0.1"', "", [], id="nothing-to-lift"),
        pytest.param('body="chip" gain="0.1"', "<freejoint/>", [], id="sticks-by-itself"),
    ],
)
def test_an_adhesion_that_holds_nothing_is_told(adhesion: str, chip: str, told: list[tuple[str, str, float]]) -> None:
    text = f"""<mujoco><worldbody><geom type="plane" size="1 1 0.1"/>
      <body name="flange" pos="0 0 0.2"><joint type="slide" axis="0 0 1" range="-0.15 0" damping="5"/>
        <geom type="cylinder" size="0.03 0.005" contype="0" conaffinity="0"/>
        <body name="cup" pos="0 0 -0.02"><geom type="cylinder" size="0.01 0.015" mass="0.05"/></body></body>
      <body name="chip" pos="0 0 0.0101">{chip}<geom type="box" size="0.02 0.02 0.01" mass="0.04"/></body></worldbody>
    <actuator><adhesion {adhesion} ctrlrange="0 1"/></actuator></mujoco>"""
    found = hints(text, "adhesion-holds-nothing")
    assert [(each.attribute, each.value, each.after) for each in found] == [
        (attribute, value, pytest.approx(after)) for attribute, value, after in told
    ]


JAW = '<body pos="0 .026 0"><joint name="jaw" type="slide" axis="0 -1 0"/><geom size="{0}" type="box"/></body>'
PALM = f'<body name="palm" pos="0 0 1"><joint name="turn"/><geom pos="0 -.03 0" size="{{0}}" type="box"/>{JAW}</body>'
GRASP = ("grasp-creeps", "grip-too-weak", "grasp-slips")
THING = '<body name="thing"><freejoint/><geom size=".02 .015 .02" type="box" mass="0.1"/></body>'
GRIPPER = (
    '<mujoco><default><geom friction="{1}"/></default>{3}<worldbody><geom type="plane" size="1 1 1" pos="0 0 -0.02"/>'
    f"{PALM.format('.02 .01 .02')}{THING}</worldbody><actuator>"
    '<position name="grip" joint="jaw" kp="{0}" kv="20" ctrlrange="0 0.04" forcerange="-{2} {2}"/>'
    '<position joint="turn" kp="1" kv="0.01"/></actuator></mujoco>'
)


@pytest.mark.parametrize(
    ("model", "told"),
    [
        (GRIPPER.format(2000, 1, 30, ""), [("grasp-creeps", "impratio", "10")]),
        (GRIPPER.format(2000, 1, 30, '<option cone="elliptic" impratio="10"/>'), []),
        (GRIPPER.format(2000, 1, 30, '<option noslip_iterations="10"/>'), []),
        (GRIPPER.format(30, 1, 30, '<option cone="elliptic" impratio="100"/>'), [("grip-too-weak", "kp", "150")]),
        (GRIPPER.format(400, 0.02, 30, '<option cone="elliptic" impratio="100"/>'), [("grasp-slips", "friction", "1")]),
        (GRIPPER.format(2000, 1, 30, "").replace("<freejoint/>", ""), []),
    ],
    ids=["creeps", "hard friction", "no slip", "weak", "slippery", "nothing to hold"],
)
def test_what_a_jaw_and_its_palm_would_lift_is_tried_between_them(model, told):
    found = findings(model, *GRASP)
    assert [(each.rule, each.attribute, each.value) for each in found] == told
    assert not findings(with_edits(model, *found), *GRASP)


@pytest.mark.parametrize(("mass", "told"), [(0.9, "grasp-slips"), (1.5, "grip-too-weak")])
def test_friction_is_the_repair_where_it_holds_more_than_the_weight(mass: float, told: str):
    text = rules()["grasp-slips"].example("Bad").replace('mass="0.4"', f'mass="{mass}"')
    found = diagnosed(text, "grasp-slips", "grip-too-weak")
    assert [each.rule for each in (*found.causes, *found.hints)] == [told], found.text()


@pytest.mark.parametrize("symptom", ["", "slips"])
def test_a_fast_creep_has_one_repair_whatever_the_symptom(symptom: str):
    found = diagnosed(GRIPPER.format(2000, 1, 30, ""), "grasp-creeps", symptom=symptom)
    assert [each.attribute for each in found.hints] == ["impratio"], found.text()


@pytest.mark.parametrize(("symptom", "told"), [("", []), ("slips", ["grasp-creeps"]), ("sags", [])])
def test_a_slow_creep_is_told_to_whom_something_slips(symptom: str, told: list[str]):
    text = rules()["grasp-creeps"].example("Bad")
    text = text.replace("<worldbody>", '<option cone="elliptic" impratio="10"/><worldbody>', 1)
    found = diagnosed(text, "grasp-creeps", symptom=symptom)
    assert [each.rule for each in found.hints] == told
    assert not found.causes


def test_of_two_hands_each_is_mended_for_itself():
    hand = PALM.format('.02 .01 .02" priority="1')
    other = hand.replace('pos="0 0 1"', 'pos="1 0 1"')
    for name in ("palm", "jaw", "turn"):
        other = other.replace(f'"{name}"', f'"other_{name}"')
    model = GRIPPER.format(400, 0.02, 30, '<option cone="elliptic" impratio="100"/>')
    model = model.replace(PALM.format(".02 .01 .02"), hand + other)
    grip = '<position joint="other_jaw" kp="400" kv="20" ctrlrange="0 0.04" forcerange="-30 30"/>'
    (told,) = causes(model.replace("<actuator>", f"<actuator>{grip}"), "grasp-slips")
    assert len(told.edit) == 4


@pytest.mark.parametrize(
    ("axis", "factor", "attribute", "value"),
    [("0 -1 0", -1, "multiplier", "1"), ("0 1 0", 1, "xyz", "0 -1 0")],
    ids=["factor", "axis"],
)
def test_of_fingers_of_a_urdf_the_factor_is_told_where_it_leads_out_of_the_range(axis, factor, attribute, value):
    inertia = '<inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/>'
    inertial = f'<inertial><mass value="0.1"/>{inertia}</inertial>'
    finger = (
        '<link name="{0}">{4}</link><joint name="{0}_joint" type="prismatic"><parent link="palm"/><child link="{0}"/>'
        '<origin xyz="0 {1} 0"/><axis xyz="{2}"/><limit lower="0" upper="0.04" effort="9" velocity="1"/>{3}</joint>'
    )
    mimic = f'<mimic joint="left_joint" multiplier="{factor}"/>'
    both = finger.format("left", 0.01, "0 1 0", "", inertial) + finger.format("right", -0.01, axis, mimic, inertial)
    text = f'<robot name="g"><link name="palm"/>{both}</robot>'
    assert [(each.attribute, each.value) for each in hints(text, "fingers-move-together")] == [(attribute, value)]
