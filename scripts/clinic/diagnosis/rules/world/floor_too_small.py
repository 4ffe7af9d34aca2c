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

The number: how many boxes that are called a floor or the ground, and are all that stands still, have an edge nearer to
their middle than a robot with a free joint reaches from its root. None of 206 healthy models has one.

When it is wrong: a pedestal that is called a floor.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import BOX
from clinic.diagnosis.probes.overlap import tree_extent
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A floor that is smaller than the robot"
FAMILIES = ("falls-through",)
UNPLANTED = "how large a floor should be, only its maker knows"

FLOOR = re.compile(r"floor|ground", re.IGNORECASE)
ENOUGH = 10  # times what the robot reaches


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The floor that a robot steps off."""
    of = model.simulation
    for geom, reach in _narrow(of).items():
        half, name = of.row("geom_size", geom, 3), of.name("geom", geom)
        value = written([ENOUGH * reach, ENOUGH * reach, half[2]])
        says = f"{name} is {2 * min(half[:2]):.3g} m wide, and the robot reaches {reach:.3g} m from its root."
        probe = how_many("floors that are smaller than the robot", _narrow)
        edits = model.set("geom", [geom], "size", value)
        yield Suspect((name,), "size", written(half), value, edits, probe, 0, says, "larger than the robot")


def _narrow(of: Simulation) -> dict[int, float]:
    """The box called a floor whose edge a robot reaches from its middle, and how far the robot reaches in m."""
    welds = of.model("body_weldid")
    still = [geom for geom in range(of.count("geom")) if solid(of, geom) and not welds[of.body_of("geom", geom)]]
    floor = still[0] if len(still) == 1 else None
    if floor is None or int(of.model("geom_type")[floor]) != BOX or of.row("geom_quat", floor, 4)[0] != 1:
        return {}
    if not FLOOR.search(of.name("geom", floor)):
        return {}
    reach = max((tree_extent(of, root) for root in of.free_bodies if root in of.children), default=0.0)
    return {floor: reach} if reach > min(of.row("geom_size", floor, 3)[:2]) else {}
