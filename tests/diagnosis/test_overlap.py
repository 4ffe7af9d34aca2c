"""Parts that begin in each other or in the floor, or come to be so as they move."""

from __future__ import annotations

import pytest
from diagnosed import causes, diagnosed, findings, hints
from scenery import BOX, FLOOR


@pytest.mark.parametrize(("gap", "told"), [(0.0, True), (0.004, False)])
def test_a_link_that_grazes_the_base_it_turns_on_jams(gap, told):
    turn = '<joint name="turn" axis="0.02 0 1" range="-90 90"/>'
    link = f'<body name="link" pos="0 0 {0.04 + gap}">{turn}<geom type="box" size="0.1 0.03 0.02"/></body>'
    base = f'<body name="base" pos="0 0 0.5"><geom type="box" size="0.1 0.1 0.02"/>{link}</body>'
    text = f"<mujoco><worldbody>{base}</worldbody></mujoco>"
    assert [each.elements[0] for each in hints(text, "jams-over-the-range")] == ['joint "turn"'] * told


def test_all_joints_that_jam_are_told_together():
    leg = (
        '<body name="hip{0}" pos="{1} 0 0"><joint axis="0 1 0" range="-20 20"/><geom size="0.02"/>'
        '<body name="thigh{0}"><joint name="swing{0}" axis="1 0 0" range="-150 150"/>'
        '<geom type="capsule" fromto="0 0 -0.06 0 0 -0.3" size="0.03"/></body></body>'
    )
    sides = (
        '<geom type="box" size="0.5 0.05 0.3" pos="0 0.12 0"/><geom type="box" size="0.5 0.05 0.3" pos="0 -0.12 0"/>'
    )
    trunk = f'<body name="trunk" pos="0 0 1"><freejoint/>{sides}{leg.format("l", 0.2)}{leg.format("r", -0.2)}</body>'
    text = f"<mujoco><worldbody>{trunk}</worldbody></mujoco>"
    (found,) = hints(text, "jams-over-the-range")
    assert {'joint "swingl"', 'joint "swingr"'} <= set(found.elements)
    assert found.says.endswith("So it is with 1 more joint.")


def arm(hand: str) -> str:
    hinge = '<joint axis="0 0 1"/><geom size="0.01" pos="0 0 1"/>'
    return f"<body>{hinge}<body>{hinge}{hand}</body></body>"


@pytest.mark.parametrize(
    ("x", "of_arms", "rules"),
    [(0, False, ["hull-over-hole"]), (0.055, False, ["overlap-at-start"]), (0, True, [])],
)
def test_a_bar_in_the_opening_of_a_hook_is_no_overlap(x, of_arms, rules):
    """The hook is a U of three plates, open upwards; the second bar goes through one of them."""
    plates = [((-0.06, 0.06), (-0.06, -0.05)), ((-0.06, -0.05), (-0.06, 0.06)), ((0.05, 0.06), (-0.06, 0.06))]
    corners, faces = [], []
    for (left, right), (low, high) in plates:
        first = len(corners)
        corners += [(x, y, z) for x in (left, right) for y in (-0.02, 0.02) for z in (low, high)]
        quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        faces += [(first + a, first + b, first + c) for q in quads for a, b, c in (q[:3], (q[0], q[2], q[3]))]
    numbers = [" ".join(f"{each:g}" for one in of for each in one) for of in (corners, faces)]
    bar = f'<geom name="bar" type="capsule" fromto="{x} -.3 0 {x} .3 0" size="0.02"/>'
    hook = '<geom name="hook" type="mesh" mesh="hook"/>'
    things = arm(bar) + arm(hook) if of_arms else f"{bar}<body><freejoint/>{hook}</body>"
    text = (
        f'<mujoco><asset><mesh name="hook" vertex="{numbers[0]}" face="{numbers[1]}"/></asset>'
        f"<worldbody>{things}</worldbody></mujoco>"
    )
    assert [each.rule for each in findings(text, "hull-over-hole", "overlap-at-start")] == rules


