"""Trials: how they change the run, what they ask, and mistakes in them."""

from __future__ import annotations

from pathlib import Path

import mujoco
import pytest
from clinic.engine.signals import SignalError
from clinic.proof.evidence import collect
from clinic.proof.laws import breaches, passes
from clinic.proof.trials import checks_in, far, run_trial, write
from clinic.record.case import Case, load_case
from clinic.record.fields import Trial
from clinic.record.problem import CaseError
from helpers import GRAVITY, PENDULUM, compiled, tiny_case, write_script_case

BEFORE = "no_sweep: The masks"
TWICE = "{id: heavy, title: Twice the gravity, set: {'model.opt.gravity[2]': -19.62}}"
HIGHER = "{id: higher, title: From above, start: {'joint(free).qpos[2]': 0.2}, duration: 0.6}"


def with_trials(folder: Path, *trials: str) -> Case:
    return tiny_case(folder, (BEFORE, f"trials: [{', '.join(trials)}]\n{BEFORE}"))


def final(case: Case, trial: Trial | None, signal: str) -> float:
    return float(run_trial(case, case.text, trial)[1][signal].value[-1])


def test_a_trial_changes_model_start_and_duration(tmp_path: Path) -> None:
    own = "checks: {broken: [{signal: height, below: -5}], fixed: [{signal: height, above: -5}]}"
    case = with_trials(tmp_path, TWICE[:-1] + f", {own}}}", HIGHER)
    heavy, higher = case.record.trials

    assert final(case, heavy, "height") == pytest.approx(0.06 - 2 * GRAVITY * 0.4**2 / 2, abs=0.02)
    assert final(case, higher, "height") == pytest.approx(0.2 - GRAVITY * 0.6**2 / 2, abs=0.02)
    assert final(case, None, "height") == pytest.approx(0.06 - GRAVITY * 0.4**2 / 2, abs=0.02)
    assert [checks_in(case.record, trial).broken[0].signal for trial in (None, heavy)] == ["contacts", "height"]


def test_a_trial_is_driven_by_its_own_controls(root: Path) -> None:
    case = load_case(root / "cases" / "elbow-will-not-bend")
    torque = [final(case, trial, "torque") for trial in (None, *case.record.trials)]
    assert torque == pytest.approx([2, 1, 4, 2])


def test_the_trials_of_a_script_edit_it_or_a_file_that_it_reads(tmp_path: Path) -> None:
    trials = """\
files: [value.txt]
trials:
  - {id: more, title: More, edits: [{find: '+ 0', replace: '+ 2'}], checks: {fixed: [{signal: error, above: 1}]}}
  - {id: other, title: Other, file: value.txt, edits: [{find: '0.5', replace: '7'}]}
no_sweep"""
    script = 'value = float(open("value.txt").read())\nprint(f"error = {value + 0}")\n'
    folder = write_script_case(tmp_path, ("no_sweep", trials), ("'0.5', replace: '0.0'", "'{value + 0}', replace: '0'"))
    (folder / "script.py").write_text(script)
    (folder / "value.txt").write_text("0.5")
    case = load_case(folder)
    more, other = case.record.trials

    measured = [final(case, trial, "error") for trial in (None, more, other)]

    assert measured == [0.5, 2.5, 7]


def test_a_text_passes_only_in_every_situation(tmp_path: Path) -> None:
    strict = TWICE[:-1] + ", checks: {fixed: [{signal: height, above: 9}]}}"
    edits = tuple(tiny_case(tmp_path / "a").record.fixes[0].edits)

    assert passes(with_trials(tmp_path / "b", TWICE, HIGHER), edits)
    assert not passes(with_trials(tmp_path / "c", strict), edits)


def test_a_fix_that_fails_in_a_trial_is_a_breach(tmp_path: Path) -> None:
    case = with_trials(tmp_path, TWICE[:-1] + ", checks: {fixed: [{signal: height, above: 9}]}}")
    evidence = collect(case)

    (breach,) = breaches(case, evidence, "verdicts")

    assert evidence.variants["share-a-bit"].trials["heavy"]["fixed"][0].holds is False
    assert (breach.where, breach.expected) == ("trials[0]", "above 9 m")
    assert breach.found.startswith("share-a-bit in heavy: height (final) = ")


def test_a_refuted_remedy_may_pass_where_it_fails_in_a_trial(tmp_path: Path) -> None:
    lax = "checks: {fixed: [{signal: height, below: 1}]}"
    case = with_trials(tmp_path, TWICE[:-1] + f", {lax}}}")
    assert breaches(case, collect(case), "verdicts") == []


@pytest.mark.parametrize(
    ("trial", "found"),
    [
        ("{id: a, title: A, set: {'model.opt.gravity[2]': -9.9}}", "no number that differs by a factor of two"),
        (
            "{id: a, title: A, start: {'joint(box).qpos[2]': 1}}",
            "in the text of broken: the joint box, which the model",
        ),
        ("{id: a, title: A, set: {'model.opt.gravity[3]': 1}}", "in the text of broken: model.opt.gravity[3]"),
        ("{id: a, title: A, edits: [{find: a, replace: b}]}", "trials[0]\n  found:    edits"),
        (
            "{id: a, title: A, ctrl: {motor: 1}}",
            "in the text of broken: run.ctrl.motor: the actuator motor, which the model does not have",
        ),
    ],
)
def test_a_mistake_in_a_trial_is_told(tmp_path: Path, trial: str, found: str) -> None:
    with pytest.raises(CaseError) as caught:
        collect(with_trials(tmp_path, trial))
    assert found in str(caught.value)


def test_an_unknown_signal_in_a_trial_is_told(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="hight, which is no signal"):
        with_trials(tmp_path, TWICE[:-1] + ", checks: {fixed: [{signal: hight, above: 9}]}}")


@pytest.mark.parametrize(
    ("here", "there", "tells"),
    [(1, 2, True), (1, 1.9, False), (2, 1, True), (1, -1, True), (0, 0.1, True), (0, 0, False), (-4, -8, True)],
)
def test_a_factor_of_two_or_another_sign_tells(here: float, there: float, tells: bool) -> None:
    assert far(here, there) is tells


def test_numbers_are_written_where_paths_read_them() -> None:
    model, data = compiled(PENDULUM)
    for path, value in {
        "model.opt.timestep": 0.5,
        "model.body(rod).mass": 3,
        "model.key(hanging).qpos": -1,
        "joint(hinge).qvel[0]": 7,
        "ctrl": 4,
    }.items():
        write(model, data, path, value)
    assert (model.opt.timestep, model.body_mass[1], model.key_qpos[0, 0]) == (0.5, 3, -1)
    assert (data.qvel[0], data.ctrl[0]) == (7, 4)
    with pytest.raises(SignalError):
        write(model, mujoco.MjData(model), "body(rob).xpos[0]", 1)
