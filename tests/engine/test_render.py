"""Images drawn off screen."""

from __future__ import annotations

import os
import subprocess
import sys

import mujoco
import numpy as np
import pytest
from clinic.engine.render import HEIGHT, WIDTH, RenderError, geom_row, image, renderer
from helpers import compiled

SCENE = """\
<mujoco>
  <visual><headlight ambient="1 1 1" diffuse="0 0 0" specular="0 0 0"/></visual>
  <worldbody>
    <camera name="front" pos="0 -3 0" xyaxes="{xyaxes}"/>
    <geom name="red" pos="0 0 0.5" size="0.2" rgba="1 0 0 1"/>
    <geom name="green" pos="0 0 -0.5" size="0.2" rgba="0 1 0 1"/>
    <geom name="middle" size="0.1" rgba="0 0 1 1"/>
    <geom name="behind" pos="0 -9 0" size="0.1"/>
  </worldbody>
</mujoco>
"""
UPRIGHT, UPSIDE_DOWN = "1 0 0 0 0 1", "-1 0 0 0 0 -1"


def scene(xyaxes: str = UPRIGHT) -> tuple[mujoco.MjModel, mujoco.MjData]:
    return compiled(SCENE.format(xyaxes=xyaxes))


def test_image_shows_what_the_camera_sees() -> None:
    pixels = image(*scene(), "front")
    red, green, _ = (pixels[: HEIGHT // 2].mean(axis=(0, 1)) > pixels[HEIGHT // 2 :].mean(axis=(0, 1))).tolist()
    assert (pixels.shape, pixels.dtype) == ((HEIGHT, WIDTH, 3), np.uint8)
    assert (red, green) == (True, False)


def test_image_does_not_depend_on_the_models_own_buffer_size() -> None:
    xml = SCENE.format(xyaxes=UPRIGHT).replace("<visual>", '<visual><global offwidth="64" offheight="48"/>')
    assert image(*compiled(xml), "front").shape == (HEIGHT, WIDTH, 3)


@pytest.mark.parametrize(
    ("xyaxes", "geom", "low", "high"),
    [
        pytest.param(UPRIGHT, "red", 0.1, 0.45, id="above"),
        pytest.param(UPRIGHT, "green", 0.55, 0.9, id="below"),
        pytest.param(UPSIDE_DOWN, "red", 0.55, 0.9, id="above-upside-down"),
        pytest.param(UPRIGHT, "middle", 0.4999, 0.5001, id="on-the-axis"),
    ],
)
def test_row_of_a_geom(xyaxes: str, geom: str, low: float, high: float) -> None:
    assert low < geom_row(*scene(xyaxes), "front", geom) < high


def test_a_geom_out_of_sight_has_no_row() -> None:
    assert np.isnan(geom_row(*scene(), "front", "behind"))


def test_machine_without_opengl_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("no display")

    monkeypatch.setattr(mujoco, "Renderer", fail)
    with pytest.raises(RenderError, match=r"OpenGL by \w+ is not available: no display"), renderer(scene()[0]):
        pass


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have a window server")
def test_importing_the_package_is_enough_to_draw_without_a_display() -> None:
    code = (
        "import clinic.engine.render, mujoco\n"
        "model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><camera name=\"c\"/></worldbody></mujoco>')\n"
        "print(clinic.engine.render.image(model, mujoco.MjData(model), 'c').shape)\n"
    )
    environment = {key: value for key, value in os.environ.items() if key not in ("MUJOCO_GL", "DISPLAY")}
    done = subprocess.run([sys.executable, "-c", code], env=environment, check=False, capture_output=True, text=True)
    assert done.stdout == f"({HEIGHT}, {WIDTH}, 3)\n", done.stderr
