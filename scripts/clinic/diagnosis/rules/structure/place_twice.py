"""A body's place is written again for its geoms, and counts twice.

A geom's `pos` is in the frame of its body, and the `<origin>` of a URDF's visual or collision in that of its link.
Where a file was made from another format, or by hand, the place of the body in its parent stands in both: the part is
twice as far away.

Bad:

    <mujoco>
      <worldbody>
        <body name="base" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.05"/>
          <body name="camera" pos="0.08 0 0.09">
            <geom type="box" size="0.01 0.03 0.01" pos="0.08 0 0.09"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <geom type="box" size="0.01 0.03 0.01" pos="0.08 0 0.09"/>
    +         <geom type="box" size="0.01 0.03 0.01" pos="0 0 0"/>

The number: bodies 2 cm or more from their parent, with two or three coordinates that are not 0, all of whose geoms have
that very place as their `pos`.

When it is wrong: equal steps of a chain that are written so.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.vector import Vector, norm, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A place that is written twice"
FAMILIES = ("wrong-numbers", "jumps-at-start", "stuck")
AFLOAT = True
UNPLANTED = "no healthy model has a geom at the place of its body"

AWAY, SAME = 0.02, 1e-6  # m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies whose geoms stand where they themselves do in their parents, all together."""
    of = model.simulation
    found = [body for body in range(1, of.count("body")) if _twice(model, body)]
    if not found:
        return
    geoms = [geom for body in found for geom in of.geoms_of(body)]
    now = written(of.row("body_pos", found[0], 3))
    says = f"{of.name('body', found[0])} is at {now} in its parent, and its geoms again at {now}."
    names = tuple(of.name(kind, each) for kind, some in (("body", found), ("geom", geoms)) for each in some)
    probe = counted("bodies whose geoms have their place again", len(found))
    edits = model.set("geom", geoms, "pos", "0 0 0")
    yield Suspect(names, "pos", now, "0 0 0", edits, probe, 0.5, says, "in the frame of the body")


def _twice(model: ReaderModel, body: int) -> bool:
    of = model.simulation
    place, geoms = of.row("body_pos", body, 3), of.geoms_of(body)
    if norm(place) < AWAY or sum(map(bool, place)) < 2 or any(model.value("geom", geom, "fromto") for geom in geoms):
        return False
    return bool(geoms) and all(_again(model, geom, place) for geom in geoms)


def _again(model: ReaderModel, geom: int, place: Vector) -> bool:
    """Whether a place is that of a geom as it is written; a mesh's own centre puts it elsewhere."""
    of, said = model.simulation, model.value("geom", geom, "pos")
    if said is None and int(of.model("geom_type")[geom]) == MESH:
        return False
    try:
        at = [float(each) for each in said.split()] if said else of.row("geom_pos", geom, 3)
    except ValueError:
        return False
    return len(at) == len(place) and all(abs(a - b) < SAME for a, b in zip(at, place, strict=True))
