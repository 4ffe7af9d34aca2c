"""Joints that an equality couples: which follows which, and how."""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.simulation import Simulation

JOINT = 2  # mjtEq

Coupling = tuple[int, int, tuple[float, ...]]  # follower, leader, factors of the powers of the leader's way


def couplings(simulation: Simulation) -> Iterator[tuple[int, Coupling]]:
    """The equalities that couple two joints, and how."""
    for each in range(simulation.count("equality")):
        follower, leader = (int(simulation.model(f"eq_obj{side}id")[each]) for side in (1, 2))
        if int(simulation.model("eq_type")[each]) == JOINT and leader >= 0 and simulation.model("eq_active0")[each]:
            yield each, (follower, leader, simulation.equality_data(each)[:5])
