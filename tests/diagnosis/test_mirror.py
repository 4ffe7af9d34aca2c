"""What is the mirror image of what: names, limbs, hands and ranges."""

from __future__ import annotations

import pytest
from clinic.diagnosis.probes.sides import right_of
from clinic.diagnosis.probes.twins import twins
from diagnosed import hints
from pairs import legs, odd, robot, simulated, unlike

CHAIN = "".join(
    f'<body name="{{side}}/{part}" pos="0.2 0 0.02"><inertial pos="0.1 0.01 0.02" mass="0.3" '
    f'fullinertia="2e-4 5e-4 6e-4 -1e-4 0 0"/><joint name="{{side}}/{part}" axis="{axis}" damping="1" range="-50 60"/>'
    '<geom size="0.03"/>'
    for part, axis in (
        ("waist", "0 0 1"), ("shoulder", "0 1 0"), ("elbow", "0 1 0"), ("roll", "1 0 0"), ("left_finger", "0 1 0"),
    )
)  # fmt: skip


def test_two_arms_that_face_each_other_are_copies_and_no_mirror_images():
    arms = "".join(
        f'<body name="{side}/base" pos="{x} 0 0" euler="0 0 {turn}"><geom size="0.05"/>{CHAIN.format(side=side)}'
        + "</body>" * 6
        for side, x, turn in (("left", -0.5, 0), ("right", 0.5, 180))
    )
    assert unlike(f"<mujoco><worldbody>{arms}</worldbody></mujoco>") == []


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("left/left_finger", "right/left_finger"),
        ("left_knee", "right_knee"),
        ("LHipPitch", "RHipPitch"),
        ("thigh_L", "thigh_R"),
        ("FL_calf_joint", "FR_calf_joint"),
        ("RL_calf", "RR_calf"),
        ("l_finger", "r_finger"),
        ("kneeLeft", "kneeRight"),
        ("foot_left_geom", "foot_geom"),
    ],
)
def test_the_right_twin_of_a_name(left, right):
    assert right in right_of(left)


def test_a_name_without_a_side_has_no_twin():
    assert not list(right_of("pelvis"))


def test_mirrored_ranges_are_alike():
    """Axes that are parallel turn mirror images by opposite angles: then -30 60 belongs to -60 30."""
    mirrored = twins(simulated(robot(left="-30 60", right="-60 30")))
    assert not [each for each in mirrored.comparisons if each.odd]
    copied = twins(simulated(robot(left="-30 60", right="-30 60")))
    assert [each.quantity for each in copied.comparisons if each.odd] == ["range"] * 3


def test_a_hip_out_of_place_does_not_move_the_mirror():
    legs_of_two = robot({'left_rear:pos="-0.2 0.1 0"': 'pos="-0.2 0.15 0"'}, right="-60 30")
    hint = next(each for each in hints(legs_of_two) if each.rule == "twin-place-differs")
    assert (hint.attribute, hint.elements) == ("pos", ('body "left_rear"',)), "the others are as far from the middle"


LEG = (
    '<body name="{side}_thigh" pos="{x} {y} -0.3"><joint name="{side}_hip" axis="0 -1 0" range="-20 100"/>'
    '<geom type="capsule" size="0.05" fromto="0 0 0 0 0 -0.4"/>'
    '<body name="{side}_shin" pos="0 0 -0.4"><joint name="{side}_knee" axis="0 -1 0" range="-150 0"/>'
    '<geom type="capsule" size="0.04" fromto="0 0 0 0 0 -0.4"/>'
    '<body name="{side}_foot" pos="0.06 0 -0.4"><joint name="{side}_ankle" axis="0 -1 0" range="-45 45"/>'
    '<geom name="{side}_right_foot" type="capsule" size="0.03" fromto="-0.1 -0.03 0 0.1 -0.02 0"/>'
    '<geom name="{side}_left_foot" type="capsule" size="0.03" fromto="-0.1 0.03 0 0.1 0.02 0" {of_the_foot}/>'
    "</body></body></body>"
)


def planar(right_x: float = 0, of_the_left_foot: str = "") -> str:
    legs = LEG.format(side="right", x=right_x, y=-0.05, of_the_foot="")
    legs += LEG.format(side="left", x=0, y=0.05, of_the_foot=of_the_left_foot)
    return (
        '<mujoco><worldbody><geom name="floor" type="plane" size="5 5 1"/><body name="torso" pos="0 0 1.3">'
        '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint axis="0 1 0"/>'
        f'<geom type="capsule" size="0.07" fromto="0 0 -0.3 0 0 0.3"/>{legs}</body></worldbody></mujoco>'
    )


