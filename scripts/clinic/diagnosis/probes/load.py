"""What gravity asks of each servo: at the start, and over poses within the ranges of the joints."""

from __future__ import annotations

from collections.abc import Sequence

from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.equalities import CONNECT
from clinic.diagnosis.probes.servo import alone, servos
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe

POSES = 16
SPREAD = 0.5  # rad or m, of a joint without a range


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
            if simulation.joint_type(joint) not in (HINGE, SLIDE):
                continue
            place = simulation.place(joint)
            low, high = begin[place] - SPREAD, begin[place] + SPREAD
            if simulation.model("jnt_limited")[joint]:
                low, high = simulation.row("jnt_range", joint, 2)
            pose[place] = low + (high - low) * seed / 2**31
        drawn.append(pose)
    return drawn


@kept
def loads(simulation: Simulation) -> list[float]:
    """The largest force of gravity on each degree of freedom over the poses, in N m or N."""
    with alone(simulation, gravity=True):
        return _loads(simulation)


def _loads(simulation: Simulation) -> list[float]:
    most = [0.0] * simulation.count("dof")
    for pose in poses(simulation):
        simulation.begin(forward=False)
        simulation.engine.write("qpos", pose)
        simulation.engine.write("qvel", [0.0] * len(most))
        simulation.engine.forward()
        for dof, (bias, gravcomp) in enumerate(
            zip(simulation.data("qfrc_bias"), simulation.data("qfrc_gravcomp"), strict=True)
        ):
            most[dof] = max(most[dof], abs(bias - gravcomp))
    return most


def _sag(simulation: Simulation, actuators: Sequence[int]) -> float:
    found = sags(simulation)
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
    return Probe(title, "rad", _sag, (tuple(actuators),), dynamic=False)


def _strain(simulation: Simulation, actuators: Sequence[int]) -> float:
    found = strains(simulation)
    return max((found[each] for each in actuators if each in found), default=0.0)


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
    return Probe(title, "", _strain, (tuple(actuators),), dynamic=False)
