"""Masses and densities: near misses."""

from __future__ import annotations

import pytest
from diagnosed import causes, diagnosed, hints, with_edits


@pytest.mark.parametrize("attributes", ['mass="0"', 'mass="0.1"', 'density="50"'])
def test_visual_geoms_with_a_written_mass_are_meant(attributes):
    body = f'<geom size="0.05" contype="0" conaffinity="0" group="2" {attributes}/><geom size="0.05" mass="0.2"/>'
    assert not causes(f'<mujoco><worldbody><body pos="0 0 1"><freejoint/>{body}</body></worldbody></mujoco>')


def test_an_arm_on_the_wall_is_not_a_robot_without_its_free_joint():
    arm = '<body pos="0.2 0 0"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/></body>'
    base = f'<body name="base" pos="0 0 1"><geom size="0.1"/>{arm}</body>'
    assert not causes(f'<mujoco><worldbody><geom type="plane" size="2 2 1"/>{base}</worldbody></mujoco>')


def test_a_density_of_a_default_class_is_mended_there():
    links = "".join(
        f'<body pos="{x} 0 1"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/></body>'
        for x in range(3)
    )
    text = '<mujoco><default><geom density="1e5"/></default><worldbody><geom type="plane" size="9 9 1"/>'
    found = causes(f"{text}{links}</worldbody></mujoco>")
    assert [(each.rule, each.attribute, each.value) for each in found] == [("denser-than-metal", "density", "1000")]
    assert len(found[0].edit) == 1


@pytest.mark.parametrize(("mass", "told"), [("120", "0.12"), ("1300", "1.3"), ("30", "0.3"), ("30000", "0.3")])
def test_a_thousand_is_taken_off_where_it_leaves_a_material(mass: str, told: str):
    text = (
        f'<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom type="box" size=".05 .05 .05" mass="{mass}"/></body>'
    )
    found = causes(f"{text}</worldbody></mujoco>", "denser-than-metal")
    assert [edit.value for each in found for edit in each.edit] == [told]


def test_links_in_grams_for_each_cubic_centimetre_are_told_beside_a_heavy_trunk():
    shins = "".join(
        f'<body pos="0 {y} 0"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/></body>'
        for y in (-0.1, 0, 0.1)
    )
    trunk = '<freejoint/><geom type="box" size="0.1 0.1 0.2" mass="8"/>'
    text = '<mujoco><default><geom density="0.9"/></default><worldbody><geom type="plane" size="5 5 1"/>'
    text += f'<body name="trunk" pos="0 0 1">{trunk}{shins}</body></worldbody></mujoco>'
    (found,) = hints(text, "lighter-than-air", "mass-unlike-links")
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
    assert [each.value for each in hints(text, "lighter-than-air")] == told


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
    assert [each.rule for each in hints(text, "mass-unlike-links")] == ["mass-unlike-links"] * told


def test_the_one_geom_of_a_body_that_is_denser_than_metal_is_made_lighter_by_itself():
    geoms = '<geom size="0.1" mass="1"/><geom name="battery" type="box" size="0.05 0.025 0.015" mass="250"/>'
    text = f'<mujoco><worldbody><body pos="0 0 1"><freejoint/>{geoms}</body></worldbody></mujoco>'
    (found,) = causes(text, "denser-than-metal")
    assert (found.elements[0], found.now, found.value) == ('geom "battery"', "250", "0.25")
    assert [(each.attribute, each.value) for each in found.edit] == [("mass", "0.25")]


@pytest.mark.parametrize(("place", "told"), [("0 0 0.005", True), ("0 0 0.4", False)])
def test_a_link_of_which_a_small_part_is_drawn_is_not_denser_than_metal(place: str, told: bool):
    inertial = f'<inertial pos="{place}" mass="1.2" diaginertia="0.006 0.006 0.001"/>'
    body = f'<body pos="0 0 1"><joint axis="0 1 0"/>{inertial}<geom size="0.01"/></body>'
    text = f"<mujoco><worldbody>{body}</worldbody></mujoco>"
    assert bool(causes(text, "denser-than-metal")) == told


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
    assert [each.now for each in hints(text, "heavy-by-default")] == told


@pytest.mark.parametrize(("side", "told"), [(0.02, ["inertial-forgotten"]), (0.012, [])])
def test_pads_of_some_grams_make_no_difference(side: float, told: list[str]):
    pad = f'<body pos="0 0 0.05"><geom type="box" size="{side} {side} {side}"/></body>'
    finger = '<joint axis="0 1 0"/><inertial pos="0 0 0" mass="0.02" diaginertia="1e-5 1e-5 1e-5"/>'
    hand = '<freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>'
    text = f'<mujoco><worldbody><body>{hand}<body pos="0 0 0.1">{finger}{pad}</body></body></worldbody></mujoco>'
    assert [each.rule for each in hints(text, "inertial-forgotten")] == told


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
    text = f"<mujoco><worldbody>{drone}</worldbody><actuator>{more}</actuator></mujoco>"
    assert [each.elements for each in hints(text, "gravcomp-on-some")] == [('body "load"',)] * told


