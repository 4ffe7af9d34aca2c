"""Contacts are switched off for the whole model.

`<flag contact="disable"/>` is for benchmarks and for kinematics. With it everything falls through everything.

Bad:

    <mujoco>
      <option>
        <flag contact="disable"/>
      </option>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <option>
    -     <flag contact="disable"/>
    -   </option>

The number: how far the centre of a body ends below a surface that it began above, 2 s after letting go.

When it is wrong: something that is meant to pass.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import CONSTRAINTS_OFF, CONTACTS_OFF
from clinic.diagnosis.probes.fall import below, fallen, limit
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Contacts are switched off"
FAMILIES = ("falls-through",)

FLAGS = {CONTACTS_OFF: "contact", CONSTRAINTS_OFF: "constraint"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The flag, where something falls through something."""
    simulation = model.simulation
    bits = int(simulation.model("opt.disableflags")[0])
    if model.source is None:
        return
    for bit, name in FLAGS.items():
        written = [each for each in model.source.elements("flag") if each.get(name) == "disable"]
        if not bits & bit or not written:
            continue
        edits = tuple(set_attribute(each, name, "enable") for each in written)
        for root, surface in fallen(simulation)[:1]:
            says = f"The flag switches every {name} off."
            most = limit(simulation, root)
            yield Suspect(
                (f"the flag {name}", simulation.name("body", root)), name, "disable", "enable", edits,
                below(root, surface), most, says, excess=5.0,
            )  # fmt: skip
