"""Step 2: every rule sees what it is for, and keeps quiet about a model that is well."""

from __future__ import annotations

import pytest
from clinic.triage.model_rules import RULES
from helpers import BALL, RESTING
from subjects import arm, subject

FREE = '<body name="box" pos="0 0 1" {0}><freejoint/><geom name="box" size=".1 .1 .1" type="box" {1}/></body>'
FLOOR = '<geom name="floor" type="plane" size="1 1 1" {0}/>'
SEEN = {
    "still": ('<mujoco><worldbody><geom size="1"/></worldbody></mujoco>', "model", "nothing can fall or move"),
    "ranges": (arm('range="0 3"'), "joint elbow", "range 0 to 0.0524"),
    "ranges wide": (arm('range="-2000 2000"'), "joint elbow", "range −34.9 to 34.9"),
    "unused_ranges": (arm('range="90 -90"'), "joint elbow", "given and not in force"),
    "start_outside": (arm('range="30 90"'), "joint elbow", "starts at 0, outside its range 0.524 to 1.57\u00a0rad"),
    "start_outside ctrl": (arm(servo='ctrlrange="1 2" kp="9"'), "actuator servo", "clamped to 1 to 2"),
    "gains": (arm(servo='kp="0"'), "actuator servo", "gain 0"),
    "gains gear": (arm(servo='kp="5" gear="0"'), "actuator servo", "gear 0"),
    "weak_servos": (arm('axis="0 1 0"', servo='kp="5"'), "actuator servo", "carries 2.94"),
    "undamped": (arm(servo='kp="5"'), "actuator servo", "damping ratio 0"),
    "undamped spring": (arm('stiffness="5"'), "joint elbow", "damping ratio 0"),
    "masses": (arm(more=FREE.format("", 'mass="1e-5"')), "body box", "beside 1"),
    "masses heavy": (arm(more=FREE.format("", 'mass="1e5"')), "body box", "mass"),
    "lengths": (
        '<mujoco><worldbody><body><joint/><geom size="1e-3"/></body></worldbody></mujoco>',
        "scene",
        "is 0.00200",
    ),
    "lengths long": (arm(more='<geom size="1" pos="2000 0 0"/>'), "scene", "is 2001"),
    "gravity": (arm(before='<option gravity="0 0 -981"/>'), "option", "gravity 0 0 −981"),
    "switches": (arm(before='<option><flag contact="disable"/></option>'), "option", "contact is disabled"),
    "time_steps": (arm('stiffness="2e7"'), "option", "stable to"),
    "time_steps zero": (arm(before='<option timestep="0"/>'), "option", "time does not go on"),
    "time_constants": (arm(geom='solref="0.001 1"'), "geom arm", "solref 1"),
    "lonely": (arm(more=FLOOR.format('contype="2" conaffinity="2"')), "geom floor", "collides with no other"),
    "priorities": (arm(geom='priority="1" friction=".1"', more=FLOOR.format("")), "geom arm", "sets friction 0.1"),
    "quaternions": (arm(more=FREE.format('quat="1 0.5 0 0"', "")), "body box", "has length 1.12"),
    "quaternions last": (arm(more=FREE.format('quat="0 0 .7071 .7071"', "")), "body box", "w last it is 90°"),
    "visual_mass": (
        arm().replace("</body>", '<geom name="look" size=".1" contype="0" conaffinity="0"/></body>'),
        "geom look",
        "has mass",
    ),
    "keyframes": (
        arm()
        .replace("</mujoco>", '<keyframe><key name="home" qpos="1"/></keyframe></mujoco>')
        .replace("</worldbody>", FREE.format("", "") + "</worldbody>"),
        "key home",
        "gives 1 of 8",
    ),
}


@pytest.mark.parametrize("name", SEEN)
def test_a_rule_sees_what_it_is_for(name: str) -> None:
    xml, element, text = SEEN[name]
    rule = next(rule for rule in RULES if rule.__name__ == name.split(maxsplit=1)[0])
    seen = dict(rule(subject(xml)))
    assert element in seen, seen
    assert text in seen[element]


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_a_rule_keeps_quiet_about_a_model_that_is_well(rule) -> None:
    well = arm(
        'axis="0 1 0" range="-90 90" damping="2"', servo='kp="500" kv="20" ctrlrange="-1 1"', more=FLOOR.format("")
    )
    for xml in (well, BALL, RESTING, "<mujoco/>"):
        assert list(rule(subject(xml))) == []


def test_every_rule_states_what_it_looks_for() -> None:
    assert [rule.__name__ for rule in RULES if not (rule.__doc__ or "").strip()] == []
    assert {name.split()[0] for name in SEEN} == {rule.__name__ for rule in RULES}
