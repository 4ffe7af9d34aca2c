"""Models that do not compile: the repair, not the message."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import Diagnosis, examine
from clinic.diagnosis.native import NativeEngine
from clinic.pages.messages import load_messages

MENDED = {  # messages that no rule mends, with the reason
    "missing-target": "what the actuator should drive is not in the text",
    "cable-plugin": "a plugin that is gone",
    "unrecognized-root": "no model",
    "file-not-found": "a file that is nowhere",
    "include-not-found": "a file that is nowhere",
}
CORNER = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
COMPILED = [message for message in load_messages() if message.xml is not None]


def diagnosed(text: str, tmp_path, monkeypatch) -> Diagnosis:
    folder = tmp_path / "around" / "model"  # the folder around a model is searched too
    folder.mkdir(parents=True, exist_ok=True)
    monkeypatch.chdir(folder)
    return examine(NativeEngine(), {"model.xml": text})


@pytest.mark.parametrize("message", COMPILED, ids=lambda message: message.id)
def test_what_mujoco_refuses_is_mended(message, tmp_path, monkeypatch):
    found = diagnosed(message.xml, tmp_path, monkeypatch)
    assert bool(found.causes) == (message.id not in MENDED), found.text()
    assert found.causes or found.hints
    if found.causes:
        assert not examine(NativeEngine(), dict(found.fixed)).error


def test_three_mistakes_are_named_in_turn_and_mended_together(tmp_path, monkeypatch):
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
    found = diagnosed(text, tmp_path, monkeypatch)
    assert [each.rule for each in found.causes] == ["unknown-attribute", "malformed-number", "unknown-reference"]
    assert [each.line for each in found.causes] == [5, 3, 8]
    assert found.diff().count("\n+") == 4  # three lines and the head


def test_a_file_elsewhere_below_the_folder_is_found(tmp_path, monkeypatch):
    meshes = tmp_path / "around" / "model" / "meshes"
    meshes.mkdir(parents=True)
    (meshes / "part.obj").write_text(CORNER)
    text = '<mujoco><asset><mesh name="part" file="Part.obj"/></asset><worldbody/></mujoco>'
    (found,) = diagnosed(text, tmp_path, monkeypatch).causes
    assert (found.rule, found.value) == ("missing-file", "meshes/part.obj")


@pytest.mark.parametrize(("there", "cause"), [("wedge.obj", True), ("wedge_v2.xml", False), ("pyramid.obj", False)])
def test_a_file_of_nearly_the_same_name_and_the_same_kind_is_meant(tmp_path, monkeypatch, there, cause):
    folder = tmp_path / "around" / "model"
    folder.mkdir(parents=True)
    (folder / there).write_text(CORNER)
    text = '<mujoco><asset><mesh name="part" file="wedge_v2.obj"/></asset><worldbody/></mujoco>'
    found = diagnosed(text, tmp_path, monkeypatch)
    assert [each.value for each in found.causes] == [there] * cause
    assert bool(found.hints) != cause


def test_a_file_that_is_nowhere_is_a_hint(tmp_path, monkeypatch):
    found = diagnosed('<mujoco><asset><mesh file="nowhere.obj"/></asset></mujoco>', tmp_path, monkeypatch)
    assert not found.causes
    assert [each.rule for each in found.hints] == ["missing-file"]


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
    ("", "<camera pos='0 0 2' lookat='0 0 0'/>", "", "unknown-attribute", "lookat", "zaxis='0 0 2'"),
]


@pytest.mark.parametrize(("top", "body", "end", "rule", "attribute", "value"), WRITTEN)
def test_what_people_write_is_mended(top, body, end, rule, attribute, value, tmp_path, monkeypatch):
    found = diagnosed(ARM.format(top, body, end), tmp_path, monkeypatch)
    first = found.causes[0]
    assert (first.rule, first.attribute, first.value) == (rule, attribute, value), found.text()
    assert first.says.rstrip(".") != found.error.splitlines()[0].rstrip(".")
    assert not examine(NativeEngine(), dict(found.fixed)).error


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
def test_what_is_there_twice_is_given_its_twin_where_none_has_that(end, attribute, value, tmp_path, monkeypatch):
    found = diagnosed(ARM.format("", CLAWS, end), tmp_path, monkeypatch)
    first = found.causes[0]
    assert (first.rule, first.attribute, first.value) == ("given-twice", attribute, value), found.text()
    assert not examine(NativeEngine(), dict(found.fixed)).error


@pytest.mark.parametrize(
    ("right", "attribute", "value"),
    [
        ("<body name='left_foot'><joint name='right_ankle'/>", "name", "right_foot"),
        ("<body name='right_leg'><geom name='left_foot' size='0.1'/>", "name", "left_foot_2"),
        ("<body name='left_foot'><joint name='right_toe'/>", "name", "left_foot_2"),
        ("<body name='left_foot'><joint/>", "name", "left_foot_2"),
    ],
)
def test_a_name_that_was_copied_is_changed_as_what_is_in_it_was(right, attribute, value, tmp_path, monkeypatch):
    left = "<body name='left_foot'><joint name='left_ankle'/><geom name='left_foot' size='0.1'/></body>"
    text = f"<mujoco><worldbody>{left}{right}<geom size='0.1'/></body></worldbody></mujoco>"
    found = diagnosed(text, tmp_path, monkeypatch)
    first = found.causes[0]
    assert (first.rule, first.attribute, first.value) == ("repeated-name", attribute, value), found.text()


URDF = """<robot name="r">{top}
  <link name="base"/>
  <link name="wheel">
    <inertial>{mass}<inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>{more}
    <collision><geometry>{shape}</geometry></collision>
  </link>
  <joint name="axle" type="{kind}"><parent link="base"/><child link="wheel"/>{axis}</joint>
