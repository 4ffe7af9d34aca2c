"""The centre of mass of a middle part is beside the plane of symmetry.

A trunk, a head or a pelvis of a robot that is its own mirror image has its centre of mass in the middle. A sign or a
frame that was lost on the way from the drawing puts it aside, and the robot leans and walks in a curve.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <freejoint/>
          <inertial pos="0 0.06 0" mass="10" diaginertia="0.1 0.1 0.1"/>
          <geom type="box" size="0.2 0.1 0.05"/>
          <body name="left_front" pos="0.2 0.1 0">
            <joint name="left_front" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02"/>
          </body>
          <body name="right_front" pos="0.2 -0.1 0">
            <joint name="right_front" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02"/>
          </body>
          <body name="left_rear" pos="-0.2 0.1 0">
            <joint name="left_rear" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02"/>
          </body>
          <body name="right_rear" pos="-0.2 -0.1 0">
            <joint name="right_rear" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 0.06 0" mass="10" diaginertia="0.1 0.1 0.1"/>
    +       <inertial pos="0.06 0 0" mass="10" diaginertia="0.1 0.1 0.1"/>

The number: how far the centre of mass of a body whose origin is on the plane of symmetry is from it, in distances of
the farthest twin from that plane; more than 0.2. The plane is that of at least two pairs of bodies, and looked at are
the body on which they hang and those on which it hangs, up to the first joint that turns one out of that plane: the
links of an arm do not share the plane of its gripper.

When it is wrong: a battery or a tool that is mounted aside.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.pairs import SYMMETRIC
from clinic.diagnosis.probes.twins import Twins, twins
from clinic.diagnosis.probes.vector import Vector, dot, norm, sub, unit
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A centre of mass beside the middle"
FAMILIES = ("drifts", "wrong-mass")
AFLOAT = True
UNPLANTED = "trunks of healthy robots carry batteries and computers aside"

OFF, ON = 0.2, 0.01  # of the distance of the twins
ALONG = 0.99  # of a hinge's axis along the normal of the plane


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The middle bodies of a robot of pairs whose centre is off the middle, all together."""
    of = model.simulation
    off = _off(of)
    found = sorted((body for body in off if off[body] > OFF), key=lambda body: -off[body])
    if not found:
        return
    worst = found[0]
    where = " ".join(f"{x:.4g}" for x in of.row("body_ipos", worst, 3))
    yield Suspect(
        tuple(of.name("body", body) for body in found),
        "inertial pos",
        where,
        "in the plane of symmetry",
        (),
        Probe("centre of mass off the middle", "of the twins' distance", _off_of, (worst,), dynamic=False),
        OFF,
        f"The left and the right are mirror images, and the centre of mass of {of.name('body', worst)} is aside of "
        "the plane between them.",
        "0",
    )


def _off_of(of: Simulation, body: int) -> float:
    return _off(of).get(body, 0.0)


def _off(of: Simulation) -> dict[int, float]:
    """How far the centres of middle bodies are from the plane of symmetry, in distances of the twins."""
    found = twins(of)
    planes = [left for left in found.images if found.share[left] >= SYMMETRIC and found.images[left].sign < 0]
    groups: dict[int, list[int]] = {}
    for left in planes:
        groups.setdefault(found.common[left], []).append(left)
    if not groups:
        return {}
    common, lefts = max(groups.items(), key=lambda each: len(each[1]))
    if len(lefts) < 2:
        return {}
    wide = max(_aside(found, lefts[0], "xpos", left) for left in lefts)
    made, here = {}, found.at("xpos", lefts[0])
    normal = unit(sub(found.images[lefts[0]].of(here), here))
    for body in _of_the_plane(of, common, normal):
        if _aside(found, lefts[0], "xpos", body) < ON * wide:
            made[body] = _aside(found, lefts[0], "xipos", body) / wide
    return made


def _of_the_plane(of: Simulation, common: int, normal: Vector) -> Iterator[int]:
    """A body and those that it hangs on, up to the first joint that turns or moves it out of its own plane."""
    of.begin()
    for body in of.ancestors(common)[:-1]:
        yield body
        for joint in of.joints_of(body):
            along = abs(dot(of.axis(joint), normal))
            if not (along > ALONG if of.joint_type(joint) == HINGE else along < 1 - ALONG):
                return


def _aside(found: Twins, left: int, field: str, body: int) -> float:
    """How far a body's origin or centre is from the plane, in m."""
    here = found.at(field, body)
    return norm(sub(found.images[left].of(here), here)) / 2
