"""Springs that rest where they should not, hold too little or too much."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import findings, hints

PLANAR = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 1"/>
    <body name="torso" pos="0 0 1">
      <joint name="forth" type="slide" axis="1 0 0"/><joint name="up" type="slide" axis="0 0 1"/>
      <joint name="pitch" axis="0 1 0"/>
      <geom type="capsule" size="0.05" fromto="0 0 0 0 0 -0.4"/>
      <body name="thigh" pos="0 0 -0.4">
        <joint name="hip" axis="0 1 0" range="-45 45" stiffness="1" springref="{hip}"/>
        <geom type="capsule" size="0.04" fromto="0 0 0 0 0 -0.25"/>
        <body name="shin" pos="0 0 -0.25">
          <joint name="knee" axis="0 1 0" range="-45 45" stiffness="1"/>
          <geom type="capsule" size="0.04" fromto="0 0 0 0 0 -0.25"/>
          <body name="foot" pos="0 0 -0.25">
            <joint name="ankle" axis="0 1 0" range="-45 45" stiffness="1" springref="{ankle}"/>
            <geom type="capsule" size="0.05" fromto="-0.05 0 -0.05 0.15 0 -0.05"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <contact><exclude body1="{one}" body2="{other}"/></contact>
</mujoco>
"""


@pytest.mark.parametrize(
    ("one", "other", "told"), [("world", "foot", True), ("foot", "world", True), ("world", "shin", False)]
)
def test_the_foot_of_a_planar_robot_must_touch_the_floor(one, other, told):
    assert bool(findings(PLANAR.format(hip=0, ankle=0, one=one, other=other), "excluded-pair")) is told


@pytest.mark.parametrize(("hip", "ankle", "told"), [(0, 90, True), (90, 90, False), (0, 60, False)])
def test_the_one_spring_that_rests_beyond_its_range_is_told(hip, ankle, told):
    text = PLANAR.format(hip=hip, ankle=ankle, one="thigh", other="torso")
    assert bool(findings(text, "spring-far-off")) is told


@pytest.mark.parametrize(
    ("rest", "told"), [("-0.02", "0.02"), ("0.02", None), ("0", None)], ids=["towards the load", "against it", "none"]
)
def test_a_spring_that_rests_on_the_side_of_its_load_gets_the_other_sign(rest: str, told: str | None) -> None:
    slide = f'<joint type="slide" axis="0 0 1" range="-0.05 0.05" stiffness="2000" damping="180" springref="{rest}"/>'
    load = f'<body name="load" pos="0 0 1">{slide}<geom size="0.1" mass="4"/></body>'
    text = f"<mujoco><worldbody>{load}</worldbody></mujoco>"
    found = hints(text, "spring-at-its-stop")
    assert [(each.attribute, each.value) for each in found] == ([("springref", told)] if told else [])


@pytest.mark.parametrize(
    ("spring", "drive", "weight", "told"),
    [
        ('stiffness="0.9"', "motor", 3, ("stiffness", "900")),
        ('stiffness="20"', "motor", 3, ("stiffness", "550")),
        ('stiffness="900" springref="-0.18"', "motor", 3, ("springref", "0")),
        ('stiffness="900" springref="-0.18"', "motor", 0, None),
        ('stiffness="900"', "motor", 3, None),
        ('stiffness="0.9" springref="0.02"', "motor", 3, ("stiffness", "900")),
        ('stiffness="0.9"', 'position kp="2000"', 3, None),
    ],
    ids=[
        "N/mm",
        "weak",
        "rests at its stop",
        "a plunger without a load",
        "right",
        "N/mm from its stop",
        "a servo holds it",
    ],
)
def test_a_leg_with_a_spring_beside_its_motor_is_told_at_its_stop(spring, drive, weight, told):
    slide = f'<joint name="leg" type="slide" axis="0 0 1" range="-0.18 0.02" damping="40" {spring}/>'
    text = f"""<mujoco><option gravity="0 0 {-3.27 * weight}"/><worldbody><body>{slide}<geom size="1" mass="3"/></body>
      </worldbody><actuator><{drive} joint="leg"/></actuator></mujoco>"""
    assert [(each.attribute, each.value) for each in hints(text, "spring-at-its-stop")] == ([told] if told else [])


def test_a_spring_pressed_to_the_stop_where_it_rests_hides_no_other() -> None:
    slide = '<joint type="slide" axis="0 0 1" range="-0.18 0.02" damping="40" stiffness="0.9" springref="0.02"/>'
    legs = "".join(
        f'<body pos="{5 * lifted} 0 0" gravcomp="{2 * lifted}">{slide}<geom size="1" mass="3"/></body>'
        for lifted in (0, 1)
    )
    assert hints(f"<mujoco><worldbody>{legs}</worldbody></mujoco>", "spring-at-its-stop")


@pytest.mark.parametrize(
    ("stiffness", "values"),
    [("120", {"0.02"}), ("20", {"0.02"}), ("0.12", set())],
    ids=["far too stiff", "too stiff", "right"],
)
def test_the_springs_of_a_chain_that_have_one_stiffness_get_one_again(stiffness: str, values: set[str]) -> None:
    link = ""
    for _ in range(5):
        shape = f'<joint axis="0 1 0" damping="0.004" stiffness="{stiffness}"/><geom size="0.01" pos="0 0 -0.01"/>'
        link = f'<body pos="0 0 -0.024">{shape}{link}</body>'
    text = f'<mujoco><option timestep="0.001"/><worldbody>{link}</worldbody></mujoco>'
    assert {edit.value for each in findings(text, "spring-too-stiff") for edit in each.edit} == values


