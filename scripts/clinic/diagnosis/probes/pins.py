"""How far the anchor of a `<connect>` is from the shapes of what it connects, as the model is written."""

from __future__ import annotations

import math

from clinic.diagnosis.engine import CAPSULE, CYLINDER, HFIELD, PLANE
from clinic.diagnosis.probes.equalities import CONNECT, ends, held, kind_of, sited
from clinic.diagnosis.probes.vector import Vector, add, at, norm, sub, times, transpose
from clinic.diagnosis.simulation import Simulation


def off(of: Simulation, each: int) -> float:
    """The distance of an anchor from the one of the two bodies that it is further off, in sizes of that."""
    if kind_of(of, each) != CONNECT or sited(of, each):
        return 0.0
    of.as_written()
    point, radii, most = ends(of, each)[0], of.model("geom_rbound"), 0.0
    for body in held(of, each):
        if body > 0 and (geoms := _shapes(of, body)):
            away = min(_away(of, geom, point) for geom in geoms)
            most = max(most, away / max(radii[geom] for geom in geoms))
    return most


def from_ends(of: Simulation, each: int) -> float:
    """The distances in m of an anchor from the nearest end of a rod of either body, together; 0 of one without rods."""
    of.as_written()
    point, frames = ends(of, each)[0], [(body, of.data_row("xpos", body, 3)) for body in held(of, each)]
    made = 0.0
    for body, place in frames:
        seen = times(transpose(of.data_row("xmat", body, 9)), sub(point, place))
        made += min((math.dist(seen, end) for end in rod_ends(of, body)), default=0.0)
    return made


def rod_ends(of: Simulation, body: int) -> list[Vector]:
    """The ends of a body's capsules and cylinders in its own frame."""
    of.as_written()
    turn, place, made = transpose(of.data_row("xmat", body, 9)), of.data_row("xpos", body, 3), list[Vector]()
    for geom in of.geoms_of(body):
        if int(of.model("geom_type")[geom]) in (CAPSULE, CYLINDER):
            axis = of.data_row("geom_xmat", geom, 9)[2::3]
            half = of.model("geom_size")[3 * geom + 1]
            tips = (add(at(of.data("geom_xpos"), geom), axis, side * half) for side in (1, -1))
            made += [tuple(round(x, 6) + 0.0 for x in times(turn, sub(tip, place))) for tip in tips]
    return made


def _shapes(of: Simulation, body: int) -> list[int]:
    """The geoms of a body and of what is fixed to it; of one that is fixed to the world, its own."""
    welds, bodies, kinds = of.model("body_weldid"), of.model("geom_bodyid"), of.model("geom_type")
    alike = [geom for geom, on in enumerate(bodies) if body == on or 0 != welds[int(on)] == welds[body]]
    return [geom for geom in alike if int(kinds[geom]) not in (PLANE, HFIELD)]


def _away(of: Simulation, geom: int, point: Vector) -> float:
    """The distance in m of a point from a capsule, or from the box around another shape; 0 inside."""
    seen = times(transpose(of.data_row("geom_xmat", geom, 9)), sub(point, of.data_row("geom_xpos", geom, 3)))
    if int(of.model("geom_type")[geom]) == CAPSULE:
        radius, half, _ = of.row("geom_size", geom, 3)
        return max(0.0, math.hypot(seen[0], seen[1], max(0.0, abs(seen[2]) - half)) - radius)
    box = of.row("geom_aabb", geom, 6)
    return norm([max(0.0, abs(x - middle) - half) for x, middle, half in zip(seen, box[:3], box[3:], strict=True)])
