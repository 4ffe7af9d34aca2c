"""The watched run of triage: the model as it is, with everything recorded that its steps ask for."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

import mujoco
import numpy as np

from clinic.triage.run import Array, Budget, Recording, Subject, distance, record, scale

NUDGE = 1e-9
"""How far every velocity is changed to see whether a motion is chaotic, in rad/s or m/s."""
MAX_UNMATCHED, MOMENTS = 200, 20
"""How many pairs of geoms with masks that do not match are measured, at how many moments."""


class Watcher:
    """Reads what each step of a run shows.

    Attributes:
        touching: The pairs of geoms seen in contact.
        farthest: The longest way each geom's centre went in one step, in m, shape (ngeom,).
        fastest: The largest speed of a degree of freedom, in rad/s or m/s, and its index.
        energies: Potential and kinetic energy at the start of each step, in J.
        supplied: The work done by actuators and gravity compensation up to the start of each step, in J.
        overlaps: From when on, in s, geoms overlapped whose contact masks do not match.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, steps: int) -> None:
        self.touching: set[tuple[int, int]] = set()
        self.farthest = np.zeros(model.ngeom)
        self.fastest = (0.0, 0)
        self.energies: list[tuple[float, float]] = []
        self.supplied = [0.0]
        self.overlaps: dict[tuple[int, int], float] = {}
        self._unmatched = list(islice(unmatched_pairs(model), MAX_UNMATCHED))
        self._every = max(1, steps // MOMENTS)
        self._centres, self._speeds = data.geom_xpos.copy(), data.qvel.copy()

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Reads the data after a step; positions, forces and energies are those of the step's start."""
        made = len(self.energies)
        if data.ncon:
            self.touching.update(map(tuple, data.contact.geom.tolist()))
        if made % self._every == 0:
            for one, two in self._unmatched:
                if (one, two) not in self.overlaps and mujoco.mj_geomDistance(model, data, one, two, 1e-6, None) < 0:
                    self.overlaps[(one, two)] = made * model.opt.timestep
        np.fmax(self.farthest, np.linalg.norm(data.geom_xpos - self._centres, axis=1), out=self.farthest)
        speed = np.nan_to_num(np.abs(data.qvel))
        if speed.max(initial=0.0) > self.fastest[0]:
            self.fastest = (float(speed.max()), int(speed.argmax()))
        self.energies.append((float(data.energy[0]), float(data.energy[1])))
        power = float(_supplied_force(model, data) @ (self._speeds + data.qvel)) / 2
        self.supplied.append(self.supplied[-1] + model.opt.timestep * power)
        self._centres, self._speeds = data.geom_xpos.copy(), data.qvel.copy()


@dataclass
class Examination:
    """A subject, the budget for its examination, and the run that several steps look at."""

    subject: Subject
    budget: Budget

    @cached_property
    def watched(self) -> tuple[Recording, Watcher]:
        """The model as it is, run once and watched.

        Raises:
            RunError: If the run cannot start.
        """
        subject = self.subject
        model = copy.copy(subject.model)
        model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
        watcher = Watcher(model, subject.data, subject.steps)
        return record(subject, model, self.budget.part(0.25), after_step=watcher), watcher

    @cached_property
    def chaos(self) -> float:
        """How far the motion changes with every start velocity changed by NUDGE, as a share of the scene's scale."""

        def nudge(_: mujoco.MjModel, data: mujoco.MjData) -> None:
            data.qvel[:] += NUDGE

        run = self.watched[0]
        again = record(self.subject, self.subject.model, self.budget.part(0.15), nudge=nudge)
        return distance(run, again) / scale(self.subject, run)


def unmatched_pairs(model: mujoco.MjModel) -> Iterator[tuple[int, int]]:
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


def _supplied_force(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Forces of actuators and of gravity compensation, which some joints have among the actuators' already."""
    routed = np.asarray(model.jnt_actgravcomp, dtype=bool)[model.dof_jntid]
    force: Array = data.qfrc_actuator + np.where(routed, 0.0, data.qfrc_gravcomp)
    return force
