"""An object hangs in the air, or lies before a gripper, and nothing can move it.

A body without a joint is fixed to its parent, here the world: gravity does nothing to it, and a robot that grasps it
cannot lift it.

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

The number: bodies of the world without joints and without others on them that collide, and whose mass somebody wrote
down (the mass of what cannot move has no effect), or that are called a cube, a ball, a bottle and the like: those that
hang in the air, and reach neither a plane nor another thing that stands still.

What lies on something is told where it is called so, is smaller than 30 cm, and has a mass that is written, or the
model a gripper; or, whatever it is called, where it has a mass, and the model a gripper and nothing free to hold. And
so is what looks like another that can move; a pallet or a crate that has a mass and carries something free; and a ball
in the air whose one joint, a hinge through its middle, moves it nowhere.

When it is wrong: a lamp, or an obstacle that is meant to stay where it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, PLANE, SPHERE
from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.key import freed
from clinic.diagnosis.probes.shape import boxes, solid
from clinic.diagnosis.probes.vector import norm, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "An object without a joint"
FAMILIES = ("stuck",)
UNPLANTED = "only intent knows what is to stay where it is"

HANGS, NEAR, SMALL = 0.005, 0.001, 0.15  # m above the floor, and from other things; half of what a gripper holds
OBJECT = re.compile(
    r"(?<![a-z])(cube|block|ball|object|brick|can|bottle|mug|dice|die|parcel|apple|banana)s?(?![a-z])", re.IGNORECASE
)
LOAD = re.compile(r"(?i)(?<![a-z])(pallet|crate|tote|tray|basket)s?(?![a-z])")
GRIPPER = re.compile(r"finger|grip|jaw|claw|suction|vacuum", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies of the world that are meant to move and have no joint, all together."""
    of = model.simulation
    if not of.count("dof") or model.source is None or model.urdf or not of.gravity:
        return
    alike = _like_free(of)
    found = [body for body in (*_weighed(model), *alike) if model.element("body", body) is not None]
    found = list(dict.fromkeys(found))
    if found:
        first = found[0]
        says = f"{of.name('body', first)} has {of.model('body_mass')[first]:.3g} kg and no joint: nothing can move it."
        says += " Others of the same shape and size can move." * (first in alike)
        probe = how_many("objects that nothing can move", _still, *found)
        names = tuple(of.name("body", body) for body in found)
        yield Suspect(
            names, "freejoint", "left out", "<freejoint/>", freed(model, found), probe, 0, says, "a joint each"
        )
    if spins := _spinning(of):
        says = f"{of.name('joint', spins[0])} turns a ball in the air about its own middle, and nothing else moves it."
        edits = model.set("joint", spins, "type", "free") + model.set("joint", spins, "limited", "false")
        probe = how_many("balls that turn in the air, and cannot leave their place", _spinning)
        yield Suspect(
            tuple(of.name("joint", each) for each in spins),
            "type",
            "hinge",
            "free",
            edits,
            probe,
            0,
            says,
            "a free joint",
        )


def _weighed(model: ReaderModel) -> Iterator[int]:
    """The bodies without a joint that have a mass, or the name of an object: in the air, or before a gripper."""
    of = model.simulation
    carries = of.children.keys() | {int(body) for body in of.model("cam_bodyid")}
    names = (name for kind in ("body", "joint", "actuator", "geom") for name in of.names(kind))
    gripper = any(map(GRIPPER.search, names))
    for body in range(1, of.count("body")):
        if of.parent(body) or body in carries or of.joints_of(body) or of.model("body_mocapid")[body] >= 0:
            continue
        geoms = [geom for geom in of.geoms_of(body) if solid(of, geom)]
        weighed = any((model.value("geom", geom, "mass") or "0") != "0" for geom in geoms)
        weighed = weighed or inertial(model, body) is not None
        called = len(geoms) == 1 and bool(OBJECT.search(of.names("body")[body]))
        loaded = weighed and bool(LOAD.search(of.names("body")[body])) and _carried(of, body)
        if loaded:
            yield body
            continue
        wanted = called and (weighed or gripper)
        wanted = wanted or (weighed and gripper and len(geoms) == 1 and not of.free_bodies)
        held = wanted and of.model("geom_rbound")[geoms[0]] < SMALL
        if geoms and (held or ((weighed or called) and _height(of, body) > HANGS)):
            yield body


def _carried(of: Simulation, body: int) -> bool:
    """Whether a free body that is called a load lies on one, at the start."""
    of.begin()
    bodies, free = of.model("geom_bodyid"), set(of.free_bodies)
    pairs = ({int(bodies[geom]) for geom in each.geoms} for each in of.engine.contacts() if min(each.geoms) >= 0)
    return any(body in pair and pair & free for pair in pairs)


def _spinning(of: Simulation) -> list[int]:
    """The hinges of the world's balls in the air, with which nothing but the ball turns, about its middle."""
    made = []
    for joint in range(of.count("joint")):
        body = of.body_of("joint", joint)
        geoms, alone = of.geoms_of(body), not of.parent(body) and len(of.joints_of(body)) == 1
        round_ones = [geom for geom in geoms if int(of.model("geom_type")[geom]) == SPHERE]
        if of.joint_type(joint) != HINGE or not alone or body in of.children or len(geoms) != 1 or geoms != round_ones:
            continue
        of.begin()
        off = sub(of.data_row("geom_xpos", geoms[0], 3), of.data_row("xanchor", joint, 3))
        if norm(off) < NEAR and _height(of, body) > HANGS:
            made.append(joint)
    return made


def _still(of: Simulation, *bodies: int) -> list[int]:
    return [body for body in bodies if not of.joints_of(body)]


def _like_free(of: Simulation) -> list[int]:
    """The bodies of the world with one geom that collides and no joint, beside a free one of the same geom and mass."""

    def looks(body: int) -> tuple[float, ...]:
        (geom,) = of.geoms_of(body)
        return (of.model("geom_type")[geom], *of.row("geom_size", geom, 3), of.model("body_mass")[body])

    single = [body for body in range(1, of.count("body")) if len(of.geoms_of(body)) == 1 and body not in of.children]
    free = {looks(body) for body in single if body in of.free_bodies}
    placed = [body for body in single if not of.parent(body) and of.model("body_mocapid")[body] < 0]
    still = _still(of, *placed)
    solids = [body for body in still if solid(of, of.geoms_of(body)[0])]
    return [body for body in solids if looks(body) in free]


def _height(of: Simulation, body: int) -> float:
    """How far a body that stands still is above all planes, 0 for one that reaches another one that does."""
    of.begin()
    bodies, kinds = of.model("geom_bodyid"), of.model("geom_type")
    every = boxes(of, range(len(kinds)))
    moving, made = set(of.moving_bodies), float("inf")
    for geom in of.geoms_of(body):
        place, half = every[geom]
        for other in range(len(kinds)) if solid(of, geom) else ():
            if int(bodies[other]) in (*moving, body) or not solid(of, other):
                continue
            there, extent = every[other]
            if int(kinds[other]) == PLANE:
                made = min(made, place[2] - half[2] - of.data_row("geom_xpos", other, 3)[2])
            elif all(abs(a - b) < c + d + NEAR for a, b, c, d in zip(place, there, half, extent, strict=True)):
                return 0.0
    return made if made < float("inf") else 0.0
