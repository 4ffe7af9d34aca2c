"""What triage examines: a model with a start and controls, and recordings of its runs, which end in time."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from time import perf_counter

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.engine.simulate import captured_messages, controls, initial_data, step, step_count
from clinic.record.fields import RunSpec

Array = NDArray[np.float64]
SAMPLES = 100  # of a recording
WARNINGS = {
    mujoco.mju_warningText(kind, 7).partition("7")[0]: mujoco.mjtWarning(kind).name.removeprefix("mjWARN_")
    for kind in range(mujoco.mjtWarning.mjNWARNING)
}
"""How the text of each kind of warning begins, with its name; MuJoCo prints it when it begins to count the kind."""
BODY_OF = {"geom": "geom_bodyid", "joint": "jnt_bodyid", "camera": "cam_bodyid"}


@dataclass(frozen=True)
class Subject:
    """What is examined.

    Args:
        spec: The model before compilation, as it was read.
        model: The model, compiled.
        run: How it is started and driven, and for how long.
        notes: What the compiler warned of.
        given: How many positions each keyframe gives in the file; the compiled model has them all.
        end: When its examination ends, as `perf_counter` tells it.
    """

    spec: mujoco.MjSpec
    model: mujoco.MjModel
    run: RunSpec
    notes: tuple[str, ...] = ()
    given: Mapping[str, int] = field(default_factory=dict)
    end: float = np.inf

    @cached_property
    def data(self) -> mujoco.MjData:
        """The start of the run, with everything derived from it."""
        with captured_messages():
            data = initial_data(self.model, self.run)
            controls(self.model, self.run, 1).apply(data, 0)
            mujoco.mj_forward(self.model, data)
        return data

    @cached_property
    def watched(self) -> tuple[Recording, Watcher]:
        """The model as it is, run once and watched: what most steps look at.

        Raises:
            RunError: If the run cannot start.
        """
        watcher = Watcher(self)
        return record(self, 0.25, watcher=watcher), watcher

    def called(self, kind: str, index: int) -> str:
        """An element as a report names it: `joint elbow`, or `geom 3 of body torso` without a name."""
        if name := mujoco.mj_id2name(self.model, getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), index):
            return f"{kind} {name}"
        if kind not in BODY_OF:
            return f"{kind} {index}"
        return f"{kind} {index} of {self.called('body', getattr(self.model, BODY_OF[kind])[index])}"


class Watcher:
    """Reads what each step of a subject's run shows.

    Attributes:
        touching: The pairs of geoms seen in contact.
        farthest: The longest way each geom's centre went in one step, in m, shape (ngeom,).
        fastest: The largest speed of a degree of freedom, in rad/s or m/s, and its index.
        supplied: The work done by actuators and gravity compensation up to the start of each step, in J.
    """

    def __init__(self, subject: Subject) -> None:
        m = self._model = subject.model
        self.touching: set[tuple[int, ...]] = set()
        self.farthest = np.zeros(m.ngeom)
        self.fastest = (0.0, 0)
        self.supplied = [0.0]
        self._in_actuators = np.asarray(m.jnt_actgravcomp, dtype=bool)[m.dof_jntid]  # where gravity compensation is
        self._qvel, self._centres = subject.data.qvel.copy(), subject.data.geom_xpos.copy()

    def __call__(self, data: mujoco.MjData) -> None:
        """Reads the data after a step; positions and forces are those of the step's start."""
        self.touching.update(map(tuple, data.contact.geom.tolist()))
        np.fmax(self.farthest, np.linalg.norm(data.geom_xpos - self._centres, axis=1), out=self.farthest)
        speed = np.nan_to_num(np.abs(data.qvel))
        if speed.max(initial=0.0) > self.fastest[0]:
            self.fastest = (float(speed.max()), int(speed.argmax()))
        force = data.qfrc_actuator + np.where(self._in_actuators, 0.0, data.qfrc_gravcomp)
        work = self._model.opt.timestep * float(force @ (self._qvel + data.qvel)) / 2
        self.supplied.append(self.supplied[-1] + work)
        self._qvel, self._centres = data.qvel.copy(), data.geom_xpos.copy()


