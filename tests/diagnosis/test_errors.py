"""Models that do not compile: the repair, not the message."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.native import NativeEngine
from clinic.engine.mjcf import SINCE
from clinic.pages.messages import load_messages
from diagnosed import FILE, causes, diagnosed, mended

pytestmark = pytest.mark.usefixtures("folder")

MENDED = {  # messages that no rule mends, with the reason
    "missing-target": "what the actuator should drive is not in the text",
    "cable-plugin": "a plugin that is gone",
    "unrecognized-root": "no model",
    "file-not-found": "a file that is nowhere",
    "include-not-found": "a file that is nowhere",
}
COMPILED = [message for message in load_messages() if message.xml is not None]


@pytest.mark.parametrize("message", COMPILED, ids=lambda message: message.id)
def test_what_mujoco_refuses_is_mended(message):
    found = diagnosed(message.xml)
    assert bool(found.causes) == (message.id not in MENDED), found.text()
    assert found.causes or found.hints
    assert message.id in MENDED or mended(message.xml)


def test_three_mistakes_are_named_in_turn_and_mended_together():
    text = """<mujoco>
  <worldbody>
    <body name="arm" pos="0 0, 1">
      <joint name="elbow" axis="0 1 0"/>
      <geom name="link" typ="sphere" size="0.1"/>
    </body>
  </worldbody>
  <actuator><motor name="motor" joint="elbo"/></actuator>
</mujoco>
"""
    found = diagnosed(text)
    assert [each.rule for each in found.causes] == ["unknown-attribute", "malformed-number", "unknown-reference"]
    assert [each.line for each in found.causes] == [5, 3, 8]
    assert found.diff().count("\n+") == 4  # three lines and the head


ARM = """<mujoco>{0}
  <worldbody>
    <body name="arm" pos="0 0 1">
      <joint name="elbow" axis="0 1 0"/>
      <geom name="link" size="0.1"/>
      <site name="tip"/>{1}
    </body>
    <body name="hand"><joint name="wrist" type="ball"/><geom name="palm" type="box" size="0.1 0.1 0.1"/></body>
  </worldbody>{2}
