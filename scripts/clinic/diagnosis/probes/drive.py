"""Joints driven with all that their actuators may give: how much of the way they go."""

from __future__ import annotations

import math

from clinic.diagnosis.engine import HINGE, TRN_IN_PARENT, TRN_SITE, TRN_TENDON
from clinic.diagnosis.probes.run import model_size
from clinic.diagnosis.probes.servo import alone, command, hold, servos
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

SECONDS = 2.0


@probe("share of the way to 1 rad (0.1 m) or the far limit that is left after 2 s of all that the actuators give")
def way_left(simulation: Simulation, joints: tuple[int, ...]) -> float:
    """How much is left of 1 rad (0.1 m), or of the way to the far limit, after driving a joint there for 2 s."""
    return max((_left_of(simulation, joint) for joint in joints), default=0.0)


@kept
def _left_of(simulation: Simulation, joint: int) -> float:
    with alone(simulation):
        return _driven(simulation, joint)


def _driven(simulation: Simulation, joint: int) -> float:
    simulation.begin()
    hold(simulation)
    begin = simulation.position(joint)
    way = 1.0 if simulation.joint_type(joint) == HINGE else 0.1
    side = 1.0
    if joint in simulation.ranges:
        low, high = simulation.ranges[joint]
        side = 1.0 if high - begin >= begin - low else -1.0
        way = min(way, max(high - begin, begin - low))
    own = {each.actuator: each for each in servos(simulation) if each.joint == joint}
    for actuator in range(simulation.count("actuator")):
        if actuator in own:
            command(simulation, own[actuator], begin + side * way)
        elif force := pulls(simulation).get(joint, {}).get(actuator):
            ends = simulation.row("actuator_ctrlrange", actuator, 2)
            simulation.engine.write("ctrl", [max(ends, key=lambda end: side * force * end)], actuator)
        elif simulation.driven_joint(actuator) == joint and simulation.model("actuator_ctrllimited")[actuator]:
            ends = simulation.row("actuator_ctrlrange", actuator, 2)
            turned = side * simulation.gear(actuator) > 0
            simulation.engine.write("ctrl", [ends[1] if turned else ends[0]], actuator)
    farthest = 0.0
    for _ in simulation.run(SECONDS, samples=20):
        if simulation.unstable():
            return math.inf
        farthest = max(farthest, side * (simulation.position(joint) - begin))
    return 1 - min(1.0, farthest / way)


@kept
def pulls(simulation: Simulation) -> dict[int, dict[int, float]]:
    """What motors at sites and tendons give, for a control of 1, at hinges and slides that nothing else drives.

    At the start, and of a tendon the most of that and of all joints at the ends and in the middle of their ranges, for
    a cable that lies along a finger has no lever until that is bent.
    """
    of, made = simulation, dict[int, dict[int, float]]()
    kinds = [int(each) for each in of.model("actuator_trntype")]
    limited = of.model("actuator_ctrllimited")
    found = [each for each, kind in enumerate(kinds) if kind in (TRN_SITE, TRN_TENDON) and limited[each]]
    if any(kind > TRN_IN_PARENT and each not in found for each, kind in enumerate(kinds)):
        return {}
    if any(not of.is_motor(actuator) for actuator in found):
        return {}
    for actuator in found:
        for share in (None, 0.0, 0.5, 1.0) if kinds[actuator] == TRN_TENDON else (None,):
            of.begin(forward=False)
            for joint, (low, high) in of.ranges.items() if share is not None else ():
                of.put(joint, low + (share or 0.0) * (high - low))
            of.engine.write("ctrl", [float(each == actuator) for each in range(len(kinds))])
            of.engine.forward()
            forces = of.data("qfrc_actuator")
            for joint in of.scalar_joints:
                now = forces[of.dof(joint)]
                if joint not in of.drivers and abs(now) > abs(made.get(joint, {}).get(actuator, 0.0)):
                    made.setdefault(joint, {})[actuator] = now
    return made


def pull(simulation: Simulation, joint: int) -> float:
    """The most that such motors give at a joint of `pulls`, all together."""
    ranges = _ranges(simulation)
    found = pulls(simulation).get(joint, {})
    return sum(abs(force) * max(map(abs, ranges[actuator])) for actuator, force in found.items())


def _ranges(simulation: Simulation) -> list[tuple[float, ...]]:
    """The lowest and the highest control of each actuator; -1 and 1 where it has no range."""
    limited = simulation.model("actuator_ctrllimited")
    return [tuple(simulation.row("actuator_ctrlrange", i, 2)) if on else (-1.0, 1.0) for i, on in enumerate(limited)]


@probe("fastest joint with all controls at the ends of their ranges", "rad/s")
def commanded(simulation: Simulation) -> float:
    """The highest speed while all controls are at the upper ends of their ranges, then at the lower ones."""
    made = 0.0
    for end in (1, 0):
        simulation.begin()
        simulation.engine.write("ctrl", [ends[end] for ends in _ranges(simulation)], 0)
        for _ in simulation.run(SECONDS, samples=20):
            if simulation.unstable():
                return math.inf
            made = max([made, *map(abs, simulation.data("qvel"))])
    return made


@probe("deepest contact while the actuators go to and fro over half of their ranges", "of the model's extent")
def pressed_in(simulation: Simulation) -> float:
    """How deep the deepest contact is while every actuator goes to and fro over half of its range."""
    ranges, deepest = _ranges(simulation), 0.0
    if not ranges:
        return 0.0
    simulation.begin()
    for time in simulation.run(SECONDS):
        sides = [math.copysign(0.25, math.sin(2 * math.pi * (1 + i % 3) * time + 0.3)) for i in range(len(ranges))]
        controls = [(low + high) / 2 + side * (high - low) for side, (low, high) in zip(sides, ranges, strict=True)]
        simulation.engine.write("ctrl", controls, 0)
        if simulation.unstable():
            return math.inf
        deepest = max([deepest, *(-contact.distance for contact in simulation.engine.contacts())])
    return deepest / model_size(simulation)