</robot>
"""
WHEEL = {
    "top": "",
    "mass": '<mass value="1"/>',
    "more": "",
    "shape": '<sphere radius="1"/>',
    "kind": "continuous",
    "axis": "",
}
APART = '<mujoco><compiler fusestatic="false"/></mujoco>'
AGAIN = '<inertial><mass value="1"/></inertial>'


@pytest.mark.parametrize(
    ("changes", "rule", "value"),
    [
        ({"mass": ""}, "left-out", "1"),
        ({"mass": '<mass value="0"/>'}, "massless-body", "0.0025"),
        ({"mass": '<mass value="0"/>', "shape": '<cylinder radius="0.1" length="0.1"/>'}, "massless-body", "0.26"),
        ({"mass": '<mass value="0"/>', "shape": '<box size="0.1 0.1 0.1"/>'}, "massless-body", "0.6"),
        ({"more": AGAIN}, "given-twice", "removed"),
        ({"kind": "floating", "top": APART}, "misplaced-joint", "world"),
        ({"shape": '<sphere radius="0"/>'}, "invalid-value", "0.001"),
        ({"shape": '<cylinder radius="1" height="2"/>'}, "left-out", "length='2'"),
        ({"axis": '<axis xyz="0 0 0"/>'}, "invalid-value", "1 0 0"),
        ({"shape": '<mesh filename="flat.obj"/>'}, "unusable-file", "box"),
    ],
)
def test_what_is_wrong_in_a_urdf_is_mended(changes, rule, value, tmp_path, monkeypatch):
    folder = tmp_path / "around" / "model"
    folder.mkdir(parents=True)
    (folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 3 2\nf 2 3 4\n")
    found = diagnosed(URDF.format(**WHEEL | changes), tmp_path, monkeypatch)
    assert [(each.rule, each.value) for each in found.causes] == [(rule, value)], found.text()
    assert not examine(NativeEngine(), dict(found.fixed)).error


@pytest.mark.parametrize(
    ("parent", "child", "edits"),
    [
        pytest.param("left_thigh", "right_shank", [("child", "left_shank")], id="copied"),
        pytest.param("left_shank", "left_thigh", [("parent", "left_thigh"), ("child", "left_shank")], id="exchanged"),
        pytest.param("left_thigh", "right_thigh", [("child", "left_shank")], id="led-elsewhere"),
        pytest.param("pelvis", "left_thigh", [("child", "left_shank")], id="twice-from-one"),
    ],
)
def test_a_joint_to_a_link_that_has_one_leads_to_the_link_without(parent, child, edits, tmp_path, monkeypatch):
    inertia = '<inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/>'
    names = ("pelvis", "left_thigh", "left_shank", "right_thigh", "right_shank")
    links = "".join(f'<link name="{name}"><inertial><mass value="1"/>{inertia}</inertial></link>' for name in names)
    ends = {
        "left_hip": ("pelvis", "left_thigh"),
        "left_knee": (parent, child),
        "right_hip": ("pelvis", "right_thigh"),
        "right_knee": ("right_thigh", "right_shank"),
    }
    joints = "".join(
        f'<joint name="{name}" type="continuous"><parent link="{a}"/><child link="{b}"/></joint>'
        for name, (a, b) in ends.items()
    )
    (found,) = diagnosed(f'<robot name="r">{links}{joints}</robot>', tmp_path, monkeypatch).causes
    assert found.elements == ('<joint name="left_knee">',)
    assert [(each.element, each.value) for each in found.edit] == edits


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"solid x\nfacet normal 0 0 1\nouter loop\n" * 9, "ASCII"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:6dd0\nsize 132314\n" * 2, "git lfs pull"),
        (b"<!DOCTYPE html><html>" + b" " * 99, "page of the web"),
        (bytes(80) + (200_001).to_bytes(4, "little") + bytes(50 * 200_001), "200,001 faces"),
        (bytes(80) + (9).to_bytes(4, "little") + bytes(60), "cut off"),
    ],
)
def test_what_an_stl_file_is_instead_is_told(content, says, tmp_path, monkeypatch):
    folder = tmp_path / "around" / "model"
    folder.mkdir(parents=True)
    (folder / "part.stl").write_bytes(content)
    text = '<mujoco>\n<asset><mesh name="part" file="part.stl"/></asset>\n</mujoco>'
    (hint,) = diagnosed(text, tmp_path, monkeypatch).hints
    assert (hint.rule, hint.line) == ("unusable-file", 2)
    assert says in hint.says


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "empty"),
        ("<", "not XML"),
        ('<?xml version="1.0"?>\n<!-- nothing -->', "no element"),
        ("<package><name>arm</name></package>", "package.xml"),
        ('<sdf version="1.6"/>', "Gazebo"),
        ("version https://git-lfs.github.com/spec/v1", "git lfs pull"),
        (URDF.format(**WHEEL | {"shape": '<sphere radius="${r}"/>'}), "xacro"),
    ],
)
def test_what_is_no_model_is_told(text, says, tmp_path, monkeypatch):
    found = diagnosed(text, tmp_path, monkeypatch)
    assert not found.causes
    assert [each.rule for each in found.hints] == ["not-a-model"]
    assert says in found.hints[0].says


@pytest.mark.parametrize(("mark", "end"), [("", "\n"), ("\ufeff", "\r\n")])
def test_the_right_one_of_twenty_is_named(mark, end, tmp_path, monkeypatch):
    sizes = ["-0.1" if number == 13 else "0.1" for number in range(20)]
    lines = "".join(f"\n<geom size='{size}'/>" for size in sizes)
    text = mark + f"<mujoco>\n<worldbody>{lines}\n</worldbody>\n</mujoco>".replace("\n", end)
    (cause,) = diagnosed(text, tmp_path, monkeypatch).causes
    assert (cause.line, cause.now, cause.value) == (16, "-0.1", "0.1")


def test_the_same_mistake_twenty_times_is_mended_everywhere(tmp_path, monkeypatch):
    lines = "".join(f"\n<geom size='0.{number + 1};0.1' type='capsule'/>" for number in range(20))
    found = diagnosed(f"<mujoco>\n<worldbody>{lines}\n</worldbody>\n</mujoco>", tmp_path, monkeypatch)
    assert [edit.line for each in found.causes for edit in each.edit] == list(range(3, 23))
    assert not examine(NativeEngine(), dict(found.fixed)).error


def test_what_an_included_file_has_wrong_is_told_there(tmp_path, monkeypatch):
    text = "<mujoco>\n<include file='part.xml'/>\n<worldbody>\n<geom size='0.1'/>\n</worldbody>\n</mujoco>"
    part = (
        "<mujoco>\n<worldbody>\n<geom size='0.1'/>\n<geom size='0.1 mm'/>\n<geom type='cube'/>\n</worldbody>\n</mujoco>"
    )
    monkeypatch.chdir(tmp_path)
    found = examine(NativeEngine(), {"model.xml": text, "part.xml": part})
    assert [(each.file, each.line) for each in found.causes] == [("part.xml", 4), ("part.xml", 5), ("part.xml", 5)]


WHOLE = """<mujoco>
  <default>
    <geom friction="0.9"
          condim="4"/>
  </default>
  <worldbody>
    <body name="arm" pos="0 0 1">
      <joint name="elbow" axis="0 1 0"/>
      <geom name="link" size="0.1"/>
      <body name="hand" pos="0 0 1">
        <geom name="palm" size="0.1"/>
      </body>
      <body name="tool" pos="0 1 0">
        <geom name="tip" size="0.1"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor name="motor" joint="elbow"/>
  </actuator>
