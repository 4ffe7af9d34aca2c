"""Well-known robots: how strong and how wide their joints are, as the makers describe them."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import NamedTuple

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.arms import is_called
from clinic.diagnosis.simulation import Simulation, kept


class Joint(NamedTuple):
    """Joints of one kind by the pattern of their names: N m and degrees, for a slide N and m."""

    pattern: re.Pattern[str]
    effort: float  # 0 where it is not known
    low: float = -math.inf  # where none is known
    high: float = math.inf

    @property
    def turns(self) -> bool:
        """Whether it is one of hinges: no slide of the table goes two metres."""
        return self.high - self.low > 2


@dataclass(frozen=True)
class Robot:
    """A robot of a data sheet: its names, in lower case, its mass in kg or 0 where it is not known, and its joints."""

    names: tuple[str, ...]
    mass: float
    joints: tuple[Joint, ...]


class Limit(NamedTuple):
    """What limits the force on a joint: the element, its attribute, and how many N m one of it is."""

    kind: str
    of: int
    attribute: str
    force: float
    scale: float


@cache
def known_robots() -> tuple[Robot, ...]:
    """The robots of `robots.toml`."""
    read = tomllib.loads(Path(__file__).with_name("robots.toml").read_text(encoding="utf-8"))
    return tuple(
        Robot(
            (name, *each.get("also", ())),
            each.get("mass", 0.0),
            tuple(Joint(re.compile(line[0]), *line[1:]) for line in each["joints"]),
        )
        for name, each in read.items()
    )


def robot_in(of: Simulation, text: str) -> tuple[Robot, dict[int, list[Joint]]] | None:
    """The robot that a text names and of which a model has the most joints, with the lines of each, in rad and m."""
    found = [(robot, _lines(of, robot)) for robot in known_robots() if is_called(text, robot.names)]
    return max(found, key=lambda each: len(each[1]), default=None)


def _lines(of: Simulation, robot: Robot) -> dict[int, list[Joint]]:
    made = {}
    for joint, name in enumerate(of.names("joint")):
        hinge = of.joint_type(joint) == HINGE
        lines = [line for line in robot.joints if line.pattern.search(name.lower()) and hinge == line.turns]
        if lines and joint in of.scalar_joints:
            unit = math.pi / 180 if hinge else 1.0
            made[joint] = [line._replace(low=unit * line.low, high=unit * line.high) for line in lines]
    return made


@kept
def limit_of(of: Simulation, joint: int) -> Limit | None:
    """What limits the force on a joint most; None where nothing does, or several actuators drive it."""
    found, own = [], of.drivers.get(joint, [])
    if of.model("jnt_actfrclimited")[joint]:
        found.append(Limit("joint", joint, "actuatorfrcrange", of.row("jnt_actfrcrange", joint, 2)[1], 1.0))
    if len(own) > 1:
        return None
    for actuator in own:
        gear, gain = abs(of.gear(actuator)), abs(of.gain(actuator)[0])
        if of.model("actuator_forcelimited")[actuator]:
            most = of.row("actuator_forcerange", actuator, 2)[1]
            found.append(Limit("actuator", actuator, "forcerange", gear * most, gear))
        if of.model("actuator_ctrllimited")[actuator] and not of.model("actuator_biastype")[actuator]:
            most = of.row("actuator_ctrlrange", actuator, 2)[1]
            found.append(Limit("actuator", actuator, "ctrlrange", gear * gain * most, gear * gain))
    return min(found, key=lambda limit: limit.force, default=None)


def nearest_range(lines: Sequence[Joint], low: float, high: float) -> tuple[float, float]:
    """The range of a data sheet, or one of them with its signs turned, whichever the given one is nearest to."""
    ways = [way for line in lines for way in ((line.low, line.high), (-line.high, -line.low))]
    return min(ways, key=lambda way: abs(way[0] - low) + abs(way[1] - high))
