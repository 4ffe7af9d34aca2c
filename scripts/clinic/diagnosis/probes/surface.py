"""How far from its own surface a mesh is touched: MuJoCo collides its convex hull instead."""

from __future__ import annotations

import math

from clinic.diagnosis.engine import MESH, SDF
from clinic.diagnosis.probes.shape import root_of, roots
from clinic.diagnosis.probes.vector import Vector, add, at, dot, sub, times, transpose
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

SAMPLES = 25
MOST_FACES = 20_000  # of a finer mesh nothing is told
NEAR = 0.1  # of the size: as near is touched at the surface, however near
REACH = 2.5  # radii of what touches: a hole counts by its own size as well as by the mesh's
Triangle = tuple[Vector, Vector, Vector]
Ball = tuple[Vector, float]


@kept
def touched_off_surface(simulation: Simulation) -> dict[int, float]:
    """How far from each mesh geom's surface other things touched it after letting go, as a share of its size.

    The size is the mesh's radius, or that of what touches it times REACH where that is less.

    Two mechanisms that collide are left out: what falls into a hole or passes through it is a single thing.
    """
    kinds, radii = simulation.model("geom_type"), simulation.model("geom_rbound")
    made: dict[int, float] = {}
    if not any(int(kind) in (MESH, SDF) for kind in kinds):
        return made
    owner, bodies = root_of(simulation), simulation.model("geom_bodyid")
    hung = _hung(simulation)
    jointed = jointed_roots(simulation)
    simulation.begin()
    for _ in simulation.run(simulation.begin_with.duration, SAMPLES):
        places, frames = simulation.data("geom_xpos"), simulation.data("geom_xmat")
        for contact in simulation.engine.contacts():
            own = [int(bodies[geom]) for geom in contact.geoms if min(contact.geoms) >= 0]
            trees = {owner[body] for body in own}
            strangers = len(trees) == 2 and trees - jointed and not hung & {(body, max(trees)) for body in own}
            for geom in contact.geoms if strangers and contact.force > 0 else ():
                if int(kinds[geom]) in (MESH, SDF):
                    seen = times(transpose(frames[9 * geom : 9 * geom + 9]), sub(contact.position, at(places, geom)))
                    mesh, other = int(simulation.model("geom_dataid")[geom]), radii[sum(contact.geoms) - geom]
                    size = min(radii[geom], REACH * other) if other > 0 else radii[geom]
                    away = _distance(simulation, mesh, seen, NEAR * size)
                    made[geom] = max(made.get(geom, 0.0), (away - abs(contact.distance)) / size)
    return made


def _hung(simulation: Simulation) -> set[tuple[int, int]]:
    """Bodies that do not move, and the roots of what hangs on them."""
    return {(above, root) for root in roots(simulation) for above in simulation.ancestors(root)[1:-1]}


@kept
def jointed_roots(simulation: Simulation) -> set[int]:
    """The roots of the trees with a joint between two bodies that move."""
    owner, bodies = root_of(simulation), (int(body) for body in simulation.model("jnt_bodyid"))
    return {owner[body] for body in bodies if owner[body] != body}


@kept
def _faces(simulation: Simulation, mesh: int) -> list[tuple[Triangle, Ball]]:
    """A mesh's triangles in the geom's frame, each with a ball around it; none of one that is too fine."""
    first, count = (int(simulation.model(f"mesh_face{of}")[mesh]) for of in ("adr", "num"))
    if count > MOST_FACES:
        return []
    offset, made = int(simulation.model("mesh_vertadr")[mesh]), []
    points, corners = simulation.model("mesh_vert"), simulation.model("mesh_face")
    for face in range(first, first + count):
        one, two, three = (at(points, offset + int(corners[3 * face + k])) for k in range(3))
        middle = tuple(sum(each) / 3 for each in zip(one, two, three, strict=True))
        made.append(((one, two, three), (middle, max(math.dist(middle, each) for each in (one, two, three)))))
    return made


def triangles(simulation: Simulation, mesh: int) -> list[Triangle]:
    """A mesh's triangles in the geom's frame; none of one that is too fine."""
    return [triangle for triangle, _ in _faces(simulation, mesh)]


def _distance(simulation: Simulation, mesh: int, point: Vector, near: float) -> float:
    """From a point to a mesh's surface in m; 0 where that is near, and for a mesh that is too fine."""
    faces, best = _faces(simulation, mesh), math.inf
    for number, (triangle, (middle, radius)) in enumerate(faces):
        if math.dist(point, middle) - radius < best:
            best = min(best, math.dist(point, nearest(triangle, point)))
        if best <= near:
            faces.insert(0, faces.pop(number))  # the next point is likely to be beside it
            return 0.0
    return 0.0 if math.isinf(best) else best


def nearest(triangle: Triangle, point: Vector) -> Vector:
    """The point of a triangle that is nearest to another one.

    C. Ericson, Real-Time Collision Detection, section 5.1.5.
    """
    a, b, c = triangle
    ab, ac, ap = sub(b, a), sub(c, a), sub(point, a)
    d1, d2 = dot(ab, ap), dot(ac, ap)
    if d1 <= 0 and d2 <= 0:
        return a
    bp = sub(point, b)
    d3, d4 = dot(ab, bp), dot(ac, bp)
    if d3 >= 0 and d4 <= d3:
        return b
    vc = d1 * d4 - d3 * d2
    if vc <= 0 <= d1 and d3 <= 0:
        return add(a, ab, d1 / (d1 - d3))
    cp = sub(point, c)
    d5, d6 = dot(ab, cp), dot(ac, cp)
    if d6 >= 0 and d5 <= d6:
        return c
    vb = d5 * d2 - d1 * d6
    if vb <= 0 <= d2 and d6 <= 0:
        return add(a, ac, d2 / (d2 - d6))
    va = d3 * d6 - d5 * d4
    if va <= 0 and d4 >= d3 and d5 >= d6:
        return add(b, sub(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)))
    total = va + vb + vc
    return add(add(a, ab, vb / total), ac, vc / total) if total else a


@probe("touched away from the mesh's surface, at most", "of its size")
def away(simulation: Simulation, geom: int) -> float:
    """How far from its surface a mesh is touched."""
    return touched_off_surface(simulation).get(geom, 0.0)
