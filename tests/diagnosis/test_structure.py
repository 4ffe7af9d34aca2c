"""Joints and springs that hold, free or turn something else than is meant; objects that nothing can move."""

from __future__ import annotations

import pytest
from clinic.diagnosis.native import NativeEngine
from diagnosed import findings, hints, with_edits

DOOR = """
<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <joint name="door" axis="0 0 1" range="0 90" {resists}/>
      <geom type="box" size="0.01 0.3 0.4" pos="0 -0.3 0" mass="5"/>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.mark.parametrize(
    ("resists", "told"),
    [('damping="1000"', 1), ('frictionloss="200"', 1), ('damping="20"', 0), ('frictionloss="20"', 0), ("", 0)],
)
def test_a_door_that_a_push_does_not_open_is_told(resists, told):
    assert len(findings(DOOR.format(resists=resists), "joint-frozen")) == told


@pytest.mark.parametrize(
    ("name", "attributes", "tool", "told"),
    [
        pytest.param("cube", "", "gripper", True, id="before a gripper"),
        pytest.param("cube", "", "pusher", False, id="before something else"),
        pytest.param("cube", 'mass="0.1"', "pusher", True, id="with a mass"),
        pytest.param("table", 'mass="9"', "gripper", False, id="a table"),
    ],
)
def test_an_object_that_lies_on_something_and_has_no_joint_is_told(
    name: str, attributes: str, tool: str, told: bool
) -> None:
    text = f"""<mujoco><worldbody><geom type="plane" size="2 2 0.1"/>
      <body name="first" pos="1 0 0.1"><freejoint/><geom size="0.1"/></body>
      <body name="{name}" pos="0.3 0 0.02" euler="0 0 90">
        <geom type="box" size="0.02 0.02 0.02" {attributes}/></body>
      <body name="{tool}" pos="0.3 0 0.3"><joint type="slide" damping="1"/><geom size="0.02"/></body></worldbody>
    <keyframe><key qpos="1 0 0.1 1 0 0 0 0.05" qvel="0 0 0 0 0 0 0.1"/></keyframe></mujoco>"""
    found = hints(text, "object-without-joint")
    assert [each.elements for each in found] == [(f'body "{name}"',)] * told
    for each in found:
        mended = with_edits(text, each)
        pose = "0.3 0 0.02 0.707107 0 0 0.707107"
        assert f'<key qpos="1 0 0.1 1 0 0 0 {pose} 0.05" qvel="{"0 " * 12}0.1"/>' in mended
        assert NativeEngine().compile(mended, {})


@pytest.mark.parametrize(
    ("geom", "tool", "beside", "told"),
    [
        pytest.param('mass="0.04"', "vacuum", "", True, id="nothing else to hold"),
        pytest.param("", "vacuum", "", False, id="no mass"),
        pytest.param('mass="0.04"', "probe", "", False, id="no gripper"),
        pytest.param('mass="0.04"', "vacuum", '<body><freejoint/><geom size="0.1"/></body>', False, id="a free one"),
        pytest.param('mass="0.04" pos="0.2 0 0"', "vacuum", "", True, id="aside"),
    ],
)
def test_what_has_a_mass_is_what_a_gripper_is_to_hold_where_nothing_is_free(geom, tool, beside, told):
    chip = f'<body name="chip" pos="0.3 0 0.02"><geom type="box" size="0.02 0.02 0.02" {geom}/></body>'
    arm = f'<body name="{tool}" pos="0 0 0.3"><joint type="slide" damping="1"/><geom size="0.02"/></body>'
    floor = '<geom type="plane" size="2 2 0.1"/>'
    text = f"<mujoco><worldbody>{floor}{chip}{arm}{beside}</worldbody></mujoco>"
    assert [each.elements for each in hints(text, "object-without-joint")] == [('body "chip"',)] * told


@pytest.mark.parametrize(
    ("geom", "height", "told"),
    [
        pytest.param('size="0.2"', 1, True, id="a ball in the air"),
        pytest.param('size="0.2" pos="0.1 0 0"', 1, False, id="beside the hinge"),
        pytest.param('size="0.2 0.2 0.2" type="box"', 1, False, id="a box, whose turning shows"),
        pytest.param('size="0.2"', 0.2, False, id="on the floor"),
    ],
)
def test_a_ball_that_its_hinge_moves_nowhere_is_set_free(geom: str, height: float, told: bool) -> None:
    joint = '<joint name="root" range="-360 360" limited="true"/>'
    ball = f'<body name="ball" pos="0 0 {height}">{joint}<geom {geom}/></body>'
    text = f'<mujoco><worldbody><geom type="plane" size="2 2 0.1"/>{ball}</worldbody></mujoco>'
    found = hints(text, "object-without-joint")
    assert [(each.elements, each.value) for each in found] == [(('joint "root"',), "free")] * told


@pytest.mark.parametrize(
    ("young", "value"), [("30", "30000"), ("3e4", None)], ids=["in-kilopascal", "that-keeps-its-shape"]
)
def test_a_soft_body_that_goes_flat_is_told(young: str, value: str | None) -> None:
    foam = f"""<flexcomp name="foam" type="grid" count="3 3 3" spacing="0.07 0.07 0.07" pos="0 0 0.09" dim="3"
        mass="1.2" radius="0.012"><elasticity young="{young}" poisson="0.2" damping="0.002"/>
        <contact solref="0.01 1" selfcollide="none"/></flexcomp>"""
    floor = '<geom type="plane" size="1 1 0.1"/>'
    text = f'<mujoco><option timestep="0.002"/><worldbody>{floor}{foam}</worldbody></mujoco>'
    found = hints(text, "flex-falls-apart")
    assert [(each.attribute, each.value) for each in found] == [("young", value)] * (value is not None)


@pytest.mark.parametrize(
    ("elasticity", "told"),
    [
        ('young="5" damping="0.001"', [("young", "5000")]),
        ('young="1e4" damping="0.001"', []),
        ('young="1e4" damping="1"', [("damping", "0.01")]),
        ('young="1e13"', []),
    ],
    ids=["lands-late", "holds", "damped-too-much", "too-stiff"],
)
def test_a_large_soft_body_is_watched_until_it_lies_and_its_damping_where_it_bursts(elasticity, told):
    gel = f"""<flexcomp name="gel" type="grid" count="4 4 4" spacing="0.04 0.04 0.04" pos="0 0 0.3" dim="3" mass="0.8"
        radius="0.005"><elasticity {elasticity} poisson="0.3"/><contact selfcollide="none"/></flexcomp>"""
    floor = '<geom type="plane" size="1 1 0.1"/>'
    text = f'<mujoco><option timestep="0.0005"/><worldbody>{floor}{gel}</worldbody></mujoco>'
    assert [(each.attribute, each.value) for each in hints(text, "flex-falls-apart")] == told


CLOTH = """<mujoco><worldbody><geom name="post" type="capsule" size="0.1 0.2" pos="0 0 0.3"/>
<flexcomp name="tarp" type="grid" dim="2" count="5 5 1" spacing="0.1 0.1 0.1" pos="0 0 {}" radius="0.01" mass="0.4">
<edge equality="true"/>{}</flexcomp></worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("height", "more", "told"),
    [("0.52", "", ["0 0 0.611"]), ("0.62", "", []), ("0.59", "", []), ("0.52", '<pin id="0"/>', [])],
    ids=["through-the-post", "above", "a-little-inside", "pinned"],
)
def test_a_cloth_that_begins_around_a_post_is_raised(height: str, more: str, told: list[str]) -> None:
    assert [each.value for each in hints(CLOTH.format(height, more), "flex-begins-inside")] == told


