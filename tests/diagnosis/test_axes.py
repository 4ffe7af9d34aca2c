"""Hinges and slides about or along another axis than is meant."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import hints, with_edits


@pytest.mark.parametrize(
    ("shin", "told"),
    [
        pytest.param("0 0 -0.4", True, id="across"),
        pytest.param("0 0.4 -0.1", False, id="a thigh that stands off, as a spider's"),
    ],
)
def test_a_knee_that_swings_its_shin_sideways_is_told(shin: str, told: bool) -> None:
    text = rules()["knee-turns-sideways"].example("Bad").replace('pos="0 0 -0.4"', f'pos="{shin}"')
    knees = [(each.elements, each.value) for each in hints(text) if each.rule == "knee-turns-sideways"]
    assert knees == [(('joint "left_knee"', 'joint "right_knee"'), "1 0 0")] * told


@pytest.mark.parametrize(
    ("joint", "actuator", "told"),
    [
        pytest.param('name="slider" range="-1 1"', "pull", True, id="joint"),
        pytest.param('name="cart" range="-1 1"', "slide", True, id="actuator"),
        pytest.param('name="slider" type="slide" range="-1 1"', "slide", False, id="slide"),
        pytest.param('name="slider_crank" type="hinge"', "crank", False, id="hinge"),
        pytest.param('name="cart"', "pull", False, id="other-names"),
    ],
)
def test_a_hinge_that_is_called_a_slide_is_told(joint: str, actuator: str, told: bool) -> None:
    cart = f'<body name="cart"><joint {joint} axis="1 0 0"/><geom size="0.1"/></body>'
    motor = f'<motor name="{actuator}" joint="{joint.split(chr(34))[1]}"/>'
    text = f"<mujoco><worldbody>{cart}</worldbody><actuator>{motor}</actuator></mujoco>"
    assert [(each.attribute, each.value) for each in hints(text, "hinge-for-slide")] == [("type", "slide")] * told


@pytest.mark.parametrize(
    ("axis", "links", "attribute"),
    [
        pytest.param("", 4, "type", id="left-out"),
        pytest.param('axis="0 0 1"', 4, "axis", id="written"),
        pytest.param('axis="0 1 0"', 4, None, id="across"),
        pytest.param("", 2, None, id="two"),
    ],
)
def test_a_chain_whose_hinges_are_on_one_line_is_told(axis: str, links: int, attribute: str | None) -> None:
    text = ""
    for each in range(links):
        shape = '<geom type="capsule" fromto="0 0 0 0 0 -0.1" size="0.01"/>'
        text = f'<body name="b{each}" pos="0 0 -0.1"><joint name="j{each}" {axis}/>{shape}{text}</body>'
    text = f"<mujoco><worldbody>{text}</worldbody></mujoco>"
    found = hints(text, "joints-on-one-line")
    assert [each.attribute for each in found] == [attribute] * (attribute is not None)
    if attribute == "type":
        assert 'type="ball"' in with_edits(text, found[0])


@pytest.mark.parametrize(
    ("names", "axes", "told"),
    [
        (("roll", "pitch"), ("1 0 0", "1 0 0"), ('joint "pitch"', "0 1 0")),
        (("roll", "pitch"), ("0 1 0", "0 1 0"), ('joint "roll"', "1 0 0")),
        (("roll", "pitch"), ("1 0 0", "0 1 0"), None),
        (("waist_yaw", "head_pan"), ("0 0 1", "0 0 1"), None),
        (("base", "turret"), ("0 0 1", "0 0 1"), None),
    ],
    ids=["inner", "outer", "two axes", "one turn", "no turns"],
)
def test_two_rings_whose_names_say_two_turns_do_not_turn_about_one_line(names, axes, told):
    outer, inner = (
        f'<joint name="{name}" axis="{axis}"/><geom size="0.1"/>' for name, axis in zip(names, axes, strict=True)
    )
    text = f"<mujoco><worldbody><body pos='0 0 1'>{outer}<body>{inner}</body></body></worldbody></mujoco>"
    assert [(each.elements[0], each.value) for each in hints(text, "joints-on-one-line")] == ([told] if told else [])


@pytest.mark.parametrize(
    ("name", "base", "axis", "told"),
    [
        pytest.param("pole", 'type="slide" axis="1 0 0"', "1 0 0", "0 1 0", id="about its slide"),
        pytest.param("pole", 'type="slide" axis="1 0 0"', "0 0 1", "0 1 0", id="along the rod"),
        pytest.param("pole", 'type="slide" axis="1 0 0"', "0 1 0", None, id="across"),
        pytest.param("pendulum", 'axis="0 0 1"', "0 0 1", "1 0 0", id="on an arm"),
        pytest.param("pendulum", 'axis="0 0 1"', "1 0 0", None, id="about the arm"),
        pytest.param("mast", 'type="slide" axis="1 0 0"', "1 0 0", None, id="called otherwise"),
    ],
)
def test_a_pendulum_that_nothing_can_swing_is_told(name: str, base: str, axis: str, told: str | None) -> None:
    rod = f'<joint name="hinge" axis="{axis}"/><geom type="capsule" fromto="0 0 0 0 0 -.3" size=".01"/>'
    cart = (
        f'<joint {base}/><geom type="box" size=".1 .05 .02" pos=".1 0 0"/><body name="{name}" pos=".2 0 0">{rod}</body>'
    )
    text = f'<mujoco><worldbody><body pos="0 0 1">{cart}</body></worldbody></mujoco>'
    found = hints(text, "axis-unlike-name")
    assert [(each.elements[0], each.value) for each in found] == ([('joint "hinge"', told)] if told else [])


@pytest.mark.parametrize(
    ("name", "axis", "beyond", "told"),
    [
        pytest.param("elbow", "0 0 1", "0 0 .3", True, id="along the forearm"),
        pytest.param("thumb_ip", "0 0 1", "", True, id="along a last link"),
        pytest.param("elbow", "0 1 0", "0 0 .3", False, id="across"),
        pytest.param("elbow", "0 0 1", "0 .2 .2", False, id="at an angle"),
        pytest.param("elbow_roll", "0 0 1", "0 0 .3", False, id="a roll"),
        pytest.param("wrist", "0 0 1", "0 0 .3", False, id="a wrist"),
        pytest.param("ship", "0 0 1", "0 0 .3", False, id="no finger"),
    ],
)
def test_an_elbow_that_twists_is_told(name: str, axis: str, beyond: str, told: bool) -> None:
    hand = f'<body pos="{beyond}"><joint axis="0 1 0"/><geom size=".02" pos=".01 0 0"/></body>' if beyond else ""
    text = (
        f'<mujoco><worldbody><body pos="0 0 1"><joint name="{name}" axis="{axis}"/>'
        f'<geom type="capsule" fromto="0 0 0 0 0 .3" size=".02"/>{hand}</body></worldbody></mujoco>'
    )
    assert [each.elements for each in hints(text, "axis-unlike-name")] == [(f'joint "{name}"',)] * told


@pytest.mark.parametrize(
    ("axis", "beam", "told"),
    [
        pytest.param("0 1 0", "1.5 0.04 0.05", ["1 0 0"], id="across"),
        pytest.param("1 0 0", "1.5 0.04 0.05", [], id="along"),
        pytest.param("0 1 0", "0.9 0.04 0.05", [], id="too short for the range"),
        pytest.param("0 1 0", "1.5 1.6 0.05", [], id="a table"),
    ],
)
def test_a_trolley_across_its_beam_is_told(axis: str, beam: str, told: list[str]):
    slide = f'<joint type="slide" axis="{axis}" range="-1.3 1.3"/><geom type="box" size="0.12 0.1 0.04"/>'
    text = f'<geom type="box" size="{beam}" pos="0 0 2"/><body pos="0 0 1.9">{slide}</body>'
    found = hints(f"<mujoco><worldbody>{text}</worldbody></mujoco>", "slide-across-its-guide")
    assert [each.value for each in found] == told


@pytest.mark.parametrize(
    ("name", "axis", "told"),
    [("drawer", "0 1 0", ["1 0 0"]), ("drawer", "1 0 0", []), ("block", "0 1 0", []), ("drawer", "0 0 1", ["1 0 0"])],
)
def test_a_drawer_through_the_wall_of_its_cabinet_is_told(name: str, axis: str, told: list[str]):
    walls = ('0.2 0.01 0.2" pos="0 0.2 0', '0.2 0.01 0.2" pos="0 -0.2 0', '0.01 0.2 0.2" pos="-0.2 0 0')
    cabinet = "".join(f'<geom type="box" size="{wall}"/>' for wall in (*walls, '0.2 0.2 0.01" pos="0 0 0.2'))
    slide = f'<joint type="slide" axis="{axis}" range="0 0.3"/><geom type="box" size="0.17 0.17 0.08"/>'
    text = f'<body>{cabinet}<body name="{name}">{slide}</body></body>'
    found = hints(f"<mujoco><worldbody>{text}</worldbody></mujoco>", "slide-across-its-guide")
    assert [each.value for each in found] == told


@pytest.mark.parametrize("wheel", ["", '<body pos=".3 0 0"><joint axis="0 0 1"/><geom size=".05"/></body>'])
def test_a_knee_whose_shin_is_fixed_to_its_rotor_bends(wheel: str) -> None:
    shin = f'<body pos="0 0 .02"><geom type="capsule" fromto="0 0 0 .3 0 0" size=".02"/>{wheel}</body>'
    rotor = '<joint name="knee" axis="0 0 1"/><geom type="cylinder" fromto="0 0 0 0 0 .02" size=".04"/>'
    text = f'<mujoco><worldbody><body pos="0 0 1">{rotor}{shin}</body></worldbody></mujoco>'
    assert not hints(text, "axis-unlike-name")
