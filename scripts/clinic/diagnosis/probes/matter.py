"""How the mass of a body lies beside its geoms: what no matter inside of them could have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

from clinic.diagnosis.engine import BALL, CAPSULE, CYLINDER, ELLIPSOID, FREE, HFIELD, HINGE, MESH, PLANE, SLIDE, SPHERE
from clinic.diagnosis.probes.inertia import inertial, tensor
from clinic.diagnosis.probes.vector import (
    IDENTITY,
    Vector,
    add,
    diagonal,
    dot,
    norm,
    of_quaternion,
    sub,
    times,
    turned,
    unit,
)
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

ABSURD = 6.0  # a radius of gyration as many times that of the geoms, or that in it
OVERDAMPED = 0.025  # s: inertia over damping, below which a joint does not show the inertia
BOUND = 2e-15  # kg m2: more than a link of a URDF has that is written without inertia (`reader_model.UNFUSED`)


@dataclass(frozen=True)
class Matter:
    """A body's mass and its geoms, in the axes of the body's frame, lengths in m.

    Attributes:
        mass: In kg.
        centre: The centre of mass.
        about: The inertia about the centre of mass, in kg m2, row by row.
        middle: The middle of the box around all geoms.
        half: Its half sizes.
        volume: Of the geoms, in m3; a mesh as the box around it.
        solid: The inertia of the geoms at a density that gives the body's mass, about their own centre.
        solid_centre: That centre.
    """

    mass: float
    centre: Vector
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
    def even(self) -> bool:
        """Whether its inertia is equal about all axes, as one types it in."""
        moments = (self.about[0], self.about[4], self.about[8])
        return max(moments) < 1.03 * min(moments)

    @property
    def absurd(self) -> bool:
        """Whether it is so, and far from that of the geoms."""
        return self.even and max(self.radius, 1 / self.radius) > ABSURD

    @property
    def along(self) -> tuple[float, float]:
        """The inertia about the geoms' longest axis, of the geoms and of the body; 1 is the mean of all axes."""
        return self._about(sub(tuple(_trace(self.solid) / 2 * x for x in IDENTITY), self.solid))

    @property
    def flat(self) -> tuple[float, float]:
        """The same about the axis across which the geoms are flat, a wheel's own: that of their greatest inertia."""
        return self._about(self.solid)

    @property
    def short(self) -> Vector:
        """The axis across which the geoms are flat."""
        return _greatest(self.solid)

    def _about(self, spread: Vector) -> tuple[float, float]:
        axis = _greatest(spread)
        geoms, own = (
            3 * dot(axis, times(each, axis)) / _trace(each) if _trace(each) else 1.0
            for each in (self.solid, self.about)
        )
        return geoms, own

    @property
    def density(self) -> float:
        """In kg/m3."""
        return self.mass / self.volume if self.volume > 0 else 0.0


def _greatest(spread: Vector) -> Vector:
    """The principal axis of a tensor's greatest moment."""
    axis: Vector = max(((1.0, 0.1, 0.1), (0.1, 1.0, 0.1), (0.1, 0.1, 1.0)), key=lambda each: norm(times(spread, each)))
    for _ in range(50):  # power iteration
        axis = unit(times(spread, axis))
    return axis


def _trace(tensor_: Vector) -> float:
    return tensor_[0] + tensor_[4] + tensor_[8]


@kept
def matter(simulation: Simulation, body: int) -> Matter | None:
    """What a body is made of; None for one without geoms or without mass."""
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
        volume, moments = _solid(simulation, geom)
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
    return Matter(
        mass,
        simulation.row("body_ipos", body, 3),
        about,
        tuple((a + b) / 2 for a, b in zip(low, high, strict=True)),
        tuple((b - a) / 2 for a, b in zip(low, high, strict=True)),
        total,
        solid,
        middle,
    )


def volume_of(simulation: Simulation, geom: int) -> float:
    """The volume of a geom in m3; of a mesh that of the box around it."""
    return _solid(simulation, geom)[0]


def _solid(simulation: Simulation, geom: int) -> tuple[float, Vector]:
    """Volume in m3, and inertia per mass about the centre along the geom's axes in m2."""
    kind, (a, b, c) = int(simulation.model("geom_type")[geom]), simulation.row("geom_aabb", geom, 6)[3:]
    if kind in (SPHERE, ELLIPSOID):
        return 4 / 3 * math.pi * a * b * c, ((b * b + c * c) / 5, (a * a + c * c) / 5, (a * a + b * b) / 5)
    if kind in (CAPSULE, CYLINDER):
        across = (3 * a * a + 4 * c * c) / 12
        return 2 * math.pi * a * a * c, (across, across, a * a / 2)
    return 8 * a * b * c, ((b * b + c * c) / 3, (a * a + c * c) / 3, (a * a + b * b) / 3)


