"""The air is as dense as water, or as viscous as honey.

`density` and `viscosity` of `<option>` make a medium that holds everything back. Air has 1.2 kg/m3 and 0.00002 Pa s,
water 1000 kg/m3 and 0.0009 Pa s.

Bad:

    <mujoco>
      <option density="5000"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <option density="5000"/>
    +   <option density="1.2"/>

The number: what the medium holds back of something that falls at the speed of a fall over its own size, as a share of
its weight; below 0.1 is well. A little viscosity is a usual way to bring what dangles to rest.

When it is wrong: a swimmer or a boat. What cannot fall, or has no gravity, is left alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import GRAVITY_OFF
from clinic.diagnosis.probes.shape import falling, size
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A medium that holds everything back"
FAMILIES = ("slow", "stuck", "drifts")
SINCE = "0.1"

MOST = 0.1  # of the weight


def _held_back(simulation: Simulation) -> float:
    simulation.begin()
    g = math.hypot(*simulation.model("opt.gravity"))
    falls = falling(simulation)
    for root, dof in falls.items():
        simulation.engine.write("qvel", [-math.sqrt(g * max(size(simulation, root), 1e-3))], dof)
    simulation.engine.forward()
    drag, masses = simulation.data("qfrc_fluid"), simulation.model("body_subtreemass")
    return max((abs(drag[dof]) / max(g * masses[root], 1e-12) for root, dof in falls.items()), default=0.0)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The medium, where something can fall in it."""
    simulation = model.simulation
    if not any(simulation.model("opt.gravity")) or int(simulation.model("opt.disableflags")[0]) & GRAVITY_OFF:
        return
    probe = Probe("drag of a fall", "of the weight", _held_back, dynamic=False)
    for name, usual, most, unit in (("density", 1.2, 6.0, "kg/m3"), ("viscosity", 0.00002, 0.01, "Pa s")):
        now = simulation.model(f"opt.{name}")[0]
        if now > most:
            says = f"The medium has {now:g} {unit}; air has {usual:g}."
            edits = model.option(name, f"{usual:g}")
            yield Suspect((name,), name, f"{now:g}", f"{usual:g}", edits, probe, MOST, says, f"{usual:g} {unit}, air")
