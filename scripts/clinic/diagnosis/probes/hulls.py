"""Meshes that overlap by their convex hulls alone: what is in there does not meet their own surfaces."""

from __future__ import annotations

import math
from collections.abc import Sequence

from clinic.diagnosis.engine import CAPSULE, CYLINDER, MESH, SDF, SPHERE, Contact
from clinic.diagnosis.probes.run import beginning
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.surface import Triangle, jointed_roots, nearest, triangles
from clinic.diagnosis.probes.vector import Vector, add, at, cross, dot, sub, times
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

PAIRS = 24  # the deepest ones are looked at
FACES = 4000  # of a finer mesh nothing is told
DEEP = 0.05  # of the smaller one's radius
MOST_POINTS = 50  # of a rod to each side of its middle
OBLIQUE = (0.1234, 0.4567, 1.0)  # along no edge of what is drawn


@kept
def closed_holes(simulation: Simulation) -> dict[tuple[int, int], float]:
    """The depth, as a share of the smaller one's radius, of pairs at the start whose surfaces do not meet.

    They are meshes, or a mesh and a ball, capsule or cylinder. Parts of one mechanism are left out: how they nest is
    `overlap_of_relatives`'s; two mechanisms that begin in each other; and of two meshes those of which one does not
    move.
    """
    kinds, radii = simulation.model("geom_type"), simulation.model("geom_rbound")
    owner, bodies = root_of(simulation), simulation.model("geom_bodyid")
    made = {}
    for contact in _deepest(simulation):
        share = -contact.distance / max(min(radii[geom] for geom in contact.geoms), 1e-9)
        meshes = [geom for geom in contact.geoms if int(kinds[geom]) in (MESH, SDF)]
        trees = {owner[int(bodies[geom])] for geom in contact.geoms}
        if len(trees) < 2 or trees <= jointed_roots(simulation) or contact.force <= 0 or share <= DEEP:
            continue
        if len(meshes) == 2:
            apart = 0 not in trees and not _meet(simulation, *meshes)
        else:
            apart = bool(meshes) and _clear(simulation, meshes[0], sum(contact.geoms) - meshes[0])
        if apart:
            made[contact.geoms] = share
    return made


def _clear(simulation: Simulation, mesh: int, other: int) -> bool:
    """Whether a ball, capsule or cylinder is in a hole of a mesh: it does not meet its surface, nor is it inside."""
    kind, (radius, half) = int(simulation.model("geom_type")[other]), simulation.row("geom_size", other, 3)[:2]
    faces = _in_world(simulation, mesh)
    if kind not in (SPHERE, CAPSULE, CYLINDER) or not faces:
        return False
    now = beginning(simulation)
    middle, frame = at(now.geom_xpos, other), now.geom_xmat[9 * other : 9 * other + 9]
    ends = 0.0 if kind == SPHERE else half
    count = max(1, min(MOST_POINTS, math.ceil(ends / radius)))
    line = [add(middle, times(frame, (0.0, 0.0, ends * step / count))) for step in range(-count, count + 1)]
    around = [add(point, (side * radius,) * 3) for point in (line[0], line[-1]) for side in (-1.0, 1.0)]
    close = _near(faces, [(around[0], around[1], around[2]), (around[1], around[2], around[3])])
    if any(_pierces(line[0], line[-1], face) for face in close):
        return False
    if any(math.dist(nearest(face, point), point) < radius for point in line for face in close):
        return False
    return sum(_pierces(middle, add(middle, OBLIQUE, 1e3), face) for face in faces) % 2 == 0


def _deepest(simulation: Simulation) -> list[Contact]:
    """The deepest contact of each pair of geoms at the start, the deepest pairs first."""
    pairs: dict[tuple[int, int], Contact] = {}
    for contact in sorted(beginning(simulation).contacts, key=lambda each: each.distance):
        if min(contact.geoms) >= 0:
            pairs.setdefault(contact.geoms, contact)
    return [*pairs.values()][:PAIRS]


def _meet(simulation: Simulation, one: int, other: int) -> bool:
    """Whether an edge of one mesh goes through a face of the other; also where one of them is too fine to tell."""
    mine, theirs = (_in_world(simulation, geom) for geom in (one, other))
    if not mine or not theirs:
        return True
    theirs = _near(theirs, mine)
    return any(_crosses(a, b) or _crosses(b, a) for a in _near(mine, theirs) for b in _near(theirs, [a]))


def _in_world(simulation: Simulation, geom: int) -> list[Triangle]:
    now = beginning(simulation)
    place, frame = at(now.geom_xpos, geom), now.geom_xmat[9 * geom : 9 * geom + 9]
    own = triangles(simulation, int(simulation.model("geom_dataid")[geom]))
    points = ([add(place, times(frame, point)) for point in each] for each in own if len(own) <= FACES)
    return [(one, two, three) for one, two, three in points]


def _near(these: Sequence[Triangle], those: Sequence[Triangle]) -> list[Triangle]:
    """The triangles whose boxes touch the box of all others."""
    if not those:
        return []
    low, high = _box([point for each in those for point in each])
    boxes = ((each, *_box(each)) for each in these)
    ways = ((each, zip((*least, *low), (*high, *most), strict=True)) for each, least, most in boxes)
    return [each for each, ends in ways if all(a <= b for a, b in ends)]


def _box(points: Sequence[Vector]) -> tuple[Vector, Vector]:
    return tuple(map(min, zip(*points, strict=True))), tuple(map(max, zip(*points, strict=True)))


def _crosses(edges: Triangle, face: Triangle) -> bool:
    """Whether an edge of one triangle goes through another one."""
    return any(_pierces(*edge, face) for edge in zip(edges, (*edges[1:], edges[0]), strict=True))


def _pierces(start: Vector, end: Vector, face: Triangle) -> bool:
    """Whether a line from one point to another goes through a triangle.

    T. Moeller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
    """
    a, b, c = face
    along = sub(end, start)
    normal = cross(along, sub(c, a))
    across = dot(sub(b, a), normal)
    if not across:
        return False
    from_a = sub(start, a)
    u = dot(from_a, normal) / across
    around = cross(from_a, sub(b, a))
    v, t = dot(along, around) / across, dot(sub(c, a), around) / across
    return u >= 0 and v >= 0 and u + v <= 1 and 0 <= t <= 1


@probe("deepest overlap at the start of meshes that do not touch", "of a mesh's radius", dynamic=False)
def holes_closed(simulation: Simulation) -> float:
    """The deepest overlap at the start of meshes whose surfaces do not meet."""
    return max(closed_holes(simulation).values(), default=0.0)
