"""What sensors read while contacts carry something."""

from __future__ import annotations

import math
from dataclasses import dataclass

from clinic.diagnosis.engine import SENS_FORCE, SENS_TORQUE, SENS_TOUCH
from clinic.diagnosis.probes.overlap import relatives
from clinic.diagnosis.probes.vector import at
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe


@dataclass
class Read:
    """Of one sensor: its largest reading, the most that contacts of its body carried in N, and how far these were.

    `reach` is the largest distance of such a contact from the site's centre, in m.
    """

    reading: float = 0.0
    carried: float = 0.0
    reach: float = 0.0


def touch_sites(of: Simulation) -> list[int]:
    """The sites of all touch sensors."""
    pairs = zip(of.model("sensor_type"), of.model("sensor_objid"), strict=True)
    return [int(site) for kind, site in pairs if int(kind) == SENS_TOUCH]


@kept
def touched(simulation: Simulation) -> dict[int, Read]:
    """Each touch, force and torque sensor, over the time after letting go, but for parts that overlap at the start."""
    kinds, of, places = (simulation.model(f"sensor_{name}") for name in ("type", "objid", "adr"))
    made = {i: Read() for i, kind in enumerate(kinds) if int(kind) in (SENS_TOUCH, SENS_FORCE, SENS_TORQUE)}
    if not made:
        return made
    bodies, owners = simulation.model("geom_bodyid"), simulation.model("site_bodyid")
    within = {(one, other) for one, other, _ in relatives(simulation)}
    simulation.begin()
    for _ in simulation.run(simulation.begin_with.duration):
        contacts, data = simulation.engine.contacts(), simulation.data("sensordata")
        centres = tuple(simulation.data("site_xpos"))
        for sensor, seen in made.items():
            site, width = int(of[sensor]), 1 if int(kinds[sensor]) == SENS_TOUCH else 3
            values = data[int(places[sensor]) : int(places[sensor]) + width]
            seen.reading = max(seen.reading, math.hypot(*values))
            carried = 0.0
            for contact in contacts:
                pair = tuple(int(bodies[geom]) for geom in contact.geoms) if min(contact.geoms) >= 0 else ()
                if owners[site] in pair and pair not in within and contact.force > 0:
                    carried += contact.force
                    seen.reach = max(seen.reach, math.dist(contact.position, at(centres, site)))
            seen.carried = max(seen.carried, carried)
    return made


@probe("of what contacts carry, not read")
def unread(simulation: Simulation, sensor: int) -> float:
    """The share of what contacts of its body carry that a sensor does not read."""
    seen = touched(simulation).get(sensor, Read())
    return 1.0 - min(1.0, seen.reading / seen.carried) if seen.carried > 0 else 0.0
