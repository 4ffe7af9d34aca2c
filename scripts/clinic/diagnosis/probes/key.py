"""A keyframe beside its text: poses, targets of servos, depth in the floor."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from itertools import combinations, permutations

from clinic.diagnosis.edit import Edit, insert, remove_attribute, set_attribute
from clinic.diagnosis.engine import BALL, FREE, PLANE, SLIDE
from clinic.diagnosis.probes import servo, tendons
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import WIDTH, Simulation, kept
from clinic.diagnosis.suspect import probe

SLIDES = 2.5  # rad, as which a slide's metre counts
WIDTHS = 0.2  # rad, as which the width of its range counts
AGREE = 0.05  # rad or m
UNIT = 0.02  # how far from 1 the length of a quaternion may be
MOST_PARTS = 5  # of a keyframe that are tried in every order


def start_at(simulation: Simulation, key: int) -> None:
    """Puts the simulation at a keyframe."""
    simulation.engine.reset(key)
    simulation.engine.forward()


def servos(simulation: Simulation, key: int) -> dict[int, tuple[float, float]]:
    """Of position servos the target in a keyframe and where they are, in rad or m.

    Those of hinges and slides, and those of tendons that no ranges bound, such as winches', by their length.
    """
    found = servo.servos(simulation)
    ropes = [each for each, tendon in tendons.pulled(simulation).items() if tendons.reach(simulation, tendon) is None]
    start_at(simulation, key)
    ctrl, lengths = simulation.data("ctrl"), simulation.data("ten_length")
    made = {
        each.actuator: (each.target(ctrl[each.actuator]), simulation.position(each.joint))
        for each in found
        if each.scale > 0
    }
    for each in ropes:
        if (line := tendons.servo(simulation, each)) is not None and line[1] > 0:
            made[each] = line[0] + line[1] * ctrl[each], lengths[tendons.pulled(simulation)[each]]
    return made


@probe("distance of three quarters of the servos from their targets", "rad", dynamic=False)
def off_target(simulation: Simulation, key: int) -> float:
    """How far three quarters of the servos are at most from their targets in a keyframe."""
    apart = sorted(abs(target - at) for target, at in servos(simulation, key).values())
    return apart[len(apart) * 3 // 4] if apart else 0.0


@probe("distance of a servo from its target", "rad", dynamic=False)
def farthest_target(simulation: Simulation, key: int) -> float:
    """How far the servo is from its target in a keyframe that is farthest from it."""
    return max((abs(target - at) for target, at in servos(simulation, key).values()), default=0.0)


@probe("depth in the floor at the keyframe", "m", dynamic=False)
def sunk(simulation: Simulation, key: int) -> float:
    """How deep something that moves is in a plane at a keyframe."""
    start_at(simulation, key)
    kinds, bodies = simulation.model("geom_type"), simulation.model("geom_bodyid")
    moving = set(simulation.moving_bodies)
    deep = [0.0]
    for contact in simulation.engine.contacts():
        planes = [int(kinds[geom]) == PLANE for geom in contact.geoms]
        if any(planes) and any(int(bodies[geom]) in moving for geom in contact.geoms):
            deep.append(-contact.distance)
    return max(deep)


@probe("worst joint outside of its range at the keyframe", "rad", dynamic=False)
def outside(simulation: Simulation, key: int) -> float:
    """How far the worst joint is outside of its range at a keyframe."""
    return max((weighed(simulation, *each) for each in beyond(simulation, key).items()), default=0.0)


def beyond(simulation: Simulation, key: int) -> dict[int, float]:
    """Of hinges and slides outside of their ranges at a keyframe: how far, in rad or m, negative below."""
    start_at(simulation, key)
    made = {}
    for joint, (low, high) in simulation.ranges.items():
        off = min(0.0, simulation.position(joint) - low) + max(0.0, simulation.position(joint) - high)
        if off:
            made[joint] = off
    return made


def weighed(simulation: Simulation, joint: int, off: float) -> float:
    """How far a joint is outside of its range, in rad; of a slide SLIDES a metre, or WIDTHS a width of its range."""
    low, high = simulation.row("jnt_range", joint, 2)
    slides = simulation.joint_type(joint) == SLIDE
    return abs(off) * (max(SLIDES, WIDTHS / max(high - low, 1e-3)) if slides else 1.0)


@kept
def against_range(simulation: Simulation, key: int) -> dict[int, tuple[float, float]]:
    """Of joints outside of their ranges at a keyframe whose servo is told to hold them there: what it may be told.

    Keyframe and control agree, so that it is the range that is wrong.
    """
    made = {}
    found = servo.servos(simulation)
    off = beyond(simulation, key)
    for each in found:
        if each.joint in off and each.targets and each.scale > 0:
            at = simulation.position(each.joint)
            target = each.target(simulation.data("ctrl")[each.actuator])
            if abs(target - at) < AGREE and each.targets[0] - AGREE < at < each.targets[1] + AGREE:
                made[each.joint] = each.targets
    return made


@probe("numbers that go to another joint", dynamic=False)
def astray(simulation: Simulation, key: int, meant: tuple[float, ...]) -> float:
    """How many numbers of a keyframe go to another joint than they are meant for."""
    simulation.engine.reset(key)
    return float(sum(abs(a - b) > 1e-5 for a, b in zip(simulation.data("qpos"), meant, strict=True)))


def reordered(model: ReaderModel, key: int) -> list[float] | None:
    """A keyframe's `qpos` in the order of the model, where it is written in another one; else None.

    Its quaternions tell: as they are read one is not of length 1, and with the free joints and what stands between
    them in another order all are.
    """
    element = model.element("key", key)
    values = element.get("qpos").split() if element is not None else []
    return _reordered(model.simulation, tuple(map(float, values)))


@kept
def _reordered(of: Simulation, values: Sequence[float]) -> list[float] | None:
    parts = _parts(of)
    if len(values) != len(of.model("qpos0")) or len(parts) > MOST_PARTS or _turns(of, values):
        return None
    tried = []
    for order in permutations(range(len(parts))):
        made, at = [0.0] * len(values), 0
        for part in order:
            first, width = parts[part]
            made[first : first + width] = values[at : at + width]
            at += width
        if _turns(of, made):
            moved = sum(a > b for a, b in combinations(order, 2))
            tried.append((_beyond_ranges(of, made), moved, made))
    return min(tried, key=lambda each: each[:2])[2] if tried else None


def _parts(of: Simulation) -> list[tuple[int, int]]:
    """Address and width in qpos of each free joint, and of all that stands between two of them."""
    made: list[tuple[int, int]] = []
    free = True
    for joint in range(of.count("joint")):
        was, free = free, of.joint_type(joint) == FREE
        at, width = of.place(joint), WIDTH[of.joint_type(joint)][0]
        if free or was:
            made.append((at, width))
        else:
            made[-1] = (made[-1][0], made[-1][1] + width)
    return made


def _turns(of: Simulation, qpos: Sequence[float]) -> bool:
    """Whether all quaternions are of length 1."""
    return all(abs(math.hypot(*qpos[at : at + 4]) - 1) < UNIT for at in _quaternions(of))


def _quaternions(of: Simulation) -> Iterator[int]:
    for joint in range(of.count("joint")):
        if of.joint_type(joint) in (FREE, BALL):
            yield of.place(joint) + 3 * (of.joint_type(joint) == FREE)


def _beyond_ranges(of: Simulation, qpos: Sequence[float]) -> int:
    """How many hinges and slides would be outside of their ranges."""
    ranges = of.ranges.items()
    return sum(not low - 0.01 <= qpos[of.place(joint)] <= high + 0.01 for joint, (low, high) in ranges)


def freed(model: ReaderModel, bodies: Collection[int]) -> tuple[Edit, ...]:
    """The edits that put bodies of the world on free joints, and their places into the keyframes."""
    made = (insert(element, "<freejoint/>") for body in bodies if (element := model.element("body", body)))
    return *made, *rekeyed(model, freed=bodies)


def rekeyed(model: ReaderModel, *, freed: Collection[int] = (), taken: Collection[int] = ()) -> tuple[Edit, ...]:
    """Edits that keep all keyframes as long as the model: bodies that get a free joint stand where they are in them.

    Of joints that are taken out the numbers go; a `qpos` that is not of the model's length is left alone.
    """
    of, made, joints = model.simulation, list[Edit](), range(model.simulation.count("joint"))
    for key in range(of.count("key")):
        start_at(of, key)
        for which, (name, begin) in enumerate((("qpos", of.place), ("qvel", of.dof))):
            element = model.element("key", key)
            numbers = element.get(name).split() if element is not None else []
            if element is None or not numbers or len(numbers) != len(of.data(name)):
                continue
            widths = {joint: WIDTH[of.joint_type(joint)][which] for joint in joints if joint not in taken}
            parts = [(of.body_of("joint", j), numbers[begin(j) : begin(j) + width]) for j, width in widths.items()]
            poses = {body: (*of.data_row("xpos", body, 3), *of.data_row("xquat", body, 4)) for body in freed}
            parts += [(body, written((0.0,) * 6 if which else pose).split()) for body, pose in poses.items()]
            text = " ".join(each for _, some in sorted(parts, key=lambda part: part[0]) for each in some)
            made.append(set_attribute(element, name, text) if text else remove_attribute(element, name))
    return tuple(made)
