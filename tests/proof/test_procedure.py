"""A family's procedure: it points at the right row on the family's models, and at none on healthy ones."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.engine.script import run_script
from clinic.engine.variant import variants
from clinic.proof.experiments import differential
from clinic.proof.procedure import asked, measured, members, procedure, procedure_problems, run_procedure
from clinic.record.case import Case, load_case, read_cases
from clinic.record.families import families
from clinic.work.cache import Cache
from helpers import MODEL, PENDULUM, RECORD, RESTING, changed, write_case

LINES = 55
FAMILY = "family: sinks\ntelling: {{cause: masks, says: contacts, expr: data.ncon, {}{}}}\n"


@pytest.fixture(scope="module")
def clinic(root: Path) -> list[Case]:
    return read_cases(root / "cases")[0]


@pytest.mark.parametrize("family", families())
def test_every_family_is_told_apart(family: str, clinic: list[Case], tmp_path: Path) -> None:
    told, problems = differential(family, clinic, Cache(tmp_path))
    own = measured(members(family, clinic))
    assert problems == []
    assert {case.slug: told.answers[case.slug].told for case in own} == {case.slug: [case.slug] for case in own}
    assert len(told.code.splitlines()) <= LINES


@pytest.mark.parametrize("family", families())
def test_no_row_applies_to_healthy_models(family: str, clinic: list[Case]) -> None:
    """Small models with known answers, and the repaired models of the other families."""
    own = measured(members(family, clinic))
    if not own:
        pytest.skip("no case that a measurement on a model tells")
    repaired = {case.slug: variants(case)[1].text for case in measured(clinic) if case not in own}
    pendulum = changed(PENDULUM, ("-90 45", "-90 95"))  # its keyframe is inside this range
    said = run_procedure(procedure(family, own), {"pendulum": pendulum, "resting": RESTING, **repaired})
    assert {name: answer.told for name, answer in said.items() if answer.told} == {}


def test_it_takes_a_path_and_names_the_element(clinic: list[Case]) -> None:
    (case,) = [case for case in clinic if case.slug == "elbow-will-not-bend"]
    code = procedure("stuck", [case]).replace("sys.argv[1]", "'model.xml'")
    assert run_script(code, {"model.xml": case.text}).splitlines() == [
        "elbow-will-not-bend = 0.04363 rad, joint elbow",
        "it is elbow-will-not-bend: a range in radians is read in degrees",
    ]
    well = variants(case)[1].text
    assert run_script(code, {"model.xml": well}).splitlines()[-1] == "it is none of these: no row applies"


def pair(root: Path, first: str, second: str) -> list[Case]:
    """Two cases of a family: a box without contacts, and the same box in the floor with them."""
    sunk = MODEL.replace(' contype="2" conaffinity="2"', "").replace("0 0 0.06", "0 0 0.04")
    fix = (
        "find: ' contype=\"2\" conaffinity=\"2\"', replace: ''",
        "find: 'pos=\"0 0 0.04\"', replace: 'pos=\"0 0 1\"'",
    )
    folders = [
        write_case(root, slug="falling-box", record=RECORD + first),
        write_case(root, ("number: 1", "number: 2"), fix, slug="sunk-box", record=RECORD + second, model=sunk),
    ]
    return [load_case(folder) for folder in folders]


def told(cases: list[Case]) -> list[str]:
    answers = run_procedure(procedure("sinks", cases), asked(cases))
    return [f"{problem.file.split('/')[1]}: {problem.found}" for problem in procedure_problems(cases, answers)]


def test_a_measurement_that_holds_for_another_case_is_a_problem(tmp_path: Path) -> None:
    cases = pair(tmp_path, FAMILY.format("below: ", 5), FAMILY.format("above: ", 1))
    assert told(cases) == [
        "falling-box: holds for falling-box repaired by share-a-bit (0)",
        "falling-box: holds for sunk-box repaired by share-a-bit (0)",
        "falling-box: holds for sunk-box (4)",
    ]


def test_a_measurement_that_does_not_hold_for_its_own_case_is_a_problem(tmp_path: Path) -> None:
    cases = pair(tmp_path, FAMILY.format("above: ", 99), FAMILY.format("above: ", 1))
    assert told(cases) == ["falling-box: does not hold for falling-box (0)"]


def test_a_reason_that_is_not_needed_is_a_problem(tmp_path: Path) -> None:
    still = "1, still: {share-a-bit: It stays.}"
    cases = pair(tmp_path, "", FAMILY.format("above: ", still))
    assert told(cases) == ["sunk-box: a fix after which it does not hold"]


def test_a_measurement_that_does_not_run_leaves_the_others(tmp_path: Path) -> None:
    cases = pair(tmp_path, FAMILY.format("above: ", 1).replace("data.ncon", "data.nkon"), FAMILY.format("above: ", 1))
    made, (problem,) = differential("sinks", cases, Cache(tmp_path / "cache"))
    assert (problem.file, problem.where) == ("cases/falling-box/case.yaml", "telling.expr")
    assert "nkon" in problem.found
    assert made.answers["sunk-box"].told == ["sunk-box"]
