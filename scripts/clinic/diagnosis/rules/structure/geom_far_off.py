"""A geom lies far away from the rest of its mechanism.

A mesh in millimetres, a point where a comma was typed, an `origin` that was never set: one part floats metres away from
the robot. It hits things that are nowhere near, and whoever plans around it finds no way.

Bad:

    <mujoco>
      <worldbody>
        <body name="base" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.05"/>
          <geom name="bumper" size="0.03" pos="-19.4 0 15.5"/>
          <body name="arm" pos="0 0 0.1">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="base" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.05"/>
          <geom name="bumper" size="0.03" pos="-0.12 0 0"/>
          <body name="arm" pos="0 0 0.1">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

The number: how far the geom's middle is from the nearest other geom of its mechanism at the start, in sizes of the box
around all the others; more than 3.

When it is wrong: two things of one mechanism that are meant to be far apart.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HFIELD, PLANE
from clinic.diagnosis.probes.shape import geoms_of_tree, roots
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A geom far away from the rest"
FAMILIES = ("jumps-at-start", "drifts", "stuck")
SINCE = "0.2"
AFLOAT = True
LEVEL = "hint"
UNPLANTED = "what is far away harms by what happens to be there"

FAR, ENOUGH = 3.0, 3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms that no other of their mechanism is near."""
    of = model.simulation
    for root in [*roots(of), 0]:
        for geom in _geoms(of, root):
            far = _far(of, root, geom)
            if far > FAR:
                probe = Probe("distance from the rest", "of its size", _far, (root, geom), dynamic=False)
                where = of.row("geom_pos", geom, 3)
                says = f"Its middle is {far:.3g} times as far away as all others of its mechanism together are large."
                now = " ".join(f"{x:.4g}" for x in where)
                yield Suspect((of.name("geom", geom),), "pos", now, "near its body", (), probe, FAR, says, "below 3")


def _geoms(of: Simulation, root: int) -> list[int]:
    """Those of a mechanism, or of what is fixed to the world, that have an end."""
    geoms = geoms_of_tree(of, root) if root else _fixed(of)
    kinds = of.model("geom_type")
    found = [geom for geom in geoms if int(kinds[geom]) not in (PLANE, HFIELD)]
    return found if len(found) > ENOUGH - 1 else []


def _fixed(of: Simulation) -> list[int]:
    """The geoms of the world itself, where a robot is all that there is; scenery may stand anywhere."""
    return [] if roots(of) else [*of.geoms_of(0)]


def _far(of: Simulation, root: int, geom: int) -> float:
    of.begin()
    places = {each: of.data_row("geom_xpos", each, 3) for each in _geoms(of, root)}
    others = [place for each, place in places.items() if each != geom]
    sides = [max(axis) - min(axis) for axis in zip(*others, strict=True)]
    size = math.hypot(*sides) + 2 * max(of.model("geom_rbound")[each] for each in places if each != geom)
    return min(math.dist(places[geom], place) for place in others) / size if size > 0 else 0.0
