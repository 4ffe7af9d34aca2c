"""A geom that is called visual collides.

Its default class lacks `contype="0" conaffinity="0"`, or it has another class: what is only to be seen then touches
things, beside the geoms that were made for it, and its mass counts as well.

Bad:

    <mujoco>
      <default>
        <default class="visual"><geom group="2"/></default>
      </default>
      <worldbody>
        <body name="link" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom class="visual" type="capsule" fromto="0 0 0 0 0 0.3" size="0.04"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.3" size="0.03" mass="1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <default class="visual"><geom group="2"/></default>
    +     <default class="visual"><geom group="2" contype="0" conaffinity="0" mass="0"/></default>

The number: geoms whose class or name says visual, in a body that has another geom that collides, with masks that are
not zero.

When it is wrong: a geom that is seen and touched, and is called so for its group.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A visual geom that collides"
FAMILIES = ("wrong-mass", "explodes", "jumps-at-start", "stuck")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "only a name says what a geom is for"

SEEN = re.compile(r"(?<![a-z])(visuals?|vis)(?![a-z])", re.IGNORECASE)
CONTACT = 1 << 4  # mjtDisableBit
BOTH = re.compile(r"coll", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All geoms that are called visual and collide, where something else of their body is to collide."""
    of = model.simulation
    if int(of.model("opt.disableflags")[0]) & CONTACT:
        return
    found = []
    for body in range(1, of.count("body")):
        geoms = [geom for geom in of.geoms_of(body) if solid(of, geom)]
        seen = [geom for geom in geoms if (each := model.element("geom", geom)) is not None and _seen(each)]
        found += seen if len(seen) < len(geoms) else []
    if not found:
        return
    says = f"{of.name('geom', found[0])} is called visual, and touches things beside the geom that is made for it."
    edits = model.set("geom", found, "contype", "0") + model.set("geom", found, "conaffinity", "0")
    masks = ", ".join(f"{int(of.model(f'geom_{mask}')[found[0]])}" for mask in ("contype", "conaffinity"))
    names = tuple(of.name("geom", geom) for geom in found)
    probe = counted("visual geoms that collide", len(found))
    yield Suspect(names, "contype, conaffinity", masks, "0, 0", edits, probe, 0.5, says, "0, 0 for what is only seen")


def _seen(element: Element) -> bool:
    name, class_ = element.get("name"), element.get("class")
    return bool(SEEN.search(class_) or SEEN.search(name)) and not BOTH.search(name + class_)
