"""A plane is turned about its own normal, which tilts nothing.

A plane's normal is its z. A ramp that is turned about z, by the wrong axis of `euler` or the last number of `quat`, is
as level as before: what lies on it does not slide.

Bad:

    <mujoco>
      <worldbody>
        <geom name="ramp" type="plane" size="1 1 0.1" euler="0 0 30"/>
        <body pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="ramp" type="plane" size="1 1 0.1" euler="0 0 30"/>
    +     <geom name="ramp" type="plane" size="1 1 0.1" euler="0 30 0"/>

The number: the angle of the turn about the normal, where it is all that the plane is turned by, and no quarter of a
turn; of 289 healthy models none has such a plane without a `material`.

When it is wrong: a plane whose pattern or edges are meant to lie askew.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import ORIENTATIONS
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A plane turned about its own normal"
FAMILIES = ("stuck", "rolls-on", "slips", "wrong-numbers")
UNPLANTED = "nothing changes in a healthy model whose floor is turned about its normal"

LEAST, LEVEL_ENOUGH = 1.0, 1e-6  # degrees; of the quaternion


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Planes of the world with a turn about z alone."""
    of = model.simulation
    for geom, kind in enumerate(of.model("geom_type")):
        written = next((name for name in ORIENTATIONS if model.value("geom", geom, name)), None)
        patterned = of.model("geom_matid")[geom] >= 0 or of.model("geom_bodyid")[geom] > 0
        if int(kind) != PLANE or written is None or patterned or not solid(of, geom):
            continue
        quarters = _about_normal(of, geom) / 90
        if abs(quarters - round(quarters)) * 90 <= LEAST:
            continue  # not turned, or lying lengthwise
        says = f"It is turned by {_about_normal(of, geom):.3g} degrees about its normal, and is as level as without."
        probe = Probe("turn about the normal", "degrees", _about_normal, (geom,), dynamic=False)
        now = model.value("geom", geom, written) or ""
        yield Suspect((of.name("geom", geom),), written, now, "a turn about x or y", (), probe, LEAST, says)


def _about_normal(of: Simulation, geom: int) -> float:
    """The angle in degrees of a turn about z; 0 for any other turn."""
    w, x, y, z = of.row("geom_quat", geom, 4)
    return math.degrees(2 * math.atan2(abs(z), abs(w))) if math.hypot(x, y) < LEVEL_ENOUGH else 0.0