@dataclass(frozen=True)
class Recording:
    """What one run showed.

    Attributes:
        planned: How many steps were asked for.
        steps: How many were made before the time or the numbers ended.
        time: What they cover, in s.
        qpos: The joint positions at each sample, shape (nq,).
        points: Positions of every body frame, then of every geom's centre, in m, shape (samples, n, 3).
        energies: Potential and kinetic energy at the start of each step, in J, shape (steps, 2).
        warnings: Each MuJoCo warning that was raised, with the first text that MuJoCo printed for it.
        resets: On how many steps time went back.
        finite: Whether all positions and velocities stayed finite.
    """

    planned: int
    steps: int
    time: float
    qpos: list[Array]
    points: Array
    energies: Array
    warnings: dict[str, str]
    resets: int
    finite: bool


def record(
    subject: Subject,
    share: float = 1.0,
    without: tuple[str, ...] = (),
    finer: int = 1,
    nudge: float = 0.0,
    watcher: Callable[[mujoco.MjData], None] | None = None,
) -> Recording:
    """Runs the subject's model from its start with its controls.

    Args:
        subject: What is run.
        share: Of the wall time left until the subject's end; the run ends when it is used up.
        without: The parts of the physics that are switched off, as MuJoCo's flags name them.
        finer: The timestep is divided by it; samples stay at the same times.
        nudge: Added to every velocity of the start, in rad/s or m/s.
        watcher: Called with the data after every step.
    """
    now = perf_counter()
    end = now + share * (subject.end - now)
    model = copy.copy(subject.model)
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    model.opt.disableflags |= flags(*without)
    model.opt.timestep /= finer
    planned = step_count(subject.model, subject.run) * finer
    stride = max(1, planned // finer // SAMPLES) * finer
    steps, resets, finite = 0, 0, True
    qpos, points, energies = [], [], []
    with captured_messages() as messages:
        data = initial_data(model, subject.run)
        data.qvel += nudge
        driven = controls(model, subject.run, planned)
        while steps < planned and finite and perf_counter() < end:
            before = data.time
            step(model, data, driven, steps)
            steps += 1
            resets += data.time <= before
            energies.append(data.energy.copy())
            if watcher is not None:
                watcher(data)
            if steps % stride == 0 or steps == planned:
                finite = bool(np.isfinite(data.qpos).all() and np.isfinite(data.qvel).all())
            if finite and steps % stride == 0:
                mujoco.mj_kinematics(model, data)
                qpos.append(data.qpos.copy())
                points.append(np.concatenate([data.xpos, data.geom_xpos]))
    return Recording(
        planned=planned,
        steps=steps,
        time=steps * model.opt.timestep,
        qpos=qpos,
        points=np.array(points).reshape(-1, model.nbody + model.ngeom, 3),
        energies=np.array(energies).reshape(-1, 2),
        warnings={name: said[0] for k, name in WARNINGS.items() if (said := [m for m in messages if m.startswith(k)])},
        resets=resets,
        finite=finite,
    )


def flags(*parts: str) -> int:
    """The bits of `opt.disableflags` that switch parts of the physics off."""
    return sum(int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{part.upper()}")) for part in parts)


def distance(one: Recording, other: Recording) -> float:
    """The largest distance between the same points of two recordings, in m; infinite where one is not finite."""
    n = min(len(one.points), len(other.points))
    apart = np.linalg.norm(one.points[:n] - other.points[:n], axis=2)
    return float(np.nan_to_num(apart, nan=np.inf).max(initial=0.0))


def scale(subject: Subject, recording: Recording) -> float:
    """What a change is compared with, in m: the scene's extent, or the longest way a point went if that is more."""
    way = np.linalg.norm(recording.points - recording.points[:1], axis=2)
    return max(float(subject.model.stat.extent), float(way[np.isfinite(way)].max(initial=0.0)))
