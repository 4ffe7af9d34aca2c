"""Contacts that throw things off: a negative `solref`, or the guard switched off.

A positive `solref` is a time constant, and MuJoCo keeps it above two timesteps. A negative one gives stiffness and
damping directly, without that guard: too stiff for the timestep, a contact gives back more energy than it takes, and
things leap. So does `<flag refsafe="disable"/>` with a short time constant.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.1">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05" solref="-900000 -10"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="box" type="box" size="0.05 0.05 0.05" solref="-900000 -10"/>
    +       <geom name="box" type="box" size="0.05 0.05 0.05"/>

The number: how high a body's centre rises above its start within 2 s after letting go, in sizes of the largest thing
that can leave its place; what is only let go does not rise by half its size.

When it is wrong: a spring or an actuator lifts it, and the contact's parameters happen to matter.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import REFSAFE_OFF
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.shape import falling, size, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Contacts that throw things off"
FAMILIES = ("jumps-at-start", "explodes", "oscillates")

MOST = 0.5  # sizes


def _leaps(simulation: Simulation) -> float:
    run = let_go(simulation)
    sizes = [size(simulation, root) for root in falling(simulation)]
    if run.end is None:
        return float("inf")
    return run.rise / max(sizes) if sizes and max(sizes) > 0 else 0.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Negative `solref`s of geoms, and the guard where it is off."""
    simulation = model.simulation
    probe = Probe("highest rise after letting go", "of its size", _leaps)
    solref = simulation.model("geom_solref")
    stiff = [i for i in range(simulation.count("geom")) if solid(simulation, i) and solref[2 * i] < 0]
    if stiff:
        names = tuple(simulation.name("geom", i) for i in stiff)
        now = f"{solref[2 * stiff[0]]:g} {solref[2 * stiff[0] + 1]:g}"
        says = "A negative solref is stiffness and damping, and nothing keeps them below what the timestep can follow."
        edits = model.set("geom", stiff, "solref", "0.02 1")
        yield Suspect(names, "solref", now, "0.02 1", edits, probe, MOST, says, "0.02 1, MuJoCo's default", excess=2.0)
    if int(simulation.model("opt.disableflags")[0]) & REFSAFE_OFF and model.source is not None:
        flags = [each for each in model.source.elements("flag") if each.get("refsafe") == "disable"]
        edits = tuple(set_attribute(each, "refsafe", "enable") for each in flags)
        says = "The guard that keeps a contact's time constant above two timesteps is off."
        yield Suspect(("the flag refsafe",), "refsafe", "disable", "enable", edits, probe, MOST, says, excess=3.0)
