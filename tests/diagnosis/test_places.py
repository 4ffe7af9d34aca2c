"""Parts that are where they cannot be: links, twins, sites and walls."""

from __future__ import annotations

import re

import pytest
from diagnosed import findings, hints


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
    assert not hints(f"<mujoco>{tray}</mujoco>", "parts-coincide")
    assert [each.value for each in hints(text, "parts-coincide")] == values


@pytest.mark.parametrize(("place", "told"), [("0 0 -16", ["0 0 -0.16"]), ("0 0 -0.16", []), ("0 0 -3", [])])
def test_a_small_link_that_is_far_from_another_is_told_on_a_long_mechanism(place: str, told: list[str]) -> None:
    camera = f'<body pos="{place}"><joint axis="0 1 0"/><geom size="0.15"/></body>'
    yoke = f'<body pos="2 0 0"><joint axis="0 0 1"/><geom size="0.1"/>{camera}</body>'
    jib = f'<body pos="0 0 1"><joint axis="0 1 0"/><geom type="box" size="1 0.1 0.1" pos="1 0 0"/>{yoke}</body>'
    text = f"<mujoco><worldbody>{jib}</worldbody></mujoco>"
    assert [each.value for each in hints(text, "link-far-off")] == told


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
    found = hints(text, "tendon-outside-range")
    assert [(each.attribute, each.value) for each in found if each.attribute != "range"] == ([told] if told else [])


@pytest.mark.parametrize(
    ("high", "motor", "told"),
    [
        pytest.param(0.1, True, True, id="an actuator pulls it"),
        pytest.param(0.1, False, False, id="none does"),
        pytest.param(0.12, True, False, id="nearly inside"),
    ],
)
def test_a_pulled_tendon_a_little_outside_of_its_range_is_told(high: float, motor: bool, told: bool) -> None:
    finger = '<joint axis="0 1 0"/><geom size="0.01" pos="0 0 -0.06"/><site name="tip" pos="0.01 0 -0.12"/>'
    text = f"""<mujoco><worldbody><site name="palm" pos="0.01 0 1.02"/><body pos="0 0 1">{finger}</body></worldbody>
      <tendon><spatial name="f" range="0 {high}" limited="true"><site site="palm"/><site site="tip"/></spatial></tendon>
      <actuator>{'<motor tendon="f" ctrlrange="-9 0"/>' * motor}</actuator></mujoco>"""
    found = hints(text, "tendon-outside-range")
    assert [(each.attribute, each.value) for each in found] == [("range", "0 0.144")] * told


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
    text = f"<mujoco><worldbody><body><freejoint/><geom size='.03'/>{fins}</body></worldbody></mujoco>"
    assert [(each.elements[0], each.value) for each in hints(text, "parts-coincide")] == ([told] if told else [])


UNSEEN = 'contype="0" conaffinity="0"'


@pytest.mark.parametrize(
    ("turns", "geom", "last", "told"),
    [
        (("0", "120", "240"), UNSEEN, "", []),
        (("0", "120", "120"), UNSEEN, "", [('body "root2"', "euler", "120 0 0")]),
        (("0", "120", "120"), "", "", [('body "root2"', "euler", "120 0 0")]),
        (("90", "90"), UNSEEN, "", [('body "blade0"', "pos", "0 0 0")]),  # no third one is turned otherwise
        (("0", "120", "120"), UNSEEN, 'mass="2"', []),
    ],
    ids=["a rotor", "one on another", "that are solid", "two alone", "of other mass"],
)
def test_blades_in_one_place_are_told_by_how_they_are_turned(turns, geom, last, told):
    blades = "".join(
        f'<body name="root{at}" euler="{turn} 0 0"><body name="blade{at}"><joint axis="0 0 1"/>'
        f'<geom type="box" size=".01 .07 .4" pos="0 0 0.5" {geom} {last if at == 2 else ""}/></body></body>'
        for at, turn in enumerate(turns)
    )
    text = f"<mujoco><worldbody><body pos='0 0 2'><joint axis='1 0 0'/><geom size='.1'/>{blades}</body></worldbody>"
    found = hints(f"{text}</mujoco>", "parts-coincide")
    assert [(each.elements[0], each.attribute, each.now) for each in found] == told


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
    text = f"<mujoco><worldbody>{wheels}</worldbody><tendon>{front}{rear}</tendon></mujoco>"
    found = hints(text.replace('axis="rear"', 'axis="0 0 1"'), "tendon-unlike-siblings")
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
    model = f"<mujoco><worldbody>{base}</worldbody></mujoco>"
    assert [each.value for each in hints(model, "link-off-the-end")] == ([told] if told else [])


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
    model = f"<mujoco><worldbody><body><joint/>{rim}{wall}{more}</body></worldbody></mujoco>"
    assert [each.value for each in hints(model, "full-lengths")] == ([told] if told else [])


