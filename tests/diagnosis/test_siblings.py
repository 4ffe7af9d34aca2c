"""Fingers, rods and wheels that are alike but for one, beyond the laws."""

from __future__ import annotations

import pytest
from clinic.diagnosis.probes.siblings import odd_ones
from clinic.diagnosis.probes.sides import by_name
from diagnosed import diagnosed, hints
from pairs import robot, simulated, unlike

PALM = '<geom type="box" size="0.04 0.05 0.01"/>'


@pytest.mark.parametrize(("thumb", "odd"), [(0.03, ["finger4"]), (0.02, [])])
def test_a_finger_is_unlike_its_siblings_beside_a_thumb_of_another_mass(thumb, odd):
    fingers = "".join(
        f'<body name="finger{i}" pos="{0.04 if i > 1 else 0} {0.02 * i} 0"><joint axis="0 1 0" range="0 90"/>'
        f'<inertial pos="0 0 {each / 1000}" mass="{0.02 if i > 1 else thumb}" diaginertia="2e-6 2e-6 1e-6"/>'
        '<geom type="capsule" size="0.008" fromto="0 0 0 0 0 0.04"/></body>'
        for i, each in enumerate((13, 16, 16, 27, 16), 1)
    )
    assert [
        each.elements
        for each in unlike(f'<mujoco><worldbody><body pos="0 0 1">{PALM}{fingers}</body></worldbody></mujoco>')
    ] == [(f'body "{name}"',) for name in odd]


def test_one_finger_of_three_is_odd_and_links_of_a_chain_are_no_siblings():
    finger = '<body pos="{i} 0 1"><joint name="finger_{i}" axis="0 1 0" damping="{d}"/><geom size="0.1"/>{inner}</body>'
    hand = "".join(finger.format(i=i, d=0.1 if i != 2 else 3, inner="") for i in range(4))
    (odd,) = odd_ones(simulated(f"<mujoco><worldbody>{hand}</worldbody></mujoco>"), "joint")
    assert (odd.index, odd.attribute) == (2, "damping")
    chain = ""
    for i in (3, 2, 1, 0):
        chain = finger.format(i=i, d=0.1 if i != 2 else 3, inner=chain)
    assert not list(odd_ones(simulated(f"<mujoco><worldbody>{chain}</worldbody></mujoco>"), "joint"))


CLASSES = """
<default>
  <joint damping="0.05" armature="0.002"/>
  <default class="knuckle"><joint axis="0 0 1" range="-20 20"/><position kp="2" ctrlrange="-0.35 0.35"/></default>
  <default class="link"><joint axis="0 -1 0" range="-15 90"/><position kp="2" ctrlrange="-0.26 1.57"/></default>
</default>
"""


def fingers(mend: str = "", class_of_first: str = "knuckle") -> str:
    """A hand whose knuckles and links have classes of their own; `mend` is written at the first knuckle."""
    made, servos = "", ""
    for place, name in enumerate(("ff", "mf", "rf", "lf")):
        first = f'class="{class_of_first}" {mend}' if name == "ff" else 'class="knuckle"'
        made += (
            f'<body name="{name}knuckle" pos="0.09 {0.03 - 0.02 * place} 0"><joint name="{name}J3" {first}/>'
            f'<geom size="0.009"/><body name="{name}link"><joint name="{name}J2" class="link"/>'
            '<geom type="capsule" fromto="0.01 0 0 0.04 0 0" size="0.008"/></body></body>'
        )
        servos += f'<position joint="{name}J3" class="knuckle"/><position joint="{name}J2" class="link"/>'
    palm = f'<body name="palm" pos="0 0 1">{PALM}{made}</body>'
    return f"<mujoco>{CLASSES}<worldbody>{palm}</worldbody><actuator>{servos}</actuator></mujoco>"


@pytest.mark.parametrize(
    ("mend", "class_of_first", "told"),
    [
        ("", "knuckle", []),
        ("", "link", [("class", "knuckle")]),
        ('axis="0 0 1"', "link", [("class", "knuckle")]),
        ('range="-15 90"', "link", [("range", "-20 20"), ("axis", "0 0 1")]),
        ('range="-15 90"', "knuckle", [("range", "-20 20")]),
    ],
)
def test_a_finger_of_another_class_than_its_siblings_gets_theirs(mend, class_of_first, told):
    found = diagnosed(fingers(mend, class_of_first))
    assert not found.causes
    odd_ones = [each for each in found.hints if each.rule == "twin-joint-differs"]
    assert sorted((each.attribute, each.value) for each in odd_ones) == sorted(told)
    assert {each.elements for each in odd_ones} <= {('joint "ffJ3"',)}
    ranged = [each for each in found.hints if each.rule == "control-range-unlike-range"]
    assert [(each.elements[0], each.attribute) for each in ranged] == [('joint "ffJ3"', "range")] * bool(told)


