"""Still images of a case: of the broken variant and of the first fix, or of a scene beside code."""

from __future__ import annotations

import io

import mujoco
from PIL import Image as Pictures

from clinic.engine.render import Image, image
from clinic.engine.simulate import compile_model, data_at
from clinic.engine.variant import variants
from clinic.pages.figures.previews import card, thumb
from clinic.record.case import Case
from clinic.record.fields import Picture, RunSpec
from clinic.work.cache import Files


def pictures(case: Case) -> Files:
    """The still images: `broken.webp`, and `fixed.webp` of the first fix where the model is the case's.

    Of the first of them also `thumb.webp`, for lists, and `card.jpg`, for links.

    Raises:
        RenderError: If images cannot be drawn on this machine.
    """
    record, drawn = case.record, dict[str, Image]()
    if record.run is not None:
        for name, variant in zip(("broken", "fixed"), variants(case), strict=False):
            model = compile_model(variant.text)
            data = data_at(model, record.run, picture_time(record.picture, record.run))
            drawn[name] = image(model, data, record.picture.camera)
    elif record.picture.scene is not None:
        drawn["broken"] = scene_image(case.texts[record.picture.scene], record.picture.camera)
    made = {f"{name}.webp": webp(pixels) for name, pixels in drawn.items()}
    return made | small(case, drawn["broken"]) if "broken" in drawn else made


def small(case: Case, pixels: Image) -> Files:
    """`thumb.webp`, for lists, and `card.jpg`, for links."""
    record = case.record
    above = f"Case {record.number}" if record.number else "A case"
    return {"thumb.webp": thumb(pixels), "card.jpg": card(pixels, record.title, above)}


def picture_time(picture: Picture, run: RunSpec) -> float:
    """When the picture is taken, in s."""
    return run.duration / 2 if picture.time is None else picture.time


def scene_image(text: str, camera: str | None) -> Image:
    """A model as it starts, in its first keyframe where it has one; shape (height, width, 3)."""
    model = compile_model(text)
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    return image(model, data, camera)


def webp(pixels: Image) -> bytes:
    """The image, compressed."""
    out = io.BytesIO()
    Pictures.fromarray(pixels).save(out, format="webp", quality=82, method=6)
    return out.getvalue()