@pytest.mark.parametrize(
    ("height", "hinge", "told"),
    [(0.3, "", True), (1, "", False), (0.3, 'range="-20 20"', False), (0.3, 'type="slide"', False)],
    ids=["low", "high", "in a range", "a slide"],
)
def test_a_pole_that_swings_into_the_floor_is_told(height: float, hinge: str, told: bool) -> None:
    text = f"""<mujoco><worldbody><geom name="floor" type="plane" size="3 3 0.1"/>
      <body pos="0 0 {height}"><joint name="way" type="slide" axis="1 0 0"/><geom type="box" size="0.1 0.05 0.05"/>
      <body><joint name="pole" axis="0 1 0" {hinge}/><geom type="capsule" fromto="0 0 0.1 0 0 0.6" size="0.02"/></body>
      </body></worldbody><actuator><motor joint="way"/></actuator></mujoco>"""
    assert [each.elements for each in hints(text, "swing-blocked")] == [('joint "pole"', 'geom "floor"')] * told


@pytest.mark.parametrize(("height", "told"), [("0.1", False), ("2", True)])
def test_a_site_of_a_robot_whose_feet_alone_have_geoms_is_beside_its_bodies(height: str, told: bool) -> None:
    foot = '<body pos="0 0 -1"><joint axis="0 1 0"/><geom size="0.05"/></body>'
    inertial = '<inertial pos="0 0 0" mass="9" diaginertia="1 1 1"/>'
    trunk = f'<body pos="0 0 1.1"><freejoint/>{inertial}<site name="imu" pos="0 0 {height}"/>{foot}</body>'
    assert bool(hints(f"<mujoco><worldbody>{trunk}</worldbody></mujoco>", "site-far-off")) == told


@pytest.mark.parametrize(
    ("geom", "place", "told"),
    [
        pytest.param('type="capsule" fromto="0 0 0 0 0 -0.5" size="0.02"', "0 0 0.5", "0 0 -0.5", id="a rod"),
        pytest.param('type="box" size="0.03 0.03 0.22" pos="0 0 -0.22"', "0 0.06 0.4", "0 0.06 -0.4", id="a box"),
        pytest.param('type="box" size="0.03 0.03 0.22" pos="0 0 -0.22"', "0 0 0.1", None, id="not as far"),
        pytest.param('type="box" size="0.03 0.03 0.5"', "0 0 0.5", None, id="both ways"),
    ],
)
def test_a_link_across_the_joint_from_the_end_of_the_one_before_is_told(geom: str, place: str, told: str | None):
    lower = f'<body pos="{place}"><joint axis="0 1 0"/><geom size="0.04" pos="0 0 -0.3"/></body>'
    text = (
        f'<mujoco><worldbody><body pos="0 0 2"><joint axis="0 1 0"/><geom {geom}/>{lower}</body></worldbody></mujoco>'
    )
    assert [each.value for each in hints(text, "link-off-the-end")] == [told] * bool(told)


@pytest.mark.parametrize(
    ("right", "told"),
    [
        pytest.param("0 0 2.868", [("right_rod", "0 0 0 0 0 0.2868")], id="ten times"),
        pytest.param("0 0 0.02868", [("right_rod", "0 0 0 0 0 0.2868")], id="a tenth"),
        pytest.param("0 0 2.867", [], id="not to the digit"),
        pytest.param("0 1 2.868", [], id="another number beside it"),
        pytest.param("0 0 -0.2868", [], id="a sign"),
    ],
)
def test_a_number_a_power_of_ten_off_its_twins_is_told(right: str, told: list[tuple[str, str]]):
    rods = "".join(
        f'<body pos="{x} 0 1"><joint axis="0 1 0"/><geom name="{side}_rod" type="capsule" size="0.01" '
        f'fromto="0 0 0 {end}"/></body>'
        for x, side, end in ((-0.1, "left", "0 0 0.2868"), (0.1, "right", right))
    )
    text = f'<mujoco><worldbody>{rods}<site name="pen" pos="0 0 0.2868"/></worldbody></mujoco>'
    found = hints(text, "twin-place-differs")
    assert [(each.elements[0], each.value) for each in found] == [(f'geom "{name}"', value) for name, value in told]


