"""Tendons through the sites of others, and unlike those beside them."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import hints

SHANK = rules()["tendon-through-anothers-site"].example("Bad")


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (("", ""), ["tib_i"]),
        (('"tib_i"', '"toe"'), []),
        (('"heel" pos', '"tib_heel" pos'), []),  # the tendon's own, which another one shares
        (('<site name="heel"', '<site name="tib_j"/><site name="heel"'), []),
        (('<site site="tib_via"/>', ""), []),  # one other site says too little
        (('<site site="sol_o"/>\n      <site site="heel"/>', '<site site="sol_o"/><site site="tib_i"/>'), []),
    ],
)
def test_a_tendon_of_two_sites_of_its_own_ends_in_a_third(change, found):
    assert change[0] in SHANK
    text = SHANK.replace(*change) if change[0] else SHANK
    text = text.replace('site="heel"', 'site="tib_heel"') if "tib_heel" in text else text
    assert [each.value for each in hints(text, "tendon-through-anothers-site")] == found


@pytest.mark.parametrize(("last", "told"), [("pinky_2", []), ("ring_2", ["pinky_2"]), ("pinky_nail", [])])
def test_a_tendon_that_ends_on_another_finger_is_led_to_its_own(last, told):
    finger = (
        '<body pos="0 {1} 0"><joint axis="0 1 0"/><geom size="0.01"/><site name="{0}_1"/>'
        '<body pos="0.04 0 0"><joint axis="0 1 0"/><geom size="0.01"/><site name="{0}_2"/></body></body>'
    )
    fingers = "".join(finger.format(name, place) for name, place in (("ring", 0), ("pinky", 0.03)))
    palm = f'<geom size="0.01"/><site name="ring_0"/><site name="pinky_0"/><site name="pinky_nail"/>{fingers}'
    paths = (("ring_0", "ring_1", "ring_2"), ("pinky_0", "pinky_1", last))
    led = "".join(
        '<spatial><site site="{}"/><site site="{}"/><site site="{}"/></spatial>'.format(*path) for path in paths
    )
    text = f"<mujoco><worldbody>{palm}</worldbody><tendon>{led}</tendon></mujoco>"
    assert [each.value for each in hints(text, "tendon-through-anothers-site")] == told


@pytest.mark.parametrize(
    ("place", "count", "told"),
    [
        ("0.01 0 0.01", 3, []),
        ("-0.01 0 0.01", 3, ["0.01 0 0.01"]),
        ("0.01 0.01 0", 3, []),  # a place of its own
        ("0.01 0 0.012", 3, []),
        ("-0.01 0 0.01", 2, []),
    ],
)
def test_the_one_cable_that_runs_over_the_back_of_its_finger_is_told(place, count, told):
    finger = (
        '<body pos="0 {0} 0"><joint axis="0 1 0"/><geom size="0.01"/><site name="{0}a" pos="{1}"/>'
        '<site name="{0}b" pos="0.009 0 0.03"/><body pos="0 0 0.04"><joint axis="0 1 0"/><geom size="0.01"/>'
        '<site name="{0}c" pos="0.008 0 0.02"/></body></body>'
    )
    cable = '<spatial><site site="{0}a"/><site site="{0}b"/><site site="{0}c"/></spatial>'
    fingers = "".join(finger.format(each, "0.01 0 0.01" if each else place) for each in range(count))
    cables = "".join(map(cable.format, range(count)))
    text = f"<mujoco><worldbody>{fingers}</worldbody><tendon>{cables}</tendon></mujoco>"
    assert [each.value for each in hints(text, "tendon-unlike-siblings")] == told


@pytest.mark.parametrize(
    ("other", "eye", "told"),
    [("0 0.8", "0.1", []), ("0 0.9", "0.1", ["0 0.8"]), ("0 0.9", "0.3", []), ("0.5 0.9", "0.1", [])],
    ids=["alike", "unequal", "of-another-length", "of-another-kind"],
)
def test_two_ropes_of_one_length_that_may_be_unequally_long_are_told(other, eye, told):
    text = f"""<mujoco><worldbody><site name="a" pos="-0.1 0 2"/><site name="b" pos="0.1 0 2"/>
      <body name="load" pos="0 0 1.2"><freejoint/><geom type="box" size="0.3 0.1 0.1"/>
        <site name="c" pos="-0.1 0 0.1"/><site name="d" pos="{eye} 0 0.1"/></body></worldbody>
    <tendon><spatial limited="true" range="0 0.8"><site site="a"/><site site="c"/></spatial>
      <spatial limited="true" range="{other}"><site site="b"/><site site="d"/></spatial></tendon></mujoco>"""
    assert [each.value for each in hints(text, "tendon-unlike-siblings")] == told


HAULED = """<mujoco><worldbody>{tops}<body pos="0 0 1"><freejoint/><geom size="0.1"/>{lugs}</body></worldbody>
<tendon>{cables}</tendon></mujoco>"""


CABLE = '<spatial name="cable{0}"><site site="top{0}"/><site site="lug{1}"/></spatial>'


@pytest.mark.parametrize(
    ("ends", "called", "found"),
    [
        ("123", "123", []),
        ("121", "123", [('tendon "cable3"', "lug3")]),
        ("121", "12x", []),  # none is called after it
        ("131", "123", []),  # lug2 is free, and cable3 goes to that of cable1
        ("111", "123", []),  # all to one
    ],
)
def test_a_cable_goes_to_the_site_of_its_number(ends, called, found):
    tops = "".join(f'<site name="top{each}" pos="0 {each} 2"/>' for each in "123")
    lugs = "".join(f'<site name="lug{each}" pos="0 0.{at} 0"/>' for at, each in enumerate(called))
    cables = "".join(CABLE.format(at + 1, end) for at, end in enumerate(ends)).replace("lug3", f"lug{called[2]}")
    text = HAULED.format(tops=tops, lugs=lugs, cables=cables)
    told = hints(text, "tendon-through-anothers-site")
    assert [(each.elements[0], each.value) for each in told] == found


def test_the_tendons_of_two_sides_are_compared_by_their_sides_alone():
    text = rules()["twin-path-differs"].example("Good").replace('"right_back"/>', '"left_back"/>')
    ours = "twin-path-differs", "tendon-through-anothers-site"
    assert [each.rule for each in hints(text, *ours)] == ["twin-path-differs"]
