"""What a fault does to a model: its behaviour beside that of the healthy one, measured without the rules.

Each harm is a number that is 1 where it begins to matter; the limits stand beside the measurements.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.diagnosis.engine import FREE, HINGE, SLIDE

Array = NDArray[np.float64]
SECONDS, SAMPLES, MOST_STEPS = 1.0, 20, 2500
UNSTABLE = ("mjWARN_BADQPOS", "mjWARN_BADQVEL", "mjWARN_BADQACC")
ALONE = int(mujoco.mjtDisableBit.mjDSBL_CONTACT) | int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)


@dataclass
class Run:
    """What was seen in one run; positions are None after it went to infinity."""

    unstable: bool
    fastest: float = 0.0
    deepest: float = 0.0
    positions: Array | None = None  # (SAMPLES, nbody, 3), m
    joints: Array = field(default_factory=lambda: np.zeros((0, 0)))  # (SAMPLES, nq)
    lengths: Array = field(default_factory=lambda: np.zeros((0, 0)))  # (SAMPLES, outputs of actuators)
    sensors: Array = field(default_factory=lambda: np.zeros(0))  # the largest of each, as a magnitude


class Behaviour:
    """How one compiled model behaves; each run is made when it is asked for.

    Args:
        model: The model.
        like: The healthy model of which it is a copy: it is pushed and driven as that one is.
    """

    def __init__(self, model: mujoco.MjModel, like: Behaviour | None = None) -> None:
        self.model, self.like = model, like or self
        self.start = mujoco.MjData(model)
        mujoco.mj_forward(model, self.start)

    @cached_property
    def mass_diagonal(self) -> Array:
        """Of the mass matrix at the start."""
        made, unit = np.zeros(self.model.nv), np.zeros(self.model.nv)
        for dof in range(self.model.nv):
            column, unit[:] = np.zeros(self.model.nv), 0
            unit[dof] = 1
            mujoco.mj_mulM(self.model, self.start, column, unit)
            made[dof] = column[dof]
        return made

    @cached_property
    def let_go(self) -> Run:
        """Nobody does anything."""
        return self._run()

    @cached_property
    def astray(self) -> Run:
        """The same from a start that is a hair away: how far chaos alone leads."""
        return self._run(begin=self._nudge)

    @cached_property
    def pushed(self) -> Run:
        """Every free body begins at 1 m/s along x."""
        return self._run(begin=self._push)

    @cached_property
    def driven(self) -> Run:
        """Every actuator goes to and fro over the half of its range, each at a pace of its own."""
        return self._run(each=lambda data, time: self._drive(data, time))

    @cached_property
    def pressed(self) -> tuple[Run, Run]:
        """Hinges and slides are pressed to their upper, then their lower end, without contacts and gravity."""
        return self._pressed(1.0), self._pressed(-1.0)

    @cached_property
    def commanded(self) -> tuple[Run, Run]:
        """All actuators at the upper, then at the lower end of their control ranges."""
        return self._commanded(1), self._commanded(0)

    @cached_property
    def stepped(self) -> Run:
        """Every position servo is told to go from the start by a tenth of the way that is left to its target's end."""
        targets = self.targets
        return self._run(each=lambda data, _: _write(data.ctrl, targets), seconds=2 * SECONDS)

    @cached_property
    def servos(self) -> list[int]:
        """Actuators with one control that pull towards it."""
        model = self.model
        return [i for i in range(model.nu) if model.actuator_biasprm[i, 1] != 0 and model.actuator_trntype[i] == 0]

    @cached_property
    def targets(self) -> Array:
        """What `stepped` commands: as the healthy model's length in each servo's joint wants it."""
        like, wanted = self.like.model, np.zeros(self.model.nu)
        for i in self.servos:
            if i < like.nu:
                joint = like.actuator_trnid[i, 0]
                low, high = like.jnt_range[joint] if like.jnt_limited[joint] else (-1.0, 1.0)
                now = self.like.start.qpos[like.jnt_qposadr[joint]]
                wanted[i] = now + (0.1 if high - now > now - low else -0.1) * (high - low)
        return wanted

    def _pressed(self, sign: float) -> Run:
        like = self.like
        hinges = [
            dof for dof in range(like.model.nv) if like.model.jnt_type[like.model.dof_jntid[dof]] in (SLIDE, HINGE)
        ]
        force = np.zeros(like.model.nv)
        force[hinges] = sign * 20 * like.mass_diagonal[hinges]  # rad/s2: 10 rad in a second where nothing stops it
        old = self.model.opt.disableflags
        self.model.opt.disableflags = old | ALONE
        try:
            return self._run(begin=lambda data: _write(data.qfrc_applied, force))
        finally:
            self.model.opt.disableflags = old

    def _commanded(self, end: int) -> Run:
        limited = self.model.actuator_ctrllimited.astype(bool)
        ends = np.where(limited, self.model.actuator_ctrlrange[:, end], (-1.0, 1.0)[end])
        return self._run(begin=lambda data: _write(data.ctrl, ends), seconds=2 * SECONDS)

    def _drive(self, data: mujoco.MjData, time: float) -> None:
        like = self.like.model
        limited = like.actuator_ctrllimited.astype(bool)
        low = np.where(limited, like.actuator_ctrlrange[:, 0], -1.0)
        high = np.where(limited, like.actuator_ctrlrange[:, 1], 1.0)
        pace = 1 + np.arange(like.nu) % 3
        wave = np.sign(np.sin(2 * math.pi * pace * time + 0.3))
        _write(data.ctrl, (low + high) / 2 + wave * (high - low) / 4)

    def _push(self, data: mujoco.MjData) -> None:
        for joint in range(self.model.njnt):
            if self.model.jnt_type[joint] == FREE:
                data.qvel[self.model.jnt_dofadr[joint]] = 1.0

    def _nudge(self, data: mujoco.MjData) -> None:
        data.qvel[:] += 1e-5 * np.cos(np.arange(self.model.nv))

    def _run(
        self,
        begin: Callable[[mujoco.MjData], None] = lambda _: None,
        each: Callable[[mujoco.MjData, float], None] = lambda data, time: None,
        seconds: float = SECONDS,
    ) -> Run:
        model, data = self.model, mujoco.MjData(self.model)
        begin(data)
        step = model.opt.timestep
        total = min(math.ceil(seconds / self.like.model.opt.timestep), MOST_STEPS) * self.like.model.opt.timestep
        positions, joints, lengths = [], [], []
        made = Run(False, sensors=np.zeros(model.nsensordata))
        for sample in range(1, SAMPLES + 1):
            each(data, data.time)
            count = max(0, round((sample * total / SAMPLES - data.time) / step)) if step > 0 else 1
            mujoco.mj_step(model, data, nstep=count)
            if any(data.warning[int(getattr(mujoco.mjtWarning, name))].number for name in UNSTABLE):
                return Run(True, math.inf, math.inf)
            positions.append(data.xpos.copy())
            joints.append(data.qpos.copy())
            lengths.append(data.actuator_length.copy())
            made.sensors = np.maximum(made.sensors, np.abs(data.sensordata))
            made.fastest = max(made.fastest, float(np.abs(data.qvel).max(initial=0)))
            made.deepest = max(made.deepest, -float(data.contact.dist.min(initial=0)))
        made.positions, made.joints, made.lengths = np.array(positions), np.array(joints), np.array(lengths)
        return made


