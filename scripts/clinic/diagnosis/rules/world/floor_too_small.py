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

The number: how many boxes of the world that are called a floor or the ground are narrower than a robot over them is in
its longest direction, where nothing wider is in the world. None of 206 healthy models has one.

When it is wrong: a pedestal that is called a floor.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import BOX, HFIELD, MESH, PLANE
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
        half = of.row("geom_size", geom, 3)
        value, name = written([ENOUGH * size, ENOUGH * size, half[2]]), of.name("geom", geom)
        says = f"{name} is {2 * min(half[:2]):.3g} m wide, and the robot over it {size:.3g} m long: it steps off."
        probe, edits = (
            how_many("floors that are smaller than the robot", _narrow),
            model.set("geom", [geom], "size", value),
        )
        yield Suspect((name,), "size", written(half), value, edits, probe, 0, says, "larger than the robot")


def _narrow(of: Simulation) -> dict[int, float]:
    """The boxes called a floor that are narrower than a robot over them, and how long that is in m."""
    of.begin()
    kinds, still = of.model("geom_type"), of.model("body_weldid")
    grounds = [g for g in range(of.count("geom")) if solid(of, g) and still[of.body_of("geom", g)] == 0]
    if any(int(kinds[each]) in (PLANE, HFIELD, MESH) for each in grounds):
        return {}
    made, free = dict[int, float](), {root: all_ for root, all_ in mechanisms(of).items() if root in of.free_bodies}
    for geom in grounds:
        if int(kinds[geom]) != BOX or not FLOOR.search(of.name("geom", geom)) or of.row("geom_quat", geom, 4)[0] != 1:
            continue
        width = 2 * min(of.row("geom_size", geom, 3)[:2])
        for root, geoms in free.items():
            long = _longest(list(boxes(of, geoms).values()))
            if root in of.children and width < long and len(grounds) == 1:
                made[geom] = max(long, made.get(geom, 0.0))
    return made


def _longest(around: list[tuple[Vector, Vector]]) -> float:
    """The longest side of the box around some boxes, in m."""
    return max(
        max(at[i] + half[i] for at, half in around) - min(at[i] - half[i] for at, half in around) for i in range(3)
    )
