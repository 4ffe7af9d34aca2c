"""An `<exclude>` forbids a contact that is needed.

`<exclude>` takes two bodies out of collision detection altogether. It is meant for relatives that overlap; between a
robot or an object and the world, it takes the floor away.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
      <contact>
        <exclude body1="world" body2="box"/>
      </contact>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

The number: how far the centre of a body ends below a surface that it began above, 2 s after letting go.

When it is wrong: something that is meant to pass.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.probes.fall import below, fallen, limit
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "An exclude that forbids a contact that is needed"
FAMILIES = ("falls-through",)
SINCE = "0.1"
UNPLANTED = "in the healthy models several bodies touch the floor: one exclusion drops nothing through it"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The excludes between what falls and what it falls through."""
    simulation, owner = model.simulation, root_of(model.simulation)
    names = ["world", *simulation.names("body")[1:]]
    if model.source is None:
        return
    written = [each for each in model.source.section("contact") if each.tag == "exclude"]
    for root, surface in fallen(simulation):
        body = int(simulation.model("geom_bodyid")[surface])
        meant = []
        for each in written:
            bodies = {names.index(each.get(side)) for side in ("body1", "body2") if each.get(side) in names}
            if body in bodies and any(owner[other] == root for other in bodies):
                meant.append(each)
        if meant:
            most, says = limit(simulation, root), "The pair is taken out of collision detection."
            yield Suspect(
                (simulation.name("body", root), simulation.name("body", body)), "exclude", "there", "removed",
                tuple(map(delete, meant)), below(root, surface), most, says, excess=4.0,
            )  # fmt: skip