def _write(array: Array, values: Array) -> None:
    count = min(len(array), len(values))
    array[:count] = values[:count]


def runs(of: Behaviour) -> Iterator[Run]:
    """The runs that look at the model as a whole."""
    yield of.let_go
    yield of.pushed
    yield of.driven


def unstable(was: Behaviour, now: Behaviour) -> float:
    """It goes to infinity, and the healthy one does not."""
    pairs = zip([*runs(was), *was.commanded], [*runs(now), *now.commanded], strict=True)
    return max(10.0 if after.unstable and not before.unstable else 0.0 for before, after in pairs)


def faster(was: Behaviour, now: Behaviour) -> float:
    """Something in it is 5 times as fast, and faster than 5 rad/s."""
    pairs = zip(runs(was), runs(now), strict=True)
    return max(_size(after.fastest / max(5 * before.fastest, 5.0)) for before, after in pairs)


def strays(was: Behaviour, now: Behaviour) -> float:
    """A body is elsewhere by a twentieth of the model's extent, and 3 times as far as chaos alone leads."""
    if was.model.nbody != now.model.nbody:
        return 0.0
    chaos = _apart(was.let_go, was.astray)
    return max(
        _size(_apart(a, b) / max(0.05 * was.model.stat.extent, 3 * chaos))
        for a, b in zip(runs(was), runs(now), strict=True)
    )


def _apart(one: Run, other: Run) -> float:
    if one.positions is None or other.positions is None:
        return 0.0 if one.positions is None else math.inf
    return float(np.linalg.norm(one.positions - other.positions, axis=2).max())


def sinks(was: Behaviour, now: Behaviour) -> float:
    """Contacts are 3 times as deep, and deeper than a hundredth of the extent."""
    pairs = zip(runs(was), runs(now), strict=True)
    return max(_size(after.deepest / max(3 * before.deepest, 0.01 * was.model.stat.extent)) for before, after in pairs)


def jumps(was: Behaviour, now: Behaviour) -> float:
    """The first acceleration is 3 times the healthy one's and 3 times gravity's over the extent."""
    usual = 3 * 9.81 / max(was.model.stat.extent, 0.01)
    first, after = (float(np.abs(each.start.qacc).max(initial=0)) for each in (was, now))
    return _size(after / max(3 * first, usual))


def reaches(was: Behaviour, now: Behaviour) -> float:
    """A pressed hinge or slide ends elsewhere by 0.1 rad, or by a twentieth of the extent."""
    made = 0.0
    for before, after in zip(was.pressed, now.pressed, strict=True):
        made = max(made, _joints_apart(was, before, after, 0.1))
    return made


