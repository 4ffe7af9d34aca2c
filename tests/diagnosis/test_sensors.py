"""Sensors: rangefinders that look astray, cutoffs, and touch sites that nothing touches."""

from __future__ import annotations

import pytest
from clinic.diagnosis.finding import Finding
from diagnosed import diagnosed, findings, hints
from scenery import FLOOR


def told(rule: str, inside: str, sensors: str) -> list[Finding]:
    text = f"<mujoco><worldbody>{FLOOR}{inside}</worldbody><sensor>{sensors}</sensor></mujoco>"
    return findings(text, rule)


@pytest.mark.parametrize(
    ("joint", "site", "values"),
    [
        pytest.param("<freejoint/>", 'pos="0 0 -0.06"', ["0 0 -1"], id="height-that-looks-up"),
        pytest.param("<freejoint/>", 'pos="0 0 -0.06" euler="180 0 0"', [], id="height"),
        pytest.param("<freejoint/>", 'pos="0 0.21 0" zaxis="0 -1 0"', ["0 1 0"], id="through-its-body"),
        pytest.param("<freejoint/>", 'pos="0 0.21 0" zaxis="0 1 0"', [], id="outward"),
        pytest.param("<freejoint/>", 'pos="0.21 0 0" euler="0 90 0"', [], id="into-the-open"),
        pytest.param("<freejoint/>", 'pos="0.16 0 -0.01" zaxis="0 0 1"', ["0 0 -1"], id="that-is-written-to-look-up"),
        pytest.param("<freejoint/>", 'pos="0.16 0 -0.01"', ["1 0 0"], id="that-is-not"),
        pytest.param("<freejoint/>", 'pos="0 0 0.06"', ["to what it is to see"], id="on-top"),
        pytest.param('<joint axis="0 1 0"/>', 'pos="0 0 0.06"', [], id="on-what-tilts"),
        pytest.param("", 'pos="0.1 0.1 0.1"', ["to what it is to see"], id="of-the-world"),
    ],
)
def test_a_rangefinder_that_looks_up_or_through_its_body_is_told(joint: str, site: str, values: list[str]) -> None:
    shape = '<geom type="box" size="0.2 0.2 0.05"/>' if joint else ""
    body = f'<body pos="0 0 0.5">{joint}{shape}<site name="eye" {site}/></body>'
    found = told("rangefinder-looks-away", body, '<rangefinder site="eye"/>')
    assert [each.value for each in found] == values


@pytest.mark.parametrize(
    ("cutoffs", "values"),
    [
        pytest.param((0.3, 6, 6), ["6"], id="one-of-three"),
        pytest.param((0.3, 0.3, 0.3), [], id="all-alike"),
        pytest.param((0.3, 6, 4), [], id="others-that-differ"),
        pytest.param((2, 6, 6), [], id="a-third"),
    ],
)
def test_a_rangefinder_that_reads_its_cutoff_is_told_beside_others(cutoffs: tuple[float, ...], values: list[str]):
    sites = '<body pos="0 0 1"><freejoint/><geom size="0.1"/><site name="eye" pos="0 0 -0.1" euler="180 0 0"/></body>'
    sensors = "".join(f'<rangefinder site="eye" cutoff="{cutoff}"/>' for cutoff in cutoffs)
    assert [each.value for each in told("cutoff-reached", sites, sensors)] == values


@pytest.mark.parametrize(
    ("site", "count"),
    [
        pytest.param('type="box" size="0.12 0.12 0.015" pos="0 0 0.035"', 1, id="5-mm-above"),
        pytest.param('type="box" size="0.12 0.12 0.015" pos="0 0 0.03"', 0, id="at-the-surface"),
        pytest.param('type="box" size="0.12 0.12 0.015" pos="0 0 0.15"', 1, id="13-cm-above"),
        pytest.param('type="capsule" size="0.01 0.1" pos="0 0 0.129"', 1, id="capsule-4-mm-above"),
        pytest.param('type="capsule" size="0.01 0.1" pos="0 0 0.124" euler="0 90 0"', 1, id="capsule-that-lies"),
        pytest.param('type="capsule" size="0.01 0.1" pos="0.2 0 0" euler="0 90 0"', 0, id="capsule-that-reaches-in"),
        pytest.param('type="sphere" size="0.5"', 0, id="all-around"),
    ],
)
def test_a_touch_site_that_does_not_reach_its_geom_is_told(site: str, count: int) -> None:
    body = f'<body pos="0 0 1"><freejoint/><geom type="box" size="0.1 0.1 0.015"/><site name="pad" {site}/></body>'
    assert len(told("touch-site-off-the-surface", body, '<touch site="pad"/>')) == count


