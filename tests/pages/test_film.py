"""Films: what is on them, and what an exploding run looks like."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from clinic.engine.simulate import compile_model
from clinic.pages.figures.film import FPS, HEIGHT, WIDTH, film, frames, strip
from clinic.pages.figures.previews import CLIP
from clinic.record.fields import Film, RunSpec
from helpers import decoded, tiny_case
from project import run

EXPLODING = """
<mujoco>
  <option timestep="0.01"/>
  <worldbody>
    <camera name="side" pos="0 -2 0" xyaxes="1 0 0 0 0 1"/>
    <light pos="0 0 2"/>
    <body>
      <joint name="spring" axis="0 1 0" stiffness="100000"/>
      <geom type="capsule" size="0.05" fromto="0 0 0 0.5 0 0" mass="0.1"/>
    </body>
  </worldbody>
</mujoco>
"""

ENCODED = """
import hashlib, sys
import numpy as np
from clinic.pages.figures.film import encode
width, height = int(sys.argv[1]), int(sys.argv[2])
shades = np.random.default_rng(0).integers(0, 255, (12, height, width, 3), dtype=np.uint8)
print(hashlib.sha256(encode(list(shades))).hexdigest())
"""


def test_a_film_shows_both_variants_for_the_filmed_time(tmp_path) -> None:
    made = film(tiny_case(tmp_path))

    pictures = decoded(made["film.mp4"])
    assert len(pictures) == 0.4 * FPS + 1
    assert pictures[0].shape == (HEIGHT, 2 * WIDTH, 3)
    left, right = pictures[-1][30:, :WIDTH].astype(int), pictures[-1][30:, WIDTH:].astype(int)
    assert np.abs(left - right).max() > 50, "the box has fallen on one side alone"
    clip = decoded(made["clip.mp4"])
    assert len(clip) == 2 * FPS
    assert clip[0].shape == (192, 256, 3)
    assert np.abs(clip[0].astype(int) - clip[-1]).max() > 50, "the box has fallen"


@pytest.mark.parametrize("size", [CLIP, (2 * WIDTH, HEIGHT)], ids=["clip", "film"])
def test_the_same_images_give_the_same_bytes_whatever_else_is_in_memory(tmp_path: Path, size: tuple[int, int]) -> None:
    told = {run(tmp_path, "-c", ENCODED, *map(str, size), MALLOC_PERTURB_=fill).stdout for fill in ("1", "85", "170")}

    assert len(told) == 1
    assert len(told.pop().strip()) == 64


def test_an_exploding_run_stops_at_its_last_picture_and_says_when() -> None:
    run = RunSpec(duration=1, qpos={"spring": 0.1})

    seen = list(frames(compile_model(EXPLODING), run, Film(), "side"))

    clocks = [clock for _, clock in seen]
    first = next(k for k, clock in enumerate(clocks) if clock.startswith("reset at"))
    assert 0 < first < 5
    assert len(set(clocks[first:])) == 1
    assert all(np.array_equal(picture, seen[first][0]) for picture, _ in seen[first:])


def test_a_strip_shows_each_moment_once() -> None:
    kinds = [np.full((HEIGHT, 2 * WIDTH, 3), shade, dtype=np.uint8) for shade in range(9)]
    assert strip([kinds[0]] * 3 + [kinds[1]] * 3).shape == (2 * HEIGHT, 2 * WIDTH, 3)
    assert strip([kinds[0], kinds[1], kinds[1], kinds[2]])[::HEIGHT, 0, 0].tolist() == [0, 1, 2]
    many = strip([each for each in kinds for _ in range(3)])
    assert many[::HEIGHT, :: 2 * WIDTH, 0].tolist() == [[0, 3], [5, 8]]
