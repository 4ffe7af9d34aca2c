"""Contacts, what is around a model, sensors and cameras: things that look ill and are well, and the other way round."""

from __future__ import annotations

import pytest
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules
from diagnosed import causes, diagnosed, findings, hints

BOX = '<body name="box" pos="0 0 {z}"><freejoint/><geom name="box" type="box" size="0.05 0.05 0.05"{more}/></body>'
FLOOR = '<geom name="floor" type="plane" size="5 5 0.1"/>'


def named(inside: str, more: str = "") -> set[str]:
    own = [name for name, rule in rules().items() if rule.suspects.__module__.split(".")[3] in OWN]
    return {each.rule for each in causes(f"<mujoco>{more}<worldbody>{inside}</worldbody></mujoco>", *own)}


OWN = ("contact", "sensor", "world")
ARM = '<joint axis="0 1 0" damping="1"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/>'

WELL = {
    "a ghost of the target falls": FLOOR
    + '<body name="target" pos="0 0 1"><freejoint/><geom type="sphere" size="0.1" contype="0" conaffinity="0"/></body>',
    "a box falls beside a table": FLOOR
    + '<geom type="box" pos="1 0 0.3" size="0.2 0.2 0.01" contype="4" conaffinity="4"/>'
    + BOX.format(z=0.6, more=""),
    "a robot's visual geoms pass": FLOOR
    + '<body pos="0 0 0.3"><freejoint/><geom type="sphere" size="0.1"/>'
    + '<geom type="box" size="0.2 0.02 0.02" contype="0" conaffinity="0"/></body>',
    "a camera sees the near end of a long wall": FLOOR
    + '<geom type="box" pos="3 0 0.2" size="3 0.02 0.2"/><camera pos="0 -1 0.2" xyaxes="1 0 0 0 0 1" fovy="40"/>',
    "rubber on rubber": FLOOR + BOX.format(z=0.05, more=' friction="2"'),
    "a little margin": FLOOR + BOX.format(z=0.05, more=' margin="0.002"'),
    "pressed into the floor by 2 mm": FLOOR + BOX.format(z=0.048, more=""),
    "only the shell of a robot has condim 1": FLOOR
    + '<body pos="0 0 0.1"><freejoint/><geom type="sphere" size="0.1" condim="1"/>'
    + '<geom type="box" pos="0.3 0 -0.05" size="0.05 0.05 0.05" condim="3"/></body>',
    "a walker without its free joint": '<body name="torso"><geom size="0.1"/>'
    + "".join(f'<body pos="0.1 {y} 0">{ARM}</body>' for y in (-0.1, 0, 0.1))
    + "</body>",
    "a camera in a hand is upside down": f'<body pos="0 0 1">{ARM}<camera xyaxes="0 -1 0 0 0 -1"/></body>',
    "a camera far away with a long lens": FLOOR
    + '<camera pos="0 -10 0.3" xyaxes="1 0 0 0 0 1" fovy="4"/>'
    + BOX.format(z=0.05, more=""),
}
ILL = {
    "masks": FLOOR + BOX.format(z=0.5, more=' contype="0" conaffinity="0"'),
    "friction-too-high": FLOOR + BOX.format(z=0.05, more=' friction="50"'),
    "margin": FLOOR + BOX.format(z=0.3, more=' margin="0.1"'),
    "overlap-at-start": '<geom type="box" pos="0 0 0.1" size="0.3 0.3 0.1"/>' + BOX.format(z=0.2, more=""),
}


@pytest.mark.parametrize("inside", WELL.values(), ids=WELL)
def test_what_looks_ill_and_is_well_has_no_cause(inside):
    assert named(inside) == set()


@pytest.mark.parametrize("rule", ILL)
def test_the_fault_is_named_alone(rule):
    assert named(ILL[rule]) == {rule}


def test_all_geoms_of_a_default_class_are_mended_by_one_edit():
    text = (
        '<mujoco><default><geom solref="1 1"/></default><worldbody><geom type="plane" size="5 5 0.1"/>'
        '<body pos="0 0 0.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/></body>'
        '<body pos="1 0 0.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/></body></worldbody></mujoco>'
    )
    (found,) = hints(text, "soft-contact")
    assert [each.element for each in found.edit] == ["geom"]
    assert len(found.elements) == 3


