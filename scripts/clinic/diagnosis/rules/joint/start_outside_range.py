"""A joint starts outside of its range.

The start is 0 unless `ref` or a keyframe says otherwise. Outside of the range the limit throws the joint back in the
first steps.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="45 150"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" range="45 150"/>
    +       <joint name="elbow" axis="0 1 0" range="-5 150"/>

The number: how fast the limit makes the joint in the first 20 ms, without gravity and contacts; more than 1 rad/s or
0.1 m/s, and the start is outside by more than 5 % of the range. A robot of four joints and more that all start at 0 is
in the pose of its drawing, in which a knee that cannot be straight is outside by up to half of its range: there more
than that is told.

When it is wrong: a start that a program sets before the first step, as for robots whose knees cannot be straight; so
it is a hint, but where a keyframe gives the start. A model that has keyframes is not judged by its start without them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.servo import alone, hold
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A joint starts outside of its range"
FAMILIES = ("jumps-at-start", "explodes")
LEVEL = "hint"

OUTSIDE, UNPOSED = 0.05, 0.5  # of the range
ROBOT = 4  # hinges and slides
KICK = 1.0  # rad/s or m/s


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Joints that begin well outside, all together."""
    simulation = model.simulation
    if simulation.begin_with.key < 0 and simulation.count("key"):
        return  # a model that has keyframes begins with one
    found, limited = [], _limited(simulation)
    least = UNPOSED if _unposed(simulation) else OUTSIDE
    for joint, (low, high, begin) in limited.items():
        if max(low - begin, begin - high) > least * (high - low):
            found.append((joint, low, high, begin))
    if not found:
        return
    edits: tuple[Edit, ...] = ()
    for joint, low, high, begin in found:
        scale = model.angle_unit if simulation.joint_type(joint) == HINGE else 1.0
        margin = 0.02 * (high - low)
        ends = min(low, begin - margin) / scale, max(high, begin + margin) / scale
        edits += model.set("joint", [joint], "range", f"{ends[0]:.4g} {ends[1]:.4g}")
    joint, low, high, begin = max(found, key=lambda each: max(each[1] - each[3], each[3] - each[2]))
    joints = tuple(each[0] for each in found)
    yield Suspect(
        tuple(simulation.name("joint", each) for each in joints),
        "range",
        "",
        next((each.value for each in edits), ""),
        edits,
        Probe(
            "highest speed in the first 20 ms, without gravity and contacts (of a slide tenfold, in m/s)",
            "rad/s",
            _kick,
            (joints,),
        ),
        KICK,
        f"{simulation.name('joint', joint)} starts at {begin:.3g}, and its range is {low:.3g} to {high:.3g} "
        f"{simulation.unit(joint)}.",
        "inside of the range",
    )


def _unposed(simulation: Simulation) -> bool:
    """Whether no joint of a robot was put anywhere: the zero pose, in which no program leaves it."""
    posed = simulation.begin_with.key >= 0 or any(map(simulation.position, simulation.scalar_joints))
    return len(simulation.scalar_joints) >= ROBOT and not posed


def _limited(simulation: Simulation) -> dict[int, tuple[float, float, float]]:
    """The range and the start of each hinge and slide that has a range."""
    simulation.begin()
    return {joint: (*ends, simulation.position(joint)) for joint, ends in simulation.ranges.items()}


def _kick(simulation: Simulation, joints: tuple[int, ...]) -> float:
    with alone(simulation):
        simulation.begin()
        hold(simulation)
        fastest = 0.0
        for _ in range(max(2, round(0.02 / simulation.timestep))):
            simulation.engine.step()
            if simulation.unstable():
                return math.inf
            speeds = simulation.data("qvel")
            for joint in joints:
                speed = abs(speeds[simulation.dof(joint)])
                fastest = max(fastest, speed if simulation.joint_type(joint) == HINGE else 10 * speed)
    return fastest