@pytest.mark.parametrize(
    ("name", "mass", "load", "told"),
    [
        pytest.param("pallet", 'mass="9"', "<freejoint/>", True, id="a pallet"),
        pytest.param("pallet", "", "<freejoint/>", False, id="without a mass"),
        pytest.param("pallet", 'mass="9"', "", False, id="under what is fixed too"),
        pytest.param("table", 'mass="9"', "<freejoint/>", False, id="a table"),
    ],
)
def test_a_pallet_that_carries_something_free_and_has_no_joint_is_told(name, mass, load, told):
    boards = "".join(f'<geom type="box" size=".4 .05 .05" pos="0 {y} 0" {mass}/>' for y in (-0.3, 0, 0.3))
    crate = f'<body pos="0 0 .149">{load}<geom type="box" size=".2 .4 .1" mass="9"/></body>'
    car = '<body pos="2 0 .5"><joint type="slide"/><geom size=".1"/></body>'
    floor = '<geom type="plane" size="5 5 .1"/>'
    text = (
        f'<mujoco><worldbody>{floor}<body name="{name}" pos="0 0 .05">{boards}</body>{crate}{car}</worldbody></mujoco>'
    )
    assert [each.elements for each in hints(text, "object-without-joint")] == [('body "pallet"',)] * told


@pytest.mark.parametrize(
    ("rail", "reach", "told"),
    [
        pytest.param("-2.2 0 .6 2.2 0 .6", "-200 200", "-2 2", id="cm"),
        pytest.param("-2.2 0 .6 2.2 0 .6", "-2000 2000", "-2 2", id="mm"),
        pytest.param("-2.2 0 .6 2.2 0 .6", "-2 2", None, id="m"),
        pytest.param("-2.2 0 .6 2.2 0 .6", "-1e5 1e5", None, id="endless"),
        pytest.param("-2.2 0 0 2.2 0 0", "-200 200", None, id="no rail beside it"),
        pytest.param("0 -2.2 .6 0 2.2 .6", "-200 200", None, id="across"),
    ],
)
def test_a_slide_whose_range_is_that_of_its_rail_in_cm_or_mm_is_told(rail: str, reach: str, told: str | None) -> None:
    text = (
        f'<mujoco><worldbody><geom name="rail" type="capsule" fromto="{rail}" size=".02"/><body pos="0 0 .6">'
        f'<joint name="slider" type="slide" axis="1 0 0" range="{reach}"/><geom type="box" size=".15 .1 .06"/></body>'
        '</worldbody><actuator><motor joint="slider"/></actuator></mujoco>'
    )
    assert [each.value for each in hints(text, "slides-out")] == ([told] if told else [])


