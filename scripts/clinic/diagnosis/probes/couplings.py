"""Joints that an equality couples: which follows which, and how."""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.equalities import COUPLED
from clinic.diagnosis.simulation import Simulation

POINTS = 41
SLACK = 0.02  # of the follower's range

Coupling = tuple[int, int, tuple[float, ...]]  # follower, leader, factors of the powers of the leader's way


def couplings(simulation: Simulation) -> Iterator[tuple[int, Coupling]]:
    """The equalities that couple two joints, and how."""
    for each in range(simulation.count("equality")):
        follower, leader = (int(simulation.model(f"eq_obj{side}id")[each]) for side in (1, 2))
        if int(simulation.model("eq_type")[each]) == COUPLED and leader >= 0 and simulation.model("eq_active0")[each]:
            yield each, (follower, leader, simulation.equality_data(each)[:5])


def led_over(simulation: Simulation, coupling: Coupling) -> list[float]:
    """Where the follower is led over the leader's range."""
    follower, leader, factors = coupling
    begins = [simulation.model("qpos0")[simulation.place(joint)] for joint in (follower, leader)]
    low, high = simulation.row("jnt_range", leader, 2)
    ways = [low + (high - low) * point / (POINTS - 1) - begins[1] for point in range(POINTS)]
    return [begins[0] + sum(factor * way**power for power, factor in enumerate(factors)) for way in ways]


def lost(simulation: Simulation, found: tuple[Coupling, ...]) -> float:
    """The largest share of a leader's range that leads its follower out of its own."""
    most = 0.0
    for coupling in found:
        if all(joint in simulation.ranges for joint in coupling[:2]):
            low, high = simulation.ranges[coupling[0]]
            slack = SLACK * (high - low)
            outside = [not low - slack <= place <= high + slack for place in led_over(simulation, coupling)]
            most = max(most, sum(outside) / POINTS)
    return most
