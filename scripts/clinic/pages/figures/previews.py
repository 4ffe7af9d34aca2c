"""The failure in small: a picture for lists, two seconds of film for tiles, and a card for links."""

from __future__ import annotations

import io
import textwrap
from typing import Any

import numpy as np
from PIL import Image as Pictures
from PIL import ImageDraw, ImageFont

from clinic.engine.render import Image

THUMB = (192, 144)
CLIP, CLIP_FRAMES, HELD = (256, 192), 40, 6  # two seconds at 20 images a second; the last image stays
CARD, SHOWN = (1200, 630), (840, 630)
GREEN, WHITE, PALE = (20, 83, 45), (255, 255, 255), (187, 222, 199)


def thumb(pixels: Image) -> bytes:
    """The picture as WebP of THUMB's size."""
    out = io.BytesIO()
    small = Pictures.fromarray(pixels).resize(THUMB, Pictures.Resampling.LANCZOS)
    small.save(out, format="webp", quality=60, method=6)
    return out.getvalue()


def two_seconds(pictures: list[Image]) -> list[Image]:
    """The images of a film in CLIP_FRAMES of CLIP's size, however long the film is."""
    chosen = np.linspace(0, len(pictures) - 1, CLIP_FRAMES - HELD).round().astype(int)
    at = [*chosen, *[chosen[-1]] * HELD]
    small = {k: np.asarray(Pictures.fromarray(pictures[k]).resize(CLIP, Pictures.Resampling.BOX)) for k in {*at}}
    return [small[k] for k in at]


def card(pixels: Image, title: str, above: str) -> bytes:
    """The picture with a title beside it, as JPEG of CARD's size, which every program that shows links can read."""
    whole = Pictures.new("RGB", CARD, GREEN)
    whole.paste(Pictures.fromarray(pixels).resize(SHOWN, Pictures.Resampling.LANCZOS), (CARD[0] - SHOWN[0], 0))
    ink = ImageDraw.Draw(whole)
    small: Any = ImageFont.load_default(size=24)
    size, rows = 44, textwrap.wrap(title, 14)
    if len(rows) > 7 or max(map(len, rows)) > 14:
        size, rows = 32, textwrap.wrap(title, 19)
    large: Any = ImageFont.load_default(size=size)
    ink.text((32, 36), above, font=small, fill=PALE)
    ink.multiline_text((32, 100), "\n".join(rows), font=large, fill=WHITE, spacing=12)
    ink.text((32, CARD[1] - 60), "MuJoCo Debugging Clinic", font=small, fill=PALE)
    out = io.BytesIO()
    whole.save(out, format="jpeg", quality=80, optimize=True)
    return out.getvalue()
