"""Steps 1, 4 and 5: warnings, conservation, half the timestep."""

from __future__ import annotations

import pytest
from clinic.triage.findings import Finding
from clinic.triage.motion import chaos, conservation, halved, warnings
from helpers import BALL, PENDULUM, RESTING
from subjects import subject

STIFF = """<mujoco><option timestep="0.01"/><worldbody><body euler="0 10 0">
  <joint name="j" axis="0 1 0" stiffness="2000"/>
  <geom size=".05" pos=".3 0 0" mass=".1"/></body></worldbody></mujoco>"""
INSIDE = """<mujoco><worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 .02"><freejoint/><geom size=".1"
  solref="0.005 .2"/></body></worldbody></mujoco>"""


def rules(found: list[Finding]) -> set[str]:
    return {rule for rule, _, _ in found}


def test_an_explosion_is_warned_of_and_reset() -> None:
    said, found = warnings(subject(STIFF.replace('euler="0 10 0"', 'euler="0 170 0"'), qvel={"j": 1.0}))
    assert rules(found) == {"warned", "reset", "fast"}
    assert ("warned", "BADQACC") in {(rule, element) for rule, element, _ in found}
    assert next(text for rule, _, text in found if rule == "warned").startswith("Nan, Inf or huge value in QACC")
    assert said.startswith("warnings in 100 steps")


@pytest.mark.parametrize(
    ("joint", "qvel", "unit"),
    [
        ('<joint name="j" type="slide"/>', [2000], "m/s"),
        ('<joint name="j"/>', [2000], "rad/s"),
        ('<joint name="j" type="ball"/>', [2000, 0, 0], "rad/s"),
        ("<freejoint/>", [0, 0, 2000, 0, 0, 0], "m/s"),
        ("<freejoint/>", [0, 0, 0, 2000, 0, 0], "rad/s"),
    ],
)
def test_a_speed_has_the_unit_of_what_moves(joint: str, qvel: list[int], unit: str) -> None:
    key = f'<keyframe><key name="k" qvel="{" ".join(map(str, qvel))}"/></keyframe>'
    world = f'<worldbody><body>{joint}<geom size="0.1"/></body></worldbody>'
    examined = subject(f'<mujoco><option gravity="0 0 0"/>{world}{key}</mujoco>', keyframe="k")
    assert [text for rule, _, text in warnings(examined)[1] if rule == "fast"] == [f"reaches 2000\u00a0{unit}"]


def test_a_quiet_run_says_how_long_it_was() -> None:
    assert warnings(subject(BALL)) == ("no warning in 1000 steps, 1\u00a0s", [])


def test_an_explosion_conserves_nothing_and_half_the_timestep_changes_it() -> None:
    examined = subject(STIFF, qvel={"j": 1.0})
    assert "explodes" in rules(conservation(examined)[1])
    assert "a twentieth" in rules(halved(examined)[1])


def test_energy_from_a_start_inside_the_floor_is_seen() -> None:
    _, found = conservation(subject(INSIDE))
    assert rules(found) == {"gain"}


def test_sound_motions_conserve_and_do_not_depend_on_the_timestep() -> None:
    for xml in (BALL, RESTING, PENDULUM):
        examined = subject(xml)
        assert conservation(examined)[1] == []
        assert halved(examined)[1] == []


def test_a_servo_does_work_that_is_counted() -> None:
    xml = """<mujoco><worldbody><body><joint name="j"/><geom size=".05" pos=".3 0 0"/></body></worldbody>
      <actuator><position name="servo" joint="j" kp="50"/></actuator></mujoco>"""
    assert conservation(subject(xml, duration=5, ctrl={"servo": 1.0})) == (
        "no energy appears",
        [],
    )


def test_nothing_that_moves_is_no_reason_to_fail() -> None:
    examined = subject("<mujoco/>")
    assert conservation(examined) == ("nothing moves", [])
    assert halved(examined)[1] == []


def test_a_double_pendulum_on_its_head_is_chaotic_and_a_fall_is_not() -> None:
    xml = """<mujoco><worldbody><body euler="0 179 0"><joint axis="0 1 0"/><geom type="capsule" size=".02"
      fromto="0 0 0 0 0 -.1"/><body pos="0 0 -.1"><joint axis="0 1 0"/><geom type="capsule" size=".02"
      fromto="0 0 0 0 0 -.1"/></body></body></worldbody><option><flag contact="disable"/></option></mujoco>"""
    assert chaos(subject(xml, duration=8)) > 1e-3
    assert chaos(subject(BALL)) < 1e-6
