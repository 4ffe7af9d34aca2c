"""Welds, connections and loops that are off, that lock or that do not reach."""

from __future__ import annotations

import math

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import findings, hints

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


def test_a_weld_that_is_off_is_told_where_its_parts_stand_as_if_it_held():
    assert findings(TIED.format(height="0.92"), "switched-off") != []
    assert findings(TIED.format(height="0.5"), "switched-off") == []


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
    assert [each.elements[0] for each in hints(off, "switched-off")] == told


@pytest.mark.parametrize("eye", ["0.3 0 0", "0.2 0 0.1"])
def test_a_swing_that_carries_a_loop_is_not_locked_by_it_though_it_begins_apart(eye):
    swing = '<body><joint name="swing" axis="0 0 1"/><geom size="0.05"/>'
    text = FOURBAR.replace("<worldbody>", f"<worldbody>{swing}").replace("</worldbody>", "</body></worldbody>")
    text = text.replace('anchor="0.3 0 0"', 'site1="eye" site2="lug"').replace('body1="coupler" body2="rocker" ', "")
    text = text.replace('<joint name="coupler"', f'<site name="eye" pos="{eye}"/><joint name="coupler"')
    text = text.replace('<joint name="rocker"', '<site name="lug" pos="0.1 0 0.1"/><joint name="rocker"')
    driven = '<actuator><velocity joint="swing" kv="1" ctrlrange="-3 3"/></actuator></mujoco>'
    assert not hints(text.replace("</mujoco>", driven), "loop-locked")


def test_the_hinge_across_all_others_is_named_where_a_loop_locks():
    driven = '<actuator><velocity joint="crank" kv="1" ctrlrange="-3 3"/></actuator></mujoco>'
    text = FOURBAR.replace("</mujoco>", driven)
    across = text.replace('name="rocker" axis="0 1 0"', 'name="rocker" axis="0 0 1"')
    assert across != text
    locked = [each for each in hints(across) if each.rule == "loop-locked"]
    assert [(each.attribute, each.value) for each in locked] == [("axis", "0 1 0")]
    assert locked[0].elements == ('joint "crank"', 'equality "loop"', 'joint "rocker"')
    assert "loop-locked" not in [each.rule for each in hints(text)]