def test_a_ball_inside_a_solid_mesh_is_in_no_hole():
    corners = " ".join(f"{x} {y} {z}" for x in (-0.1, 0.1) for y in (-0.1, 0.1) for z in (0, 0.2))
    faces = "0 1 3 0 3 2 4 6 7 4 7 5 0 4 5 0 5 1 2 3 7 2 7 6 0 2 6 0 6 4 1 5 7 1 7 3"
    text = (
        f'<mujoco><asset><mesh name="block" vertex="{corners}" face="{faces}"/></asset><worldbody>'
        '<geom type="mesh" mesh="block"/><body pos="0 0 0.1"><freejoint/><geom size="0.05"/></body>'
        "</worldbody></mujoco>"
    )
    assert [each.rule for each in causes(text, "hull-over-hole", "overlap-at-start")] == ["overlap-at-start"]


def test_halves_that_a_weld_holds_in_each_other_want_an_exclude_and_stay_where_they_are():
    half = '<body name="{0}" pos="0 0 {1}"><freejoint/><geom type="capsule" size=".03 .02"/></body>'
    halves = f"<worldbody>{FLOOR}{half.format('low', 0.06)}{half.format('top', 0.1)}</worldbody>"
    weld = '<equality><weld body1="low" body2="top" solref="0.004 1"/></equality>'
    found = diagnosed(f"<mujoco>{halves}{weld}</mujoco>")
    assert not found.causes
    assert [(each.rule, each.elements) for each in found.hints] == [
        ("overlap-of-relatives", ('body "low"', 'body "top"'))
    ]


@pytest.mark.parametrize(("wrist", "told"), [("-8 8", True), ("-200 200", False)])
def test_a_hand_that_is_in_its_forearm_at_one_angle_of_the_wrist_alone_is_well(wrist: str, told: bool):
    hand = (
        '<body name="hand"><joint axis="1 0 0" range="-160 160"/>'
        '<geom type="capsule" fromto="-0.15 0.05 0 -0.3 0.05 0" size="0.03"/></body>'
    )
    arm = (
        '<body name="forearm" pos="0 0 1"><joint axis="0 0 1"/>'
        '<geom type="capsule" fromto="0 0.03 0 0.3 0.03 0" size="0.04"/>'
        f'<body pos="0.4 0 0"><joint axis="0 1 0" range="{wrist}"/><geom size="0.01"/>{hand}</body></body>'
    )
    rules = ["jams-over-the-range", "overlap-of-relatives"]
    assert sorted(each.rule for each in hints(f"<mujoco><worldbody>{arm}</worldbody></mujoco>", *rules)) == rules * told


@pytest.mark.parametrize(("other", "edits"), [(0.02, 3), (0.05, 1)])
def test_what_is_as_deep_in_other_keyframes_and_in_its_own_place_is_lifted_there_too(other, edits):
    box = BOX.format(z=other, more="")
    keys = "".join(f'<key qpos="{x} 0 {z} 1 0 0 0"/>' for x, z in ((0, 0.02), (1, other), (2, 0.05)))
    text = f"<mujoco><worldbody>{FLOOR}{box}</worldbody><keyframe>{keys}</keyframe></mujoco>"
    (found,) = findings(text, "overlap-at-start")
    assert len(found.edit) == edits


CUBE = '<body name="cube" pos="0 0 {}"><freejoint/><geom type="box" size="0.05 0.05 0.05"/></body>'
WHEEL = '<body pos="0.1 {} 0"><joint axis="0 1 0"/><geom type="cylinder" size="0.33 0.01" zaxis="0 1 0"/></body>'
CART = f'<body pos="0 0 {{}}"><freejoint/><geom size="0.01"/>{WHEEL.format(0.1)}{WHEEL.format(-0.1)}</body>'


@pytest.mark.parametrize(
    ("inside", "z", "told"),
    [
        pytest.param(CUBE, 0.0255, ("size", "0.025 0.025 0.025"), id="half the edge stands on the floor"),
        pytest.param(CUBE, 0.015, ("pos", "0.035 m higher"), id="half of it is sunk still"),
        pytest.param(CART, 0.033, ("size", "0.033 0.01"), id="wheels of a tenth roll on the floor"),
        pytest.param(CART, 0.05, ("pos", "0.28 m higher"), id="wheels of a tenth hang in the air"),
    ],
)
def test_what_begins_in_the_floor_for_its_size_is_made_smaller(inside, z, told):
    text = f"<mujoco><worldbody>{FLOOR}{inside.format(z)}</worldbody></mujoco>"
    (found,) = causes(text, "overlap-at-start")
    assert (found.attribute, found.value) == told


