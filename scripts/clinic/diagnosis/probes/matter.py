"""How the mass of a body lies beside its geoms: what no matter inside of them could have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

from clinic.diagnosis.engine import BOX, CAPSULE, CYLINDER, ELLIPSOID, HFIELD, PLANE, SPHERE
from clinic.diagnosis.probes.inertia import tensor
from clinic.diagnosis.probes.vector import IDENTITY, Vector, add, diagonal, dot, of_quaternion, sub, times, turned
from clinic.diagnosis.simulation import Simulation


@dataclass(frozen=True)
class Matter:
    """A body's mass and its geoms, in the axes of the body's frame, lengths in m.

    Attributes:
        mass: In kg.
        centre: The centre of mass.
        spread: The standard deviation of the mass about its centre along each axis.
        about: The inertia about the centre of mass, in kg m2, row by row.
        middle: The middle of the box around all geoms.
        half: Its half sizes.
        volume: Of the geoms, in m3; a mesh as the box around it.
        solid: The inertia of the geoms at a density that gives the body's mass, about their own centre.
        solid_centre: That centre.
    """

    mass: float
    centre: Vector
    spread: Vector
    about: Vector
    middle: Vector
    half: Vector
    volume: float
    solid: Vector
    solid_centre: Vector

    @property
    def outside(self) -> float:
        """How far the centre of mass is outside of the box, in m."""
        beyond = [max(0.0, abs(c - m) - h) for c, m, h in zip(self.centre, self.middle, self.half, strict=True)]
        return math.sqrt(dot(beyond, beyond))

    @property
    def radius(self) -> float:
        """The radius of gyration over that of the geoms."""
        own = (self.about[0] + self.about[4] + self.about[8]) / self.mass
        solid = (self.solid[0] + self.solid[4] + self.solid[8]) / self.mass
        return math.sqrt(own / solid) if solid > 0 else 1.0

    @property
    def density(self) -> float:
        """In kg/m3."""
        return self.mass / self.volume if self.volume > 0 else 0.0


def matter(simulation: Simulation, body: int) -> Matter | None:
    """What a body is made of; None for one without geoms or without mass."""
    kept = simulation.kept
    if ("matter", body) not in kept:
        kept["matter", body] = _matter(simulation, body)
    found = kept["matter", body]
    assert found is None or isinstance(found, Matter)
    return found


def _matter(simulation: Simulation, body: int) -> Matter | None:
    mass = simulation.model("body_mass")[body]
    kinds = simulation.model("geom_type")
    geoms = [geom for geom in simulation.geoms_of(body) if kinds[geom] not in (PLANE, HFIELD)]
    if not geoms or mass <= 0:
        return None
    corners, parts = [], []
    for geom in geoms:
        box, place = simulation.row("geom_aabb", geom, 6), simulation.row("geom_pos", geom, 3)
        turn = of_quaternion(simulation.row("geom_quat", geom, 4))
        centre = add(place, times(turn, box[:3]))
        for signs in product((-1, 1), repeat=3):
            corners.append(add(centre, times(turn, tuple(s * h for s, h in zip(signs, box[3:], strict=True)))))
        volume, moments = _solid(int(kinds[geom]), simulation.row("geom_size", geom, 3), box[3:])
        parts.append((volume, centre, turned(turn, diagonal(moments))))
    low, high = (tuple(pick(each) for each in zip(*corners, strict=True)) for pick in (min, max))
    total = sum(volume for volume, _, _ in parts) or 1e-30
    middle = tuple(sum(v * c[i] for v, c, _ in parts) / total for i in range(3))
    solid = tuple(0.0 for _ in range(9))
    for volume, centre, moments in parts:
        off = sub(centre, middle)
        shifted = tuple(dot(off, off) * IDENTITY[3 * i + j] - off[i] * off[j] for i in range(3) for j in range(3))
        solid = add(solid, add(moments, shifted), mass * volume / total)
    about = tensor(simulation, body)
    half_trace = (about[0] + about[4] + about[8]) / 2
    spread = tuple(math.sqrt(max(0.0, half_trace - about[4 * i]) / mass) for i in range(3))
    return Matter(
        mass,
        simulation.row("body_ipos", body, 3),
        spread,
        about,
        tuple((a + b) / 2 for a, b in zip(low, high, strict=True)),
        tuple((b - a) / 2 for a, b in zip(low, high, strict=True)),
        total,
        solid,
        middle,
    )


def _solid(kind: int, size: Vector, box: Vector) -> tuple[float, Vector]:
    """Volume in m3, and inertia per mass about the centre along the geom's axes in m2."""
    a, b, c = box
    if kind in (SPHERE, ELLIPSOID):
        return 4 / 3 * math.pi * a * b * c, ((b * b + c * c) / 5, (a * a + c * c) / 5, (a * a + b * b) / 5)
    if kind in (CAPSULE, CYLINDER):
        across = (3 * a * a + 4 * c * c) / 12
        return 2 * math.pi * a * a * c, (across, across, a * a / 2)
    assert kind >= BOX or size
    return 8 * a * b * c, ((b * b + c * c) / 3, (a * a + c * c) / 3, (a * a + b * b) / 3)
