"""Models without their meshes and pictures: what is wrong besides is found all the same."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.diagnosis.start import Start, StartError
from diagnosed import diagnosed, findings

ARM = """<mujoco model="arm">
  <compiler angle="radian" meshdir="meshes"/>
  <asset>
    <texture name="sky" type="skybox" file="sky.png"/>
    <mesh name="upper" file="upper.stl" scale="0.001 0.001 0.001"/>
    <mesh file="lower.stl" scale="0.001 0.001 0.001"/>
    <hfield name="hills" file="hills.png" size="5 5 1 0.1"/>
    <skin file="skin.skn"/>
  </asset>
  <worldbody>
    <geom name="ground" type="hfield" hfield="hills" pos="0 0 -2"/>
    <body name="arm" pos="0 0 0.2">
      <joint name="shoulder" axis="0 1 0" range="-1.5 1.5" damping="5"/>
      <geom name="upper" type="mesh" mesh="upper"/>
      <body name="forearm" pos="0 0 0.3">
        <joint name="elbow" axis="0 1 0" range="-1.5 1.5" damping="5"/>
        <geom name="lower" type="mesh" mesh="lower"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <position name="shoulder" joint="shoulder" kp="500" ctrlrange="-1.5 1.5"/>
    <position name="elbow" joint="elbow" kp="500" ctrlrange="-1.5 1.5"/>
  </actuator>
</mujoco>
"""
URDF = """<robot name="arm">
  <link name="base"/>
  <link name="link">
    <inertial>
      <mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><geometry><mesh filename="package://arm/link.stl"/></geometry></collision>
  </link>
  <joint name="elbow" type="revolute"><limit lower="-1.6" upper="1.6" effort="10" velocity="1"/>
    <parent link="base"/><child link="link"/><axis xyz="0 1 0"/>
  </joint>
</robot>
"""


@pytest.fixture(autouse=True)
def meshes(folder: Path) -> None:
    """An empty folder for them."""
    (folder / "meshes").mkdir()


def test_of_a_well_model_only_the_files_are_told():
    found = diagnosed(ARM)
    assert "opening file" in found.error
    assert [each.rule for each in (*found.causes, *found.hints)] == ["missing-file"], found.text()
    assert "So it is with 4 more." in found.hints[0].says
    assert found.fixed == found.texts


@pytest.mark.parametrize(
    ("text", "written", "wrong", "rule"),
    [
        (ARM, 'elbow" kp="500" ctrlrange="-1.5', 'elbow" kp="500" ctrlrange="-150', "control-range-too-wide"),
        (ARM, 'elbow" axis="0 1 0" range="-1.5 1.5"', 'elbow" axis="0 1 0" range="0 0"', "range-empty"),
        (URDF, 'lower="-1.6" upper="1.6"', 'lower="-90" upper="90"', "range-in-the-wrong-unit"),
    ],
    ids=["servo", "joint", "URDF"],
)
def test_what_is_wrong_besides_is_a_hint_at_its_line(text, written, wrong, rule):
    assert rule not in [each.rule for each in diagnosed(text).hints]
    found = diagnosed(text.replace(written, wrong))
    assert not found.causes
    line = text.partition(written)[0].count("\n") + 1
    assert (rule, line) in [(each.rule, each.line) for each in found.hints], found.text()
    assert not {"masks", "visual-mass", "overlap-at-start"} & {*found.ruled_out}, "boxes say nothing of these"


def test_what_else_keeps_it_from_compiling_is_told_too():
    key = '<keyframe>\n<key name="home" qpos="0 0 0"/>\n</keyframe>'
    text = ARM.replace("<asset>", f"{key}\n<asset>").replace(
        'elbow" axis="0 1 0" range="-1.5 1.5"', 'elbow" range="0 0"'
    )
    found = diagnosed(text)
    assert [each.rule for each in found.causes] == ["keyframe-size"]
    assert [each.rule for each in found.hints] == ["missing-file", "range-empty"], found.text()
    assert "What else" not in found.causes[0].says
    assert found.hints[1].line == text.partition('elbow" range')[0].count("\n") + 1


def test_behind_an_error_that_is_mended_the_rest_is_a_hint():
    text = BOX.format(files='builtin="flat" width="8" height="48"')
    text = text.replace('name="floor"', 'name="floor"\n colour="red"')
    found = diagnosed(text)
    assert [each.rule for each in found.causes] == ["unknown-attribute"], found.text()
    assert "mended" in found.causes[-1].says
    (hint,) = found.hints
    assert (hint.rule, hint.line) == ("overlap-at-start", text.partition("<body")[0].count("\n") + 1)
    assert "mended" not in diagnosed(text.replace("0 0 0.02", "0 0 0.2")).causes[-1].says


QUADROTOR = """<mujoco>
  <asset><mesh name="frame" file="frame.stl"/></asset>
  <worldbody>
    <light pos="0 0 5"/>
    <geom type="plane" size="10 10 1"/>
    <body name="quad" pos="0 0 1">
      <freejoint/>
      <geom type="mesh" mesh="frame" density="400"/>
      <site name="m1" pos="0.15 0.15 0"/><site name="m2" pos="-0.15 -0.15 0"/><site name="gps" pos="0 0 0.6"/>
    </body>
  </worldbody>
  <actuator>
    <motor site="m1" gear="0 0 1 0 0 0.02" ctrlrange="0 20"/><motor site="m2" gear="0 0 1 0 0 -0.02" ctrlrange="0 20"/>
  </actuator>
  <keyframe><key name="hover" qpos="0 0 1 1 0 0 0" ctrl="9.4 9.4"/></keyframe>
