"""What differs between releases of MuJoCo, seen with bindings that look like older ones."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from clinic.engine import installed
from clinic.engine.releases import control_of, mass_matrix, output_of, read_spec
from helpers import BALL, PENDULUM

OLD = SimpleNamespace(nu=2)
NEW = SimpleNamespace(
    actuator_ctrlnum=[1, 2, 0],
    actuator_ctrladr=[0, 1, -1],
    actuator_outnum=[1, 2, 1],
    actuator_outadr=[0, 1, 3],
)


def test_in_older_releases_an_actuator_has_one_control_and_one_output() -> None:
    assert [control_of(OLD, 1), output_of(OLD, 1)] == [1, 1]


def test_in_newer_releases_it_may_have_none_or_several() -> None:
    assert [control_of(NEW, i) for i in range(3)] == [0, None, None]
    assert [output_of(NEW, i) for i in range(3)] == [0, None, 3]


def test_the_mass_matrix_is_symmetric_and_holds_the_masses() -> None:
    model = mujoco.MjModel.from_xml_string(BALL)
    matrix = mass_matrix(model)
    assert np.array_equal(matrix, matrix.T)
    assert matrix[:3, :3] == pytest.approx(np.eye(3) * model.body_mass[1])


def test_the_release_is_two_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(installed, "version", lambda _: "3.10.1.post1")
    assert installed.installed() == (3, 10)


def test_a_file_whose_ending_a_release_does_not_know_is_read_as_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def from_file(name: str) -> mujoco.MjSpec:
        raise ValueError(f"Could not find decoder for resource '{name}'")

    older = SimpleNamespace(from_file=from_file, from_string=mujoco.MjSpec.from_string)
    monkeypatch.setattr(mujoco, "MjSpec", older)
    path = tmp_path / "model.urdf"
    path.write_text(PENDULUM, encoding="utf-8")
    assert Path(read_spec(path).modelfiledir) == tmp_path
