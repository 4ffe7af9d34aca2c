"""Rotors of a drone: motors at sites of a free body, which push along a site's axes and turn about them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from clinic.diagnosis.engine import TRN_SITE
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.vector import Vector, add, at, cross, norm, sub, times, transpose
from clinic.diagnosis.simulation import Simulation


@dataclass(frozen=True)
class Rotor:
    """What an actuator does per N of its force, in the axes of the free body.

    Attributes:
        actuator: Its number.
        place: Where its site is about the centre of mass of the whole drone, in m.
        push: The force.
        drag: The torque of the gear about the site.
    """

    actuator: int
    place: Vector
    push: Vector
    drag: Vector

    @property
    def torque(self) -> Vector:
        """The torque about the centre of mass in m."""
        return add(cross(self.place, self.push), self.drag)


def rotors(of: Simulation, body: int) -> list[Rotor]:
    """The rotors of a free body and of all that hangs on it, at the start."""
    if TRN_SITE not in map(int, of.model("actuator_trntype")):
        return []
    owner, bodies, sites = root_of(of), of.model("site_bodyid"), of.model("actuator_trnid")
    of.begin()
    turn, centre = transpose(of.data_row("xmat", body, 9)), of.data_row("subtree_com", body, 3)
    made = []
    for each, kind in enumerate(of.model("actuator_trntype")):
        site, gear = int(sites[2 * each]), of.row("actuator_gear", each, 6)
        if int(kind) != TRN_SITE or sites[2 * each + 1] >= 0 or owner[int(bodies[site])] != body or not norm(gear[:3]):
            continue
        axes = times(turn, of.data_row("site_xmat", site, 9))
        place = times(turn, sub(of.data_row("site_xpos", site, 3), centre))
        made.append(Rotor(each, place, times(axes, at(gear, 0)), times(axes, at(gear, 1))))
    return made


def forces(of: Simulation, found: Sequence[Rotor], controls: Sequence[float]) -> list[float]:
    """The forces of rotors at controls, filters at rest, in N."""
    for each, control in zip(found, controls, strict=True):
        of.engine.write("ctrl", [control], each.actuator)
        state = int(of.model("actuator_actadr")[each.actuator])
        if state >= 0:
            of.engine.write("act", [control], state)
    of.engine.forward()
    given = of.data("actuator_force")
    return [given[each.actuator] for each in found]
