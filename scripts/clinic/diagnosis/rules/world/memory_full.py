"""MuJoCo's memory is full, and contacts or constraints are dropped.

`<size memory=...>` bounds how much there may be; `njmax` and `nstack` of older models set the memory as well. What does
not fit is dropped with a warning: things fall through.

Bad:

    <mujoco>
      <size memory="14K"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
        <body pos="0.2 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
        <body pos="0.4 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <size memory="14K"/>

The number: how often MuJoCo warns `CONTACTFULL` or `CNSTRFULL` within 2 s after letting go.

When it is wrong: something explodes, and makes more contacts than any memory holds.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute, set_attribute
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "The memory is full"
FAMILIES = ("falls-through", "explodes")
LEVEL = "cause"
UNPLANTED = "no single edit of a healthy model makes so many contacts"


def _full(simulation: Simulation) -> float:
    return float(sum(let_go(simulation).warnings.get(kind, 0) for kind in ("CONTACTFULL", "CNSTRFULL")))


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The sizes that are written."""
    if model.source is None or not _full(model.simulation):
        return
    written = [each for each in model.source.root.children if each.tag == "size"]
    for each in written:
        old = [name for name in ("nconmax", "njmax", "nstack") if name in each.attributes]
        edits = (set_attribute(each, "memory", "100M"), *(remove_attribute(each, name) for name in old))
        now = ", ".join(f"{name} {each.get(name)}" for name in ("memory", *old) if each.get(name))
        says = "What does not fit is dropped; where it is the Newton solver's own, CG solves the step."
        probe = Probe("warnings that the memory is full", "", _full)
        yield Suspect(("<size>",), "memory", now, "100M", edits, probe, 0.0, says)
