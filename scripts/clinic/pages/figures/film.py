"""Films: the broken model beside the first fix, same camera, same clock, with MuJoCo's own overlays."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import av
import mujoco
import numpy as np
from PIL import Image as Pictures
from PIL import ImageDraw, ImageFont

from clinic.engine.render import FREE, Image, renderer
from clinic.engine.simulate import captured_messages, compile_model, controls, initial_data, step
from clinic.engine.variant import variants
from clinic.pages.figures.pictures import picture_time, webp
from clinic.pages.figures.previews import two_seconds
from clinic.record.case import Case
from clinic.record.fields import Film, RunSpec
from clinic.record.prose import number
from clinic.work.cache import Files

WIDTH, HEIGHT, FPS = 320, 240, 20
DRAWN, SHADOW_SIZE = (480, 360), 512  # larger, then averaged: as smooth as four samples a pixel, and a third cheaper
MAX_FRAMES = 160
STRIP = 4
STILL = 1e-4
FLAGS = {
    "contact_points": mujoco.mjtVisFlag.mjVIS_CONTACTPOINT,
    "contact_forces": mujoco.mjtVisFlag.mjVIS_CONTACTFORCE,
    "joint_axes": mujoco.mjtVisFlag.mjVIS_JOINT,
    "inertia": mujoco.mjtVisFlag.mjVIS_INERTIA,
    "actuators": mujoco.mjtVisFlag.mjVIS_ACTUATOR,
    "transparent": mujoco.mjtVisFlag.mjVIS_TRANSPARENT,
    "cameras": mujoco.mjtVisFlag.mjVIS_CAMERA,
}


def film(case: Case) -> Files:
    """`film.mp4`, its `poster.webp`, `strip.webp`: moments for paper, and `clip.mp4`: two seconds of the failure.

    Raises:
        RenderError: If images cannot be drawn on this machine.
    """
    record, spec = case.record, case.record.filmed
    assert spec is not None
    assert record.run is not None
    camera = record.picture.camera
    broken, fixed = (
        list(frames(compile_model(variant.text), record.run, spec, camera)) for variant in variants(case)[:2]
    )
    at = min(picture_time(record.picture, record.run) / film_duration(spec, record.run), 1.0)
    return films(broken, fixed, round(at * (len(broken) - 1)))


def films(broken: list[tuple[Image, str]], fixed: list[tuple[Image, str]], at: int) -> Files:
    """The files of a film, from its images with their clocks; `at` says which is the poster."""
    pictures = [beside(left, right) for left, right in zip(broken, fixed, strict=True)]
    return {
        "film.mp4": encode(pictures),
        "poster.webp": webp(pictures[at]),
        "clip.mp4": encode(two_seconds([image for image, _ in broken])),
        "strip.webp": webp(strip(pictures)),
    }


def strip(pictures: list[Image]) -> Image:
    """STRIP moments of a film in two columns; where fewer of its images differ, each of these once, in one column."""
    differ = [k for k, each in enumerate(pictures) if k == 0 or not np.array_equal(each, pictures[k - 1])]
    if len(differ) < STRIP:
        return np.vstack([pictures[k] for k in differ])
    shown = [pictures[differ[k]] for k in np.linspace(0, len(differ) - 1, STRIP).round().astype(int)]
    return np.vstack([np.hstack(shown[k : k + 2]) for k in (0, 2)])


def film_duration(spec: Film, run: RunSpec) -> float:
    """The simulated time that is filmed, in s."""
    return min(spec.duration or run.duration, MAX_FRAMES / FPS * spec.speed)


def frames(model: mujoco.MjModel, run: RunSpec, spec: Film, camera: str | None) -> Iterator[tuple[Image, str]]:
    """The images of a run, shape (HEIGHT, WIDTH, 3), each with the text of its clock.

    A state that has moved by less than STILL, in m or rad, is not drawn anew. From the first warning of a
    diverging run on, the last image before it stays: a state that is reset every few steps would flash.
    """
    count = max(2, math.floor(film_duration(spec, run) / spec.speed * FPS) + 1)
    last = round((count - 1) / FPS * spec.speed / model.opt.timestep)
    data, drive, option = initial_data(model, run), controls(model, run, last), mujoco.MjvOption()
    for name in spec.overlays:
        if name == "body_frames":
            option.frame = mujoco.mjtFrame.mjFRAME_BODY
        else:
            option.flags[FLAGS[name]] = True
    made, image, halted, drawn = 0, None, "", data.qpos.copy()
    model.vis.quality.offsamples, model.vis.quality.shadowsize = 0, SHADOW_SIZE
    with captured_messages(), renderer(model, *DRAWN) as draw:
        mujoco.mj_forward(model, data)
        for k in range(count):
            time = k / FPS * spec.speed
            while made < round(time / model.opt.timestep) and not halted:
                step(model, data, drive, made)
                made += 1
                if any(warning.number for warning in data.warning):
                    halted = f"reset at {number(made * model.opt.timestep, 2)} s"
            if image is None or (not halted and np.max(np.abs(data.qpos - drawn), initial=0) > STILL):
                mujoco.mj_kinematics(model, data)  # a step leaves the positions of its start
                draw.update_scene(data, FREE if camera is None else camera, option)
                large = Pictures.fromarray(draw.render())
                image, drawn = np.asarray(large.resize((WIDTH, HEIGHT), Pictures.Resampling.BOX)), data.qpos.copy()
            yield image, halted or f"{time:.2f} s"


def beside(broken: tuple[Image, str], repaired: tuple[Image, str]) -> Image:
    """Two images side by side, each with its title and clock, shape (HEIGHT, 2 * WIDTH, 3)."""
    whole = Pictures.fromarray(np.hstack([broken[0], repaired[0]]))
    ink = ImageDraw.Draw(whole)
    font: Any = ImageFont.load_default(size=14)
    for x, title, clock in ((0, "broken", broken[1]), (WIDTH, "repaired", repaired[1])):
        for place, text, anchor in (((x + 8, 6), title, "la"), ((x + WIDTH - 8, 6), clock, "ra")):
            left, top, right, bottom = ink.textbbox(place, text, font=font, anchor=anchor)
            ink.rectangle((left - 4, top - 3, right + 4, bottom + 3), fill=(20, 24, 28))
            ink.text(place, text, font=font, anchor=anchor, fill=(255, 255, 255))
    ink.line((WIDTH, 0, WIDTH, HEIGHT), fill=(20, 24, 28), width=2)
    return np.asarray(whole)


def encode(pictures: list[Image]) -> bytes:
    """The images as H.264 in MP4; the same images give the same bytes where their width is a multiple of 128.

    Of other widths the encoder reads what lies in memory beyond the end of a row.
    """
    with tempfile.TemporaryDirectory(prefix="clinic-") as folder:
        path = Path(folder, "film.mp4")
        with av.open(str(path), "w", options={"movflags": "faststart", "fflags": "+bitexact"}) as container:
            stream = container.add_stream("libx264", rate=FPS, options={"crf": "27", "preset": "slow", "threads": "1"})
            stream.height, stream.width = pictures[0].shape[:2]
            stream.pix_fmt = "yuv420p"
            for picture in pictures:
                container.mux(stream.encode(av.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")))
            container.mux(stream.encode())
        return path.read_bytes()
