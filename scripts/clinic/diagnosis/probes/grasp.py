"""Closing the fingers on what lies between them: what friction can carry of it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from clinic.diagnosis.probes.servo import hold
from clinic.diagnosis.probes.touch import Deciding, deciding
from clinic.diagnosis.probes.vector import dot
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe

SECONDS = 1.0
OPPOSITE = -0.7  # cosine of the normals of two fingers


@dataclass(frozen=True)
class Grasp:
    """A free body between fingers: their normal forces, what friction carries of them, and its weight, all in N."""

    body: int
    force: float
    carries: float
    weight: float
    deciding: tuple[Deciding, ...]


@kept
def grasps(simulation: Simulation) -> list[Grasp]:
    """What is held when all fingers go to one end of their controls, without gravity."""
    gravity = simulation.model("opt.gravity")
    fingers = _fingers(simulation) if simulation.free_bodies and any(gravity) else []
    return [each for end in (0, 1) for each in _held(simulation, fingers, end)] if fingers else []


def _fingers(simulation: Simulation) -> list[int]:
    """The actuators with a control range of joints that carry no other joint."""
    parents, jointed = simulation.model("body_parentid"), simulation.model("body_jntnum")
    carriers = {int(parents[body]) for body in range(1, simulation.count("body")) if jointed[body]}
    made = []
    for actuator in range(simulation.count("actuator")):
        joint = simulation.driven_joint(actuator)
        body = simulation.body_of("joint", joint) if joint is not None else 0
        if joint is not None and body not in carriers and simulation.model("actuator_ctrllimited")[actuator]:
            made.append(actuator)
    return made if len(made) > 1 else []


def _held(simulation: Simulation, fingers: list[int], end: int) -> list[Grasp]:
    gravity, bodies = list(simulation.model("opt.gravity")), simulation.model("geom_bodyid")
    simulation.engine.write_model("opt.gravity", [0.0, 0.0, 0.0])
    try:
        simulation.begin()
        hold(simulation)
        for actuator in fingers:
            simulation.engine.write("ctrl", [simulation.row("actuator_ctrlrange", actuator, 2)[end]], actuator)
        for _ in simulation.run(SECONDS, samples=4):
            pass
        contacts = [] if simulation.unstable() else simulation.engine.contacts()
    finally:
        simulation.engine.write_model("opt.gravity", gravity)
    made, free = [], set(simulation.free_bodies)
    for body in free:
        pressed = []
        for contact in contacts:
            sides = [int(bodies[geom]) if geom >= 0 else 0 for geom in contact.geoms]
            other = sides[0] + sides[1] - body
            if body in sides and contact.force > 0 and other not in free and other in simulation.moving_bodies:
                sign = 1 if sides[1] == body else -1
                pressed.append((contact, tuple(sign * x for x in contact.normal)))
        if any(dot(one, other) < OPPOSITE for _, one in pressed for _, other in pressed):
            decided = [deciding(simulation, contact) for contact, _ in pressed]
            forces = [contact.force for contact, _ in pressed]
            carries = sum(force * each.friction for force, each in zip(forces, decided, strict=True))
            weight = math.hypot(*gravity) * simulation.model("body_subtreemass")[body]
            made.append(Grasp(body, sum(forces), carries, weight, tuple(dict.fromkeys(decided))))
    return made


def _needed(simulation: Simulation, body: int) -> float:
    return max((each.weight / max(each.carries, 1e-9) for each in grasps(simulation) if each.body == body), default=0.0)


def needed(body: int) -> Probe:
    """The weight of what is held over what the friction of the fingers carries; above 1 it slips."""
    return Probe("weight over what friction of the closed fingers carries", "", _needed, (body,))
