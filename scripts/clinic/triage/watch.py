"""The watched run of triage: the model as it is, with everything recorded that its steps ask for."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice, pairwise

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.triage.run import Array, Budget, Recording, Subject, gap, record, scale

WATCHED = 0.25
"""The share of the budget that the watched run may take."""
CHAOS = 0.15
NUDGE = 1e-9
"""How far every velocity is changed to see whether a motion is chaotic, in rad/s or m/s."""
ONE_STAGE = tuple(int(getattr(mujoco.mjtIntegrator, f"mjINT_{name}")) for name in ("EULER", "IMPLICIT", "IMPLICITFAST"))
MAX_PAIRS = 10_000
MAX_UNMATCHED, MOMENTS = 200, 20
"""How many pairs of geoms with masks that do not match are measured, at how many moments."""


@dataclass
class Touch:
    """Two geoms in contact: from when on, in s, and how deep at the deepest, in m."""

    since: float
    deepest: float


class Watch:
    """Reads what a step of the model shows.

    Attributes:
        touched: The contacts seen, by the pair of geoms.
        farthest: The longest way each geom's centre went in one step, in m, shape (ngeom,).
        fastest: The largest speed of a degree of freedom, in rad/s or m/s, and its index.
        energies: Potential and kinetic energy at the start of each step, in J.
        supplied: The work done by actuators and gravity compensation up to the start of each step, in J.
        overlaps: From when on, in s, geoms overlapped whose contact masks do not match.
        momenta: For each tree, its momentum at the start of each step, in kg m/s.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, steps: int) -> None:
        self.overlaps: dict[tuple[int, int], float] = {}
        self._unmatched = list(islice(unmatched(model), MAX_UNMATCHED))
        self._every = max(1, steps // MOMENTS)
        self.touched: dict[tuple[int, int], Touch] = {}
        self.farthest = np.zeros(model.ngeom)
        self.fastest = (0.0, 0)
        self.acted = np.zeros(model.nv, dtype=bool)
        self._before = data.geom_xpos.copy()
        self._qvel = data.qvel.copy()
        self._powers: list[tuple[Array, Array]] = []
        self._energies: list[tuple[float, float]] = []
        self._momenta: list[Array] = []
        self._roots = np.asarray(model.tree_bodyadr, dtype=int)
        self._steps = 0
        self._timestep = model.opt.timestep
        self._one_stage = model.opt.integrator in ONE_STAGE

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Reads the data after a step; positions, forces and energies are those of the step's start."""
        with np.errstate(all="ignore"):
            self._contacts(data)
            if self._steps % self._every == 0:
                self._overlaps(model, data)
            if self._steps:
                way = np.linalg.norm(data.geom_xpos - self._before, axis=1)
                np.fmax(self.farthest, way, out=self.farthest)
            speed = np.abs(data.qvel)
            if model.nv and np.nanmax(speed, initial=0.0) > self.fastest[0]:
                self.fastest = (float(np.nanmax(speed)), int(np.nanargmax(speed)))
            force = data.qfrc_actuator + np.where(_routed(model), 0.0, data.qfrc_gravcomp)
            self.acted |= data.qfrc_actuator != 0
            self._powers.append((force, self._qvel))
            self._energies.append((float(data.energy[0]), float(data.energy[1])))
            mujoco.mj_subtreeVel(model, data)
            self._momenta.append(model.body_subtreemass[self._roots, None] * data.subtree_linvel[self._roots])
        self._before = data.geom_xpos.copy()
        self._qvel = data.qvel.copy()
        self._steps += 1

    @property
    def energies(self) -> Array:
        """Shape (steps, 2)."""
        return np.array(self._energies).reshape(-1, 2)

    @property
    def supplied(self) -> Array:
        """Shape (steps,). A one-stage integrator applies the force of a step's start over the whole step."""
        with np.errstate(all="ignore"):
            gains = [
                self._timestep * float((one[0] if self._one_stage else (one[0] + two[0]) / 2) @ (one[1] + two[1])) / 2
                for one, two in pairwise(self._powers)
            ]
        return np.cumsum([0.0, *gains])

    @property
    def momenta(self) -> Array:
        """Shape (steps, trees, 3)."""
        return np.array(self._momenta).reshape(-1, len(self._roots), 3)

    def _contacts(self, data: mujoco.MjData) -> None:
        if not data.ncon:
            return
        since = self._steps * self._timestep
        for (one, two), dist in zip(data.contact.geom.tolist(), data.contact.dist.tolist(), strict=True):
            touch = self.touched.get((one, two))
            if touch is not None:
                touch.deepest = max(touch.deepest, -dist)
            elif len(self.touched) < MAX_PAIRS:
                self.touched[(one, two)] = Touch(since, max(0.0, -dist))

    def _overlaps(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        for one, two in self._unmatched:
            if (one, two) not in self.overlaps and mujoco.mj_geomDistance(model, data, one, two, 1e-6, None) < 0:
                self.overlaps[(one, two)] = self._steps * self._timestep


@dataclass
class Trial:
    """A subject under examination, with the budget for it and the one run that several steps look at."""

    subject: Subject
    budget: Budget

    @cached_property
    def base(self) -> tuple[Recording, Watch]:
        """The model as it is, run once and watched.

        Raises:
            RunError: If the run cannot start.
        """
        subject = self.subject
        model = copy.copy(subject.model)
        model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
        watch = Watch(model, subject.data, subject.steps)
        return record(subject, model, self.budget.part(WATCHED), watch=watch), watch

    @cached_property
    def chaos(self) -> float:
        """How far the motion changes with every start velocity changed by NUDGE, as a share of the scene's scale."""
        subject, (base, _) = self.subject, self.base

        def nudge(_: mujoco.MjModel, data: mujoco.MjData) -> None:
            data.qvel[:] += NUDGE

        again = record(subject, subject.model, self.budget.part(CHAOS), nudge=nudge)
        return gap(base, again) / scale(subject, base)


def unmatched(model: mujoco.MjModel) -> Iterator[tuple[int, int]]:
    """Pairs of geoms that have contact masks and could meet, but whose masks do not match.

    Pairs that MuJoCo leaves out for other reasons are left out: welded, parent and child, excluded; named pairs too.
    """
    m = model
    excluded = {(int(k) >> 16, int(k) & 0xFFFF) for k in m.exclude_signature}
    named = {frozenset((int(i), int(j))) for i, j in zip(m.pair_geom1, m.pair_geom2, strict=True)}
    weld = m.body_weldid[m.geom_bodyid]
    parent = m.body_weldid[m.body_parentid[weld]]
    able = np.flatnonzero((m.geom_contype != 0) | (m.geom_conaffinity != 0))
    for k, i in enumerate(able):
        rest = able[k + 1 :]
        match = (m.geom_contype[i] & m.geom_conaffinity[rest]) | (m.geom_contype[rest] & m.geom_conaffinity[i])
        child = (parent[rest] == weld[i]) & (weld[i] > 0) | (parent[i] == weld[rest]) & (weld[rest] > 0)
        for j in rest[(match == 0) & (weld[rest] != weld[i]) & ~child]:
            bodies = (int(m.geom_bodyid[i]), int(m.geom_bodyid[j]))
            if bodies not in excluded and bodies[::-1] not in excluded and frozenset((int(i), int(j))) not in named:
                yield int(i), int(j)


def _routed(model: mujoco.MjModel) -> NDArray[np.bool_]:
    """For each degree of freedom, whether gravity compensation is applied as an actuator force."""
    routed: NDArray[np.bool_] = np.asarray(model.jnt_actgravcomp, dtype=bool)[model.dof_jntid]
    return routed
