"""The reader's model and a cause's edit, as the page's playground takes them, against MuJoCo's own reading."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import mujoco
import pytest
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.edit import apply
from clinic.diagnosis.finding import Diagnosis
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.start import Start
from clinic.engine.node import executable as node

pytestmark = pytest.mark.xdist_group("parity")
SKINNED = """<?xml version="1.0"?>
<!-- a part -->
<mujoco model="part">
  <worldbody>
    <body name="{name}" pos="{x} 0 2">
      <freejoint/>
      <geom size="0.05" contype="0" conaffinity="0"/>
      <geom size="0.05" mass="0.2"/>
    </body>
  </worldbody>
</mujoco>
"""
FILES = {
    "scene.xml": """<mujoco>
  <!-- <include file="left.xml"/> -->
  <include file="left.xml"/>
  <include file='both.xml'></include>
  <keyframe><key/><key name="up" qpos="0 0 3 1 0 0 0 1 0 3 1 0 0 0"/></keyframe>
</mujoco>
""",
    "left.xml": SKINNED.format(name="left", x=0),
    "both.xml": '<mujocoinclude><include file="right.xml" /></mujocoinclude>',
    "right.xml": SKINNED.format(name="right", x=1),
}


def tried(root: Path, tmp_path: Path, texts: dict[str, str], start: Start | None) -> tuple[Diagnosis, dict[str, Any]]:
    """The diagnosis, and what the playground makes of its first cause."""
    found = examine(NativeEngine(), texts, start=start, select=["visual-mass"])
    after = apply(texts, found.causes[0].edit)
    edited = [{file: text for file, text in after.items() if text != texts[file]}]
    made = tmp_path / "made.json"
    asked = {"name": "scene.xml", "made": {"data": found.data(), "texts": texts, "edited": edited}}
    made.write_text(json.dumps(asked), encoding="utf-8")
    command = [node() or "", "tests/playground/try.mjs", str(made)]
    done = subprocess.run(command, cwd=root, env=os.environ, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return found, json.loads(done.stdout)


def masses(texts: dict[str, str]) -> list[float]:
    others = {name: text.encode() for name, text in texts.items() if name != "scene.xml"}
    return list(mujoco.MjModel.from_xml_string(texts["scene.xml"], others).body_mass)


def test_an_edit_in_two_files_is_tried_in_the_whole_model(root: Path, tmp_path: Path) -> None:
    found, made = tried(root, tmp_path, FILES, None)
    assert {each.file for each in found.causes[0].edit} == {"left.xml", "right.xml"}
    assert made["name"] == "scene.xml"
    assert made["text"].count("<body ") == 2
    assert made["before"]["mass"] == pytest.approx(masses(FILES))
    assert made["after"]["mass"] == pytest.approx(masses(apply(FILES, found.causes[0].edit)))
    assert made["after"]["mass"] != pytest.approx(made["before"]["mass"])
    assert made["before"]["qpos"][2] == made["after"]["qpos"][2] == 2


def test_an_edit_in_an_included_file_is_tried_in_that_file(root: Path, tmp_path: Path) -> None:
    texts = {**FILES, "right.xml": FILES["right.xml"].replace('conaffinity="0"/>', 'conaffinity="0" mass="0"/>')}
    _, made = tried(root, tmp_path, texts, None)
    assert (made["name"], made["text"]) == ("left.xml", texts["left.xml"])
    assert made["before"]["mass"] == pytest.approx(masses(texts))
    assert made["after"]["mass"] == pytest.approx([0, 0.2, 0.2])


@pytest.mark.parametrize(("keyframe", "height"), [("up", 3), ("0", 2)])
def test_it_begins_where_the_diagnosis_began(root: Path, tmp_path: Path, keyframe: str, height: float) -> None:
    _, made = tried(root, tmp_path, FILES, Start(keyframe=keyframe))
    assert made["before"]["qpos"][2] == made["after"]["qpos"][2] == height