</mujoco>
"""
BOX = """<mujoco>
  <asset><texture name="sky" type="cube" {files}/><material name="m" texture="sky"/></asset>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 .1"/>
    <body name="box" pos="0 0 0.02"><freejoint/><geom type="box" size="0.1 0.1 0.1" material="m" mass="1"/></body>
  </worldbody>
</mujoco>
"""
SIDES = ("right", "left", "up", "down", "front", "back")


def test_nothing_is_told_that_the_size_of_a_box_decides():
    found = diagnosed(QUADROTOR)
    assert [each.rule for each in found.hints] == ["missing-file"], found.text()


def test_without_its_pictures_a_model_is_diagnosed_as_with_them():
    missing = diagnosed(BOX.format(files=" ".join(f'file{side}="{side}.png"' for side in SIDES)))
    there = diagnosed(BOX.format(files='builtin="flat" width="8" height="48"'))
    assert [each.rule for each in missing.causes] == [each.rule for each in there.causes] == ["overlap-at-start"]
    assert missing.diff().count("\n+") == there.diff().count("\n+")
    (file,) = (each for each in missing.hints if each.rule == "missing-file")
    assert "5 more" in file.says
    assert "mesh" not in file.says


def test_the_file_that_is_there_is_not_the_one_of_that_name_that_is_not():
    with open("meshes/link.obj", "w") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    meshes = '<mesh name="a" file="meshes/link.obj"/>\n<mesh name="b" file="collision/link.obj"/>'
    (cause,) = diagnosed(f"<mujoco><asset>{meshes}</asset></mujoco>").causes
    assert (cause.rule, cause.line, cause.value) == ("missing-file", 2, "meshes/link.obj")


@pytest.mark.parametrize(("select", "ignore"), [(["range-empty"], []), ([], ["missing-file"])])
def test_where_the_missing_file_may_not_be_told_nothing_behind_it_is(select, ignore):
    text = ARM.replace('elbow" axis="0 1 0" range="-1.5 1.5"', 'elbow" axis="0 1 0" range="0 0"')
    assert "range-empty" not in {each.rule for each in findings(text, *select, ignore=ignore)}


def test_a_keyframe_that_is_not_there_is_told():
    with pytest.raises(StartError):
        diagnosed(ARM, start=Start(keyframe="home"))


@pytest.mark.parametrize("ending", ["stl", "obj"])
def test_a_pointer_of_git_is_told_as_one(ending):
    with open(f"meshes/upper.{ending}", "w") as file:
        file.write("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n")
    lines = (line for line in ARM.splitlines() if "sky" not in line and "skin" not in line and "hills" not in line)
    text = "\n".join(lines).replace('"lower.stl" scale="0.001 0.001 0.001"', '"lower" vertex="0 0 0 1 0 0 0 1 0 0 0 1"')
    text = text.replace('mesh file="lower"', 'mesh name="lower"').replace("upper.stl", f"upper.{ending}")
    found = diagnosed(text)
    assert not found.causes, found.text()
    assert "git lfs pull" in found.hints[0].says
