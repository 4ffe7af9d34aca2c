"""What rules say and offer beside what MuJoCo does: healthy models that were told, and edits that did nothing."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import causes, hints, with_edits

BASE = '<body name="base"><geom type="cylinder" size="0.1 0.1" pos="0 0 0.1"/>{}</body>'
SHOULDER = """<body name="shoulder" pos="0 0 0.2"><joint axis="0 0 1"/>
  <geom type="cylinder" size="0.08 0.1" pos="0 0 {}"/></body>"""
TWICE = """<mujoco><worldbody><body pos="0 0 0.5"><freejoint/>
  <geom type="box" size="0.05 0.05 0.1" contype="0" conaffinity="0" mass="0" euler="{}"/>
  <geom type="box" size="0.05 0.05 0.1"/></body></worldbody></mujoco>"""
STANDS = """<mujoco><worldbody><geom name="floor" type="plane" size="2 2 0.1"/>
  <body name="box" pos="0 0 0.05"><freejoint/><geom name="box" type="box" size="0.05 0.05 0.05" {geom}/></body>
  </worldbody><contact>{contact}</contact></mujoco>"""
LINK = """<mujoco><worldbody><body quat="0.7071 0.7071 0 0"><joint axis="0 1 0" pos="0 0 0"/>
  <inertial pos="0 0 0.2" mass="1" diaginertia="0.0002 0.0135 0.0135"/>
  <geom type="capsule" fromto="0 0 0 0 0 0.4" size="0.02"/></body></worldbody></mujoco>"""


@pytest.mark.parametrize(("place", "told"), [(0.099, 1), (0.10005, 0)], ids=["in it", "0.05 mm above it"])
def test_a_link_that_does_not_touch_its_base_does_not_rub_on_it(place: float, told: int) -> None:
    text = f"<mujoco><worldbody>{BASE.format(SHOULDER.format(place))}</worldbody></mujoco>"
    assert len(hints(text, "rubs-on-its-base")) == told


@pytest.mark.parametrize(("turn", "told"), [("0 0 90", 0), ("90 0 0", 1), ("0 0 45", 1)])
def test_a_square_box_that_is_turned_by_a_quarter_is_as_before(turn: str, told: int) -> None:
    assert len(hints(TWICE.format(turn), "collision-apart")) == told


def test_a_ball_that_is_to_stop_rolling_stops_by_the_edit() -> None:
    text = rules()["rolls-for-ever"].example("Bad")
    (told,) = hints(text, "rolls-for-ever")
    assert told.elements == ('geom "ball"',)
    assert 'condim="6" friction="1 0.005 0.005"' in with_edits(text, told)


@pytest.mark.parametrize(("friction", "value"), [("50 0.02 0.003", "1 0.02 0.003"), ("99 99 99", "1 0.005 0.0001")])
def test_of_a_friction_beyond_any_material_what_may_be_meant_is_kept(friction: str, value: str) -> None:
    text = STANDS.format(geom=f'condim="6" friction="{friction}"', contact="")
    assert [each.value for each in hints(text, "friction-beyond-any-material")] == [value]


def test_a_pair_touches_what_an_exclude_keeps_apart() -> None:
    exclude, pair = '<exclude body1="world" body2="box"/>', '<pair geom1="floor" geom2="box"/>'
    assert hints(STANDS.format(geom="", contact=exclude + pair), "excluded-pair") == []


def test_a_pair_with_a_margin_is_named() -> None:
    text = STANDS.format(geom="", contact='<pair name="sole" geom1="floor" geom2="box" margin="0.05"/>')
    assert [each.elements for each in causes(text, "margin")] == [('pair "sole"',)]


@pytest.mark.parametrize("solref", ["1 0.01", "1 1"])
def test_of_a_friction_only_the_time_constant_acts(solref: str) -> None:
    pair = f'<pair geom1="floor" geom2="box" solreffriction="{solref}"/>'
    said = [each.says for each in hints(STANDS.format(geom="", contact=pair), "solref-exchanged")]
    assert ["creep" in each for each in said] == [True] * (solref == "1 0.01")


@pytest.mark.parametrize(("option", "told"), [("", 1), ('<option integrator="discrete"/>', 0)])
def test_a_solref_below_two_steps_is_told_where_the_guard_lifts_it(option: str, told: int) -> None:
    text = rules()["solref-below-two-steps"].example("Bad").replace("<mujoco>", f"<mujoco>{option}")
    assert len(hints(text, "solref-below-two-steps")) == told


def test_what_rolls_off_a_terrain_does_not_fall_through_it() -> None:
    field = '<hfield name="h" nrow="3" ncol="3" size="0.3 0.3 0.2 0.1" elevation="0 0 0 0 1 0 0 0 0"/>'
    ball = '<body pos="0.2 0 0.5"><freejoint/><geom size="0.05" mass="0.1"/></body>'
    world = f'<worldbody><geom type="hfield" hfield="h"/>{ball}</worldbody>'
    assert hints(f"<mujoco><asset>{field}</asset>{world}</mujoco>", "terrain-thin") == []


def test_no_axis_is_offered_inside_a_frame() -> None:
    text = rules()["wheel-not-round"].example("Bad")
    geom = '<geom type="cylinder" size="0.1 0.02" mass="0.3"/>'
    framed = text.replace(geom, f'<frame euler="0 0 90">{geom}</frame>')
    assert [each.edit for each in hints(framed, "wheel-not-round")] == [()]


def test_a_floor_keeps_its_masks_where_something_else_stands_on_it() -> None:
    text = rules()["swing-blocked"].example("Bad")
    ball = '<body pos="1 1 0.2"><freejoint/><geom size="0.05"/></body>'
    assert [bool(each.edit) for each in hints(text, "swing-blocked")] == [True]
    assert [each.edit for each in hints(text.replace("</worldbody>", f"{ball}</worldbody>"), "swing-blocked")] == [()]


def test_a_servo_at_the_end_of_its_force_is_not_made_stiffer() -> None:
    text = rules()["grip-too-weak"].example("Bad").replace('kp="200"', 'kp="1000" forcerange="-2 2"')
    assert [(each.attribute, each.edit) for each in hints(text, "grip-too-weak")] == [("forcerange", ())]


def test_the_turn_that_is_told_is_that_of_the_inertial() -> None:
    assert [each.now for each in hints(LINK, "inertia-across-geoms")] == ["quat left out"]


@pytest.mark.parametrize(("base", "static"), [("<joint/>", False), ("", True)])
def test_the_filter_of_parents_is_told_of_a_parent_alone(base: str, static: bool) -> None:
    rod = '<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/>'
    arm = f'<body name="b" pos="0.1 0 0"><joint axis="0 0 1"/>{rod}</body>'
    link = f'<body name="a">{base}<geom size="0.01" pos="0.3 0 0.2"/>{arm}</body>' if base else arm
    text = f'<mujoco><worldbody><body name="base"><geom size="0.1"/>{link}</body></worldbody></mujoco>'
    assert ["filter of parents" in each.says for each in hints(text, "overlap-of-relatives")] == [static]


def test_a_unit_is_named_where_it_fits() -> None:
    rod = '<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>'
    link = f'<inertial pos="0.15 0 0" mass="1" diaginertia="20 750 750"/>{rod}'
    arm = f'<body><joint axis="0 1 0"/>{link}<body pos="0.3 0 0"><joint axis="0 1 0"/>{link}</body></body>'
    (told,) = causes(f"<mujoco><worldbody>{arm}</worldbody></mujoco>", "inertia-in-another-unit")
    assert (told.value, "as if" in told.says) == ("1e-5 times as much", False)
