"""A run: a model stepped for a fixed number of steps, its signals read after every step."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from time import process_time

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.engine.checks import Trace
from clinic.engine.mjcf import check_text
from clinic.engine.signals import Path, bind, element_names
from clinic.record.fields import RunSpec
from clinic.record.problem import article, closest, listed

MAX_STEPS = 2_000_000
MOST_SECONDS = 30.0  # of the processor
Nudge = Callable[[mujoco.MjModel, mujoco.MjData], None]
_log = threading.Lock()


class RunError(ValueError):
    """A run that cannot start: the field of `run` at fault, what was found, expected, and the repair."""

    def __init__(self, where: tuple[str, ...], found: str, expected: str, repair: str) -> None:
        self.where, self.found, self.expected, self.repair = where, found, expected, repair
        super().__init__(where, found, expected, repair)

    def __str__(self) -> str:
        return f"{'.'.join(self.where)}: {self.found}; expected {self.expected}; {self.repair}"


@dataclass(frozen=True)
class Run:
    """What a simulation showed.

    Args:
        timestep: Seconds of simulated time a step.
        steps: How many steps were made.
        traces: Every path signal, sampled after each step at time (i + 1) * timestep.
        warnings: The largest count that each MuJoCo warning reached; those never raised are left out.
        messages: The distinct texts that MuJoCo printed, in order.
    """

    timestep: float
    steps: int
    traces: dict[str, Trace]
    warnings: dict[str, int]
    messages: tuple[str, ...]


@dataclass(frozen=True)
class Drive:
    """The controls of a run: `values`, shape (steps, n), for the n actuators with ids `actuators`, shape (n,)."""

    actuators: NDArray[np.int64]
    values: NDArray[np.float64]

    def changes(self, steps: int) -> list[bool]:
        """Whether a step has other controls than the one before, or is the first."""
        if not len(self.actuators):
            return [False] * steps
        return [True, *(self.values[1:] != self.values[:-1]).any(axis=1).tolist()]


def compile_model(xml: str) -> mujoco.MjModel:
    """The compiled model.

    Raises:
        ModelError: If the text is not XML, or names a file.
        ValueError: With MuJoCo's message, if the XML does not compile.
    """
    check_text(xml)
    with captured_messages():
        return mujoco.MjModel.from_xml_string(xml)


def start(
    model: mujoco.MjModel, spec: RunSpec, nudge: Nudge | None = None, data: mujoco.MjData | None = None
) -> mujoco.MjData:
    """The data at the run's start: keyframe, then named positions and velocities, then `nudge` applied to them.

    Args:
        data: Of the same model, to be reset and used: a new one takes as long as 300 steps of a small model.

    Raises:
        RunError: If the model lacks a keyframe or joint that the run names.
    """
    if data is None:
        data = mujoco.MjData(model)
    else:
        mujoco.mj_resetData(model, data)
    if spec.keyframe is not None:
        _require(model, "key", spec.keyframe, ("keyframe",))
        mujoco.mj_resetDataKeyframe(model, data, model.key(spec.keyframe).id)
    for field, values in (("qpos", spec.qpos), ("qvel", spec.qvel)):
        for name, value in values.items():
            _require(model, "joint", name, (field, name))
            target = getattr(data.joint(name), field)
            if len(target) != 1:
                raise RunError(
                    (field, name), f"a joint with {len(target)} numbers", "a hinge or slide joint", "use a keyframe"
                )
            target[0] = value
    if nudge is not None:
        nudge(model, data)
    return data


def simulate(
    model: mujoco.MjModel,
    spec: RunSpec,
    paths: Mapping[str, Path],
    nudge: Nudge | None = None,
    data: mujoco.MjData | None = None,
    last: bool = False,
) -> Run:
    """Steps the model for `spec.duration` and reads every path after each step.

    The loop is bounded by steps, never by `data.time`, which an automatic reset turns back.

    Args:
        data: As `start` takes it.
        last: Reads every path after the last step alone.

    Raises:
        RunError: If the run cannot start, or takes more than MAX_STEPS steps or MOST_SECONDS.
        SignalError: If a path cannot be bound to the model.
    """
    timestep, steps = model.opt.timestep, step_count(model, spec)
    data = start(model, spec, nudge, data)
    readers = {name: bind(path, model, data) for name, path in paths.items()}
    moving = [name for name in readers if not paths[name].model]
    reading = [readers[name] for name in moving]
    drive = controls(model, spec, steps)
    steered = drive.changes(steps)
    counts = np.zeros(len(data.warning), dtype=int)
    rows, made = [], 0
    with captured_messages() as messages:
        if last and steps > 1 and not any(steered[1:]):
            step(model, data, drive, 0)
            mujoco.mj_step(model, data, nstep=steps - 2)
            made = steps - 1
            if messages:  # then every step matters
                start(model, spec, nudge, data)
                messages.clear()
                made = 0
        begun = process_time()
        for i in range(made, steps):
            if (not i & i - 1 or not i % 64) and process_time() - begun > MOST_SECONDS:
                found, expected = f"{steps} steps, of which {i} take {MOST_SECONDS:g} s", "a run that comes to an end"
                raise RunError(("duration",), found, expected, "make the model smaller, or the run shorter")
            if steered[i] or messages:  # an automatic reset undoes controls too
                step(model, data, drive, i)
            else:
                mujoco.mj_step(model, data)
            if not last or i == steps - 1:
                rows.append([read() for read in reading])
            if messages:  # a type's first warning is printed, also after a reset: until then nothing is counted
                np.maximum(counts, data.warning.number, out=counts)
    values = dict(zip(moving, np.array(rows, dtype=float).reshape(len(rows), len(moving)).T, strict=True))
    moments = np.arange(steps + 1 - len(rows), steps + 1) * timestep
    return Run(
        timestep=timestep,
        steps=steps,
        traces={
            name: Trace(moments, values[name] if name in values else np.full(len(rows), readers[name]()))
            for name in paths
        },
        warnings={mujoco.mjtWarning(k).name.removeprefix("mjWARN_"): int(n) for k, n in enumerate(counts) if n},
        messages=tuple(dict.fromkeys(messages)),
    )


def aside(text: str) -> None:
    """Prints what MuJoCo says while nobody listens; without this it adds to MUJOCO_LOG.TXT in the working directory."""
    print(f"WARNING: {text}", file=sys.stderr)


@contextmanager
def captured_messages() -> Iterator[list[str]]:
    """Collects what MuJoCo would print as warnings, and keeps it out of stderr and MUJOCO_LOG.TXT."""
    messages: list[str] = []
    with _log:
        mujoco.set_mju_user_warning(messages.append)
        try:
            yield messages
        finally:
            mujoco.set_mju_user_warning(aside)


def step(model: mujoco.MjModel, data: mujoco.MjData, drive: Drive, i: int) -> None:
    """Makes step `i`, counted from 0, with the controls of time i * timestep."""
    if len(drive.actuators):
        data.ctrl[drive.actuators] = drive.values[i]
    mujoco.mj_step(model, data)


def state_at(model: mujoco.MjModel, spec: RunSpec, time: float) -> mujoco.MjData:
    """The data after round(time / timestep) steps of the run, with everything derived from its state up to date."""
    steps = round(time / model.opt.timestep)
    data, drive = start(model, spec), controls(model, spec, steps)
    with captured_messages():
        for i in range(steps):
            step(model, data, drive, i)
        mujoco.mj_forward(model, data)
    return data


def step_count(model: mujoco.MjModel, spec: RunSpec) -> int:
    """How many steps the run takes.

    Raises:
        RunError: If that is none, or more than MAX_STEPS.
    """
    timestep = model.opt.timestep
    steps = round(min(spec.duration / timestep, MAX_STEPS + 1)) if timestep > 0 else 0
    if not 1 <= steps <= MAX_STEPS:
        found = f"{spec.duration:g} s at a timestep of {timestep:g} s"
        raise RunError(("duration",), found, f"1 to {MAX_STEPS} steps", "change the duration or the timestep")
    return steps


def controls(model: mujoco.MjModel, spec: RunSpec, steps: int) -> Drive:
    """The controls of every driven actuator at the start of each step.

    Raises:
        RunError: If the model lacks an actuator, or the times of a schedule do not increase.
    """
    moments = np.arange(steps) * model.opt.timestep
    actuators, columns = [], []
    for name, value in spec.ctrl.items():
        _require(model, "actuator", name, ("ctrl", name))
        points = [(0.0, value)] if isinstance(value, float | int) else value
        times = [time for time, _ in points]
        if not points or any(later <= earlier for earlier, later in pairwise(times)):
            raise RunError(
                ("ctrl", name), f"times {times}", "one or more times, each after the one before", "sort them"
            )
        actuators.append(model.actuator(name).id)
        columns.append(np.interp(moments, times, [target for _, target in points]))
    return Drive(np.array(actuators, dtype=np.int64), np.array(columns).T)


def _require(model: mujoco.MjModel, kind: str, name: str, where: tuple[str, ...]) -> None:
    known = element_names(model, kind)
    if name not in known:
        guess = closest(name, known)
        raise RunError(
            where,
            f"the {kind} {name}, which the model does not have",
            f"{article(kind)}: {listed(known)}",
            f"write {guess}" if guess else "correct the name",
        )


mujoco.set_mju_user_warning(aside)
