"""A limb's centre of mass was copied to the other side, and not mirrored.

Left and right limb are written by one macro: what is attached to them is mirrored, and the `pos` of the `<inertial>`
keeps its sign. One side's mass is then inside of where it belongs and the other's outside: the robot leans.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <freejoint/>
          <inertial pos="0 0 0" mass="5" diaginertia="0.05 0.05 0.05"/>
          <geom type="box" size="0.1 0.1 0.1"/>
          <body name="left_hip" pos="0 0.1 -0.1">
            <inertial pos="0.02 0.03 -0.02" mass="1" diaginertia="0.002 0.002 0.002"/>
            <joint name="left_hip" axis="1 0 0"/>
            <geom size="0.04"/>
            <body name="left_leg" pos="0 0.06 -0.05">
              <inertial pos="0 0 -0.15" mass="1" diaginertia="0.008 0.008 0.001"/>
              <joint name="left_leg" axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
            </body>
          </body>
          <body name="right_hip" pos="0 -0.1 -0.1">
            <inertial pos="0.02 0.03 -0.02" mass="1" diaginertia="0.002 0.002 0.002"/>
            <joint name="right_hip" axis="1 0 0"/>
            <geom size="0.04"/>
            <body name="right_leg" pos="0 -0.06 -0.05">
              <inertial pos="0 0 -0.15" mass="1" diaginertia="0.008 0.008 0.001"/>
              <joint name="right_leg" axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

            <body name="right_hip" pos="0 -0.1 -0.1">
    -         <inertial pos="0.02 0.03 -0.02" mass="1" diaginertia="0.002 0.002 0.002"/>
    +         <inertial pos="0.02 -0.03 -0.02" mass="1" diaginertia="0.002 0.002 0.002"/>

The number: how far the centre of mass is from the mirror image of its twin's, in m; more than 2 mm, where the two have
the same numbers in frames that are turned alike, and what hangs on them, their geoms, or their joints' ranges are
mirrored.

When it is wrong: one part that is built in on both sides without being turned, where no geom shows it.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.twins import Twins, twins
from clinic.diagnosis.probes.vector import Vector, norm, sub, times
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A centre of mass copied to the other side and not mirrored"
FAMILIES = ("drifts", "wrong-mass", "wrong-numbers")
AFLOAT = True
UNPLANTED = "on a robot of which both sides are wrong, no side tells it"

FAR = 0.002  # m
SAME = 0.02  # of the distance


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The pairs of links with one centre of mass in mirrored surroundings."""
    of, found = model.simulation, twins(model.simulation)
    for left, right in found.pairs["body"]:
        if left not in found.images or found.images[left].sign > 0 or _aside(of, left, right) <= FAR:
            continue
        if inertial(model, left) is None or not _copied(found, left, right) or not _mirrored(found, left, right):
            continue
        says = f"Its centre of mass has the numbers of {of.name('body', left)}, and what is beside it is mirrored."
        now = " ".join(f"{x:.4g}" for x in of.row("body_ipos", right, 3))
        probe = Probe("centre of mass off the mirror image of the twin's", "m", _aside, (left, right), dynamic=False)
        names = of.name("body", right), of.name("body", left)
        at = model.element("body", right)
        yield Suspect(names, "pos", now, "mirrored on one of the two", (), probe, FAR, says, "at most 2 mm", at=at)


def _aside(of: Simulation, left: int, right: int) -> float:
    """How far a body's centre of mass is from the image of its twin's, in m, seen from their origins."""
    found = twins(of)
    here, there = (sub(found.at("xipos", each), found.at("xpos", each)) for each in (left, right))
    return norm(sub(times(found.images[left].matrix, here), there))


def _copied(found: Twins, left: int, right: int) -> bool:
    """Whether masses and centres of mass are written alike, in frames that are turned alike."""
    of = found.of
    masses, places = of.model("body_mass"), [of.row("body_ipos", each, 3) for each in (left, right)]
    alike = norm(sub(*places)) < SAME * norm(places[0]) and abs(masses[left] - masses[right]) < SAME * masses[left]
    return alike and norm(sub(found.at("xmat", left, 9), found.at("xmat", right, 9))) < SAME


def _mirrored(found: Twins, left: int, right: int) -> bool:
    """Whether a child, a geom or a joint's range of the two is mirrored, and no geom is copied as the mass is."""
    of, matrix = found.of, found.images[left].matrix
    pairs: list[tuple[str, Vector, Vector]] = []
    for kind, field in (("body", "xpos"), ("geom", "geom_xpos")):
        for pair in found.pairs[kind]:
            if tuple(of.body_of(kind, one) for one in pair) == (left, right):
                here, there = (found.at(field, one) for one in pair)
                pairs.append((kind, sub(here, found.at("xpos", left)), sub(there, found.at("xpos", right))))
    aside = [each for each in pairs if norm(sub(times(matrix, each[1]), each[1])) > 2 * FAR]
    if any(kind == "geom" and norm(sub(here, there)) < SAME * norm(here) for kind, here, there in aside):
        return False
    ranges = [[of.row("jnt_range", joint, 2) for joint in of.joints_of(body)] for body in (left, right)]
    turned = any(a != b and norm(sub(a, (-b[1], -b[0]))) < SAME * norm(a) for a, b in zip(*ranges, strict=False))
    return turned or any(norm(sub(times(matrix, here), there)) < SAME * norm(here) for _, here, there in aside)