def test_a_step_that_needs_more_memory_than_there_is_ends_in_a_warning():
    boxes = "".join(
        f'<body pos="{x} 0 0.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/></body>' for x in (0, 1)
    )
    text = f'<mujoco><size memory="6K"/><worldbody>{FLOOR}{boxes}</worldbody></mujoco>'
    compiled = NativeEngine().compile(text, {})
    compiled.step()
    assert compiled.warnings()["CNSTRFULL"] == 1
    compiled.reset()
    assert not compiled.warnings()


@pytest.mark.parametrize(("height", "told"), [(0.002, False), (-0.2, True)])
def test_a_picture_on_the_ground_is_no_surface(height: float, told: bool):
    soft = '<geom name="ground" type="box" size="1 1 0.1" pos="0 0 -0.1" solref="1 1"/>'
    picture = f'<geom name="logo" type="plane" size="1 1 1" pos="0 0 {height}" contype="0" conaffinity="0"/>'
    ball = '<body name="ball" pos="0 0 0.05"><freejoint/><geom size="0.02"/></body>'
    ground = soft if height > 0 else ""
    text = f"<mujoco><worldbody>{ground}{picture}{ball}</worldbody></mujoco>"
    assert bool(causes(text, "masks")) == told


def test_a_pair_touches_whatever_the_masks_are():
    ghost = BOX.format(z=0.5, more=' contype="0" conaffinity="0"')
    shin = '<body pos="0 0 -0.3"><geom name="foot" size="0.02" contype="0" conaffinity="0"/></body></body>'
    inside = FLOOR + ghost.removesuffix("</body>") + shin
    assert "masks" in named(inside)
    pair = '<contact><pair geom1="floor" geom2="foot"/></contact>'
    assert "masks" not in named(inside, more=pair)


@pytest.mark.parametrize(("gap", "told"), [(0.0, True), (0.004, False)])
def test_a_link_that_grazes_the_base_it_turns_on_jams(gap, told):
    turn = '<joint name="turn" axis="0.02 0 1" range="-90 90"/>'
    link = f'<body name="link" pos="0 0 {0.04 + gap}">{turn}<geom type="box" size="0.1 0.03 0.02"/></body>'
    base = f'<body name="base" pos="0 0 0.5"><geom type="box" size="0.1 0.1 0.02"/>{link}</body>'
    text = f"<mujoco><worldbody>{base}</worldbody></mujoco>"
    assert [each.elements[0] for each in hints(text, "jams-over-the-range")] == ['joint "turn"'] * told


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


def test_a_wheel_that_has_no_direction_is_not_told_to_vary_by_nan():
    text = rules()["wheel-not-round"].example("Bad").replace('mass="0.3"/>', 'mass="0.3" zaxis="0 1 nan"/>', 1)
    assert not findings(text, "wheel-not-round")


@pytest.mark.parametrize(("size", "told"), [("0.002", True), ("0.06 0.06 0.06", False)])
def test_several_touch_sensors_that_all_miss_are_told(size, told):
    sites = "".join(
        f'<site name="s{index}" type="box" pos="{place}" size="{size} 0.002 0.002"/>'
        if told
        else f'<site name="s{index}" type="box" pos="{place}" size="{size}"/>'
        for index, place in enumerate(("0.05 0 0", "-0.05 0 0", "0 0 0.05"))
    )
    sensors = "".join(f'<touch name="t{index}" site="s{index}"/>' for index in range(3))
    body = f'<body name="box" pos="0 0 0.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/>{sites}</body>'
    text = f"<mujoco><worldbody>{FLOOR}{body}</worldbody><sensor>{sensors}</sensor></mujoco>"
    assert [len(each.elements) for each in hints(text, "touch-site-too-small")] == [4] * told


