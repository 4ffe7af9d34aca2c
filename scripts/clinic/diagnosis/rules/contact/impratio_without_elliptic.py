"""A high `impratio` under pyramidal friction cones.

`impratio` above 1 makes friction harder than the normal force, so that what is grasped creeps less. It is defined by
elliptic cones; with pyramidal ones, the default, the manual does not recommend it: normal and friction are mixed in
each row, and contacts become hard and uneven instead.

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

The number: `impratio` itself, with the cone that it needs. MuJoCo's manual, XML reference, `option-impratio`: *it is
not recommended to use high impratio values with pyramidal cones.*

When it is wrong: a model that nothing is held in; so it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A high impratio under pyramidal cones"
FAMILIES = ("slips",)
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "what it does hangs on what is held, and most healthy models hold nothing"
MOST = 1.0


def _uneven(simulation: Simulation) -> float:
    return simulation.model("opt.impratio")[0] if simulation.model("opt.cone")[0] == 0 else 1.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The option, where the cone is pyramidal."""
    ratio = _uneven(model.simulation)
    if ratio > MOST:
        probe = Probe("impratio under pyramidal cones", "", _uneven, dynamic=False)
        says = f'impratio {ratio:g} is defined by cone="elliptic", and this model has pyramidal cones.'
        edits = model.option("cone", "elliptic", "option")
        yield Suspect(
            ("the friction cone",), "cone", "pyramidal", "elliptic", edits, probe, MOST, says, "1", level="hint"
        )