@pytest.mark.parametrize(
    ("place", "end", "told"),
    [
        pytest.param("0.015 0 0", "", ["0.15 0 0"], id="a tenth"),
        pytest.param("0.02 0 0", "", [], id="not a tenth"),
        pytest.param("0.015 0 0", '<site pos="0.15 0 0"/>', [], id="a site at the end"),
        pytest.param("0 0.015 0", "", [], id="aside"),
    ],
)
def test_a_link_at_a_tenth_of_a_rod_at_whose_end_nothing_is_is_told(place: str, end: str, told: list[str]):
    arm = '<joint axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.006"/><geom size="0.02"/>'
    pole = f'<body pos="{place}"><joint axis="1 0 0"/><geom size="0.01" pos="0.01 0 -0.2"/></body>'
    text = f"<mujoco><worldbody><body pos='0 0 1'>{arm}{end}{pole}</body></worldbody></mujoco>"
    assert [each.value for each in hints(text, "link-off-the-end")] == told


@pytest.mark.parametrize(
    ("end", "bob", "more", "told"),
    [
        pytest.param("0 0 0.26", "0 0 -0.26", "", ["0 0 0 0 0 -0.26"], id="a sign"),
        pytest.param("0 0 -0.26", "0 0 -0.26", "", [], id="well"),
        pytest.param("0 0 0.26", "0 0 -0.2", "", [], id="not as far"),
        pytest.param("0 0 0.26", "0 0 -0.26", '<site pos="0 0 0.26"/>', [], id="something at its end"),
        pytest.param("0 0 0.26", "0 0 -0.26", '<geom size="0.05" pos="0.05 0 -0.1"/>', [], id="a third geom"),
    ],
)
def test_a_rod_that_points_away_from_its_bob_is_told(end: str, bob: str, more: str, told: list[str]):
    rod = f'<geom type="capsule" fromto="0 0 0 {end}" size="0.004"/><geom size="0.012" pos="{bob}"/>{more}'
    text = f'<mujoco><worldbody><body pos="0 0 1"><joint axis="1 0 0"/>{rod}</body></worldbody></mujoco>'
    assert [each.value for each in hints(text, "geom-far-off")] == told


@pytest.mark.parametrize(("right", "told"), [("0.06", ["0 -0.06 -0.1"]), ("-0.06", [])], ids=["copied", "mirrored"])
def test_two_hips_without_geoms_in_one_place_are_told_by_what_hangs_on_them(right: str, told: list[str]):
    legs = "".join(
        f'<body name="{side}_hip" pos="0 {y} -0.1"><joint axis="0 1 0"/>'
        f'<inertial pos="0 {sign}0.04 0" mass="1" diaginertia="0.01 0.01 0.01"/>'
        f'<body name="{side}_leg" pos="0 {sign}0.05 0"><joint axis="1 0 0"/><geom size="0.03"/></body></body>'
        for side, y, sign in (("left", "0.06", ""), ("right", right, "-"))
    )
    text = f'<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom size="0.05"/>{legs}</body></worldbody></mujoco>'
    assert [each.value for each in hints(text, "parts-coincide")] == told


@pytest.mark.parametrize(
    ("size", "posts", "told"),
    [
        pytest.param("0.78 0.04 2", 0.47, ["0.39 0.02 1"], id="full lengths"),
        pytest.param("0.39 0.02 1", 0.47, [], id="half"),
        pytest.param("0.78 0.04 2", 0.42, [], id="in them with half, too"),
        pytest.param("0.78 0.04 2", 2, [], id="in the floor alone"),
    ],
)
def test_a_door_of_full_lengths_is_told_by_its_frame(size: str, posts: float, told: list[str]):
    frame = "".join(f'<geom type="box" size="0.05 0.06 1.05" pos="{x} 0 1.05"/>' for x in (posts, -posts))
    door = f'<joint axis="0 0 1" pos="-0.4 0 0"/><geom type="box" size="{size}"/>'
    text = f'<geom type="plane" size="3 3 1"/>{frame}<body name="door" pos="0 0 1.02">{door}</body>'
    found = findings(f"<mujoco><worldbody>{text}</worldbody></mujoco>", "full-lengths", "overlap-of-relatives")
    assert [each.value for each in found if each.rule == "full-lengths"] == told
    assert not told or found[0].rule == "full-lengths"
