"""Arms of a data sheet, equality constraints that are off, doors that do not open."""

from __future__ import annotations

import re

import pytest
from clinic.diagnosis.diagnose import Diagnosis, examine
from clinic.diagnosis.edit import apply
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules

UR5E = rules()["arm-unlike-data-sheet"].example("Good")
TIED = """
<mujoco>
  <worldbody>
    <body name="arm" pos="0 0 1">
      <joint name="lift" type="slide" axis="0 0 1" damping="5"/>
      <geom type="box" size="0.05 0.05 0.02" contype="0" conaffinity="0"/>
    </body>
    <body name="tool" pos="0 0 {height}">
      <freejoint/>
      <geom type="sphere" size="0.02"/>
    </body>
  </worldbody>
  <equality>
    <weld body1="arm" body2="tool" active="false" relpose="0 0 -0.08 1 0 0 0"/>
  </equality>
</mujoco>
"""
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


def found(text: str, rule: str) -> list[str]:
    """What a rule says of a model, and that its edits unsay it."""
    told: Diagnosis = examine(NativeEngine(), {"model.xml": text}, select=[rule])
    return [each.says for each in (*told.causes, *told.hints)]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("0.425 -0.131 0", "0.435 -0.131 0"), "mm; of ur5e it is 425 mm"),
        (("0 0 -0.0997", "0 0 -0.0946"), "is 94.6 mm; of ur5e it is 99.7 mm"),
        (('name="wrist_2" axis="0 0 -1"', 'name="wrist_2" axis="0 0 1"'), "turns about z as the arm stands at 0"),
        (('mass="8.058"', 'mass="7.358"'), "It is what those of ur5 weigh."),
    ],
)
def test_a_length_or_an_axis_of_an_arm_that_is_sold_is_told(change, says):
    assert change[0] in UR5E
    (told,) = found(UR5E.replace(*change), "arm-unlike-data-sheet")
    assert says in told


@pytest.mark.parametrize(
    "change",
    [
        ("0 0 -0.0997", "0 0 -0.099"),  # rounded
        ('model="ur5e"', 'model="my arm"'),
        ('model="ur5e"', 'model="ur5ex"'),
        ('axis="0 1 0"', 'axis="0 -1 0"'),  # the frames of all are turned
        ("0.425 -0.131 0", "0.435 -0.133 0.02"),  # with what follows, another arm
    ],
)
def test_an_arm_within_its_data_sheet_and_one_of_another_name_are_let_be(change):
    text = UR5E.replace(*change)
    if "0.02" in change[1]:
        text = text.replace("0 0 -0.0997", "0 0 -0.2").replace("0.3922 0 0", "0.5 0 0.1")
    assert found(text, "arm-unlike-data-sheet") == []


def test_the_arm_may_stand_on_another_place_and_be_turned():
    turned = UR5E.replace(
        '<body name="shoulder" pos="0 0 0.1625">', '<body name="shoulder" pos="1 2 0.5" euler="0 90 30">'
    )
    assert found(turned.replace("0 0 -0.0997", "0 0 -0.0946"), "arm-unlike-data-sheet") != []


def test_a_weld_that_is_off_is_told_where_its_parts_stand_as_if_it_held():
    assert found(TIED.format(height="0.92"), "switched-off") != []
    assert found(TIED.format(height="0.5"), "switched-off") == []


@pytest.mark.parametrize(
    ("resists", "told"),
    [('damping="1000"', 1), ('frictionloss="200"', 1), ('damping="20"', 0), ('frictionloss="20"', 0), ("", 0)],
)
def test_a_door_that_a_push_does_not_open_is_told(resists, told):
    assert len(found(DOOR.format(resists=resists), "joint-frozen")) == told


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
    assert bool(found(PLANAR.format(hip=0, ankle=0, one=one, other=other), "excluded-pair")) is told


@pytest.mark.parametrize(("hip", "ankle", "told"), [(0, 90, True), (90, 90, False), (0, 60, False)])
def test_the_one_spring_that_rests_beyond_its_range_is_told(hip, ankle, told):
    text = PLANAR.format(hip=hip, ankle=ankle, one="thigh", other="torso")
    assert bool(found(text, "spring-far-off")) is told