@pytest.mark.parametrize(
    ("shin", "attribute"),
    [
        pytest.param("", "contype, conaffinity", id="nothing collides"),
        pytest.param('<geom size="0.02" pos="0 0 0.5"/>', "pos", id="another geom does"),
    ],
)
def test_of_a_touch_site_about_a_geom_that_cannot_touch_the_masks_are_told(shin: str, attribute: str) -> None:
    foot = '<geom name="foot" size="0.035" contype="0" conaffinity="0"/><site name="foot" size="0.04"/>'
    body = f'<body pos="0 0 1"><joint type="slide" axis="0 0 1"/>{shin}{foot}</body>'
    (found,) = told("touch-site-off-the-surface", body, '<touch site="foot"/>')
    assert found.attribute == attribute


@pytest.mark.parametrize(
    ("sensor", "told_of"),
    [
        pytest.param('objtype="site" objname="tip" reftype="site" refname="tip"', 1, id="itself"),
        pytest.param('objtype="site" objname="tip" reftype="body" refname="arm"', 1, id="its-body"),
        pytest.param('objtype="site" objname="tip" reftype="site" refname="mount"', 0, id="across-a-joint"),
        pytest.param('objtype="site" objname="tip"', 0, id="in-the-world"),
        pytest.param('objtype="site" objname="mount" reftype="body" refname="target"', 0, id="by-mocap"),
        pytest.param('objtype="site" objname="mount" reftype="camera" refname="eye"', 1, id="both-of-the-world"),
    ],
)
def test_a_sensor_of_a_frame_in_one_that_moves_along_is_told(sensor: str, told_of: int) -> None:
    arm = '<body name="arm" pos="0 0 1"><joint/><geom size="0.1"/><site name="tip"/></body>'
    rest = '<site name="mount"/><camera name="eye"/><body name="target" mocap="true"><geom size="0.1"/></body>'
    assert len(told("sensor-of-itself", arm + rest, f"<framepos {sensor}/>")) == told_of


@pytest.mark.parametrize(
    ("sensor", "values"),
    [
        pytest.param('<actuatorfrc actuator="elbow" cutoff="1"/>', ["60"], id="a-sixtieth-of-the-force"),
        pytest.param('<actuatorfrc actuator="elbow" cutoff="60"/>', [], id="all-of-the-force"),
        pytest.param('<actuatorfrc actuator="elbow"/>', [], id="no-cutoff"),
        pytest.param('<actuatorfrc actuator="free" cutoff="1"/>', [], id="no-limit"),
        pytest.param('<jointpos joint="elbow" cutoff="0.2"/>', ["2"], id="a-tenth-of-the-range"),
    ],
)
def test_a_cutoff_far_below_what_is_read_is_told(sensor: str, values: list[str]) -> None:
    arm = '<body pos="0 0 9"><joint name="elbow" axis="0 0 1" range="-114.591559 20"/><geom size="0.1"/></body>'
    motors = '<motor name="elbow" joint="elbow" forcerange="-60 60"/><motor name="free" joint="elbow"/>'
    text = f"<mujoco><worldbody>{arm}</worldbody><actuator>{motors}</actuator><sensor>{sensor}</sensor></mujoco>"
    found = diagnosed(text, "cutoff-reached")
    assert not found.causes
    assert [each.value for each in found.hints] == values


@pytest.mark.parametrize(("size", "told"), [("0.002", True), ("0.06 0.06 0.06", False)])
def test_several_touch_sensors_that_all_miss_are_told(size, told):
    sites = "".join(
        f'<site name="s{index}" type="box" pos="{place}" size="{size} 0.002 0.002"/>'
        if told
        else f'<site name="s{index}" type="box" pos="{place}" size="{size}"/>'
        for index, place in enumerate(("0.05 0 0", "-0.05 0 0", "0 0 0.05"))
    )
    sensors = "".join(f'<touch name="t{index}" site="s{index}"/>' for index in range(3))
    body = f'<body name="box" pos="0 0 0.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/>{sites}</body>'
    text = f"<mujoco><worldbody>{FLOOR}{body}</worldbody><sensor>{sensors}</sensor></mujoco>"
    assert [len(each.elements) for each in hints(text, "touch-site-too-small")] == [4] * told