</mujoco>
"""
HARMED = {  # what a slip of the hand makes of a part of the text
    "a quote is left out before": ('"0 0 1">\n      <joint', '0 0 1">\n      <joint'),
    "a quote is left out after": ('name="arm" pos', 'name="arm pos'),
    "an attribute stands twice, in two lines": ('condim="4"', 'condim="4"\n          condim="4"'),
    "a tag is opened twice": ("  <worldbody>\n", "  <worldbody>\n  <worldbody>\n"),
    "a tag is closed twice": ("  </worldbody>\n", "  </worldbody>\n  </worldbody>\n"),
    "a section is not closed": ("  </worldbody>\n", ""),
    "a body is not closed": ("      </body>\n      <body", "      <body"),
    "a geom is not closed": ('"palm" size="0.1"/>', '"palm" size="0.1">'),
    "a tag has no end": ('"tool" pos="0 1 0">', '"tool" pos="0 1 0"'),
    "a closing tag has no end": ("</body>\n    </body>", "</body\n    </body>"),
    "a tag has no beginning": ("  <worldbody>", "  worldbody>"),
    "a name is misspelt where it is closed": ("</actuator>", "</actuater>"),
    "a character that is none": ("<motor", "<mo\0tor"),
    "a name is misspelt where it is opened": ("  <worldbody>", "  <worldbdy>"),
    "a tag is opened where it should be closed": ("  </worldbody>", "  <worldbody>"),
    "a tag is empty where it should be closed": ("  </worldbody>", "  <worldbody/>"),
    "a slash is left out before another element": ('"0 1 0"/>\n      <geom', '"0 1 0">\n      <geom'),
    "an equals sign is left out": ('axis="0', 'axis "0'),
    "an equals sign is a colon": ('name="elbow"', 'name:"elbow"'),
    "an equals sign is typed too late": ('name="elbow"', 'name"=elbow"'),
    "an equals sign and a quote are left out": ('axis="0', "axis0"),
    "a quote is doubled": ('name="elbow"', 'name="elbow""'),
    "a quote is another": ('name="elbow"', "name=\"elbow'"),
    "a quote is a mark": ('name="elbow"', 'name="elbow@'),
    "quotes are left out": ('name="elbow"', "name=elbow"),
    "quotes are those of prose": ('name="elbow"', "name=\u201celbow\u201d"),
    "a bracket is doubled": ("<joint", "<<joint"),
    "a slash has a blank behind": ('"0 1 0"/>', '"0 1 0"/ >'),
    "a slash is typed too early": ('"0 1 0"/>', '"0 1 0/">'),
    "a slash is a backslash": ('"0 1 0"/>', '"0 1 0"\\>'),
    "slash and bracket are left out": ('"palm" size="0.1"/>', '"palm" size="0.1"'),
    "a name runs into the next": ("<joint name", "<jointname"),
    "an attribute has no value": ("<joint name", "<joint limited name"),
    "a tag has no beginning, and what it names is missed": ("<joint", "joint"),
    "a tag is put in for a program": ("  <actuator>", "  <?x y?><actuator>"),
    "a merge leaves one mark": ("  <actuator>", "<<<<<<< HEAD\n  <actuator>"),
    "a merge leaves a mark that is indented": ("  <actuator>", "  <<<<<<< HEAD\n  <actuator>"),
    "the root is not opened": ("<mujoco>\n", ""),
}


@pytest.mark.parametrize("harm", HARMED)
def test_a_slip_in_the_tags_is_undone_and_nothing_else_is_touched(harm, tmp_path, monkeypatch):
    before, after = HARMED[harm]
    assert WHOLE.count(before) == 1
    found = diagnosed(WHOLE.replace(before, after), tmp_path, monkeypatch)
    assert [each.rule for each in found.causes] == ["malformed-xml"], found.text()
    assert found.fixed["model.xml"] == WHOLE


def test_tags_that_run_into_each_other_in_one_line_are_parted(tmp_path, monkeypatch):
    line = '<body name="toe" pos="0 0 1"><joint name="j"/><geom size="0.1"/></body>'
    whole = WHOLE.replace("  </worldbody>", f"    {line}\n  </worldbody>")
    for wrong in ('1"<joint name="j"/>', '1"><joint name="j">', '1"><joint name="j"/'):
        text = whole.replace('1"><joint name="j"/>', wrong)
        assert text != whole
        assert diagnosed(text, tmp_path, monkeypatch).fixed["model.xml"] == whole


def test_a_body_in_a_line_that_is_not_closed_is_closed_there(tmp_path, monkeypatch):
    bodies = "".join(f'    <body name="b{n}" pos="{n} 0 1"><geom size="0.1"/></body>\n' for n in range(9))
    whole = WHOLE.replace("  </worldbody>", f"{bodies}  </worldbody>")
    line = '<body name="b3" pos="3 0 1"><geom size="0.1"/>'
    found = diagnosed(whole.replace(f"{line}</body>", line), tmp_path, monkeypatch)
    assert found.fixed["model.xml"].split() == whole.replace(f"{line}</body>", f"{line}\n</body>").split()


def test_single_quotes_are_kept(tmp_path, monkeypatch):
    whole = WHOLE.replace('"', "'")
    for right in ("name='elbow'", "size='0.1'/>\n      <body", "axis='0"):
        wrong = right.replace("'", "", 1) if right.startswith("axis") else right[::-1].replace("'", "", 1)[::-1]
        found = diagnosed(whole.replace(right, wrong), tmp_path, monkeypatch)
        assert found.fixed["model.xml"] == whole


def test_a_character_that_is_not_seen_is_told_by_its_number(tmp_path, monkeypatch):
    (cause,) = diagnosed(WHOLE.replace("<motor", "<mo\x7ftor"), tmp_path, monkeypatch).causes
    assert (cause.now, cause.value) == ("<mo\\x7ftor", "<motor")


def test_two_slips_are_told_each_at_its_place(tmp_path, monkeypatch):
    wrong = WHOLE.replace('axis="0', 'axis "0').replace('"tip" size="0.1"/>', '"tip" size="0.1/>')
    found = diagnosed(wrong, tmp_path, monkeypatch)
    assert [(each.line, each.now, each.value) for each in found.causes] == [
        (8, 'axis "0', 'axis="0'),
        (14, 'size="0.1/>', 'size="0.1"/>'),
    ]
    assert 'found `axis "0`, expected `axis="0`' in found.causes[0].says
    assert found.fixed["model.xml"] == WHOLE


def test_a_name_that_is_typed_wrong_is_not_taken_for_too_much(tmp_path, monkeypatch):
    found = diagnosed(
        WHOLE.replace("<actuator", "<:actuator").replace("</actuator", "</:actuator"), tmp_path, monkeypatch
    )
    assert [each.rule for each in found.causes] == ["unknown-element"]


def test_of_a_body_that_is_not_opened_only_the_end_is_taken(tmp_path, monkeypatch):
    found = diagnosed(WHOLE.replace('      <body name="hand" pos="0 0 1">\n', ""), tmp_path, monkeypatch)
    assert found.diff().count("\n-") == 1
    assert "</body> of line 11 closes nothing" in found.causes[0].says
    assert '<motor name="motor" joint="elbow"/>' in found.fixed["model.xml"]


def test_of_a_conflict_that_a_merge_has_left_the_first_side_is_kept(tmp_path, monkeypatch):
    sides = "<<<<<<< HEAD\n  <actuator>\n=======\n  <actuator><!-- theirs -->\n>>>>>>> theirs\n"
    assert WHOLE.count("  <actuator>\n") == 1
    found = diagnosed(WHOLE.replace("  <actuator>\n", sides), tmp_path, monkeypatch)
    assert found.fixed["model.xml"] == WHOLE
    assert "both sides of a conflict" in found.causes[0].says


def test_the_second_side_of_a_conflict_is_kept_where_only_that_compiles(tmp_path, monkeypatch):
    sides = "<<<<<<< HEAD\n  <actuators>\n=======\n  <actuator>\n>>>>>>> theirs\n"
    found = diagnosed(WHOLE.replace("  <actuator>\n", sides), tmp_path, monkeypatch)
    assert found.fixed["model.xml"] == WHOLE


@pytest.mark.parametrize("end", ["->", "-- >"])
def test_a_comment_ends_at_its_arrow(end, tmp_path, monkeypatch):
    found = diagnosed(WHOLE.replace("  <actuator>", f"  <!-- the motors {end}\n  <actuator>"), tmp_path, monkeypatch)
    assert found.fixed["model.xml"] == WHOLE.replace("  <actuator>", "  <!-- the motors -->\n  <actuator>")


def test_a_comment_that_has_no_end_ends_with_its_line(tmp_path, monkeypatch):
    found = diagnosed(WHOLE.replace("  <actuator>", "  <!-- the motors\n  <actuator>"), tmp_path, monkeypatch)
    assert found.fixed["model.xml"] == WHOLE.replace("  <actuator>", "  <!-- the motors -->\n  <actuator>")


@pytest.mark.parametrize("end", ['"tip" si', "<body na", '"palm" size="0.1"/>'])
def test_a_text_that_was_cut_off_is_told_as_such(end, tmp_path, monkeypatch):
    found = diagnosed(WHOLE[: WHOLE.index(end) + len(end)], tmp_path, monkeypatch)
    assert "as if the rest of the file were missing" in found.causes[0].says
    assert not examine(NativeEngine(), dict(found.fixed)).error


def test_a_number_beyond_all_bounds_is_told_and_nothing_else_is_written(tmp_path, monkeypatch):
    found = diagnosed(ARM.format("", '<light dir="0 1e400 -1"/>', ""), tmp_path, monkeypatch)
    (cause,) = found.causes
    assert (cause.rule, cause.attribute, cause.value) == ("malformed-number", "dir", "left out")
    assert "largest number" in cause.says


@pytest.mark.parametrize(
    ("attribute", "now", "value"), [("pos", "abc 0 0.5", "0 0 0.5"), ("zaxis", "0 abc 0", "0 1 0")]
)
def test_a_word_among_numbers_gives_its_own_place(attribute, now, value, tmp_path, monkeypatch):
    (cause,) = diagnosed(ARM.format("", f'<site {attribute}="{now}"/>', ""), tmp_path, monkeypatch).causes
    assert (cause.attribute, cause.value) == (attribute, value)


def test_an_element_that_was_pasted_twice_is_taken_out(tmp_path, monkeypatch):
    found = diagnosed(
        WHOLE.replace('        <geom name="tip"', 2 * '        <geom name="tip" size="0.1"/>\n' + "        <geom"),
        tmp_path,
        monkeypatch,
    )
    assert [each.value for each in found.causes] == ["removed"]
    assert found.fixed["model.xml"].count('name="tip"') == 1
    assert found.fixed["model.xml"].count("<geom") == 5


def test_the_part_of_the_other_side_is_not_taken_for_one_that_is_missing(tmp_path, monkeypatch):
    text = ARM.format("", "<body><joint name='right_knee'/><geom size='0.1'/></body>", "<actuator>{0}</actuator>")
    found = diagnosed(text.format("<motor joint='left_knee'/>"), tmp_path, monkeypatch)
    (hint,) = found.hints
    assert not found.causes
    assert "'right_knee' is another of its kind" in hint.says
    assert diagnosed(text.format("<motor joint='rihgt_knee'/>"), tmp_path, monkeypatch).causes[0].value == "right_knee"


def test_a_joint_of_a_urdf_without_parent_goes_to_the_link_that_is_called_most_like_it(tmp_path, monkeypatch):
    links = "".join(f"<link name='{name}'/>" for name in ("pelvis", "l_uarm", "l_larm", "head"))
    text = f"<robot name='r'>{links}"
    for parent, child in (("pelvis", "l_uarm"), ("", "l_larm"), ("pelvis", "head")):
        end = f"<parent link='{parent}'/>" if parent else ""
        text += f"<joint name='to_{child}' type='fixed'>{end}<child link='{child}'/></joint>"
    (cause,) = diagnosed(f"{text}</robot>", tmp_path, monkeypatch).causes
    assert (cause.attribute, cause.value) == ("parent", "l_uarm")


def test_a_joint_right_before_a_body_without_one_is_put_into_it(tmp_path, monkeypatch):
    joint, body = '      <joint name="elbow" axis="0 1 0"/>\n', '    <body name="arm" pos="0 0 1">\n'
    found = diagnosed(WHOLE.replace(body + joint, joint + body), tmp_path, monkeypatch)
    assert found.fixed["model.xml"] == WHOLE


@pytest.mark.parametrize(
    "wrong",
    [
        WHOLE.replace("  </worldbody>\n", "").replace("</mujoco>", "<sensor><clock/></sensor></worldbody></mujoco>"),
        WHOLE.replace("  <actuator>", '  <jointpos joint="elbow"/>\n  <jointpos joint="elbow"/>\n  <actuator>'),
        WHOLE.replace("  <actuator>\n", "").replace("  </actuator>\n", '    <motor joint="elbow"/>\n'),
    ],
)
def test_elements_that_stand_outside_of_their_section_are_moved_and_none_is_lost(wrong, tmp_path, monkeypatch):
    found = diagnosed(wrong, tmp_path, monkeypatch)
    assert {each.rule for each in found.causes} == {"unknown-element"}, found.text()
    for kept in ("<motor", "<clock", "<jointpos", "<geom"):
        assert found.fixed["model.xml"].count(kept) == wrong.count(kept)
    assert not examine(NativeEngine(), dict(found.fixed)).error


def test_a_value_is_written_as_xml_has_it(tmp_path, monkeypatch):
    found = diagnosed(ARM.format("", "<site nme='a \"b\" &lt; &amp;'/>", ""), tmp_path, monkeypatch)
    assert 'name="a &quot;b&quot; &lt; &amp;"' in found.fixed["model.xml"]
    assert not examine(NativeEngine(), dict(found.fixed)).error


def test_a_long_value_is_shortened_for_a_terminal_alone(tmp_path, monkeypatch):
    found = diagnosed(ARM.format("", f"<site pos='{'x' * 10_000}'/>", ""), tmp_path, monkeypatch)
    assert len(found.text()) < 2000
    assert found.causes[0].now == "x" * 10_000


GRIPPER = """<mujoco>
  <compiler angle="degree"/>
  <default>
    <default class="finger">
      <joint type="slide" axis="0 1 0" range="0 0.04"/>
      <geom type="box" size="0.01 0.01 0.03"/>
    </default>
    <default class="cable"><joint type="ball"/></default>
  </default>
  <worldbody>
    <body name="hand" pos="0 0 1">
      <geom size="0.03"/>
      <body name="lfinger" pos="0 0.03 0.05" childclass="finger"><joint name="lf"/><geom name="l"/></body>
      <body name="rfinger" pos="0 -0.03 0.05" childclass="finger">
        <joint name="rf" axis="0 -1 0"/>
        <geom name="r"/>
      </body>
    </body>
    <body name="rope" pos="1 0 1" childclass="cable"><joint name="j2"/><geom size="0.01"/></body>
  </worldbody>
  <equality><joint joint1="lf" joint2="rf"/></equality>
  <actuator><position joint="rf" kp="10"/><motor joint="j2"/></actuator>
