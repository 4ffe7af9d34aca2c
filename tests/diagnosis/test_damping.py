"""Joints that damping or dry friction holds against what drives them."""

from __future__ import annotations

import pytest
from diagnosed import hints


@pytest.mark.parametrize(
    ("joint", "told"),
    [
        pytest.param('frictionloss="40"', [("joint-frozen", "frictionloss")], id="friction"),
        pytest.param('stiffness="150" springref="0.25"', [("spring-against-servo", "stiffness")], id="spring"),
        pytest.param('frictionloss="1" stiffness="2" springref="0.25"', [], id="well"),
    ],
)
def test_what_a_motor_at_a_site_cannot_move_is_told(joint, told):
    text = f"""<mujoco><compiler angle="radian"/><worldbody><body>
      <joint name="hinge" axis="0 0 1" range="-1.7 0" damping="1.2" {joint}/>
      <geom type="box" size="0.45 0.02 1" pos="0.45 0 1" mass="9"/><site name="grip" pos="0.74 0 1"/></body></worldbody>
    <actuator><motor site="grip" gear="0 -1 0 0 0 0" ctrlrange="-40 40"/></actuator></mujoco>"""
    found = hints(text, "joint-frozen", "spring-against-servo")
    assert [(each.rule, each.attribute) for each in found] == told
    assert all(each.after is not None for each in found)


@pytest.mark.parametrize(
    ("joint", "told"),
    [
        pytest.param('damping="2"', [("joint-frozen", "damping")], id="damping"),
        pytest.param('damping="0.01" stiffness="8"', [("spring-against-servo", "stiffness")], id="spring"),
        pytest.param('damping="0.01" stiffness="0.05"', [], id="well"),
    ],
)
def test_what_a_cable_cannot_bend_is_told(joint: str, told: list[tuple[str, str]]) -> None:
    """The cable lies along the finger's axis at the start, and has a lever of 10 mm where that is bent."""
    text = f"""<mujoco><worldbody><site name="palm" pos="0.01 0 -0.01"/><body>
      <joint name="knuckle" axis="0 1 0" range="0 90" armature="0.0002" {joint}/>
      <geom type="capsule" fromto="0 0 0 0 0 0.04" size="0.008" mass="0.02"/><site name="tip" pos="0.01 0 0.01"/></body>
    </worldbody><tendon><spatial name="cable"><site site="palm"/><site site="tip"/></spatial></tendon>
    <actuator><motor tendon="cable" gear="-1" ctrlrange="0 25"/></actuator></mujoco>"""
    found = hints(text, "joint-frozen", "spring-against-servo")
    assert [(each.rule, each.attribute) for each in found] == told


@pytest.mark.parametrize(
    ("damping", "actuator", "told"),
    [
        pytest.param(0.5, 'motor ctrlrange="-0.6 0.6"', ["0.095"], id="crawls"),
        pytest.param(0.005, 'motor ctrlrange="-0.6 0.6"', [], id="turns"),
        pytest.param(0.5, 'position kp="0.6" kv="0.1" ctrlrange="-1 1"', [], id="servo"),
    ],
)
def test_a_wheel_whose_motor_needs_seconds_for_a_turn_is_told(damping: float, actuator: str, told: list[str]) -> None:
    kind, *rest = actuator.split(" ", 1)
    wheel = f'<joint name="wheel" axis="0 1 0" damping="{damping}" armature="0.001"/><geom size="0.06" mass="0.1"/>'
    text = f"<mujoco><worldbody><body>{wheel}</body></worldbody><actuator><{kind} joint='wheel' {rest[0]}/></actuator>"
    assert [each.value for each in hints(f"{text}</mujoco>", "joint-frozen")] == told


@pytest.mark.parametrize(
    ("damping", "limits", "told"),
    [
        pytest.param(0.2, "", ["0.00068"], id="creeps"),
        pytest.param(0.02, "", [], id="swings"),
        pytest.param(0.2, 'range="-90 90"', [], id="a-range"),
    ],
)
def test_a_pendulum_that_creeps_down_is_told(damping: float, limits: str, told: list[str]) -> None:
    rod = f'<joint axis="1 0 0" damping="{damping}" {limits}/><geom size="0.01" pos="0 0 -0.26" mass="0.06"/>'
    arm = f'<body pos="0 0 1"><joint name="arm" axis="0 0 1"/><geom size="0.05" mass="1"/><body>{rod}</body></body>'
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator><motor joint='arm'/></actuator></mujoco>"
    assert [each.value for each in hints(text, "joint-frozen")] == told


@pytest.mark.parametrize(
    ("damping", "limits", "told"),
    [
        pytest.param(500, 'range="-1 1"', ["10"], id="50 s"),
        pytest.param(100, 'range="-1 1"', [], id="10 s"),
        pytest.param(500, 'range="-0.1 0.1"', [], id="a short way"),
        pytest.param(500, 'limited="false"', [], id="no range"),
        pytest.param(1, 'range="-inf inf"', [], id="a range without end"),
    ],
)
def test_a_slide_whose_motor_needs_most_of_a_minute_for_its_range_is_told(damping, limits, told):
    cart = f'<joint name="rail" type="slide" axis="1 0 0" damping="{damping}" {limits}/><geom size="0.1" mass="1"/>'
    motor = '<motor joint="rail" gear="20" ctrlrange="-1 1"/>'
    text = f"<mujoco><worldbody><body>{cart}</body></worldbody><actuator>{motor}</actuator></mujoco>"
    assert [each.value for each in hints(text, "joint-frozen")] == told