@pytest.mark.parametrize(
    ("place", "size", "told"),
    [
        pytest.param("0 0 -0.2", 0.04, [("pos", "0 0 -0.32")], id="the site of a foot higher up the shin"),
        pytest.param("0 0 -0.32", 0.04, [], id="around the foot"),
        pytest.param("0 0 -0.32", 0.01, [("size", "0.0385 0.0385 0.0385")], id="in the foot, and small"),
        pytest.param("0 0 -0.2", 0.02, [("size", "0.17 0.17 0.17")], id="too small for the foot as well"),
    ],
)
def test_a_touch_site_that_would_hold_the_foot_elsewhere_gets_its_place(place, size, told):
    foot = '<geom size="0.035" pos="0 0 -0.32"/><geom size="0.15" contype="0" conaffinity="0"/>'
    shin = f'<joint type="slide" axis="0 0 1"/>{foot}<site name="s" pos="{place}" size="{size}"/>'
    body = f'<body pos="0 0 0.355">{shin}</body>'
    text = f'<mujoco><worldbody>{FLOOR}{body}</worldbody><sensor><touch site="s"/></sensor></mujoco>'
    assert [(each.attribute, each.value) for each in hints(text, "touch-site-too-small")] == told


PAIR = (
    '<body pos="0 0 1"><freejoint/><geom size="0.1"/><site name="imu"/>'
    + "".join(
        f'<body pos="0 {y} 0"><joint name="{side}_wheel" axis="0 1 0"/><geom size="0.05"/></body>'
        for side, y in (("left", 0.2), ("right", -0.2), ("rear", 0.6))
    )
    + "</body>"
)


@pytest.mark.parametrize(
    ("sensors", "said"),
    [
        pytest.param({"left_enc": "pos left", "right_enc": "vel right"}, [("left_enc", "right_enc")], id="two"),
        pytest.param({"left_enc": "pos left", "right_enc": "pos right"}, [], id="alike"),
        pytest.param({"left_enc": "pos left", "right_enc": "vel left"}, [], id="of-one-joint"),
        pytest.param({"left_pos": "pos left", "right_vel": "vel right"}, [], id="called-otherwise"),
        pytest.param(
            {"left_enc": "pos left", "right_enc": "vel right", "rear_enc": "vel rear"},
            [("left_enc",)],
            id="one-of-three",
        ),
    ],
)
def test_a_sensor_of_another_kind_than_its_sisters_is_told(
    sensors: dict[str, str], said: list[tuple[str, ...]]
) -> None:
    made = "".join(
        f'<joint{kind.split()[0]} name="{name}" joint="{kind.split()[1]}_wheel"/>' for name, kind in sensors.items()
    )
    found = told("sensor-unlike-name", PAIR, made)
    assert [each.elements for each in found] == [tuple(f'sensor "{name}"' for name in names) for names in said]


@pytest.mark.parametrize(
    ("kind", "name", "values"),
    [
        pytest.param("framexaxis", "upvector", ["<framezaxis>"], id="that-lies"),
        pytest.param("framezaxis", "upvector", [], id="that-stands"),
        pytest.param("framexaxis", "forward", [], id="another-name"),
    ],
)
def test_an_upward_axis_that_lies_is_told(kind: str, name: str, values: list[str]) -> None:
    found = told("sensor-unlike-name", PAIR, f'<{kind} name="{name}" objtype="site" objname="imu"/>')
    assert [each.value for each in found] == values


REELED = """<mujoco><worldbody><site name="drum" pos="0 0 2"/>
  <body name="hand" mocap="true"><site name="palm"/></body>
  <body><site name="bench"/></body>
  <body name="load" pos="0 0 1"><joint name="swing" axis="0 1 0"/><joint name="turn" axis="0 0 1" range="-90 90"/>
    <geom size="0.1"/><site name="eye"/></body></worldbody>
  <tendon><spatial name="rope"><site site="drum"/><site site="eye"/></spatial>
    <spatial name="cable"><site site="drum"/><site site="eye"/></spatial></tendon>
  <actuator><motor tendon="{pulled}"/><motor joint="turn"/></actuator><sensor><{sensor}/></sensor></mujoco>"""


