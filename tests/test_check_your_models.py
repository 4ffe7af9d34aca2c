"""The page about models in CI, followed by a machine: its workflow, its hook and its example do what it says."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml
from clinic.commands.cli import app
from clinic.diagnosis.rules import rules
from project import settings
from typer.testing import CliRunner

FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.fixture
def fences(root: Path) -> dict[str, list[str]]:
    made: dict[str, list[str]] = {}
    for kind, code in FENCE.findall((root / "docs/check-your-models.md").read_text(encoding="utf-8")):
        made.setdefault(kind, []).append(code)
    return made


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A repository of models, one of which is wrong."""
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot/scene.xml").write_text(rules()["visual-mass"].example("Bad"), encoding="utf-8")
    return tmp_path


def shell(root: Path, folder: Path, command: str) -> subprocess.CompletedProcess[str]:
    """Runs a command as a workflow's step does, with this clinic on the path."""
    own = settings(root)
    own["PATH"] = f"{Path(sys.executable).parent}:{own['PATH']}"
    return subprocess.run(
        ["bash", "-e", "-c", command], cwd=folder, env=own, check=False, capture_output=True, text=True
    )


def test_the_workflow_installs_the_clinic_and_uploads_what_it_wrote(fences, root, repository):
    workflow = yaml.safe_load(fences["yaml"][1])
    (job,) = workflow["jobs"].values()
    install, *steps = [step["run"] for step in job["steps"] if "run" in step]
    assert install == "pip install git+<address of the clinic's repository>"
    for step in steps:
        assert shell(root, repository, step).returncode == 1
    upload = job["steps"][-1]
    assert upload["if"] == "${{ !cancelled() }}"  # although the step before failed
    assert job["permissions"]["security-events"] == "write"
    log = json.loads((repository / upload["with"]["sarif_file"]).read_text(encoding="utf-8"))
    (result, *_) = log["runs"][0]["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "robot/scene.xml"


def test_annotations_name_the_file_as_the_repository_does(fences, root, repository):
    (command,) = fences["sh"]
    assert shell(root, repository, command).stdout.startswith("::error file=robot/scene.xml,line=")


def test_the_hook_is_the_one_that_this_repository_offers(fences, root, repository):
    (offered,) = hooks(root / ".pre-commit-hooks.yaml")
    (taken,) = yaml.safe_load(fences["yaml"][0])["repos"][0]["hooks"]
    assert taken["id"] == offered["id"]
    program, *_ = shlex.split(offered["entry"])
    assert program in tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]["scripts"]
    assert shell(root, repository, shlex.join([*shlex.split(offered["entry"]), *taken["args"]])).returncode == 1
    assert re.search(taken["files"], "robot/scene.xml")
    assert all(re.search(offered["files"], name) for name in ("a.xml", "b.urdf", "c.mjcf"))
    assert not any(re.search(offered["files"], name) for name in ("d.xml.bak", "e.py"))


def hooks(path: Path) -> list[dict[str, Any]]:
    made: list[dict[str, Any]] = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert all({"id", "name", "entry", "language"} <= hook.keys() for hook in made)  # what pre-commit requires
    return made


def test_the_silenced_example_would_be_a_cause(fences, tmp_path):
    (text,) = fences["xml"]
    model = tmp_path / "buoy.xml"
    model.write_text(text, encoding="utf-8")
    silenced = CliRunner().invoke(app, ["diagnose", str(model), "--format", "json"])
    assert silenced.exit_code == 0
    (found,) = json.loads(silenced.stdout)["silenced"]
    model.write_text(re.sub("<!--.*?-->", "", text), encoding="utf-8")
    loud = CliRunner().invoke(app, ["diagnose", str(model), "--format", "json"])
    assert loud.exit_code == 1
    assert found["rule"] in {each["rule"] for each in json.loads(loud.stdout)["causes"]}
