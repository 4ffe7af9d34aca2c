"""Servos pressed to the ends of their control ranges: how far their joints go beyond their limits."""

from __future__ import annotations

import math
from collections.abc import Sequence

from clinic.diagnosis.probes.servo import alone, hold, servos
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

SECONDS = 1.0


@probe("farthest beyond a limit after 1 s at an end of the control range, as a share of the joint's range")
@kept
def past_limit(simulation: Simulation, actuators: Sequence[int]) -> float:
    """How far beyond their limits servos push their joints."""
    with alone(simulation):
        return max(_pressed(simulation, actuators, end) for end in (0, 1))


def _pressed(simulation: Simulation, actuators: Sequence[int], end: int) -> float:
    simulation.begin()
    hold(simulation)
    pressed = [each for each in servos(simulation) if each.actuator in actuators and each.ctrl and each.range]
    for servo in pressed:
        assert servo.ctrl is not None
        simulation.engine.write("ctrl", [servo.ctrl[end]], servo.actuator)
    for _ in simulation.run(SECONDS, samples=5):
        if simulation.unstable():
            return math.inf
    farthest = 0.0
    for servo in pressed:
        assert servo.range is not None
        low, high = servo.range
        place = simulation.position(servo.joint)
        farthest = max(farthest, (low - place) / (high - low), (place - high) / (high - low))
    return farthest
