"""A loop's equality is switched off.

`active="false"` was set while the chain was tried out, and stayed. Both ends meet at the start, as if it held; then the
last link swings freely, and what drives the loop moves nothing.

Bad:

    <mujoco>
      <worldbody>
        <body name="crank" pos="0 0 1">
          <joint name="crank" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.1" size="0.01"/>
          <body name="coupler" pos="0 0 0.1">
            <joint name="coupler" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01"/>
          </body>
        </body>
        <body name="rocker" pos="0.3 0 1">
          <joint name="rocker" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.1" size="0.01"/>
        </body>
      </worldbody>
      <equality>
        <connect name="loop" body1="coupler" body2="rocker" anchor="0.3 0 0" active="false"/>
      </equality>
    </mujoco>

Good:

    -     <connect name="loop" body1="coupler" body2="rocker" anchor="0.3 0 0" active="false"/>
    +     <connect name="loop" body1="coupler" body2="rocker" anchor="0.3 0 0" active="true"/>

The number: connections of two links, neither of which is free, that are off and closed to 1 mm at the start.

When it is wrong: a latch that code closes.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.equalities import CONNECT, by_mocap, gap, held, kind_of, sited
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A loop that is switched off"
FAMILIES = ("stuck", "drifts", "sags")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "the healthy models have few loops"

CLOSED = 1e-3  # m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each connection of a loop that is off."""
    of = model.simulation
    for each in range(of.count("equality")):
        if _open(of, each):
            name, edits = of.name("equality", each), model.set("equality", [each], "active", "true")
            probe = Probe("connections of a loop that are off", "", _open, (each,), dynamic=False)
            says = "It is off, and closed at the start, as if it held."
            yield Suspect((name,), "active", "false", "true", edits, probe, 0.5, says, "loops that hold")


def _open(of: Simulation, each: int) -> float:
    """1 where a connection is off that closes a loop of links, else 0."""
    if kind_of(of, each) != CONNECT or of.model("eq_active0")[each] or by_mocap(of, each):
        return 0.0
    owner, ends = root_of(of), held(of, each)
    bodies = [int(of.model("site_bodyid")[one]) if sited(of, each) else one for one in ends]
    free = {owner[body] for body in of.free_bodies}
    roots = [owner[body] for body in bodies]
    if not all(roots) or (roots[0] != roots[1] and free & {*roots}):
        return 0.0
    of.begin()
    return float((gap(of, each) or 0.0) < CLOSED)
