"""Step 6: what the motion depends on, and what touches nothing."""

from __future__ import annotations

from clinic.triage.findings import Finding
from clinic.triage.switch_off import look
from helpers import RESTING
from subjects import subject

SWING = """<mujoco><worldbody><geom name="pole" type="box" size=".01 .01 .5" pos="2 0 0"/>
  <body name="arm"><joint name="j" axis="{0}"/><geom name="ball" size=".05" pos=".3 0 0"/></body></worldbody>
  </mujoco>"""


def test_a_motion_hangs_on_gravity() -> None:
    said, found = look(subject(SWING.format("0 1 0")))
    assert said == "the motion hangs on gravity; nothing touches geom pole, geom ball"
    assert found == []


def test_gravity_that_changes_nothing_is_said_and_found_where_nothing_moves() -> None:
    said, found = look(subject(SWING.format("0 0 1")))
    assert "gravity: switched off, nothing changes" in said
    assert [(finding.rule, finding.element) for finding in found] == [("idle", "gravity")]
    said, found = look(subject(SWING.format("0 0 1"), qvel={"j": 1.0}))
    assert "gravity: switched off, nothing changes" in said
    assert found == []


def test_the_part_that_a_warning_needs_is_found() -> None:
    stiff = SWING.format("0 1 0").replace("<worldbody>", '<option timestep="0.01"/><worldbody>')
    stiff = stiff.replace('name="j"', 'name="j" stiffness="1e5"')
    _, found = look(subject(stiff, qvel={"j": 1.0}))
    assert found == [Finding("needed", "spring", "switched off, MuJoCo no longer warns of BADQACC")]


def test_contacts_hold_what_rests() -> None:
    said, found = look(subject(RESTING))
    assert said.startswith("the motion hangs on contact; nothing touches geom other")
    assert found == []


def test_a_model_without_joints() -> None:
    assert look(subject("<mujoco/>")) == ("nothing moves", [])