FOURBAR = """
<mujoco>
  <worldbody>
    <body name="crank" pos="0 0 1">
      <joint name="crank" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 0.1" size="0.01"/>
      <body name="coupler" pos="0 0 0.1">
        <joint name="coupler" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01"/>
      </body>
    </body>
    <body name="rocker" pos="0.3 0 1">
      <joint name="rocker" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 0.1" size="0.01"/>
    </body>
  </worldbody>
  <equality>
    <connect name="loop" body1="coupler" body2="rocker" anchor="0.3 0 0"/>
  </equality>
</mujoco>
"""


@pytest.mark.parametrize(("free", "told"), [("", ['equality "loop"']), ("<freejoint/>", [])])
def test_a_loop_between_two_links_of_the_world_that_is_off_is_told_and_a_latch_is_not(free, told):
    off = FOURBAR.replace('anchor="0.3 0 0"', 'anchor="0.3 0 0" active="false"')
    off = off.replace('<joint name="rocker" axis="0 1 0"/>', free or '<joint name="rocker" axis="0 1 0"/>')
    found = examine(NativeEngine(), {"model.xml": off}, select=["switched-off"])
    assert [each.elements[0] for each in found.hints] == told


@pytest.mark.parametrize("eye", ["0.3 0 0", "0.2 0 0.1"])
def test_a_swing_that_carries_a_loop_is_not_locked_by_it_though_it_begins_apart(eye):
    swing = '<body><joint name="swing" axis="0 0 1"/><geom size="0.05"/>'
    text = FOURBAR.replace("<worldbody>", f"<worldbody>{swing}").replace("</worldbody>", "</body></worldbody>")
    text = text.replace('anchor="0.3 0 0"', 'site1="eye" site2="lug"').replace('body1="coupler" body2="rocker" ', "")
    text = text.replace('<joint name="coupler"', f'<site name="eye" pos="{eye}"/><joint name="coupler"')
    text = text.replace('<joint name="rocker"', '<site name="lug" pos="0.1 0 0.1"/><joint name="rocker"')
    driven = '<actuator><velocity joint="swing" kv="1" ctrlrange="-3 3"/></actuator></mujoco>'
    found = examine(NativeEngine(), {"model.xml": text.replace("</mujoco>", driven)}, select=["loop-locked"])
    assert not found.hints


def test_the_hinge_across_all_others_is_named_where_a_loop_locks():
    driven = '<actuator><velocity joint="crank" kv="1" ctrlrange="-3 3"/></actuator></mujoco>'
    text = FOURBAR.replace("</mujoco>", driven)
    across = text.replace('name="rocker" axis="0 1 0"', 'name="rocker" axis="0 0 1"')
    assert across != text
    locked = [each for each in examine(NativeEngine(), {"model.xml": across}).hints if each.rule == "loop-locked"]
    assert [(each.attribute, each.value) for each in locked] == [("axis", "0 1 0")]
    assert locked[0].elements == ('joint "crank"', 'equality "loop"', 'joint "rocker"')
    assert "loop-locked" not in [each.rule for each in examine(NativeEngine(), {"model.xml": text}).hints]


@pytest.mark.parametrize(("mass", "told"), [(50, True), (1, False)])
def test_a_weld_that_a_load_pulls_apart_is_told(mass, told):
    text = f"""
<mujoco>
  <worldbody>
    <body name="hook" pos="0 0 2"><geom size="0.05"/></body>
    <body name="ball" pos="0 0 1.8">
      <freejoint/>
      <geom size="0.05" mass="0.1"/>
      <site name="below"/>
    </body>
    <body pos="0 0 1.2">
      <joint type="slide" axis="0 0 1" damping="20"/>
      <geom size="0.1" mass="{mass}"/>
      <site name="load"/>
    </body>
  </worldbody>
  <tendon>
    <spatial stiffness="1000" damping="1"><site site="below"/><site site="load"/></spatial>
  </tendon>
  <equality>
    <weld body1="hook" body2="ball"/>
  </equality>
</mujoco>
"""
    says = found(text, "soft-equality")
    assert [" apart where the equality holds them together" in each for each in says] == [True] * told


