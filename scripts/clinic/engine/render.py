"""Images of a model, drawn by MuJoCo off screen."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.record.problem import MissingRequirementError

WIDTH, HEIGHT = 480, 360
SHADOW_SIZE, SHADOW_CLIP = 1024, 2.0  # smaller than the defaults: faster; wider: no speckles at the edge
FREE = -1  # MuJoCo's own view of all, from the model's extent
Image = NDArray[np.uint8]


class RenderError(MissingRequirementError):
    """Images cannot be drawn on this machine."""


@contextmanager
def renderer(model: mujoco.MjModel, width: int = WIDTH, height: int = HEIGHT) -> Iterator[mujoco.Renderer]:
    """A renderer that is closed afterwards.

    Raises:
        RenderError: If there is no OpenGL library, or it cannot make a context.
    """
    model.vis.global_.offwidth, model.vis.global_.offheight = width, height  # all of the buffer is read, used or not
    model.vis.quality.shadowsize = min(model.vis.quality.shadowsize, SHADOW_SIZE)
    model.vis.map.shadowclip = max(model.vis.map.shadowclip, SHADOW_CLIP)
    try:
        made = mujoco.Renderer(model, height, width)
    except (ImportError, AttributeError, RuntimeError, mujoco.FatalError) as error:
        raise RenderError(f"OpenGL by {os.environ.get('MUJOCO_GL', 'the default')} is not available: {error}") from None
    with made:
        yield made


def why_no_images() -> str:
    """Says why images cannot be drawn on this machine; empty when they can."""
    try:
        with renderer(mujoco.MjModel.from_xml_string("<mujoco/>"), 8, 8):
            return ""
    except RenderError as error:
        return str(error)


def image(model: mujoco.MjModel, data: mujoco.MjData, camera: str | None) -> Image:
    """Draws the camera's colour image, or a view of all without one, shape (HEIGHT, WIDTH, 3)."""
    with renderer(model) as draw:
        draw.update_scene(data, FREE if camera is None else camera)
        pixels: Image = draw.render()
        return pixels


def geom_row(model: mujoco.MjModel, data: mujoco.MjData, camera: str, geom: str) -> float:
    """The mean row of the geom's visible pixels: 0 the image's top edge, 1 its bottom; NaN when none is visible."""
    with renderer(model) as draw:
        draw.enable_segmentation_rendering()
        draw.update_scene(data, camera)
        seen = draw.render()  # the id and the type of what each pixel shows
    rows = np.nonzero((seen == (model.geom(geom).id, int(mujoco.mjtObj.mjOBJ_GEOM))).all(axis=2))[0]
    return float((rows.mean() + 0.5) / HEIGHT) if len(rows) else float("nan")