@pytest.mark.parametrize(
    ("sensor", "told"),
    [
        ('tendonactuatorfrc tendon="cable"', 1),
        ('tendonactuatorfrc tendon="rope"', 0),
        ('jointactuatorfrc joint="swing"', 0),
        ('gyro site="drum"', 1),
        ('gyro site="eye"', 0),
        ('gyro site="palm"', 1),
        ('gyro site="bench"', 0),
        ('framelinvel objtype="site" objname="drum" reftype="body" refname="load"', 0),
        ('framelinvel objtype="body" objname="load"', 0),
        ('magnetometer site="eye"', 0),
    ],
)
def test_a_sensor_of_what_is_not_there_is_told(sensor: str, told: int) -> None:
    text = REELED.format(pulled="rope", sensor=sensor)
    assert len(hints(text, "sensor-reads-nothing")) == told
    idle = text.replace('<motor tendon="rope"/><motor joint="turn"/>', "")
    assert len(hints(idle, "sensor-reads-nothing")) == (told or "actuator" in sensor)


PLATE = (
    '<body pos="0 0 1"><joint axis="0 1 0"/><geom type="box" size=".2 .2 .01"/><site name="middle"/></body>'
    '<body name="ball" pos="0 0 1.05"><freejoint/><geom size="0.02"/></body>'
)
IN_PLATE = 'reftype="site" refname="middle"'


@pytest.mark.parametrize(
    ("place", "rate", "told"),
    [
        pytest.param('framepos name="ball_pos"', f'framelinvel name="ball_vel" {IN_PLATE}', ["ball_pos"], id="place"),
        pytest.param(f'framepos name="ball_pos" {IN_PLATE}', 'framelinvel name="ball_vel"', ["ball_vel"], id="rate"),
        pytest.param('framepos name="ball_pos"', 'framelinvel name="ball_vel"', [], id="the-world"),
        pytest.param('framepos name="map_pos"', f'framelinvel name="ball_vel" {IN_PLATE}', [], id="called-otherwise"),
        pytest.param('framequat name="ball_pos"', f'framelinvel name="ball_vel" {IN_PLATE}', [], id="no-rate-of-it"),
    ],
)
def test_a_place_and_its_rate_in_two_frames_are_told(place: str, rate: str, told: list[str]) -> None:
    sensors = "".join(f'<{each} objtype="body" objname="ball"/>' for each in (place, rate))
    text = f"<mujoco><worldbody>{PLATE}</worldbody><sensor>{sensors}</sensor></mujoco>"
    assert [each.elements[0] for each in hints(text, "sensor-frames-differ")] == [f'sensor "{name}"' for name in told]


@pytest.mark.parametrize(
    ("site", "told"),
    [
        ('pos="0 0 -0.2" size="0.056 0.301"', "0.056 0.1505"),
        ('pos="0 0 -0.2" size="0.056 0.156"', None),
        ('pos="0 0 -0.1" size="0.056 0.301"', None),
        ('pos="0 0 -0.2" size="0.056 0.301" euler="30 0 0"', None),
        ('pos="0 0 -0.2" size="0.1 0.301"', None),
    ],
    ids=["full length", "half", "elsewhere", "aslant", "thick"],
)
def test_a_touch_site_that_is_twice_as_long_as_its_geom_is_told(site: str, told: str | None) -> None:
    thigh = '<geom type="capsule" fromto="0 0 -0.05 0 0 -0.35" size="0.055"/>'
    body = f'<body><joint/>{thigh}<site name="thigh" type="capsule" {site}/></body>'
    model = f'<mujoco><worldbody>{body}</worldbody><sensor><touch site="thigh"/></sensor></mujoco>'
    assert [each.value for each in hints(model, "full-lengths")] == ([told] if told else [])


@pytest.mark.parametrize(("end", "told_of"), [(".9 -.6 .4", 0), (".9 -.6 0", 1)], ids=["aside", "across the ray"])
def test_a_rangefinder_beside_a_slanted_part_of_its_robot_does_not_see_it(end: str, told_of: int) -> None:
    boom = f'<body pos="0 .3 0"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 {end}" size=".02"/></body>'
    car = '<geom type="box" size=".2 .1 .05"/><site name="front" pos=".21 0 0" zaxis="1 0 0"/>'
    body = f'<body pos="0 0 .3"><joint type="slide" axis="1 0 0"/>{car}{boom}</body>'
    wall = '<geom type="box" size=".05 1 1" pos=".9 0 .5"/>'
    assert len(told("rangefinder-hits-itself", wall + body, '<rangefinder site="front"/>')) == told_of
