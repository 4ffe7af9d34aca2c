"""Lines that were copied and half adapted: two name one thing, and another is named by none."""

from __future__ import annotations

import pytest
from diagnosed import hints, with_edits

FINGER = """
<body pos="0 {y} 1">
  <joint name="{one}J1" axis="0 1 0" range="0 90" damping="0.1"/>
  <geom type="capsule" fromto="0.01 0 0 0.05 0 0" size="0.008"/>
  <body pos="0.06 0 0">
    <joint name="{one}J0" axis="0 1 0" range="0 90" damping="0.1"/>
    <geom type="capsule" fromto="0.01 0 0 0.03 0 0" size="0.008"/>
    <site name="{one}tip" pos="0.03 0 0"/>
    <site name="{one}pad" pos="0.03 0 0"/>
  </body>
</body>
"""
FINGERS = "".join(FINGER.format(one=one, y=0.04 * place) for place, one in enumerate(("ff", "mf", "rf")))
PULL = '<fixed name="{one}pull"><joint joint="{one}J1" coef="1"/><joint joint="{one}J0" coef="1"/></fixed>'
PULLS = "".join(PULL.format(one=one) for one in ("ff", "mf", "rf"))


def hand(**lines: str) -> str:
    """Three fingers, each with a line of its own in some sections: `A` stands for the finger's name."""
    sections = ""
    for section, line in lines.items():
        each = [line.replace("A", one) for one in ("ff", "mf", "rf")]
        sections += f"<{section}>{''.join(each)}</{section}>"
    palm = f'<body><joint name="wrist"/><geom size="0.03"/>{FINGERS}</body>'
    return f"<mujoco><worldbody>{palm}</worldbody><tendon>{PULLS}</tendon>{sections}</mujoco>"


@pytest.mark.parametrize(
    ("tendon", "idle", "meant"),
    [("R_out", "R_in", ["R_in"]), ("R_in", "R_in", []), ("R_out", "in", [])],
    ids=["on that of another", "on its own", "the twin is not there"],
)
def test_an_actuator_belongs_to_the_twin_of_the_tendon_of_its_twin(tendon, idle, meant):
    joints = "".join(f'<body><joint name="{side}J"/><geom size="0.03"/></body>' for side in "LR")
    fixed = '<fixed name="{}"><joint joint="{}J" coef="1"/></fixed>'
    tendons = "".join(
        fixed.format(name, side) for name, side in (("L_in", "L"), ("L_out", "L"), (idle, "R"), ("R_out", "R"))
    )
    pulls = {"flex_L": "L_in", "flex_R": tendon, "ext_L": "L_out", "ext_R": "R_out"}
    motors = "".join(f'<motor name="{name}" tendon="{pulled}"/>' for name, pulled in pulls.items())
    sections = f"<tendon>{tendons}</tendon><actuator>{motors}</actuator>"
    found = hints(f"<mujoco><worldbody>{joints}</worldbody>{sections}</mujoco>", "actuator-on-another-tendon")
    assert [(each.elements[0], each.value) for each in found] == [('actuator "flex_R"', each) for each in meant]


