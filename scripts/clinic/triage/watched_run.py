"""The watched run of triage: the model as it is, with everything recorded that its steps ask for."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np

from clinic.triage.run import Array, Budget, Recording, Subject, distance, record, scale

NUDGE = 1e-9
"""How far every velocity is changed to see whether a motion is chaotic, in rad/s or m/s."""
MOMENTS = 20  # at which overlaps are looked for


class Watcher:
    """Reads what each step of a run shows.

    Attributes:
        touching: The pairs of geoms seen in contact.
        farthest: The longest way each geom's centre went in one step, in m, shape (ngeom,).
        fastest: The largest speed of a degree of freedom, in rad/s or m/s, and its index.
        energies: Potential and kinetic energy at the start of each step, in J.
        supplied: The work done by actuators and gravity compensation up to the start of each step, in J.
        overlaps: From when on, in s, geoms overlapped that have contact masks which do not match.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, steps: int) -> None:
        self.touching: set[tuple[int, ...]] = set()
        self.farthest = np.zeros(model.ngeom)
        self.fastest = (0.0, 0)
        self.energies: list[tuple[float, float]] = []
        self.supplied = [0.0]
        self.overlaps: dict[tuple[int, ...], float] = {}
        self._meeting = copy.copy(model)
        for kind in ("body", "geom"):  # MuJoCo asks those of bodies first
            masks = [getattr(self._meeting, f"{kind}_{name}") for name in ("contype", "conaffinity")]
            masks[0][:] = masks[1][:] = (masks[0] | masks[1]) != 0
        self._met = mujoco.MjData(self._meeting)
        self._every = max(1, steps // MOMENTS)
        self._qpos, self._qvel, self._centres = data.qpos.copy(), data.qvel.copy(), data.geom_xpos.copy()

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Reads the data after a step; positions, forces and energies are those of the step's start."""
        made = len(self.energies)
        self.touching.update(map(tuple, data.contact.geom.tolist()))
        if made % self._every == 0:
            self._find_overlaps(made * model.opt.timestep)
        np.fmax(self.farthest, np.linalg.norm(data.geom_xpos - self._centres, axis=1), out=self.farthest)
        speed = np.nan_to_num(np.abs(data.qvel))
        if speed.max(initial=0.0) > self.fastest[0]:
            self.fastest = (float(speed.max()), int(speed.argmax()))
        self.energies.append((float(data.energy[0]), float(data.energy[1])))
        power = float(_supplied_force(model, data) @ (self._qvel + data.qvel)) / 2
        self.supplied.append(self.supplied[-1] + model.opt.timestep * power)
        self._qpos, self._qvel, self._centres = data.qpos.copy(), data.qvel.copy(), data.geom_xpos.copy()

    def _find_overlaps(self, time: float) -> None:
        """Finds what would touch if all masks matched; MuJoCo itself leaves out parent and child, welded, excluded."""
        self._met.qpos[:] = self._qpos
        mujoco.mj_fwdPosition(self._meeting, self._met)
        for pair, dist in zip(map(tuple, self._met.contact.geom.tolist()), self._met.contact.dist, strict=True):
            if dist < 0 and pair not in self.touching and min(pair) >= 0:
                self.overlaps.setdefault(pair, time)


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


def _supplied_force(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Forces of actuators and of gravity compensation, which some joints have among the actuators' already."""
    routed = np.asarray(model.jnt_actgravcomp, dtype=bool)[model.dof_jntid]
    force: Array = data.qfrc_actuator + np.where(routed, 0.0, data.qfrc_gravcomp)
    return force
