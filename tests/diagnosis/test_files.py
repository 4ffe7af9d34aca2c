"""Files that a model names and that are elsewhere, nowhere or something else; what is no model."""

from __future__ import annotations

import pytest
from diagnosed import causes, diagnosed, hints

pytestmark = pytest.mark.usefixtures("folder")

CORNER = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"


def test_a_file_elsewhere_below_the_folder_is_found(folder):
    (folder / "meshes").mkdir()
    (folder / "meshes" / "part.obj").write_text(CORNER)
    text = '<mujoco><asset><mesh name="part" file="Part.obj"/></asset><worldbody/></mujoco>'
    (found,) = causes(text)
    assert (found.rule, found.value) == ("missing-file", "meshes/part.obj")


@pytest.mark.parametrize(("there", "cause"), [("wedge.obj", True), ("wedge_v2.xml", False), ("pyramid.obj", False)])
def test_a_file_of_nearly_the_same_name_and_the_same_kind_is_meant(folder, there, cause):
    (folder / there).write_text(CORNER)
    text = '<mujoco><asset><mesh name="part" file="wedge_v2.obj"/></asset><worldbody/></mujoco>'
    found = diagnosed(text)
    assert [each.value for each in found.causes] == [there] * cause
    assert bool(found.hints) != cause


def test_a_file_that_is_nowhere_is_a_hint():
    found = diagnosed('<mujoco><asset><mesh file="nowhere.obj"/></asset></mujoco>')
    assert not found.causes
    assert [each.rule for each in found.hints] == ["missing-file"]


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
def test_what_an_stl_file_is_instead_is_told(content, says, folder):
    (folder / "part.stl").write_bytes(content)
    text = '<mujoco>\n<asset><mesh name="part" file="part.stl"/></asset>\n</mujoco>'
    (hint,) = hints(text)
    assert (hint.rule, hint.line) == ("unusable-file", 2)
    assert says in hint.says


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "empty"),
        ("<package><name>arm</name></package>", "package.xml"),
        ('<sdf version="1.6"/>', "Gazebo"),
        ("version https://git-lfs.github.com/spec/v1", "git lfs pull"),
        (
            '<robot name="r"><link name="base"><inertial><mass value="${m}"/></inertial></link></robot>',
            "xacro",
        ),
    ],
)
def test_what_is_no_model_is_told(text, says):
    found = diagnosed(text)
    assert not found.causes
    assert [each.rule for each in found.hints] == ["not-a-model"]
    assert says in found.hints[0].says