@pytest.mark.parametrize(
    ("rule", "lines", "right", "wrong"),
    [
        (
            "actuator-on-another-tendon",
            {"actuator": '<motor name="M_AJ1" tendon="Apull"/>'},
            'tendon="rfpull"',
            'tendon="mfpull"',
        ),
        (
            "driven-twice",
            {"actuator": '<motor name="A_turn" joint="AJ1"/>'},
            '"rf_turn" joint="rfJ1"',
            '"rf_turn" joint="mfJ1"',
        ),
        ("sensor-twice", {"sensor": '<touch name="A_touch" site="Atip"/>'}, 'site="rftip"', 'site="mftip"'),
        (
            "sensor-twice",
            {"sensor": '<jointpos name="A_way" joint="AJ1"/>'},
            '"ff_way" joint="ffJ1"',
            '"ff_way" joint="mfJ1"',
        ),
        (
            "equality-copied",
            {"equality": '<joint name="A" joint1="AJ0" joint2="AJ1"/>'},
            'joint1="rfJ0"',
            'joint1="mfJ0"',
        ),
        ("equality-copied", {"equality": '<connect site1="Atip" site2="Apad"/>'}, 'site2="rfpad"', 'site2="ffpad"'),
    ],
)
def test_what_a_line_is_called_tells_what_it_was_meant_for(rule, lines, right, wrong):
    text = hand(**lines)
    assert text.count(right) == 1
    broken = text.replace(right, wrong)
    (found,) = hints(broken, rule)
    assert [each.value for each in found.edit] == [right.split('"')[-2]]
    assert with_edits(broken, found) == text
    assert not hints(text, rule)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({}, True),
        ({'<joint name="rfJ0" axis="0 1 0"': '<joint name="rfJ0" axis="0 -1 0"'}, False),  # its axis is turned as well
        ({'"rfJ0" axis="0 1 0" range="0 90"': '"rfJ0" axis="0 1 0" range="-90 0"'}, False),  # it bends back
        ({'joint2="ffJ1" polycoef="0 0.7': 'joint2="ffJ1" polycoef="0 0.5'}, False),  # two others of three
        ({'joint2="ffJ1" polycoef="0 0.7': 'joint2="ffJ1" polycoef="0 -0.7'}, False),
    ],
)
def test_one_coupling_of_three_has_the_other_sign(change, told):
    right = hand(equality='<joint name="A" joint1="AJ0" joint2="AJ1" polycoef="0 0.7 0 0 0"/>')
    wrong = right.replace('joint2="rfJ1" polycoef="0 0.7', 'joint2="rfJ1" polycoef="0 -0.7')
    text = wrong
    for old, new in change.items():
        assert text.count(old) == 1
        text = text.replace(old, new)
    found = hints(text, "coupling-unlike-others", "follower-out-of-range")
    found = [each for each in found if each.rule == "coupling-unlike-others" or told]
    assert [(each.rule, each.value) for each in found] == [("coupling-unlike-others", "0 0.7 0 0 0")] * told
    assert not told or with_edits(text, found[0]) == right


@pytest.mark.parametrize("rule", ["coupling-unlike-others", "loop-not-assembled"])
def test_what_follows_from_a_copied_end_of_an_equality_is_not_told(rule):
    line = '<joint name="A" joint1="AJ0" joint2="AJ1"/><connect site1="Atip" site2="Apad"/>'
    text = hand(equality=line).replace('joint1="rfJ0"', 'joint1="mfJ0"').replace('site2="rfpad"', 'site2="ffpad"')
    assert not hints(text, rule)


@pytest.mark.parametrize(
    "line",
    [
        '<joint name="A" joint1="AJ0" joint2="ffJ1"/>',  # the leader of all
        '<joint name="A" joint1="AJ0" joint2="AJ1"/><joint name="A_again" joint1="AJ0" joint2="AJ1"/>',
    ],
)
def test_one_leader_of_all_fingers_is_no_copied_line(line):
    assert not [each for each in hints(hand(equality=line), "equality-copied") if each.edit]


@pytest.mark.parametrize(
    ("sensors", "meant"),
    [
        ('<jointvel name="enc_l" joint="wheel_l"/><jointvel name="enc_r" joint="wheel_l"/>', ("joint", "wheel_r")),
        ('<touch name="rim_l" site="hub_r"/><touch name="rim_r" site="hub_r"/>', ("site", "hub_l")),
        (
            '<framepos name="at_l" objtype="site" objname="hub_l"/>'
            '<framepos name="at_r" objtype="site" objname="hub_l"/>',
            ("objname", "hub_r"),
        ),
    ],
)
def test_the_name_of_a_sensor_tells_which_of_a_pair_reads_the_wrong_side(sensors, meant):
    pairs = "".join(
        f'<body name="{part}_{side}" pos="{x} {y} 0"><joint name="{part}_{side}" axis="0 1 0"/><geom size="0.05"/>'
        f'<site name="{hub}_{side}"/></body>'
        for part, hub, x in (("wheel", "hub", 0.2), ("arm", "hand", 0), ("leg", "toe", -0.2), ("ear", "tip", -0.3))
        for side, y in (("l", 0.2), ("r", -0.2))
    )
    text = f"<mujoco><worldbody><body pos='0 0 1'><freejoint/><geom size='0.1'/>{pairs}</body></worldbody>"
    (found,) = hints(f"{text}<sensor>{sensors}</sensor></mujoco>", "twin-sensor-differs")
    assert [(each.attribute, each.value) for each in found.edit] == [meant]
    assert found.attribute == meant[0]


