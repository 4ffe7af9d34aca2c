"""Still images of a case: of the broken variant and of the first fix, or of a scene beside code."""

from __future__ import annotations

import mujoco

from clinic.engine.render import Image, image
from clinic.engine.simulate import compile_model, data_at
from clinic.engine.variant import Variant, variants
from clinic.pages.figures.film import webp
from clinic.record.case import Case
from clinic.work.cache import Files


def pictures(case: Case) -> Files:
    """The still images: `broken.webp`, and `fixed.webp` of the first fix where the model is the case's.

    Raises:
        RenderError: If images cannot be drawn on this machine.
    """
    if case.record.model is not None:
        broken, fixed, *_ = variants(case)
        return {"broken.webp": webp(still(case, broken)), "fixed.webp": webp(still(case, fixed))}
    return {"broken.webp": webp(scene_image(case))} if case.record.picture.scene is not None else {}


def still(case: Case, variant: Variant) -> Image:
    """A variant at the picture's time, from the picture's camera."""
    record = case.record
    assert record.run is not None
    model = compile_model(variant.text)
    return image(model, data_at(model, record.run, record.picture.time), record.picture.camera)


def scene_image(case: Case) -> Image:
    """A code case's scene, in its first keyframe where it has one."""
    picture = case.record.picture
    assert picture.scene is not None
    model = compile_model(case.texts[picture.scene])
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    return image(model, data, picture.camera)
