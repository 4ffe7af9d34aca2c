"""The time constant of a contact is far below two timesteps.

`solref="0.0000001 1"` asks for a contact that is over within a small part of a step. MuJoCo averages it with that of a
geom of equal `priority`, and computes with no less than two timesteps (its guard `refsafe`). Without the guard the
model may explode.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 0.1">
          <freejoint/>
          <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" solref="0.0000001 1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" solref="0.0000001 1"/>
    +       <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" solref="0.02 1"/>

The number: two timesteps over the time constant; more than 10.

When it is wrong: somebody wants the stiffest contact that there is, and knows that it is two timesteps. With `refsafe`
off, or the integrator `discrete`, nothing is told.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import IMPLICITFAST, REFSAFE_OFF
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A solref that no timestep can follow"
FAMILIES = ("oscillates", "explodes", "jumps-at-start")
UNPLANTED = "the guard keeps it from doing harm in most models"

MOST = 10.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The colliding geoms with such a time constant, all together."""
    of = model.simulation
    short = tuple(geom for geom in range(of.count("geom")) if solid(of, geom) and _ratio(of, geom) > MOST)
    guarded = not int(of.model("opt.disableflags")[0]) & REFSAFE_OFF
    if not short or not guarded or of.model("opt.integrator")[0] > IMPLICITFAST:  # `discrete` follows any
        return
    now = " ".join(f"{x:g}" for x in of.row("geom_solref", short[0], 2))
    says = f"Two timesteps are {2 * of.timestep:g} s, and MuJoCo computes with no less."
    probe = Probe("two timesteps over the time constant", "", _ratio, short, dynamic=False)
    value = f"{max(0.02, 2 * of.timestep):g} 1"
    edits = model.set("geom", short, "solref", value)
    names = tuple(of.name("geom", geom) for geom in short)
    yield Suspect(names, "solref", now, value, edits, probe, MOST, says, "0.02 1, MuJoCo's default")


def _ratio(of: Simulation, *geoms: int) -> float:
    solref = of.model("geom_solref")
    return max(2 * of.timestep / solref[2 * geom] if solref[2 * geom] > 0 else 0.0 for geom in geoms)
