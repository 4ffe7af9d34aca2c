"""What triage runs: a model with a start and controls, and recordings of it under a budget of time."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.engine.simulate import Controls, captured_messages, controls, initial_data, step, step_count
from clinic.record.fields import RunSpec

Array = NDArray[np.float64]
SAMPLES = 100
KINDS = {
    "body": (mujoco.mjtObj.mjOBJ_BODY, "nbody"),
    "joint": (mujoco.mjtObj.mjOBJ_JOINT, "njnt"),
    "geom": (mujoco.mjtObj.mjOBJ_GEOM, "ngeom"),
    "camera": (mujoco.mjtObj.mjOBJ_CAMERA, "ncam"),
    "actuator": (mujoco.mjtObj.mjOBJ_ACTUATOR, "nu"),
    "tendon": (mujoco.mjtObj.mjOBJ_TENDON, "ntendon"),
    "key": (mujoco.mjtObj.mjOBJ_KEY, "nkey"),
}


class Budget:
    """Seconds of wall time that work may take; without a number, as long as it takes."""

    def __init__(self, seconds: float | None = None, clock: Callable[[], float] = time.perf_counter) -> None:
        self._clock = clock
        self._end = None if seconds is None else clock() + seconds

    @property
    def left(self) -> float:
        """Seconds left, 0 when they are used up."""
        return np.inf if self._end is None else max(0.0, self._end - self._clock())

    def part(self, share: float) -> Budget:
        """A budget of a share of what is left."""
        return Budget(None if self._end is None else share * self.left, self._clock)


@dataclass(frozen=True)
class Subject:
    """What is examined.

    Args:
        name: How the report calls it.
        spec: The model before compilation, as it was read.
        model: The model, compiled.
        run: How it is started and driven, and for how long.
        notes: What the compiler warned of.
        given: How many positions each keyframe gives in the file; the compiled model has them all.
    """

    name: str
    spec: mujoco.MjSpec
    model: mujoco.MjModel
    run: RunSpec
    notes: tuple[str, ...] = ()
    given: Mapping[str, int] = field(default_factory=dict)

    @cached_property
    def data(self) -> mujoco.MjData:
        """The start of the run, with everything derived from it."""
        with captured_messages():
            data = initial_data(self.model, self.run)
            controls(self.model, self.run, 1).apply(data, 0)
            mujoco.mj_forward(self.model, data)
        return data

    @cached_property
    def steps(self) -> int:
        """How many steps the run takes.

        Raises:
            RunError: If there are none, or too many.
        """
        return step_count(self.model, self.run)

    def called(self, kind: str, index: int) -> str:
        """An element as a report names it: `joint elbow`, or `geom 3 of body torso` without a name."""
        name = mujoco.mj_id2name(self.model, KINDS[kind][0], index)
        if name:
            return f"{kind} {name}"
        owner = {"geom": "geom_bodyid", "joint": "jnt_bodyid", "camera": "cam_bodyid"}.get(kind)
        if owner is None:
            return f"{kind} {index}"
        return f"{kind} {index} of {self.called('body', getattr(self.model, owner)[index])}"


@dataclass
class Recording:
    """What one run showed.

    Attributes:
        timestep: In s.
        planned: How many steps were asked for.
        steps: How many were made before the budget or the numbers ended.
        points: Positions of every body frame, then of every geom's centre, in m, shape (samples, n, 3).
        warnings: The largest count of each MuJoCo warning.
        messages: The distinct texts that MuJoCo printed.
        resets: On how many steps time went back; counted in a thorough recording alone.
    """

    timestep: float
    planned: int
    stride: int
    steps: int = 0
    points: Array = field(default_factory=lambda: np.empty((0, 0, 3)))
    warnings: dict[str, int] = field(default_factory=dict)
    messages: tuple[str, ...] = ()
    resets: int = 0
    finite: bool = True

    @property
    def time(self) -> float:
        """Simulated time covered, in s."""
        return self.steps * self.timestep

    @property
    def whole(self) -> bool:
        """Whether every planned step was made."""
        return self.steps == self.planned


Watch = Callable[[mujoco.MjModel, mujoco.MjData], None]


def record(
    subject: Subject,
    model: mujoco.MjModel,
    budget: Budget,
    finer: int = 1,
    watch: Watch | None = None,
    nudge: Watch | None = None,
) -> Recording:
    """Runs `model`, a changed copy of the subject's, from the subject's start with its controls.

    Args:
        finer: The model's timestep is this many times smaller than the subject's; samples stay at the same times.
        watch: Called after every step.
        nudge: Changes the start.
    """
    stride = max(1, subject.steps // SAMPLES)
    made = Recording(model.opt.timestep, subject.steps * finer, stride)
    points = []
    counts = np.zeros(mujoco.mjtWarning.mjNWARNING, dtype=int)
    with captured_messages() as messages:
        data = initial_data(model, subject.run, nudge)
        drive = controls(model, subject.run, made.planned)
        together = 1
        while made.steps < made.planned and made.finite and budget.left > 0:
            ahead = stride * finer - made.steps % (stride * finer)
            end = made.steps + min(together, ahead, made.planned - made.steps)
            before = data.time
            if watch is None:
                _advance(model, data, drive, made.steps, end)
                together *= 2
            else:
                step(model, data, drive, made.steps)
                watch(model, data)
            made.steps = end
            made.resets += data.time <= before
            np.maximum(counts, data.warning.number, out=counts)
            made.finite = bool(np.isfinite(data.qpos).all() and np.isfinite(data.qvel).all())
            if made.finite and made.steps % (stride * finer) == 0:
                mujoco.mj_kinematics(model, data)
                points.append(np.concatenate([data.xpos, data.geom_xpos]))
    made.warnings = {mujoco.mjtWarning(k).name.removeprefix("mjWARN_"): int(n) for k, n in enumerate(counts) if n}
    made.messages = tuple(dict.fromkeys(messages))
    made.points = np.array(points).reshape(len(points), model.nbody + model.ngeom, 3)
    return made


def apart(one: Recording, other: Recording) -> Array:
    """How far the points of two recordings are apart, in m, shape (samples that both have, n)."""
    n = min(len(one.points), len(other.points))
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(np.linalg.norm(one.points[:n] - other.points[:n], axis=2))


def gap(one: Recording, other: Recording) -> float:
    """The largest distance between two recordings, in m; infinite where a number is no longer finite."""
    return float(np.nan_to_num(apart(one, other), nan=np.inf).max(initial=0.0))


def scale(subject: Subject, recording: Recording) -> float:
    """What a change is compared with, in m: the scene's extent, or the longest way a point went if that is more."""
    with np.errstate(over="ignore", invalid="ignore"):
        way = np.linalg.norm(recording.points - recording.points[:1], axis=2) if recording.points.size else np.zeros(1)
    way = way[np.isfinite(way)]
    return max(float(subject.model.stat.extent), float(way.max(initial=0.0)))


def _advance(model: mujoco.MjModel, data: mujoco.MjData, drive: Controls, begin: int, end: int) -> None:
    """Makes the steps from `begin` to `end`, together where the controls do not change."""
    values = drive.values[begin:end]
    if bool(np.all(values == values[0])):
        drive.apply(data, begin)
        mujoco.mj_step(model, data, end - begin)
        return
    for i in range(begin, end):
        step(model, data, drive, i)
