"""What comes in pairs, beyond the laws: near misses, and healthy models that look ill."""

from __future__ import annotations

import re

import pytest
from clinic.diagnosis.finding import Finding
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.siblings import odd_ones
from clinic.diagnosis.probes.sides import by_name, right_of
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.rules import rules
from clinic.diagnosis.simulation import Simulation, Start
from diagnosed import causes, diagnosed, findings, hints, with_edits

PARTS = ("front", "middle", "rear")


def robot(change: dict[str, str] | None = None, **of_side: str) -> str:
    """Six legs in pairs; `change` replaces text of one body, by its name."""
    legs = ""
    for place, part in enumerate(PARTS):
        for side, y in (("left", 0.1), ("right", -0.1)):
            name = f"{side}_{part}"
            leg = (
                f'<body name="{name}" pos="{0.2 - 0.2 * place} {y} 0"><inertial pos="0 {y / 2} 0" mass="0.2" '
                f'diaginertia="1e-4 2e-4 3e-4"/><joint name="{name}" axis="1 0 0" damping="0.1" '
                f'range="{of_side.get(side, "-30 60")}"/><geom size="0.04" pos="0.0 {y / 2} 0"/></body>'
            )
            for found, other in (change or {}).items():
                who, _, text = found.partition(":")
                if who == name:
                    assert text in leg
                    leg = leg.replace(text, other)
            legs += leg
    return f'<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom size="0.1"/>{legs}</body></worldbody></mujoco>'


def unlike(text: str) -> list[Finding]:
    """What the rules about twins find, as causes and as hints."""
    return [each for each in findings(text) if each.rule.startswith("twin-")]


def simulated(text: str) -> Simulation:
    return Simulation(NativeEngine().compile(text, {}), Start())


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


def test_a_robot_in_which_all_pairs_differ_has_no_cause():
    assert not causes(robot(left="-30 60", right="-30 60"))


@pytest.mark.parametrize(
    ("found", "other", "attribute"),
    [
        ('right_rear:range="-60 30"', 'range="-30 60"', "range"),
        ('left_front:damping="0.1"', 'damping="1"', "damping"),
        ('right_middle:pos="0 -0.05 0"', 'pos="0 -0.01 0"', "center of mass"),
        ('left_rear:mass="0.2"', 'mass="0.6"', "mass"),
        ('left_rear:axis="1 0 0"', 'axis="0 1 0"', "axis"),
    ],
)
def test_the_odd_one_is_named_and_its_twins_value_mends_it(found, other, attribute):
    text = robot({found: other}, right="-60 30")
    (odd_one,) = unlike(text)
    assert odd_one.attribute == attribute
    assert found.partition(":")[0].partition("_")[2] in odd_one.elements[0]
    assert unlike(with_edits(text, odd_one)) == []


def test_a_third_copy_tells_which_one_is_odd():
    """Damping that only one element of all has is the odd one's, whichever side it is on."""
    for side in ("left", "right"):
        (odd_one,) = unlike(robot({f'{side}_front:damping="0.1"': 'damping="1"'}, right="-60 30"))
        assert odd_one.elements == (f'joint "{side}_front"',)


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


def test_targets_copied_to_the_other_side_of_a_mirrored_pair_are_the_fault():
    arm = (
        '<body name="{0}_arm" pos="0 {1} 1"><joint name="{0}_lift" axis="1 0 0" range="{2}" damping="1"/>'
        '<geom type="capsule" fromto="0 0 0 0 {1} 0" size="0.02" mass="0.1"/></body>'
    )
    arms = arm.format("left", "0.2", "0 3") + arm.format("right", "-0.2", "-3 0")
    servos = "".join(f'<position joint="{side}_lift" kp="50" kv="5" ctrlrange="0 3"/>' for side in ("left", "right"))
    compiler = '<compiler angle="radian"/>'
    found = diagnosed(f"<mujoco>{compiler}<worldbody>{arms}</worldbody><actuator>{servos}</actuator></mujoco>")
    (told,) = (each for each in found.causes if each.rule == "control-range-too-narrow")
    assert [edit.value for edit in told.edit] == ["-3 0"]


