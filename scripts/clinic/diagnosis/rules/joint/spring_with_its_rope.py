"""A spring pulls the same way as the rope that is to work against it.

A rope pulls and cannot push: what it closes, a spring opens again. With `springref` on the far side of the start, in
the direction in which the rope pulls, the finger is closed before anything pulls, and nothing opens it.

Bad:

    <mujoco>
      <compiler angle="degree"/>
      <worldbody>
        <site name="winch" pos="0.02 0 0.9"/>
        <body name="finger" pos="0 0 1">
          <joint name="knuckle" axis="0 1 0" range="-10 90" stiffness="0.1" springref="60" damping="0.02"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.04" size="0.008" mass="0.02"/>
          <site name="eye" pos="0.01 0 0.02"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="cable">
          <site site="winch"/>
          <site site="eye"/>
        </spatial>
      </tendon>
      <actuator>
        <motor tendon="cable" gear="-1" ctrlrange="0 25"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="knuckle" axis="0 1 0" range="-10 90" stiffness="0.1" springref="60" damping="0.02"/>
    +       <joint name="knuckle" axis="0 1 0" range="-10 90" stiffness="0.1" springref="0" damping="0.02"/>

The number: how far the spring is at rest from the start, in the direction in which all motors on the joint pull, each
by a control range of one sign, as a share of the joint's range; from 0.25 on. Not where a motor works the other way, or
where gravity turns the joint with half of the spring's force and more, over its poses, and may open it.

When it is wrong: a spring that takes up slack; what something outside opens.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.load import loads
from clinic.diagnosis.probes.tendons import pulled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A spring that pulls with its rope"
FAMILIES = ("wrong-numbers", "stuck", "drifts")
UNPLANTED = "healthy models have few ropes that a spring works against"

LEAST, HOLDS = 0.25, 0.5  # of the range; of the spring's force
STEP = 0.02  # of the range


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints with such a spring, those of one rest together."""
    of = model.simulation
    alike: dict[float, list[int]] = {}
    for joint in of.ranges:
        if of.model("jnt_stiffness")[joint] > 0 and _along(of, joint) > LEAST:
            alike.setdefault(of.model("qpos_spring")[of.place(joint)], []).append(joint)
    for rest, joints in alike.items():
        begins = {each: f"{of.model('qpos0')[of.place(each)] / _unit(model, each):.4g}" for each in joints}
        names, now = tuple(of.name("joint", each) for each in joints), f"{rest / _unit(model, joints[0]):.4g}"
        says = f"The spring of {names[0]} closes it as far as {now}, the way its rope pulls, and nothing pulls it back."
        yield Suspect(
            names,
            "springref",
            now,
            begins[joints[0]],
            model.set_each("joint", "springref", begins),
            Probe(
                "way to the spring's rest along the rope's pull", "of the range", _most, tuple(joints), dynamic=False
            ),
            LEAST,
            says,
            "at the start, or on the other side",
        )


def _unit(model: ReaderModel, joint: int) -> float:
    return model.angle_unit if model.simulation.unit(joint) == "rad" else 1.0


def _most(of: Simulation, *joints: int) -> float:
    return max(_along(of, joint) for joint in joints)


def _along(of: Simulation, joint: int) -> float:
    """How far a spring is at rest from the start along its rope's pull, over the range; 0 where something opens it."""
    (low, high), place = of.ranges[joint], of.place(joint)
    way = of.model("qpos_spring")[place] - of.model("qpos0")[place]
    if low >= high or abs(way) < LEAST * (high - low) or not any(_ropes(of)):
        return 0.0
    pulls = {pull for each in _ropes(of) if (pull := _pull(of, each, joint)) is not None}
    if joint in of.drivers or pulls != {math.copysign(1, way)}:
        return 0.0
    weak = loads(of)[of.dof(joint)] < HOLDS * of.model("jnt_stiffness")[joint] * abs(way)
    return abs(way) / (high - low) if weak else 0.0


def _ropes(of: Simulation) -> list[tuple[int, int]]:
    """The actuators on tendons, with these."""
    return list(pulled(of).items())


def _pull(of: Simulation, rope: tuple[int, int], joint: int) -> float | None:
    """Which way an actuator on a tendon turns a joint, 1 or -1; 0 where both ways, None where it does not."""
    actuator, tendon = rope
    (low, high), lengths = of.ranges[joint], list[float]()
    for step in (-STEP, STEP):
        of.as_written()
        of.put(joint, of.position(joint) + step * (high - low))
        of.engine.forward()
        lengths.append(of.data("ten_length")[tendon])
    slope = (lengths[1] - lengths[0]) * of.gear(actuator) * of.gain(actuator)[0]
    if abs(slope) < 1e-9:
        return None
    least, most = of.row("actuator_ctrlrange", actuator, 2)
    one_sided = of.model("actuator_ctrllimited")[actuator] and least * most >= 0 and least < most
    if not of.is_motor(actuator) or not one_sided:
        return 0.0
    return math.copysign(1, slope * (least + most))