@pytest.mark.parametrize(
    ("hand", "told"),
    [
        ('<body name="hand"><geom size="0.02"/></body>', True),
        ('<body name="hand" euler="0 0 0"><geom size="0.02"/></body>', True),
        ('<body name="hand"><geom size="0.02" pos="0 0.1 0"/></body>', False),
        (
            '<body name="hand" pos="0 0.1 0"><geom size="0.02"/></body><body name="imu"><geom size="0.01"/></body>',
            False,
        ),
        ('<body name="skin"><geom size="0.02" contype="0" conaffinity="0"/></body>', False),
    ],
    ids=["at the origin", "with a turn", "drawn at the site", "at the site", "only seen"],
)
def test_a_tool_that_is_not_at_the_site_for_it_is_told(hand: str, told: bool) -> None:
    site = '<site name="attachment_site" pos="0 0.1 0" quat="-1 1 0 0"/>'
    wrist = f'<body name="wrist"><joint axis="0 1 0"/><geom size="0.04"/>{site}{hand}</body>'
    text = f"<mujoco><worldbody>{wrist}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["mount-off-its-site"]).hints
    assert [each.elements[0] for each in found] == ['body "hand"'] * told
    for each in found:
        edited = apply({"model.xml": text}, each.edit)
        assert NativeEngine().compile(edited["model.xml"], {}).count("body") == 3


@pytest.mark.parametrize(
    ("axis", "shin", "told"),
    [
        pytest.param("0 1 0", "0 0 -0.4", True, id="across"),
        pytest.param("1 0 0", "0 0 -0.4", False, id="as it should"),
        pytest.param("0 1 0", "0 0.4 -0.1", False, id="a thigh that stands off, as a spider's"),
    ],
)
def test_a_knee_that_swings_its_shin_sideways_is_told(axis: str, shin: str, told: bool) -> None:
    bad = rules()["knee-turns-sideways"].example("Bad")
    text = bad.replace('_knee" axis="0 1 0"', f'_knee" axis="{axis}"').replace('pos="0 0 -0.4"', f'pos="{shin}"')
    found = examine(NativeEngine(), {"model.xml": text}).hints
    knees = [each for each in found if each.rule == "knee-turns-sideways"]
    assert bool(knees) is told
    if knees:
        assert knees[0].elements == ('joint "left_knee"', 'joint "right_knee"')
        assert knees[0].value == "1 0 0"


@pytest.mark.parametrize(("place", "told"), [("0.35 0 1", False), ("0.9 0.3 1", True)])
def test_a_cable_that_does_not_reach_what_it_is_connected_to_is_told(place: str, told: bool) -> None:
    text = f"""<mujoco><worldbody>
      <body name="first" pos="0 0 1"><geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.01"/>
        <body name="end" pos="0.15 0 0"><joint axis="0 1 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.01"/></body></body>
      <body name="box" pos="{place}"><geom type="box" size="0.05 0.05 0.05"/></body></worldbody>
    <equality><connect body1="box" body2="end" anchor="-0.05 0 0"/></equality></mujoco>"""
    found = [each for each in examine(NativeEngine(), {"model.xml": text}).hints if each.rule == "anchor-far-off"]
    assert bool(found) is told
    assert not found or 'Put body "end" where it is to be held' in found[0].says


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
    assert bool(examine(NativeEngine(), {"model.xml": text}, select=["wheel-not-round"]).hints) is told


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
    found = examine(NativeEngine(), {"model.xml": text}, select=["object-without-joint"]).hints
    assert [each.elements for each in found] == [(f'body "{name}"',)] * told
    for each in found:
        mended = apply({"model.xml": text}, each.edit)["model.xml"]
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
    found = examine(NativeEngine(), {"model.xml": text}, select=["object-without-joint"]).hints
    assert [each.elements for each in found] == [('body "chip"',)] * told


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
    found = examine(NativeEngine(), {"model.xml": text}, select=["object-without-joint"]).hints
    assert [(each.elements, each.value) for each in found] == [(('joint "root"',), "free")] * told
    for each in found:
        assert not examine(NativeEngine(), apply({"model.xml": text}, each.edit), select=["object-without-joint"]).hints


