"""A box stands half in the ground: its size has full lengths.

The `size` of a box, and the second one of a cylinder, are half lengths in MuJoCo. Written in full, a box that was
meant to stand on the floor is twice as large, and a quarter of it is below the floor.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <geom name="step" type="box" size="0.3 1.2 0.1" pos="0.65 0 0.05"/>
        <body pos="0 0 1">
          <freejoint/>
          <geom size="0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="step" type="box" size="0.3 1.2 0.1" pos="0.65 0 0.05"/>
    +     <geom name="step" type="box" size="0.15 0.6 0.05" pos="0.65 0 0.05"/>

The number: upright boxes and cylinders whose middle is as high above a plane, or above the box that they stand on, as a
half of their half height: with half the size they would stand on it.

When it is wrong: a box that is to be sunk by exactly so much.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import CYLINDER
from clinic.diagnosis.probes.overlap import sunk_by_half
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A size with full lengths"
FAMILIES = ("jumps-at-start", "explodes", "wrong-numbers")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "how large a box should be, only its maker knows"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All boxes and cylinders that would stand on something with half their size."""
    of = model.simulation
    of.begin()
    found = [geom for geom in range(of.count("geom")) if sunk_by_half(of, geom)]
    placed = [(geom, element) for geom in found if (element := model.element("geom", geom)) is not None]
    placed = [(geom, element) for geom, element in placed if element.get("size") and not element.get("fromto")]
    if not placed:
        return
    edits, names = [], tuple(of.name("geom", geom) for geom, _ in placed)
    for geom, element in placed:
        sizes = [float(word) for word in element.get("size").split()]
        round_ = int(of.model("geom_type")[geom]) == CYLINDER
        halves = [size if round_ and not index else size / 2 for index, size in enumerate(sizes)]
        edits.append(set_attribute(element, "size", " ".join(f"{size:.6g}" for size in halves)))
    says = "A size is half a length, and with half of it it would stand on what it is sunk into."
    now, probe = placed[0][1].get("size"), counted("boxes that are sunk by half their half height", len(placed))
    yield Suspect(names, "size", now, edits[0].value, tuple(edits), probe, 0.5, says, "half lengths")
