"""The healthy models: other people's, found and divided."""

from __future__ import annotations

from collections import Counter

import pytest
from clinic.diagnosis.bench.healthy import FURTHER, KNOWN, survey
from clinic.record.checkout import cache_folder
from clinic.record.problem import MissingRequirementError
from clinic.work.cache import Cache

ARM = '<mujoco><worldbody><body><joint/><geom size="0.1"/></body></worldbody></mujoco>'


@pytest.fixture(scope="session")
def surveyed(root):
    return survey(root, Cache(cache_folder(root)))


def test_every_model_that_compiles_and_moves_is_there(surveyed):
    models, _ = surveyed
    assert Counter(model.name.split("/")[0] for model in models) == {
        "dm_control": 37,
        "gymnasium": 14,
        "gymnasium_robotics": 30,
    }


def test_each_file_that_is_left_out_has_its_reason(surveyed):
    models, left_out = surveyed
    assert not {model.name for model in models} & set(left_out)
    assert left_out["dm_control/suite/lqr.xml"] == "nothing in it can move"
    assert "mjMINVAL" in left_out["dm_control/mjcf/test_assets/test_model.xml"]


def test_a_robot_is_held_out_with_all_its_models(surveyed):
    models, _ = surveyed
    sides = {}
    for model in models:
        sides.setdefault(model.robot, set()).add(model.held_out)
    assert all(len(side) == 1 for side in sides.values())
    assert 1 / 4 < Counter(next(iter(side)) for side in sides.values())[True] / len(sides) < 1 / 2
    assert sides["hand"] == {True}
    assert "coupled" not in sides
    assert sides["humanoid"] == {False}


def test_a_known_fault_is_of_a_model_that_is_there(surveyed):
    models, _ = surveyed
    assert set(KNOWN) <= {model.name for model in models}


def test_further_folders_are_measured_too(root, tmp_path, monkeypatch):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "arm.xml").write_text(ARM)
    (tmp_path / "mine" / "broken.xml").write_text("<mujoco")
    monkeypatch.setenv(FURTHER, str(tmp_path / "mine"))
    models, left_out = survey(root, Cache(tmp_path / "cache"))
    assert [model.dofs for model in models if model.name == "mine/arm.xml"] == [1]
    assert "mine/broken.xml" in left_out


def test_without_the_packages_it_is_said_what_to_do(tmp_path):
    with pytest.raises(MissingRequirementError, match="make healthy"):
        survey(tmp_path, Cache(tmp_path / "cache"))
