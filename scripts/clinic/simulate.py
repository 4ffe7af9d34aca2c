"""A run: a model stepped for a fixed number of steps, its signals read after every step."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

import mujoco
import numpy as np

from clinic.checks import Trace
from clinic.problem import closest, listed
from clinic.record import RunSpec
from clinic.signals import Path, bind, element_names

MAX_STEPS = 2_000_000
Drive = dict[int, tuple[list[float], list[float]]]
_log = threading.Lock()


class RunError(ValueError):
    """A run that cannot start: the field of `run` at fault, what was found, expected, and the repair."""

    def __init__(self, where: tuple[str, ...], found: str, expected: str, repair: str) -> None:
        self.where, self.found, self.expected, self.repair = where, found, expected, repair
        super().__init__(f"{'.'.join(where)}: {found}; expected {expected}; {repair}")


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


def compile_model(xml: str) -> mujoco.MjModel:
    """The compiled model.

    Raises:
        ValueError: With MuJoCo's message, if the XML does not compile.
    """
    with captured_messages():
        return mujoco.MjModel.from_xml_string(xml)


def start(model: mujoco.MjModel, spec: RunSpec, offsets: Mapping[int, float] | None = None) -> mujoco.MjData:
    """The data at the run's start: keyframe, then named positions and velocities, then `offsets` by qpos address.

    Raises:
        RunError: If the model lacks a keyframe or joint that the run names.
    """
    data = mujoco.MjData(model)
    if spec.keyframe is not None:
        _require(model, "key", spec.keyframe, ("keyframe",))
        mujoco.mj_resetDataKeyframe(model, data, model.key(spec.keyframe).id)
    for field, values in (("qpos", spec.qpos), ("qvel", spec.qvel)):
        for name, value in values.items():
            _require(model, "joint", name, (field, name))
            target = getattr(data.joint(name), field)
            if len(target) != 1:
                raise RunError((field, name), f"a joint with {len(target)} numbers", "a hinge or slide joint", "use a keyframe")
            target[0] = value
    for address, offset in (offsets or {}).items():
        data.qpos[address] += offset
    return data


def simulate(
    model: mujoco.MjModel, spec: RunSpec, paths: Mapping[str, Path], offsets: Mapping[int, float] | None = None
) -> Run:
    """Steps the model for `spec.duration` and reads every path after each step.

    The loop is bounded by steps, never by `data.time`, which an automatic reset turns back.

    Raises:
        RunError: If the run cannot start or would take more than MAX_STEPS steps.
        SignalError: If a path cannot be bound to the model.
    """
    timestep, steps = model.opt.timestep, step_count(model, spec)
    data = start(model, spec, offsets)
    readers = {name: bind(path, model, data) for name, path in paths.items()}
    drive = controls(model, spec)
    counts = np.zeros(len(data.warning), dtype=int)
    values = np.empty((steps, len(readers)))
    with captured_messages() as messages:
        for i in range(steps):
            step(model, data, drive, i)
            values[i] = [read() for read in readers.values()]
            for k in range(len(counts)):
                counts[k] = max(counts[k], data.warning[k].number)
    time = np.arange(1, steps + 1) * timestep
    return Run(
        timestep=timestep,
        steps=steps,
        traces={name: Trace(time, values[:, k]) for k, name in enumerate(readers)},
        warnings={
            mujoco.mjtWarning(k).name.removeprefix("mjWARN_"): int(n) for k, n in enumerate(counts) if n
        },
        messages=tuple(dict.fromkeys(messages)),
    )


@contextmanager
def captured_messages() -> Iterator[list[str]]:
    """Collects what MuJoCo would print as warnings, and keeps it out of stderr and MUJOCO_LOG.TXT."""
    messages: list[str] = []
    with _log:
        mujoco.set_mju_user_warning(messages.append)
        try:
            yield messages
        finally:
            mujoco.set_mju_user_warning(None)


def step(model: mujoco.MjModel, data: mujoco.MjData, drive: Drive, i: int) -> None:
    """Makes step `i`, counted from 0, with the controls of time i * timestep."""
    for actuator, (times, targets) in drive.items():
        data.ctrl[actuator] = np.interp(i * model.opt.timestep, times, targets)
    mujoco.mj_step(model, data)


def state_at(model: mujoco.MjModel, spec: RunSpec, time: float) -> mujoco.MjData:
    """The data after round(time / timestep) steps of the run, with everything derived from its state up to date."""
    data, drive = start(model, spec), controls(model, spec)
    with captured_messages():
        for i in range(round(time / model.opt.timestep)):
            step(model, data, drive, i)
        mujoco.mj_forward(model, data)
    return data


def step_count(model: mujoco.MjModel, spec: RunSpec) -> int:
    """How many steps the run takes.

    Raises:
        RunError: If that is none, or more than MAX_STEPS.
    """
    timestep = model.opt.timestep
    steps = round(spec.duration / timestep) if timestep > 0 else 0
    if not 1 <= steps <= MAX_STEPS:
        found = f"{spec.duration:g} s at a timestep of {timestep:g} s"
        raise RunError(("duration",), found, f"1 to {MAX_STEPS} steps", "change the duration or the timestep")
    return steps


def controls(model: mujoco.MjModel, spec: RunSpec) -> Drive:
    """The times in s and values of every driven actuator, by its id.

    Raises:
        RunError: If the model lacks an actuator, or the times do not increase.
    """
    drive: Drive = {}
    for name, value in spec.ctrl.items():
        _require(model, "actuator", name, ("ctrl", name))
        points = [(0.0, value)] if isinstance(value, float | int) else value
        times = [time for time, _ in points]
        if not points or any(later <= earlier for earlier, later in zip(times, times[1:], strict=False)):
            raise RunError(("ctrl", name), f"times {times}", "one or more times, each after the one before", "sort them")
        drive[model.actuator(name).id] = (times, [float(target) for _, target in points])
    return drive


def _require(model: mujoco.MjModel, kind: str, name: str, where: tuple[str, ...]) -> None:
    known = element_names(model, kind)
    if name not in known:
        guess = closest(name, known)
        raise RunError(
            where,
            f"the {kind} {name}, which the model does not have",
            f"a {kind}: {listed(known)}",
            f"write {guess}" if guess else "correct the name",
        )