@pytest.mark.parametrize(
    ("joints", "driven", "told"),
    [
        pytest.param("xz", True, 'type="hinge" axis="0 1 0"', id="no hinge"),
        pytest.param("xt", True, 'type="slide" axis="0 0 1"', id="no slide"),
        pytest.param("xzt", True, None, id="all three"),
        pytest.param("zt", True, None, id="on a boom"),
        pytest.param("xy", True, None, id="in another plane"),
        pytest.param("xz", False, None, id="nothing drives the legs"),
    ],
)
def test_a_robot_in_a_plane_that_lacks_a_joint_of_its_root_is_told(joints: str, driven: bool, told: str | None):
    kinds = {"x": 'type="slide" axis="1 0 0"', "z": 'type="slide" axis="0 0 1"', "t": 'axis="0 1 0"'}
    kinds["y"] = 'type="slide" axis="0 1 0"'
    root = "".join(f"<joint {kinds[each]}/>" for each in joints)
    legs = "".join(f'<body><joint name="{i}" axis="0 1 0"/><geom size="0.1" pos="0 0 -1"/></body>' for i in range(2))
    motors = '<motor joint="0"/><motor joint="1"/>' * driven
    text = f'<mujoco><worldbody><body pos="0 0 3">{root}<geom size="0.1"/>{legs}</body></worldbody>'
    found = hints(f"{text}<actuator>{motors}</actuator></mujoco>", "planar-root-incomplete")
    assert [each.value for each in found] == [f"<joint {told}/>"] * bool(told)


@pytest.mark.parametrize("legs", [1, 2])
def test_a_hopper_on_a_boom_has_one_leg_and_does_not_turn(legs: int):
    thigh = '<body><joint name="{0}" axis="0 1 0"/><geom size=".1" pos="0 0 -1"/>{1}</body>'
    shins = [thigh.format(f"{i}knee", "") for i in range(legs)]
    below = "".join(thigh.format(f"{i}hip", shin) for i, shin in enumerate(shins))
    motors = "".join(f'<motor joint="{i}{at}"/>' for i in range(legs) for at in ("hip", "knee"))
    root = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><geom size=".1"/>'
    text = (
        f'<mujoco><worldbody><body pos="0 0 3">{root}{below}</body></worldbody><actuator>{motors}</actuator></mujoco>'
    )
    assert len(hints(text, "planar-root-incomplete")) == legs - 1


@pytest.mark.parametrize(
    ("more", "told"),
    [("", True), ('<geom type="box" size="1 1 0.1" pos="0 0 0.1"/>', False), ("<camera/>", False)],
    ids=["alone", "beside a table", "to be looked at"],
)
def test_a_thing_that_hangs_alone_above_the_floor_is_told(more: str, told: bool) -> None:
    ball = '<geom type="plane" size="2 2 1"/><geom size="0.1" pos="0 0 1"/>'
    model = f"<mujoco><worldbody>{ball}{more}</worldbody></mujoco>"
    assert [each.level for each in findings(model, "nothing-can-move")] == ["cause"] * told


@pytest.mark.parametrize(
    ("foot", "more", "told"),
    [
        ('name="foot"', "", "0 0 -0.3"),
        ('name="foot" pos="0 0 -0.3"', "", None),
        ('name="knee"', "", None),
        ('name="foot"', '<body name="toes" pos="0 0 -0.3"><joint/><geom size="0.02"/></body>', None),
    ],
    ids=["at the knee", "at the end", "a knee", "beside toes"],
)
def test_a_foot_at_the_knee_is_told(foot: str, more: str, told: str | None) -> None:
    shin = '<geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>'
    body = f'<body pos="0 0 1"><joint axis="0 1 0"/>{shin}<geom size="0.04" {foot}/>{more}</body>'
    found = hints(f"<mujoco><worldbody>{body}</worldbody></mujoco>", "foot-at-the-joint")
    assert [each.value for each in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("floor", "told"),
    [
        ('name="floor" type="box" size="0.2 3 0.05"', "3.36603 3.36603 0.05"),
        ('name="floor" type="box" size="0.2 0.2 0.05"', "3.36603 3.36603 0.05"),
        ('name="floor" type="box" size="3 3 0.05"', None),
        ('name="table" type="box" size="0.1 0.1 0.05"', None),
        ('name="floor" type="plane" size="0.1 0.1 0.05"', None),
    ],
)
def test_a_floor_that_a_robot_steps_off_is_told(floor: str, told: str | None) -> None:
    head = '<body pos="0 0 0.25"><joint/><geom type="box" size="0.05 0.05 0.05"/></body>'
    robot = f'<body pos="0 0 0.45"><freejoint/><geom type="box" size="0.1 0.1 0.2"/>{head}</body>'
    model = f'<mujoco><worldbody><geom {floor} pos="0 0 -0.05"/>{robot}</worldbody></mujoco>'
    assert [each.value for each in hints(model, "floor-too-small")] == ([told] if told else [])
