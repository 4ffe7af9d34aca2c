"""Springs of joints that a timestep is too coarse for: where they are, beside where a tenth of the step takes them."""

from __future__ import annotations

import math

from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

COARSE = 1.0  # the step times the natural frequency in rad/s: a period has 2 pi over that many steps
SECONDS, SAMPLES, FINER = 1.0, 20, 10
STEPS = 20000  # at most, of the finer run


@kept
def coarse(simulation: Simulation) -> dict[int, float]:
    """The hinges and slides whose springs swing within few steps, and how many steps a period has."""
    of, made = simulation, dict[int, float]()
    for joint, stiffness in enumerate(of.model("jnt_stiffness")):
        if stiffness > 0 and joint in of.scalar_joints:
            turned = of.timestep * math.sqrt(stiffness * of.model("dof_invweight0")[of.dof(joint)])
            if turned > COARSE:
                made[joint] = 2 * math.pi / turned
    return made


def _way(simulation: Simulation, step: float) -> list[list[float]]:
    """Where the springs are at so many moments of a second, computed with a timestep."""
    of, made = simulation, list[list[float]]()
    of.engine.write_model("opt.timestep", [step])
    try:
        of.begin()
        for _ in range(SAMPLES):
            of.engine.step(max(1, round(SECONDS / SAMPLES / step)))
            made.append([of.position(joint) for joint in coarse(of)])
    finally:
        of.engine.write_model("opt.timestep", [of.timestep])
    return made


@probe("how far a spring's joint is from where a tenth of the step takes it, within 1 s", "of its range")
@kept
def strays(simulation: Simulation) -> float:
    """How far springs of few steps a period are from where a tenth of the step takes them, within a second."""
    of, step = simulation, simulation.timestep
    if not coarse(of) or FINER * SECONDS / step > STEPS:
        return 0.0
    mine, finer = _way(of, step), _way(of, step / FINER)
    ranges = [of.ranges.get(joint, (0.0, 1.0)) for joint in coarse(of)]
    apart = (
        abs(one - other) / (high - low)
        for there, here in zip(mine, finer, strict=True)
        for one, other, (low, high) in zip(there, here, ranges, strict=True)
    )
    return max(apart) if not of.unstable() else math.inf
