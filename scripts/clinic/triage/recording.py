"""What triage examines: a model with a start and controls, and recordings of its runs, which end in time."""

from __future__ import annotations

import copy
from collections.abc import Mapping
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
    for kind in range(int(mujoco.mjtWarning.mjNWARNING))
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
            controls(self.model, self.run, 1)(data, 0)
            mujoco.mj_forward(self.model, data)
        return data

    @cached_property
    def watched(self) -> Recording:
        """The run of the model as it is, at which most steps look."""
        return record_run(self, 0.25)

    def called(self, kind: str, index: int) -> str:
        """An element as a report names it: `joint elbow`, or `geom 3 of body torso` without a name."""
        if name := mujoco.mj_id2name(self.model, getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), index):
            return f"{kind} {name}"
        if kind not in BODY_OF:
            return f"{kind} {index}"
        return f"{kind} {index} of {self.called('body', getattr(self.model, BODY_OF[kind])[index])}"


@dataclass
class Recording:
    """What one run showed.

    Attributes:
        planned: How many steps were asked for.
        steps: How many were made before the time or the numbers ended.
        time: What they cover, in s.
        finite: Whether all positions and velocities stayed finite.
        resets: On how many steps time went back.
        warnings: Each MuJoCo warning that was raised, with the first text that MuJoCo printed for it.
        fastest: The largest speed of each degree of freedom, in rad/s or m/s, shape (nv,).
        farthest: The longest way each geom's centre went in one step, in m, shape (ngeom,).
        touching: The pairs of geoms that were in contact.
        energies: At the start of each step potential and kinetic energy, in J, shape (2,).
        supplied: The work done by actuators and gravity compensation up to then, in J.
        qpos: At each sample the joint positions, shape (nq,).
        points: The positions of every body frame, then of every geom's centre, in m, shape (n, 3).
    """

    planned: int
    fastest: Array
    farthest: Array
    steps: int = 0
    time: float = 0.0
    finite: bool = True
    resets: int = 0
    warnings: dict[str, str] = field(default_factory=dict)
    touching: set[tuple[int, ...]] = field(default_factory=set)
    energies: list[Array] = field(default_factory=list)
    supplied: list[float] = field(default_factory=list)
    qpos: list[Array] = field(default_factory=list)
    points: list[Array] = field(default_factory=list)


def record_run(
    subject: Subject, share: float = 1.0, without: tuple[str, ...] = (), finer: int = 1, nudge: float = 0.0
) -> Recording:
    """Runs the subject's model from its start with its controls.

    Args:
        subject: What is run.
        share: Of the wall time left until the subject's end; the run ends when it is used up.
        without: The parts of the physics that are switched off, as MuJoCo's flags name them.
        finer: The timestep is divided by it; samples stay at the same times.
        nudge: Added to every velocity of the start, in rad/s or m/s.

    Raises:
        RunError: If the run cannot start.
    """
    now = perf_counter()
    end = now + share * (subject.end - now)
    m = copy.copy(subject.model)
    m.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    m.opt.disableflags |= flags(*without)
    m.opt.timestep /= finer
    made = Recording(step_count(subject.model, subject.run) * finer, np.zeros(m.nv), np.zeros(m.ngeom))
    stride = max(1, made.planned // finer // SAMPLES) * finer
    compensated = np.asarray(m.jnt_actgravcomp, dtype=bool)[m.dof_jntid]  # against gravity by actuators' forces
    centres, work = subject.data.geom_xpos, 0.0
    with captured_messages() as messages:
        data = initial_data(m, subject.run)
        data.qvel += nudge
        driven = controls(m, subject.run, made.planned)
        while made.steps < made.planned and made.finite and perf_counter() < end:
            time, qvel = data.time, data.qvel.copy()
            step(m, data, driven, made.steps)  # velocities are then those of its end, all else of its start
            made.steps += 1
            made.resets += data.time <= time
            made.touching.update(map(tuple, data.contact.geom.tolist()))
            made.farthest = np.fmax(made.farthest, np.linalg.norm(data.geom_xpos - centres, axis=1))
            centres = data.geom_xpos.copy()
            made.fastest = np.fmax(made.fastest, abs(data.qvel))
            made.energies.append(data.energy.copy())
            made.supplied.append(work)
            force = data.qfrc_actuator + np.where(compensated, 0.0, data.qfrc_gravcomp)
            work += m.opt.timestep * float(force @ (qvel + data.qvel)) / 2
            if made.steps % stride == 0 or made.steps == made.planned:
                made.finite = bool(np.isfinite(data.qpos).all() and np.isfinite(data.qvel).all())
            if made.finite and made.steps % stride == 0:
                mujoco.mj_kinematics(m, data)
                made.qpos.append(data.qpos.copy())
                made.points.append(np.concatenate([data.xpos, data.geom_xpos]))
    made.time = made.steps * m.opt.timestep
    for words, name in WARNINGS.items():
        if said := [message for message in messages if message.startswith(words)]:
            made.warnings[name] = said[0]
    return made


def flags(*parts: str) -> int:
    """The bits of `opt.disableflags` that switch parts of the physics off."""
    return sum(int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{part.upper()}")) for part in parts)


def distance(one: Recording, other: Recording) -> float:
    """The largest distance between the same points of two recordings, in m; infinite where one is not finite."""
    n = min(len(one.points), len(other.points))
    apart = np.linalg.norm(np.subtract(one.points[:n], other.points[:n]), axis=-1)
    return float(np.nan_to_num(apart, nan=np.inf).max(initial=0.0))


def scale(subject: Subject, recording: Recording) -> float:
    """What a change is compared with, in m: the scene's extent, or the longest way a point went if that is more."""
    way = np.linalg.norm(np.subtract(recording.points, recording.points[:1]), axis=-1)
    return max(float(subject.model.stat.extent), float(way[np.isfinite(way)].max(initial=0.0)))