</mujoco>
"""
WRITTEN = [  # what is written at the top, in the body and at the end; the rule, its attribute and value
    ("", "<inertial pos='0 0 0' mass='1'/><inertial pos='0 0 0' mass='2'/>", "", "given-twice", "", "removed"),
    ("", "<geom size='10cm'/>", "", "malformed-number", "size", "0.1"),
    ("", "<geom size='.1' pos='0.13/2 0 -0.25'/>", "", "malformed-number", "pos", "0.065 0 -0.25"),
    ("", "<geom size='0,1'/>", "", "malformed-number", "size", "0.1"),
    ("", "<geom size='0.1' pos='0 0 \u22120.1'/>", "", "malformed-number", "pos", "0 0 -0.1"),
    ("", "<site name='s' type='plane'/>", "", "invalid-value", "type", "box"),
    ("", "<geom size='0.1' condim='2'/>", "", "invalid-value", "condim", "3"),
    ("", "<body><joint type='fixed'/><geom size='0.1'/></body>", "", "invalid-value", "", "<joint> removed"),
    ("<option gravity='-9.81'/>", "", "", "malformed-number", "gravity", "0 0 -9.81"),
    ("<option><flag contact='false'/></option>", "", "", "invalid-value", "contact", "disable"),
    ("<asset><texture name='t' type='2d' builtin='flat'/></asset>", "", "", "invalid-value", "width", "100"),
    ("<size memory='1'/>", "", "", "unfit-element", "memory", "nothing"),
    ("<default><default/></default>", "", "", "left-out", "class", "part"),
    ("", "<inertial mass='1' diaginertia='1 1 1'/>", "", "left-out", "pos", "0 0 0"),
    ("", "", "<sensor><touch body='arm'/></sensor>", "unknown-attribute", "body", "site='tip'"),
    ("", "", "<sensor><jointpos joint='wrist'/></sensor>", "unfit-element", "", "<ballquat>"),
    ("", "", "<sensor><framepos objname='arm'/></sensor>", "left-out", "objtype", "body"),
    ("", "", "<equality><joint joint='elbow'/></equality>", "unknown-attribute", "joint", "joint1='elbow'"),
    ("", "", "<equality><weld body1='arms'/></equality>", "unknown-reference", "body1", "arm"),
    ("", "", "<contact><pair body1='arm' body2='hand'/></contact>", "unknown-attribute", "body1", "geom1='link'"),
    ("", "", "<tendon><fixed><joint joint='elbow'/></fixed></tendon>", "left-out", "coef", "1"),
    ("", "", "<tendon><spatial><site site='tip'/></spatial></tendon>", "unfit-element", "", "removed"),
    ("", "", "<actuator><muscle joint='elbow'/></actuator>", "unfit-element", "range", "-90 90"),
    ("", "", "<actuator><motor name='elbow_motor'/></actuator>", "left-out", "joint", "elbow"),
    ("", "", "<actuator><damper joint='elbow' ctrlrange='-1 1'/></actuator>", "invalid-value", "ctrlrange", "0 1"),
    ("", "<composite type='cable' count='9 1 1' size='1'/>", "", "unknown-element", "", '<flexcomp dim="1">'),
    ("", "<camera pos='0 0 2' lookat='0 0 0'/>", "", "unknown-attribute", "lookat", "xyaxes='1 0 0 0 1 0'"),
    ("", "<geom name='red' size='0.1' color='1 0 0'/>", "", "unknown-attribute", "color", "rgba='1 0 0 1'"),
    ("", "<geom type='cylinder' radius='.1' length='1'/>", "", "unknown-attribute", "radius", "size='0.1 0.5'"),
    (
        "<default><default class='b'><geom type='box' size='0.1'/></default></default>",
        "<geom class='b'/>",
        "",
        "invalid-value",
        "size",
        "0.1 0.1 0.1",
    ),
    (
        "",
        "<body><joint/><inertial pos='0 0 0' mass='1' diaginertia='0.01 0.01 0'/></body>",
        "",
        "massless-body",
        "diaginertia",
        "0.01 0.01 0.01",
    ),
    ("<asset><texture name='t' type='2d'/></asset>", "", "", "invalid-value", "builtin", "flat"),
    ("", "<site rpy='0 1.5708 0'/>", "", "unknown-attribute", "rpy", "quat='0.707105 0 0.707108 0'"),
    ("", "<site euler='-pi/2 0 0'/>", "", "malformed-number", "euler", "-90 0 0"),
    ("<compiler angle='radian'/>", "<site euler='90deg 0 0'/>", "", "malformed-number", "euler", "1.5708 0 0"),
    ("<compiler angle='radian'/>", "<camera fovy='45deg'/>", "", "malformed-number", "fovy", "45"),
]


@pytest.mark.parametrize(("top", "body", "end", "rule", "attribute", "value"), WRITTEN)
def test_what_people_write_is_mended(top, body, end, rule, attribute, value):
    found = mended(ARM.format(top, body, end))
    first = found.causes[0]
    assert (first.rule, first.attribute, first.value) == (rule, attribute, value), found.text()
    assert first.says.rstrip(".") != found.error.splitlines()[0].rstrip(".")


CLAW = "<body name='{0}_finger'><joint name='{0}_claw' type='slide'/><geom size='0.1'/><site name='{0}_tip'/></body>"
CLAWS = CLAW.format("left") + CLAW.format("right")
THROUGH = "<tendon><fixed><joint joint='{0}_claw' coef='1'/><joint joint='{0}_claw' coef='1'/></fixed></tendon>"


@pytest.mark.parametrize(
    ("end", "attribute", "value"),
    [
        (THROUGH.format("left"), "joint", "right_claw"),
        (THROUGH.format("right"), "joint", "left_claw"),
        ("<equality><joint joint1='left_claw' joint2='left_claw'/></equality>", "joint2", "right_claw"),
        ("<equality><weld body1='left_finger' body2='left_finger'/></equality>", "body2", "right_finger"),
        (
            "<tendon><spatial><site site='tip'/><site site='left_tip'/><site site='left_tip'/></spatial></tendon>",
            "site",
            "right_tip",
        ),
        (
            THROUGH.format("left").replace("</tendon>", "<fixed><joint joint='right_claw' coef='1'/></fixed></tendon>"),
            "",
            "removed",
        ),
    ],
)
def test_what_is_there_twice_is_given_its_twin_where_none_has_that(end, attribute, value):
    found = mended(ARM.format("", CLAWS, end))
    first = found.causes[0]
    assert (first.rule, first.attribute, first.value) == ("given-twice", attribute, value), found.text()


@pytest.mark.parametrize(
    ("right", "attribute", "value"),
    [
        ("<body name='left_foot'><joint name='right_ankle'/>", "name", "right_foot"),
        ("<body name='right_leg'><geom name='left_foot' size='0.1'/>", "name", "left_foot_2"),
        ("<body name='left_foot'><joint name='right_toe'/>", "name", "left_foot_2"),
        ("<body name='left_foot'><joint/>", "name", "left_foot_2"),
    ],
)
def test_a_name_that_was_copied_is_changed_as_what_is_in_it_was(right, attribute, value):
    left = "<body name='left_foot'><joint name='left_ankle'/><geom name='left_foot' size='0.1'/></body>"
    text = f"<mujoco><worldbody>{left}{right}<geom size='0.1'/></body></worldbody></mujoco>"
    found = diagnosed(text)
    first = found.causes[0]
    assert (first.rule, first.attribute, first.value) == ("repeated-name", attribute, value), found.text()


@pytest.mark.parametrize(("mark", "end"), [("", "\n"), ("\ufeff", "\r\n")])
def test_the_right_one_of_twenty_is_named(mark, end):
    sizes = ["-0.1" if number == 13 else "0.1" for number in range(20)]
    lines = "".join(f"\n<geom size='{size}'/>" for size in sizes)
    text = mark + f"<mujoco>\n<worldbody>{lines}\n</worldbody>\n</mujoco>".replace("\n", end)
    (cause,) = causes(text)
    assert (cause.line, cause.now, cause.value) == (16, "-0.1", "0.1")


def test_the_same_mistake_twenty_times_is_mended_everywhere():
    lines = "".join(f"\n<geom size='0.{number + 1};0.1' type='capsule'/>" for number in range(20))
    found = mended(f"<mujoco>\n<worldbody>{lines}\n</worldbody>\n</mujoco>")
    assert [edit.line for each in found.causes for edit in each.edit] == list(range(3, 23))


def test_what_an_included_file_has_wrong_is_told_there():
    text = "<mujoco>\n<include file='part.xml'/>\n<worldbody>\n<geom size='0.1'/>\n</worldbody>\n</mujoco>"
    part = (
        "<mujoco>\n<worldbody>\n<geom size='0.1'/>\n<geom size='0.1 mm'/>\n<geom type='cube'/>\n</worldbody>\n</mujoco>"
    )
    found = examine(NativeEngine(), {FILE: text, "part.xml": part})
    assert [(each.file, each.line) for each in found.causes] == [("part.xml", 4), ("part.xml", 5), ("part.xml", 5)]


def test_a_number_beyond_all_bounds_is_told_and_nothing_else_is_written():
    (cause,) = causes(ARM.format("", '<light dir="0 1e400 -1"/>', ""))
    assert (cause.rule, cause.attribute, cause.value) == ("malformed-number", "dir", "left out")
    assert "largest number" in cause.says


@pytest.mark.parametrize(
    ("attribute", "now", "value"), [("pos", "abc 0 0.5", "0 0 0.5"), ("zaxis", "0 abc 0", "0 1 0")]
)
def test_a_word_among_numbers_gives_its_own_place(attribute, now, value):
    (cause,) = causes(ARM.format("", f'<site {attribute}="{now}"/>', ""))
    assert (cause.attribute, cause.value) == (attribute, value)


def test_the_part_of_the_other_side_is_not_taken_for_one_that_is_missing():
    text = ARM.format("", "<body><joint name='right_knee'/><geom size='0.1'/></body>", "<actuator>{0}</actuator>")
    found = diagnosed(text.format("<motor joint='left_knee'/>"))
    (hint,) = found.hints
    assert not found.causes
    assert "'right_knee' is another of its kind" in hint.says
    assert causes(text.format("<motor joint='rihgt_knee'/>"))[0].value == "right_knee"


def test_a_value_is_written_as_xml_has_it():
    found = mended(ARM.format("", "<site nme='a \"b\" &lt; &amp;'/>", ""))
    assert 'name="a &quot;b&quot; &lt; &amp;"' in found.fixed[FILE]


def test_a_long_value_is_shortened_for_a_terminal_alone():
    found = diagnosed(ARM.format("", f"<site pos='{'x' * 10_000}'/>", ""))
    assert len(found.text()) < 2000
    assert found.causes[0].now == "x" * 10_000


@pytest.mark.parametrize(
    ("geom", "attribute", "value"),
    [
        pytest.param('<geom class="hub"/>', "class", "tyre", id="another-class"),
        pytest.param('<geom class="tyre" mass="0"/>', "mass", "left out", id="mass-taken"),
    ],
)
def test_a_body_without_mass_gets_that_of_those_written_alike(geom, attribute, value):
    text = '<mujoco><default><default class="tyre"><geom size="0.1" mass="1"/></default>'
    text += '<default class="hub"><geom size="0.1" mass="0"/></default><geom size="0.1"/></default><worldbody>'
    wheels = [geom, '<geom class="tyre"/>', '<geom class="tyre"/>']
    text += "".join(f'<body name="w{n}" pos="{n} 0 1"><joint/>{each}</body>' for n, each in enumerate(wheels))
    (cause,) = causes(f"{text}</worldbody></mujoco>")
    assert (cause.rule, cause.attribute, cause.value) == ("massless-body", attribute, value)


@pytest.mark.parametrize(("limits", "value"), [('range="-30 45"', "-0.5236 0.7854"), ("", "0 1")])
def test_a_servo_without_the_control_range_that_its_class_wants_gets_that_of_its_joint(limits, value):
    elbow = f'<body><joint name="elbow" axis="0 1 0" {limits}/><geom size="0.1"/></body>'
    text = f"""<mujoco><default><position kp="10" kv="1" ctrllimited="true"/></default><worldbody>{elbow}</worldbody>