@pytest.mark.parametrize(
    ("welded", "load", "told"),
    [
        ("connect", "", []),
        ("weld", "", ['equality "3"']),
        ("connect", '<weld name="load" body1="plate" body2="load"/>', []),
    ],
    ids=["pins", "a-weld", "a-load"],
)
def test_the_one_strut_of_a_hexapod_that_is_welded_is_told(welded, load, told):
    struts, ends = "", ""
    for each in range(6):
        low, high = (math.radians(60 * (each // 2 * 2 + 1) + side * (2 * (each % 2) - 1)) for side in (50, 10))
        foot, head = (
            (0.25 * math.cos(low), 0.25 * math.sin(low), 0.0),
            (0.12 * math.cos(high), 0.12 * math.sin(high), 0.4),
        )
        way = [b - a for a, b in zip(foot, head, strict=True)]
        struts += f"""<body pos="{foot[0]} {foot[1]} 0" zaxis="{way[0]} {way[1]} {way[2]}">
          <joint axis="1 0 0"/><joint axis="0 1 0"/><geom size="0.01"/>
          <body name="rod{each}" pos="0 0 {math.hypot(*way)}"><joint name="{each}" type="slide"/>
            <geom size="0.01"/></body>
        </body>"""
        pin = "connect" if each != 3 else welded
        anchor = 'anchor="0 0 0"' if pin == "connect" else ""
        ends += f'<{pin} name="{each}" body1="rod{each}" body2="plate" {anchor}/>'
    plates = '<body name="plate" pos="0 0 0.4"><freejoint/><geom type="cylinder" size="0.15 0.01"/></body>'
    plates += '<body name="load" pos="0 0 0.6"><freejoint/><geom size="0.05"/></body>' if load else ""
    motors = "".join(f'<motor joint="{each}"/>' for each in range(6))
    text = f"""<mujoco><default><geom contype="0" conaffinity="0"/></default><worldbody>{struts}{plates}</worldbody>
      <equality>{ends}{load}</equality><actuator>{motors}</actuator></mujoco>"""
    assert [name for each in hints(text, "loop-locked") for name in each.elements] == told


@pytest.mark.parametrize("turned", ["", ' euler="0 0 90"'])
def test_a_link_of_a_locked_loop_that_has_no_joint_gets_one_like_the_others(turned):
    driven = '<actuator><velocity joint="crank" kv="1" ctrlrange="-3 3"/></actuator></mujoco>'
    text = FOURBAR.replace("</mujoco>", driven).replace('<joint name="coupler" axis="0 1 0"/>', "")
    text = text.replace('"coupler" pos="0 0 0.1"', f'"coupler" pos="0 0 0.1"{turned}')
    if turned:
        text = text.replace('fromto="0 0 0 0.3 0 0"', 'fromto="0 0 0 0 -0.3 0"').replace('"0.3 0 0"', '"0 -0.3 0"')
    (found,) = hints(text, "loop-locked")
    assert (found.elements[0], found.attribute) == ('body "coupler"', "joint")
    assert found.value == f'<joint type="hinge" axis="{"1 0 0" if turned else "0 1 0"}"/>'


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
    found = findings(text, "soft-equality")
    assert [" apart where the equality is to hold them together" in each.says for each in found] == [True] * told


@pytest.mark.parametrize(("place", "told"), [("0.35 0 1", False), ("0.9 0.3 1", True)])
def test_a_cable_that_does_not_reach_what_it_is_connected_to_is_told(place: str, told: bool) -> None:
    text = f"""<mujoco><worldbody>
      <body name="first" pos="0 0 1"><geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.01"/>
        <body name="end" pos="0.15 0 0"><joint axis="0 1 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.01"/></body></body>
      <body name="box" pos="{place}"><geom type="box" size="0.05 0.05 0.05"/></body></worldbody>
    <equality><connect body1="box" body2="end" anchor="-0.05 0 0"/></equality></mujoco>"""
    found = [each for each in hints(text) if each.rule == "anchor-far-off"]
    assert bool(found) is told
    assert not found or 'Put body "end" where it is to be held' in found[0].says


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ('anchor="0.3 0 0"', 'anchor="0.2 0 0"', ('equality "loop"', "anchor", "0.3 0 0")),
        ('anchor="0.3 0 0"', 'anchor="0 0 0.3"', ('equality "loop"', "anchor", "0.3 0 0")),
        ('"rocker" pos="0.3 0 1"', '"rocker" pos="-0.3 0 1"', ('body "rocker"', "pos", "0.3 0 1")),
        ('"rocker" pos="0.3 0 1"', '"rocker" pos="0.33 0 1"', ("", "", "")),
        ('body2="rocker"', 'body2="stub"', ('equality "loop"', "body2", "rocker")),
    ],
    ids=["short of the end", "exchanged", "a body's sign", "a little off", "the link before"],
)
def test_an_anchor_off_one_of_its_bodies_is_told_where_a_slip_says_why(right, wrong, told):
    text = FOURBAR.replace(
        '<body name="rocker"', '<body name="stub" pos="0.3 0 0.9"><geom size="0.01"/><body name="rocker"'
    )
    text = text.replace("    </body>\n  </worldbody>", "    </body></body>\n  </worldbody>")
    text = text.replace('"rocker" pos="0.3 0 1"', '"rocker" pos="0 0 0.1"') if "stub" in wrong else FOURBAR
    assert not hints(text, "anchor-far-off")
    found = hints(text.replace(right, wrong), "anchor-far-off")
    assert [(each.elements[0], each.attribute, each.value) for each in found] == [told] * bool(told[0])


LOOP = rules()["loop-not-assembled"].example("Good")
STANDING = LOOP.replace("<worldbody>", '<worldbody><geom size="0.1" pos="0 0 1"/>')
TURNED = LOOP.replace('"rocker" pos="0.5 0 1"', '"rocker" pos="0.5 0 1" euler="0 90 0"').replace(
    '"-0.3 0 0"', '"0 0 -0.3"'
)
FAR = (
    LOOP.replace('"0 0 0 0.15 0 0"', '"0 0 0 0 0 0.4"')
    .replace('"0.2 0 0"/>', '"0.3 0 0.1"/>')
    .replace('"-0.3 0 0"/>', '"-0.2 0 0.1"/>')
)
HELD = LOOP.replace("<connect", '<connect name="loop"').replace(
    "</worldbody>", '<site name="tip" pos="0.1 0 2"/></worldbody>'
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
        (
            LOOP.replace('"0.5 0 1"', '"0.5 0 0.9" euler="0 60 0"').replace('"-0.3 0 0"', '"-0.236603 0 -0.209808"'),
            ' euler="0 60 0"',
            ' euler="0 -60 0"',
            ('body "rocker"', "euler", "0 60 0"),
        ),
        (FAR, '"0.3 0 0.1"', '"0.1 0 0.3"', ('site "pin"', "pos", "0.3 0 0.1")),
        (HELD, 'site2="hole"', 'site2="tip"', ('equality "loop"', "site2", "hole")),
        (HELD, 'site1="pin"', 'site1="tip"', ('equality "loop"', "site1", "pin")),
        (HELD.replace("</body>", '<site name="eye" pos="0.2 0 0"/></body>', 1), 'site1="pin"', 'site1="tip"', None),
    ],
    ids=[
        "a site's sign",
        "exchanged",
        "a body's sign",
        "another length",
        "another axis",
        "orientation left out",
        "an orientation's sign",
        "exchanged as a turn would",
        "the second site",
        "the first site",
        "two sites in its place",
    ],
)
def test_a_loop_that_a_slip_of_the_pen_opens_is_closed_there(text, right, wrong, told):
    assert text.count(right) == 1
    broken = text.replace(right, wrong)
    (found,) = hints(broken, "loop-not-assembled")
    if told is None:
        assert "with this value" not in found.says
    else:
        assert (found.elements[0], found.attribute, found.value) == told
    assert not hints(text, "loop-not-assembled")


