"""An object hangs in the air while the rest of the model moves.

A body without a joint is part of the world: gravity does nothing to it, and a robot that grasps it cannot lift it.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="arm" pos="0 0 0.5">
          <joint axis="0 0 1"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
        <body name="parcel" pos="0.6 0 0.8">
          <geom type="box" size="0.05 0.05 0.05" mass="0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

          <body name="parcel" pos="0.6 0 0.8">
    +       <freejoint/>

The number: the height in m of what hangs above the floor. Told are bodies of the world without joints and without
others on them that collide, that reach neither a plane nor another thing that stands still, and whose mass somebody
wrote down (the mass of what cannot move has no effect), or that are called a cube, a ball, a bottle and the like.

When it is wrong: a lamp, or an obstacle that is meant to stay where it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import insert
from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.shape import boxes
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An object without a joint"
FAMILIES = ("stuck",)
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "only intent knows what is to stay where it is"

HANGS, NEAR = 0.005, 0.001  # m above the floor, and from other things
OBJECT = re.compile(
    r"(?<![a-z])(cube|block|ball|object|brick|can|bottle|mug|dice|die|parcel|apple|banana)s?(?![a-z])", re.IGNORECASE
)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies of the world in the air that have a mass and no joint, all together."""
    of, parents = model.simulation, model.simulation.model("body_parentid")
    if not of.count("dof") or model.source is None or model.source.urdf or not any(of.model("opt.gravity")):
        return
    carries = {int(parent) for parent in parents} | {int(body) for body in of.model("cam_bodyid")}
    mocap, collides, found = of.model("body_mocapid"), of.model("geom_contype"), {}
    for body in range(1, of.count("body")):
        element = model.element("body", body)
        if parents[body] or body in carries or of.joints_of(body) or mocap[body] >= 0 or element is None:
            continue
        geoms = [geom for geom in of.geoms_of(body) if collides[geom]]
        weighed = any((model.value("geom", geom, "mass") or "0") != "0" for geom in geoms)
        weighed |= len(geoms) == 1 and bool(OBJECT.search(of.names("body")[body]))
        if geoms and (weighed or inertial(model, body)) and _height(of, body) > HANGS:
            found[body] = element
    found |= {body: element for body in _like_free(of) if (element := model.element("body", body)) is not None}
    if found:
        most = HANGS
        first = next(iter(found))
        says = f"{of.name('body', first)} has {of.model('body_mass')[first]:.3g} kg and no joint: nothing can move it."
        edits = tuple(insert(element, "<freejoint/>") for element in found.values())
        probe = Probe("height above the floor at which it hangs", "m", _highest, tuple(found), dynamic=False)
        if _highest(of, *found) <= HANGS:
            says += " Others of the same shape and size can move."
            probe, most = Probe("objects that stand still beside others", "", _still, tuple(found), dynamic=False), 0.0
        names = tuple(of.name("body", body) for body in found)
        yield Suspect(names, "freejoint", "left out", "<freejoint/>", edits, probe, most, says, "a joint")


def _still(of: Simulation, *bodies: int) -> float:
    return float(sum(not of.joints_of(body) for body in bodies))


def _like_free(of: Simulation) -> list[int]:
    """The bodies of the world with one geom that collides and no joint, beside a free one of the same geom and mass."""
    parents, carries = of.model("body_parentid"), {int(parent) for parent in of.model("body_parentid")}

    def looks(body: int) -> tuple[float, ...]:
        (geom,) = of.geoms_of(body)
        return (of.model("geom_type")[geom], *of.row("geom_size", geom, 3), of.model("body_mass")[body])

    single = [body for body in range(1, of.count("body")) if len(of.geoms_of(body)) == 1 and body not in carries]
    free = {looks(body) for body in single if body in of.free_bodies}
    still = [
        body for body in single if not parents[body] and not of.joints_of(body) and of.model("body_mocapid")[body] < 0
    ]
    solids = [body for body in still if of.model("geom_contype")[of.geoms_of(body)[0]]]
    return [body for body in solids if looks(body) in free]


def _highest(of: Simulation, *bodies: int) -> float:
    return max(_height(of, body) for body in bodies)


def _height(of: Simulation, body: int) -> float:
    """How far a body that stands still is above all planes, 0 for one that reaches another one that does."""
    of.begin()
    if of.joints_of(body):
        return 0.0
    bodies, kinds, collides = of.model("geom_bodyid"), of.model("geom_type"), of.model("geom_contype")
    every = boxes(of, range(len(kinds)))
    moving, made = set(of.moving_bodies), float("inf")
    for geom in of.geoms_of(body):
        place, half = every[geom]
        for other in range(len(kinds)) if collides[geom] else ():
            if int(bodies[other]) in (*moving, body) or not collides[other]:
                continue
            there, extent = every[other]
            if int(kinds[other]) == PLANE:
                made = min(made, place[2] - half[2] - of.data_row("geom_xpos", other, 3)[2])
            elif all(abs(a - b) < c + d + NEAR for a, b, c, d in zip(place, there, half, extent, strict=True)):
                return 0.0
    return made if made < float("inf") else 0.0