def commands(was: Behaviour, now: Behaviour) -> float:
    """At the ends of the controls a joint is elsewhere by 0.2 rad, or by a twentieth of the extent."""
    made = 0.0
    for before, after in zip(was.commanded, now.commanded, strict=True):
        made = max(made, _joints_apart(was, before, after, 0.2))
    return made


def _joints_apart(was: Behaviour, before: Run, after: Run, angle: float) -> float:
    if before.positions is None or after.positions is None or before.joints.shape != after.joints.shape:
        return 10.0 if before.positions is not None and after.positions is None else 0.0
    made = 0.0
    for joint, kind in enumerate(was.model.jnt_type):
        if kind in (SLIDE, HINGE):
            at = was.model.jnt_qposadr[joint]
            limit = angle if kind == HINGE else 0.05 * was.model.stat.extent
            made = max(made, abs(before.joints[-1, at] - after.joints[-1, at]) / limit)
    return _size(made)


def misses(was: Behaviour, now: Behaviour) -> float:
    """A servo ends a quarter of its step further from the target, or 0.1 rad, or swings by as much."""
    before, after = was.stepped, now.stepped
    if before.positions is None or after.positions is None or before.lengths.shape != after.lengths.shape:
        return 10.0 if before.positions is not None and after.positions is None else 0.0
    made = 0.0
    for i in was.servos:
        joint = was.model.actuator_trnid[i, 0]
        at = was.model.jnt_qposadr[joint]
        step = max(abs(was.targets[i] - was.start.qpos[at]), 1e-6)
        error = [float(np.abs(run.joints[SAMPLES // 2 :, at] - was.targets[i]).max()) for run in (before, after)]
        made = max(made, (error[1] - error[0]) / (0.25 * step))
    return _size(made)


def weighs(was: Behaviour, now: Behaviour) -> float:
    """The model's mass, or that of a body that has a hundredth of it, is off by 20 %."""
    if was.model.nbody != now.model.nbody:
        return 0.0
    share = 0.01 * was.model.body_mass.sum()
    masses = [(was.model.body_mass[i], now.model.body_mass[i]) for i in range(1, was.model.nbody)]
    pairs = [(before, after) for before, after in masses if max(before, after) > share]
    return _size(
        max([_factor(a, b) for a, b in [*pairs, (was.model.body_mass.sum(), now.model.body_mass.sum())]]) / 1.2
    )


def accelerates(was: Behaviour, now: Behaviour) -> float:
    """What some joint has to move, or has to hold at the start, is off by a third."""
    if was.model.nv != now.model.nv:
        return 0.0
    moved = max(map(_factor, was.mass_diagonal, now.mass_diagonal), default=1.0) / (4 / 3)
    loads = [np.abs(each.start.qfrc_bias) for each in (was, now)]
    some = 0.05 * max(1e-9, float(loads[0].max(initial=0)))
    held = max((_factor(a, b) for a, b in zip(*loads, strict=True) if max(a, b) > some), default=1.0) / (4 / 3)
    return _size(max(moved, held if was.model.opt.gravity.any() else 0.0))


def reads(was: Behaviour, now: Behaviour) -> float:
    """A sensor that told something tells at most a tenth of it."""
    made = 0.0
    for before, after in zip(runs(was), runs(now), strict=True):
        if not after.unstable and before.sensors.shape == after.sensors.shape:
            told = before.sensors > 1e-6
            made = max([made, *(before.sensors[told] / np.maximum(10 * after.sensors[told], 1e-9))])
    return _size(made)


def looks(was: Behaviour, now: Behaviour) -> float:
    """A camera is turned by 30 degrees, or its field of view is off by a third."""
    made = 0.0
    for i in range(min(was.model.ncam, now.model.ncam)):
        one, other = was.start.cam_xmat[i].reshape(3, 3), now.start.cam_xmat[i].reshape(3, 3)
        angle = math.acos(min(1.0, max(-1.0, (np.trace(one.T @ other) - 1) / 2)))
        made = max(made, angle / math.radians(30), _factor(was.model.cam_fovy[i], now.model.cam_fovy[i]) / (4 / 3))
    return made


def _factor(one: float, other: float) -> float:
    """How many times the larger is the smaller; 1 where both are next to nothing."""
    low, high = sorted((abs(float(one)), abs(float(other))))
    return 1.0 if high < 1e-12 else min(1e6, high / max(low, 1e-12))


def _size(excess: float) -> float:
    """Bounded, so that it can be told."""
    return 10.0 if math.isnan(excess) else float(min(10.0, max(0.0, excess)))


HARMS: dict[str, Callable[[Behaviour, Behaviour], float]] = {
    each.__name__: each
    for each in (unstable, faster, strays, sinks, jumps, reaches, commands, misses, weighs, accelerates, reads, looks)
}
