"""Pushing what can leave its place, once it has come to rest: does friction stop it?"""

from __future__ import annotations

import math

from clinic.diagnosis.engine import FREE, SLIDE
from clinic.diagnosis.probes.run import State, let_go, state
from clinic.diagnosis.probes.shape import falling, root_of, size
from clinic.diagnosis.probes.vector import Vector, at, cross, dot, sub
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import probe

FRICTION = 0.3  # stops what is pushed within the time that the probe waits
GRAVITY = 9.81
PART = 0.1  # a push as fast as a fall over half this part of the thing's radius: without friction it slides by a third


@probe("pushed at rest, its contacts still slide with", "of the push's speed")
def slides_on(simulation: Simulation) -> float:
    """The share of a push's speed with which the contacts still slide when friction 0.3 would have stopped them."""
    run = let_go(simulation)
    if run.end is None:
        return float("inf")
    pushed = list(falling(simulation))
    return max((_pushed(simulation, run.end, pushed, axis) for axis in (0, 1)), default=0.0) if pushed else 0.0


def _pushed(simulation: Simulation, rest: State, pushed: list[int], along: int) -> float:
    gravity = simulation.gravity or GRAVITY
    simulation.begin()
    simulation.engine.write("qpos", rest.qpos)
    velocities = [0.0] * len(rest.qvel)
    scale = min(size(simulation, root) for root in pushed) or 0.1
    speed = math.sqrt(PART * gravity * scale)
    # neighbours are pushed apart, so that those of a pile slide on each other as well
    for number, root in enumerate(pushed):
        sign = 1 if number % 2 == 0 else -1
        for joint in simulation.joints_of(root):
            kind, axis = simulation.joint_type(joint), simulation.row("jnt_axis", joint, 3)
            if kind == FREE or (kind == SLIDE and abs(axis[along]) > 0.7):
                velocities[simulation.dof(joint) + (along if kind == FREE else 0)] = sign * speed
    simulation.engine.write("qvel", velocities)
    for _ in simulation.run(speed / (FRICTION * gravity), samples=1):
        pass
    if simulation.unstable():
        return float("inf")
    return max((each / speed for each in _slips(simulation).values()), default=0.0)


def _slips(simulation: Simulation) -> dict[int, float]:
    """For each tree how fast its contacts slide in m/s, the mean by force."""
    simulation.engine.forward()
    now, owner, bodies = state(simulation), root_of(simulation), simulation.model("geom_bodyid")
    tops, coms, moves = simulation.model("body_rootid"), simulation.data("subtree_com"), simulation.data("cvel")

    def velocity(body: int, place: Vector) -> Vector:
        turn, way = tuple(moves[6 * body : 6 * body + 3]), tuple(moves[6 * body + 3 : 6 * body + 6])
        lever = sub(place, at(coms, int(tops[body])))
        lift = cross(turn, lever)
        return (way[0] + lift[0], way[1] + lift[1], way[2] + lift[2])

    sums: dict[int, tuple[float, float]] = {}
    for contact in now.contacts:
        one, other = (int(bodies[geom]) for geom in contact.geoms)
        if owner[one] == owner[other] or contact.force <= 0:
            continue
        apart = sub(velocity(one, contact.position), velocity(other, contact.position))
        along = dot(apart, contact.normal)
        slip = math.sqrt(max(0.0, dot(apart, apart) - along * along))
        for root in {owner[one], owner[other]} - {0}:
            weight, total = sums.get(root, (0.0, 0.0))
            sums[root] = (weight + contact.force, total + contact.force * slip)
    return {root: total / weight for root, (weight, total) in sums.items()}


@probe("of its speed it has after a second of rolling")
def rolls_on(simulation: Simulation, body: int) -> float:
    """The share of a ball's speed that is left after a second of rolling."""
    run = let_go(simulation)
    if run.end is None:
        return 0.0
    simulation.begin()
    simulation.engine.write("qpos", run.end.qpos)
    dof = simulation.dof(simulation.joints_of(body)[0])
    simulation.engine.write("qvel", [0.0] * len(run.end.qvel))
    simulation.engine.write("qvel", [1.0], dof)
    speeds = [math.hypot(*simulation.data("qvel")[dof : dof + 2]) for _ in simulation.run(1.5, samples=3)]
    rolled = len(speeds) > 1 and 0.1 < speeds[0] >= 0.95 * speeds[-1]
    return speeds[-1] / speeds[0] if rolled else 0.0


@probe("contacts slide on it after 2 s with", "radii a second")
def creeps(simulation: Simulation, body: int) -> float:
    """How fast what is held slides in the grasp once the model was let go."""
    run = let_go(simulation)
    if run.end is None:
        return float("inf")
    simulation.begin()
    simulation.engine.write("qpos", run.end.qpos)
    simulation.engine.write("qvel", run.end.qvel)
    for _ in simulation.run(0.1, samples=1):
        pass
    return _slips(simulation).get(body, 0.0) / max(size(simulation, body), 1e-9)
