"""Well-known arms: how far apart the axes of their joints are, and which way these turn, as the makers describe them.

Two lines have a distance and an angle, and three lines in a row have an offset along the middle one, wherever the
frames of the bodies are: the parameters a, alpha and d of Denavit and Hartenberg, *A Kinematic Notation for Lower-Pair
Mechanisms Based on Matrices*, 1955. So a model is compared with a data sheet whatever its frames are.
"""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.shape import limbs
from clinic.diagnosis.probes.vector import Vector, add, cross, dot, norm, sub
from clinic.diagnosis.simulation import Simulation, kept

PARALLEL = 0.02  # the sine of an angle
NEAR, SHARE = 0.002, 0.01  # m, and of a length: nearer to the data sheet than both of these is alike
ALONG = 0.99
QUARTER = {"x": "y", "y": "-x", "-x": "-y", "-y": "x"}


@dataclass(frozen=True)
class Arm:
    """An arm of a data sheet.

    Attributes:
        names: How it is called, in lower case; the first is its name.
        lengths: The distance of each axis from the next, in m.
        offsets: From one axis to the next but one, along the axis between them, in m; positive.
        axes: The directions of the axes as the arm stands at 0: `z`, `-y`; empty where not known.
        height: From the base along the first axis to where the second is nearest to it, in m; None where not known.
        mass: Of all links that move, in kg; None where not known.
        ranges: Of each joint, in rad; empty where not known.
        grip: From the last axis but one to the way of its own fingers, about the last axis, in rad; None without.
    """

    names: tuple[str, ...]
    lengths: tuple[float, ...]
    offsets: tuple[float, ...]
    axes: tuple[str, ...]
    height: float | None
    mass: float | None
    ranges: tuple[tuple[float, float], ...]
    grip: float | None

    @property
    def numbers(self) -> tuple[float, ...]:
        """Its lengths and offsets."""
        return (*self.lengths, *self.offsets)


class Measured(NamedTuple):
    """As many hinges in a row as an arm has: their joints, and the same numbers of them.

    `shoulder` is the place on the first axis where the second is nearest to it.
    """

    joints: tuple[int, ...]
    shoulder: Vector
    lengths: tuple[float, ...]
    offsets: tuple[float, ...]
    axes: tuple[Vector, ...]

    @property
    def numbers(self) -> tuple[float, ...]:
        """Their lengths and offsets."""
        return (*self.lengths, *self.offsets)


@cache
def known_arms() -> tuple[Arm, ...]:
    """The arms of `arms.toml`, and the makers there."""
    read = tomllib.loads(Path(__file__).with_name("arms.toml").read_text(encoding="utf-8"))
    return tuple(_arm(name, each) for name, each in read.items())


def _arm(name: str, said: dict[str, Any]) -> Arm:
    lengths, offsets = (tuple(each / 1000 for each in said.get(key, ())) for key in ("lengths", "offsets"))
    height = said.get("height")
    ranges = tuple((math.radians(low), math.radians(high)) for low, high in said.get("range", ()))
    axes = tuple(said["axes"].split()) if "axes" in said else ("",) * (len(lengths) + 1)
    metres = None if height is None else height / 1000
    grip = math.radians(said["grip"]) if "grip" in said else None
    return Arm((name, *said.get("also", ())), lengths, offsets, axes, metres, said.get("mass"), ranges, grip)


def called(text: str) -> list[Arm]:
    """The arms of which a text has a name, as a word of its own; the maker's in common where it names none of them."""
    named = [arm for arm in known_arms() if is_called(text, arm.names)]
    return [arm for arm in named if arm.lengths] or named


def is_called(text: str, names: Iterable[str]) -> bool:
    """Whether a text has one of the names, in lower case, as a word of its own."""
    said = re.sub(r"[^a-z0-9]+", "_", f" {text.lower()} ")
    return any(f"_{name}_" in said for name in names)


def differs(measured: float, right: float) -> bool:
    """Whether a length is another one than that of the data sheet."""
    return abs(measured - right) > max(NEAR, SHARE * right)


def rows_of_hinges(of: Simulation, count: int) -> Iterator[Measured]:
    """All rows of so many hinges, each carried by the one before, as the model stands where its joints are 0."""
    for joints in _chains(of):
        for first in range(len(joints) - count + 1):
            yield measured(of, joints[first : first + count])


def longest_row(of: Simulation) -> int:
    """The most hinges in a row."""
    return max(map(len, _chains(of)), default=0)


@kept
def _chains(of: Simulation) -> tuple[tuple[int, ...], ...]:
    """The hinges from each last body back to the world, in order from the world on; each chain once."""
    joints = ([joint for body in limb for joint in of.joints_of(body)] for limb in limbs(of))
    return tuple(dict.fromkeys(tuple(each for each in some if of.joint_type(each) == HINGE) for some in joints))


@kept
def measured(of: Simulation, joints: tuple[int, ...]) -> Measured:
    """The numbers of hinges in a row."""
    of.as_written()
    places = [of.data_row("xanchor", joint, 3) for joint in joints]
    axes = [of.axis(joint) for joint in joints]
    lengths, offsets, foot, shoulder = [], [], places[0], places[0]
    for one, (axis, after) in enumerate(pairwise(axes)):
        normal, between = cross(axis, after), sub(places[one + 1], places[one])
        sine = norm(normal)
        if sine < PARALLEL:
            start, end = foot, add(places[one + 1], after, dot(sub(foot, places[one + 1]), after))
        else:
            start = add(places[one], axis, dot(cross(between, after), normal) / sine**2)
            end = add(places[one + 1], after, dot(cross(between, axis), normal) / sine**2)
        shoulder = shoulder if one else start
        offsets.append(norm(sub(start, foot)))
        lengths.append(norm(sub(end, start)))
        foot = end
    return Measured(joints, shoulder, tuple(lengths), tuple(offsets[1:]), tuple(axes))


def direction(axis: Sequence[float]) -> str:
    """Along which axis of the world a direction lies: `-y`; empty where it lies along none."""
    size, which = max((abs(part), which) for part, which in zip(axis, "xyz", strict=True))
    return (("-" if axis["xyz".index(which)] < 0 else "") + which) if size > ALONG else ""


def about_the_vertical(axes: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """Directions, and how they are after a turn of all by 90, 180 and 270 degrees about z."""
    yield (turned := tuple(axes))
    for _ in range(3):
        yield (turned := tuple(QUARTER.get(axis, axis) for axis in turned))


def against(one: str, other: str) -> bool:
    """Whether two directions are opposite."""
    return one != other and one.strip("-") == other.strip("-")
