"""A high `impratio` under pyramidal friction cones.

`impratio` above 1 makes friction harder than the normal force, so that what is grasped creeps less. With elliptic cones
it does that alone. Pyramidal ones, the default, have the normal force and friction in each row: creep is less there,
too, but not as little, and the contact itself gets harder than its `solref` and `solimp` say.

Bad:

    <mujoco>
      <option impratio="10"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <option impratio="10"/>
    +   <option impratio="10" cone="elliptic"/>

The number: `impratio` itself; up to 5 nothing is said. A box of 1 kg that rests on four corners sinks in by 0.10 mm,
and with pyramidal cones and 10 by 0.01 mm. The pin of `grasp-creeps` slides by 3.6 mm/s; with 10 it is 0.6 mm/s, and
0.2 mm/s with elliptic cones as well. MuJoCo's manual, XML reference, `option-impratio`: *it is not recommended to use
high impratio values with pyramidal cones.*

When it is wrong: a model that may have contacts as hard as that; so it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import PYRAMIDAL
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A high impratio under pyramidal cones"
FAMILIES = ("slips",)
MINOR = True
UNPLANTED = "what it does hangs on what is held, and most healthy models hold nothing"
MOST = 5.0


def _uneven(simulation: Simulation) -> float:
    return simulation.model("opt.impratio")[0] if simulation.model("opt.cone")[0] == PYRAMIDAL else 1.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The option, where the cone is pyramidal."""
    ratio = _uneven(model.simulation)
    if ratio > MOST:
        probe = Probe("impratio under pyramidal cones", "", _uneven, dynamic=False)
        says = (
            f"With pyramidal cones impratio {ratio:g} hardens the normal force as well, beyond solref and solimp, and "
        )
        says += "slows creep less than with elliptic ones."
        edits = model.option("cone", "elliptic", "option")
        yield Suspect(
            ("the friction cone",),
            "cone",
            "pyramidal",
            "elliptic",
            edits,
            probe,
            MOST,
            says,
            f"at most {MOST:g}",
            level="hint",
        )
