"""A robot stands on a floor that is smaller than the robot.

A box has an edge where a plane goes on for ever. On a box called a floor, of half a metre, a robot that takes a step or
starts beside the middle falls off it.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="box" size="0.15 0.15 0.05" pos="0 0 -0.05"/>
        <body name="torso" pos="0 0 0.45">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.2" mass="5"/>
          <body name="head" pos="0 0 0.25">
            <joint axis="0 0 1" damping="1"/>
            <geom type="box" size="0.05 0.05 0.05" mass="1"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="floor" type="box" size="0.15 0.15 0.05" pos="0 0 -0.05"/>
    +     <geom name="floor" type="plane" size="3 3 0.1"/>

The number: how many boxes that are called a floor or the ground, and are all that stands still, are narrower than a
robot with a free joint is in its longest direction. None of 206 healthy models has one.

When it is wrong: a pedestal that is called a floor.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import BOX
from clinic.diagnosis.probes.shape import boxes, mechanisms, solid
from clinic.diagnosis.probes.vector import Vector, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A floor that is smaller than the robot"
FAMILIES = ("falls-through",)
UNPLANTED = "how large a floor should be, only its maker knows"

FLOOR = re.compile(r"floor|ground", re.IGNORECASE)
ENOUGH = 10  # times the robot


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The floor that a robot steps off."""
    of = model.simulation
    for geom, size in _narrow(of).items():
        half, name = of.row("geom_size", geom, 3), of.name("geom", geom)
        value = written([ENOUGH * size, ENOUGH * size, half[2]])
        says = f"{name} is {2 * min(half[:2]):.3g} m wide, and the robot over it {size:.3g} m long: it steps off."
        probe = how_many("floors that are smaller than the robot", _narrow)
        edits = model.set("geom", [geom], "size", value)
        yield Suspect((name,), "size", written(half), value, edits, probe, 0, says, "larger than the robot")


def _narrow(of: Simulation) -> dict[int, float]:
    """The box called a floor that is narrower than a robot, and how long that is in m."""
    welds = of.model("body_weldid")
    grounds = [geom for geom in range(of.count("geom")) if solid(of, geom) and welds[of.body_of("geom", geom)] == 0]
    if len(grounds) != 1 or int(of.model("geom_type")[grounds[0]]) != BOX:
        return {}
    (floor,) = grounds
    if not FLOOR.search(of.name("geom", floor)) or of.row("geom_quat", floor, 4)[0] != 1:
        return {}
    of.begin()
    robots = [geoms for root, geoms in mechanisms(of).items() if root in of.free_bodies and root in of.children]
    longest = max((_longest([*boxes(of, geoms).values()]) for geoms in robots), default=0.0)
    return {floor: longest} if longest > 2 * min(of.row("geom_size", floor, 3)[:2]) else {}


def _longest(around: list[tuple[Vector, Vector]]) -> float:
    """The longest side of the box around some boxes, in m."""
    return max(
        max(at[i] + half[i] for at, half in around) - min(at[i] - half[i] for at, half in around) for i in range(3)
    )