def legs(calf: str = "0.02 0.02 0.06", mass: str = "0.2", knee: str = "0 0 -0.21") -> str:
    """A dog of four legs, of which one may have another calf."""
    made = ""
    for name, x, y in (("FL", 0.2, 0.1), ("FR", 0.2, -0.1), ("RL", -0.2, 0.1), ("RR", -0.2, -0.1)):
        own = (calf, mass, knee) if name == "RL" else ("0.02 0.02 0.06", "0.2", "0 0 -0.21")
        inertial = 'pos="0 0 -0.05" mass="{}" diaginertia="2e-4 2e-4 3e-5"'
        made += (
            f'<body name="{name}_thigh" pos="{x} {y} 0"><inertial {inertial.format(0.4)}/>'
            f'<joint name="{name}_hip" axis="0 1 0" range="-60 60"/><geom size="0.02" pos="0 0 -0.1"/>'
            f'<body name="{name}_calf" pos="{own[2]}"><inertial {inertial.format(own[1])}/>'
            f'<joint name="{name}_knee" axis="0 1 0" range="-90 0"/>'
            f'<geom type="box" size="{own[0]}" pos="0 0 -0.06"/></body></body>'
        )
    trunk = '<freejoint/><geom size="0.1" mass="5"/>'
    return f'<mujoco><worldbody><body pos="0 0 1">{trunk}{made}</body></worldbody></mujoco>'


@pytest.mark.parametrize(
    ("change", "attribute", "level"),
    [
        ({"calf": "0.02 0.02 0.09"}, "size", "hint"),
        ({"mass": "0.24"}, "mass", "cause"),
        ({"knee": "0 0 -0.29"}, "pos", "hint"),
    ],
)
def test_the_leg_that_three_others_outvote_is_the_odd_one(change, attribute, level):
    (odd_one,) = findings(legs(**change))
    assert (odd_one.attribute, odd_one.level) == (attribute, level)
    assert "RL_calf" in " ".join(odd_one.elements)
    assert len(odd_one.elements) == 1


def test_digits_in_another_order_are_told_and_a_length_that_hardly_differs_without_its_edit():
    (clear,) = hints(legs(knee="0 0 -0.12"))
    assert "same digits" in clear.says
    assert clear.after == 0
    (slight,) = hints(legs(calf="0.02 0.02 0.066"))
    assert (slight.attribute, slight.after) == ("size", None)
    assert not hints(legs(knee="0 0 -0.201"))


def test_where_nothing_tells_which_side_is_wrong_both_are_named():
    ranges = {"left_front": "-31 61", "right_front": "-61 31", "left_rear": "-32 62", "right_rear": "-30 32"}
    written = {"left": "-30 60", "right": "-60 30"}
    change = {f'{name}:range="{written[name.partition("_")[0]]}"': f'range="{new}"' for name, new in ranges.items()}
    (odd_one,) = unlike(robot(change, right="-60 30"))
    assert odd_one.elements == ('joint "left_rear"', 'joint "right_rear"')
    assert odd_one.says.endswith(
        f"which of the two is wrong. {odd_one.elements[0]} has -32 62, {odd_one.elements[1]} -30 32."
    )
    assert (odd_one.value, odd_one.edit) == ("", ())
    assert odd_one.edit == (), "it might spoil the healthy side"


def test_a_hip_out_of_place_does_not_move_the_mirror():
    legs_of_two = robot({'left_rear:pos="-0.2 0.1 0"': 'pos="-0.2 0.15 0"'}, right="-60 30")
    hint = next(each for each in hints(legs_of_two) if each.rule == "twin-place-differs")
    assert (hint.attribute, hint.elements) == ("pos", ('body "left_rear"',)), "the others are as far from the middle"


def test_a_motor_that_turns_the_other_way_is_the_one_with_the_rare_sign():
    names = [f"{side}_{part}" for part in PARTS for side in ("left", "right")]
    motors = "".join(
        f'<motor name="{name}" joint="{name}" gear="{-5 if name == "left_rear" else 5}"/>' for name in names
    )
    text = robot(right="-60 30").replace("</mujoco>", f"<actuator>{motors}</actuator></mujoco>")
    hint = next(each for each in hints(text) if each.rule == "twin-actuator-differs")
    assert (hint.attribute, hint.elements, hint.value) == ("gear sign", ('actuator "left_rear"',), "5")


def test_what_moves_nothing_is_told_last():
    driven = robot({'left_front:mass="0.2"': 'mass="0.3"'}).replace(
        "</mujoco>", '<actuator><muscle joint="left_front" ctrlrange="-1 1"/></actuator></mujoco>'
    )
    told = [each.rule for each in hints(driven)]
    assert "twin-inertia-differs" in told[:-1]
    assert told[-1] == "muscle-excited-below-zero"


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


@pytest.mark.parametrize(("x", "told"), [(0.1, []), (-0.1, ["pos"])])
def test_one_geom_of_many_that_is_on_the_other_side_is_told_and_the_same_part_on_both_is_not(x, told):
    change = {'left_rear:pos="0.0 0.05 0"': f'pos="{x} 0.05 0"', 'right_rear:pos="0.0 -0.05 0"': 'pos="0.1 -0.05 0"'}
    assert [each.attribute for each in unlike(robot(change, right="-60 30"))] == told