def test_a_leg_that_was_put_elsewhere_is_told_though_all_of_it_hangs_straight_down():
    assert unlike(planar()) == []
    (found,) = unlike(planar(0.27))
    assert found.attribute == "pos"
    assert set(found.elements) == {'body "left_thigh"', 'body "right_thigh"'}


def test_the_left_geom_of_the_right_foot_is_the_twin_of_the_right_geom_of_the_left_one():
    (found,) = unlike(planar(of_the_left_foot='contype="0" conaffinity="0"'))
    assert found.elements == ('geom "left_left_foot"',)
    assert 'geom "right_right_foot"' in found.says


def test_an_axis_that_points_the_other_way_is_told_where_the_ranges_have_the_same_numbers():
    text = planar()
    wrong = text.replace('name="left_hip" axis="0 -1 0"', 'name="left_hip" axis="0 1 0"')
    assert wrong != text
    (found,) = unlike(wrong)
    assert found.attribute == "axis"
    assert {'joint "left_hip"', 'joint "right_hip"'} == set(found.elements)


def test_fingers_on_the_same_side_of_both_hands_make_no_copy_of_mirrored_arms():
    def arm(side: str, y: int) -> str:
        fingers = "".join(
            f'<body name="{side}_finger_{each}" pos="0.06 {place} 0"><geom type="box" size="0.03 0.01 0.01"/>'
            f'<joint name="{side}_grip_{each}" type="slide" axis="0 {-place} 0" range="0 0.03"/></body>'
            for each, place in (("a", 0.04), ("b", -0.04))
        )
        roll = "-0.3 1.9" if y > 0 else "-1.9 0.3"
        return (
            f'<body name="{side}_shoulder" pos="0 {0.19 * y} 0.4"><joint axis="0 1 0" range="-2.8 1.2"/>'
            f'<inertial pos="0 {0.02 * y} 0" mass="1" diaginertia="0.002 0.002 0.002"/>'
            f'<body name="{side}_upperarm" pos="0 {0.06 * y} 0"><joint axis="1 0 0" range="{roll}"/>'
            '<geom type="capsule" fromto="0 0 0 0 0 -0.24" size="0.04"/><body pos="0 0 -0.27">'
            '<joint axis="0 1 0" range="-1.4 1.1"/><geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03"/>'
            f'<body pos="0.24 0 0"><joint axis="1 0 0" range="-1.6 1.6"/><geom size="0.02"/>{fingers}'
            "</body></body></body></body>"
        )

    torso = f'<body pos="0 0 1"><geom size="0.1"/>{arm("l", 1)}{arm("r", -1)}</body>'
    assert not unlike(f'<mujoco><compiler angle="radian"/><worldbody>{torso}</worldbody></mujoco>')


def test_the_leg_that_goes_inward_beside_pairs_that_go_outward_is_the_one_that_is_turned():
    def leg(name: str, x: float, y: float, turn: int) -> str:
        links = "".join(
            f'<body name="{name}_{part}" pos="{far} 0 0"><joint axis="0 1 0" range="-50 60"/>'
            '<geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01"/>'
            for part, far in (("femur", 0.05), ("tibia", 0.08))
        )
        return (
            f'<body name="{name}_coxa" pos="{x} {y} 0" euler="0 0 {turn}"><joint axis="0 0 1" range="-40 40"/>'
            f'<geom size="0.02"/>{links}</body></body></body>'
        )

    legs = "".join(
        leg(f"{side}{part}", x, y, -90 if (side, part) == ("l", "m") else 90 if y > 0 else -90)
        for part, x in (("f", 0.1), ("m", 0), ("r", -0.1))
        for side, y in (("l", 0.08), ("r", -0.08))
    )
    text = f'<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom size="0.05"/>{legs}</body></worldbody></mujoco>'
    (found,) = hints(text, "twin-turned")
    assert found.elements == ('body "lm_coxa"', 'body "rm_coxa"')
    assert found.edit[0].line == 1
    assert "Nothing here tells" not in found.says


def test_a_centre_in_millimetres_does_not_make_any_mirror_fit():
    (found,) = unlike(robot({'left_rear:<inertial pos="0 0.05 0"': '<inertial pos="0 50 0"'}))
    assert found.elements == ('body "left_rear"',)
    assert found.value.startswith('<inertial pos="0 0.05 0"')


