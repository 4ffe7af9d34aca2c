"""Wheels, axles and what steers them."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import findings, hints


@pytest.mark.parametrize(
    ("shape", "told"),
    [
        pytest.param('type="ellipsoid" size="0.05 0.03 0.05"', False, id="on the hinge"),
        pytest.param('type="ellipsoid" size="0.05 0.03 0.05" pos="0.004 0 0.003"', True, id="beside it"),
        pytest.param('type="ellipsoid" size="0.05 0.05 0.03"', True, id="flat"),
        pytest.param('type="sphere" size="0.05" pos="0 0 0.001"', False, id="a little beside it"),
    ],
)
def test_a_wheel_whose_middle_is_beside_its_hinge_is_told(shape: str, told: bool) -> None:
    wheels = "".join(
        f'<body name="wheel_{i}" pos="{x} {y} 0"><joint name="steer_{i}" axis="0 0 1" range="-30 30"/>'
        f'<joint name="wheel_{i}" axis="0 1 0"/><geom {shape}/></body>'
        for i, (x, y) in enumerate(((0.1, 0.1), (0.1, -0.1), (-0.1, 0.1), (-0.1, -0.1)))
    )
    car = f'<body pos="0 0 0.05"><freejoint/><geom type="box" size="0.1 0.05 0.02"/>{wheels}</body>'
    text = f'<mujoco><worldbody><geom type="plane" size="5 5 0.1"/>{car}</worldbody></mujoco>'
    assert bool(hints(text, "wheel-not-round")) is told


AXLE = rules()["axle-against-itself"].example("Bad")
STRAIGHT = rules()["axle-against-itself"].example("Good")
MOTOR = '<velocity tendon="shaft" kv="0.1"/>'


@pytest.mark.parametrize(
    ("text", "changes", "values"),
    [
        pytest.param(STRAIGHT, [('"right" axis="0 1 0"', '"right" axis="0 -1 0"')], ["-0.5"], id="opposite-axes"),
        pytest.param(AXLE, [('"right" axis="0 1 0"', '"right" axis="0 -1 0"')], [], id="axes-and-signs"),
        pytest.param(AXLE, [(MOTOR, MOTOR + '<motor joint="left"/>')], [], id="something-else-drives"),
        pytest.param(AXLE, [(MOTOR, "")], [], id="nothing-drives"),
        pytest.param(AXLE, [('"right" axis="0 1 0"', '"right" axis="0 1 0" range="0 90"')], [], id="with-a-range"),
        pytest.param(AXLE, [('"right" pos="-0.1 -0.15 0"', '"right" pos="-0.4 0.15 0"')], [], id="one-behind-another"),
    ],
)
def test_a_tendon_that_drives_two_wheels_of_an_axle_apart_is_told(
    text: str, changes: list[tuple[str, str]], values: list[str]
) -> None:
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    assert [each.value for each in hints(text, "axle-against-itself")] == values


@pytest.mark.parametrize(
    ("place", "axis", "factor", "told"),
    [
        ("0 -0.1 0", "0 0 1", -1, True),
        ("0 -0.1 0", "0 0 1", 1, False),
        ("0 -0.1 0", "0 0 -1", 1, True),
        ("0.3 0.1 0", "0 0 1", -1, False),  # of another axle
        ("0 -0.1 0", "0 1 0", -1, False),  # no steering
    ],
)
def test_a_coupling_that_steers_two_wheels_of_an_axle_apart_is_told(
    place: str, axis: str, factor: int, told: bool
) -> None:
    fork = '<body pos="{1}"><joint name="{0}" axis="{2}" range="-30 30"/><geom size="0.02"/><body><joint axis="0 1 0"/>'
    forks = "".join(
        fork.format(*each) + '<geom size="0.05"/></body></body>'
        for each in (("left", "0 0.1 0", "0 0 1"), ("right", place, axis))
    )
    tie = f'<equality><joint joint1="right" joint2="left" polycoef="0 {factor} 0.1 0 0"/></equality>'
    text = (
        f'<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom size="0.1"/>{forks}</body></worldbody>{tie}</mujoco>'
    )
    assert [each.value for each in hints(text, "axle-against-itself")] == [f"0 {-factor} 0.1 0 0"] * told


@pytest.mark.parametrize(
    ("names", "shaft", "told"),
    [
        pytest.param(("rear_l", "rear_r"), '<velocity tendon="shaft"/>', ["0.1"], id="driven-together"),
        pytest.param(("rear_l", "rear_r"), '<velocity joint="front"/>', ["0.1"], id="trailing"),
        pytest.param(("rear", "prop"), '<velocity tendon="shaft"/>', [], id="not-called-a-pair"),
    ],
)
def test_two_wheels_of_two_sizes_are_told_whatever_drives_them(names: tuple[str, str], shaft: str, told: list[str]):
    part = '<body name="{0}" pos="0 {1} 0"><joint name="{0}" axis="0 1 0"/><geom type="sphere" size="{2}"/></body>'
    wheels = "".join(part.format(*each) for each in zip(names, (0.2, -0.2), (0.1, 0.08), strict=True))
    wheels += '<body pos="0.3 0 0"><joint name="front" axis="0 1 0"/><geom size="0.1"/></body>'
    joints = "".join(f'<joint joint="{name}" coef="0.5"/>' for name in names)
    text = f"""<mujoco><worldbody><body pos="0 0 0.1"><freejoint/><geom type="box" size="0.2 0.1 0.03"/>{wheels}</body>
      </worldbody><tendon><fixed name="shaft">{joints}</fixed></tendon><actuator>{shaft}</actuator></mujoco>"""
    assert [each.value for each in hints(text, "wheels-unlike")] == told


@pytest.mark.parametrize(
    ("axis", "cylinder", "told"),
    [
        pytest.param("1 0 0", 'euler="90 0 0"', ("axis", "0 -1 0"), id="the hinge is wrong"),
        pytest.param("0 1 0", "", ("zaxis", "0 1 0"), id="the cylinder stands"),
        pytest.param("0 1 0", 'euler="90 0 0"', None, id="both along the axle"),
    ],
)
def test_of_hinge_and_cylinder_the_one_that_is_not_along_the_axle_is_turned(axis, cylinder, told):
    wheel = (
        f'<body name="wheel_{{0}}" pos="0 {{1}} 0"><joint name="wheel_{{0}}" axis="{axis}"/>'
        f'<geom type="cylinder" size="0.1 0.02" mass="0.3" {cylinder}/></body>'
    )
    car = f'<freejoint/><geom type="box" size="0.2 0.1 0.03"/>{wheel.format("l", 0.2)}{wheel.format("r", -0.2)}'
    text = f'<mujoco><worldbody><body pos="0 0 0.1">{car}</body></worldbody></mujoco>'
    assert [(each.attribute, each.value) for each in hints(text, "wheel-not-round")[:1]] == ([told] if told else [])


def test_a_wheel_that_has_no_direction_is_not_told_to_vary_by_nan():
    text = rules()["wheel-not-round"].example("Bad").replace('mass="0.3"/>', 'mass="0.3" zaxis="0 1 nan"/>', 1)
    assert not findings(text, "wheel-not-round")


@pytest.mark.parametrize(
    ("kv", "force", "told"),
    [
        pytest.param(0.02, 'forcerange="-8 8"', True, id="a-weak-gain-of-a-strong-servo"),
        pytest.param(0.02, 'forcerange="-1 1"', False, id="of-a-weak-one"),
        pytest.param(0.02, "", False, id="of-one-without-limits"),
        pytest.param(0.2, 'forcerange="-8 8"', False, id="a-gain-that-is-strong-enough"),
    ],
)
def test_a_wheel_that_needs_seconds_to_its_speed_is_told(kv, force, told):
    text = rules()["speed-not-reached"].example("Good").replace('kv="0.2"', f'kv="{kv}" {force}')
    text = text.replace('damping="0.01"', 'damping="0.001"').replace('mass="3"', 'mass="12"')
    assert [(each.attribute, each.value) for each in hints(text, "speed-not-reached")] == [("kv", "0.4")] * told


@pytest.mark.parametrize(
    ("damping", "told"),
    [pytest.param(0.05, ["5.6"], id="more-than-it-gives"), pytest.param(0.02, [], id="less")],
)
def test_a_wheel_whose_damping_takes_all_force_below_its_speed_is_told(damping: float, told: list[str]) -> None:
    text = rules()["speed-not-reached"].example("Good").replace('kv="0.2"', 'kv="4" forcerange="-0.28 0.28"')
    text = text.replace('damping="0.01"', f'damping="{damping}"').replace('mass="3"', 'mass="0.5"')
    assert [each.value for each in hints(text, "speed-not-reached")] == told


@pytest.mark.parametrize(("force", "told"), [(0.01, ["0.2"]), (0.3, [])])
def test_a_cart_that_meets_a_wall_had_its_speed_before(force: float, told: list[str]) -> None:
    text = rules()["speed-not-reached"].example("Good").replace('kv="0.2"', f'kv="0.2" forcerange="-{force} {force}"')
    text = text.replace('damping="0.01"', 'damping="0.001"').replace('mass="3"', 'mass="1"')
    text = text.replace("<worldbody>", '<worldbody><geom type="box" size="0.02 2 0.5" pos="1.5 0 0.5"/>')
    assert [each.value for each in hints(text, "speed-not-reached")] == told


@pytest.mark.parametrize(
    ("throttle", "told"),
    [
        pytest.param('position kp="0.05"', ["wheel-held"], id="angle"),
        pytest.param('velocity kv="0.05"', [], id="speed"),
        pytest.param("motor", [], id="torque"),
    ],
)
def test_a_servo_that_holds_two_wheels_by_a_tendon_is_told(throttle: str, told: list[str]) -> None:
    wheels = "".join(
        f'<body name="{side}_wheel" pos="0 {y} 0"><joint name="{side}_spin" axis="0 1 0"/><geom size="0.05"/></body>'
        for side, y in (("left", 0.1), ("right", -0.1))
    )
    car = f'<body pos="0 0 0.05"><freejoint/><geom type="box" size="0.1 0.05 0.02"/>{wheels}</body>'
    ends = "".join(f'<joint joint="{side}_spin" coef="0.5"/>' for side in ("left", "right"))
    text = f"""<mujoco><worldbody><geom type="plane" size="1 1 0.1"/>{car}</worldbody>
      <tendon><fixed name="axle">{ends}</fixed></tendon>
      <actuator><{throttle} tendon="axle" ctrlrange="-60 60"/></actuator></mujoco>"""
    assert [each.rule for each in hints(text, "wheel-held")] == told


@pytest.mark.parametrize(
    ("joint", "sensor", "world", "told"),
    [
        ("", "gyro", "<geom size='9'/>", 1),
        ("", "velocimeter", "<geom size='9'/>", 1),
        ("", "accelerometer", "<geom size='9'/>", 0),
        ("<freejoint/>", "gyro", "<geom size='9'/>", 0),
        ("", "gyro", "", 0),
    ],
)
def test_a_fixed_body_whose_motion_is_measured_is_told(joint: str, sensor: str, world: str, told: int):
    tail = '<body pos="-0.1 0 0"><joint axis="0 0 1"/><geom size="0.05 0.01 0.03" type="box"/></body>'
    head = f'<body name="head">{joint}<geom size="0.05"/><site name="imu"/>{tail}</body>'
    text = f'<mujoco><worldbody>{world}{head}</worldbody><sensor><{sensor} name="imu" site="imu"/></sensor></mujoco>'
    assert [each.elements for each in hints(text, "root-is-fixed")] == [('body "head"',)] * told
