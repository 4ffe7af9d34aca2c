"""A slippery geom is not slippery: what it touches has more friction, and MuJoCo takes the larger of the two.

The friction of a contact is that of the geom with the higher `priority`; with equal ones it is the larger number. So
`friction="0"` on a block alone changes nothing on a floor that has MuJoCo's default of 1, nor does a slippery floor
below a block that has the default.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="2 2 0.1"/>
        <body name="puck" pos="0 0 0.02">
          <freejoint/>
          <geom type="cylinder" size="0.05 0.02" mass="0.1" friction="0.15"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom type="cylinder" size="0.05 0.02" mass="0.1" friction="0.15"/>
    +       <geom type="cylinder" size="0.05 0.02" mass="0.1" friction="0.15" priority="1"/>

The number: the least sliding friction of the contacts on which the geom rests after 2 s, over its own, above 4; told of
frictions up to 0.2. MuJoCo's manual, Modeling, Contact parameters: the element-wise maximum.

When it is wrong: a geom that is slippery against others, which it does not touch here.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import OVERRIDE_ON
from clinic.diagnosis.probes.touch import resting
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A friction that the other geom overrules"
FAMILIES = ("stuck", "slips", "wrong-numbers")
UNPLANTED = "how slippery it is to be, only intent knows"

SLIPPERY, TIMES, LEAST = 0.2, 4.0, 1e-3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The slippery geoms that touch only what is not, all together."""
    of = model.simulation
    found = [geom for geom in _felt(of) if _over(of, geom) > TIMES]
    if not found:
        return
    felt = _felt(of)[found[0]]
    now = f"{of.model('geom_friction')[3 * found[0]]:g}"
    says = f"Its contacts have a friction of {felt:g}: the larger of the two counts, where none has a higher priority."
    probe = Probe("friction of its contacts over its own", "", _over, (found[0],))
    names = tuple(of.name("geom", geom) for geom in found)
    edits = model.set("geom", found, "priority", "1")
    yield Suspect(names, "priority", "0", "1", edits, probe, TIMES, f"friction {now}: {says}", "1", level="hint")


def _over(of: Simulation, geom: int) -> float:
    """The friction that a geom feels over its own."""
    return _felt(of).get(geom, 0.0) / max(of.model("geom_friction")[3 * geom], LEAST)


@kept
def _felt(of: Simulation) -> dict[int, float]:
    """The least friction of the contacts that each slippery geom rests on."""
    friction, made = of.model("geom_friction")[::3], dict[int, float]()
    if int(of.model("opt.enableflags")[0]) & OVERRIDE_ON:
        return made
    for contact, decides in resting(of):
        for geom in contact.geoms if decides.dim > 1 else ():
            if geom >= 0 and friction[geom] <= SLIPPERY:
                made[geom] = min(made.get(geom, decides.friction), decides.friction)
    return made
