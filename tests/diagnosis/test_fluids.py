"""Fluids, and free bodies in them and in the air."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import Diagnosis
from diagnosed import diagnosed, hints

FISH = """<mujoco>
  <option {option}/>
  <default>
    <joint stiffness="0.004" damping="0.0008"/>
    <geom type="ellipsoid" {geom} contype="0" conaffinity="0"/>
  </default>
  <worldbody>
    <geom name="pond" type="plane" size="3 3 0.1" pos="0 0 -0.6" fluidshape="none"/>
    <body name="fish">
      {joint}
      <geom name="trunk" size="0.08 0.03 0.04"/>
      <body name="tail" pos="-0.08 0 0">
        <joint name="tail" axis="0 0 1"/>
        <geom name="tail" size="0.04 0.005 0.03" pos="-0.04 0 0" fluidcoef="0.5 0.25 1.5 1 1"/>
      </body>
    </body>
  </worldbody>
</mujoco>"""
WATER = 'density="1000" viscosity="0.0009"'
SHAPED = 'density="1000" fluidshape="ellipsoid"'
STILL = 'gravity="0 0 0"'


def fish(option: str, geom: str = SHAPED, joint: str = "<freejoint/>") -> Diagnosis:
    return diagnosed(FISH.format(option=option, geom=geom, joint=joint))


@pytest.mark.parametrize(
    ("option", "geom", "told"),
    [
        pytest.param(f"{WATER} {STILL}", SHAPED, [], id="afloat"),
        pytest.param(WATER, SHAPED, [("fluid", "gravity", "0 0 0")], id="sinks"),
        pytest.param(WATER, 'density="3000" fluidshape="ellipsoid"', [], id="of-stone"),
        pytest.param(f'viscosity="0.0009" {STILL}', SHAPED, [("fluid", "density", "1000")], id="no-density"),
        pytest.param(f'density="1000" viscosity="0.9" {STILL}', SHAPED, [("fluid", "viscosity", "0.0009")], id="mPa-s"),
        pytest.param(
            f"{WATER} {STILL}",
            'density="1000"',
            [("attribute-without-effect", "fluidshape", "ellipsoid")],
            id="not-shaped",
        ),
    ],
)
def test_a_medium_that_a_swimmer_is_not_made_for_is_told(
    option: str, geom: str, told: list[tuple[str, str, str]]
) -> None:
    found = fish(option, geom)
    rules = ("fluid", "masks", "attribute-without-effect")
    assert [(each.rule, each.attribute, each.value) for each in found.hints if each.rule in rules] == told
    assert not found.causes
    assert not any(each.rule == "gravity" for each in found.hints if "fluidshape" in geom and "density" in option)


@pytest.mark.parametrize(
    ("joint", "told"),
    [
        pytest.param("<freejoint/>", False, id="freejoint"),
        pytest.param('<joint type="free"/>', True, id="default"),
        pytest.param('<joint type="free" stiffness="0.01"/>', False, id="own"),
    ],
)
def test_a_free_joint_on_a_spring_of_the_default_is_told_where_nothing_weighs(joint: str, told: bool) -> None:
    found = [each for each in fish(f"{WATER} {STILL}", joint=joint).hints if each.rule == "root-on-springs"]
    assert [(each.attribute, each.after) for each in found] == [("stiffness", 0.0)] * told


@pytest.mark.parametrize(("density", "told"), [("1", "1000"), ("1.1", "1100"), ("1000", None), ("30", None)])
def test_a_swimmer_with_a_density_in_g_per_cm3_is_told(density: str, told: str | None) -> None:
    found = fish(f"{WATER} {STILL}", f'density="{density}" fluidshape="ellipsoid"').hints
    assert [each.value for each in found if each.attribute == "density"] == ([told] if told else [])


@pytest.mark.parametrize(
    ("axis", "size", "more", "told"),
    [
        ("0 1 0", "0.04 0.005 0.03", "", ("axis", "0 0 1")),
        ("0 0 1", "0.04 0.005 0.03", "", None),
        ("1 0 0", "0.04 0.005 0.03", "", None),
        ("0 1 0", "0.04 0.02 0.03", "", None),
        ("0 1 0", "0.04 0.005 0.03", '<joint axis="0 0 1"/>', None),
        ("0 1 0", "0.04 0.005 0.03", '<geom size="0.01 0.01 0.02"/>', None),
    ],
    ids=["about its normal", "flaps", "rolls", "thick", "flaps too", "with a rod across"],
)
def test_a_fin_that_turns_in_its_own_plane_is_told(axis, size, more, told):
    text = FISH.format(option=f"{WATER} {STILL}", geom=SHAPED, joint="<freejoint/>")
    text = text.replace('"tail" axis="0 0 1"/>', f'"tail" axis="{axis}" range="-40 40"/>{more}')
    text = text.replace('"0.04 0.005 0.03"', f'"{size}"')
    found = hints(text, "fin-in-its-plane")
    assert [(each.attribute, each.value) for each in found] == ([told] if told else [])


def test_a_fin_on_what_turns_about_the_same_axis_gets_the_other_size():
    text = FISH.format(option=f"{WATER} {STILL}", geom=SHAPED, joint='<joint axis="0 0 1"/>')
    text = text.replace('"tail" axis="0 0 1"', '"tail" axis="0 0 1" range="-40 40"')
    fish_ = text.replace("0.04 0.005 0.03", "0.04 0.03 0.005")
    (found,) = hints(fish_, "fin-in-its-plane")
    assert (found.attribute, found.value) == ("size", "0.04 0.005 0.03")


@pytest.mark.parametrize(
    ("option", "told"),
    [
        pytest.param('density="1225" viscosity="0.000018"', "1.225", id="g/m3"),
        pytest.param('density="1.225" viscosity="0.000018"', None, id="kg/m3"),
        pytest.param('density="1225" viscosity="0.0012"', None, id="brine"),
    ],
)
def test_a_density_of_air_in_grams_is_told_by_the_viscosity_beside_it(option: str, told: str | None) -> None:
    drone = (
        '<body pos="0 0 1"><freejoint/><geom type="box" size="0.1 0.1 0.02" mass="2" fluidshape="ellipsoid"/></body>'
    )
    text = f"<mujoco><option {option}/><worldbody>{drone}</worldbody></mujoco>"
    assert [each.value for each in hints(text, "fluid") if each.attribute == "density"] == ([told] if told else [])


@pytest.mark.parametrize(("density", "told"), [("1", ["1000"]), ("1.025", ["1000"]), ("1000", []), ("2.5", [])])
def test_a_density_of_water_in_g_per_cm3_is_told_by_its_viscosity(density: str, told: list[str]) -> None:
    found = fish(f'density="{density}" viscosity="0.0009" {STILL}').hints
    assert [each.value for each in found if (each.rule, each.attribute) == ("fluid", "density")] == told


EEL = """<mujoco><option {option}/><worldbody>
  <geom type="plane" size="3 3 .1" pos="0 0 -.1"/>
  <body name="eel">
    {root}
    <geom type="capsule" size=".03" fromto="0 0 0 .3 0 0" contype="0" conaffinity="0"/>
    <body><joint name="bend" axis="0 0 1"/><geom type="capsule" size=".03" fromto="0 0 0 -.3 0 0" {geom}/></body>
  </body></worldbody><actuator><motor joint="bend"/>{motor}</actuator></mujoco>"""
PLANAR = '<joint name="x" type="slide" axis="1 0 0" {0}/><joint type="slide" axis="0 1 0"/><joint axis="0 0 1"/>'
GHOST = 'contype="0" conaffinity="0"'


@pytest.mark.parametrize(
    ("option", "root", "geom", "motor", "told"),
    [
        pytest.param("", PLANAR.format(""), GHOST, "", True, id="nothing"),
        pytest.param(STILL, "<freejoint/>", GHOST, "", True, id="free"),
        pytest.param("", "<freejoint/>", GHOST, "", False, id="falls"),
        pytest.param('viscosity="0.1"', PLANAR.format(""), GHOST, "", False, id="honey"),
        pytest.param("", PLANAR.format('damping="1"'), GHOST, "", False, id="damped"),
        pytest.param("", PLANAR.format(""), "", "", False, id="touches"),
        pytest.param("", PLANAR.format(""), GHOST, '<motor joint="x"/>', False, id="driven"),
        pytest.param('gravity="3 0 -9"', PLANAR.format(""), GHOST, "", False, id="slope"),
        pytest.param("", "", GHOST, "", False, id="fixed"),
    ],
)
def test_a_swimmer_that_nothing_pushes_is_told(option: str, root: str, geom: str, motor: str, told: bool) -> None:
    text = EEL.format(option=option, root=root, geom=geom, motor=motor)
    assert [each.value for each in hints(text, "fluid")] == ["1000"] * told


@pytest.mark.parametrize(
    ("tail", "option", "told"),
    [
        ("", WATER, [("gravcomp-on-some", ('body "tail"',))]),
        ('gravcomp="1"', WATER, []),
        ("", f"{WATER} {STILL}", []),
    ],
)
def test_the_one_segment_of_a_fish_that_sinks_is_told_alone(tail: str, option: str, told: list[object]) -> None:
    text = FISH.format(option=option, geom=SHAPED, joint="<freejoint/>")
    text = text.replace('name="fish"', 'name="fish" gravcomp="1"').replace(
        'body name="tail"', f'body name="tail" {tail}'
    )
    assert [(each.rule, each.elements) for each in hints(text, "fluid", "gravcomp-on-some")] == told


SWING = """<mujoco><option><flag gravity="disable"/></option><worldbody><body pos="0 0 1">
  <joint name="swing" axis="{axis}" {joint}/><geom size=".05" pos="0 0 -.5"/></body></worldbody>{more}</mujoco>"""


@pytest.mark.parametrize(
    ("axis", "joint", "more", "told"),
    [
        pytest.param("0 1 0", "", "", True, id="swings"),
        pytest.param("0 0 1", "", "", False, id="upright"),
        pytest.param("0 1 0", 'stiffness="5"', "", False, id="sprung"),
        pytest.param("0 1 0", 'damping="5"', "", False, id="creeps"),
        pytest.param("0 1 0", 'frictionloss="2"', "", False, id="stuck"),
        pytest.param("0 1 0", "", '<actuator><motor joint="swing"/></actuator>', False, id="driven"),
    ],
)
def test_a_pendulum_whose_gravity_is_switched_off_is_told(axis: str, joint: str, more: str, told: bool) -> None:
    text = SWING.format(axis=axis, joint=joint, more=more)
    assert [(each.now, each.value) for each in hints(text, "gravity")] == [("disable", "enable")] * told
