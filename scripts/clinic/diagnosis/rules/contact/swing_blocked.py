"""A pendulum swings into the floor.

A pole on a cart, or a pendulum at a post, is to turn all the way round. Hung lower than it is long it stops on the
floor, on its rail or on the post, and none of its joints says why.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="3 3 0.1"/>
        <body name="cart" pos="0 0 0.3">
          <joint name="slide" type="slide" axis="1 0 0"/>
          <geom type="box" size="0.1 0.05 0.05" mass="1"/>
          <body name="pole">
            <joint name="hinge" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0.1 0 0 0.6" size="0.02" mass="0.1"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="slide"/>
      </actuator>
    </mujoco>

Good:

    -     <geom name="floor" type="plane" size="3 3 0.1"/>
    +     <geom name="floor" type="plane" size="3 3 0.1" contype="0" conaffinity="0"/>

The number: the share of 36 poses of a hinge, the other joints at their start, in which what hangs on it is inside of
something that is fixed to the world, by more than a tenth of the thinner geom; told where it is less than 0.9, and the
start is free. Looked at are hinges that have no range, no drive and no vertical axis, of what cannot fall, in a model
of at most four joints.

When it is wrong: a pendulum that is meant to hit something. Only intent knows whether it hangs too low: a hint.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import tau

from clinic.diagnosis.probes.shape import falling, root_of, thickness
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A pendulum that hits the floor"
FAMILIES = ("stuck",)
UNPLANTED = "few of the healthy models are pendulums"

POSES, DEEP, VERTICAL, MOST = 36, 0.1, 0.7, 0.9
FEW = 4  # joints; a model with more is no pendulum


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges that should turn round, and what stops each of them."""
    of = model.simulation
    for joint in _pendulums(of):
        poses = _blocked(of, joint)
        share = len(poses) / POSES
        if not 0 < share < MOST or 0 in poses:
            continue
        stops = sorted(set().union(*poses.values()))
        names = (of.name("joint", joint), *(of.name("geom", geom) for geom in stops))
        probe = Probe("share of a turn that is blocked", "", _share, (joint,), dynamic=False)
        says = f"No range ends it, and in {100 * share:.0f} % of a turn what hangs on it is inside of {names[1]}."
        masks = () if falling(of) else ("contype", "conaffinity")  # which another thing stands on
        edits = tuple(edit for mask in masks for edit in model.set("geom", stops, mask, "0"))
        value = "0" if edits else ""
        yield Suspect(names, "contype", "1", value, edits, probe, 0, says, "a pivot higher than the pendulum is long")


def _pendulums(of: Simulation) -> list[int]:
    """The hinges without a range and a drive, about no vertical axis, of mechanisms that cannot fall."""
    owner, falls = root_of(of), falling(of)
    of.begin()
    return [
        joint
        for joint in range(of.count("joint") if of.count("joint") <= FEW else 0)
        if of.continuous(joint)
        and joint not in of.drivers
        and owner[of.body_of("joint", joint)] not in falls
        and abs(of.axis(joint)[2]) < VERTICAL
    ]


@kept
def _blocked(of: Simulation, joint: int) -> dict[int, set[int]]:
    """The poses of a turn in which what hangs on a hinge is inside of the world, and the world's geoms there."""
    place, moved = of.place(joint), set(of.below(of.body_of("joint", joint)))
    bodies, welds = of.model("geom_bodyid"), of.model("body_weldid")
    of.begin(forward=False)
    start, made = of.data("qpos")[place], dict[int, set[int]]()
    for pose in range(POSES):
        of.engine.write("qpos", [start + tau * pose / POSES], place)
        of.engine.forward()
        for contact in (each for each in of.engine.contacts() if min(each.geoms) >= 0):
            hit = [geom for geom in contact.geoms if not welds[int(bodies[geom])]]
            thin = min(thickness(of, geom) for geom in contact.geoms)
            if hit and moved & {int(bodies[geom]) for geom in contact.geoms} and -contact.distance > DEEP * thin:
                made.setdefault(pose, set()).update(hit)
    return made


def _share(of: Simulation, joint: int) -> float:
    return len(_blocked(of, joint)) / POSES
