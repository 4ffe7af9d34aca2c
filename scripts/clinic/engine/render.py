"""Images of a model, drawn by MuJoCo off screen.

`mujoco.Renderer` makes an OpenGL context for every model, in which everything is compiled anew: 0.3 s on a machine
without a GPU. Here all models of a thread share one.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.record.problem import LackError

WIDTH, HEIGHT = 480, 360
SHADOW_SIZE, SHADOW_CLIP = 1024, 2.0  # smaller than the defaults: faster; wider: no speckles at the edge
MOST_GEOMS = 10_000
Image = NDArray[np.uint8]
_own = threading.local()


class RenderError(LackError):
    """Images cannot be drawn on this machine."""


class Renderer:
    """Draws one model, in the OpenGL context of this thread.

    Raises:
        AttributeError, ImportError, RuntimeError, mujoco.FatalError: If there is none.
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int) -> None:
        _context().make_current()
        self.model, self.shape = model, (height, width, 3)
        self.scene = mujoco.MjvScene(model, MOST_GEOMS)
        self.camera = mujoco.MjvCamera()
        self.camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        self.context = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self.context)

    def render(self, data: mujoco.MjData, camera: str, option: mujoco.MjvOption | None = None) -> Image:
        """The camera's image, shape (height, width, 3)."""
        self.camera.fixedcamid = self.model.camera(camera).id
        seen = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self.model, data, option or mujoco.MjvOption(), None, self.camera, seen, self.scene)
        height, width, _ = self.shape
        whole, pixels = mujoco.MjrRect(0, 0, width, height), np.empty(self.shape, np.uint8)
        mujoco.mjr_render(whole, self.scene, self.context)
        mujoco.mjr_readPixels(pixels, None, whole, self.context)
        return np.flipud(pixels)  # OpenGL counts rows from below

    def objects(self, data: mujoco.MjData, camera: str) -> NDArray[np.int32]:
        """The type and the id of what the camera sees, shape (height, width, 2); -1 where that is nothing."""
        for flag in (mujoco.mjtRndFlag.mjRND_SEGMENT, mujoco.mjtRndFlag.mjRND_IDCOLOR):
            self.scene.flags[flag] = True
        segments = self.render(data, camera).astype(np.int64) @ (1, 2**8, 2**16)
        seen = np.full((self.scene.ngeom + 1, 2), -1, np.int32)
        for geom in self.scene.geoms[: self.scene.ngeom]:
            if geom.segid >= 0:
                seen[geom.segid + 1] = geom.objtype, geom.objid
        found: NDArray[np.int32] = seen[segments]
        return found


def _context() -> Any:
    """The OpenGL context of this thread; the images are drawn into buffers of their own size."""
    if not hasattr(_own, "context"):
        _own.context = mujoco.GLContext(WIDTH, HEIGHT)
    return _own.context


@contextmanager
def renderer(model: mujoco.MjModel, width: int = WIDTH, height: int = HEIGHT) -> Iterator[Renderer]:
    """A renderer that is closed afterwards.

    Raises:
        RenderError: If there is no OpenGL library, or it cannot make a context.
    """
    model.vis.global_.offwidth, model.vis.global_.offheight = width, height  # all of the buffer is read, used or not
    model.vis.quality.shadowsize = min(model.vis.quality.shadowsize, SHADOW_SIZE)
    model.vis.map.shadowclip = max(model.vis.map.shadowclip, SHADOW_CLIP)
    try:
        made = Renderer(model, width, height)
    except (ImportError, AttributeError, RuntimeError, mujoco.FatalError) as error:
        raise RenderError(f"OpenGL by {os.environ.get('MUJOCO_GL', 'the default')} is not available: {error}") from None
    try:
        yield made
    finally:
        made.context.free()


def blindness() -> str:
    """Why images cannot be drawn on this machine; empty when they can."""
    try:
        with renderer(mujoco.MjModel.from_xml_string("<mujoco/>"), 8, 8):
            return ""
    except RenderError as error:
        return str(error)


def image(model: mujoco.MjModel, data: mujoco.MjData, camera: str) -> Image:
    """The camera's colour image, shape (HEIGHT, WIDTH, 3)."""
    with renderer(model) as draw:
        return draw.render(data, camera)


def geom_row(model: mujoco.MjModel, data: mujoco.MjData, camera: str, geom: str) -> float:
    """The mean row of the geom's visible pixels: 0 the image's top edge, 1 its bottom; NaN when none is visible."""
    with renderer(model) as draw:
        seen = draw.objects(data, camera)
    rows = np.nonzero((seen == (int(mujoco.mjtObj.mjOBJ_GEOM), model.geom(geom).id)).all(axis=2))[0]
    return float((rows.mean() + 0.5) / HEIGHT) if len(rows) else float("nan")
