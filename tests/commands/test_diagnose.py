"""The commands about a reader's own model."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from clinic.commands.cli import app
from clinic.commands.diagnosis_options import OptionError, start_of
from clinic.diagnosis.rules import rules
from clinic.diagnosis.start import Start
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
    assert "; --all names them)" in result.stdout
    assert "timestep-too-long" in run("diagnose", model, "--all").stdout


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


def test_fix_writes_a_new_file_and_over_one_only_when_told(model):
    assert run("diagnose", model, "--fix", "new.xml").exit_code == 1
    assert run("diagnose", "new.xml").exit_code == 0
    again = run("diagnose", model, "--fix", "robot.xml")
    assert again.exit_code == 2
    assert again.stderr == "clinic: --fix robot.xml: it exists; name a new file, or add --force\n"
    assert model.read_text() == BROKEN
    assert run("diagnose", model, "--fix", "robot.xml", "--force").exit_code == 1
    assert model.read_text() == Path("new.xml").read_text() != BROKEN


def test_fix_keeps_the_line_ends_of_the_model(model):
    model.write_bytes(BROKEN.replace("\n", "\r\n").encode())
    run("diagnose", model, "--fix", "new.xml")
    mended = Path("new.xml").read_bytes()
    assert mended.count(b"\r\n") == mended.count(b"\n") == BROKEN.count("\n")


def test_fix_before_the_model_is_told_apart_from_the_file_to_write(model):
    taken = run("diagnose", "--fix", "robot.xml")
    assert taken.exit_code == 2
    assert taken.stderr.endswith("robot.xml is what --fix writes: clinic diagnose robot.xml --fix\n")
    assert run("diagnose", "--fix", "--select", "unknown-attribute", model).stdout.startswith("--- robot.xml")
    assert run("diagnose", "--fix", "-", given=BROKEN).stdout.startswith("--- model.xml")


def test_fix_writes_no_part_of_an_edit_in_several_files(model):
    Path("part.xml").write_text(rules()["visual-mass"].example("Bad"))
    model.write_text('<mujoco><include file="part.xml"/></mujoco>')
    result = run("diagnose", model, "--fix", "new.xml")
    assert result.exit_code == 2
    assert "the edits change part.xml, which it includes" in result.stderr
    assert not Path("new.xml").exists()


def test_several_models_are_diagnosed_and_one_that_cannot_be_holds_up_no_other(model):
    Path("well.xml").write_text(WELL)
    result = run("diagnose", "well.xml", "nowhere.xml", model)
    assert result.exit_code == 1
    assert result.stdout.startswith("well.xml\nNothing found")
    assert "robot.xml\n1  cause   unknown-attribute" in result.stdout
    assert result.stderr == "clinic: nowhere.xml: No such file or directory\n"
    assert run("diagnose", "well.xml", "nowhere.xml").exit_code == 2


def test_standard_input_is_read():
    assert run("diagnose", "-", given=BROKEN).exit_code == 1
    bent = run("diagnose", "-", "--keyframe", "bent", "--select", "spring-too-stiff,masks", given=DRIVEN)
    assert (bent.exit_code, bent.stderr) == (0, "")
    assert run("diagnose", "-", given="robot.xml").exit_code == 2


def test_a_symptom_in_words_is_read_as_one_and_the_others_are_named(model):
    assert run("diagnose", "robot.xml", "--symptom", "slips").stderr == ""
    said = run("diagnose", "robot.xml", "--symptom", "the leg shakes and then flies away").stderr
    assert said.startswith("clinic: --symptom is read as oscillates; if you mean another one: --symptom jumps-at-start")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nowhere.xml"], "nowhere.xml: No such file"),
        (["robot.xml", "--symptom", "burns"], "--symptom burns: expected one of explodes, "),
        (["robot.xml", "--select", "unknown-atribute"], "no rule is called unknown-atribute; unknown-attribute is"),
        (["robot.xml", "--select", "masks", "--ignore", "masks"], "--ignore masks: no rule is left"),
        (["robot.xml", "--ctrl", "motor=fast"], "--ctrl motor=fast: 'fast' is not a number"),
        (["robot.xml", "--ctrl", "motor=nan"], "--ctrl motor=nan: 'nan' is not a number"),
        (["robot.xml", "--ctrl", "nowhere.csv"], "--ctrl nowhere.csv: No such file"),
        (["driven.xml", "--ctrl", "moter=1"], "driven.xml: control moter: the model has motor"),
        (["driven.xml", "--keyframe", "home"], "driven.xml: keyframe home: the model has bent"),
        (["driven.xml", "--keyframe", "1"], "driven.xml: keyframe 1: the model has bent"),
        ([], "no model is named: clinic diagnose robot.xml"),
        (["robot.xml", "driven.xml", "--format", "json"], "--format json takes one model, not 2"),
        (["robot.xml", "driven.xml", "--fix", "new.xml"], "--fix new.xml takes one model, not 2"),
        (["robot.xml", "--force"], "--force goes with --fix OUT"),
        (["robot.xml", "--fix", "nowhere/new.xml"], "--fix nowhere/new.xml: No such file"),
    ],
)
def test_a_wrong_option_is_a_sentence(model, arguments, said):
    Path("driven.xml").write_text(DRIVEN)
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
        assert start_of(None, [file], 2.0, 0) == Start(series=wanted)
    assert start_of("bent", ["motor=5"], 1.0, 3) == Start(-1, {"motor": 5.0}, (), 1.0, 3, "bent")
    assert start_of(None, [], 2.0, 0) is None


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("short.csv", b"time,motor\n0,0\n0.1\n", "row 2, motor: '' is not a number"),
        ("long.csv", b"time,motor\n0,0,7\n", "row 1, beyond the last column: \"['7']\" is not a number"),
        ("semicolons.csv", b"time;motor\n0;0\n", "columns: time;motor"),
        ("head.csv", b"time,motor\n", "columns: none"),
        ("binary.csv", b"\xff\xfe", "not a text in UTF-8"),
        ("torn.npz", b"PK", "not an NPZ"),
    ],
)
def test_a_table_of_controls_that_cannot_be_read_is_a_sentence(tmp_path, name, content, said):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(OptionError) as caught:
        start_of(None, [str(tmp_path / name)], 2.0, 0)
    assert said in str(caught.value)


def test_columns_of_an_npz_are_numbers_and_equally_long(tmp_path):
    for motor in ([1.0], [[1.0, 2.0], [3.0, 4.0]]):
        np.savez(tmp_path / "wrong.npz", time=[0.0, 0.1], motor=motor)
        with pytest.raises(OptionError, match="motor"):
            start_of(None, [str(tmp_path / "wrong.npz")], 2.0, 0)


def test_rules_are_listed_and_explained():
    listed = run("rules").stdout
    assert all(rule in listed for rule in rules())
    told = run("explain", "timestep-too-long").stdout
    assert "Bad:" in told
    assert "Good:" in told
    unknown = run("explain", "timestep")
    assert unknown.exit_code == 2
    assert "timestep-too-long" in unknown.stderr or "clinic rules" in unknown.stderr
