"""Numbers of a compiled model that a prediction can read. Each states its source."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from clinic.engine.releases import mass_matrix


def omega_max(model: mujoco.MjModel) -> float:
    """The highest natural frequency of the joint springs at qpos0, in rad/s: sqrt of the largest eigenvalue of M^-1 K.

    An undamped linear oscillator under semi-implicit Euler is stable for h < 2 / omega; coupled joints have one such
    limit a mode, and the highest mode decides. See Hairer, Lubich, Wanner, *Geometric Numerical Integration*, I.5.
    """
    stiffness = np.diag(model.jnt_stiffness[model.dof_jntid])
    return math.sqrt(float(np.max(np.linalg.eigvals(np.linalg.solve(mass_matrix(model), stiffness)).real)))


def omega_one_link(model: mujoco.MjModel) -> float:
    """The popular estimate of the same, in rad/s: sqrt(k / I) of the last joint with its own link's inertia."""
    return math.sqrt(float(model.jnt_stiffness[-1]) / float(mass_matrix(model)[-1, -1]))


MODEL_NUMBERS = {"omega_max": omega_max, "omega_one_link": omega_one_link}