@pytest.mark.parametrize(
    ("disc", "told"),
    [('rgba="0 1 0 0.5"', True), ('rgba="0 1 0 1"', False), ('rgba="0 1 0 0.5" contype="0" conaffinity="0"', False)],
    ids=["seen through", "a thing", "not touched"],
)
def test_a_target_that_stops_what_is_brought_to_it_is_told(disc, told):
    target = f'<geom name="target" type="cylinder" size="0.1 0.001" pos="0.3 0 0.001" {disc}/>'
    text = f"<mujoco><worldbody>{FLOOR}{target}{BOX.format(z=0.05, more='')}</worldbody></mujoco>"
    assert [each.elements for each in hints(text, "visual-collides")] == [('geom "target"',)] * told


@pytest.mark.parametrize(("cells", "told"), [(101, True), (11, False)])
def test_a_terrain_from_a_file_is_told_in_words_where_contacts_are_lost(cells, told):
    elevation = " ".join(["0"] * cells**2)
    asset = f'<hfield name="hills" nrow="{cells}" ncol="{cells}" size="0.5 0.5 0.1 1" elevation="{elevation}"/>'
    terrain = '<geom name="terrain" type="hfield" hfield="hills"/>'
    text = f"<mujoco><asset>{asset}</asset><worldbody>{terrain}{BOX.format(z=0.05, more='')}</worldbody></mujoco>"
    found = hints(text, "contacts-cut-off")
    assert [(each.elements[0], each.edit) for each in found] == [('hfield "hills"', ())] * told


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
    assert [each.rule for each in causes(text, "hull-over-hole", "overlap-at-start")] == rules


@pytest.mark.parametrize(("others", "told"), [(3, True), (1, False)])
def test_the_one_mocap_body_of_four_that_things_bump_into_is_told(others, told):
    mark = '<body name="m{0}" mocap="true" pos="{0} 0 1"><geom size="0.1" {1}/></body>'
    ghosts = "".join(mark.format(i, 'contype="0" conaffinity="0"') for i in range(1, 1 + others))
    text = f"<mujoco><worldbody>{FLOOR}{mark.format(0, '')}{ghosts}{BOX.format(z=0.05, more='')}</worldbody></mujoco>"
    assert [each.elements for each in hints(text, "visual-collides")] == [('geom of body "m0"',)] * told


@pytest.mark.parametrize(("name", "told"), [("obstacle", True), ("obstacle_visual", False)])
def test_an_obstacle_that_nothing_touches_is_told(name, told):
    wall = f'<geom name="{name}" type="box" pos="1 0 0.2" size="0.05 1 0.2" contype="0" conaffinity="0"/>'
    text = f"<mujoco><worldbody>{FLOOR}{wall}{BOX.format(z=0.05, more='')}</worldbody></mujoco>"
    assert [each.elements for each in hints(text, "touches-nothing")] == [('geom "obstacle"',)] * told


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


@pytest.mark.parametrize(
    ("wall", "walls"), [('class="wall"', 2), ('class="rim_visual"', 0), ('class="wall" contype="1"', 0)]
)
def test_walls_of_a_tray_that_nothing_touches_are_told(wall, walls):
    rims = "".join(f'<geom {wall} type="box" pos="{x} 0 0.012" size="0.004 0.15 0.012"/>' for x in (-0.146, 0.146))
    tray = f'<joint axis="1 0 0" range="-8 8"/><geom type="box" size="0.15 0.15 0.005" pos="0 0 -0.005"/>{rims}'
    ball = '<body pos="0 0 0.51"><freejoint/><geom size="0.01"/></body>'
    masks = '<geom contype="0" conaffinity="0"/>'
    classes = "".join(f'<default class="{name}">{masks}</default>' for name in ("wall", "rim_visual"))
    text = f'<mujoco><default>{classes}</default><worldbody>{FLOOR}<body pos="0 0 0.5">{tray}</body>{ball}</worldbody>'
    assert [len(each.elements) for each in hints(f"{text}</mujoco>", "touches-nothing")] == [walls] * bool(walls)


