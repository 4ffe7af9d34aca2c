"""Contacts: what touches nothing or too much, and what looks so and is well."""

from __future__ import annotations

import pytest
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules
from diagnosed import causes, diagnosed, hints
from scenery import ARM, BOX, FLOOR


def named(inside: str, more: str = "") -> set[str]:
    own = [name for name, rule in rules().items() if rule.suspects.__module__.split(".")[3] in OWN]
    return {each.rule for each in causes(f"<mujoco>{more}<worldbody>{inside}</worldbody></mujoco>", *own)}


OWN = ("contact", "sensor", "world")
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


SLAB = '<geom type="box" size="5 0.01 5"/>'
CRANK = (
    '<body pos="0 1 0"><joint axis="{}" damping="0.1"/><geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02"/></body>'
)


@pytest.mark.parametrize(
    ("scene", "told"),
    [(SLAB + CRANK.format("1 0 0"), False), (CRANK.format("0 0 1"), False), (CRANK.format("1 0 0"), True)],
    ids=["a slab across it", "all hinges about z", "neither"],
)
def test_gravity_along_y_is_right_in_a_scene_that_is_drawn_so(scene, told):
    text = f'<mujoco><option gravity="0 -9.81 0"/><worldbody>{scene}</worldbody></mujoco>'
    assert [each.attribute for each in causes(text, "gravity")] == ["gravity"] * told


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
