"""The measurements of a symptom's page, on a reader's model: they answer, and find nothing in healthy ones."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.diagnosis.bench.healthy import survey
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.process import diagnose
from clinic.diagnosis.start import Start
from clinic.diagnosis.symptom import code_of, measure
from clinic.diagnosis.texts import read_file, read_texts
from clinic.record.case import load_case
from clinic.record.checkout import cache_folder
from clinic.record.families import families
from clinic.work.cache import Cache
from folders import FOLDERS, write_model

RADIANS = "its ranges are in radians, and the compiler that says so comes from the program that composes it"
ELSEWHERE = "it does jump as it stands; the program that loads it begins from another pose"
PARTS = "it is a part, whose geoms have friction only in the scene that attaches it"
CTRL = "its keyframe has no controls, and the environment writes them at every step"
GYRATION = "b_2 weighs 11.7 g with a radius of gyration of 1.47 m, and its geom is 0.53 m long"
HULL = "wings and legs stand in the hulls of other parts, which fruitfly.xml, made from it, excludes"
FETCH = ("pick_and_place", "push", "reach", "slide")
ASSETS = "dm_control/locomotion/walkers/assets"
KNOWN = {  # what is true of models as their files stand, by case and model
    "elbow-will-not-bend": {
        "dm_control/locomotion/soccer/assets/boxhead/boxhead.xml": RADIANS,
        f"{ASSETS}/humanoid_CMU_V2019.xml": RADIANS,
        f"{ASSETS}/jumping_ball/jumping_ball_with_head.xml": RADIANS,
        "dm_control/mjcf/test_assets/robot_arm.xml": RADIANS,
    },
    "stacked-boxes-fly-apart": {
        f"{ASSETS}/build_fruitfly/assets/drosophila_fused.xml": HULL,
        "dm_control/mjcf/test_assets/robot_arm.xml": ELSEWHERE,
        "dm_control/mujoco/testing/assets/arm.xml": ELSEWHERE,
        "dm_control/third_party/kinova/jaco_arm.xml": ELSEWHERE,
        "gymnasium/envs/mujoco/assets/humanoidstandup.xml": ELSEWHERE,
        "gymnasium_robotics/envs/mujoco/assets/humanoidstandup.xml": ELSEWHERE,
    },
    "joint-snaps-at-start": {
        f"{ASSETS}/humanoid_CMU_V2019.xml": ELSEWHERE,
        f"{ASSETS}/humanoid_CMU_V2020.xml": ELSEWHERE,
    },
    "arm-jumps-at-reset": {
        "dm_control/mjcf/test_assets/robot_arm.xml": RADIANS,
        "dm_control/suite/hopper.xml": ELSEWHERE,
        "dm_control/third_party/kinova/jaco_arm.xml": ELSEWHERE,
        "dm_control/third_party/kinova/jaco_hand.xml": ELSEWHERE,
        "gymnasium/envs/mujoco/assets/ant.xml": ELSEWHERE,
        "gymnasium_robotics/envs/mujoco/assets/ant.xml": ELSEWHERE,
        **{f"gymnasium_robotics/envs/assets/fetch/{task}.xml": ELSEWHERE for task in FETCH},
    },
    "ball-stops-above-cup": {f"{ASSETS}/build_fruitfly/assets/drosophila_fused.xml": HULL},
    "crate-slides-off-table": {
        f"{ASSETS}/fruitfly_v2/fruitfly.xml": PARTS,
        f"{ASSETS}/humanoid_CMU_V2019.xml": PARTS,
        f"{ASSETS}/humanoid_CMU_V2020.xml": PARTS,
    },
    "arm-leaves-its-keyframe": {
        "gymnasium_robotics/envs/assets/kitchen_franka/kitchen_assets/kitchen_env_model.xml": CTRL
    },
    "heavy-base-spins": {"dm_control/mujoco/testing/assets/arm.xml": GYRATION},
}


@pytest.mark.parametrize("family", [name for name in families() if code_of(name)])
def test_no_row_applies_to_healthy_models(family, root, monkeypatch):
    monkeypatch.setattr("clinic.diagnosis.symptom.SECONDS", 120)
    code, told = code_of(family), {}
    for model in survey(root, Cache(cache_folder(root)))[0]:
        path = Path(model.path)
        monkeypatch.chdir(path.parent)
        texts = read_texts(path.read_text(encoding="utf-8"), path.name, read_file)
        said = measure(family, code, NativeEngine(), texts, None)
        assert "they end with" not in said.printed, f"{model.name}: {said.printed}"
        told |= {(case, model.name): said.values[case] for case in said.told}
    own = cases_of(code)
    assert told.keys() == {(case, name) for case in own for name in KNOWN.get(case, {})}, told


def cases_of(code: str) -> set[str]:
    """The cases whose rows a program has."""
    return {line.split('"')[1] for line in code.splitlines() if line.startswith('    ("')}


def test_the_reader_is_told_what_the_symptoms_page_measures(root):
    model = root / "cases" / "servo-sags" / "model.xml"
    made = diagnose(model, symptom="sags", select=["weak-servo"])
    assert made.measured is not None
    assert made.measured.told == ("servo-sags",)
    assert made.measured.values["servo-sags"] == pytest.approx(4.905)
    assert made.data()["measured"]["family"] == "sags"
    *_, head, _, row, told = made.text().splitlines()
    assert head == "sags, measured in this model as on the symptom's page:"
    assert row == "   servo-sags = 4.905 rad, actuator servo"
    assert told.startswith("   it is servo-sags: ")


def test_the_symptom_can_be_named_from_anywhere(root, tmp_path, monkeypatch):
    text = (root / "cases" / "servo-sags" / "model.xml").read_text(encoding="utf-8")
    (tmp_path / "mine.xml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    made = diagnose(tmp_path / "mine.xml", symptom="sags", select=["weak-servo"])
    assert made.measured is not None
    assert made.measured.told == ("servo-sags",)


@pytest.mark.parametrize("symptom", ["", "will-not-compile"])
def test_nothing_is_measured_where_no_symptom_has_a_measurement(symptom, root):
    made = diagnose(root / "cases" / "servo-sags" / "model.xml", symptom=symptom, select=["weak-servo"])
    assert made.measured is None
    assert made.data()["measured"] is None


def test_a_measurement_that_fails_says_so_and_the_diagnosis_stands(root):
    case = load_case(root / "cases" / "servo-sags")
    said = measure("sags", "rows = 1 / 0", NativeEngine(), {"model.xml": case.text}, Start())
    assert said.printed == "they end with ZeroDivisionError: division by zero"


@pytest.mark.parametrize("files", FOLDERS.values(), ids=FOLDERS.keys())
def test_a_model_whose_files_are_found_by_its_path_is_measured(root, tmp_path, files):
    told = diagnose(write_model(tmp_path, files), symptom="sags", select=["masks"]).measured
    assert told is not None
    assert told.printed == "it is none of these: no row applies\n"


def test_what_takes_too_long_is_ended(root, monkeypatch):
    monkeypatch.setattr("clinic.diagnosis.symptom.SECONDS", 1)
    case = load_case(root / "cases" / "servo-sags")
    said = measure("sags", "while True: pass", NativeEngine(), {"model.xml": case.text}, None)
    assert said.printed == "they end with TimeoutError: they take longer than 1 s"
