"""Forces that are too small for what they carry."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import causes, diagnosed, findings, hints


@pytest.mark.parametrize(
    ("force", "told"), [pytest.param(0.5, True, id="a weak servo"), pytest.param(1.2, False, id="a strong one")]
)
def test_wheels_that_are_blocked_are_not_told_a_greater_force(force, told):
    text = rules()["speed-not-reached"].example("Good").replace('kv="0.2"', f'kv="200" forcerange="-{force} {force}"')
    text = text.replace('mass="3"', 'mass="30"').replace('ctrlrange="-20 20"', 'ctrlrange="-6 6"')
    text = text.replace('euler="90 0 0"', 'euler="90 0 0" friction="1 0.005 0.01" condim="6"')  # rolls hard
    assert [each.attribute for each in hints(text, "speed-not-reached")] == ["forcerange"] * told


@pytest.mark.parametrize(
    ("force", "told"),
    [pytest.param(0.6, [("hint", "forcerange", "3")], id="stands-on-it"), pytest.param(6, [], id="has-some-left")],
)
def test_motors_that_give_all_they_can_to_stand_still_are_told(force: float, told: list[tuple[str, str, str]]) -> None:
    legs = "".join(
        f'<body pos="{x} {y} 0" euler="0 0 {turn}"><joint name="leg{i}" axis="0 1 0" range="-60 60" damping="0.1" '
        'armature="0.004"/><geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.05" contype="0"/>'
        '<geom type="capsule" fromto="0.2 0 0 0.2 0 -0.08" size="0.02" mass="0.05"/></body>'
        for i, (x, y, turn) in enumerate(((0.1, 0.1, 45), (0.1, -0.1, -45), (-0.1, 0.1, 135), (-0.1, -0.1, -135)))
    )
    trunk = f'<body pos="0 0 0.1"><freejoint/><geom type="box" size="0.1 0.1 0.02" mass="2" contype="0"/>{legs}</body>'
    servos = "".join(f'<position joint="leg{i}" kp="40" kv="1" forcerange="-{force} {force}"/>' for i in range(4))
    floor = '<geom type="plane" size="2 2 0.1"/>'
    text = f"<mujoco><worldbody>{floor}{trunk}</worldbody><actuator>{servos}</actuator></mujoco>"
    assert [(each.level, each.attribute, each.value) for each in findings(text, "force-range-too-small")] == told


@pytest.mark.parametrize(
    ("force", "open_by", "told"),
    [(300, 0, ["1500"]), (3000, 0, []), (300, 0.2, [])],
    ids=["too weak", "strong", "not closed at the start"],
)
def test_a_ram_that_cannot_carry_what_its_loop_puts_on_it_is_told(
    force: float, open_by: float, told: list[str]
) -> None:
    rod = (
        '<body pos="0 0 0.3"><joint name="ram" type="slide" axis="0 0 1" range="-0.1 0.1" damping="100"/>'
        '<geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.01" mass="1"/>'
        f'<site name="eye" pos="0 0 {0.2 + open_by}"/></body>'
    )
    text = f"""<mujoco><worldbody>
      <body pos="0 0 1.5"><joint axis="0 1 0" range="-40 40"/><site name="lug" pos="0.3 0 0"/>
        <geom type="capsule" fromto="0 0 0 1 0 0" size="0.03" mass="20"/></body>
      <body pos="0.3 0 1"><joint axis="0 1 0" damping="1"/>
        <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02" mass="1"/>{rod}</body></worldbody>
      <equality><connect site1="eye" site2="lug"/></equality>
      <actuator><position joint="ram" kp="60000" kv="2000" forcerange="-{force} {force}"/></actuator></mujoco>"""
    assert [each.value for each in causes(text, "force-range-too-small")] == told


@pytest.mark.parametrize(("elbow", "told"), [("3", [("actuatorfrcrange", "15")]), ("20", [])])
def test_a_motor_far_harder_pressed_than_the_one_that_carries_it_is_told(
    elbow: str, told: list[tuple[str, str]]
) -> None:
    link = '<joint name="{0}" axis="0 1 0" range="-90 90" damping="1" actuatorfrcrange="-{1} {1}"/>'
    link += '<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>'
    forearm = f'<body pos="0.3 0 0">{link.format("elbow", elbow)}</body>'
    text = f"""<mujoco><worldbody><body pos="0 0 1">{link.format("shoulder", 60)}{forearm}</body></worldbody>
      <actuator><position joint="shoulder" kp="200" kv="10"/><position joint="elbow" kp="100" kv="5"/></actuator>
    </mujoco>"""
    found = diagnosed(text, "force-range-too-small")
    assert not found.causes
    assert [(each.attribute, each.value) for each in found.hints] == told


@pytest.mark.parametrize(
    ("force", "ratio", "spring", "more", "told"),
    [
        pytest.param(0.004, 785, "", "", True, id="weak"),
        pytest.param(0.02, 785, "", "", False, id="strong"),
        pytest.param(0.004, 785, "", '<motor joint="bed"/>', False, id="beside a motor"),
        pytest.param(0.004, 785, 'stiffness="100"', "", False, id="on a spring"),
        pytest.param(1.57, 2, "", "", True, id="another ratio"),
        pytest.param(3.14, 1, "", "", False, id="the ratio was left at 1"),
        pytest.param(
            1.57,
            2,
            "",
            '</actuator><keyframe><key qpos="0.1 78.5 78.5"/></keyframe><actuator>',
            False,
            id="a keyframe has another ratio",
        ),
    ],
)
def test_servos_of_screws_that_together_do_not_hold_a_bed_are_told(force, ratio, spring, more, told):
    screw = '<body pos="{1} 0 0"><joint name="{0}" axis="0 0 1" armature="0.00002"/><geom size="0.01"/></body>'
    servo = '<position joint="{0}" kp="2" kv="0.01" forcerange="-{1} {1}"/>'
    nut = '<joint joint1="{}" joint2="bed" polycoef="0 {} 0 0 0"/>'
    sides = (("left", -1), ("right", 1))
    text = f"""<mujoco><worldbody><body><joint name="bed" type="slide" axis="0 0 1" {spring}/>
      <geom size="0.1" mass="1"/></body>{"".join(screw.format(*side) for side in sides)}</worldbody>
      <equality>{"".join(nut.format(side, ratio) for side, _ in sides)}</equality>
      <actuator>{"".join(servo.format(side, force) for side, _ in sides)}{more}</actuator></mujoco>"""
    assert [each.value for each in causes(text, "force-range-too-small")] == [f"{14.8 / ratio:.2g}"] * told


@pytest.mark.parametrize(
    ("axis", "inside", "told"),
    [
        pytest.param("0 0 1", "", ["30"], id="slide-that-lifts"),
        pytest.param("0 0 1", 'frictionloss="1"', [], id="friction-holds-it"),
        pytest.param("0 0 1", 'stiffness="50"', [], id="spring-holds-it"),
        pytest.param("1 0 0", "", [], id="slide-that-lies"),
    ],
)
def test_a_force_a_little_below_the_weight_is_told_where_no_pose_takes_less(axis: str, inside: str, told: list[str]):
    joint = f'<joint name="lift" type="slide" axis="{axis}" range="-0.2 0.2" damping="20" {inside}/>'
    body = f'<body pos="0 0 1">{joint}<geom size="0.1" mass="1.02"/></body>'
    servo = '<position joint="lift" kp="3000" kv="200" forcerange="-9.3 9.3"/>'
    text = f"<mujoco><worldbody>{body}</worldbody><actuator>{servo}</actuator></mujoco>"
    assert [each.value for each in causes(text, "force-range-too-small")] == told
