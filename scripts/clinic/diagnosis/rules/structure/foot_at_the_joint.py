"""A foot is at the joint of its link, not at the other end.

A geom without a `pos` is at its body's origin, where the joint of a shin is: the knee. The foot is inside the link
there, and the link's bare end touches the floor.

Bad:

    <mujoco>
      <worldbody>
        <body name="shin" pos="0 0 1">
          <joint name="knee" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="0.5"/>
          <geom name="foot" size="0.04" mass="0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="foot" size="0.04" mass="0.1"/>
    +       <geom name="foot" size="0.04" pos="0 0 -0.3" mass="0.1"/>

The number: the geoms called a foot, toe, paw, hoof or tip that are at the origin of a body without children, from which
a rod of the same body leads away. None of 206 healthy models has one.

When it is wrong: a tip at which the rod behind it ends.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.probes.shape import rods
from clinic.diagnosis.probes.vector import Vector, norm, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A foot at the joint of its link"
FAMILIES = ("slips", "sinks", "jumps-at-start")
UNPLANTED = "where a foot belongs, only its name tells"

END = re.compile(r"foot|feet|toe|paw|hoof|tip(?![a-z])", re.IGNORECASE)
NEAR = 0.05  # of the rod's length


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each foot that could be at the end of its link."""
    of = model.simulation
    for geom, end in _feet(of).items():
        now, value, name = written(of.row("geom_pos", geom, 3)), written(end), of.name("geom", geom)
        says = f"{name} is at the origin of its link, whose other end is {norm(end):.3g} m away."
        edits = model.set("geom", [geom], "pos", value)
        yield Suspect((name,), "pos", now, value, edits, how_many("feet at their joint", _feet), 0, says, "at the end")


def _feet(of: Simulation) -> dict[int, Vector]:
    """The feet that are at the origin of their link, and where that ends."""
    made = {}
    for body in of.moving_bodies:
        for rod, end in rods(of, body)[-1:] if body not in of.children and of.joints_of(body) else ():
            for geom in of.geoms_of(body):
                away = norm(of.row("geom_pos", geom, 3))
                if geom != rod and away < NEAR * norm(end) and END.search(of.name("geom", geom)):
                    made[geom] = end
    return made