CAMERAS = {
    f'{side}_rear:<geom size="0.04"': f'<camera name="{side}_eye" pos="0 0 0.1" euler="{{}} 0 0"/><geom size="0.04"'
    for side in ("left", "right")
}


@pytest.mark.parametrize(("turn", "told"), [("-80", []), ("30", ["direction"])])
def test_of_two_cameras_the_one_that_looks_elsewhere_is_told(turn, told):
    turns = dict(zip(CAMERAS, ("80", turn), strict=True))
    change = {place: text.format(turns[place]) for place, text in CAMERAS.items()}
    assert [each.attribute for each in unlike(robot(change, right="-60 30"))] == told


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


PATHS = rules()["twin-path-differs"].example("Good")


@pytest.mark.parametrize(
    ("change", "told", "value"),
    [
        (("right_back", "right_front"), 'tendon "right_hamstring"', ""),  # as good as the other way round
        (("right_back", "left_back"), 'tendon "right_hamstring"', "right_back"),
        (("left_back", "right_back"), 'tendon "left_hamstring"', "left_back"),
    ],
)
def test_the_tendon_that_goes_through_the_other_side_is_told(change, told, value):
    one, other = (f'<site site="{name}"/>' for name in change)
    (hint,) = [each for each in hints(PATHS.replace(one, other)) if each.rule == "twin-path-differs"]
    assert hint.elements[0] == told
    assert [each.value for each in hint.edit] == [value] * bool(value)


def test_what_both_tendons_go_through_has_no_twin():
    middle = PATHS.replace('<site name="left_front"', '<site name="middle"/><site name="left_front"')
    both = middle.replace('_hamstring">', '_hamstring"><site site="middle"/>')
    wrong = both.replace('<site site="right_back"/>', '<site site="right_front"/>')
    assert [each.rule for each in hints(both)].count("twin-path-differs") == 0
    assert [each.rule for each in hints(wrong)].count("twin-path-differs") == 1


def test_one_finger_of_four_with_other_moments_gets_those_of_the_others() -> None:
    finger = (
        '<body name="finger{0}" pos="{0} 0 0"><inertial pos="0 0 0" mass="0.02" diaginertia="{1}"/>'
        '<joint axis="0 1 0"/><geom size="0.02"/></body>'
    )
    moments = ["3e-6 3e-6 1e-6", "1e-6 3e-6 3e-6", "3e-6 3e-6 1e-6", "4e-7 4e-7 1e-7"]
    fingers = "".join(finger.format(i, each) for i, each in enumerate(moments))
    text = f'<mujoco><worldbody><body name="hand"><geom size="0.1"/>{fingers}</body></worldbody></mujoco>'
    (cause,) = causes(text, "twin-inertia-differs")
    assert (cause.elements, cause.value) == (('body "finger3"',), "3e-6 3e-6 1e-6")


def test_the_twin_that_hangs_on_the_other_side_is_the_odd_one():
    (found,) = unlike(robot({'right_front:pos="0.2 -0.1 0"': 'pos="0.2 0.1 0"'}))
    assert (found.elements, found.value) == (('body "right_front"',), "0.2 -0.1 0")


@pytest.mark.parametrize(
    ("left", "right", "told"),
    [
        pytest.param("-0.06 0.05 0", "0.06 -0.05 0", ["0.06 0.05 0"], id="a-sign"),
        pytest.param("0.06 0.05 0", "0.06 -0.05 0", [], id="mirrored"),
        pytest.param("0.02 0 0", "0.06 0 0", [], id="elsewhere"),
    ],
)
def test_the_one_pair_of_sites_that_a_sign_sets_apart_is_told_in_a_robot_of_pairs(
    left: str, right: str, told: list[str]
) -> None:
    change = {}
    for side, place in (("left", left), ("right", right)):
        change[f"{side}_front:</body>"] = f'<site name="{side}_tip" pos="{place}"/></body>'
        change[f'{side}_front:inertial pos="0 '] = 'inertial pos="0.03 '
    found = [each for each in unlike(robot(change, left="-30 60", right="-60 30")) if "site" in each.elements[0]]
    assert [each.value for each in found] == told


@pytest.mark.parametrize(("axis", "told"), [("0 1 0", True), ("1 0 0", False)])
def test_a_link_that_turns_out_of_the_plane_of_the_pairs_has_its_centre_anywhere(axis: str, told: bool):
    text = rules()["centre-off-the-middle"].example("Good").replace("<freejoint/>", f'<joint axis="{axis}"/>')
    arm = '<body name="arm"><inertial pos="0 0.06 0" mass="1" diaginertia="0.01 0.01 0.01"/><joint axis="0 0 1"/>'
    text = text.replace("<worldbody>", f"<worldbody>{arm}").replace("</worldbody>", "</body></worldbody>")
    assert [each.elements for each in hints(text, "centre-off-the-middle")] == [('body "arm"',)] * told


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