@pytest.mark.parametrize(
    ("finger", "cube", "told"),
    [
        pytest.param('contype="2" conaffinity="2"', "", [("conaffinity", "3")], id="no-bit"),
        pytest.param('contype="2" conaffinity="1"', "", [], id="a-bit"),
        pytest.param('contype="2" conaffinity="2"', 'contype="0" conaffinity="4"', [("contype", "6")], id="affinity"),
    ],
)
def test_fingers_that_touch_nothing_that_is_free_are_told(finger, cube, told):
    fingers = "".join(
        f'<body name="finger_{y}" pos="0.1 {y} 0"><joint type="slide" axis="0 1 0" range="-0.02 0.02"/>'
        f'<geom type="box" size="0.04 0.005 0.01" {finger}/></body>'
        for y in (-0.04, 0.04)
    )
    hand = f'<body pos="0 0 0.5"><joint axis="0 1 0"/><geom type="box" size="0.05 0.05 0.02" {finger}/>{fingers}</body>'
    box = f'<body pos="1 0 0.1"><freejoint/><geom size="0.1" {cube}/></body>'
    text = f"<mujoco><worldbody>{FLOOR}{hand}{box}</worldbody></mujoco>"
    found = hints(text, "touches-nothing")
    assert [(each.attribute, each.value) for each in found] == told
    assert all(each.after == 0 for each in found)


def test_a_ball_inside_a_solid_mesh_is_in_no_hole():
    corners = " ".join(f"{x} {y} {z}" for x in (-0.1, 0.1) for y in (-0.1, 0.1) for z in (0, 0.2))
    faces = "0 1 3 0 3 2 4 6 7 4 7 5 0 4 5 0 5 1 2 3 7 2 7 6 0 2 6 0 6 4 1 5 7 1 7 3"
    text = (
        f'<mujoco><asset><mesh name="block" vertex="{corners}" face="{faces}"/></asset><worldbody>'
        '<geom type="mesh" mesh="block"/><body pos="0 0 0.1"><freejoint/><geom size="0.05"/></body>'
        "</worldbody></mujoco>"
    )
    assert [each.rule for each in causes(text, "hull-over-hole", "overlap-at-start")] == ["overlap-at-start"]


def test_friction_is_given_to_geoms_and_pairs_in_their_own_form():
    named = (
        rules()["grasp-slips"]
        .example("Bad")
        .replace("<geom type", '<geom name="pad" type', 2)
        .replace('"pad"', '"floor"', 1)
    )
    pair = '<contact><pair geom1="cube" geom2="pad" friction="0.15 0.15 0.005 0.0001 0.0001"/></contact>'
    found = findings(named.replace("</worldbody>", f"</worldbody>{pair}"))
    (told,) = [each for each in found if each.rule == "grasp-slips"]
    assert {edit.value for edit in told.edit} == {"1 0.005 0.0001", "1 1 0.005 0.0001 0.0001"}


FOOT = '<body pos="0.1 0 -0.5"><joint axis="0 1 0" pos="0 0 .25"/><geom name="foot" size=".05"{0}/></body>'
WALKER = (
    '<mujoco><worldbody><geom name="floor" type="plane" size="2 2 .1"/><body name="trunk" pos="0 0 .6"><freejoint/>'
    f'<geom size=".1"{{1}}/><body><joint/><geom size=".05"{{1}}/></body>{FOOT}</body></worldbody>{{2}}</mujoco>'
)
NONE = ' contype="0" conaffinity="0"'


@pytest.mark.parametrize(
    ("model", "told"),
    [
        (WALKER.format("", NONE, ""), [("masks", 'body "trunk"')]),
        (WALKER.format("", "", ""), []),
        (WALKER.format(NONE, NONE, '<contact><pair geom1="foot" geom2="floor"/></contact>'), []),
    ],
    ids=["masks at the foot", "masks everywhere", "a pair"],
)
def test_a_robot_that_only_its_feet_hold_up_sinks_to_them(model, told):
    found = diagnosed(model, "masks")
    assert [(each.rule, each.elements[0]) for each in found.hints] == told
    assert not found.causes


def test_halves_that_a_weld_holds_in_each_other_want_an_exclude_and_stay_where_they_are():
    half = '<body name="{0}" pos="0 0 {1}"><freejoint/><geom type="capsule" size=".03 .02"/></body>'
    halves = f"<worldbody>{FLOOR}{half.format('low', 0.06)}{half.format('top', 0.1)}</worldbody>"
    weld = '<equality><weld body1="low" body2="top" solref="0.004 1"/></equality>'
    found = diagnosed(f"<mujoco>{halves}{weld}</mujoco>")
    assert not found.causes
    assert [(each.rule, each.elements) for each in found.hints] == [
        ("overlap-of-relatives", ('body "low"', 'body "top"'))
    ]