def test_the_little_finger_and_the_ring_finger_are_no_pair():
    assert by_name(simulated(fingers()), "joint") == []


def test_either_of_two_fingers_that_follow_each_other_may_be_driven():
    hands = "".join(
        f'<body name="{hand}_hand" pos="0 {y} 0"><geom size="0.03"/>'
        + "".join(
            f'<body pos="0.05 {z} 0"><joint name="{hand}_{finger}_finger" type="slide" axis="0 {-z} 0" range="0 0.03"/>'
            '<geom type="box" size="0.02 0.005 0.01"/></body>'
            for finger, z in (("left", 0.02), ("right", -0.02))
        )
        + "</body>"
        for hand, y in (("left", 0.3), ("right", -0.3))
    )
    coupled = "".join(
        f'<joint joint1="{hand}_right_finger" joint2="{hand}_left_finger"/>' for hand in ("left", "right")
    )
    driven = "".join(
        f'<motor name="{hand}_grip" joint="{hand}_left_finger" ctrlrange="-1 1"/>' for hand in ("left", "right")
    )
    text = robot(right="-60 30").replace("</body></worldbody>", f"{hands}</body></worldbody>")
    text = text.replace("</mujoco>", f"<equality>{coupled}</equality><actuator>{driven}</actuator></mujoco>")
    assert [each for each in unlike(text) if each.attribute == "joint"] == []


def test_one_finger_of_four_with_other_moments_gets_those_of_the_others() -> None:
    finger = (
        '<body name="finger{0}" pos="{0} 0 0"><inertial pos="0 0 0" mass="0.02" diaginertia="{1}"/>'
        '<joint axis="0 1 0"/><geom size="0.02"/></body>'
    )
    moments = ["3e-6 3e-6 1e-6", "1e-6 3e-6 3e-6", "3e-6 3e-6 1e-6", "4e-7 4e-7 1e-7"]
    fingers = "".join(finger.format(i, each) for i, each in enumerate(moments))
    text = f'<mujoco><worldbody><body name="hand"><geom size="0.1"/>{fingers}</body></worldbody></mujoco>'
    (hint,) = hints(text, "twin-inertia-differs")
    assert (hint.elements, hint.value) == (('body "finger3"',), "3e-6 3e-6 1e-6")


@pytest.mark.parametrize(("y", "told"), [("0.0866025", []), ("0.06", ["center of mass"])])
def test_a_rod_in_a_frame_that_is_turned_is_like_its_siblings(y, told):
    rod = '<body name="rod_{0}"><joint axis="0 0 1"/><inertial pos="{1}" mass="1" diaginertia="1 1 1"/>'
    rods = "".join(f'{rod.format(i, "0.1 0 0")}<geom pos="0.1 0 0" size="0.01"/></body>' for i in range(4))
    rods += f'{rod.format(4, f"0.05 {y} 0")}<geom pos="0.05 0.0866025 0" size="0.01"/></body>'
    found = odd_ones(simulated(f"<mujoco><worldbody>{rods}</worldbody></mujoco>"), "body")
    assert [each.attribute for each in found] == told


@pytest.mark.parametrize(("ends", "told"), [("", []), (' range="-60 60"', ["quat"])])
def test_a_wheel_that_is_rolled_on_is_not_turned(ends, told):
    def wheel(side: str, y: float, quat: str) -> str:
        spoke = '<body name="{0}_{1}" pos="{2}"><joint axis="1 0 0"/><geom size="0.01"/></body>'
        spokes = "".join(spoke.format(side, i, x) for i, x in enumerate(("0.1 0 0", "-0.05 0.03 0.08", "0 0 -0.1")))
        joint = f'<joint name="{side}_wheel" axis="0 1 0"{ends}/>'
        return f'<body name="{side}_wheel" pos="0 {y} 0" quat="{quat}">{joint}<geom size="0.05"/>{spokes}</body>'

    wheels = wheel("left", 0.2, "0.8 0 0.6 0") + wheel("right", -0.2, "0.6 0 0.8 0")
    text = robot(right="-60 30").removesuffix("</body></worldbody></mujoco>")
    assert [each.attribute for each in hints(f"{text}{wheels}</body></worldbody></mujoco>", "twin-turned")] == told
