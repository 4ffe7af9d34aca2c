"""The model that a program holds, beside what its text compiles to: a program may have changed its numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator

import mujoco
import numpy as np

from clinic.diagnosis.engine import CAPSULE, CYLINDER, SPHERE
from clinic.diagnosis.finding import Finding, remark

CHANGED = "model-changed"
OF = re.compile(r"qpos|(?:body|jnt|dof|geom|site|actuator|eq|tendon|wrap|sensor|pair|exclude|key)_")
DERIVED = re.compile(
    r"(?:adr|num|id|invweight0|_M0|acc0|length0|lengthrange|subtreemass|simple|sameframe|body_iquat|rgba|rbound|aabb)$"
)  # of other numbers, of how the compiler puts things, or of looks
NEAR = 1e-4  # of the largest number of a row: what a text that was written of a model rounds off
NOISE = 1e-10
SIZES = {SPHERE: 1, CAPSULE: 2, CYLINDER: 2}  # of three, those that a shape has
SHOWN = 6  # fields that are told


def changed(given: mujoco.MjModel, compiled: mujoco.MjModel, file: str) -> list[Finding]:
    """That a model is not what its text compiles to, where it is not: by field the first number that differs."""
    told = sorted(_differences(given, compiled), key=lambda each: "rows" not in each)  # those of another text first
    if not told:
        return []
    more = f"; and {len(told) - SHOWN} more fields" if len(told) > SHOWN else ""
    says = (
        f"The text is what is diagnosed. The model that is given with it has other numbers: {'; '.join(told[:SHOWN])}"
        f"{more}. Write them into the text to have them looked at: `mujoco.mj_saveLastXML` writes those of the model "
        "that was loaded last, all but flags such as contype."
    )
    return [remark(CHANGED, "The model is not what its text compiles to", says, file)]


def _differences(given: mujoco.MjModel, compiled: mujoco.MjModel) -> Iterator[str]:
    theirs = dict(_fields(compiled))
    for field, one in _fields(given):
        other = theirs[field]
        if one.shape != other.shape:
            yield f"{field} has {len(one)} rows, the text's {len(other)}"
            continue
        scale = np.maximum(abs(one), abs(other)).max(axis=-1, keepdims=True, initial=0.0)
        apart = np.argwhere((one != other) & ~(abs(one - other) <= NEAR * scale + NOISE))
        if len(apart):
            at = tuple(apart[0])
            where = [int(each) for each, length in zip(at, one.shape, strict=True) if length > 1]
            yield f"{field}{where or ''} is {one[at]:.4g}, in the text {other[at]:.4g}"


def _fields(model: mujoco.MjModel) -> Iterator[tuple[str, np.ndarray]]:
    """The numbers that physics depends on, a row for each element."""
    for name in dir(model.opt):
        if not name.startswith("_") and isinstance(value := getattr(model.opt, name), (int, float, np.ndarray)):
            yield f"opt.{name}", np.atleast_2d(np.asarray(value, float))
    for name in dir(model):
        if OF.match(name) and not DERIVED.search(name) and isinstance(value := getattr(model, name), np.ndarray):
            rows = value.astype(float).reshape(len(value), -1 if len(value) else 0)
            if name in ("geom_size", "site_size"):
                shapes = getattr(model, name.replace("size", "type"))
                rows = rows * [[at < SIZES.get(shape, 3) for at in range(3)] for shape in shapes.tolist()]
            yield name, rows