@pytest.mark.parametrize(
    ("joint", "actuator", "told"),
    [
        pytest.param('name="slider" range="-1 1"', "pull", True, id="joint"),
        pytest.param('name="cart" range="-1 1"', "slide", True, id="actuator"),
        pytest.param('name="slider" type="slide" range="-1 1"', "slide", False, id="slide"),
        pytest.param('name="slider_crank" type="hinge"', "crank", False, id="hinge"),
        pytest.param('name="cart"', "pull", False, id="other-names"),
    ],
)
def test_a_hinge_that_is_called_a_slide_is_told(joint: str, actuator: str, told: bool) -> None:
    cart = f'<body name="cart"><joint {joint} axis="1 0 0"/><geom size="0.1"/></body>'
    motor = f'<motor name="{actuator}" joint="{joint.split(chr(34))[1]}"/>'
    text = f"<mujoco><worldbody>{cart}</worldbody><actuator>{motor}</actuator></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["hinge-for-slide"]).hints
    assert [(each.attribute, each.value) for each in found] == [("type", "slide")] * told


@pytest.mark.parametrize(
    ("ends", "told"),
    [("ram ram ram", [("class", "ram")]), ("ram ram pin", []), ("1 2 3", [("type", "slide")])],
    ids=["of-its-name", "of-another-name", "left-out"],
)
def test_the_one_hinge_among_slides_of_its_name_gets_their_class(ends: str, told: list[tuple[str, str]]) -> None:
    joints = [f"{part}_{end}" for part, end in zip(("boom", "stick", "bucket"), ends.split(), strict=True)]
    kinds = ["pin" if "ram" in ends else "free", "ram", "ram"]
    bodies = "".join(
        f'<body pos="{i} 0 0"><joint name="{name}" class="{kind}" range="-0.04 0.05"/><geom size="0.1"/></body>'
        for i, (name, kind) in enumerate(zip(joints, kinds, strict=True))
    ).replace(' class="free"', "")
    classes = (
        '<default class="pin"><joint type="hinge" axis="0 1 0"/></default><default class="ram"><joint type="slide"/>'
    )
    driven = "".join(f'<position joint="{name}" kp="10" kv="1"/>' for name in joints)
    text = (
        f'<mujoco><compiler angle="radian"/><default>{classes}</default></default><worldbody>{bodies}</worldbody>'
        f"<actuator>{driven}</actuator></mujoco>"
    )
    found = examine(NativeEngine(), {"model.xml": text}, select=["hinge-for-slide", "range-in-the-wrong-unit"])
    assert [(each.attribute, each.value) for each in found.hints] == told


@pytest.mark.parametrize(
    ("young", "value"), [("30", "30000"), ("3e4", None)], ids=["in-kilopascal", "that-keeps-its-shape"]
)
def test_a_soft_body_that_goes_flat_is_told(young: str, value: str | None) -> None:
    foam = f"""<flexcomp name="foam" type="grid" count="3 3 3" spacing="0.07 0.07 0.07" pos="0 0 0.09" dim="3"
        mass="1.2" radius="0.012"><elasticity young="{young}" poisson="0.2" damping="0.02"/>
        <contact solref="0.01 1" selfcollide="none"/></flexcomp>"""
    floor = '<geom type="plane" size="1 1 0.1"/>'
    text = f'<mujoco><option timestep="0.002"/><worldbody>{floor}{foam}</worldbody></mujoco>'
    found = examine(NativeEngine(), {"model.xml": text}, select=["flex-falls-apart"]).hints
    assert [(each.attribute, each.value) for each in found] == [("young", value)] * (value is not None)