<actuator><position joint="elbow"/></actuator></mujoco>"""
    found = causes(text)[0]
    assert (found.rule, found.attribute, found.value) == ("invalid-value", "ctrlrange", value)


def test_a_joint_that_a_class_limits_without_a_range_is_kept():
    text = ARM.format("<default><joint limited='true'/></default>", "", "")
    (cause, *_) = causes(text)
    assert (cause.attribute, cause.value) == ("limited", "false")


@pytest.mark.parametrize(
    ("names", "text"), [("flag.glitter", '<option><flag glitter="enable"/></option>'), ("glitter", "<glitter/>")]
)
def test_what_a_newer_release_reads_is_no_mistake(names, text, monkeypatch):
    monkeypatch.setitem(SINCE, "9.0", [names])
    found = diagnosed(f'<mujoco>{text}<worldbody><geom size="0.1"/></worldbody></mujoco>')
    (hint,) = found.hints
    assert not found.causes
    assert not hint.edit
    assert "does not know `glitter`; MuJoCo 9.0 does." in hint.says


def test_materials_that_are_there_twice_are_taken_out_where_they_come_again():
    materials = "".join(f"<material name='{name}' rgba='1 0 0 1'/>" for name in ("link", "joint"))
    text = f"<mujoco><asset>{materials}<material name='table'/>{materials}</asset><worldbody/></mujoco>"
    found = mended(text)
    assert [(each.rule, each.value) for each in found.causes] == [("repeated-name", "removed")]
    assert found.fixed["model.xml"].count("<material") == 3
