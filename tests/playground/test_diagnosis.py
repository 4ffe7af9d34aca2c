"""The page's diagnosis, run by Node, against Python's: the same findings on the same release of MuJoCo."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from os.path import relpath
from pathlib import Path
from typing import Any

import pytest
from clinic.diagnosis.rules import rules
from clinic.engine.node import executable as node
from clinic.publish.bundle import diagnosis_files
from clinic.record.case import read_cases
from clinic.record.checkout import cache_folder
from clinic.work.cache import Cache
from folders import FOLDERS

pytestmark = pytest.mark.xdist_group("parity")
APART = {"memory-full"}  # after it the page's engine cannot be trusted, and the page begins a new one
MOST = 120  # models for one engine: what it leaks of each would fill it up, and the page begins a new one for each
WITHOUT_MESHES = """<mujoco>
  <asset>
    <mesh name="upper" file="upper.stl"/><mesh file="lower.obj"/><texture name="wood" type="2d" file="wood.png"/>
  </asset>
  <worldbody>
    <body name="arm"><joint name="elbow" axis="0 1 0" range="-90 90"/><geom type="mesh" mesh="upper"/>
      <body name="hand" pos="0 0 0.3"><joint name="wrist" axis="0 1 0" range="0 0" limited="true"/>
        <geom type="mesh" mesh="lower"/></body></body>
  </worldbody>
</mujoco>
"""
SAME = ("rule", "elements", "file", "line", "attribute", "now", "value", "edit")


@pytest.fixture(scope="module")
def models(root: Path) -> dict[str, str]:
    broken = {case.slug: case.text for case in read_cases(root / "cases")[0] if case.record.model is not None}
    large = rules()["no-armature"].example("Bad").replace("<worldbody>", '<size memory="900M"/><worldbody>', 1)
    broken["of which the page's memory holds four"] = large
    broken["whose meshes are missing"] = WITHOUT_MESHES
    return {**broken, **{rule.id: rule.example("Bad") for rule in rules().values() if rule.id not in APART}}


def test_the_page_finds_what_python_finds(root: Path, models: dict[str, str], tmp_path: Path) -> None:
    names = [*models]
    parts = [{name: models[name] for name in names[start : start + MOST]} for start in range(0, len(names), MOST)]
    for path, content in diagnosis_files(root, Cache(cache_folder(root))).items():
        (tmp_path / Path(path).name).write_bytes(content)
    beside = os.pathsep.join([str(Path(sys.prefix, "parity")), str(root / "scripts")])

    there, here = dict[str, Any](), dict[str, Any]()
    for number, part in enumerate(parts):
        texts = tmp_path / f"models{number}.json"
        texts.write_text(json.dumps(part), encoding="utf-8")
        there |= output(root, [node() or "", "tests/playground/diagnosis.mjs", str(texts), str(tmp_path)])
        here |= output(root, [sys.executable, "tests/playground/diagnosis.py", str(texts)], PYTHONPATH=beside)

    assert len(models) >= 20
    assert {name: told(found) for name, found in there.items()} == {name: told(found) for name, found in here.items()}


def test_the_page_finds_files_as_mujoco_finds_them_for_a_path(root: Path, tmp_path: Path) -> None:
    models = [
        {
            "text": folder.pop("robots/arm/model.xml"),
            "files": {relpath(name, "robots/arm"): folder[name] for name in folder},
        }
        for folder in (dict(each) for each in FOLDERS.values())
    ]
    missing = {"text": models[1]["text"], "files": {}}
    asked = tmp_path / "models.json"
    asked.write_text(json.dumps([*models, missing]), encoding="utf-8")
    *found, error = output(root, [node() or "", "tests/playground/compile.mjs", str(asked)])
    assert found == [1] * len(models)
    assert "opening file '../../parts/scene.xml'" in error


def output(root: Path, command: list[str], **environment: str) -> Any:
    done = subprocess.run(
        command, cwd=root, env={**os.environ, **environment}, check=False, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def told(found: dict[str, Any]) -> dict[str, Any]:
    parts = {level: [{name: each[name] for name in SAME} for each in found[level]] for level in ("causes", "hints")}
    return {**parts, "engine": found["engine"], "ruled_out": found["ruled_out"]}