@pytest.mark.parametrize(
    ("gravity", "value"),
    [("0 0 9.81", "0 0 -9.81"), ("0 0 3.71", "0 0 -3.71"), ("0 -1.62 0", "0 0 -1.62"), ("0 0 50", "0 0 -9.81")],
)
def test_gravity_that_points_the_wrong_way_keeps_the_size_that_it_has_on_another_planet(gravity, value):
    box = '<body pos="0 0 1"><freejoint/><geom size="0.1"/></body>'
    plane = '<geom type="plane" size="1 1 1"/>'
    text = f'<mujoco><option gravity="{gravity}"/><worldbody>{plane}{box}</worldbody></mujoco>'
    (found, *_) = causes(text, "gravity")
    assert (found.attribute, found.value) == ("gravity", value)


@pytest.mark.parametrize(("ratio", "told"), [(5, False), (10, True)])
def test_impratio_hardens_the_contact_itself_under_pyramidal_cones(ratio, told):
    box = BOX.format(z=0.05, more=' mass="1"')

    def depth(option: str) -> float:
        text = f"<mujoco><option {option}/><worldbody>{FLOOR}{box}</worldbody></mujoco>"
        compiled = NativeEngine().compile(text, {})
        compiled.step(1000)
        found = hints(text, "impratio-without-elliptic")
        assert len(found) == ("elliptic" not in option and "impratio" in option and told)
        return 0.05 - compiled.data("qpos")[2]

    assert depth(f'impratio="{ratio}"') == pytest.approx(depth("") / ratio, rel=0.1)
    assert depth(f'impratio="{ratio}" cone="elliptic"') == pytest.approx(depth(""), rel=0.1)


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


@pytest.mark.parametrize(
    ("geom", "told"),
    [
        pytest.param('fromto="0 0 0.04 0 0 0.26" size="0.03"', True, id="forgotten"),
        pytest.param('fromto="0 0 0.04 0 0 0.26" size="0.03" density="30"', False, id="light"),
        pytest.param('fromto="0 0 -0.26 0 0 -0.04" size="0.028"', False, id="inside-of-the-link-above"),
    ],
)
def test_a_link_without_collision_is_told_where_something_could_meet_it(geom: str, told: bool):
    text = rules()["link-without-collision"].example("Bad")
    text = text.replace('fromto="0 0 0.04 0 0 0.26" size="0.03" contype="0"', f'{geom} contype="0"')
    assert [each.elements[0] for each in hints(text, "link-without-collision")] == ['body "fore"'] * told


@pytest.mark.parametrize(("symptom", "told"), [("", []), ("falls-through", ['body "trunk"', 'geom of body "trunk"'])])
def test_a_robot_of_which_the_feet_alone_collide_is_told_to_whom_it_falls_through(symptom: str, told: list[str]):
    foot = '<body pos="{x} 0 -0.2"><joint axis="0 1 0"/><geom size="0.03"/></body>'
    trunk = '<freejoint/><geom type="box" size="0.2 0.1 0.05" contype="0" conaffinity="0"/>'
    robot = f'<body name="trunk" pos="0 0 0.3">{trunk}{foot.format(x=0.1)}{foot.format(x=-0.1)}</body>'
    text = f"<mujoco><worldbody>{FLOOR}{robot}</worldbody></mujoco>"
    assert [name for each in hints(text, "link-without-collision", symptom=symptom) for name in each.elements] == told


@pytest.mark.parametrize(("other", "edits"), [(0.02, 3), (0.05, 1)])
def test_what_is_as_deep_in_other_keyframes_and_in_its_own_place_is_lifted_there_too(other, edits):
    box = BOX.format(z=other, more="")
    keys = "".join(f'<key qpos="{x} 0 {z} 1 0 0 0"/>' for x, z in ((0, 0.02), (1, other), (2, 0.05)))
    text = f"<mujoco><worldbody>{FLOOR}{box}</worldbody><keyframe>{keys}</keyframe></mujoco>"
    (found,) = causes(text, "overlap-at-start")
    assert len(found.edit) == edits


