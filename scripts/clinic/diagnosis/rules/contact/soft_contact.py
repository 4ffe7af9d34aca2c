"""Contacts so soft that things sink in.

A contact is a damped spring: `solref` has its time constant and damping ratio, `solimp` how much of it acts. A time
constant of 0.2 s in place of 0.02 s, or an impedance of 0.1 in place of 0.9, lets things sink in by a part of their
size.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05" solref="1 1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

The number: the deepest contact 2 s after letting go as a share of the thinner geom's thickness; below 0.15 is well.
With the default values a box at rest sinks in by 0.1 mm.

When it is wrong: a cushion.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.touch import depth, edits_of, names_of, resting
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Contacts too soft"
FAMILIES = ("sinks", "falls-through", "slips")
SINCE = "0.2"

MOST = 0.15  # of the thinner geom's thickness
SOLREF, SOLIMP = (0.02, 1.0), (0.9, 0.95, 0.001, 0.5, 2.0)  # MuJoCo's defaults


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """`solref` and `solimp`, where they are softer than the default, of what decides deep contacts."""
    simulation = model.simulation
    if model.measured(depth()) <= MOST:
        return
    rests = [decides for _, decides in resting(simulation)]
    soft, weak, least, longest = [], [], 1.0, 0.0
    for each in rests:
        for index in each.elements:
            time, damping = simulation.row(f"{each.kind}_solref", index, 2)
            impedance = simulation.row(f"{each.kind}_solimp", index, 5)
            if time * damping > 1.5 * SOLREF[0] or -400 < time < 0:
                soft.append(each)
                longest = max(longest, time) if time > 0 else time
            if impedance[1] < 0.5:
                weak.append(each)
                least = min(least, impedance[1])
    for found, attribute, now, value, excess in (
        (soft, "solref", f"{longest:g}", "0.02 1", abs(longest) / SOLREF[0]),
        (weak, "solimp", f"{least:g}", "0.9 0.95 0.001", SOLIMP[0] / max(least, 1e-3)),
    ):
        if found:
            says = f"{attribute} lets the contact give way: {now} beside MuJoCo's default {value}."
            edits = edits_of(model, found, attribute, value)
            yield Suspect(
                names_of(simulation, found), attribute, now, value, edits, depth(), MOST, says,
                f"{value}, MuJoCo's default", excess=excess,
            )  # fmt: skip
