"""The commands about a reader's own model."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from clinic.commands.cli import app
from clinic.commands.diagnosis_options import start_of
from clinic.diagnosis.rules import rules
from clinic.diagnosis.simulation import Start
from clinic.pages.rules import diagnosis_schema
from jsonschema import Draft202012Validator
from typer.testing import CliRunner, Result

BROKEN = '<mujoco>\n  <worldbody>\n    <geom name="ball" size="0.1" colour="1 0 0 1"/>\n  </worldbody>\n</mujoco>\n'
WELL = '<mujoco>\n  <worldbody>\n    <geom name="ball" size="0.1"/>\n  </worldbody>\n</mujoco>\n'
DRIVEN = """<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <joint name="hinge" axis="0 0 1" damping="0.01"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01" mass="0.05"/>
    </body>
  </worldbody>
  <actuator><motor name="motor" joint="hinge"/></actuator>
  <keyframe><key name="bent" qpos="0.5"/></keyframe>
</mujoco>
"""


@pytest.fixture
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "robot.xml"
    path.write_text(BROKEN)
    return path


def run(*arguments: object, given: str | None = None) -> Result:
    return CliRunner().invoke(app, list(map(str, arguments)), input=given)


def test_a_cause_is_named_with_file_line_and_edit(model):
    result = run("diagnose", model)
    assert result.exit_code == 1
    assert "unknown-attribute  robot.xml:3" in result.stdout


def test_nothing_found_says_what_was_tried(model):
    model.write_text(WELL)
    result = run("diagnose", model)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.startswith("Nothing found, by ")
    assert "timestep-too-long" in result.stdout


def test_json_follows_the_published_schema(model):
    result = run("diagnose", model, "--format", "json")
    found = json.loads(result.stdout)
    Draft202012Validator.check_schema(diagnosis_schema())
    assert not list(Draft202012Validator(diagnosis_schema()).iter_errors(found))
    (cause,) = found["causes"]
    assert cause["edit"][0] == {
        "file": "robot.xml", "line": 3, "element": "geom", "action": "remove", "attribute": "colour", "value": ""
    }  # fmt: skip
    assert list(Draft202012Validator(diagnosis_schema()).iter_errors({**found, "causes": [{}]}))


def test_fix_prints_a_diff_and_writes_nothing(model):
    result = run("diagnose", model, "--fix")
    assert '-    <geom name="ball" size="0.1" colour="1 0 0 1"/>\n+' in result.stdout
    assert model.read_text() == BROKEN


def test_fix_writes_a_new_file_and_never_over_one(model):
    assert run("diagnose", model, "--fix", "--out", "new.xml").exit_code == 1
    assert run("diagnose", "new.xml").exit_code == 0
    again = run("diagnose", model, "--fix", "--out", "robot.xml")
    assert again.exit_code == 2
    assert again.stderr == "clinic: robot.xml exists; name a new file\n"
    assert model.read_text() == BROKEN


def test_standard_input_is_read():
    assert run("diagnose", "-", given=BROKEN).exit_code == 1
    assert run("diagnose", "-", given="robot.xml").exit_code == 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nowhere.xml"], "nowhere.xml: No such file"),
        (["robot.xml", "--symptom", "burns"], "--symptom burns: expected one of explodes, "),
        (["robot.xml", "--select", "unknown-atribute"], "no rule is called unknown-atribute; unknown-attribute is"),
        (["robot.xml", "--ctrl", "motor=fast"], "--ctrl motor=fast: 'fast' is not a number"),
        (["robot.xml", "--ctrl", "nowhere.csv"], "--ctrl nowhere.csv: No such file"),
        (["robot.xml", "--keyframe", "home"], "--keyframe home: the model has none with a name"),
    ],
)
def test_a_wrong_option_is_a_sentence(model, arguments, said):
    result = run("diagnose", *arguments)
    assert result.exit_code == 2
    assert result.stderr.startswith(f"clinic: {said}")
    assert "Traceback" not in result.output


def test_controls_are_read_from_the_command_a_csv_and_an_npz(model):
    model.write_text(DRIVEN)
    Path("fast.csv").write_text("time,motor\n0,0\n0.1,5\n")
    np.savez("fast.npz", time=[0.0, 0.1], motor=[0.0, 5.0])
    wanted = ((0.0, {"motor": 0.0}), (0.1, {"motor": 5.0}))
    for file in ("fast.csv", "fast.npz"):
        assert start_of(None, [file], 2.0, 0, "robot.xml") == Start(series=wanted)
    assert start_of("bent", ["motor=5"], 1.0, 3, "robot.xml") == Start(0, {"motor": 5.0}, (), 1.0, 3)
    assert start_of(None, [], 2.0, 0, "robot.xml") is None


def test_rules_are_listed_and_explained():
    listed = run("rules").stdout
    assert all(rule in listed for rule in rules())
    told = run("explain", "timestep-too-long").stdout
    assert "Bad:" in told
    assert "Good:" in told
    unknown = run("explain", "timestep")
    assert unknown.exit_code == 2
    assert "timestep-too-long" in unknown.stderr or "clinic rules" in unknown.stderr
