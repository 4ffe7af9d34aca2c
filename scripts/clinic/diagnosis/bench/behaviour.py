"""How a compiled model behaves when it is let go, pushed, driven and pressed: runs that are bounded in steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.diagnosis.engine import FREE, HINGE, SLIDE
from clinic.engine.releases import mass_matrix

Array = NDArray[np.float64]
SECONDS, SAMPLES, MOST_STEPS = 1.0, 20, 2500
UNSTABLE = ("mjWARN_BADQPOS", "mjWARN_BADQVEL", "mjWARN_BADQACC")
ALONE = sum(int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{what}")) for what in ("CONTACT", "GRAVITY", "ACTUATION"))


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
        return np.diagonal(mass_matrix(self.model, self.start))

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
        return self._run(each=self._drive)

    @cached_property
    def pressed(self) -> tuple[Run, Run]:
        """Hinges and slides pressed up, then down, without contacts, gravity and actuators."""
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
            try:
                mujoco.mj_step(model, data, nstep=count) if count else None
            except mujoco.FatalError:  # its memory is full
                return Run(True, math.inf, math.inf)
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
