"""Step 3: what a picture with overlays would show."""

from __future__ import annotations

import pytest
from clinic.triage.scene_rules import RULES, ghosts, look
from helpers import BALL, MODEL, RESTING
from subjects import subject

BALL_AT = '<body pos="0 0 {0}"><freejoint/><geom name="b" size="{1}"/></body></worldbody></mujoco>'
FLOOR = '<geom name="floor" type="box" size="1 1 .003" pos="0 0 0"/>'
SEEN = {
    "cameras": (
        '<mujoco><worldbody><camera name="c" xyaxes="1 0 0 0 0 -1"/></worldbody></mujoco>',
        "camera c",
        "(0, 0, −1)",
    ),
    "deep_start": (
        f"<mujoco><worldbody>{FLOOR}{BALL_AT.format(0.05, 0.1)}",
        "geom b and geom floor",
        "start 53.0\u00a0mm inside",
    ),
    "leaps": (
        f'<mujoco><option timestep=".02"/><worldbody>{FLOOR}{BALL_AT.format(3, 0.01)}',
        "geom b",
        "in a step; half of it and of geom floor are 13.0\u00a0mm thick",
    ),
    "ghosts": (MODEL.replace("0 0 0.06", "0 0 0.3"), "geom floor and geom box", "without a contact"),
}


@pytest.mark.parametrize("name", SEEN)
def test_a_rule_sees_what_it_is_for(name: str) -> None:
    xml, element, text = SEEN[name]
    _, found = look(subject(xml))
    seen = {where: said for rule, where, said in found if rule == name}
    assert element in seen, found
    assert text in seen[element]


def test_every_rule_is_tested_and_states_what_it_looks_for() -> None:
    assert set(SEEN) == {rule.__name__ for rule in RULES}
    assert all(rule.__doc__ for rule in RULES)


@pytest.mark.parametrize("xml", [BALL, RESTING, "<mujoco/>"])
def test_a_scene_that_is_well(xml: str) -> None:
    said, found = look(subject(xml))
    assert found == []
    assert "at the start" in said


def test_parents_welded_and_excluded_pairs_do_not_overlap() -> None:
    xml = """<mujoco><worldbody><body name="a"><joint/><geom size=".1" contype="2" conaffinity="2"/>
      <geom size=".1"/><body name="b"><joint/><geom size=".1"/><body name="c"><joint/>
      <geom size=".1" contype="4" conaffinity="4"/></body></body></body></worldbody>
      <contact><exclude body1="a" body2="c"/></contact></mujoco>"""
    assert list(ghosts(subject(xml))) == []
