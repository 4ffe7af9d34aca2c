"""One geom is larger than all the rest of its mechanism together.

A radius in centimetres or millimetres, a decimal point that was lost: the robot is inside of one of its own geoms,
which may weigh tonnes and stand in the floor.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 20">
          <joint axis="0 1 0"/>
          <geom name="upper" type="capsule" fromto="0 0 0 0 0 0.3" size="0.03"/>
          <body name="fore" pos="0 0 0.3">
            <joint axis="0 1 0"/>
            <geom name="fore" type="capsule" fromto="0 0 0 0 0 0.3" size="3"/>
            <body name="hand" pos="0 0 0.3">
              <joint axis="0 1 0"/>
              <geom name="palm" type="box" size="0.03 0.03 0.01"/>
              <geom name="finger" type="box" size="0.01 0.01 0.03" pos="0 0 0.04"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <geom name="fore" type="capsule" fromto="0 0 0 0 0 0.3" size="3"/>
    +         <geom name="fore" type="capsule" fromto="0 0 0 0 0 0.3" size="0.03"/>

The number: the smallest extent of a geom that is no mesh over the size of the box around all others of its mechanism,
which are three at least; more than 2.

When it is wrong: a large ball with small things on it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.shape import mechanisms, thickness
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A geom larger than all the rest"
FAMILIES = ("jumps-at-start", "stuck", "wrong-mass", "explodes")
AFLOAT = True
UNPLANTED = "how large a geom should be, only its maker knows"

LARGE, ENOUGH = 2.0, 3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The geom that is out of scale, mechanism by mechanism."""
    of = model.simulation
    of.begin()
    for geoms in mechanisms(of).values():
        geom = max(geoms, key=lambda each: thickness(of, each))
        if (
            len(geoms) <= ENOUGH
            or int(of.model("geom_type")[geom]) == MESH
            or (times := _beside(of, geom, geoms)) <= LARGE
        ):
            continue
        others = sorted(thickness(of, each) for each in geoms if each != geom)
        scale = 10.0 ** -round(math.log10(thickness(of, geom) / others[len(others) // 2]))
        now = model.value("geom", geom, "size") or ""
        value = written([scale * x if 2 * x > thickness(of, geom) / times else x for x in map(float, now.split())])
        edits = model.set("geom", [geom], "size", value) if value else ()
        says = (
            f"It is {times:.3g} times as thick as the box around the {len(others)} others of its mechanism is across."
        )
        probe = Probe("a geom's thickness", "of the box around the others", _times, (geom,), dynamic=False)
        yield Suspect((of.name("geom", geom),), "size", now, value, edits, probe, LARGE, says, "below 2")


def _times(of: Simulation, geom: int) -> float:
    """The smallest extent of a geom over the size of the box around the others of its mechanism."""
    of.begin()
    return _beside(of, geom, next(geoms for geoms in mechanisms(of).values() if geom in geoms))


def _beside(of: Simulation, geom: int, geoms: list[int]) -> float:
    others = [(of.data_row("geom_xpos", each, 3), of.model("geom_rbound")[each]) for each in geoms if each != geom]
    sides = [
        max(place[axis] + radius for place, radius in others) - min(place[axis] - radius for place, radius in others)
        for axis in range(3)
    ]
    return thickness(of, geom) / math.hypot(*sides) if any(sides) else 0.0
