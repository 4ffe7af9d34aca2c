"""Drones, beyond the laws: what is meant to fly so, and what is not."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from diagnosed import diagnosed, hints


def drone(
    number: int = 4,
    mass: float = 0.5,
    push: Callable[[int], float] = lambda _: 1.0,
    drag: Callable[[int], float] = lambda i: 0.02 * (-1) ** i,
    option: str = "",
    body: str = "",
    more: str = "",
    ctrl: str = "",
) -> str:
    turns = [math.pi / 4 + 2 * math.pi * i / number for i in range(number)]
    sites = "".join(
        f'<site name="s{i}" pos="{0.2 * math.cos(t):.6f} {0.2 * math.sin(t):.6f} 0"/>' for i, t in enumerate(turns)
    )
    motors = "".join(f'<motor site="s{i}" gear="0 0 {push(i)} 0 0 {drag(i)}" ctrlrange="0 5"/>' for i in range(number))
    key = f'<keyframe><key name="hover" qpos="0 0 1 1 0 0 0" ctrl="{ctrl}"/></keyframe>' if ctrl else ""
    return (
        f'<mujoco><option {option}/><worldbody><body name="drone" pos="0 0 1" {body}><freejoint/>'
        f'<geom type="box" size="0.1 0.1 0.02" mass="{mass}"/>{sites}{more}</body></worldbody>'
        f"<actuator>{motors}</actuator>{key}</mujoco>"
    )


def told(text: str) -> list[str]:
    found = diagnosed(text)
    assert not found.error
    return [each.attribute for each in (*found.causes, *found.hints) if each.rule == "rotors-unbalanced"]


CAMERA = '<geom type="box" size="0.02 0.02 0.02" pos="0.1 0 -0.02" mass="{mass}"/>'


@pytest.mark.parametrize(
    "text",
    [
        *(drone(number) for number in (3, 4, 5, 6, 8)),
        drone(drag=lambda _: 0.0),
        drone(body='euler="20 10 40"'),
        drone(body='euler="90 0 0"'),
        drone(mass=50, body='gravcomp="1"'),
        drone(mass=50, option='density="1000"'),
        drone(mass=50, option='gravity="0 0 0"'),
        drone(more=CAMERA.format(mass=0.03)),
        drone(ctrl="1.226 1.226 1.226 1.226"),
        drone(ctrl="0 0 0 0"),
        drone(number=2, mass=50),
    ],
)
def test_a_drone_that_hovers_is_left_alone(text):
    assert told(text) == []


@pytest.mark.parametrize(
    ("text", "attribute"),
    [
        (drone(mass=5), "ctrlrange"),
        (drone(drag=lambda i: 0.02 if i == 1 else 0.02 * (-1) ** i), "gear"),
        (drone(push=lambda i: -1.0 if i == 2 else 1.0), "site"),
        (drone(more=CAMERA.format(mass=0.3)), "site"),
        (drone(ctrl="1 1 1 1"), "ctrl"),
    ],
)
def test_a_drone_that_does_not_hover_is_told(text, attribute):
    assert told(text) == [attribute]


@pytest.mark.parametrize(
    ("hinge", "told"),
    [('axis="0 0 1"', True), ('axis="0 0 1" damping="0.001"', False), ('axis="1 0 0"', False), (None, False)],
    ids=["loose", "damped", "across", "none"],
)
def test_a_rotor_that_turns_loosely_keeps_its_drag_to_itself(hinge: str | None, told: bool) -> None:
    joint = f"<joint {hinge}/>" if hinge else ""
    rotor = (
        f'<body pos="0 0 0.05">{joint}<geom type="cylinder" size="0.05 0.002" mass="0.01"/><site name="top"/></body>'
    )
    text = f"""<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom type="box" size="0.1 0.1 0.02" mass="0.5"/>
      {rotor}</body></worldbody>
      <actuator><motor site="top" gear="0 0 1 0 0 0.02" ctrlrange="0 10"/></actuator></mujoco>"""
    assert [each.value for each in hints(text, "rotors-not-independent")] == ["0.0004"] * told


@pytest.mark.parametrize("pose", ["0.1 0.1", "0.14 0"], ids=["x", "plus"])
def test_rotors_that_all_turn_alike_are_mended_by_turning_every_other_one(pose: str) -> None:
    x, y = map(float, pose.split())
    places = [(x, y), (-y, x), (-x, -y), (y, -x)]
    sites = "".join(f'<site name="s{i}" pos="{a} {b} 0"/>' for i, (a, b) in enumerate(places))
    motors = "".join(f'<motor site="s{i}" gear="0 0 1 0 0 0.02" ctrlrange="0 5"/>' for i in range(4))
    body = f'<body pos="0 0 1"><freejoint/><geom type="box" size="0.1 0.1 0.02" mass="0.5"/>{sites}</body>'
    text = f"<mujoco><worldbody>{body}</worldbody><actuator>{motors}</actuator></mujoco>"
    (found,) = hints(text, "rotors-not-independent")  # which its edit mends, as hints() has it
    assert found.says == "All turn alike, so that yaw comes with lift."