@pytest.mark.parametrize(
    ("sensors", "meant"),
    [
        ('<force site="a"/><torque site="b"/><framepos objtype="site" objname="a"/>', "b"),
        ('<gyro site="b"/><accelerometer site="a"/><framequat objtype="site" objname="b"/><touch site="a"/>', "b"),
        ('<gyro site="b"/><accelerometer site="a"/>', ""),  # which is elsewhere, no other sensor tells
        ('<force site="a"/><torque site="a"/><touch site="a"/><gyro site="b"/>', ""),
        ('<gyro site="b"/><accelerometer site="b"/><accelerometer site="a"/><touch site="a"/>', ""),  # a second one
        ('<gyro site="far"/><accelerometer site="a"/><touch site="a"/>', ""),
    ],
)
def test_a_sensor_alone_at_the_site_of_another_kind_belongs_to_its_unit(sensors, meant):
    link = '<body pos="0 0 1"><joint/><geom size="0.1"/>{0}</body>'
    chain = link.format('<site name="a"/>' + link.format('<site name="b"/>' + link.format('<site name="far"/>')))
    text = f"<mujoco><worldbody>{chain}</worldbody><sensor>{sensors}</sensor></mujoco>"
    found = hints(text, "sensor-off-its-unit")
    assert [each.value for one in found for each in one.edit] == [meant] * bool(meant)


@pytest.mark.parametrize(
    ("sensors", "meant"),
    [
        ('<framequat name="attitude" objtype="site" objname="foot_l"/>', ["imu"]),
        ('<framequat name="attitude" objtype="site" objname="imu"/>', []),
        ('<framequat name="foot_l_turn" objtype="site" objname="foot_l"/>', []),
        ('<framequat objtype="site" objname="foot_l"/><framequat objtype="site" objname="foot_r"/>', []),
        ('<framequat name="attitude" objtype="site" objname="tip"/>', []),
    ],
)
def test_the_one_orientation_at_a_foot_of_a_pair_belongs_to_the_unit(sensors, meant):
    foot = '<body pos="0 {} 0"><joint/><geom size="0.1"/><site name="{}"/></body>'
    feet = "".join(foot.format(y, name) for name, y in (("foot_l", 1), ("foot_r", -1), ("tip", 2)))
    trunk = f'<body><freejoint/><geom size="0.1"/><site name="imu"/>{feet}</body>'
    unit = '<gyro site="imu"/><accelerometer site="imu"/><touch site="foot_l"/><touch site="foot_r"/>'
    text = f"<mujoco><worldbody>{trunk}</worldbody><sensor>{unit}{sensors}</sensor></mujoco>"
    assert [each.value for each in hints(text, "sensor-off-its-unit")] == meant


CYLINDERS = "".join(
    f'<body name="{part}"><joint name="{part}_pin" axis="0 1 0"/><geom size="0.1"/><body name="{part}_barrel">'
    f'<joint name="{part}_rod" type="slide"/><geom size="0.1"/><site name="{part}_eye"/></body></body>'
    for part in ("boom", "stick", "bucket")
)
STROKE = '<jointpos name="{0}_stroke" joint="{0}_rod"/>'
STROKES = "".join(map(STROKE.format, ("boom", "stick", "bucket")))