@pytest.mark.parametrize(
    ("axis", "links", "attribute"),
    [
        pytest.param("", 4, "type", id="left-out"),
        pytest.param('axis="0 0 1"', 4, "axis", id="written"),
        pytest.param('axis="0 1 0"', 4, None, id="across"),
        pytest.param("", 2, None, id="two"),
    ],
)
def test_a_chain_whose_hinges_are_on_one_line_is_told(axis: str, links: int, attribute: str | None) -> None:
    text = ""
    for each in range(links):
        shape = '<geom type="capsule" fromto="0 0 0 0 0 -0.1" size="0.01"/>'
        text = f'<body name="b{each}" pos="0 0 -0.1"><joint name="j{each}" {axis}/>{shape}{text}</body>'
    text = f"<mujoco><worldbody>{text}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["joints-on-one-line"]).hints
    assert [each.attribute for each in found] == [attribute] * (attribute is not None)
    if attribute == "type":
        assert 'type="ball"' in apply({"model.xml": text}, found[0].edit)["model.xml"]


@pytest.mark.parametrize(
    ("names", "axes", "told"),
    [
        (("roll", "pitch"), ("1 0 0", "1 0 0"), ('joint "pitch"', "0 1 0")),
        (("roll", "pitch"), ("0 1 0", "0 1 0"), ('joint "roll"', "1 0 0")),
        (("roll", "pitch"), ("1 0 0", "0 1 0"), None),
        (("waist_yaw", "head_pan"), ("0 0 1", "0 0 1"), None),
        (("base", "turret"), ("0 0 1", "0 0 1"), None),
    ],
    ids=["inner", "outer", "two axes", "one turn", "no turns"],
)
def test_two_rings_whose_names_say_two_turns_do_not_turn_about_one_line(names, axes, told):
    outer, inner = (
        f'<joint name="{name}" axis="{axis}"/><geom size="0.1"/>' for name, axis in zip(names, axes, strict=True)
    )
    text = f"<mujoco><worldbody><body pos='0 0 1'>{outer}<body>{inner}</body></body></worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["joints-on-one-line"]).hints
    assert [(each.elements[0], each.value) for each in found] == ([told] if told else [])
    for each in found:
        assert not examine(NativeEngine(), apply({"model.xml": text}, each.edit), select=["joints-on-one-line"]).hints


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
    found = examine(NativeEngine(), {"model.xml": text}, select=["axle-against-itself"]).hints
    assert [each.value for each in found] == values


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
    found = examine(NativeEngine(), {"model.xml": text}, select=["axle-against-itself"]).hints
    assert [each.value for each in found] == [f"0 {-factor} 0.1 0 0"] * told


@pytest.mark.parametrize(
    ("sites", "values"),
    [
        pytest.param('<site name="slot1" pos="-0.04 0 0.01"/><site name="slot2" pos="-0.04 0 0.01"/>', ["0.04 0 0.01"]),
        pytest.param('<site name="slot1" pos="-0.04 0 0.01"/><site name="slot2" pos="0.04 0 0.01"/>', []),
        pytest.param('<site name="target0"/><site name="target1"/>', []),  # code puts them somewhere
        pytest.param('<site name="grasp" pos="0.1 0 0"/><site name="tool" pos="0.1 0 0"/>', []),
        pytest.param(
            '<site name="ray1" pos="0.1 0 0" zaxis="1 0 0"/><site name="ray2" pos="0.1 0 0" zaxis="1 1 0"/>', []
        ),
        pytest.param("".join(f'<site name="pin{i}" pos="{x} 0 0"/>' for i, x in enumerate((0.1, 0.1, 0.3))), []),
    ],
)
def test_numbered_sites_of_one_body_in_one_place_are_told(sites: str, values: list[str]) -> None:
    names = re.findall('name="(.*?)"', sites)
    sensors = "".join(f'<framepos objtype="site" objname="{name}"/>' for name in names)
    tray = f'<worldbody><body name="tray"><geom size="0.1"/>{sites}</body></worldbody>'
    text = f"<mujoco>{tray}<sensor>{sensors}</sensor></mujoco>"
    assert not examine(NativeEngine(), {"model.xml": f"<mujoco>{tray}</mujoco>"}, select=["parts-coincide"]).hints
    found = examine(NativeEngine(), {"model.xml": text}, select=["parts-coincide"]).hints
    assert [each.value for each in found] == values


