"""A nudge: whether the model comes to rest, or rattles from step to step."""

from __future__ import annotations

import math

from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.servo import alone, hold
from clinic.diagnosis.simulation import ENDLESS, Simulation, kept
from clinic.diagnosis.suspect import probe

NUDGE = 0.01  # rad or m
SECONDS = 0.5
SLIDES = 10.0  # times the speed in m/s of a slide, to be compared with that of a hinge
LOOKED_AT = 40  # steps
SHAKES = 5.0  # rad/s a step, above which a joint rattles


@probe(
    "to and fro of a joint's speed from step to step, 0.5 s after a nudge of 0.01 rad without contacts and gravity",
    "rad/s",
)
@kept
def shake(simulation: Simulation) -> float:
    """How much the speed of a joint jumps to and fro from one step to the next, after a nudge."""
    with alone(simulation):
        return _shaken(simulation)


def _shaken(simulation: Simulation) -> float:
    simulation.begin()
    for joint in simulation.scalar_joints:
        simulation.put(joint, _off_the_limits(simulation, joint))
    hold(simulation)
    for joint in simulation.scalar_joints:
        begin, (low, high) = simulation.position(joint), simulation.ranges.get(joint, ENDLESS)
        simulation.put(joint, begin + NUDGE if begin + NUDGE < high else max(low, begin - NUDGE))
    scale = [SLIDES if simulation.joint_type(joint) == SLIDE else 1.0 for joint in simulation.dof_joints]
    for _ in simulation.run(SECONDS, samples=20):
        if simulation.unstable():
            return math.inf
    speeds, changes = list(simulation.data("qvel")), [0.0] * simulation.count("dof")
    turned, turns = [0.0] * len(changes), [0] * len(changes)
    for _ in range(LOOKED_AT):
        simulation.engine.step()
        now = list(simulation.data("qvel"))
        for dof, (old, new) in enumerate(zip(speeds, now, strict=True)):
            if (new - old) * changes[dof] < 0:
                turned[dof] += scale[dof] * abs(new - old) / LOOKED_AT
                turns[dof] += 1
            changes[dof] = new - old
        speeds = now
    if simulation.unstable():
        return math.inf
    return max((each for each, often in zip(turned, turns, strict=True) if often > LOOKED_AT / 2), default=0.0)


def _off_the_limits(simulation: Simulation, joint: int) -> float:
    """Where a joint stands, or so far from its limit that this does not hold it: at most the middle of its range."""
    begin, (low, high) = simulation.position(joint), simulation.ranges.get(joint, ENDLESS)
    if not low <= begin <= high:
        return begin
    away = min(2 * NUDGE, (high - low) / 2)
    return min(max(begin, low + away), high - away)