@pytest.mark.parametrize(
    ("sensors", "edits"),
    [
        ('<framelinvel name="stick_vel" objtype="xbody" objname="boom"/>', [("objname", "stick")]),
        ('<framelinvel name="stick_vel" objtype="xbody" objname="stick"/>', []),
        (
            '<framepos name="eye_pos" objtype="body" objname="boom_barrel"/>',  # no site has that name alone
            [],
        ),
        (
            '<framepos name="lug_pos" objtype="body" objname="tip"/>',
            [("objname", "lug"), ("objtype", "site")],
        ),
        ('<framepos name="tip_of_lug" objtype="body" objname="tip"/>', []),
        (
            '<framepos name="lug_in_stick" objtype="site" objname="lug" reftype="body" refname="boom"/>',
            [("refname", "stick")],
        ),
        ('<framepos name="lug_in_boom" objtype="site" objname="lug" reftype="body" refname="boom"/>', []),
        ('<framepos name="stick_at" objtype="body" objname="stick" reftype="body" refname="boom"/>', []),
        ('<framepos name="in_boom" objtype="body" objname="tip" reftype="body" refname="boom"/>', []),
        (STROKES, []),
        (STROKES.replace('"stick_rod"', '"stick_pin"'), [("joint", "stick_rod")]),
        (STROKES[: 2 * len(STROKES) // 3].replace('"stick_rod"', '"stick_pin"'), []),  # one of two
    ],
)
def test_a_sensor_reads_what_its_name_or_its_sisters_say(sensors, edits):
    tip = '<body name="tip"><joint/><geom size="0.1"/><site name="lug"/></body>'
    text = f"<mujoco><worldbody>{CYLINDERS}{tip}</worldbody><sensor>{sensors}</sensor></mujoco>"
    found = hints(text, "sensor-on-another-joint")
    assert [(each.attribute, each.value) for one in found for each in one.edit] == edits


BARS = "".join(
    f'<fixed name="bar_{end}" stiffness="9"><joint joint="{one}J1" coef="1"/><joint joint="{one}J0" coef="-1"/></fixed>'
    for end, one in (("front", "ff"), ("rear", "mf"))
)
SHAFT = '<fixed name="shaft"{}><joint joint="rfJ1" coef="1"/><joint joint="rfJ0" coef="1"/></fixed>'


@pytest.mark.parametrize(
    ("bars", "shaft", "motors", "meant"),
    [
        (BARS, SHAFT.format(""), '<motor name="drive" tendon="bar_rear"/>', ["shaft"]),
        (BARS, SHAFT.format(""), '<motor name="drive" tendon="shaft"/>', []),
        (BARS, SHAFT.format(' damping="1"'), '<motor name="drive" tendon="bar_rear"/>', []),
        (BARS, SHAFT.format(""), '<motor name="a" tendon="bar_rear"/><motor name="b" tendon="bar_front"/>', []),
        (BARS.partition("</fixed>")[2], SHAFT.format(""), '<motor name="drive" tendon="bar_rear"/>', []),
    ],
)
def test_an_actuator_on_one_of_several_springs_belongs_to_the_tendon_that_does_nothing(bars, shaft, motors, meant):
    palm = f'<body><joint name="wrist"/><geom size="0.03"/>{FINGERS}</body>'
    sections = f"<tendon>{bars}{shaft}</tendon><actuator>{motors}</actuator>"
    text = f"<mujoco><worldbody>{palm}</worldbody>{sections}</mujoco>"
    found = hints(text, "actuator-on-another-tendon")
    assert [each.value for one in found for each in one.edit] == meant


@pytest.mark.parametrize(
    ("meshes", "odd"),
    [
        ({"link3": "link2"}, ['body "link3"']),
        ({"link3": "link2", "link3_seen": "link2_seen"}, []),
        ({"link3": "link2", "link4": "link2"}, []),
        ({"link3": "motor"}, []),
        ({}, []),
    ],
    ids=["of one geom", "of both: one shape", "of two links", "called after no link", "all right"],
)
def test_a_link_with_the_mesh_of_another_is_told(meshes, odd):
    names = [f"link{number}{what}" for number in range(1, 5) for what in ("", "_seen")]
    corners = "-0.02 0 0  0.02 0 0  0 0.02 0  0 0 0.1"
    assets = "".join(f'<mesh name="{name}" vertex="{corners}"/>' for name in (*names, "motor"))
    bodies = ""
    for number in range(1, 5):
        own = [meshes.get(name, name) for name in (f"link{number}", f"link{number}_seen")]
        geoms = "".join(f'<geom type="mesh" mesh="{name}"/>' for name in own)
        bodies += f'<body name="link{number}" pos="0 0 0.2"><joint axis="0 1 0"/>{geoms}'
    text = f"<mujoco><asset>{assets}</asset><worldbody>{bodies}{'</body>' * 4}</worldbody></mujoco>"
    assert [each.elements[0] for each in hints(text, "mesh-of-another-link")] == odd