def odd(text: str, kind: str) -> list[str]:
    """The quantities in which a pair of a kind differs."""
    return [each.quantity for each in twins(simulated(text)).comparisons if each.odd and each.kind == kind]


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


def test_two_contact_sensors_of_one_wall_and_a_finger_each_are_as_meant():
    sensors = "".join(
        f'<contact name="wall_{side}_found" geom1="wall" geom2="{side}_tip" data="found"/>'
        for side in ("left", "right")
    )
    tips = {f'{side}_rear:<geom size="0.04"': f'<geom name="{side}_tip" size="0.04"' for side in ("left", "right")}
    joints = "".join(f'<jointpos name="{n}" joint="{n}"/>' for p in PARTS for n in (f"left_{p}", f"right_{p}"))
    text = robot(tips, right="-60 30").replace(
        "<worldbody>", '<worldbody><geom name="wall" type="plane" size="1 1 1"/>'
    )
    assert not unlike(text.replace("</mujoco>", f"<sensor>{sensors}{joints}</sensor></mujoco>"))


@pytest.mark.parametrize(("child", "told"), [("0 -0.03 -0.21", False), ("0 0 -0.21", True)])
def test_a_frame_that_slides_along_its_own_hinge_moves_nothing(child, told):
    text = legs().replace('<body name="RL_thigh" pos="-0.2 0.1 0">', '<body name="RL_thigh" pos="-0.2 0.13 0">')
    text = text.replace('<body name="RL_calf" pos="0 0 -0.21">', f'<body name="RL_calf" pos="{child}">')
    assert ("pos" in odd(text, "body")) == told


@pytest.mark.parametrize(("right", "told"), [("0 0.05 0", False), ("0 0.04 0", True)])
def test_the_centre_of_mass_of_one_mesh_used_twice_is_the_same_in_its_frame(right, told):
    corners = " ".join(f"{x} {y} {z}" for x in (0, 0.02) for y in (0, 0.1) for z in (0, 0.02))
    mesh = f'<mesh name="motor" vertex="{corners}"/>'
    front, left, right_ = re.split("(?=<body name=.R[LR]_thigh)", legs())
    thighs = [
        each.replace('<inertial pos="0 0 -0.05" mass="0.4"', f'<inertial pos="{centre}" mass="0.4"').replace(
            '<geom size="0.02" pos="0 0 -0.1"/>', '<geom type="mesh" mesh="motor"/>'
        )
        for each, centre in ((left, "0 0.05 0"), (right_, right))
    ]
    text = "".join((front, *thighs))
    assert ("center of mass" in odd(text.replace("<worldbody>", f"<asset>{mesh}</asset><worldbody>"), "body")) == told


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


SERVO = '<position joint="{}" kp="20" kv="2" ctrlrange="{}"/>'


@pytest.mark.parametrize(
    ("more", "rule"),
    [
        (
            f"<actuator>{SERVO.format('left_front', '0 1.0472')}{SERVO.format('right_front', '-1.0472 0')}</actuator>",
            "control-range-too-narrow",
        ),
        ('<keyframe><key qpos="0 0 1 1 0 0 0  .5 -.5 .5 -.5 .5 -.5"/></keyframe>', "key-outside-range"),
    ],
    ids=["targets", "a keyframe"],
)
def test_what_agrees_with_the_image_of_the_twin_is_not_blamed_for_a_copied_range(more, rule):
    for change, told in (({'right_front:range="-60 0"': 'range="0 60"'}, True), ({}, False)):
        text = robot(change, left="0 60", right="-60 0").replace("</mujoco>", f"{more}</mujoco>")
        found = diagnosed(text)
        assert rule not in [each.rule for each in (*found.causes, *found.hints)]
        names = [each.elements for each in found.hints if each.rule == "twin-joint-differs"]
        assert bool(names) == told
        assert all(each[0] == 'joint "right_front"' for each in names) or rule == "key-outside-range"


def test_a_target_that_misses_the_range_of_both_twins_is_blamed():
    servos = f"{SERVO.format('left_front', '0 1.0472')}{SERVO.format('right_front', '0.2 1.0472')}"
    text = robot(left="0 60", right="-60 0").replace("</mujoco>", f"<actuator>{servos}</actuator></mujoco>")
    assert "control-range-too-narrow" in [each.rule for each in causes(text)]
