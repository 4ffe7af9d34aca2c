"""The six steps on cases and on files, whatever is in them."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.record.problem import CaseError
from clinic.triage.findings import Finding
from clinic.triage.steps import FIRST, STEPS, Observation, report, subject_of, subject_of_case, triage
from helpers import BALL, MODEL, PENDULUM, tiny_case, write_case, write_script_case
from subjects import subject

GOOD = {
    "empty": "<mujoco/>",
    "no bodies": "<mujoco><worldbody><geom size='.1'/></worldbody></mujoco>",
    "ball": BALL,
    "pendulum": PENDULUM,
    "timestep zero": BALL.replace("0.001", "0"),
    "timestep negative": BALL.replace("0.001", "-1"),
    "timestep tiny": BALL.replace("0.001", "1e-12"),
    "not a number": BALL.replace('pos="0 0 1"', 'pos="nan 0 0"'),
    "huge gravity": BALL.replace('timestep="0.001"', 'gravity="0 0 -1e300"'),
    "unnamed": "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>",
    "short key": BALL.replace("</mujoco>", '<keyframe><key qpos="0 0"/></keyframe></mujoco>'),
    "cloth": """<mujoco><worldbody><flexcomp name="f" type="grid" count="3 3 1" spacing=".1 .1 .1" dim="2" mass="1"
      radius=".01"><edge equality="true"/></flexcomp></worldbody></mujoco>""",
    "muscle": """<mujoco><worldbody><body><joint name="j"/><geom size=".1" pos=".3 0 0"/></body></worldbody>
      <actuator><muscle joint="j" lengthrange="0 1"/><velocity joint="j"/></actuator></mujoco>""",
    "robot": """<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0"
      ixz="0" iyz="0"/></inertial></link></robot>""",
    "collinear": """<mujoco><worldbody><body><joint axis="1 0 0"/><joint axis="1 0 0"/><geom size=".1" pos="0 1 0"/>
      </body></worldbody></mujoco>""",
}
BAD = {
    "nothing": ("", "ParseXML: empty file"),
    "no text": (bytes(range(256)).decode("latin-1"), "XML"),
    "no XML": ("hello", "XML_ERROR_PARSING_TEXT"),
    "unclosed": ("<mujoco>\n<worldbody>\n</mujoco>", "model.xml:2:\n.*XML_ERROR_MISMATCHED_ELEMENT"),
    "unknown": ("<mujoco>\n<option colour='1'/></mujoco>", "model.xml:2:\n.*unrecognized attribute: 'colour'"),
    "mesh missing": ('<mujoco><asset><mesh name="m" file="m.stl"/></asset></mujoco>', "Error opening file"),
    "too deep": ("<mujoco><worldbody>" + "<body>" * 900 + "</body>" * 900 + "</worldbody></mujoco>", "too deep"),
    "no robot": ("<package/>", "Unrecognized XML model type"),
}


def observed(path: Path) -> list[Observation]:
    return list(triage(subject_of(path)))


@pytest.mark.parametrize("name", GOOD)
def test_any_model_gives_six_observations(tmp_path: Path, name: str) -> None:
    path = tmp_path / "model.xml"
    path.write_text(GOOD[name], encoding="utf-8")
    made = observed(path)
    assert [observation.step for observation in made] == list(STEPS)
    assert all(report(observation) for observation in made)


@pytest.mark.parametrize("name", BAD)
def test_a_file_that_is_no_model_is_a_problem(tmp_path: Path, name: str) -> None:
    path = tmp_path / "model.xml"
    path.write_text(BAD[name][0], encoding="latin-1")
    with pytest.raises(CaseError, match=BAD[name][1]) as caught:
        subject_of(path)
    assert str(caught.value).count("\n  repair:   see *What MuJoCo says*") == 1


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    for path, found in ((tmp_path / "model.xml", "no such file"), (tmp_path, "a folder without case.yaml")):
        with pytest.raises(CaseError, match=found):
            subject_of(path)


def test_a_case_is_run_as_its_record_says(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    for path in (folder, folder / "case.yaml"):
        assert subject_of(path).run.duration == 0.4
    seen = {observation.step for observation in observed(folder) if observation.findings}
    assert seen == {"model", "overlays"}


def test_a_case_in_code_has_no_model(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="a bug in code"):
        subject_of(write_script_case(tmp_path))


def test_a_file_is_started_from_its_first_keyframe(tmp_path: Path) -> None:
    path = tmp_path / "model.xml"
    path.write_text(PENDULUM, encoding="utf-8")
    assert subject_of(path).run.keyframe == "hanging"
    path.write_text(PENDULUM.replace('name="hanging" ', ""), encoding="utf-8")
    made = subject_of(path)
    assert made.run.keyframe == FIRST
    assert made.data.ctrl[0] == 2


def test_what_the_compiler_warns_of_is_seen(tmp_path: Path) -> None:
    path = tmp_path / "model.xml"
    path.write_text(GOOD["not a number"], encoding="utf-8")
    first = observed(path)[0]
    assert "XML contains a 'NaN'" in report(first)


def test_steps_for_which_there_is_no_time_say_so() -> None:
    made = list(triage(subject(MODEL), seconds=0))
    assert [observation.step for observation in made] == list(STEPS)
    assert not any(observation.taken for observation in made)
    assert report(made[-1]) == "6. a reduced scene: not taken (the time allowed was used up)"


def test_steps_do_not_change_the_model(tmp_path: Path) -> None:
    made = subject_of_case(tiny_case(tmp_path))
    first, second = (list(triage(made)) for _ in range(2))
    assert first == second


def test_a_report_lists_each_kind_of_finding_briefly() -> None:
    alike = [Finding("ranges", f"joint {i}", "range 0 to 0") for i in range(5)]
    unlike = [Finding("masses", f"body {i}", f"mass {i} kg") for i in range(5)]
    text = report(Observation(step="model", said="6 joints", findings=[*alike, *unlike]))
    assert text.splitlines() == [
        "2. the model as compiled: saw something (6 joints)",
        "   - joint 0, joint 1, joint 2 and 2 more: range 0 to 0",
        *(f"   - body {i}: mass {i} kg" for i in range(3)),
        "   - ... and 2 more of the same kind",
    ]


def test_a_keyframe_of_the_wrong_size_is_told_at_its_own_line(tmp_path):
    keys = '<keyframe>\n<key name="home" qpos="0"/>\n<key name="far" qpos="0 0 1"/>\n</keyframe>'
    path = tmp_path / "model.xml"
    body = '<worldbody><body><joint name="hinge"/><geom size="0.1"/></body></worldbody>'
    path.write_text(f"<mujoco>\n{body}\n{keys}\n</mujoco>")
    with pytest.raises(CaseError) as raised:
        subject_of(path)
    assert raised.value.problems[0].line == 5
