"""What comes in pairs, beyond the laws: near misses, and healthy models that look ill."""

from __future__ import annotations

import re

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import causes, diagnosed, findings, hints, with_edits
from pairs import PARTS, legs, odd, robot, unlike


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


@pytest.mark.parametrize(
    ("change", "attribute"),
    [({"calf": "0.02 0.02 0.09"}, "size"), ({"mass": "0.24"}, "mass"), ({"knee": "0 0 -0.29"}, "pos")],
)
def test_the_leg_that_three_others_outvote_is_the_odd_one(change, attribute):
    (odd_one,) = findings(legs(**change))
    assert odd_one.attribute == attribute
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
    assert (odd_one.value, odd_one.edit) == ("", ()), "it might spoil the healthy side"


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


@pytest.mark.parametrize(("rest", "told"), [("-20", []), ("-0.35", ["springref"]), ("-17", [])])
def test_a_spring_at_rest_elsewhere_than_its_twins_is_told(rest, told):
    sprung = {
        f'{side}_{part}:damping="0.1"': f'damping="0.1" stiffness="30" springref="{20 if side == "left" else -20}"'
        for side in ("left", "right")
        for part in PARTS
    }
    sprung['right_front:damping="0.1"'] = f'damping="0.1" stiffness="30" springref="{rest}"'
    found = unlike(robot(sprung, right="-60 30"))
    assert [each.attribute for each in found if each.rule == "twin-joint-differs"] == told


@pytest.mark.parametrize(
    ("foot", "told"), [("</body>{}", ["left_shin"]), ("{}</body>", []), ("<body/></body>{}", [])],
    ids=["beside the shin", "on it", "beside a shin that carries something"],
)  # fmt: skip
def test_a_foot_that_hangs_a_link_higher_than_its_twin_is_told(foot: str, told: list[str]):
    part = '<body name="{0}_{1}" pos="{2}"><joint axis="0 1 0"/><geom size="0.03"/>'
    legs = "".join(
        part.format(side, "thigh", f"0 {y} 0") + part.format(side, "shin", "0 0 -0.3")
        + ends.format(part.format(side, "foot", "0 0 -0.3") + "</body>") + "</body>"
        for side, y, ends in (("left", 0.1, foot), ("right", -0.1, "{}</body>"))
    )  # fmt: skip
    text = f'<mujoco><worldbody><body><freejoint/><geom size="0.1"/>{legs}</body></worldbody></mujoco>'
    assert [each.value for each in hints(text, "twin-hangs-elsewhere")] == told
