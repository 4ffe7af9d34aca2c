"""A keyframe beside its text: poses, targets of servos, depth in the floor."""

from __future__ import annotations

from clinic.diagnosis.engine import HINGE, PLANE, SLIDE
from clinic.diagnosis.probes import servo
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe


def start_at(simulation: Simulation, key: int) -> None:
    """Puts the simulation at a keyframe."""
    simulation.engine.reset(key)
    simulation.engine.forward()


def servos(simulation: Simulation, key: int) -> dict[int, tuple[float, float]]:
    """Of position servos on hinges and slides: the target in a keyframe and the joint's position, in rad or m."""
    found = servo.servos(simulation)
    start_at(simulation, key)
    ctrl = simulation.data("ctrl")
    return {
        each.actuator: (each.offset + each.scale * ctrl[each.actuator], simulation.position(each.joint))
        for each in found
        if each.scale > 0
    }


def _off(simulation: Simulation, key: int) -> float:
    apart = sorted(abs(target - at) for target, at in servos(simulation, key).values())
    return apart[len(apart) * 3 // 4] if apart else 0.0


def off_target(key: int) -> Probe:
    """How far three quarters of the servos are at most from their targets in a keyframe."""
    return Probe("distance of three quarters of the servos from their targets", "rad", _off, (key,), dynamic=False)


def _depth(simulation: Simulation, key: int) -> float:
    start_at(simulation, key)
    kinds, bodies = simulation.model("geom_type"), simulation.model("geom_bodyid")
    moving = set(simulation.moving_bodies)
    deep = [0.0]
    for contact in simulation.engine.contacts():
        planes = [int(kinds[geom]) == PLANE for geom in contact.geoms]
        if any(planes) and any(int(bodies[geom]) in moving for geom in contact.geoms):
            deep.append(-contact.distance)
    return max(deep)


def sunk(key: int) -> Probe:
    """How deep something that moves is in a plane at a keyframe."""
    return Probe("depth in the floor at the keyframe", "m", _depth, (key,), dynamic=False)


def _beyond(simulation: Simulation, key: int) -> float:
    return max((abs(off) for off in beyond(simulation, key).values()), default=0.0)


def beyond(simulation: Simulation, key: int) -> dict[int, float]:
    """Of hinges and slides outside of their ranges at a keyframe: how far, in rad or m, negative below."""
    start_at(simulation, key)
    made = {}
    for joint in range(simulation.count("joint")):
        if simulation.joint_type(joint) in (SLIDE, HINGE) and simulation.model("jnt_limited")[joint]:
            low, high = simulation.row("jnt_range", joint, 2)
            off = min(0.0, simulation.position(joint) - low) + max(0.0, simulation.position(joint) - high)
            if off:
                made[joint] = off
    return made


def outside(key: int) -> Probe:
    """How far the worst joint is outside of its range at a keyframe."""
    return Probe("worst joint outside of its range at the keyframe", "rad", _beyond, (key,), dynamic=False)
