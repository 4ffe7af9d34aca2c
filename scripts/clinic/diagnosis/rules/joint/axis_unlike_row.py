"""One hinge of a row turns about another axis than all others.

A chain with one frame for each joint has one axis in all of them: a planar arm, or an arm whose frames are laid out as
Denavit and Hartenberg do, with `0 0 1` throughout. One axis that was typed otherwise moves all that follows out of the
plane, or out of the data sheet's kinematics.

Bad:

    <mujoco>
      <default>
        <joint axis="0 0 1" damping="1"/>
        <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01"/>
      </default>
      <worldbody>
        <body name="a">
          <joint name="a"/>
          <geom/>
          <body name="b" pos="0.1 0 0">
            <joint name="b"/>
            <geom/>
            <body name="c" pos="0.1 0 0">
              <joint name="c" axis="0 1 0"/>
              <geom/>
              <body name="d" pos="0.1 0 0">
                <joint name="d"/>
                <geom/>
                <body name="e" pos="0.1 0 0">
                  <joint name="e"/>
                  <geom/>
                  <body name="f" pos="0.1 0 0">
                    <joint name="f"/>
                    <geom/>
                  </body>
                </body>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -           <joint name="c" axis="0 1 0"/>
    +           <joint name="c" axis="0 0 1"/>

The number: the hinges in a row, each alone on its body, about one axis of their own frames, x, y or z, of which one in
the middle turns about another, with two others and more on either side of it and five others and more in all. Arms with
`1 0 0`, `0 1 0` and `0 0 1` in turn have no such row: none of 260 healthy models has.

When it is wrong: a row that is bent there on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.shape import limbs
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "One axis of a row unlike the others"
FAMILIES = ("drifts", "stuck", "wrong-numbers")
UNPLANTED = "no healthy model of the bench has a row of six hinges about one axis"

BESIDE, ROW = 2, 5
ALONG = 0.999


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints within a row of which all others have one axis, where a chain of the model has one such joint."""
    of = model.simulation
    for joint, others in _odd(of).items():
        now, axis = (of.row("jnt_axis", each, 3) for each in (joint, others[0]))
        says = f"Before and after it {len(others)} hinges in a row turn about {written(axis)} of their own frames."
        edits = model.set("joint", [joint], "axis", written(axis))
        probe = how_many("hinges of another axis than their row", _among, joint)
        names = (of.name("joint", joint), *(of.name("joint", other) for other in others))
        yield Suspect(names, "axis", written(now), written(axis), edits, probe, 0, says, "the axis of the others")


def _among(of: Simulation, joint: int) -> list[int]:
    return [each for each in _odd(of) if each == joint]


def _odd(of: Simulation) -> dict[int, list[int]]:
    """By joint the others of the row that it stands out of; none where two and more of the model do."""
    made: dict[int, list[int]] = {}
    for chain in _chains(of):
        axes = [_axis(of, joint) for joint in chain]
        for at in range(1, len(chain) - 1):
            before, own, after = axes[at - 1 : at + 2]
            if not before or not own or own == before or before != after:
                continue
            first, last = at - 1, at + 1
            while first > 0 and axes[first - 1] == before:
                first -= 1
            while last + 1 < len(axes) and axes[last + 1] == before:
                last += 1
            if min(at - first, last - at) >= BESIDE and last - first >= ROW:
                made[chain[at]] = [*chain[first:at], *chain[at + 1 : last + 1]]
    return made if len(made) == 1 else {}


def _chains(of: Simulation) -> list[list[int]]:
    """The joints from the world on to each last body, in order; -1 for a body that has another joint, or several."""
    made = []
    for limb in limbs(of):
        joints = [of.joints_of(body) for body in limb]
        made.append([some[0] if len(some) == 1 and of.joint_type(some[0]) == HINGE else -1 for some in joints if some])
    return made


def _axis(of: Simulation, joint: int) -> str:
    """Along which axis of its frame a hinge lies, to and fro alike; empty along none."""
    axis = of.row("jnt_axis", joint, 3) if joint >= 0 else ()
    return next((name for name, part in zip("xyz", axis, strict=False) if abs(part) > ALONG), "")
