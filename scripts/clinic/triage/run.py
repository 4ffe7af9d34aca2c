"""What triage runs: a model with a start and controls, and recordings of it under a budget of time."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.engine.simulate import captured_messages, controls, initial_data, step, step_count
from clinic.record.fields import RunSpec

Array = NDArray[np.float64]
AfterStep = Callable[[mujoco.MjModel, mujoco.MjData], None]
SAMPLES = 100  # of a recording
BODY_OF = {"geom": "geom_bodyid", "joint": "jnt_bodyid", "camera": "cam_bodyid"}


class Budget:
    """Seconds of wall time that work may take; without a number, as long as it takes."""

    def __init__(self, seconds: float = np.inf, clock: Callable[[], float] = time.perf_counter) -> None:
        self._clock = clock
        self._end = clock() + seconds

    @property
    def left(self) -> float:
        """Seconds left, 0 when they are used up."""
        return max(0.0, self._end - self._clock())

    def part(self, share: float) -> Budget:
        """A budget of a share of what is left."""
        return Budget(share * self.left, self._clock)


@dataclass(frozen=True)
class Subject:
    """What is examined.

    Args:
        spec: The model before compilation, as it was read.
        model: The model, compiled.
        run: How it is started and driven, and for how long.
        notes: What the compiler warned of.
        given: How many positions each keyframe gives in the file; the compiled model has them all.
    """

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
        if name := mujoco.mj_id2name(self.model, getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), index):
            return f"{kind} {name}"
        if kind not in BODY_OF:
            return f"{kind} {index}"
        return f"{kind} {index} of {self.called('body', getattr(self.model, BODY_OF[kind])[index])}"


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
        resets: On how many steps time went back.
        finite: Whether all positions and velocities stayed finite.
    """

    timestep: float
    planned: int
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


def record(
    subject: Subject,
    model: mujoco.MjModel,
    budget: Budget,
    finer: int = 1,
    after_step: AfterStep | None = None,
    nudge: AfterStep | None = None,
) -> Recording:
    """Runs `model`, a changed copy of the subject's, from the subject's start with its controls.

    Args:
        subject: Gives the start, the controls and the duration.
        model: What is run.
        budget: The run ends when it is used up.
        finer: The model's timestep is this many times smaller than the subject's; samples stay at the same times.
        after_step: Called after every step.
        nudge: Changes the start.
    """
    stride = max(1, subject.steps // SAMPLES) * finer
    made = Recording(model.opt.timestep, subject.steps * finer)
    points = []
    counts = np.zeros(mujoco.mjtWarning.mjNWARNING, dtype=int)
    with captured_messages() as messages:
        data = initial_data(model, subject.run, nudge)
        driven = controls(model, subject.run, made.planned)
        while made.steps < made.planned and made.finite and budget.left > 0:
            before = data.time
            step(model, data, driven, made.steps)
            made.steps += 1
            made.resets += data.time <= before
            if after_step is not None:
                after_step(model, data)
            if messages:
                np.maximum(counts, data.warning.number, out=counts)
            if made.steps % stride == 0 or made.steps == made.planned:
                made.finite = bool(np.isfinite(data.qpos).all() and np.isfinite(data.qvel).all())
            if made.finite and made.steps % stride == 0:
                mujoco.mj_kinematics(model, data)
                points.append(np.concatenate([data.xpos, data.geom_xpos]))
    made.warnings = {mujoco.mjtWarning(k).name.removeprefix("mjWARN_"): int(n) for k, n in enumerate(counts) if n}
    made.messages = tuple(dict.fromkeys(messages))
    made.points = np.array(points).reshape(len(points), model.nbody + model.ngeom, 3)
    return made


def distance(one: Recording, other: Recording) -> float:
    """The largest distance between the same points of two recordings, in m; infinite where one is not finite."""
    n = min(len(one.points), len(other.points))
    apart = np.linalg.norm(one.points[:n] - other.points[:n], axis=2)
    return float(np.nan_to_num(apart, nan=np.inf).max(initial=0.0))


def scale(subject: Subject, recording: Recording) -> float:
    """What a change is compared with, in m: the scene's extent, or the longest way a point went if that is more."""
    way = np.linalg.norm(recording.points - recording.points[:1], axis=2)
    return max(float(subject.model.stat.extent), float(way[np.isfinite(way)].max(initial=0.0)))
