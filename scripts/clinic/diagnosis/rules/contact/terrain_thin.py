"""A height field is thin: what falls onto it fast goes through.

The fourth number of an hfield's `size` is how deep its solid base goes. What is deeper than that within a step is below
the terrain, where nothing pushes it up: a robot that is thrown or dropped sinks through the hills and falls for ever.

Bad:

    <mujoco>
      <asset>
        <hfield name="hills" nrow="4" ncol="4" size="2 2 0.05 0.001" elevation="0 1 0 1 1 0 1 0 0 1 0 1 1 0 1 0"/>
      </asset>
      <worldbody>
        <geom type="hfield" hfield="hills"/>
        <body pos="0 0 0.2">
          <freejoint/>
          <geom type="sphere" size="0.02" mass="0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <hfield name="hills" nrow="4" ncol="4" size="2 2 0.05 0.001" elevation="0 1 0 1 1 0 1 0 0 1 0 1 1 0 1 0"/>
    +     <hfield name="hills" nrow="4" ncol="4" size="2 2 0.05 1" elevation="0 1 0 1 1 0 1 0 0 1 0 1 1 0 1 0"/>

The number: how far a free body ends below the base of the terrain, 2 s after it was let go 4 m above its start, where a
base of 1 m stops it.

When it is wrong: nothing in the task is ever as fast as after a fall of 4 m, 9 m/s.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import HFIELD
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A terrain that is thin"
FAMILIES = ("falls-through",)
UNPLANTED = "few healthy models have a height field"

HIGH, SECONDS, DEEP = 4.0, 2.0, "1"  # m above the start; s; m of base that an edit gives


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The height fields with a shallow base, where a body that falls goes through one."""
    of, source = model.simulation, model.source
    fields = [geom for geom, kind in enumerate(of.model("geom_type")) if int(kind) == HFIELD]
    if source is None or source.urdf or len(fields) != 1 or not of.free_bodies or not of.gravity:
        return
    written = [each for each in source.elements("hfield") if len(each.get("size").split()) == 4]
    shallow = [each for each in written if float(each.get("size").split()[3]) < float(DEEP)]
    probe = Probe("below the terrain 2 s after a fall of 4 m", "m", _below)
    edits = tuple(set_attribute(each, "size", " ".join([*each.get("size").split()[:3], DEEP])) for each in shallow)
    if not shallow or model.measured(probe) <= 0 or model.measured(probe, edits) > 0:
        return  # what rolls off the edge falls beside any base
    now, value = shallow[0].get("size"), edits[0].value
    says = f"Its base is {shallow[0].get('size').split()[3]} m deep, and what falls from 4 m goes through it."
    names = (f'hfield "{shallow[0].get("name")}"', of.name("geom", fields[0]))
    yield Suspect(names, "size", now, value, edits, probe, 0.0, says, f"a base of {DEEP} m", at=shallow[0])


def _below(of: Simulation) -> float:
    """How far the first free body is below the base of the height field in m, 2 s after it was dropped."""
    (field,) = (geom for geom, kind in enumerate(of.model("geom_type")) if int(kind) == HFIELD)
    body = of.free_bodies[0]
    place = of.place(next(iter(of.joints_of(body)))) + 2
    of.begin()
    of.engine.write("qpos", [of.data("qpos")[place] + HIGH], place)
    for _ in of.run(SECONDS, samples=20):
        if of.unstable():
            return 0.0
    low = of.data_row("geom_xpos", field, 3)[2] - of.row("geom_size", field, 3)[2]
    return max(0.0, low - of.data_row("xpos", body, 3)[2])