@pytest.mark.parametrize(("priority", "told"), [(1, [("condim", "1", "3")]), (0, [])])
def test_friction_that_condim_switches_off_is_told_by_the_condim(priority, told):
    more = f' friction="0.5" condim="1" priority="{priority}"'
    text = f"<mujoco><worldbody>{FLOOR}{BOX.format(z=0.05, more=more)}</worldbody></mujoco>"
    assert [(each.attribute, each.now, each.value) for each in hints(text, "attribute-without-effect")] == told


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


CLASSES = (
    '<mujoco><default><default class="panel"><geom contype="2" conaffinity="2"/></default>'
    '<default class="bolt"><geom contype="4" conaffinity="2"/></default></default><worldbody>{}</worldbody></mujoco>'
)


@pytest.mark.parametrize(
    ("geoms", "told"),
    [
        ('<geom name="bolt" class="panel" size="0.1"/>', ("panel", "bolt")),
        ('<geom name="bolt" size="0.1"/>', ("left out", "bolt")),
        ('<geom name="bolt" class="bolt" size="0.1"/>', None),
        ('<geom name="bolt" class="panel" size="0.1"/><geom class="bolt" size="0.1"/>', None),
        ('<geom name="lid" class="panel" size="0.1"/>', None),
        ('<geom size="0.1" class="panel"/><site name="bolt"/>', None),
    ],
    ids=["another class", "no class", "its class", "a class in use", "another name", "nothing for sites"],
)
def test_what_is_called_as_a_class_that_nothing_uses_is_told(geoms: str, told: tuple[str, str] | None) -> None:
    found = hints(CLASSES.format(geoms), "class-not-reached")
    assert [(each.now, each.value) for each in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("geom", "joint", "told"),
    [
        ('class="deco" friction="0.4"', "<freejoint/>", True),
        ('class="deco"', "<freejoint/>", False),
        ('contype="0" conaffinity="0" friction="0.4"', "<freejoint/>", False),
        ('class="deco" friction="0.4"', "<joint/>", False),
        ('friction="0.4"', "<freejoint/>", False),
    ],
    ids=["friction of its own", "no friction", "masks of its own", "not free", "collides"],
)
def test_friction_of_a_free_body_whose_class_touches_nothing_is_told(geom: str, joint: str, told: bool) -> None:
    deco = '<default><default class="deco"><geom contype="0" conaffinity="0"/></default></default>'
    body = f'<body pos="0 0 1">{joint}<geom {geom} size="0.1"/></body>'
    text = f"<mujoco>{deco}<worldbody>{FLOOR}{body}</worldbody></mujoco>"
    found = hints(text, "attribute-without-effect")
    assert [(each.attribute, each.value) for each in found] == [("contype", "1")] * told


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


@pytest.mark.parametrize(
    ("place", "size", "told"),
    [
        pytest.param("0 0 -0.2", 0.04, [("pos", "0 0 -0.32")], id="the site of a foot higher up the shin"),
        pytest.param("0 0 -0.32", 0.04, [], id="around the foot"),
        pytest.param("0 0 -0.32", 0.01, [("size", "0.0385 0.0385 0.0385")], id="in the foot, and small"),
        pytest.param("0 0 -0.2", 0.02, [("size", "0.17 0.17 0.17")], id="too small for the foot as well"),
    ],
)
def test_a_touch_site_that_would_hold_the_foot_elsewhere_gets_its_place(place, size, told):
    foot = '<geom size="0.035" pos="0 0 -0.32"/><geom size="0.15" contype="0" conaffinity="0"/>'
    shin = f'<joint type="slide" axis="0 0 1"/>{foot}<site name="s" pos="{place}" size="{size}"/>'
    body = f'<body pos="0 0 0.355">{shin}</body>'
    text = f'<mujoco><worldbody>{FLOOR}{body}</worldbody><sensor><touch site="s"/></sensor></mujoco>'
    assert [(each.attribute, each.value) for each in hints(text, "touch-site-too-small")] == told