</mujoco>
"""


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        pytest.param('pos="0 0.03 0.05" childclass="finger"', 'pos="0 0.03 0.05"', id="childclass-of-the-twin"),
        pytest.param('<joint name="rf"', '<joint name="lf"', id="name-that-is-missed"),
        pytest.param('<motor joint="j2"', '<motor joint="joint2"', id="abbreviation"),
    ],
)
def test_what_the_rest_of_the_text_tells_is_put_back(right, wrong, tmp_path, monkeypatch):
    assert not diagnosed(GRIPPER, tmp_path, monkeypatch).error
    assert GRIPPER.count(right) == 1
    found = diagnosed(GRIPPER.replace(right, wrong), tmp_path, monkeypatch)
    (mended,) = found.fixed.values()
    assert sorted(mended.split()) == sorted(GRIPPER.split())


def test_a_free_joint_inside_is_what_its_class_says(tmp_path, monkeypatch):
    inner = '<geom size="0.01"/><body><joint name="j3" type="free"/><geom size="0.01"/></body>'
    text = GRIPPER.replace('<geom size="0.01"/>', inner)
    (cause,) = diagnosed(text, tmp_path, monkeypatch).causes
    assert (cause.attribute, cause.value) == ("type", "ball")


def test_a_joint_that_a_class_limits_without_a_range_is_kept(tmp_path, monkeypatch):
    text = ARM.format("<default><joint limited='true'/></default>", "", "")
    (cause, *_) = diagnosed(text, tmp_path, monkeypatch).causes
    assert (cause.attribute, cause.value) == ("limited", "false")


def test_seven_numbers_more_that_begin_with_a_pose_are_those_of_a_lost_free_joint(tmp_path, monkeypatch):
    leg = '<body pos="0 0 -0.1"><joint name="knee" axis="0 1 0"/><geom size="0.05"/></body>'
    text = '<mujoco><worldbody><body name="trunk" pos="0 0 1">{}<geom size="0.1"/>' + leg + "</body></worldbody>"
    text += '<keyframe><key name="home" qpos="0 0 0.4 1 0 0 0 0.3"/></keyframe></mujoco>'
    (cause,) = diagnosed(text.format(""), tmp_path, monkeypatch).causes
    assert (cause.attribute, cause.elements) == ("freejoint", ('<body name="trunk">',))
    assert not diagnosed(text.format("<freejoint/>"), tmp_path, monkeypatch).causes


LEG = '<body><joint axis="0 1 0"/><geom size="0.1"/></body>'


@pytest.mark.parametrize(
    ("around", "beside", "value"),
    [
        ("", "", 'moved into <body name="frame">'),
        (
            '<geom size="0.1"/>',
            '<body><joint axis="0 1 0"/><geom size="0.1"/></body>',
            'moved into <body name="frame">',
        ),
        ('<geom size="0.1"/>', "", "removed"),  # a table with a cube on it does not fly
        ('<joint axis="0 1 0"/><geom size="0.1"/>', "", "removed"),
    ],
)
def test_a_free_joint_is_put_into_the_body_that_carries_its_own(around, beside, value, tmp_path, monkeypatch):
    inner = '<body name="inner"><freejoint/><geom size="0.1"/></body>'
    text = f'<mujoco><worldbody><body name="frame" pos="0 0 1">{around}{inner}{beside}</body></worldbody></mujoco>'
    (cause,) = diagnosed(text, tmp_path, monkeypatch).causes
    assert (cause.rule, cause.value) == ("misplaced-joint", value)


@pytest.mark.parametrize(
    ("geom", "attribute", "value"),
    [
        pytest.param('<geom class="hub"/>', "class", "tyre", id="another-class"),
        pytest.param('<geom class="tyre" mass="0"/>', "mass", "left out", id="mass-taken"),
    ],
)
def test_a_body_without_mass_gets_that_of_those_written_alike(geom, attribute, value, tmp_path, monkeypatch):
    text = '<mujoco><default><default class="tyre"><geom size="0.1" mass="1"/></default>'
    text += '<default class="hub"><geom size="0.1" mass="0"/></default><geom size="0.1"/></default><worldbody>'
    wheels = [geom, '<geom class="tyre"/>', '<geom class="tyre"/>']
    text += "".join(f'<body name="w{n}" pos="{n} 0 1"><joint/>{each}</body>' for n, each in enumerate(wheels))
    (cause,) = diagnosed(f"{text}</worldbody></mujoco>", tmp_path, monkeypatch).causes
    assert (cause.rule, cause.attribute, cause.value) == ("massless-body", attribute, value)


@pytest.mark.parametrize(("limits", "value"), [('range="-30 45"', "-0.5236 0.7854"), ("", "0 1")])
def test_a_servo_without_the_control_range_that_its_class_wants_gets_that_of_its_joint(
    limits, value, tmp_path, monkeypatch
):
    elbow = f'<body><joint name="elbow" axis="0 1 0" {limits}/><geom size="0.1"/></body>'
    text = f"""<mujoco><default><position kp="10" kv="1" ctrllimited="true"/></default><worldbody>{elbow}</worldbody>
