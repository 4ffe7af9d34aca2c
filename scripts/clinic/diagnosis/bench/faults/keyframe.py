"""Keyframes: beyond the ranges, in the floor, with their numbers in another order."""

from __future__ import annotations

import math
from random import Random

from clinic.diagnosis.bench.faults import Fault, between, kind, text_of
from clinic.diagnosis.reader_model import ReaderModel


def _keyless(model: ReaderModel) -> bool:
    """Whether no keyframe is written: `nkey` alone makes some that are the model's start."""
    return model.source is not None and not any(True for _ in model.source.elements("key"))


@kind("key-outside-range", harms=("keys",))
def key_outside_of_the_range(model: ReaderModel, random: Random) -> Fault | None:
    """A keyframe with a hinge or slide beyond its range by 10 to 300 % of the range."""
    simulation = model.simulation
    joints = [j for j in range(simulation.count("joint")) if simulation.joint_type(j) > 1]
    joints = [j for j in joints if simulation.model("jnt_limited")[j]]
    if not joints or not _keyless(model):
        return None
    joint, share = random.choice(joints), between(random, 0.1, 3)
    low, high = simulation.row("jnt_range", joint, 2)
    way = share * (high - low)
    positions = list(simulation.model("qpos0"))
    positions[simulation.place(joint)] = random.choice((low - way, high + way))
    xml = f'<key name="planted" qpos="{text_of(*positions)}"/>'
    return Fault(model.add("keyframe", xml), (), "qpos", share)


@kind("key-in-the-floor", "overlap-at-start", harms=("keys",))
def key_in_the_floor(model: ReaderModel, random: Random) -> Fault | None:
    """A keyframe in which a free body stands lower by 5 to 100 % of the model's size."""
    free = [j for j in range(model.simulation.count("joint")) if model.simulation.joint_type(j) == 0]
    if not free or not _keyless(model):
        return None
    depth = model.simulation.extent * between(random, 0.05, 1)
    positions = list(model.simulation.model("qpos0"))
    positions[model.simulation.place(random.choice(free)) + 2] -= depth
    xml = f'<key name="planted" qpos="{text_of(*positions)}"/>'
    return Fault(model.add("keyframe", xml), (), "qpos", depth)


@kind("key-quaternion", harms=("keys",))
def key_with_w_last(model: ReaderModel, random: Random) -> Fault | None:
    """A keyframe with the quaternion of a free body as x y z w."""
    free = [j for j in range(model.simulation.count("joint")) if model.simulation.joint_type(j) == 0]
    if not free or not _keyless(model):
        return None
    positions = list(model.simulation.model("qpos0"))
    at = model.simulation.place(random.choice(free)) + 3
    turn = random.uniform(0.3, 2.8)
    positions[at : at + 4] = [0.0, 0.0, math.sin(turn / 2), math.cos(turn / 2)]
    xml = f'<key name="planted" qpos="{text_of(*positions)}"/>'
    return Fault(model.add("keyframe", xml), (), "qpos", turn)


@kind("key-in-another-order", harms=("keys",))
def key_with_free_joints_last(model: ReaderModel, random: Random) -> Fault | None:
    """A keyframe in which the numbers of the free joints stand behind those of all other joints."""
    simulation = model.simulation
    at = [simulation.place(j) for j in range(simulation.count("joint"))]
    free = [at[j] for j in range(simulation.count("joint")) if simulation.joint_type(j) == 0]
    hinges = [j for j in range(simulation.count("joint")) if simulation.joint_type(j) > 1]
    if not free or not hinges or free[0] > at[hinges[-1]] or not _keyless(model):
        return None
    positions = list(simulation.model("qpos0"))
    for joint in hinges:
        low, high = simulation.row("jnt_range", joint, 2) if simulation.model("jnt_limited")[joint] else (-0.5, 0.5)
        positions[at[joint]] = random.uniform(low, high)
    behind = [positions[k + i] for k in free for i in range(7)]
    taken = {k + i for k in free for i in range(7)}
    values = [value for i, value in enumerate(positions) if i not in taken] + behind
    xml = f'<key name="planted" qpos="{text_of(*values)}"/>'
    return Fault(model.add("keyframe", xml), (), "qpos", 1)
