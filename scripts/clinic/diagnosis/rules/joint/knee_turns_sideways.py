"""A knee that turns about the way in which it should walk.

Two legs hang side by side, and their knees turn about an axis that points forwards: the shins swing to the sides,
through each other, and no gait makes a step of it. The axis was taken from another model, whose forwards is another
axis.

Bad:

    <mujoco>
      <worldbody>
        <body name="torso" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.1"/>
          <body name="left_thigh" pos="-0.12 0 -0.1">
            <joint name="left_hip" axis="1 0 0" damping="1"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/>
            <body name="left_shin" pos="0 0 -0.4">
              <joint name="left_knee" axis="0 1 0" damping="1"/>
              <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/>
            </body>
          </body>
          <body name="right_thigh" pos="0.12 0 -0.1">
            <joint name="right_hip" axis="1 0 0" damping="1"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/>
            <body name="right_shin" pos="0 0 -0.4">
              <joint name="right_knee" axis="0 1 0" damping="1"/>
              <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -           <joint name="left_knee" axis="0 1 0" damping="1"/>
    +           <joint name="left_knee" axis="1 0 0" damping="1"/>

    -           <joint name="right_knee" axis="0 1 0" damping="1"/>
    +           <joint name="right_knee" axis="1 0 0" damping="1"/>

The number: the angle in degrees between the axis of a hinge called a knee or a calf and the line to its twin of the
other side. More than 60, where the thigh hangs down; of 120 models with knees, healthy ones among them, 1 had such
knees, and its legs could not step. A hip of one hinge that turns the same way is told with it.

When it is wrong: a leg that is meant to fold to the side, as a spider's; its thigh does not hang.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.probes.vector import Vector, dot, norm, sub, times, transpose, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A knee that turns sideways"
FAMILIES = ("stuck", "drifts", "wrong-numbers")
UNPLANTED = "which hinge is a knee, only names tell, and few healthy models of the bench have one that they name"

KNEE = re.compile("(?i)knee|calf")
FAR = 60.0  # degrees
HANGS = 0.8  # the cosine of the thigh's angle to the vertical


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The knees that turn about the way forwards, all together."""
    of = model.simulation
    of.as_written()
    axes = {joint: axis for pair in twins(of).pairs["joint"] for joint, axis in _turned(of, *pair).items()}
    if not axes:
        return
    first = min(axes)
    names = tuple(of.name("joint", joint) for joint in axes)
    yield Suspect(
        names,
        "axis",
        written(of.row("jnt_axis", first, 3)),
        axes[first],
        model.set_each("joint", "axis", axes),
        Probe(
            "angle of the axis to the line between left and right", "degrees", _angle, _pair(of, first), dynamic=False
        ),
        FAR,
        f"{names[0]} turns about an axis across the line between the legs: what hangs on it swings sideways.",
        "along the line between left and right",
    )


def _pair(of: Simulation, joint: int) -> tuple[int, int]:
    return next((joint, sum(pair) - joint) for pair in twins(of).pairs["joint"] if joint in pair)


def _turned(of: Simulation, left: int, right: int) -> dict[int, str]:
    """The axes that two knees and the hips above them should have, where both knees turn sideways."""
    made: dict[int, str] = {}
    for joint, other in ((left, right), (right, left)):
        leg = [each for body in of.ancestors(of.body_of("joint", joint)) for each in of.joints_of(body)]
        hinges = [each for each in leg if of.joint_type(each) == HINGE]
        if not KNEE.search(of.engine.name("joint", joint)) or len(hinges) < 2 or not _hangs(of, *hinges[:2]):
            return {}
        if (
            any(len(of.joints_of(of.body_of("joint", each))) > 1 for each in hinges[:2])
            or _angle(of, joint, other) < FAR
        ):
            return {}
        hip = hinges[1:] if len(hinges) == 2 else []
        for each in (joint, *hip):
            if abs(dot(of.axis(each), of.axis(joint))) > HANGS:
                frame = transpose(of.data_row("xmat", of.body_of("joint", each), 9))
                made[each] = written([round(x, 6) for x in times(frame, _across(of, left, right))])
    return made


def _hangs(of: Simulation, knee: int, hip: int) -> bool:
    thigh = sub(of.data_row("xanchor", hip, 3), of.data_row("xanchor", knee, 3))
    return thigh[2] > HANGS * norm(thigh) > 0


def _across(of: Simulation, left: int, right: int) -> Vector:
    """The direction of the line between two knees, whichever way is the more positive one."""
    way = sub(of.data_row("xanchor", right, 3), of.data_row("xanchor", left, 3))
    length = math.copysign(norm(way), sum(way))
    return (way[0] / length, way[1] / length, way[2] / length)


def _angle(of: Simulation, joint: int, other: int) -> float:
    """The angle in degrees of a hinge's axis to the line to its twin, in the pose of the file; 0 in one place."""
    of.as_written()
    way = sub(of.data_row("xanchor", other, 3), of.data_row("xanchor", joint, 3))
    cosine = dot(way, of.axis(joint)) / (norm(way) or 1e-12)
    return math.degrees(math.acos(min(1.0, abs(cosine)))) if norm(way) > 1e-6 else 0.0