<actuator><position joint="elbow"/></actuator></mujoco>"""
    found = diagnosed(text, tmp_path, monkeypatch).causes[0]
    assert (found.rule, found.attribute, found.value) == ("invalid-value", "ctrlrange", value)


@pytest.mark.parametrize(
    ("tray", "qpos", "moved"),
    [
        pytest.param("", "0.1 0 0 0.1 1 0 0 0", '<body name="ball"><freejoint/>', id="at-the-origin"),
        pytest.param('pos="0 0 1"', "0.1 0 0 1.1 1 0 0 0", '<frame pos="0 0 1"><body name="ball">', id="above-it"),
        pytest.param("", "0.1", "", id="keyframes-without-it"),
    ],
)
def test_a_ball_inside_its_tray_is_put_into_the_world_where_keyframes_have_it(tray, qpos, moved, tmp_path, monkeypatch):
    ball = '<body name="ball"><freejoint/><geom size="0.1"/></body>'
    body = f'<body name="tray" {tray}><joint axis="0 1 0"/><geom type="box" size="1 1 0.01"/>{ball}</body>'
    text = f'<mujoco><worldbody>{body}</worldbody><keyframe><key qpos="{qpos}"/></keyframe></mujoco>'
    (found,) = diagnosed(text, tmp_path, monkeypatch).causes
    inserted = [edit.value for edit in found.edit if edit.action == "insert"]
    assert (found.rule, len(inserted)) == ("misplaced-joint", bool(moved))
    assert not moved or inserted[0].startswith(moved)
