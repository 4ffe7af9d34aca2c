"""Friction too large for the pyramidal cone: things sink in.

With the pyramidal cone, the default, a contact is the softer the larger its `friction` is: with 8 a box sinks in 15
times as deep as with 4. With the elliptic cone the depth does not depend on it.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1" friction="8"/>
        <body name="box" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1" mass="2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="floor" type="plane" size="1 1 0.1" friction="8"/>
    +     <geom name="floor" type="plane" size="1 1 0.1" friction="1"/>

The number: the deepest contact 2 s after letting go as a share of the thinner geom's thickness; below 0.04 is well.
Friction above 3 is tried. Measured with a box of 0.2 m in 4 s: 0.1 mm with friction 1, 6.7 mm with 4, 102 mm with 8.

When it is wrong: a contact that is deep for another reason, such as `solref`; the edit that helps more is named.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import ELLIPTIC
from clinic.diagnosis.probes.touch import DRY, depth, edits_of, names_of, resting, with_like
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Friction beyond the pyramidal cone"
FAMILIES = ("sinks", "falls-through")
CASE = "box-sinks-into-floor"

HIGH, MOST = 3.0, 0.04


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What decides the contacts that carry something with friction above 3, where the cone is pyramidal."""
    simulation = model.simulation
    high = [decides for _, decides in resting(simulation) if decides.dim > 1 and decides.friction > HIGH]
    if not high or int(simulation.model("opt.cone")[0]) == ELLIPTIC:
        return
    frictions = simulation.model("geom_friction")
    most = max(each.friction for each in high)
    says = f"With the pyramidal cone, friction {most:g} makes the contact so soft that things sink in."
    high = with_like(simulation, high, lambda geom: frictions[3 * geom] > HIGH)
    edits = edits_of(model, high, "friction", DRY)
    yield Suspect(
        names_of(simulation, high), "friction", f"{most:g}", "1", edits, depth(), MOST, says,
        'at most 3, or <option cone="elliptic"/>', excess=most / HIGH,
    )  # fmt: skip