HAND = (
    '<body name="{side}_hand" pos="{x} {y} -0.25"><geom size="0.02"/>'
    '<body name="{side}_thumb" pos="0.01 0.03 -0.05"><joint name="{side}_thumb" axis="1 0 0" range="{thumb}"/>'
    '<geom size="0.01" mass="0.1"/></body>'
    '<body name="{side}_finger" pos="0 -0.03 -0.05"><joint name="{side}_finger" axis="-1 0 0" range="0 40"/>'
    '<geom size="0.01" mass="0.1"/></body></body>'
)


@pytest.mark.parametrize(("thumb", "told"), [("0 40", []), ("0 60", ["range"])])
def test_a_hand_that_is_its_own_mirror_image_may_be_a_copy(thumb, told):
    """As mirror images, both fingers of the right hand would stand on the other side, and turn the other way."""
    text = robot(right="-60 30").removesuffix("</body></worldbody></mujoco>")
    hands = HAND.format(side="left", x=0, y=0.2, thumb="0 40") + HAND.format(side="right", x=0, y=-0.2, thumb=thumb)
    found = unlike(f"{text}{hands}</body></worldbody></mujoco>")
    assert [each.attribute for each in found if "thumb" in each.elements[0] and each.attribute == "range"] == told
    assert not told or found
    assert told or not found


@pytest.mark.parametrize(("knee", "told"), [("-88 0", []), ("-86 0", ["range"])])
def test_ends_of_ranges_that_differ_by_less_than_3_degrees_are_alike(knee, told):
    toe = '<body name="{0}"><joint name="{0}" axis="0 1 0" range="-20 20"/><geom size="0.01"/></body>'
    toes = "".join(toe.format(f"{side}_toe{i}") for side in ("FL", "FR") for i in range(3))
    text = legs().replace('<body name="RL_thigh"', f'{toes}<body name="RL_thigh"')
    assert (
        odd(
            text.replace('name="RL_knee" axis="0 1 0" range="-90 0"', f'name="RL_knee" axis="0 1 0" range="{knee}"'),
            "joint",
        )
        == told
    )


@pytest.mark.parametrize(("knee", "told"), [("0 90", []), ("-90 0", ["range", "axis sign"])])
def test_a_range_that_is_negated_with_its_axis_is_the_same_motion(knee, told):
    turned = f'name="RL_knee" axis="0 -1 0" range="{knee}"'
    assert odd(legs().replace('name="RL_knee" axis="0 1 0" range="-90 0"', turned), "joint") == told


FIN = """<body name="fin_{0}" pos="0.02 {1} 0" {4}><joint axis="0 1 0" range="-40 40"/>
  <geom name="fin_{0}" type="box" size="0.016 0.025 0.002" pos="-0.005 {2} {3}"/></body>"""


@pytest.mark.parametrize(
    ("right", "told"),
    [
        (("-0.028", "0.025", "0", ""), ("geom", "-0.005 -0.025 0")),
        (("-0.028", "-0.025", "0", ""), None),
        (("-0.028", "0.025", "0", 'euler="180 0 0"'), None),
    ],
    ids=["copied", "mirrored", "the part turned"],
)
def test_a_part_that_is_copied_to_the_other_side_is_told_of_one_pair_alone(right, told):
    fins = FIN.format("l", "0.028", "0.025", "0", "") + FIN.format("r", *right)
    fish = f'<body pos="0 0 1"><freejoint/><geom type="ellipsoid" size="0.1 0.02 0.03"/>{fins}</body>'
    found = hints(f"<mujoco><worldbody>{fish}</worldbody></mujoco>", "twin-place-differs")
    assert [(each.elements[0].split()[0], each.value) for each in found] == ([told] if told else [])


@pytest.mark.parametrize(("height", "told"), [("-0.15", True), ("-0.1", False)])
def test_a_wheel_that_is_lower_than_its_twin_and_all_others_is_told(height: str, told: bool):
    wheel = '<body name="{}" pos="{} {} {}"><joint axis="0 1 0"/><geom size="0.1"/></body>'
    places = [("fl", 0.3, 0.27, -0.1), ("fr", 0.3, -0.27, -0.1), ("rl", -0.3, 0.27, height), ("rr", -0.3, -0.27, -0.1)]
    wheels = "".join(wheel.format(f"wheel_{name}", *place) for name, *place in places)
    car = f'<body pos="0 0 1"><freejoint/><geom type="box" size="0.4 0.2 0.05"/>{wheels}</body>'
    found = hints(f"<mujoco><worldbody>{car}</worldbody></mujoco>", "twin-place-differs")
    assert [(each.elements[0], each.value) for each in found] == [('body "wheel_rl"', "-0.3 0.27 -0.1")] * told
