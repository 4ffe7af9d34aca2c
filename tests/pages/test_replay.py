"""Films of code cases: the scene stands where the script printed that it stands."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from clinic.pages.figures.film import FPS, HEIGHT, WIDTH
from clinic.pages.figures.replay import DURATION, places, replay
from clinic.proof.model_problems import check_against_model
from clinic.record.case import Case, load_case
from clinic.record.fields import Picture
from clinic.record.problem import CaseError
from helpers import decoded, evidence_of_variants, variant_evidence, write_script_case
from PIL import Image as Pictures

SCENE = """
<mujoco>
  <worldbody>
    <camera name="side" pos="0 -2 0" xyaxes="1 0 0 0 0 1"/>
    <light pos="0 -1 2"/>
    <body>
      <joint name="hand" axis="0 1 0"/>
      <geom type="capsule" size="0.05" fromto="0 0 0 0.5 0 0" mass="0.1"/>
    </body>
  </worldbody>
</mujoco>
"""
SHOWN = Picture(camera="side", scene="scene.xml", shows={"hand": "error"})


def shown_case(folder: Path, joint: str = "hand", signal: str = "error") -> Case:
    made = write_script_case(
        folder,
        ("script: script.py", "script: script.py\nfiles: [scene.xml]"),
        ("camera: side", f"camera: side, scene: scene.xml, shows: {{{joint}: {signal}}}"),
    )
    (made / "scene.xml").write_text(SCENE, encoding="utf-8")
    return load_case(made)


def compared(folder: Path, joint: str, signal: str) -> None:
    """Reads the case and holds it against its scene."""
    if problems := check_against_model(shown_case(folder, joint, signal)):
        raise CaseError(problems)


def test_a_film_has_every_sample_and_the_poster_is_where_the_two_differ_most(tmp_path: Path) -> None:
    case = shown_case(tmp_path)
    fix = case.record.fixes[0].id.replace("-", "_")
    said = {"broken": variant_evidence(error=[0.0, 1.5, 0.2]), fix: variant_evidence(kind="fix", error=[0.0, 0.0, 0.2])}

    made = replay(case, evidence_of_variants(**said))

    frames = decoded(made["film.mp4"])
    assert len(frames) % 3 == 0
    assert len(frames) <= DURATION * FPS
    halves = [(frame[30:, :WIDTH].astype(int), frame[30:, WIDTH:].astype(int)) for frame in frames[:: len(frames) // 3]]
    apart = [np.abs(left - right).mean() for left, right in halves]
    assert max(apart) == apart[1] > 10 * max(apart[0], apart[2])
    assert {"poster.webp", "strip.webp", "clip.mp4", "broken.webp", "thumb.webp", "card.jpg"} <= set(made)


def test_what_stays_the_same_has_every_sample_of_the_other(tmp_path: Path) -> None:
    case = shown_case(tmp_path)
    fix = case.record.fixes[0].id.replace("-", "_")
    still = variant_evidence(kind="fix", error=[0.0, 0.0])
    still.traces["error"].time[1] = 2 * still.traces["error"].time[1]
    said = {"broken": variant_evidence(error=[0.0, 0.5, 1.5]), fix: still}

    made = replay(case, evidence_of_variants(**said))

    assert Pictures.open(io.BytesIO(made["strip.webp"])).size == (2 * WIDTH, 3 * HEIGHT)


def test_what_is_no_number_leaves_the_joint_where_it_was() -> None:
    dead, still, moved = (
        list(places(SCENE, SHOWN, variant_evidence(error=samples))) for samples in ([0.5, None], [0.5, 0.5], [0.5, 0.9])
    )
    assert np.array_equal(dead[1], still[1])
    assert not np.array_equal(dead[1], moved[1])


@pytest.mark.parametrize(("joint", "signal"), [("foot", "error"), ("hand", "force")])
def test_names_that_are_not_there_are_told(tmp_path: Path, joint: str, signal: str) -> None:
    with pytest.raises(CaseError, match=r"picture\.shows"):
        compared(tmp_path, joint, signal)