@pytest.mark.parametrize(
    ("height", "house", "plane", "told"),
    [
        (-0.1, 0.25, FLOOR, "0 0 0.2"),
        (0.2, 0.25, FLOOR, None),
        (0.05, 0.25, FLOOR, None),
        (-0.1, 0.05, FLOOR, None),
        (-0.3, 0.4, FLOOR, None),
        (-0.1, 0.25, "", None),
    ],
    ids=["mostly below", "on it", "a little below", "with its joint", "wholly below", "no floor"],
)
def test_a_base_of_the_world_that_is_in_the_floor_for_the_most_part_is_told(height, house, plane, told):
    arm = f'<body pos="0 0 {house}"><joint axis="0 0 1"/><geom size="0.2" contype="0" conaffinity="0"/></body>'
    base = f'<body name="tracks" pos="0 0 {height}"><geom type="box" size="0.7 0.5 0.2"/>{arm}</body>'
    model = f"<mujoco><worldbody>{plane}{base}</worldbody></mujoco>"
    found = hints(model, "overlap-at-start")
    assert [(each.elements, each.value) for each in found] == ([(('body "tracks"',), told)] if told else [])


@pytest.mark.parametrize(
    ("rail", "told"),
    [
        pytest.param('type="capsule" fromto="-1.3 0 0 1.3 0 0" size="0.02"', True, id="through the cart"),
        pytest.param('type="capsule" fromto="-1.3 0 -0.07 1.3 0 -0.07" size="0.02"', False, id="flush"),
        pytest.param('type="capsule" fromto="-0.5 0 0 0.2 0 0" size="0.02"', False, id="not along all of the way"),
        pytest.param('type="plane" size="2 2 0.1" pos="0 0 -0.045"', False, id="a floor"),
    ],
)
def test_a_cart_that_is_in_its_rail_all_the_way_is_told(rail, told):
    slide = '<joint name="slider" type="slide" axis="1 0 0" range="-1 1"/>'
    cart = f'<body name="cart">{slide}<geom type="box" size="0.12 0.06 0.05" mass="1"/></body>'
    text = f"<mujoco><worldbody><geom {rail}/>{cart}</worldbody></mujoco>"
    assert [each.elements[0] for each in hints(text, "rubs-on-its-base")] == ['joint "slider"'] * told


@pytest.mark.parametrize(
    ("left", "right", "value"),
    [(0.002, -0.006, "0 0.006 0"), (0.006, -0.002, "0 -0.006 0"), (0.006, -0.006, None), (0.003, -0.003, None)],
    ids=["left", "right", "apart", "both alike"],
)
def test_of_two_fingers_in_each_other_the_nearer_one_is_told(left, right, value):
    finger = (
        '<body name="{0}_finger" pos="0 {1} 0"><joint type="slide" axis="0 {2} 0" range="0 0.04"/>'
        '<geom type="box" size="0.01 0.005 0.03" pos="0 0 -0.05"/></body>'
    )
    both = finger.format("left", left, 1) + finger.format("right", right, -1)
    palm = f'<body name="palm" pos="0 0 1"><joint/><geom size="0.01"/>{both}</body>'
    text = f"<mujoco><worldbody>{palm}</worldbody></mujoco>"
    found = hints(text, "overlap-of-relatives")
    assert [each.value for each in found if each.attribute == "pos"] == ([value] if value else [])


@pytest.mark.parametrize(
    ("height", "keys", "told"),
    [
        pytest.param(-0.009, "", "0 0 0.007", id="nearly all of it"),
        pytest.param(0.005, "", None, id="a little"),
        pytest.param(-0.009, '<keyframe><key qpos="0.1"/></keyframe>', None, id="raised by a keyframe"),
    ],
)
def test_a_tool_that_slides_on_the_world_and_begins_in_the_floor_is_raised(height, keys, told):
    slide = '<joint type="slide" axis="0 0 1" range="0 0.2" damping="20"/>'
    palm = f'{slide}<geom type="box" size="0.05 0.05 0.01" pos="0 0 0.5" contype="0" conaffinity="0"/>'
    tool = f'<body name="hoist" pos="0 0 {height}">{palm}<geom name="tip" type="box" size="0.008 0.01 0.007"/></body>'
    floor = '<geom type="plane" size="1 1 0.1"/>'
    text = f"<mujoco><worldbody>{floor}{tool}</worldbody>{keys}</mujoco>"
    assert [each.value for each in hints(text, "overlap-at-start")] == ([told] if told else [])


