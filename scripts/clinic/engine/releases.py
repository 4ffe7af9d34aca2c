"""What differs between MuJoCo's releases from 3.4 on: each difference stands here once, as a function."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray


def read_spec(path: Path) -> mujoco.MjSpec:
    """The model in an MJCF or URDF file, not compiled; older releases know no file that ends on .urdf.

    Raises:
        ValueError: With MuJoCo's message, if it cannot be read.
    """
    try:
        return mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        if "Could not find decoder" not in str(error):
            raise
        spec = mujoco.MjSpec.from_string(path.read_text(encoding="utf-8"))
        spec.modelfiledir = str(path.parent)
        return spec


def control_of(model: mujoco.MjModel, actuator: int) -> int | None:
    """Where in `data.ctrl` the actuator's control stands; None if it has none or several, as it may in newer ones."""
    if not hasattr(model, "actuator_ctrlnum"):
        return actuator
    return int(model.actuator_ctrladr[actuator]) if model.actuator_ctrlnum[actuator] == 1 else None


def output_of(model: mujoco.MjModel, actuator: int) -> int | None:
    """The actuator's row of `data.actuator_moment`; None if it has none or several, as it may in newer releases."""
    if not hasattr(model, "actuator_outnum"):
        return actuator
    return int(model.actuator_outadr[actuator]) if model.actuator_outnum[actuator] == 1 else None


def mass_matrix(model: mujoco.MjModel, data: mujoco.MjData | None = None) -> NDArray[np.float64]:
    """The joint-space inertia, at qpos0 unless data are given, shape (nv, nv), in kg m^2 or kg."""
    if data is None:
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
    matrix = np.zeros((model.nv, model.nv))
    for row, unit in zip(matrix, np.eye(model.nv), strict=True):  # mj_fullM takes other arguments on older releases
        mujoco.mj_mulM(model, data, row, unit)
    return matrix
