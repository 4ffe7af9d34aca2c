"""Stiffness and inertia of a model at its start: natural frequencies, and the servos that act on single joints."""

from __future__ import annotations

import math
from collections.abc import Iterator

import mujoco
import numpy as np

from clinic.engine.releases import mass_matrix, output_of
from clinic.triage.recording import Array, Subject

HINGE, SLIDE = int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)
DENSE = 300  # degrees of freedom up to which inertias and eigenvalues are computed


def highest_frequency(s: Subject) -> float:
    """The highest natural frequency of the springs and servos at the start, in rad/s; 0 without any.

    The root of the largest eigenvalue of M^-1 K; see Hairer, Lubich, Wanner, *Geometric Numerical Integration*, I.5.
    """
    m = s.model
    stiffness = np.diag(m.jnt_stiffness[m.dof_jntid].astype(float))
    for _, arms, kp in _position_servos(s):
        stiffness += kp * np.outer(arms, arms)
    if m.nv > DENSE or not stiffness.any():
        return 0.0
    with np.errstate(all="ignore"):
        squares = np.linalg.eigvals(np.linalg.solve(mass_matrix(m, s.data), stiffness)).real
    return math.sqrt(max(0.0, float(squares.max()))) if np.isfinite(squares).all() else 0.0


def joint_servos(s: Subject) -> Iterator[tuple[int, int, float]]:
    """Every position servo that acts on one hinge or slide: actuator, degree of freedom, stiffness at it."""
    for actuator, arms, kp in _position_servos(s):
        dofs = np.flatnonzero(arms)
        if len(dofs) == 1 and s.model.jnt_type[s.model.dof_jntid[dofs[0]]] in (HINGE, SLIDE):
            yield actuator, int(dofs[0]), kp * float(arms[dofs[0]]) ** 2


def inertias(s: Subject) -> Array:
    """The diagonal of the inertia matrix at the start, shape (nv,), in kg m² or kg; zeros for large models."""
    return np.diag(mass_matrix(s.model, s.data)) if s.model.nv <= DENSE else np.zeros(s.model.nv)


def _position_servos(s: Subject) -> Iterator[tuple[int, Array, float]]:
    """Every position servo with its moment arms, shape (nv,), and its stiffness kp."""
    for actuator in range(s.model.nu):
        row, kp = output_of(s.model, actuator), -float(s.model.actuator_biasprm[actuator, 1])
        if s.model.actuator_biastype[actuator] == mujoco.mjtBias.mjBIAS_AFFINE and row is not None and kp > 0:
            begin, count = s.data.moment_rowadr[row], s.data.moment_rownnz[row]
            arms = np.zeros(s.model.nv)
            arms[s.data.moment_colind[begin : begin + count]] = s.data.actuator_moment[begin : begin + count]
            yield actuator, arms, kp