@pytest.mark.parametrize(
    ("size", "told"), [("0.6 0.6 0.5", "0.3 0.3 0.25"), ("0.3 0.3 0.25", None)], ids=["full", "half"]
)
def test_a_crate_between_things_is_halved_where_raising_it_does_not_free_it(size, told):
    crate = f'<body pos="0 0 0.401"><freejoint/><geom name="crate" type="box" size="{size}" mass="9"/></body>'
    pallet = '<body pos="0 0 0.075"><freejoint/><geom type="box" size="0.4 0.4 0.075" mass="9"/></body>'
    roof = '<geom type="box" size="1 1 0.1" pos="0 0 1.5"/>'
    mast = '<body pos="-0.5 0 0.4"><freejoint/><geom type="capsule" size="0.05 0.3" mass="9"/></body>'
    text = f"<mujoco><worldbody>{FLOOR}{roof}{pallet}{crate}{mast}</worldbody></mujoco>"
    found = findings(text, "overlap-at-start")
    assert [each.value for each in found if each.attribute == "size"] == ([told] if told else [])


@pytest.mark.parametrize(("height", "told"), [(0.46, "0 0 0.4"), (0.4, None)], ids=["out of the row", "in it"])
def test_the_last_drawer_of_a_row_that_overlaps_is_put_in_the_row(height, told):
    slide = '<joint type="slide" axis="1 0 0" range="0 0.1"/><geom type="box" size="0.2 0.2 0.05"/>'
    places = ((1, 0.16), (2, 0.28), (3, height))
    drawers = "".join(f'<body name="drawer_{n}" pos="0 0 {z}">{slide}</body>' for n, z in places)
    case = f'<body name="case"><geom type="box" size="0.2 0.2 0.01" pos="0 0 0.5"/>{drawers}</body>'
    text = f"<mujoco><worldbody>{FLOOR}{case}</worldbody></mujoco>"
    found = hints(text, "overlap-of-relatives")
    assert [each.value for each in found if each.attribute == "pos"] == ([told] if told else [])
    assert bool(found) is bool(told)


@pytest.mark.parametrize(("depth", "level"), [(0.05, "hint"), (0.12, "cause")])
def test_what_is_pushed_out_gently_is_a_hint_and_what_is_thrown_a_cause(depth: float, level: str):
    trunk = f'<body pos="0 0 {0.5 - depth}"><freejoint/><geom type="box" size="0.5 0.5 0.5"/></body>'
    found = findings(f"<mujoco><worldbody>{FLOOR}{trunk}</worldbody></mujoco>", "overlap-at-start")
    assert [each.level for each in found] == [level]


@pytest.mark.parametrize(
    ("second", "fourth", "told"),
    [
        pytest.param(-0.0452, 0.0502, ["-0.0502 0 0.3"], id="in the third"),
        pytest.param(-0.0502, 0.0502, [], id="in its place"),
        pytest.param(-0.0452, 0.0452, [], id="two of them"),
        pytest.param(-0.0504, 0.0502, [], id="in none"),
    ],
)
def test_a_ball_of_an_even_row_that_is_in_the_next_one_is_put_into_the_row(
    second: float, fourth: float, told: list[str]
):
    balls = "".join(
        f'<body name="ball{i}" pos="{x} 0 0.3"><joint axis="0 1 0" pos="0 0 0.3"/><geom size="0.025"/></body>'
        for i, x in enumerate((-0.1004, second, 0, fourth, 0.1004))
    )
    found = hints(f"<mujoco><worldbody>{balls}</worldbody></mujoco>", "overlap-of-relatives")
    assert [each.value for each in found if each.attribute == "pos"] == told
