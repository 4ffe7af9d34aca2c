"""The watched run of triage: the model as it is, with everything recorded that its steps ask for."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from functools import cached_property
from time import perf_counter

import mujoco
import numpy as np

from clinic.engine.simulate import step_count
from clinic.triage.run import Recording, Subject, record

MOMENTS = 20  # at which overlaps are looked for


class Watcher:
    """Reads what each step of a subject's run shows.

    Attributes:
        touching: The pairs of geoms seen in contact.
        farthest: The longest way each geom's centre went in one step, in m, shape (ngeom,).
        fastest: The largest speed of a degree of freedom, in rad/s or m/s, and its index.
        supplied: The work done by actuators and gravity compensation up to the start of each step, in J.
        overlaps: From when on, in s, geoms overlapped that have contact masks which do not match.
    """

    def __init__(self, subject: Subject) -> None:
        self.touching: set[tuple[int, ...]] = set()
        self.farthest = np.zeros(subject.model.ngeom)
        self.fastest = (0.0, 0)
        self.supplied = [0.0]
        self.overlaps: dict[tuple[int, ...], float] = {}
        self._meeting = copy.copy(subject.model)
        for kind in ("body", "geom"):  # MuJoCo asks those of bodies first
            masks = [getattr(self._meeting, f"{kind}_{name}") for name in ("contype", "conaffinity")]
            masks[0][:] = masks[1][:] = (masks[0] | masks[1]) != 0
        self._met = mujoco.MjData(self._meeting)
        self._every = max(1, step_count(subject.model, subject.run) // MOMENTS)
        self._remember(subject.data)

    def __call__(self, data: mujoco.MjData) -> None:
        """Reads the data after a step; positions and forces are those of the step's start."""
        m, made = self._meeting, len(self.supplied) - 1
        self.touching.update(map(tuple, data.contact.geom.tolist()))
        if made % self._every == 0:
            self._find_overlaps(made * m.opt.timestep)
        np.fmax(self.farthest, np.linalg.norm(data.geom_xpos - self._centres, axis=1), out=self.farthest)
        speed = np.nan_to_num(np.abs(data.qvel))
        if speed.max(initial=0.0) > self.fastest[0]:
            self.fastest = (float(speed.max()), int(speed.argmax()))
        compensated = np.asarray(m.jnt_actgravcomp, dtype=bool)[m.dof_jntid]  # by what is among the actuators' forces
        force = data.qfrc_actuator + np.where(compensated, 0.0, data.qfrc_gravcomp)
        self.supplied.append(self.supplied[-1] + m.opt.timestep * float(force @ (self._qvel + data.qvel)) / 2)
        self._remember(data)

    def _remember(self, data: mujoco.MjData) -> None:
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
    """A subject, the moment of `perf_counter` at which its examination ends, and the run that most steps look at."""

    subject: Subject
    end: float = np.inf

    @property
    def left(self) -> float:
        """Seconds left, 0 when they are used up."""
        return max(0.0, self.end - perf_counter())

    @cached_property
    def watched(self) -> tuple[Recording, Watcher]:
        """The model as it is, run once and watched.

        Raises:
            RunError: If the run cannot start.
        """
        watcher = Watcher(self.subject)
        return record(self.subject, 0.25 * self.left, watcher=watcher), watcher