@pytest.mark.parametrize(("place", "told"), [("0 0 -16", ["0 0 -0.16"]), ("0 0 -0.16", []), ("0 0 -3", [])])
def test_a_small_link_that_is_far_from_another_is_told_on_a_long_mechanism(place: str, told: list[str]) -> None:
    camera = f'<body pos="{place}"><joint axis="0 1 0"/><geom size="0.15"/></body>'
    yoke = f'<body pos="2 0 0"><joint axis="0 0 1"/><geom size="0.1"/>{camera}</body>'
    jib = f'<body pos="0 0 1"><joint axis="0 1 0"/><geom type="box" size="1 0.1 0.1" pos="1 0 0"/>{yoke}</body>'
    text = f"<mujoco><worldbody>{jib}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["link-far-off"]).hints
    assert [each.value for each in found] == told


@pytest.mark.parametrize(
    ("rest", "told"), [("-0.02", "0.02"), ("0.02", None), ("0", None)], ids=["towards the load", "against it", "none"]
)
def test_a_spring_that_rests_on_the_side_of_its_load_gets_the_other_sign(rest: str, told: str | None) -> None:
    slide = f'<joint type="slide" axis="0 0 1" range="-0.05 0.05" stiffness="2000" damping="180" springref="{rest}"/>'
    load = f'<body name="load" pos="0 0 1">{slide}<geom size="0.1" mass="4"/></body>'
    text = f"<mujoco><worldbody>{load}</worldbody></mujoco>"
    found = examine(NativeEngine(), {"model.xml": text}, select=["spring-at-its-stop"]).hints
    assert [(each.attribute, each.value) for each in found] == ([("springref", told)] if told else [])


@pytest.mark.parametrize(
    ("site", "euler", "more", "told"),
    [
        pytest.param("tip", "0 -40 0", "", None, id="inside"),
        pytest.param("axle", "0 -40 0", "", ("site", "tip"), id="another site"),
        pytest.param("tip", "0 40 0", "", ("euler", "0 -40 0"), id="another sign"),
        pytest.param("axle", "0 -40 0", '<site name="end" pos="-1.8 0 0"/>', None, id="two sites would do"),
        pytest.param("far", "0 -40 0", "", None, id="nothing does"),
    ],
)
def test_the_one_thing_that_brings_a_tendon_into_its_range_is_told(
    site: str, euler: str, more: str, told: tuple[str, str] | None
) -> None:
    text = f"""<mujoco><worldbody><geom type="plane" size="9 9 1"/><site name="axle" pos="0 0 1.5"/>
      <body pos="0 0 1.5" euler="{euler}"><joint name="axle" axis="0 1 0" damping="1"/><site name="tip" pos="-1.9 0 0"/>
        <geom type="capsule" fromto="0 0 0 -1.9 0 0" size="0.03" contype="0"/>{more}</body>
      <body pos="-0.6 0 0.075"><freejoint/><geom size="0.075" mass="3"/><site name="pouch"/></body>
      <body pos="0 0 2"><site name="far" pos="0 4 0"/></body></worldbody>
      <tendon><spatial name="sling" range="0 1.02" limited="true"><site site="{site}"/><site site="pouch"/></spatial>
      {'<spatial><site site="far"/><site site="tip"/></spatial>' if site == "far" else ""}</tendon></mujoco>"""
    found = examine(NativeEngine(), {"model.xml": text}, select=["tendon-outside-range"]).hints
    assert [(each.attribute, each.value) for each in found if each.attribute != "range"] == ([told] if told else [])


