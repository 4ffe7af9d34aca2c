"""Two parts that are alike stand in one place.

A second finger, box or wheel is a copy of the first one with the same `pos` (in a URDF: the same `origin`), or hangs on
the other side's parent: one is inside of the other.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 0.5">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body name="left_finger" pos="0 0 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
          <body name="right_finger" pos="0 0 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <body name="left_finger" pos="0 0 0.05">
    +       <body name="left_finger" pos="0 0.005 0.05">

    -       <body name="right_finger" pos="0 0 0.05">
    +       <body name="right_finger" pos="0 -0.005 0.05">

The number: groups of moving bodies, none of which hangs on another, that begin with all their solid geoms in the same
places, of the same kinds and sizes, and touch. Of 499 healthy models none has one.

When it is wrong: parts that are meant to start in one place.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.vector import at
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "Two parts in one place"
FAMILIES = ("jumps-at-start", "stuck", "slips")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "fingers of healthy models that are put in one place are told as overlapping"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each group of parts in one place."""
    of = model.simulation
    for bodies in _together(of):
        names = tuple(of.name("body", body) for body in bodies)
        says = f"{names[0]} and {names[1]} begin in the same place, and have the same shape."
        now = " ".join(f"{x:.4g}" for x in of.row("body_pos", bodies[0], 3))
        probe = how_many("groups of parts in one place", _together)
        yield Suspect(names, "pos", now, "apart from each other", (), probe, 0.1, says, "none")


def _together(of: Simulation) -> list[list[int]]:
    """Bodies with joints that stand in one place with the same solid geoms at the start, and touch."""
    of.begin()
    places, owners = tuple(of.data("geom_xpos")), of.model("geom_bodyid")
    touching = {frozenset(int(owners[geom]) for geom in each.geoms if geom >= 0) for each in of.engine.contacts()}
    groups: dict[tuple[float, ...], list[int]] = {}
    for body in of.moving_bodies:
        key: list[float] = []
        for geom in of.geoms_of(body) if of.joints_of(body) else ():
            if solid(of, geom):
                key += [round(x, 4) for x in at(places, geom)]
                key += [round(x, 3) + 0.0 for x in of.data_row("geom_xmat", geom, 9)]
                key += [of.model("geom_type")[geom], *(round(x, 6) for x in of.row("geom_size", geom, 3))]
        if key:
            groups.setdefault(tuple(key), []).append(body)
    return [bodies for bodies in groups.values() if any({*pair} in touching for pair in combinations(bodies, 2))]