def explicit(model: ReaderModel) -> list[tuple[int, Matter]]:
    """The moving bodies that have an `<inertial>` and geoms, and how they lie to each other."""
    if model.source is None:
        return []
    of = model.simulation
    bodies = [body for body in of.moving_bodies if inertial(model, body) is not None and not _decorated(model, body)]
    found = [(body, matter(of, body)) for body in bodies]
    return [(body, each) for body, each in found if each is not None and each.about[0] > BOUND]


def _decorated(model: ReaderModel, body: int) -> bool:
    """Whether all geoms of a body are primitives of which it is written that they have no mass."""
    of = model.simulation
    kinds = of.model("geom_type")
    return all(int(kinds[geom]) != MESH and model.value("geom", geom, "mass") == "0" for geom in of.geoms_of(body))


def turns(simulation: Simulation, joint: int) -> list[tuple[int, Vector]]:
    """The degrees of freedom in which a joint turns, and their axes in the world, as the state is now."""
    kind, dof = simulation.joint_type(joint), simulation.dof(joint)
    if kind == HINGE:
        return [(dof, simulation.axis(joint))]
    frame, first = simulation.data_row("xmat", simulation.body_of("joint", joint), 9), dof + (3 if kind == FREE else 0)
    return [(first + i, frame[i::3]) for i in range(3)] if kind in (FREE, BALL) else []


def _heavier(simulation: Simulation, body: int) -> float:
    """How many times the inertia of the joint that turns a body differs from what its geoms would give it."""
    found, best = matter(simulation, body), 1.0
    if found is None:
        return best
    joint_body = body
    kinds = simulation.model("jnt_type")
    while joint_body and not any(int(kinds[joint]) != SLIDE for joint in simulation.joints_of(joint_body)):
        joint_body = simulation.parent(joint_body)
    diagonal_of = simulation.mass_diagonal
    turn = simulation.data_row("xmat", body, 9)
    excess = turned(turn, sub(found.about, found.solid))
    for joint in simulation.joints_of(joint_body):
        for index, axis in turns(simulation, joint):
            mine, more = diagonal_of[index], dot(axis, times(excess, axis))
            other = mine - more
            unseen = 0 < more < OVERDAMPED * simulation.model("dof_damping")[index]
            if mine > 0 and not unseen:
                best = max(best, mine / max(other, mine * 1e-6), other / mine)
    return best


@probe("inertia at the joint, unlike that of the geoms by", "times", dynamic=False)
def joint_inertia(simulation: Simulation, *bodies: int) -> float:
    """How many times the joints' inertia is what the geoms would give, or that in it."""
    simulation.begin()
    return max(_heavier(simulation, body) for body in bodies)


@probe("radius of gyration, unlike that of the geoms by", "times", dynamic=False)
def gyration(simulation: Simulation, *bodies: int) -> float:
    """How many times the radius of gyration is that of the geoms, or that in it."""
    found = [matter(simulation, body) for body in bodies]
    return max((max(each.radius, 1 / each.radius) for each in found if each is not None), default=1.0)


@probe("mass", "kg", dynamic=False)
def mass_of(simulation: Simulation, *bodies: int) -> float:
    """The mass of some bodies."""
    return sum(simulation.model("body_mass")[body] for body in bodies)


@probe("centre of mass outside of the geoms by", "half lengths", dynamic=False)
def centre_outside(simulation: Simulation, *bodies: int) -> float:
    """How far the centre of mass is outside of the geoms, in half lengths of the body."""
    found = [matter(simulation, body) for body in bodies]
    return max((each.outside / max(each.half) for each in found if each is not None), default=0.0)


@probe("inertia about the long axis, times the mean", dynamic=False)
def across(simulation: Simulation, body: int) -> float:
    """The inertia about the geoms' long axis, where the mean of the three principal ones is 1."""
    found = matter(simulation, body)
    return found.along[1] if found is not None else 0.0


@probe("mean inertia over that about a flat body's own axis", dynamic=False)
def flat(simulation: Simulation, *bodies: int) -> float:
    """The mean of the three principal inertias over that about a flat body's own axis, the most of several bodies."""
    found = [each.flat[1] for body in bodies if (each := matter(simulation, body)) is not None]
    return max((1 / own for own in found if own > 0), default=0.0)


@probe("density", "kg/m3", dynamic=False)
def density(simulation: Simulation, *bodies: int) -> float:
    """The density of the densest body."""
    found = [matter(simulation, body) for body in bodies]
    return max((each.density for each in found if each is not None), default=0.0)
