"""Stiffness and inertia of a model at its start: natural frequencies, and the servos that act on single joints."""

from __future__ import annotations

import math
from collections.abc import Iterator

import mujoco
import numpy as np

from clinic.triage.run import Array, Subject

HINGE, SLIDE = int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)
DENSE = 300
"""Degrees of freedom up to which eigenvalues are computed."""


def omega_max(s: Subject) -> float:
    """The highest natural frequency of the springs and servos at the start, in rad/s; 0 without any."""
    m = s.model
    if not 0 < m.nv <= DENSE:
        return 0.0
    stiffness = np.diag(m.jnt_stiffness[m.dof_jntid].astype(float))
    for _, row, k in _rows(s):
        stiffness += k * np.outer(row, row)
    if not stiffness.any():
        return 0.0
    matrix = np.zeros((m.nv, m.nv))
    mujoco.mj_fullM(m, s.data, matrix)
    with np.errstate(all="ignore"):
        squares = np.linalg.eigvals(np.linalg.solve(matrix, stiffness)).real
    return math.sqrt(max(0.0, float(squares.max()))) if np.isfinite(squares).all() else 0.0


def kp(m: mujoco.MjModel, i: int) -> float:
    """The stiffness of an actuator that is a position servo, else 0."""
    affine = m.actuator_biastype[i] == mujoco.mjtBias.mjBIAS_AFFINE
    return float(-m.actuator_biasprm[i, 1]) if affine and m.actuator_outnum[i] == 1 else 0.0


def _rows(s: Subject) -> Iterator[tuple[int, Array, float]]:
    """Every position servo with its moment arms, shape (nv,), and its stiffness."""
    for i in range(s.model.nu):
        if (stiffness := kp(s.model, i)) > 0:
            out = s.model.actuator_outadr[i]
            begin, count = s.data.moment_rowadr[out], s.data.moment_rownnz[out]
            row = np.zeros(s.model.nv)
            row[s.data.moment_colind[begin : begin + count]] = s.data.actuator_moment[begin : begin + count]
            yield i, row, stiffness


def servos(s: Subject) -> Iterator[tuple[int, int, float]]:
    """Every position servo that acts on one hinge or slide: actuator, degree of freedom, stiffness at it."""
    for i, row, stiffness in _rows(s):
        dofs = np.flatnonzero(row)
        if len(dofs) == 1 and s.model.jnt_type[s.model.dof_jntid[dofs[0]]] in (HINGE, SLIDE):
            yield i, int(dofs[0]), stiffness * float(row[dofs[0]]) ** 2


def inertia(s: Subject) -> Array:
    """The diagonal of the inertia matrix at the start, shape (nv,)."""
    m = s.model
    if not 0 < m.nv <= DENSE:
        return np.zeros(m.nv)
    full = np.zeros((m.nv, m.nv))
    mujoco.mj_fullM(m, s.data, full)
    return np.diag(full).copy()
