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
not zero, those that `<replicate>` makes too; and transparent ones of the world or a mocap body that are called target,
marker, waypoint or indicator; and, of four mocap bodies and more, those of the only one that something can touch.

When it is wrong: a geom that is seen and touched, and is called so for its group.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import CONTACTS_OFF
from clinic.diagnosis.probes.shape import collides, masks_told, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A visual geom that collides"
FAMILIES = ("wrong-mass", "explodes", "jumps-at-start", "stuck", "slow")
CASE = "small-stack-is-slow"
UNPLANTED = "only a name says what a geom is for"

SEEN = re.compile(r"(?<![a-z])(visuals?|vis)(?![a-z])", re.IGNORECASE)
MARK = re.compile(r"(?<![a-z])(target|marker|waypoint|indicator)(?![a-rt-z])", re.IGNORECASE)
OPAQUE = 0.9  # of alpha
MASKS = ("contype", "conaffinity")
MANY = 3  # mocap bodies
BOTH = re.compile(r"coll", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All geoms that are only to be seen and collide, by what says so."""
    of = model.simulation
    if int(of.model("opt.disableflags")[0]) & CONTACTS_OFF:
        return
    seen = []
    for body in range(1, of.count("body")):
        geoms = [geom for geom in of.geoms_of(body) if solid(of, geom)]
        visual = [geom for geom in geoms if (each := model.element("geom", geom)) is not None and _seen(each)]
        seen += visual if len(visual) < len(geoms) else []
    marks = [geom for geom in range(of.count("geom")) if _marks(of, geom)]
    yield from _repeated(model)
    for geoms, says in (
        (seen, "is called visual, and touches things beside the geom that is made for it."),
        (marks, "is transparent and called a mark, and stops what comes to it."),
        (_odd_mocap(of), "stops what it comes to, and the geoms of all other mocap bodies do not."),
    ):
        if not geoms:
            continue
        edits = model.set("geom", geoms, "contype", "0") + model.set("geom", geoms, "conaffinity", "0")
        masks = masks_told(of, geoms[0])
        names = tuple(of.name("geom", geom) for geom in geoms)
        probe, told = counted("visual geoms that collide", len(geoms)), f"{names[0]} {says}"
        yield Suspect(
            names, "contype, conaffinity", masks, "0, 0", edits, probe, 0.5, told, "0, 0 for what is only seen"
        )


def _repeated(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms that are written once inside a `<replicate>`, and have no place of their own in the model."""
    if model.source is None:
        return
    solids = [each for each in model.source.elements("geom") if any(_mask(model, each, name) != "0" for name in MASKS)]
    bodies = {_body_of(geom) for geom in solids if not _seen(geom)} - {None}
    for geom in solids:
        if not _seen(geom) or _body_of(geom) not in bodies or all(each.tag != "replicate" for each in geom.around()):
            continue
        named, masks = f'geom "{geom.get("name")}"', ", ".join(_mask(model, geom, name) for name in MASKS)
        says = f"{named} is called visual, and each of its copies touches things beside what is made for it."
        edits = tuple(set_attribute(geom, name, "0") for name in MASKS)
        probe, well = counted("visual geoms that collide", 1), "0, 0 for what is only seen"
        yield Suspect((named,), ", ".join(MASKS), masks, "0, 0", edits, probe, 0.5, says, well, at=geom)


def _body_of(geom: Element) -> Element | None:
    return next((each for each in geom.around() if each.tag == "body"), None)


def _mask(model: ReaderModel, geom: Element, name: str) -> str:
    return (model.source.value(geom, name) if model.source else None) or "1"


def _marks(of: Simulation, geom: int) -> bool:
    """Whether a geom is a place to be seen, on the world or moved by mocap, that things bump into."""
    body = of.body_of("geom", geom)
    called = MARK.search(f"{of.names('geom')[geom]} {of.names('body')[body]}")
    still = not int(of.model("body_weldid")[body]) or int(of.model("body_mocapid")[body]) >= 0
    if not called or not still or not 0 < of.model("geom_rgba")[4 * geom + 3] < OPAQUE:
        return False
    return _stops(of, geom)


def _odd_mocap(of: Simulation) -> list[int]:
    """The geoms that stop things of the one mocap body that has some, where three others and more have none."""
    mocap = [body for body, each in enumerate(of.model("body_mocapid")) if int(each) >= 0 and of.geoms_of(body)]
    if len(mocap) <= MANY:
        return []
    odd = [geoms for body in mocap if (geoms := [geom for geom in of.geoms_of(body) if _stops(of, geom)])]
    return [geom for geom in odd[0] if not _marks(of, geom)] if len(odd) == 1 else []


def _stops(of: Simulation, geom: int) -> bool:
    """Whether something that moves may touch a geom."""
    moving = {*of.moving_bodies}
    return any(int(owner) in moving and collides(of, geom, each) for each, owner in enumerate(of.model("geom_bodyid")))


def _seen(element: Element) -> bool:
    name, class_ = element.get("name"), element.get("class")
    return bool(SEEN.search(class_) or SEEN.search(name)) and not BOTH.search(name + class_)