@pytest.mark.parametrize(("left", "right", "value"), [(-0.2, -0.2, "0.4 0.2 0"), (0.2, 0.2, "0.4 -0.2 0")])
def test_a_left_and_a_right_geom_in_one_place_are_mirrored(left: float, right: float, value: str):
    forks = "".join(
        f'<geom name="fork_{side}" type="box" size="0.4 0.05 0.01" pos="0.4 {y} 0"/>'
        for side, y in (("l", left), ("r", right))
    )
    text = f"<mujoco><worldbody><body pos='0 0 1'><joint/>{forks}</body></worldbody></mujoco>"
    found = diagnosed(text, "geom-twice")
    assert [each.value for each in found.hints] == [value]
    assert not found.causes


@pytest.mark.parametrize(
    ("density", "told"),
    [("1.21", "1210"), ("0.9", "900"), ("2.7", "2700"), ("5", None), ("1210", None)],
    ids=["tpu", "pp", "aluminium", "ant", "kg/m3"],
)
def test_links_are_told_up_to_the_density_of_plastics_in_grams(density: str, told: str | None):
    links = "".join(
        f'<body pos="0 {y} 0"><joint/><geom class="soft" type="box" size="0.01 0.01 0.01"/></body>' for y in range(3)
    )
    default = f'<default><default class="soft"><geom density="{density}"/></default></default>'
    palm = f'<body name="palm"><joint type="slide"/><geom size="0.05" mass="0.3"/>{links}</body>'
    text = f"<mujoco>{default}<worldbody>{palm}</worldbody></mujoco>"
    assert [each.value for each in hints(text, "lighter-than-air")] == ([told] if told else [])


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
    text = f"<mujoco><worldbody><body><joint axis='0 1 0'/>{pole}</body></worldbody></mujoco>"
    found = hints(text, "lighter-than-air")
    assert [each.value for each in found] == ([told] if told else [])
    for each in found:
        assert 'size=".04" mass="0.3"' in with_edits(text, each).replace("  ", " ")


@pytest.mark.parametrize(("tip", "named"), [(1, []), (1e-6, ["lighter-than-air"])])
def test_a_link_weighs_what_is_fixed_to_it_too(tip: float, named: list[str]) -> None:
    text = f"""<mujoco><worldbody><body name="cart" pos="0 0 1"><joint type="slide" axis="1 0 0"/>
      <geom type="box" size="0.3 0.2 0.1" mass="1"/>
      <body name="pole"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0.2 0 0 1" size="0.05" mass="1e-6"/>
      <body name="tip" pos="0 0 1"><geom size="0.1" mass="{tip}"/></body></body></body></worldbody></mujoco>"""
    assert [each.rule for each in causes(text, "lighter-than-air")] == named


@pytest.mark.parametrize(
    ("density", "walls", "told"),
    [("0.65", 3, ["650"]), ("0.65", 1, []), ("7.85", 1, ["7850"]), ("5", 3, []), ("650", 3, [])],
)
def test_walls_with_the_density_of_their_class_in_grams_are_told_beside_a_knob_with_a_mass(
    density: str, walls: int, told: list[str]
):
    wall = "".join(f'<geom class="wood" type="box" size="0.2 0.01 0.2" pos="0 {y} 0"/>' for y in range(walls))
    drawer = f'<body name="drawer"><joint type="slide"/>{wall}<geom size="0.02" mass="0.1"/></body>'
    default = f'<default><default class="wood"><geom density="{density}"/></default></default>'
    text = f"<mujoco>{default}<worldbody>{drawer}</worldbody></mujoco>"
    assert [each.value for each in hints(text, "lighter-than-air")] == told


@pytest.mark.parametrize(
    ("names", "x", "told"),
    [
        (("wall_e", "wall_w"), -1, [('geom "wall_e"', "1 0 0.1")]),
        (("west", "east"), -1, [('geom "east"', "1 0 0.1")]),
        (("wall1", "wall2"), -1, [('geom "wall2"', "apart from each other")]),
        (("wall_e", "wall_w"), 1, []),
        (("", ""), -1, []),
    ],
)
def test_two_walls_of_the_world_in_one_place_are_told(names: tuple[str, str], x: int, told: list[tuple[str, str]]):
    walls = "".join(
        f'<geom {name} type="box" size="0.1 1 0.1" pos="{place} 0 0.1"/>'
        for name, place in zip([f'name="{name}"' * bool(name) for name in names], (x, -1), strict=True)
    )
    text = f'<mujoco><worldbody>{walls}<body pos="0 0 1"><freejoint/><geom size="0.1"/></body></worldbody></mujoco>'
    assert [(each.elements[0], each.value) for each in hints(text, "geom-twice")] == told
