"""A geom that is called visual collides.

Its default class lacks `contype="0" conaffinity="0"`, or it has another class: what is only to be seen then touches
things, beside the geoms that were made for it, and its mass counts as well. So does a target that one sees through:
what is brought there is stopped at its edge, however thin it is.

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
not zero; and transparent ones of the world or a mocap body that are called target, marker, waypoint or indicator;
and the one of four geoms of mocap bodies and more that something can touch.

When it is wrong: a geom that is seen and touched, and is called so for its group.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.probes.shape import collides, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A visual geom that collides"
FAMILIES = ("wrong-mass", "explodes", "jumps-at-start", "stuck")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "only a name says what a geom is for"

SEEN = re.compile(r"(?<![a-z])(visuals?|vis)(?![a-z])", re.IGNORECASE)
MARK = re.compile(r"(?<![a-z])(target|marker|waypoint|indicator)(?![a-rt-z])", re.IGNORECASE)
OPAQUE = 0.9  # of alpha
MANY = 3  # geoms of mocap bodies
CONTACT = 1 << 4  # mjtDisableBit
BOTH = re.compile(r"coll", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All geoms that are called visual and collide, where something else of their body is to collide."""
    of = model.simulation
    if int(of.model("opt.disableflags")[0]) & CONTACT:
        return
    marks = [geom for geom in range(of.count("geom")) if _marks(of, geom)]
    found = [*marks, *_odd_mocap(of)]
    for body in range(1, of.count("body")):
        geoms = [geom for geom in of.geoms_of(body) if solid(of, geom)]
        seen = [geom for geom in geoms if (each := model.element("geom", geom)) is not None and _seen(each)]
        found += seen if len(seen) < len(geoms) else []
    if not found:
        return
    says = f"{of.name('geom', found[0])} is called visual, and touches things beside the geom that is made for it."
    if not marks and _odd_mocap(of):
        says = f"{of.name('geom', found[0])} stops what it comes to, and the geoms of all other mocap bodies do not."
    if marks:
        says = f"{of.name('geom', found[0])} is transparent and called a mark, and stops what comes to it."
    edits = model.set("geom", found, "contype", "0") + model.set("geom", found, "conaffinity", "0")
    masks = ", ".join(f"{int(of.model(f'geom_{mask}')[found[0]])}" for mask in ("contype", "conaffinity"))
    names = tuple(of.name("geom", geom) for geom in found)
    probe = counted("visual geoms that collide", len(found))
    yield Suspect(names, "contype, conaffinity", masks, "0, 0", edits, probe, 0.5, says, "0, 0 for what is only seen")


def _marks(of: Simulation, geom: int) -> bool:
    """Whether a geom is a place to be seen, on the world or moved by mocap, that things bump into."""
    body = int(of.model("geom_bodyid")[geom])
    called = MARK.search(f"{of.names('geom')[geom]} {of.names('body')[body]}")
    still = not int(of.model("body_weldid")[body]) or int(of.model("body_mocapid")[body]) >= 0
    if not called or not still or not 0 < of.model("geom_rgba")[4 * geom + 3] < OPAQUE:
        return False
    return _stops(of, geom)


def _odd_mocap(of: Simulation) -> list[int]:
    """The one geom of mocap bodies that stops things, where three others and more do not."""
    mocap = [body for body, each in enumerate(of.model("body_mocapid")) if int(each) >= 0]
    geoms = [geom for body in mocap for geom in of.geoms_of(body)]
    odd = [geom for geom in geoms if _stops(of, geom)]
    return odd if len(odd) == 1 and len(geoms) > MANY else []


def _stops(of: Simulation, geom: int) -> bool:
    """Whether something that moves may touch a geom."""
    moving = {*of.moving_bodies}
    return any(int(owner) in moving and collides(of, geom, each) for each, owner in enumerate(of.model("geom_bodyid")))


def _seen(element: Element) -> bool:
    name, class_ = element.get("name"), element.get("class")
    return bool(SEEN.search(class_) or SEEN.search(name)) and not BOTH.search(name + class_)