@pytest.mark.parametrize(
    ("coupling", "more", "told"),
    [
        pytest.param('joint1="bed" joint2="screw" polycoef="0 0.00125 0 0 0"', "", True, id="the bed follows"),
        pytest.param('joint1="screw" joint2="bed" polycoef="0 800 0 0 0"', "", False, id="the screw follows"),
        pytest.param('joint1="bed" joint2="screw" polycoef="0 0.00125 0 0 0"', 'gravcomp="1"', False, id="no load"),
        pytest.param(
            'joint1="bed" joint2="screw" polycoef="0 0.00125 0 0 0" solref="0.002 1" solimp="0.99999 0.999999 0.001"',
            "",
            False,
            id="a hard one",
        ),
    ],
)
def test_a_bed_that_sinks_off_its_lead_screw_gets_its_joints_exchanged(coupling: str, more: str, told: bool) -> None:
    text = f"""<mujoco><worldbody>
      <body {more}><joint name="bed" type="slide" axis="0 0 1" range="-0.1 0.1"/><geom size="0.06"/></body>
      <body pos="0.2 0 0"><joint name="screw" axis="0 0 1" damping="0.0001" armature="0.00002"/>
        <geom type="cylinder" size="0.004 0.2" density="7800"/></body>
      </worldbody><equality><joint name="nut" {coupling}/></equality>
      <actuator><position joint="screw" kp="2" kv="0.01"/></actuator></mujoco>"""
    found = hints(text, "soft-equality")
    wanted = {"joint1": "screw", "joint2": "bed", "polycoef": "0 800 0 0 0"}
    assert [{edit.attribute: edit.value for edit in each.edit} for each in found] == [wanted] * told
