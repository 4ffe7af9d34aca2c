"""Films of code cases: a scene in the places that the script printed, of the broken script beside the first fix."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence

import mujoco
import numpy as np
from PIL import Image as Pictures

from clinic.engine.render import Image, image
from clinic.engine.simulate import compile_model
from clinic.engine.variant import variants
from clinic.pages.figures.film import FPS, HEIGHT, WIDTH, films
from clinic.pages.figures.pictures import small, webp
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.record.case import Case
from clinic.record.fields import Picture
from clinic.work.cache import Files

DURATION = 4  # s, of the film, if a sample then stays no longer than LONGEST and no shorter than SHORTEST images
LONGEST, SHORTEST = 12, 4


def replay(case: Case, evidence: Evidence) -> Files:
    """The files of the film, a sample after the other, and the stills of the one where the two differ most.

    Raises:
        RenderError: If images cannot be drawn on this machine.
    """
    picture = case.record.picture
    assert picture.scene is not None
    text = case.texts[picture.scene]
    shown = [evidence.variants[each.id] for each in variants(case)[:2]]
    times = [sorted({time for signal in picture.shows.values() for time in each.traces[signal].time}) for each in shown]
    both = [time for time in sorted({*times[0], *times[1]}) if time <= min(times[0][-1], times[1][-1])]
    broken, fixed = (list(places(text, picture, each, both)) for each in shown)
    count = len(both)
    most = max(range(count), key=lambda k: float(np.abs(broken[k].astype(float) - fixed[k]).mean()))
    hold = max(SHORTEST, min(LONGEST, DURATION * FPS // count))
    told = [
        [(_film_size(each), f"{k + 1} of {count}") for k, each in enumerate(drawn) for _ in range(hold)]
        for drawn in (broken, fixed)
    ]
    stills = {"broken.webp": webp(broken[most])} | small(case, broken[most])
    return films(told[0], told[1], most * hold) | stills


def places(text: str, picture: Picture, said: VariantEvidence, times: Sequence[float] | None = None) -> Iterator[Image]:
    """The scene at each of these times, or at each sample, shape (height, width, 3).

    What is not a number leaves its joint where it was.
    """
    model = compile_model(text)
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    traces = {joint: said.traces[signal] for joint, signal in picture.shows.items()}
    for time in times or sorted({time for trace in traces.values() for time in trace.time}):
        for joint, trace in traces.items():
            value = trace.value[bisect_right(trace.time, time) - 1]  # what stays the same is kept as its ends alone
            if value is not None and math.isfinite(value):
                data.joint(joint).qpos[0] = value
        mujoco.mj_forward(model, data)
        yield image(model, data, picture.camera)


def _film_size(pixels: Image) -> Image:
    return np.asarray(Pictures.fromarray(pixels).resize((WIDTH, HEIGHT), Pictures.Resampling.BOX))
