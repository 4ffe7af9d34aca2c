"""A diagnosis in a process of its own, whatever the model does to it."""

from __future__ import annotations

import base64
import os
import pickle
import subprocess
import sys

import clinic
import mujoco
import pytest
from clinic.diagnosis import process
from clinic.diagnosis.finding import DIES, FAILS, KILLED, LATE
from clinic.diagnosis.process import DiagnosisError, Request, diagnose
from clinic.diagnosis.start import Start
from folders import CORNER, FOLDERS, write_model

TALL = """<mujoco>
  <option timestep="0.01"/>
  <worldbody>
    <body pos="0 0 1">
      <joint name="hinge" axis="0 1 0" stiffness="2000" springref="2"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01" mass="0.05"/>
    </body>
  </worldbody>
</mujoco>
"""
DIES_ON_A_RULE = """
import base64, os, pickle, sys
from clinic.diagnosis import process
line = sys.stdin.buffer.readline()
if {rule!r} not in pickle.loads(base64.b64decode(line)).ignore:
    print("trying {rule}", flush=True)
    os.abort()
sys.stdin = type("Again", (), {{"buffer": __import__("io").BytesIO(line)}})
process.main()
"""


def found_here() -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}


def test_a_path_a_text_a_spec_and_a_pair_give_the_same(tmp_path):
    path = tmp_path / "model.xml"
    path.write_text(TALL)
    spec = mujoco.MjSpec.from_string(TALL)
    given = [path, str(path), TALL, spec, (spec.compile(), TALL), (spec.compile(), str(path))]
    found = [[each.rule for each in clinic.diagnose(source).causes] for source in given]
    assert found[0]
    assert all(each == found[0] for each in found)


def test_the_reader_s_file_is_left_as_it_is_and_the_folder_too(tmp_path):
    path = tmp_path / "model.xml"
    path.write_text(TALL)
    diagnose(path)
    assert [each.name for each in tmp_path.iterdir()] == ["model.xml"]
    assert path.read_text() == TALL


def test_files_that_lie_on_no_disk_are_given_beside_the_text():
    asset = '<asset><mesh name="part" file="part.obj"/></asset>'
    text = f'<mujoco>{asset}<worldbody><geom type="mesh" mesh="part"/></worldbody></mujoco>'
    assert "missing-file" in {each.rule for each in diagnose(text).hints}
    assert not diagnose(text, assets={"part.obj": CORNER.encode()}).error


@pytest.mark.parametrize("files", FOLDERS.values(), ids=FOLDERS.keys())
def test_files_are_found_as_mujoco_finds_them_for_a_path(tmp_path, files):
    assert not diagnose(write_model(tmp_path, files), select=["masks"]).error


def test_where_the_engine_dies_that_is_a_finding_and_the_other_rules_are_tried(monkeypatch):
    rule = "malformed-number"
    monkeypatch.setattr(process, "CHILD", (sys.executable, "-c", DIES_ON_A_RULE.format(rule=rule)))
    found = diagnose("<mujoco><worldbody><geom size='0.1' colour='1 0 0 1'/></worldbody></mujoco>")
    assert [each.rule for each in found.causes] == [DIES, "unknown-attribute"]
    assert rule in found.causes[0].says
    assert rule not in found.ruled_out


def test_where_a_rule_fails_that_is_no_fault_of_the_model_or_the_engine(monkeypatch):
    again = (
        "import base64, os, pickle, sys\nfrom dataclasses import replace\nfrom clinic.diagnosis import process, rules\n"
    )
    again += "def fails(model):\n    raise AttributeError('nthe')\n"
    again += "rules.rules()['masks'] = replace(rules.rules()['masks'], suspects=fails)\nprocess.main()\n"
    monkeypatch.setattr(process, "CHILD", (sys.executable, "-c", again))
    found = diagnose(TALL, select=["masks", "spring-too-stiff"])
    assert [each.rule for each in found.causes] == ["spring-too-stiff"]
    assert [each.rule for each in found.hints] == [FAILS]
    assert "masks failed (AttributeError: nthe): a mistake of the clinic" in found.hints[0].says


def test_a_rule_that_takes_too_long_says_nothing_of_the_model(monkeypatch):
    slow = DIES_ON_A_RULE.format(rule="masks").replace("os.abort()", "__import__('time').sleep(60)")
    monkeypatch.setattr(process, "CHILD", (sys.executable, "-c", slow))
    monkeypatch.setattr(process, "LIMIT", 10.0)
    found = diagnose(TALL, select=["masks", "spring-too-stiff"])
    assert DIES not in {each.rule for each in found.causes}
    assert [each.rule for each in found.hints] == [LATE]


