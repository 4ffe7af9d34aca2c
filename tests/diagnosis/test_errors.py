"""Models that do not compile: the repair, not the message."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import Diagnosis, examine
from clinic.diagnosis.native import NativeEngine
from clinic.pages.messages import load_messages

MENDED = {  # messages that no rule mends, with the reason
    "missing-target": "what the actuator should drive is not in the text",
    "lengthrange": "a muscle's geometry",
    "mesh-coplanar": "a mesh that is flat",
    "mesh-vertices": "a mesh of three points",
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
