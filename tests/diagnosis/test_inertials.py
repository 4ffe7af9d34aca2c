"""Inertias and centres of mass against the geoms and the joints."""

from __future__ import annotations

import pytest
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.matter import matter
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.start import Start
from diagnosed import causes, findings, hints


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
    texts = [link(placeholder.format(1e-4), "<freejoint/>")]
    texts += [link(placeholder.format(inertia), slide) for inertia in (1e-4, 1e-6)]
    told = [[each.rule for each in hints(text)] for text in texts]
    assert told == [["inertia-unlike-geoms"], [], ["inertia-unlike-geoms"]]


@pytest.mark.parametrize(("damping", "told"), [(1, ["inertia-unlike-geoms"]), (20, [])])
def test_an_inertia_that_the_damping_hides_is_well(damping: float, told: list[str]):
    joint = f'<joint axis="0 1 0" damping="{damping}"/>'
    text = link('<inertial pos="0 0 0.2" mass="1" diaginertia="0.3 0.3 0.3"/>', joint)
    assert [each.rule for each in hints(text)] == told


@pytest.mark.parametrize(("inertia", "told"), [(1e-2, ["inertia-beyond-the-model"]), (1e-5, [])])
def test_a_frame_that_its_joint_does_not_feel_is_well(inertia: float, told: list[str]):
    frame = f'<body><inertial pos="0 0 0" mass="1e-7" diaginertia="{inertia} {inertia} {inertia}"/></body>'
    text = link("", f'<joint axis="0 1 0"/>{frame}')
    assert [each.rule for each in hints(text, "inertia-beyond-the-model")] == told


def test_a_mass_in_grams_is_mended_without_the_inertia_that_is_right():
    text = link('<inertial pos="0 0 0.2" mass="500" diaginertia="0.0072 0.0072 0.0001"/>')
    (found,) = causes(text, "denser-than-metal")
    assert 'mass="0.5" fullinertia="0.0072 0.0072 0.0001' in next(iter(found.edit)).value


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
    assert [each.elements for each in hints(text, "inertial-copied")] == [('body "link3"', 'body "link2"')] * told


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
    assert [each.elements for each in hints(text, "inertial-copied")] == [('body "thumb"', 'body "index"')] * told


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
    assert [each.rule for each in findings(text, "inertial-forgotten", "mass-unlike-links", "visual-mass")] == [told]


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
    text = f"<mujoco><worldbody>{door}</worldbody></mujoco>"
    assert [each.value for each in hints(text, "centre-at-the-joint")] == ([f"pos {told}"] if told else [])


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
    assert [each.rule for each in hints(text, "inertial-ignored")] == told


def test_a_mass_that_a_class_gives_a_geom_is_no_lost_inertial():
    inner = '<inertial pos="0 0 0.1" mass="0.5" diaginertia="0.002 0.002 0.0005"/><geom size="0.03"/>'
    geom = '<geom class="pad" type="box" size="0.03 0.006 0.012"/>'
    pad = f'<body name="pad" pos="0 0 0.2"><joint type="slide"/>{geom}</body>'
    chain = f'<body pos="0 0 0.2"><joint/>{inner}{pad}</body>'
    default = '<default><default class="pad"><geom {}/></default></default>'
    told = []
    for given in ('mass="0.06"', 'density="4000"'):
        text = f"<mujoco>{default.format(given)}<worldbody><body><joint/>{inner}{chain}</body></worldbody></mujoco>"
        found = hints(text, "inertial-forgotten")
        told.append([each.elements for each in found])
    assert told == [[], [('body "pad"',)]]


@pytest.mark.parametrize(
    ("pos", "told"),
    [("0 0 1.5", "pos 0 0 0.15"), ("0 0 150", "pos 0 0 0.15"), ("0 0 0.6", None), ("0 2 1.5", None)],
    ids=["a digit", "mm", "a little outside", "elsewhere"],
)
def test_a_centre_with_a_slip_of_the_point_is_told_of_drawn_geoms_too(pos: str, told: str | None):
    geom = '<geom type="capsule" fromto="0 0 0 0 0 0.3" size="0.04" mass="0"/>'
    arm = f'<joint axis="0 1 0"/><inertial pos="{pos}" mass="2" diaginertia="0.02 0.02 0.003"/>{geom}'
    text = f"<mujoco><worldbody><body>{arm}</body></worldbody></mujoco>"
    assert [each.value for each in hints(text, "centre-of-mass-outside")] == ([told] if told else [])


@pytest.mark.parametrize(
    ("pos", "value"), [("-20 0 150", "-0.02 0 0.15"), ("-20 0 900", "0 0 0.15"), ("2 0 0", "0 0 0.15")]
)
def test_a_centre_of_mass_in_mm_is_mended_by_its_unit(pos: str, value: str):
    inertial = f'<inertial pos="{pos}" mass="1" diaginertia="0.01 0.01 0.001"/>'
    geom = '<geom type="box" size="0.05 0.05 0.15" pos="0 0 0.15"/>'
    body = f'<body pos="0 0 1"><joint axis="0 1 0"/>{inertial}{geom}</body>'
    text = f"<mujoco><worldbody>{body}</worldbody></mujoco>"
    assert [each.value for each in hints(text, "centre-of-mass-outside")] == [f"pos {value}"]


@pytest.mark.parametrize(("arm", "level"), [(1, "cause"), (40, "hint")])
def test_a_skin_of_a_part_that_is_a_hundredth_of_its_arm_is_a_hint(arm: float, level: str):
    plate = '<geom type="box" size="0.02 0.02 0.02" contype="0" conaffinity="0"/>'
    plate += '<geom type="box" size="0.02 0.02 0.02" group="3"/>'
    body = f'<body name="plate" pos="0.3 0 0"><joint axis="0 1 0"/>{plate}</body>'
    text = f'<body name="arm" pos="0 0 1"><joint axis="0 1 0"/><geom size="0.1" mass="{arm}"/>{body}</body>'
    found = findings(f"<mujoco><worldbody>{text}</worldbody></mujoco>", "visual-mass")
    assert [(each.level, each.elements) for each in found] == [(level, ('body "plate"',))]