def test_a_process_whose_asker_is_gone_ends_and_leaves_nothing(tmp_path):
    loaded = TALL.replace("<body", "<body><freejoint/><geom size='0.05'/></body>" * 60 + "<body", 1)
    request = Request(loaded, "model.xml", str(tmp_path), {}, "", "", Start(duration=60.0), (), ())
    child = subprocess.Popen(process.CHILD, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=found_here())
    assert child.stdin is not None
    assert child.stdout is not None
    child.stdin.write(base64.b64encode(pickle.dumps(request)) + b"\n")
    child.stdin.flush()
    assert child.stdout.readline().startswith(b"trying ")
    child.stdin.close()
    assert b"made " not in child.stdout.read()
    child.stdout.close()
    assert child.wait() == 1
    assert list(tmp_path.iterdir()) == []


def test_a_process_that_dies_before_any_rule_is_a_sentence(monkeypatch):
    monkeypatch.setattr(process, "CHILD", (sys.executable, "-c", "import os; os.abort()"))
    with pytest.raises(DiagnosisError, match="MuJoCo ended the process"):
        diagnose(TALL)


def test_a_process_that_is_killed_is_not_laid_to_mujoco(monkeypatch):
    monkeypatch.setattr(process, "CHILD", (sys.executable, "-c", "import os; os.kill(os.getpid(), 9)"))
    with pytest.raises(DiagnosisError, match="the system ended the process"):
        diagnose(TALL)


def test_a_rule_during_which_the_process_is_killed_says_nothing_of_the_model(monkeypatch):
    killed = DIES_ON_A_RULE.format(rule="masks").replace("os.abort()", "os.kill(os.getpid(), 9)")
    monkeypatch.setattr(process, "CHILD", (sys.executable, "-c", killed))
    found = diagnose(TALL, select=["masks", "spring-too-stiff"])
    assert [each.rule for each in found.causes] == ["spring-too-stiff"]
    assert [each.rule for each in found.hints] == [KILLED]


def test_a_model_that_takes_a_quarter_of_the_memory_is_diagnosed_as_any_other():
    large = TALL.replace("<worldbody>", '<size memory="1G"/><worldbody>')
    one, other = diagnose(TALL), diagnose(large)
    assert one.causes
    assert [each.rule for each in other.causes] == [each.rule for each in one.causes]
    assert [each.rule for each in other.hints] == [each.rule for each in one.hints]
    assert other.ruled_out == one.ruled_out


def test_a_spec_that_does_not_compile_is_a_sentence():
    spec = mujoco.MjSpec()
    spec.worldbody.add_body(name="hand").add_freejoint()
    with pytest.raises(DiagnosisError, match=r"give the text instead: .*mjMINVAL"):
        diagnose(spec)


@pytest.mark.parametrize("wrong", [3, None, ("a", "b", "c")])
def test_another_kind_of_source_is_a_sentence(wrong):
    with pytest.raises(DiagnosisError, match="expected a path, a text, an MjSpec"):
        diagnose(wrong)


@pytest.mark.parametrize(
    ("start", "said"), [(Start(keyframe="home"), "keyframe home"), (Start(ctrl={"x": 1.0}), "control x")]
)
def test_a_start_that_the_model_lacks_is_a_sentence(start, said):
    with pytest.raises(DiagnosisError, match=f"model.xml: {said}: the model has no"):
        diagnose(TALL, start=start)


def test_a_file_that_is_no_text_is_a_sentence(tmp_path):
    (tmp_path / "model.xml").write_bytes(b"<mujoco>\n<!-- \0 -->\n</mujoco>")
    with pytest.raises(DiagnosisError, match="not a text in UTF-8: byte 0x00 in line 2"):
        diagnose(tmp_path / "model.xml")


def test_a_text_in_latin_1_is_diagnosed(tmp_path):
    (tmp_path / "model.xml").write_bytes(TALL.replace("<mujoco>", "<mujoco><!-- per\xe7euse -->").encode("latin-1"))
    assert [each.line for each in diagnose(tmp_path / "model.xml").causes] == [
        each.line for each in diagnose(TALL).causes
    ]