LOOP = rules()["loop-not-assembled"].example("Good")
STANDING = LOOP.replace("<worldbody>", '<worldbody><geom size="0.1" pos="0 0 1"/>')
TURNED = LOOP.replace('"rocker" pos="0.5 0 1"', '"rocker" pos="0.5 0 1" euler="0 90 0"').replace(
    '"-0.3 0 0"', '"0 0 -0.3"'
)


@pytest.mark.parametrize(
    ("text", "right", "wrong", "told"),
    [
        (LOOP, '"-0.3 0 0"', '"0.3 0 0"', ('site "hole"', "pos", "-0.3 0 0")),
        (STANDING, '"0.5 0 1"', '"0.5 1 0"', ('body "rocker"', "pos", "0.5 0 1")),
        (LOOP, '"0.5 0 1"', '"-0.5 0 1"', ('body "rocker"', "pos", "0.5 0 1")),
        (LOOP, '"-0.3 0 0"', '"-0.2 0 0"', ('site "pin"', "pos", "-0.3 0 0")),
        (TURNED, ' euler="0 90 0"', "", ('site "hole"', "pos", "-0.3 0 0")),
        (
            TURNED.replace("0 90 0", "0 60 0").replace('"0 0 -0.3"', '"-0.15 0 -0.259808"'),
            ' euler="0 60 0"',
            "",
            ('body "rocker"', "quat", "0.866025 0 0.5 0"),
        ),
    ],
    ids=["a site's sign", "exchanged", "a body's sign", "another length", "another axis", "orientation left out"],
)
def test_a_loop_that_a_slip_of_the_pen_opens_is_closed_there(text, right, wrong, told):
    assert text.count(right) == 1
    broken = {"model.xml": text.replace(right, wrong)}
    (found,) = examine(NativeEngine(), broken, select=["loop-not-assembled"]).hints
    assert (found.elements[0], found.attribute, found.value) == told
    assert not examine(NativeEngine(), apply(broken, found.edit), select=["loop-not-assembled"]).hints
    assert not examine(NativeEngine(), {"model.xml": text}, select=["loop-not-assembled"]).hints


@pytest.mark.parametrize(
    ("left", "right", "out", "told"),
    [
        (0.03, -0.03, -1, None),
        (0.03, 0.03, -1, ('body "fin_r"', "0 -0.03 0")),
        (-0.03, -0.03, -1, ('body "fin_l"', "0 0.03 0")),
        (0, 0, -1, None),
        (0.03, 0.03, 1, None),
    ],
    ids=["on both sides", "both on the left", "both on the right", "in the middle", "no images"],
)
def test_twins_in_one_place_whose_geoms_are_mirror_images_are_told(left, right, out, told):
    fins = "".join(
        f'<body name="fin_{side}" pos="0 {y} 0"><joint/><geom type="box" size=".01 .02 .01" pos="0 {way * 0.02} 0" '
        'contype="0"/></body>'
        for side, y, way in (("l", left, 1), ("r", right, out))
    )
    text = {"fish.xml": f"<mujoco><worldbody><body><freejoint/><geom size='.03'/>{fins}</body></worldbody></mujoco>"}
    found = examine(NativeEngine(), text, select=["parts-coincide"]).hints
    assert [(each.elements[0], each.value) for each in found] == ([told] if told else [])
    for each in found:
        assert not examine(NativeEngine(), apply(text, each.edit), select=["parts-coincide"]).hints


