"""A fine terrain makes more contacts under a foot than MuJoCo keeps.

A height field is one geom, whatever it is made of, and of two geoms MuJoCo keeps 50 contacts. Under a foot on fine
cells the others are lost, on one side of it first: it sinks, finds contacts again, is thrown up, and tips over.

Bad:

    <mujoco>
      <asset>
        <hfield name="terrain" nrow="301" ncol="301" size="1.5 1.5 0.05 1"/>
      </asset>
      <worldbody>
        <geom type="hfield" hfield="terrain"/>
        <body pos="0 0 0.02">
          <freejoint/>
          <geom type="box" size="0.1 0.05 0.02" mass="5"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <hfield name="terrain" nrow="301" ncol="301" size="1.5 1.5 0.05 1"/>
    +     <hfield name="terrain" nrow="27" ncol="27" size="1.5 1.5 0.05 1"/>

The number: the most contacts of one geom with the height field after letting go; 50 is `mjMAXCONPAIR` of `mjmodel.h`.

When it is wrong: a wide body that keeps still on its 50 contacts; a field that your code fills, so that the edit of its
rows has to be one of the code.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import HFIELD
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "More contacts with a terrain than are kept"
FAMILIES = ("falls-through", "sinks", "jumps-at-start", "oscillates")
UNPLANTED = "few healthy models have a height field"

KEPT = 50  # mjMAXCONPAIR


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The height field on which something has all contacts that are kept; its edit has cells as large as that."""
    of, source = model.simulation, model.source
    if source is None or source.urdf:
        return
    found = {pair: most for pair, most in _most(of).items() if most >= KEPT}
    for geom in dict.fromkeys(field for field, _ in found):
        wide = max((other for field, other in found if field == geom), key=lambda one: of.model("geom_rbound")[one])
        fields, which = list(source.elements("hfield")), int(of.model("geom_dataid")[geom])
        if which >= len(fields):  # of an attached model
            continue
        field = fields[which]
        cells = _cells(of.model("geom_rbound")[wide], field)
        level = not field.get("file") and not field.get("elevation")
        edits = (
            tuple(set_attribute(field, *each) for each in zip(("nrow", "ncol"), cells, strict=True)) if level else ()
        )
        now = "as in its file" if field.get("file") else f"{field.get('nrow')}, {field.get('ncol')}"
        says = f"{of.name('geom', wide)} has {KEPT} contacts with it, which is all that are kept of two geoms."
        probe = Probe("most contacts of one geom with the terrain", "", _largest, (geom,))
        yield Suspect((of.name("hfield", which), of.name("geom", wide)), "nrow, ncol", now, ", ".join(cells), edits,
                      probe, KEPT - 0.5, says, "below 50", share=0.9, at=field)  # fmt: skip


def _cells(size: float, field: Element) -> list[str]:
    """How many rows and columns a field has, of cells as large as `size` in m."""
    across, along = (2 * float(half) for half in field.get("size").split()[:2])
    return [str(max(2, 1 + int(side / size))) for side in (along, across)]


@kept
def _most(of: Simulation) -> dict[tuple[int, int], int]:
    """The most contacts of each height field with each geom, after letting go."""
    fields = {geom for geom, kind in enumerate(of.model("geom_type")) if int(kind) == HFIELD}
    most: dict[tuple[int, int], int] = {}
    if not fields:
        return most
    of.begin()
    for _ in of.run(of.begin_with.duration):
        pairs = Counter(
            (field, sum(contact.geoms) - field)
            for contact in of.engine.contacts()
            if min(contact.geoms) >= 0
            for field in fields & {*contact.geoms}
        )
        most |= {pair: max(each, most.get(pair, 0)) for pair, each in pairs.items()}
    return most


def _largest(of: Simulation, geom: int) -> float:
    return float(max((most for (field, _), most in _most(of).items() if field == geom), default=0))
