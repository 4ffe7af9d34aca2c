"""Numbers that closed forms need: of a compiled model, and functions of numbers. Each states its source."""

from __future__ import annotations

import math
from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import NDArray


def omega_max(model: mujoco.MjModel) -> float:
    """The highest natural frequency of the joint springs at qpos0, in rad/s: sqrt of the largest eigenvalue of M^-1 K.

    An undamped linear oscillator under semi-implicit Euler is stable for h < 2 / omega; coupled joints have one such
    limit a mode, and the highest mode decides. See Hairer, Lubich, Wanner, *Geometric Numerical Integration*, I.5.
    """
    mass = mass_matrix(model)
    stiffness = np.diag(model.jnt_stiffness[model.dof_jntid])
    return math.sqrt(float(np.max(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)))


def omega_one_link(model: mujoco.MjModel) -> float:
    """The popular estimate of the same, in rad/s: sqrt(k / I) of the last joint with its own link's inertia."""
    stiffness = float(model.jnt_stiffness[-1])
    return math.sqrt(stiffness / float(mass_matrix(model)[-1, -1]))


def mass_matrix(model: mujoco.MjModel) -> NDArray[np.float64]:
    """The dense joint-space inertia at qpos0, shape (nv, nv), in kg m^2 or kg."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    return mass


MODEL_NUMBERS: dict[str, Callable[[mujoco.MjModel], float]] = {
    "omega_max": omega_max,
    "omega_one_link": omega_one_link,
}


def servo_sag(kp: float, load: float) -> float:
    """The angle below horizontal, in rad, at which a position servo holds an arm: the root of kp q = load cos q.

    `kp` is in N m/rad, `load` the gravity torque of the horizontal arm in N m. Newton's method; both sides are
    monotonic on [0, pi/2], so the root is unique.
    """
    angle = min(load / kp, math.pi / 2)
    for _ in range(60):
        angle -= (kp * angle - load * math.cos(angle)) / (kp + load * math.sin(angle))
    return angle


FUNCTIONS: dict[str, Callable[..., float]] = {"servo_sag": servo_sag}
