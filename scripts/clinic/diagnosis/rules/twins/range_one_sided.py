"""A joint in the middle of a symmetric robot turns further to one side.

The waist, the neck and the tail of a robot whose left and right are mirrored turn to both sides alike. With `0` where a
limit or its sign was lost, the robot leans or looks to one side alone.

Bad:

    <mujoco>
      <worldbody>
        <body name="pelvis" pos="0 0 1">
          <freejoint/>
          <geom size="0.1"/>
          <body name="torso" pos="0 0 0.2">
            <joint name="waist" axis="0 0 1" range="0 60"/>
            <geom size="0.1"/>
            <body name="left_arm" pos="0 0.2 0">
              <joint name="left_arm" axis="0 1 0" range="-90 90"/>
              <geom size="0.05"/>
            </body>
            <body name="right_arm" pos="0 -0.2 0">
              <joint name="right_arm" axis="0 1 0" range="-90 90"/>
              <geom size="0.05"/>
            </body>
          </body>
          <body name="left_leg" pos="0 0.1 -0.2">
            <joint name="left_leg" axis="0 1 0" range="-90 30"/>
            <geom size="0.05"/>
          </body>
          <body name="right_leg" pos="0 -0.1 -0.2">
            <joint name="right_leg" axis="0 1 0" range="-90 30"/>
            <geom size="0.05"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint name="waist" axis="0 0 1" range="0 60"/>
    +         <joint name="waist" axis="0 0 1" range="-60 60"/>

The number: the difference of the two ends' magnitudes over the width of the range, above 0.3, of a hinge whose anchor
is its own image and whose turn is the opposite of its image's, where two pairs of bodies and more are mirrored. The
image is that of the largest pair that the joint does not carry: a wrist lies in the middle of its own fingers.

When it is wrong: a joint whose zero is not the middle of the robot.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.pairs import FITS, SYMMETRIC
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.probes.vector import dot, norm, sub, times
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A joint in the middle that turns to one side"
FAMILIES = ("stuck", "drifts")
UNPLANTED = "few healthy models have a waist or a neck"

MOST, ALIKE, PAIRS = 0.3, 0.98, 2


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges in the plane of a robot's symmetry whose ranges are not the same to both sides."""
    of = model.simulation
    for joint in _middle(of):
        if (off := _one_sided(of, joint)) <= MOST:
            continue
        low, high = of.row("jnt_range", joint, 2)
        unit = model.angle_unit
        low_now, high_now, far = low / unit, high / unit, max(abs(low), abs(high)) / unit
        name, paired = of.name("joint", joint), len(_mirrored(of))
        says = f"{name} turns from {low:.3g} to {high:.3g} rad; {paired} pairs of bodies of the robot are mirrored."
        probe = Probe("difference of the ends over the range", "", _one_sided, (joint,), dynamic=False)
        yield Suspect(
            (name,), "range", f"{low_now:.3g} {high_now:.3g}", f"{-far:.3g} {far:.3g}", (), probe, MOST, says,
            "to both sides alike", excess=off / MOST,
        )  # fmt: skip


def _one_sided(of: Simulation, joint: int) -> float:
    low, high = of.row("jnt_range", joint, 2)
    return abs(low + high) / max(high - low, 1e-9)


def _mirrored(of: Simulation) -> list[int]:
    """The left ones of the pairs of bodies that a reflection maps on each other."""
    found = twins(of)
    return [left for left, image in found.images.items() if image.sign < 0 and found.share[left] >= SYMMETRIC]


@kept
def _middle(of: Simulation) -> tuple[int, ...]:
    """The hinges that the reflection of the robot's largest pair maps on themselves, turned the other way."""
    found, mirrored = twins(of), _mirrored(of)
    if len(mirrored) < PAIRS:
        return ()
    made = []
    for joint in of.ranges:
        mover = of.body_of("joint", joint)
        lefts = [left for left in mirrored if mover not in of.ancestors(found.common[left])]
        if of.joint_type(joint) != HINGE or not lefts:
            continue
        largest = max(lefts, key=lambda left: found.size[left])
        image, near = found.images[largest], FITS * found.size[largest]
        anchor, axis = found.at("xanchor", joint), found.at("xaxis", joint)
        apart = norm(sub(image.of(anchor), anchor))
        turned = dot(times(image.matrix, axis), axis)
        if apart < near and turned > ALIKE and found.partner("joint", joint) is None:
            made.append(joint)
    return tuple(made)