@pytest.mark.parametrize(
    ("name", "coefficients", "axis", "told"),
    [
        ("antiroll", (1, 1), "0 0 1", ('tendon "antiroll_f"', "-1")),
        ("bar", (1, 1), "0 0 1", ('tendon "bar_f"', "the same sign in both")),
        ("antiroll", (1, -1), "0 0 1", None),
        ("antiroll", (1, 1), "0 0 -1", None),
        ("antiroll", (2, 2), "0 0 1", None),
        ("bar", (1, 1), "rear", None),
    ],
    ids=["a bar against roll", "any", "alike", "the axis is turned", "other coefficients", "over the same two"],
)
def test_a_tendon_that_adds_left_and_right_beside_one_that_does_not_is_told(name, coefficients, axis, told):
    wheels = "".join(
        f'<body pos="{x} {y} 0"><joint name="{side}_susp" type="slide" axis="{axis if side == "fr" else "0 0 1"}"/>'
        '<geom size="0.1"/></body>'
        for side, x, y in (("fl", 1, 1), ("fr", 1, -1), ("rl", -1, 1), ("rr", -1, -1))
    )
    front, rear = (
        f'<fixed name="{name}_{end}" stiffness="9"><joint joint="{end}l_susp" coef="{a}"/>'
        f'<joint joint="{end}r_susp" coef="{b}"/></fixed>'
        for end, (a, b) in (("f", coefficients), ("r", (1, -1)))
    )
    front = front.replace('joint="f', 'joint="r') if axis == "rear" else front
    text = {"car.xml": f"<mujoco><worldbody>{wheels}</worldbody><tendon>{front}{rear}</tendon></mujoco>"}
    text["car.xml"] = text["car.xml"].replace('axis="rear"', 'axis="0 0 1"')
    found = examine(NativeEngine(), text, select=["tendon-unlike-siblings"]).hints
    assert [(each.elements[0], each.value) for each in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("second", "last", "half", "told"),
    [
        ("0.25 0 0.05", "0.2 0 0", 0.12, None),
        ("0.52 0 0.05", "0.2 0 0", 0.12, "0.25 0 0.05"),
        ("-0.23 0 0.05", "0.2 0 0", 0.05, "0.23 0 0.05"),
        ("0.6 0 0.05", "0.2 0 0", 0.12, None),
        ("0.52 0 0.05", "0.6 0 0", 0.12, None),
    ],
    ids=["well", "digits", "sign", "no slip", "two of them"],
)
def test_the_one_link_that_a_slip_puts_away_from_the_one_before_is_told(second, last, half, told):
    text = ""
    for place, size in ((last, 0.12), ("0.1 0 0", 0.12), (second, half), ("0 0 0.3", 0.12)):
        box = f'<geom type="box" size="{size} 0.05 0.03" pos="{size} 0 0.02"/>'
        text = f'<body pos="{place}"><joint/>{box}{text}</body>'
    base = f'<body name="base"><geom size="0.1" pos="0 0 0.2"/>{text}</body>'
    model = {"arm.xml": f"<mujoco><worldbody>{base}</worldbody></mujoco>"}
    found = examine(NativeEngine(), model, select=["link-off-the-end"]).hints
    assert [each.value for each in found] == ([told] if told else [])
    for each in found:
        assert not examine(NativeEngine(), apply(model, each.edit), select=["link-off-the-end"]).hints


@pytest.mark.parametrize(
    ("size", "more", "told"),
    [
        ("0.18 0.004 0.012", "", "0.09 0.004 0.012"),
        ("0.09 0.004 0.012", "", None),
        ("0.4 0.004 0.012", "", None),
        ("0.18 0.02 0.012", "", None),
        ("0.18 0.004 0.012", '<geom type="box" size="0.25 0.2 0.01"/>', None),
    ],
    ids=["full length", "half", "out with half, too", "of another width", "on a larger plate"],
)
def test_the_one_wall_that_sticks_out_of_a_maze_is_told(size: str, more: str, told: str | None) -> None:
    rim = "".join(
        f'<geom type="box" pos="{x} {y} 0.012" size="{half}"/>'
        for x, y, half in (
            (0, 0.146, "0.15 0.004 0.012"),
            (0, -0.146, "0.15 0.004 0.012"),
            (0.146, 0, "0.004 0.15 0.012"),
            (-0.146, 0, "0.004 0.15 0.012"),
        )
    )
    wall = f'<geom name="wall" type="box" pos="-0.05 0.05 0.012" size="{size}"/>'
    model = {"maze.xml": f"<mujoco><worldbody><body><joint/>{rim}{wall}{more}</body></worldbody></mujoco>"}
    found = examine(NativeEngine(), model, select=["full-lengths"]).hints
    assert [each.value for each in found] == ([told] if told else [])
