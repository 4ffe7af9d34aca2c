"""What gravity asks of each servo: at the start, and over poses within the ranges of the joints."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from clinic.diagnosis.probes.equalities import CONNECT, gap, kind_of
from clinic.diagnosis.probes.servo import Servo, alone, hold, servos
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, probe

POSES = 16
SPREAD = 0.5  # rad or m, of a joint without a range
HANGS, FULL, TOLD = 1.0, 0.98, 0.01  # s; of the greatest force; of its range, that a servo may be told to leave
CLOSED = 0.01  # of the model's extent


def poses(simulation: Simulation) -> list[list[float]]:
    """The start, and poses drawn over the ranges; the start alone where links close a loop."""
    simulation.begin(forward=False)
    begin = list(simulation.data("qpos"))
    if CONNECT in map(int, simulation.model("eq_type")):
        return [begin]
    drawn, seed = [begin], 12345 + simulation.begin_with.seed
    for _ in range(POSES):
        pose = list(begin)
        for joint in range(simulation.count("joint")):
            seed = (1103515245 * seed + 12345) % 2**31
            if joint not in simulation.scalar_joints:
                continue
            place = simulation.place(joint)
            low, high = simulation.ranges.get(joint, (begin[place] - SPREAD, begin[place] + SPREAD))
            pose[place] = low + (high - low) * seed / 2**31
        drawn.append(pose)
    return drawn


@kept
def loads(simulation: Simulation) -> list[float]:
    """The largest force of gravity on each degree of freedom over the poses, in N m or N."""
    return _over_poses(simulation, max)


@kept
def least_loads(simulation: Simulation) -> list[float]:
    """The smallest force of gravity on each degree of freedom over the poses, in N m or N."""
    return _over_poses(simulation, min)


def _over_poses(simulation: Simulation, pick: Callable[..., float]) -> list[float]:
    with alone(simulation, gravity=True):
        return list(map(pick, zip(*_all_loads(simulation), strict=True)))


def _all_loads(simulation: Simulation) -> Iterator[list[float]]:
    """The forces of gravity in each of the poses."""
    for pose in poses(simulation):
        simulation.begin(forward=False)
        simulation.engine.write("qpos", pose)
        simulation.engine.write("qvel", [0.0] * simulation.count("dof"))
        simulation.engine.forward()
        forces = zip(simulation.data("qfrc_bias"), simulation.data("qfrc_gravcomp"), strict=True)
        yield [abs(bias - gravcomp) for bias, gravcomp in forces]


def _worst(simulation: Simulation, find: Callable[[Simulation], dict[int, float]], actuators: Sequence[int]) -> float:
    found = find(simulation)
    return max((found[each] for each in actuators if each in found), default=0.0)


def sags(simulation: Simulation) -> dict[int, float]:
    """How far the load moves the joint of each servo off its target, in rad or m."""
    held: dict[int, float] = {}
    for servo in servos(simulation):
        held[servo.dof] = held.get(servo.dof, simulation.model("jnt_stiffness")[servo.joint]) + servo.stiffness
    friction, load = simulation.model("dof_frictionloss"), loads(simulation)
    return {
        each.actuator: max(0.0, load[each.dof] - friction[each.dof]) / held[each.dof] for each in servos(simulation)
    }


def sag(actuators: Sequence[int]) -> Probe:
    """How far servos sag under the model's own weight."""
    title = f"farthest that the model's own weight moves the joint off its target, over {POSES + 1} poses"
    return Probe(title, "rad", _worst, (sags, tuple(actuators)), dynamic=False)


def strains(simulation: Simulation) -> dict[int, float]:
    """The load of each servo's joint over the most that the servos of that joint give."""
    given: dict[int, float] = {}
    for servo in servos(simulation):
        given[servo.dof] = given.get(servo.dof, simulation.model("dof_frictionloss")[servo.dof]) + servo.force
    load = loads(simulation)
    return {each.actuator: load[each.dof] / max(given[each.dof], 1e-12) for each in servos(simulation)}


def strain(actuators: Sequence[int]) -> Probe:
    """The share of its greatest force that a servo needs to hold the model's own weight."""
    title = f"the model's own weight at the joint over the greatest force of its servo, over {POSES + 1} poses"
    return Probe(title, "", _worst, (strains, tuple(actuators)), dynamic=False)


@kept
def carriers(simulation: Simulation) -> dict[Servo, Servo]:
    """For each hinge's servo with a limited force the hardest-pressed of those that carry it and as much, or more."""
    of, load = simulation, loads(simulation)
    limited = {each.joint: each for each in servos(of) if each.hinge and math.isfinite(each.force)}
    made = {}
    for joint, servo in limited.items():
        above = [each for body in of.ancestors(of.body_of("joint", joint))[1:] for each in of.joints_of(body)]
        carry = [limited[each] for each in above if each in limited and load[limited[each].dof] >= load[servo.dof] > 0]
        if carry:
            made[servo] = max(carry, key=lambda each: strains(of)[each.actuator])
    return made


@probe(
    "share of its greatest force that the weight takes, over that of the servos which carry the joint", dynamic=False
)
def outdone(simulation: Simulation, actuators: Sequence[int]) -> float:
    """How many times the share of its force that a servo needs is that of the servos that carry it."""
    found, over = strains(simulation), carriers(simulation)
    shares = [found[one.actuator] / found[other.actuator] for one, other in over.items() if one.actuator in actuators]
    return max(shares, default=0.0)


@kept
def yielded(simulation: Simulation) -> dict[Servo, float]:
    """How far servos of closed loops that hold the start give way to gravity, where they give all that they can.

    In rad or m; the contacts are off. None of a robot that stands freely, or whose loops are open at the start.
    """
    of, owner = simulation, root_of(simulation)
    of.begin()
    loops = [each for each, on in enumerate(of.model("eq_active0")) if on and kind_of(of, each) == CONNECT]
    least = CLOSED * of.extent
    if not loops or any((gap(of, each) or 0.0) > least for each in loops) or not of.gravity:
        return {}
    begun = {
        each: of.position(each.joint)
        for each in servos(of)
        if math.isfinite(each.force) and owner[of.body_of("joint", each.joint)] not in of.free_bodies
    }
    with alone(of, gravity=True):
        hold(of)
        for _ in of.run(HANGS, samples=4) if begun else ():
            if of.unstable():
                return {}
    forces, targets = of.data("qfrc_actuator"), of.data("ctrl")
    return {
        each: abs(of.position(each.joint) - place)
        for each, place in begun.items()
        if abs(forces[each.dof]) >= FULL * each.force
        and abs(each.target(targets[each.actuator]) - place) <= TOLD * travel(each)
    }


def travel(servo: Servo) -> float:
    """How far a joint goes in rad or m: its range, or what is usual where it has none."""
    return servo.range[1] - servo.range[0] if servo.range else 2 * SPREAD


@probe(f"how far the weight moves a servo's joint within {HANGS:g} s that is told to hold the start", "of its range")
def yields(simulation: Simulation, actuators: Sequence[int]) -> float:
    """How far servos of a closed loop give way to the weight."""
    found = yielded(simulation).items()
    return max((way / travel(each) for each, way in found if each.actuator in actuators), default=0.0)