@pytest.mark.parametrize(("rest", "told"), [("-75", False), ("160", True)])
def test_a_spring_that_holds_a_door_shut_is_well(rest, told):
    doors = "".join(
        f'<body pos="{x} 0 1"><joint name="d{x}" axis="0 1 0" range="0 85" stiffness="5" damping="1" springref="{{}}"/>'
        '<geom type="box" size="0.2 0.3 0.01" pos="0.2 0 0" mass="1"/></body>'
        for x in range(3)
    )
    text = f"<mujoco><worldbody>{doors.format('0', '0', rest)}</worldbody></mujoco>"
    assert bool(findings(text, "spring-far-off")) == told


@pytest.mark.parametrize(
    ("spring", "turn", "motor", "told"),
    [
        pytest.param('stiffness="1" springref="-12"', "-52 0", "motor", ["12"], id="hangs"),
        pytest.param('stiffness="1" springref="12"', "-52 0", "motor", [], id="pressed to its stop"),
        pytest.param('stiffness="1" springref="-12"', "-52 52", "motor", [], id="not at a stop"),
        pytest.param('stiffness="1" springref="-12"', "-52 0", 'position kp="5"', [], id="held"),
        pytest.param('stiffness="10" springref="-12"', "-52 0", "motor", [], id="stiff"),
    ],
)
def test_a_lever_whose_spring_lets_it_hang_is_told(spring: str, turn: str, motor: str, told: list[str]) -> None:
    joint = f'<joint name="lever" axis="0 1 0" range="{turn}" damping="0.1" armature="0.005" {spring}/>'
    lever = f'{joint}<geom type="capsule" fromto="0 0 0 -0.12 0 0" size="0.01" mass="0.25"/>'
    drive = f'<actuator><{motor} joint="lever"/></actuator>'
    text = f'<mujoco><worldbody><body pos="0 0 1">{lever}</body></worldbody>{drive}</mujoco>'
    assert [each.value for each in hints(text, "spring-at-its-stop")] == told


@pytest.mark.parametrize(
    ("joint", "extra", "told"),
    [
        pytest.param('stiffness="2000"', "", ["41"], id="no-damper"),
        pytest.param('stiffness="2000" damping="1"', "", [], id="damping"),
        pytest.param('stiffness="2000" frictionloss="1"', "", [], id="friction"),
        pytest.param("", "", [], id="no-spring"),
        pytest.param('stiffness="2000"', '<option density="1000"/>', [], id="in-water"),
        pytest.param(
            'stiffness="2000"',
            '<actuator><position joint="left_strut"/><position joint="right_strut"/></actuator>',
            [],
            id="driven",
        ),
        pytest.param('stiffness="1"', "hinge", [], id="hinge-that-its-spring-does-not-hold"),
        pytest.param('stiffness="100"', "hinge", ["0.78"], id="hinge-that-it-holds"),
    ],
)
def test_a_spring_without_a_damper_is_told_of_what_moves_freely(joint: str, extra: str, told: list[str]) -> None:
    text = rules()["spring-undamped"].example("Bad").replace('stiffness="2000"', joint)
    if extra == "hinge":
        text = text.replace('type="slide" axis="0 0 1" range="-0.05 0.05"', 'axis="0 1 0"')
        text = text.replace(
            '<geom type="box" size="0.2 0.02 0.1"', '<geom type="box" size="0.2 0.02 0.1" pos="0.2 0 0"'
        )
        extra = ""
    text = text.replace("</mujoco>", f"{extra}</mujoco>")
    assert [each.value for each in hints(text, "spring-undamped")] == told
    fixed = text.replace("<freejoint/>", "")
    assert not hints(fixed, "spring-undamped")


@pytest.mark.parametrize(
    ("root", "drive", "told"),
    [
        pytest.param("", "", [], id="on-the-ground"),
        pytest.param('<joint type="slide" axis="0 0 1"/>', "", ["66"], id="on-a-rail"),
        pytest.param('<joint type="slide" axis="0 0 1"/>', '<motor joint="leg"/>', ["66"], id="beside-a-motor"),
        pytest.param('<joint type="slide" axis="0 0 1"/>', '<position joint="leg"/>', [], id="beside-a-servo"),
    ],
)
def test_the_spring_of_a_hopper_without_a_damper_is_told(root: str, drive: str, told: list[str]) -> None:
    text = f"""<mujoco><worldbody><body name="carriage" pos="0 0 0.75">{root}<geom size="0.1" mass="4.6"/>
      <body pos="0 0 -0.4"><joint name="leg" type="slide" axis="0 0 1" range="0 0.2" stiffness="2500"/>
      <geom size="0.025" mass="0.25"/></body></body></worldbody><actuator>{drive}</actuator></mujoco>"""
    assert [each.value for each in hints(text, "spring-undamped")] == told


def test_the_rest_of_a_spring_gets_the_unit_of_the_file() -> None:
    joint = '<joint name="elbow" axis="0 1 0" range="-60 60" ref="30" stiffness="1" springref="450" damping="0.1"/>'
    text = f"""<mujoco><worldbody><body pos="0 0 1">{joint}
      <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/></body></worldbody></mujoco>"""
    assert [each.value for each in hints(text, "spring-far-off")] == ["30"]
