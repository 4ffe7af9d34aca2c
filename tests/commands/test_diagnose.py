"""The commands about a reader's own model."""

from __future__ import annotations

import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from clinic.commands import diagnosis_output
from clinic.commands.cli import app
from clinic.commands.diagnosis_options import OptionError, start_of
from clinic.diagnosis.rules import rules
from clinic.diagnosis.start import Start
from clinic.diagnosis.texts import encoded
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


ASKS = 'clinic: say what you see, and weaker signs of it are told, too: --symptom slips, or --symptom "it sags"\n'


def test_nothing_found_says_what_was_tried(model):
    model.write_text(WELL)
    result = run("diagnose", model)
    assert (result.exit_code, result.stderr) == (0, ASKS)
    assert result.stdout.startswith("Nothing found, by ")
    assert run("diagnose", model, "--symptom", "sags").stderr == ""
    assert run("diagnose", model, "--format", "json").stderr == ""
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


def test_fix_of_a_model_without_a_cause_names_the_hints_that_have_an_edit(model):
    model.write_text(WELL)
    assert run("diagnose", model, "--fix").stdout == "nothing to change\n"
    model.write_text(rules()["axis-unlike-name"].example("Bad"))
    result = run("diagnose", model.name, "--fix", "new.xml", "--select", "axis-unlike-name")
    assert result.stdout == (
        "No cause, so nothing is changed; the hint axis-unlike-name has an edit: clinic diagnose robot.xml\n"
    )
    assert not Path("new.xml").exists()


def test_fix_writes_a_new_file_and_over_one_only_when_told(model):
    assert run("diagnose", model, "--fix", "new.xml").exit_code == 1
    assert run("diagnose", "new.xml").exit_code == 0
    again = run("diagnose", model, "--fix", "robot.xml")
    assert again.exit_code == 2
    assert again.stderr == "clinic: --fix robot.xml: it exists; name a new file, or add --force\n"
    assert model.read_text() == BROKEN
    assert run("diagnose", model, "--fix", "robot.xml", "--force").exit_code == 1
    assert model.read_text() == Path("new.xml").read_text() != BROKEN


@pytest.mark.parametrize("end", [b"\r\n", b"\r"])
def test_fix_changes_no_byte_but_what_it_edits(model, end):
    head, broken, *rest = (b"\xef\xbb\xbf<mujoco>", *BROKEN.encode().split(b"\n")[1:])
    mixed = head + end + broken + b"\n" + end.join(rest)
    model.write_bytes(mixed)
    run("diagnose", model, "--fix", "new.xml")
    assert Path("new.xml").read_bytes() == mixed.replace(b"colour", b"rgba")


def test_fix_ends_a_new_line_as_the_first_and_writes_what_the_encoding_lacks_as_a_number():
    content = b"<a>\r\n  <b/>\n  <!-- \xf6 -->\r</a>"
    mended = "<a>\n  <c/>\n  <d/>\n  <!-- \xf6 -->\n  <e name='\u0142'/>\n</a>"
    wanted = b"<a>\r\n  <c/>\n  <d/>\r\n  <!-- \xf6 -->\r  <e name='&#322;'/>\r\n</a>"
    assert encoded(mended, content) == wanted


def test_fix_that_cannot_be_written_leaves_what_was_there(model, monkeypatch):
    def full(_path: Path, _content: bytes) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "write_bytes", full)
    model.with_name("old.xml").write_text("old")
    for out, force in (("new.xml", []), ("old.xml", ["--force"])):
        result = run("diagnose", model, "--fix", out, *force)
        assert (result.exit_code, result.stderr) == (2, f"clinic: --fix {out}: No space left on device\n")
    assert {path.name: path.read_text() for path in Path().iterdir()} == {"robot.xml": BROKEN, "old.xml": "old"}


def test_fix_leaves_a_file_that_came_into_being_meanwhile(model, monkeypatch):
    monkeypatch.setattr(diagnosis_output, "check_output", lambda *_: Path("new.xml").write_text("meanwhile"))
    result = run("diagnose", model, "--fix", "new.xml")
    assert (result.exit_code, result.stderr) == (
        2,
        "clinic: --fix new.xml: it exists; name a new file, or add --force\n",
    )
    assert Path("new.xml").read_text() == "meanwhile"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a full device")
def test_an_output_that_takes_no_more_is_a_sentence(model):
    command = [sys.executable, "-m", "clinic", "diagnose", model.name, "--select", "unknown-attribute"]
    with open("/dev/full", "w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert (done.returncode, done.stderr) == (2, "clinic: standard output: No space left on device\n")


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


def test_elements_that_stand_too_deep_are_a_sentence(tmp_path):
    deep = tmp_path / "deep.xml"
    bodies = 20_000
    deep.write_text(f"<mujoco><worldbody>{'<body>' * bodies}{'</body>' * bodies}</worldbody></mujoco>")
    done = run("diagnose", deep)
    assert done.exit_code == 2
    assert "the model is too large: its elements stand too deep within one another" in done.output


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
        (["robot.xml", "--select", "masks", "--ignore", "masks"], "ignore masks: no rule is left"),
        (["robot.xml", "--ctrl", "motor=fast"], "--ctrl motor=fast: 'fast' is not a number"),
        (["robot.xml", "--ctrl", "motor=nan"], "--ctrl motor=nan: 'nan' is not a number"),
        (["robot.xml", "--ctrl", "nowhere.csv"], "--ctrl nowhere.csv: No such file"),
        (["driven.xml", "--ctrl", "moter=1"], "driven.xml: control moter: the model has motor"),
        (["driven.xml", "--keyframe", "home"], "driven.xml: keyframe home: the model has bent"),
        (["driven.xml", "--keyframe", "1"], "driven.xml: keyframe 1: the model has bent"),
        ([], "no model is named: clinic diagnose robot.xml"),
        (["robot.xml", ""], "no model is named: clinic diagnose robot.xml"),
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


def _flipped(content: bytes, at: int, mask: int) -> bytes:
    return content[:at] + bytes([content[at] ^ mask]) + content[at + 1 :]


def test_a_damaged_npz_is_a_sentence(tmp_path):
    path = tmp_path / "run.npz"
    np.savez_compressed(path, time=np.arange(500) / 100, motor=np.sin(np.arange(500)))
    sound = path.read_bytes()
    entry = sound.index(b"PK\x01\x02")  # in the directory at the end: 6 version, 8 flags, 10 compression
    first = entry + 46 + len("time.npy")
    damages = {
        "encrypted": _flipped(_flipped(sound, entry + 8, 1), 6, 1),
        "version": _flipped(sound, entry + 6, 0xFF),
        "compression": _flipped(_flipped(sound, entry + 10, 0xF), 8, 0xF),
        **{f"byte {at}": _flipped(sound, at, 0xFF) for at in range(60, first - 60, 97)},
    }
    for damage, content in damages.items():
        path.write_bytes(content)
        with pytest.raises(OptionError) as caught:
            start_of(None, [str(path)], 2.0, 0)
        assert str(caught.value).startswith(f"--ctrl {path}: damaged"), damage


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
