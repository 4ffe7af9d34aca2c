"""A sensor measures a frame in itself, or in one that is fixed to it.

`reftype` and `refname` say in which frame a position, an orientation or a velocity is measured. Where that is the frame
itself, or another one of the same body, the reading is the same for ever: 0 for a velocity, and for the place of a
frame in itself. It is a copied name; or it was to give a velocity along the body's own axes, which `<velocimeter>` and
`<gyro>` do.

Bad:

    <mujoco>
      <worldbody>
        <body name="base" pos="0 0 1">
          <geom type="box" size="0.1 0.1 0.05"/>
          <site name="mount"/>
          <body name="arm" pos="0 0 0.1">
            <joint axis="0 0 1"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
            <site name="tip" pos="0.3 0 0"/>
          </body>
        </body>
      </worldbody>
      <sensor>
        <framepos name="tip_pos" objtype="site" objname="tip" reftype="site" refname="tip"/>
      </sensor>
    </mujoco>

Good:

    -     <framepos name="tip_pos" objtype="site" objname="tip" reftype="site" refname="tip"/>
    +     <framepos name="tip_pos" objtype="site" objname="tip" reftype="site" refname="mount"/>

The number: sensors of a frame whose reference no joint moves against it. The edit takes the reference off, so that the
sensor reads in the world.

When it is wrong: where a camera or a site is on its body is to be read with all else.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.attached import OBJECTS, attached
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A sensor that measures a frame in itself"
FAMILIES = ("sensor-reads-zero", "wrong-numbers")
UNPLANTED = "few healthy models measure one frame in another"

BODIES = {"geom": "geom_bodyid", "site": "site_bodyid", "camera": "cam_bodyid"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor of a frame that nothing moves in its reference."""
    of = model.simulation
    for sensor, (name, reference) in _constant(of).items():
        element = model.element("sensor", sensor)
        parts = [each for each in ("reftype", "refname") if element is not None and element.get(each)]
        edits: tuple[Edit, ...] = tuple(edit for each in parts for edit in model.remove("sensor", [sensor], each))
        says = f"It measures {name} in {'itself' if reference == name else reference + ', which is fixed to it'}."
        names = tuple(dict.fromkeys((of.name("sensor", sensor), name, reference)))
        probe = how_many("sensors of a frame in itself", _constant)
        now = reference.partition(" ")[2].strip('"')
        yield Suspect(names, "refname", now, "left out", edits, probe, 0, says, "a frame that it moves in")


def _constant(of: Simulation) -> dict[int, tuple[str, str]]:
    """By sensor with a reference that no joint moves against its object: the two, as they are told."""
    made = {}
    for sensor, reference in enumerate(of.model("sensor_reftype")):
        kind, found = OBJECTS.get(int(reference), ""), attached(of, "sensor", sensor)
        if found is None or not kind:
            continue
        pair = (found, (kind, int(of.model("sensor_refid")[sensor])))
        bodies = {_carrier(of, *each) for each in pair}
        if len(bodies) == 1:
            made[sensor] = (of.name(*pair[0]), of.name(*pair[1]))
    return made


def _carrier(of: Simulation, kind: str, index: int) -> int:
    """The body that a frame is fixed to, with all below which no joint moves; a mocap body is one of its own."""
    body = index if kind == "body" else int(of.model(BODIES[kind])[index])
    moved = int(of.model("body_rootid")[body])
    return moved if of.model("body_mocapid")[moved] >= 0 else int(of.model("body_weldid")[body])
