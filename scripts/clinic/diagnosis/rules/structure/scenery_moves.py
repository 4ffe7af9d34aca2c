"""A table, a shelf or a wall can move.

What a robot works at is part of the world: a body without a joint. With a free joint it may tip over when the robot
leans on it; with slides and a large damping it stays while one looks, and creeps away under a push, which a policy
learns to use.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="table" pos="0.6 0 0.2">
          <joint type="slide" axis="1 0 0" damping="1000"/>
          <geom type="box" size="0.3 0.4 0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint type="slide" axis="1 0 0" damping="1000"/>

The number: how many joints let it move. Told are bodies of the world whose name ends in a word for scenery and that
have a free joint or three slides, and bodies with nothing but slides that nothing drives, holds or springs back and
whose damping is 1,000 N s/m and more, up to 100,000: 100 N move it by 1 mm to 100 mm in a second.

When it is wrong: furniture that is meant to be pushed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.engine import FREE, SLIDE
from clinic.diagnosis.probes.equalities import held, sited
from clinic.diagnosis.probes.key import rekeyed
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Scenery that can move"
FAMILIES = ("drifts", "slips")
UNPLANTED = "only intent knows what is scenery"

SCENERY = frozenset(
    {
        "cabinet",
        "ceiling",
        "conveyor",
        "counter",
        "desk",
        "floor",
        "ground",
        "pedestal",
        "ramp",
        "shelf",
        "table",
        "wall",
    }
)
PARTS = ("top", "body", "link", "base", "left", "right", "front", "back", "main", "root", "l", "r")  # of its name
DAMPED = (1e3, 1e5)  # N s/m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies of the world that are scenery and have joints, all together."""
    of = model.simulation
    if model.source is None or model.urdf:
        return
    found = {}
    for body in range(1, of.count("body")):
        joints = list(of.joints_of(body))
        if not joints or of.parent(body) or of.drivers.keys() & set(joints):
            continue
        if (_called(of, body) and _anywhere(of, joints)) or _creeps(of, joints):
            found[body] = joints
    if found:
        loose = [joint for joints in found.values() for joint in joints]
        places = [model.element("joint", joint) for joint in loose]
        edits = tuple(delete(each) for each in places if each is not None) if all(places) else ()
        edits += rekeyed(model, taken=loose) if edits else ()
        first = of.name("body", next(iter(found)))
        says = f"{first} stands in the world, has a joint that lets it move, and nothing drives it."
        probe = Probe("joints that let it move", "", _count, tuple(found), dynamic=False)
        names = [
            name for body, joints in found.items() for name in (of.name("body", body), of.name("joint", joints[0]))
        ]
        yield Suspect(tuple(names), "joint", "", "left out", edits, probe, 0.5, says, "scenery has no joint")


def _called(of: Simulation, body: int) -> bool:
    """Whether a name ends in such a word: a table_top or a wall_2, and no table_tennis_ball."""
    words = [word for word in re.findall("[a-z]+", of.names("body")[body].lower()) if word not in PARTS]
    return bool(words) and words[-1] in SCENERY


def _anywhere(of: Simulation, joints: list[int]) -> bool:
    """Whether it can go anywhere: a free joint, or three slides without a spring or an equality that holds it."""
    slides = [joint for joint in joints if of.joint_type(joint) == SLIDE and not of.model("jnt_stiffness")[joint]]
    body = of.body_of("joint", joints[0])
    tied = any(body in held(of, each) for each in range(of.count("equality")) if not sited(of, each))
    return of.joint_type(joints[0]) == FREE or (len(slides) == 3 and not tied)


def _creeps(of: Simulation, joints: list[int]) -> bool:
    """Whether all are slides that only a large damping holds."""
    return all(
        of.joint_type(joint) == SLIDE
        and not of.model("jnt_stiffness")[joint]
        and not of.model("dof_frictionloss")[of.dof(joint)]
        and DAMPED[0] <= of.model("dof_damping")[of.dof(joint)] <= DAMPED[1]
        for joint in joints
    )


def _count(simulation: Simulation, *bodies: int) -> float:
    return float(sum(len(list(simulation.joints_of(body))) for body in bodies))
