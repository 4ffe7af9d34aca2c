"""Mass and inertia against the geoms, keyframes and structure: near misses."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.edit import apply
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.matter import matter
from clinic.diagnosis.simulation import Simulation, Start


def causes(text: str) -> list[str]:
    return [each.rule for each in examine(NativeEngine(), {"model.xml": text}).causes]


def hints(text: str) -> list[str]:
    return [each.rule for each in examine(NativeEngine(), {"model.xml": text}).hints]


def link(inertial: str, joint: str = '<joint axis="0 1 0"/>') -> str:
    return (
        f'<mujoco><worldbody><body pos="0 0 1">{joint}{inertial}'
        '<geom type="capsule" fromto="0 0 0 0 0 0.4" size="0.02"/></body></worldbody></mujoco>'
    )


def test_a_body_that_its_geoms_make_has_their_inertia():
    simulation = Simulation(NativeEngine().compile(link(""), {}), Start())
    found = matter(simulation, 1)
    assert found is not None
    assert found.radius == pytest.approx(1, abs=0.05)
    assert found.outside == 0
    assert found.density == pytest.approx(1000, rel=0.1)


@pytest.mark.parametrize("inertia", ["0.0135 0.0135 0.0002", "0.03 0.03 0.0005", "0.005 0.005 0.0001"])
def test_an_inertia_of_a_hollow_or_a_heavy_ended_link_is_well(inertia):
    assert not causes(link(f'<inertial pos="0 0 0.2" mass="1" diaginertia="{inertia}"/>'))


def test_a_placeholder_that_no_joint_feels_is_told_of_a_point_alone():
    placeholder, slide = (
        '<inertial pos="0 0 0.2" mass="1" diaginertia="{0} {0} {0}"/>',
        '<joint type="slide" axis="0 1 0"/>',
    )
    assert hints(link(placeholder.format(1e-4), "<freejoint/>")) == ["inertia-unlike-geoms"]
    assert not hints(link(placeholder.format(1e-4), slide))
    assert hints(link(placeholder.format(1e-6), slide)) == ["inertia-unlike-geoms"]


@pytest.mark.parametrize(("damping", "told"), [(1, ["inertia-unlike-geoms"]), (20, [])])
def test_an_inertia_that_the_damping_hides_is_well(damping: float, told: list[str]):
    joint = f'<joint axis="0 1 0" damping="{damping}"/>'
    assert hints(link('<inertial pos="0 0 0.2" mass="1" diaginertia="0.3 0.3 0.3"/>', joint)) == told


@pytest.mark.parametrize(("inertia", "told"), [(1e-2, ["inertia-beyond-the-model"]), (1e-5, [])])
def test_a_frame_that_its_joint_does_not_feel_is_well(inertia: float, told: list[str]):
    frame = f'<body><inertial pos="0 0 0" mass="1e-7" diaginertia="{inertia} {inertia} {inertia}"/></body>'
    text = link("", f'<joint axis="0 1 0"/>{frame}')
    found = examine(NativeEngine(), {"model.xml": text}, select=["inertia-beyond-the-model"]).hints
    assert [each.rule for each in found] == told


@pytest.mark.parametrize("attributes", ['mass="0"', 'mass="0.1"', 'density="50"'])
def test_visual_geoms_with_a_written_mass_are_meant(attributes):
    body = f'<geom size="0.05" contype="0" conaffinity="0" group="2" {attributes}/><geom size="0.05" mass="0.2"/>'
    assert not causes(f'<mujoco><worldbody><body pos="0 0 1"><freejoint/>{body}</body></worldbody></mujoco>')


def test_an_arm_on_the_wall_is_not_a_robot_without_its_free_joint():
    arm = '<body pos="0.2 0 0"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/></body>'
    base = f'<body name="base" pos="0 0 1"><geom size="0.1"/>{arm}</body>'
    assert not causes(f'<mujoco><worldbody><geom type="plane" size="2 2 1"/>{base}</worldbody></mujoco>')


def test_a_keyframe_with_one_servo_that_opens_a_gripper_is_meant():
    joints = "".join(
        f'<body pos="{i} 0 1"><joint name="j{i}" axis="0 1 0" damping="1" armature="0.1"/><geom size="0.05"/></body>'
        for i in range(3)
    )
    servos = "".join(f'<position joint="j{i}" kp="20" kv="2"/>' for i in range(3))
    model = "<mujoco><worldbody>{}</worldbody><actuator>{}</actuator><keyframe>{}</keyframe></mujoco>"
    assert not causes(model.format(joints, servos, '<key qpos="1 1 0" ctrl="1 1 0.5"/>'))
    assert causes(model.format(joints, servos, '<key qpos="1 0 0.5" ctrl="0 0.5 1"/>')) == ["key-targets-elsewhere"]


def test_a_density_of_a_default_class_is_mended_there():
    links = "".join(
        f'<body pos="{x} 0 1"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/></body>'
        for x in range(3)
    )
    text = '<mujoco><default><geom density="1e5"/></default><worldbody><geom type="plane" size="9 9 1"/>'
    found = examine(NativeEngine(), {"model.xml": f"{text}{links}</worldbody></mujoco>"}).causes
    assert [(each.rule, each.attribute, each.value) for each in found] == [("denser-than-metal", "density", "1000")]
    assert len(found[0].edit) == 1


def test_a_mass_in_grams_is_mended_without_the_inertia_that_is_right():
    text = link('<inertial pos="0 0 0.2" mass="500" diaginertia="0.0072 0.0072 0.0001"/>')
    (found,) = examine(NativeEngine(), {"model.xml": text}, select=["denser-than-metal"]).causes
    assert 'mass="0.5" fullinertia="0.0072 0.0072 0.0001' in next(iter(found.edit)).value


@pytest.mark.parametrize(("mass", "told"), [("120", "0.12"), ("1300", "1.3"), ("30", "0.3"), ("30000", "0.3")])
def test_a_thousand_is_taken_off_where_it_leaves_a_material(mass: str, told: str):
    text = (
        f'<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom type="box" size=".05 .05 .05" mass="{mass}"/></body>'
    )
    found = examine(NativeEngine(), {"model.xml": f"{text}</worldbody></mujoco>"}, select=["denser-than-metal"]).causes
    assert [edit.value for each in found for edit in each.edit] == [told]


def test_links_in_grams_for_each_cubic_centimetre_are_told_beside_a_heavy_trunk():
    shins = "".join(
        f'<body pos="0 {y} 0"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/></body>'
        for y in (-0.1, 0, 0.1)
    )
    trunk = '<freejoint/><geom type="box" size="0.1 0.1 0.2" mass="8"/>'
    text = '<mujoco><default><geom density="0.9"/></default><worldbody><geom type="plane" size="5 5 1"/>'
    text += f'<body name="trunk" pos="0 0 1">{trunk}{shins}</body></worldbody></mujoco>'
    (found,) = examine(NativeEngine(), {"model.xml": text}, select=["lighter-than-air", "mass-unlike-links"]).hints
    assert (found.rule, found.attribute, found.value, len(found.edit)) == ("lighter-than-air", "density", "900", 1)


@pytest.mark.parametrize(
    ("ball", "option", "told"),
    [
        pytest.param('size="0.01" density="7.8"', "", ["7800"], id="steel"),
        pytest.param('size="0.01" density="25"', "", [], id="foam"),
        pytest.param('size="0.01" density="7.8" mass="0.03"', "", [], id="with-a-mass"),
        pytest.param('mass="1" size="0.7"', "", [], id="of-a-kilogram"),
        pytest.param('size="0.01" density="7.8"', '<option density="1000"/>', [], id="in-water"),
    ],
)
def test_a_free_body_in_grams_for_each_cubic_centimetre_is_told(ball: str, option: str, told: list[str]):
    body = f'<body pos="0 0 1"><freejoint/><geom {ball}/></body>'
    text = f'<mujoco>{option}<worldbody><geom type="plane" size="5 5 1"/>{body}</worldbody></mujoco>'
    found = examine(NativeEngine(), {"model.xml": text}, select=["lighter-than-air"]).hints
    assert [each.value for each in found] == told


@pytest.mark.parametrize(
    ("second", "third", "told"),
    [
        pytest.param("8.4 0.21", "8.4 0.21", True, id="copied"),
        pytest.param("8.4 0.21", "2.3 0.17", False, id="its-own"),
        pytest.param("8.4 0", "8.4 0", False, id="placeholders"),
        pytest.param("3.1 0.1", "3.1 0.1", False, id="others-that-are-alike-too"),
    ],
)
def test_a_link_with_mass_centre_and_inertia_of_the_one_it_hangs_on_is_told(second: str, third: str, told: bool):
    text, links = "", ["3.1 0.1", "3.1 0.1" if second == "3.1 0.1" else "5.2 0.3", second, third, "0.9 0.05"]
    for number, numbers in reversed(list(enumerate(links))):
        mass, z = numbers.split()
        inertial = f'<inertial pos="0 0 {z}" mass="{mass}" diaginertia="0.13 0.12 0.015"/>'
        geom = f'<geom type="capsule" fromto="0 0 0 0 0 0.4" size="0.0{number + 2}"/>'
        text = f'<body name="link{number}" pos="0 0 0.4">{inertial}<joint axis="0 1 0"/>{geom}{text}</body>'
    text = f"<mujoco><worldbody>{text}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["inertial-copied"]).hints
    assert [each.elements for each in found] == [('body "link3"', 'body "link2"')] * told


@pytest.mark.parametrize(
    ("geom", "told"),
    [
        pytest.param('<geom type="box" size="0.02 0.03 0.09"/>', True, id="another-part"),
        pytest.param('<geom type="box" size="0.0202 0.03 0.06"/>', False, id="the-same-part"),
        pytest.param("", False, id="nothing-to-compare"),
    ],
)
def test_an_inertial_is_copied_where_the_part_is_another(geom: str, told: bool):
    inertial = '<inertial pos="0 0 0" mass="0.03171" diaginertia="2.1e-5 1.7e-5 9e-6"/><joint axis="0 1 0"/>'
    index = f'<body name="index" pos="0 0 1">{inertial}<geom type="box" size="0.06 0.02 0.03"/></body>'
    text = f'<mujoco><worldbody>{index}<body name="thumb" pos="0 0.2 1">{inertial}{geom}</body></worldbody></mujoco>'
    found = examine(NativeEngine(), {"model.xml": text}, select=["inertial-copied"]).hints
    assert [each.elements for each in found] == [('body "thumb"', 'body "index"')] * told


@pytest.mark.parametrize(
    ("masses", "size", "told"),
    [
        pytest.param((1.2, 10, 0.7, 0.3), 0.03, True, id="too-heavy"),
        pytest.param((1.2, 1.3, 0.7, 0.3), 0.014, False, id="drawn-small"),
        pytest.param((2, 2, 2, 2), 0.014, True, id="placeholder"),
        pytest.param((10, 1.2, 0.7, 0.3), 0.03, False, id="first-link-with-the-drive"),
    ],
)
def test_a_dense_link_is_told_where_it_is_heavy_too(masses: tuple[float, ...], size: float, told: bool):
    text = ""
    for number, mass in reversed(list(enumerate(masses))):
        thick = size if number == 1 else 0.03
        geom = f'<geom type="capsule" fromto="0 0 0 0.3 0 0" size="{thick}" mass="{mass}"/>'
        text = f'<body pos="0.3 0 0"><joint axis="0 1 0"/>{geom}{text}</body>'
    text = f"<mujoco><worldbody>{text}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["mass-unlike-links"])
    assert [each.rule for each in found.hints] == ["mass-unlike-links"] * told


@pytest.mark.parametrize(
    ("geoms", "told"),
    [
        pytest.param('<geom size="0.1"/>', "inertial-forgotten", id="dense"),
        pytest.param(
            '<geom type="box" size="0.1 0.1 0.1"/><geom size="0.1" group="2" contype="0" conaffinity="0"/>',
            "visual-mass",
            id="seen",
        ),
    ],
)
def test_a_link_without_its_inertial_is_told_once(geoms: str, told: str):
    text, links = "", ["", "", geoms, "", ""]
    for geom in links:
        given = '<inertial pos="0.1 0 0" mass="0.1" diaginertia="1e-4 4e-4 4e-4"/>' * (not geom)
        given += geom or '<geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03"/>'
        text = f'<body pos="0.2 0 0"><joint axis="0 1 0"/>{given}{text}</body>'
    text = f"<mujoco><worldbody>{text}</worldbody></mujoco>"
    found = examine(
        NativeEngine(), {"model.xml": text}, select=["inertial-forgotten", "mass-unlike-links", "visual-mass"]
    )
    assert [each.rule for each in (*found.causes, *found.hints)] == [told]


def test_the_one_geom_of_a_body_that_is_denser_than_metal_is_made_lighter_by_itself():
    geoms = '<geom size="0.1" mass="1"/><geom name="battery" type="box" size="0.05 0.025 0.015" mass="250"/>'
    text = f'<mujoco><worldbody><body pos="0 0 1"><freejoint/>{geoms}</body></worldbody></mujoco>'
    (found,) = examine(NativeEngine(), {"model.xml": text}, select=["denser-than-metal"]).causes
    assert (found.elements[0], found.now, found.value) == ('geom "battery"', "250", "0.25")
    assert [(each.attribute, each.value) for each in found.edit] == [("mass", "0.25")]


@pytest.mark.parametrize(("place", "told"), [("0 0 0.005", True), ("0 0 0.4", False)])
def test_a_link_of_which_a_small_part_is_drawn_is_not_denser_than_metal(place: str, told: bool):
    inertial = f'<inertial pos="{place}" mass="1.2" diaginertia="0.006 0.006 0.001"/>'
    body = f'<body pos="0 0 1"><joint axis="0 1 0"/>{inertial}<geom size="0.01"/></body>'
    text = f"<mujoco><worldbody>{body}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["denser-than-metal"]).causes
    assert bool(found) == told


@pytest.mark.parametrize(
    ("ball", "motor", "told"),
    [
        pytest.param("", True, ["1000 (default)"], id="heavier than the robot"),
        pytest.param('mass="0.5"', True, [], id="with a mass"),
        pytest.param("", False, [], id="without a robot"),
    ],
)
def test_a_ball_of_water_is_told_where_it_is_heavier_than_the_robot(ball: str, motor: bool, told: list[str]):
    drone = (
        '<body pos="0 0 1"><freejoint/><geom type="box" size="0.1 0.1 0.02" mass="0.4"/><site name="thrust"/></body>'
    )
    thing = f'<body pos="0 0 2"><freejoint/><geom size="0.05" {ball}/></body>'
    drive = '<actuator><motor site="thrust" gear="0 0 1 0 0 0"/></actuator>' if motor else ""
    text = f"<mujoco><worldbody>{drone}{thing}</worldbody>{drive}</mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["heavy-by-default"]).hints
    assert [each.now for each in found] == told


@pytest.mark.parametrize(
    ("pos", "inertia", "shift", "told"),
    [
        ("0 0 1", "7.4 8.9 1.52", 0.455, "0.455 0 1"),
        ("0.45 0 1", "7.4 8.9 1.52", 0.455, None),
        ("0 0 1", "7.4 8.9 1.52", 0.1, None),
        ("0 0 1", "7.4 7.4 0.02", 0.455, None),
        ("0 0 1", "1.5 1.5 1.5", 0.455, None),
        ("-0.02 0 1", "7.4 8.9 1.52", 0.455, None),
    ],
    ids=["on the hinge", "in the middle", "geoms on both sides", "narrow", "a placeholder", "beside the hinge"],
)
def test_an_inertia_that_has_no_room_about_a_centre_on_the_hinge_is_told(pos, inertia, shift, told):
    leaf = f'<geom type="box" size="0.445 0.02 1" pos="{shift} 0 1"/>'
    own = f'<inertial pos="{pos}" mass="22" diaginertia="{inertia}"/>'
    door = f'<body name="door" pos="0 0 0.02">{own}<joint axis="0 0 1"/>{leaf}</body>'
    text = {"model.xml": f"<mujoco><worldbody>{door}</worldbody></mujoco>"}
    found = examine(NativeEngine(), text, select=["centre-at-the-joint"]).hints
    assert [each.value for each in found] == ([f"pos {told}"] if told else [])
    for each in found:
        assert not examine(NativeEngine(), apply(text, each.edit), select=["centre-at-the-joint"]).hints


@pytest.mark.parametrize(("side", "told"), [(0.02, ["inertial-forgotten"]), (0.012, [])])
def test_pads_of_some_grams_make_no_difference(side: float, told: list[str]):
    pad = f'<body pos="0 0 0.05"><geom type="box" size="{side} {side} {side}"/></body>'
    finger = '<joint axis="0 1 0"/><inertial pos="0 0 0" mass="0.02" diaginertia="1e-5 1e-5 1e-5"/>'
    hand = '<freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>'
    text = f'<mujoco><worldbody><body>{hand}<body pos="0 0 0.1">{finger}{pad}</body></body></worldbody></mujoco>'
    found = examine(NativeEngine(), {"model.xml": text}, select=["inertial-forgotten"]).hints
    assert [each.rule for each in found] == told


@pytest.mark.parametrize(
    ("geoms", "told"),
    [
        pytest.param("0.5 0.3 0.4", ["inertial-ignored"], id="more than the inertial"),
        pytest.param("0.5 0.6", [], id="the same"),
        pytest.param("1.1 1.1", [], id="drawn and colliding"),
        pytest.param("0.3 0.2", [], id="less"),
        pytest.param("1.5", [], id="one"),
    ],
)
def test_masses_of_geoms_that_an_inertial_leaves_out_are_told(geoms: str, told: list[str]):
    own = "1.1" if "1.1" in geoms or "0.6" in geoms else "0.9"
    shapes = "".join(f'<geom size="0.05" mass="{mass}"/>' for mass in geoms.split())
    hub = f'<inertial pos="0 0 0" mass="{own}" diaginertia="0.004 0.004 0.006"/>{shapes}'
    text = f'<mujoco><worldbody><body name="hub" pos="0 0 1"><freejoint/>{hub}</body></worldbody></mujoco>'
    found = examine(NativeEngine(), {"model.xml": text}, select=["inertial-ignored"]).hints
    assert [each.rule for each in found] == told


@pytest.mark.parametrize(
    ("load", "more", "told"),
    [
        pytest.param('gravcomp="1"', "", True, id="what hangs"),
        pytest.param('gravcomp="0.3"', "", False, id="a part of it"),
        pytest.param('gravcomp="1"', '<motor joint="swing"/>', False, id="held by a motor"),
    ],
)
def test_a_load_that_hangs_without_a_weight_is_told(load: str, more: str, told: bool):
    swing = '<joint name="swing" axis="0 1 0"/><geom size=".05" pos="0 0 -.1"/>'
    hung = f'<body name="load" pos="0 0 -.3" {load}>{swing}</body>'
    drone = f'<body name="drone" pos="0 0 2"><freejoint/><geom size=".1"/>{hung}</body>'
    text = {"m.xml": f"<mujoco><worldbody>{drone}</worldbody><actuator>{more}</actuator></mujoco>"}
    found = examine(NativeEngine(), text, select=["gravcomp-on-some"]).hints
    assert [each.elements for each in found] == [('body "load"',)] * told


@pytest.mark.parametrize(("left", "right", "value"), [(-0.2, -0.2, "0.4 0.2 0"), (0.2, 0.2, "0.4 -0.2 0")])
def test_a_left_and_a_right_geom_in_one_place_are_mirrored(left: float, right: float, value: str):
    forks = "".join(
        f'<geom name="fork_{side}" type="box" size="0.4 0.05 0.01" pos="0.4 {y} 0"/>'
        for side, y in (("l", left), ("r", right))
    )
    text = {"m.xml": f"<mujoco><worldbody><body pos='0 0 1'><joint/>{forks}</body></worldbody></mujoco>"}
    found = examine(NativeEngine(), text, select=["geom-twice"])
    assert [each.value for each in found.hints] == [value]
    assert not found.causes


def test_a_mass_that_a_class_gives_a_geom_is_no_lost_inertial():
    inner = '<inertial pos="0 0 0.1" mass="0.5" diaginertia="0.002 0.002 0.0005"/><geom size="0.03"/>'
    geom = '<geom class="pad" type="box" size="0.03 0.006 0.012"/>'
    pad = f'<body name="pad" pos="0 0 0.2"><joint type="slide"/>{geom}</body>'
    chain = f'<body pos="0 0 0.2"><joint/>{inner}{pad}</body>'
    default = '<default><default class="pad"><geom {}/></default></default>'
    told = []
    for given in ('mass="0.06"', 'density="4000"'):
        text = f"<mujoco>{default.format(given)}<worldbody><body><joint/>{inner}{chain}</body></worldbody></mujoco>"
        found = examine(NativeEngine(), {"m.xml": text}, select=["inertial-forgotten"]).hints
        told.append([each.elements for each in found])
    assert told == [[], [('body "pad"',)]]


@pytest.mark.parametrize(
    ("density", "told"),
    [("1.21", "1210"), ("0.9", "900"), ("5", None), ("1210", None)],
    ids=["tpu", "pp", "ant", "kg/m3"],
)
def test_links_are_told_up_to_the_density_of_plastics_in_grams(density: str, told: str | None):
    links = "".join(
        f'<body pos="0 {y} 0"><joint/><geom class="soft" type="box" size="0.01 0.01 0.01"/></body>' for y in range(3)
    )
    default = f'<default><default class="soft"><geom density="{density}"/></default></default>'
    palm = f'<body name="palm"><joint type="slide"/><geom size="0.05" mass="0.3"/>{links}</body>'
    text = f"<mujoco>{default}<worldbody>{palm}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"m.xml": text}, select=["lighter-than-air"]).hints
    assert [each.value for each in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("tip", "rod", "told"),
    [
        pytest.param('density="0.3"', 'mass="0.2"', "mass 0.3", id="beside a mass"),
        pytest.param('density="0.3"', 'density="900"', None, id="beside a density"),
        pytest.param('density="300"', 'mass="0.2"', None, id="a density"),
        pytest.param('density="0"', 'mass="0.2"', None, id="nothing"),
    ],
)
def test_a_density_that_is_meant_as_a_mass_is_told(tip: str, rod: str, told: str | None):
    rod = f'<geom type="capsule" fromto="0 0 0 0 0 .8" size=".015" {rod}/>'
    pole = f'{rod}<geom name="tip" pos="0 0 .8" size=".04" {tip}/>'
    text = {"m.xml": f"<mujoco><worldbody><body><joint axis='0 1 0'/>{pole}</body></worldbody></mujoco>"}
    found = examine(NativeEngine(), text, select=["lighter-than-air"]).hints
    assert [each.value for each in found] == ([told] if told else [])
    for each in found:
        assert 'size=".04" mass="0.3"' in apply(text, each.edit)["m.xml"].replace("  ", " ")


@pytest.mark.parametrize(
    ("pos", "told"),
    [("0 0 1.5", "pos 0 0 0.15"), ("0 0 150", "pos 0 0 0.15"), ("0 0 0.6", None), ("0 2 1.5", None)],
    ids=["a digit", "mm", "a little outside", "elsewhere"],
)
def test_a_centre_with_a_slip_of_the_point_is_told_of_drawn_geoms_too(pos: str, told: str | None):
    geom = '<geom type="capsule" fromto="0 0 0 0 0 0.3" size="0.04" mass="0"/>'
    arm = f'<joint axis="0 1 0"/><inertial pos="{pos}" mass="2" diaginertia="0.02 0.02 0.003"/>{geom}'
    text = f"<mujoco><worldbody><body>{arm}</body></worldbody></mujoco>"
    found = examine(NativeEngine(), {"m.xml": text}, select=["centre-of-mass-outside"]).hints
    assert [each.value for each in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("pos", "value"), [("-20 0 150", "-0.02 0 0.15"), ("-20 0 900", "0 0 0.15"), ("2 0 0", "0 0 0.15")]
)
def test_a_centre_of_mass_in_mm_is_mended_by_its_unit(pos: str, value: str):
    inertial = f'<inertial pos="{pos}" mass="1" diaginertia="0.01 0.01 0.001"/>'
    geom = '<geom type="box" size="0.05 0.05 0.15" pos="0 0 0.15"/>'
    body = f'<body pos="0 0 1"><joint axis="0 1 0"/>{inertial}{geom}</body>'
    text = f"<mujoco><worldbody>{body}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["centre-of-mass-outside"]).hints
    assert [each.value for each in found] == [f"pos {value}"]


@pytest.mark.parametrize(("tip", "named"), [(1, []), (1e-6, ["lighter-than-air"])])
def test_a_link_weighs_what_is_fixed_to_it_too(tip: float, named: list[str]) -> None:
    text = f"""<mujoco><worldbody><body name="cart" pos="0 0 1"><joint type="slide" axis="1 0 0"/>
      <geom type="box" size="0.3 0.2 0.1" mass="1"/>
      <body name="pole"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0.2 0 0 1" size="0.05" mass="1e-6"/>
      <body name="tip" pos="0 0 1"><geom size="0.1" mass="{tip}"/></body></body></body></worldbody></mujoco>"""
    found = examine(NativeEngine(), {"model.xml": text}, select=["lighter-than-air"])
    assert [each.rule for each in found.causes] == named
