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
from clinic.engine.signals import Path, bind, missing_element
from clinic.record.fields import RunSpec
from clinic.record.yaml_lines import Where

MAX_STEPS = 2_000_000
MAX_SECONDS = 30.0  # of the processor
Nudge = Callable[[mujoco.MjModel, mujoco.MjData], None]
_log = threading.Lock()


@dataclass(eq=False)
class RunError(ValueError):
    """A run that the record asks for and the model cannot give: the field at fault, found, expected, and the repair."""

    where: Where
    found: str
    expected: str
    repair: str

    def __str__(self) -> str:
        return f"{'.'.join(map(str, self.where))}: {self.found}; expected {self.expected}; {self.repair}"


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
class Controls:
    """The controls of a run: `values`, shape (steps, n), for the n actuators with ids `actuators`, shape (n,)."""

    actuators: NDArray[np.int64]
    values: NDArray[np.float64]

    def apply(self, data: mujoco.MjData, i: int) -> None:
        """Writes the controls of step `i`, counted from 0, into `data`."""
        data.ctrl[self.actuators] = self.values[i]


def compile_model(xml: str) -> mujoco.MjModel:
    """Compiles a text that names no other file.

    Raises:
        ModelError: If the text is not XML, or names a file.
        ValueError: With MuJoCo's message, if the XML does not compile.
    """
    check_text(xml)
    with captured_messages():
        return mujoco.MjModel.from_xml_string(xml)


def initial_data(model: mujoco.MjModel, spec: RunSpec, nudge: Nudge | None = None) -> mujoco.MjData:
    """The data at the run's start: keyframe, then named positions and velocities, then `nudge` applied to them.

    Raises:
        RunError: If the model lacks a keyframe or joint that the run names.
    """
    data = mujoco.MjData(model)
    if spec.keyframe is not None:
        _require(model, "key", spec.keyframe, "keyframe")
        mujoco.mj_resetDataKeyframe(model, data, model.key(spec.keyframe).id)
    for field, values in (("qpos", spec.qpos), ("qvel", spec.qvel)):
        for name, value in values.items():
            _require(model, "joint", name, field, name)
            target = getattr(data.joint(name), field)
            if len(target) != 1:
                found, expected = f"a joint with {len(target)} numbers", "a hinge or slide joint"
                raise RunError(("run", field, name), found, expected, "use a keyframe")
            target[0] = value
    if nudge is not None:
        nudge(model, data)
    return data


def simulate(model: mujoco.MjModel, spec: RunSpec, paths: Mapping[str, Path], nudge: Nudge | None = None) -> Run:
    """Steps the model for `spec.duration` and reads every path after each step.

    The loop is bounded by steps, never by `data.time`, which an automatic reset turns back.

    Raises:
        RunError: If the run cannot start, or takes more than MAX_STEPS steps or MAX_SECONDS.
        SignalError: If a path cannot be bound to the model.
    """
    steps = step_count(model, spec)
    data, driven = initial_data(model, spec, nudge), controls(model, spec, steps)
    readers = [bind(path, model, data) for path in paths.values()]
    counts = np.zeros(len(data.warning), dtype=int)
    samples: list[list[float]] = []
    begun = process_time()
    with captured_messages() as messages:
        for i in range(steps):
            if i % 64 == 0 and process_time() - begun > MAX_SECONDS:
                found, expected = f"{steps} steps, of which {i} take {MAX_SECONDS:g} s", "a run that comes to an end"
                raise RunError(("run", "duration"), found, expected, "make the model smaller, or the run shorter")
            step(model, data, driven, i)
            samples.append([read() for read in readers])
            if messages:  # a type's first warning is printed, also after a reset: until then nothing is counted
                np.maximum(counts, data.warning.number, out=counts)
    time = np.arange(1, steps + 1) * model.opt.timestep
    values = np.array(samples, dtype=float).T
    return Run(
        timestep=model.opt.timestep,
        steps=steps,
        traces={name: Trace(time, value) for name, value in zip(paths, values, strict=True)},
        warnings={mujoco.mjtWarning(k).name.removeprefix("mjWARN_"): int(n) for k, n in enumerate(counts) if n},
        messages=tuple(dict.fromkeys(messages)),
    )


def print_warning(text: str) -> None:
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
            mujoco.set_mju_user_warning(print_warning)


def step(model: mujoco.MjModel, data: mujoco.MjData, driven: Controls, i: int) -> None:
    """Makes step `i`, counted from 0, with the controls of time i * timestep."""
    driven.apply(data, i)
    mujoco.mj_step(model, data)


def data_at(model: mujoco.MjModel, spec: RunSpec, time: float) -> mujoco.MjData:
    """The data after round(time / timestep) steps of the run, with everything derived from its state up to date."""
    steps = round(time / model.opt.timestep)
    data, driven = initial_data(model, spec), controls(model, spec, steps)
    with captured_messages():
        for i in range(steps):
            step(model, data, driven, i)
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
        raise RunError(("run", "duration"), found, f"1 to {MAX_STEPS} steps", "change the duration or the timestep")
    return steps


def controls(model: mujoco.MjModel, spec: RunSpec, steps: int) -> Controls:
    """The controls of every driven actuator at the start of each step.

    Raises:
        RunError: If the model lacks an actuator, or the times of a schedule do not increase.
    """
    moments = np.arange(steps) * model.opt.timestep
    values = np.empty((steps, len(spec.ctrl)))
    for k, (name, value) in enumerate(spec.ctrl.items()):
        _require(model, "actuator", name, "ctrl", name)
        points = [(0.0, value)] if isinstance(value, float | int) else value
        times = [time for time, _ in points]
        if not points or any(later <= earlier for earlier, later in pairwise(times)):
            expected = "one or more times, each after the one before"
            raise RunError(("run", "ctrl", name), f"times {times}", expected, "sort them")
        values[:, k] = np.interp(moments, times, [target for _, target in points])
    return Controls(np.array([model.actuator(name).id for name in spec.ctrl], dtype=np.int64), values)


def _require(model: mujoco.MjModel, kind: str, name: str, *field: str) -> None:
    if missing := missing_element(model, kind, name):
        raise RunError(("run", *field), *missing)


mujoco.set_mju_user_warning(print_warning)
