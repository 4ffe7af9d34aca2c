"""Whether a limit pushes a joint back that is beyond its range."""

from __future__ import annotations

from collections.abc import Sequence

from clinic.diagnosis.probes.servo import alone
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe


def _unstopped(simulation: Simulation, joints: tuple[int, ...]) -> float:
    free = False
    with alone(simulation, limp=True):
        for joint in joints:
            low, high = sorted(simulation.row("jnt_range", joint, 2))
            simulation.begin(forward=False)
            beyond = high + 0.1 * max(high - low, 0.1)
            simulation.put(joint, beyond)
            simulation.engine.forward()
            free = free or not simulation.data("qfrc_constraint")[simulation.dof(joint)] < 0
    return float(free)


def unstopped(joints: Sequence[int], which: str = "a joint") -> Probe:
    """Whether nothing pushes one of some hinges and slides back, a tenth of its range beyond it: 0 or 1."""
    title = f"1 where nothing pushes {which} back from beyond its range"
    return Probe(title, "", _unstopped, (tuple(joints),), dynamic=False)
