"""A variant in MuJoCo's viewer, which itself is not opened here."""

from __future__ import annotations

from pathlib import Path

import mujoco
import pytest
from clinic.commands.viewer import scene, view
from clinic.record.problem import CaseError, LackError
from helpers import script_case, tiny_case


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[tuple[mujoco.MjModel, mujoco.MjData]]:
    """What the viewer was asked to show."""
    import mujoco.viewer

    shown: list[tuple[mujoco.MjModel, mujoco.MjData]] = []
    monkeypatch.setattr(mujoco.viewer, "launch", lambda model, data: shown.append((model, data)))
    monkeypatch.setenv("DISPLAY", ":0")
    return shown


def test_the_broken_model_and_a_fix_are_opened(tmp_path: Path, opened: list) -> None:
    case = tiny_case(tmp_path)
    view(case)
    view(case, "share-a-bit")
    assert [int(model.geom("floor").contype[0]) for model, _ in opened] == [2, 1]


def test_the_scene_stands_at_the_start_of_the_run(tmp_path: Path) -> None:
    slide = ('<freejoint name="free"/>', '<joint name="free" type="slide"/>')
    from helpers import MODEL, changed

    xml = changed(MODEL, slide, ("</mujoco>", '<actuator><motor name="m" joint="free"/></actuator></mujoco>'))
    case = tiny_case(tmp_path, ("duration: 0.4", "duration: 0.4, qpos: {free: 0.3}, ctrl: {m: 2}"), model=xml)
    _, data = scene(case, "broken")
    assert (data.time, data.qpos[0], data.ctrl[0]) == (0, 0.3, 2)
    assert data.body("box").xpos[2] == pytest.approx(0.36)


def test_unknown_variant_is_reported_with_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="repair:   write share-a-bit"):
        scene(tiny_case(tmp_path), "share-bit")


def test_a_script_has_nothing_to_view(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"a bug in script\.py, a script"):
        view(script_case(tmp_path))


def test_a_viewer_that_fails_ends_in_a_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import mujoco.viewer

    def fail(*_: object) -> None:
        raise mujoco.FatalError("could not initialize GLFW")

    monkeypatch.setattr(mujoco.viewer, "launch", fail)
    monkeypatch.setenv("DISPLAY", ":0")
    with pytest.raises(LackError, match="does not open: could not initialize GLFW"):
        view(tiny_case(tmp_path))
