"""What the rules tell only whoever names the symptom, and no more once it is mended."""

from __future__ import annotations

import pytest
from diagnosed import diagnosed

ARM = '<mujoco><worldbody><body pos="0 0 1"><joint name="elbow" axis="0 1 0"{joint}/>'
ARM += '<geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/></body></worldbody>'
ARM += "<actuator>{actuator}</actuator></mujoco>"
FOOT = '<mujoco><worldbody><geom type="plane" size="1 1 0.1"/><body pos="0 0 0.1"><freejoint/>'
FOOT += '<geom type="sphere" size="0.02" pos="{} {} -0.08" {}/>' * 3
FOOT += '<geom type="box" size="0.1 0.1 0.02" mass="8" contype="0" conaffinity="0"/></body></worldbody></mujoco>'
SOFT = 'solimp="0.015 1 0.031"'


def feet(given: str) -> str:
    return FOOT.format(0.08, 0, given, -0.08, 0.08, given, -0.08, -0.08, given)


def arm(joint: str, actuator: str = "") -> str:
    return ARM.format(joint=joint, actuator=actuator)


SHORT, WIDE = (f'<position joint="elbow" kp="20" kv="1" ctrlrange="{low} 1.57"/>' for low in (-0.7, -1.57))
MOTOR = '<motor joint="elbow"/>'
LEGS = "".join(
    f'<body pos="0 {y} 0.7"><inertial pos="0 0 {{0}}" mass="10" diaginertia="0.3 0.3 0.05"/>'
    '<geom type="box" size="0.05 0.1 0.3" pos="0 0 -0.3"/></body>'
    for y in (-0.2, 0.2)
)
BODY = f'<mujoco><worldbody><body><freejoint/><geom size="0.1" mass="10"/>{LEGS}</body></worldbody></mujoco>'
KEEN = {
    "centre-at-the-joint": ("wrong-mass", BODY.format(0), BODY.format(-0.3)),
    "control-range-too-narrow": ("stuck", arm(' range="-90 90"', SHORT), arm(' range="-90 90"', WIDE)),
    "range-not-applied": ("passes-limit", arm("", MOTOR), arm(' range="-90 90"', MOTOR)),
    "motors-undamped": ("oscillates", arm(""), arm(' damping="0.01"')),
    "soft-contact": ("sinks", feet(SOFT), feet("")),
}


@pytest.mark.parametrize("rule", KEEN)
def test_a_named_symptom_makes_a_rule_tell(rule: str):
    symptom, ill, well = KEEN[rule]
    for text, named, told in ((ill, symptom, ["hint"]), (ill, "", []), (well, symptom, [])):
        found = diagnosed(text, rule, symptom=named)
        assert [each.level for each in (*found.causes, *found.hints)] == told, found.text()
