"""What falls through something that it began above."""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import BOX, HFIELD, PLANE
from clinic.diagnosis.probes.run import State, beginning, let_go
from clinic.diagnosis.probes.shape import box, falling, root_of, size, solid
from clinic.diagnosis.probes.vector import at, dot, sub
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe


def _above(simulation: Simulation, now: State, body: int, geom: int) -> float | None:
    """How far a body's centre is above a geom's upper side in m; None where it is beside it."""
    centre = at(now.xipos, body)
    if int(simulation.model("geom_type")[geom]) == PLANE:
        matrix = now.geom_xmat[9 * geom : 9 * geom + 9]
        return dot((matrix[2], matrix[5], matrix[8]), sub(centre, at(now.geom_xpos, geom)))
    middle, half = box(simulation, now.geom_xpos, now.geom_xmat, geom)
    if any(abs(centre[i] - middle[i]) > half[i] for i in (0, 1)):
        return None
    return centre[2] - middle[2] - half[2]


@kept
def fallen(simulation: Simulation) -> list[tuple[int, int]]:
    """Bodies and the geoms that they fell through after letting go: roots of trees, and what `bare` gives."""
    return list(_fallen(simulation))


def _fallen(simulation: Simulation) -> Iterator[tuple[int, int]]:
    start, end = beginning(simulation), let_go(simulation).end
    if end is None:
        return
    kinds, bodies, owner = simulation.model("geom_type"), simulation.model("geom_bodyid"), root_of(simulation)
    for root in [*falling(simulation), *bare(simulation)]:
        for geom, body in enumerate(bodies):
            kind = int(kinds[geom])
            if (
                owner[int(body)] == owner[root]
                or kind == HFIELD
                or not (solid(simulation, geom) or kind in (PLANE, BOX))
            ):
                continue
            before = _above(simulation, start, root, geom)
            after = _above(simulation, end, root, geom)
            if before is None or after is None or not before > 0 > after + limit(simulation, root):
                continue
            if solid(simulation, geom) or not _pictured(simulation, start, root, before):
                yield root, geom


def _pictured(simulation: Simulation, start: State, root: int, height: float) -> bool:
    """Whether a surface without masks, `height` m below a body, is a picture: it lies on one that collides."""
    owner, bodies = root_of(simulation), simulation.model("geom_bodyid")
    others = (geom for geom, body in enumerate(bodies) if owner[int(body)] != owner[root] and solid(simulation, geom))
    heights = (_above(simulation, start, root, geom) for geom in others)
    return any(each is not None and abs(each - height) < limit(simulation, root) for each in heights)


def bare(simulation: Simulation) -> list[int]:
    """The one body of a tree that can fall whose geoms collide with nothing, where all others do; the root too."""
    made, owner = [], root_of(simulation)
    for root in falling(simulation):
        bodies = [body for body in range(len(owner)) if owner[body] == root and simulation.geoms_of(body)]
        empty = [body for body in bodies if not any(solid(simulation, geom) for geom in simulation.geoms_of(body))]
        if len(bodies) > len(empty) == 1:
            made += empty
    return made


def limit(simulation: Simulation, root: int) -> float:
    """How far a body's centre may be below a surface in m: a part of its size."""
    return 0.25 * size(simulation, root)


@probe("centre below the surface 2 s after letting go", "m")
def below(simulation: Simulation, root: int, geom: int) -> float:
    """How far a body's centre is below a surface that it began above."""
    run = let_go(simulation)
    if run.end is None:
        return float("inf")
    above = _above(simulation, run.end, root, geom)
    return max(0.0, -above) if above is not None else 0.0
