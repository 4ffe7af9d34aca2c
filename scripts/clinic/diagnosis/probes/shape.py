"""Sizes of bodies and geoms, and which of them move together."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from itertools import product

from clinic.diagnosis.engine import BOX, CAPSULE, CYLINDER, FREE, HFIELD, MESH, PLANE, SLIDE
from clinic.diagnosis.probes.vector import Vector, across, add, at, norm, of_quaternion, sub, times, transpose
from clinic.diagnosis.simulation import Simulation, kept

SLENDER = 1.5  # lengths over the thickness
CLEAR = 0.05  # of the opacity
FLUID = 12  # mjNFLUID, numbers of a geom in geom_fluid
LIQUID = 100.0  # kg/m3


def roots(simulation: Simulation) -> list[int]:
    """The moving bodies that hang on nothing that moves."""
    moving = set(simulation.moving_bodies)
    return [body for body in simulation.moving_bodies if simulation.parent(body) not in moving]


def limbs(simulation: Simulation) -> list[list[int]]:
    """The bodies from the world on to each on which no other hangs, in order."""
    ends = [body for body in range(1, simulation.count("body")) if body not in simulation.children]
    return [simulation.ancestors(body)[::-1] for body in ends]


@kept
def root_of(simulation: Simulation) -> list[int]:
    """For each body the root of its tree; 0 for what does not move."""
    tops = set(roots(simulation))
    made = [0] * simulation.count("body")
    for body in range(1, len(made)):
        made[body] = body if body in tops else made[simulation.parent(body)]
    return made


def geoms_of_tree(simulation: Simulation, root: int) -> list[int]:
    """The geoms of a root and of all that hangs on it; for 0 those that do not move."""
    owner = root_of(simulation)
    return [geom for geom, body in enumerate(simulation.model("geom_bodyid")) if owner[int(body)] == root]


def mechanisms(simulation: Simulation) -> dict[int, list[int]]:
    """The geoms that have an end of all that hangs together and moves, by its root."""
    owners, bodies, kinds = root_of(simulation), simulation.model("geom_bodyid"), simulation.model("geom_type")
    made: dict[int, list[int]] = {}
    for geom, kind in enumerate(kinds):
        if (root := owners[int(bodies[geom])]) and int(kind) not in (PLANE, HFIELD):
            made.setdefault(root, []).append(geom)
    return made


def falling(simulation: Simulation) -> dict[int, int]:
    """The roots that can fall, and the degree of freedom in which they do."""
    made = {}
    for root in roots(simulation):
        for joint in simulation.joints_of(root):
            kind, axis = simulation.joint_type(joint), simulation.row("jnt_axis", joint, 3)
            if kind == FREE:
                made[root] = simulation.dof(joint) + 2
            elif kind == SLIDE and abs(axis[2]) > 0.9:
                made[root] = simulation.dof(joint)
    return made


def collides(simulation: Simulation, one: int, other: int) -> bool:
    """Whether the masks of two geoms let them touch."""
    types, affinities = simulation.model("geom_contype"), simulation.model("geom_conaffinity")
    return bool(int(types[one]) & int(affinities[other]) or int(types[other]) & int(affinities[one]))


def pair_of(simulation: Simulation, one: int, other: int) -> int | None:
    """The number of the `<pair>` of two geoms, which touches whatever their masks are; None where there is none."""
    pairs = zip(*(map(int, simulation.model(f"pair_geom{side}")) for side in (1, 2)), strict=True)
    return next((index for index, pair in enumerate(pairs) if {one, other} == set(pair)), None)


def solid(simulation: Simulation, geom: int) -> bool:
    """Whether a geom collides with anything at all by its masks."""
    return bool(simulation.model("geom_contype")[geom] or simulation.model("geom_conaffinity")[geom])


def in_pairs(simulation: Simulation) -> set[int]:
    """The geoms of all `<pair>`."""
    return {int(geom) for side in (1, 2) for geom in simulation.model(f"pair_geom{side}")}


def masks_told(simulation: Simulation, geom: int) -> str:
    """The masks of a geom, contype before conaffinity: `1, 1`."""
    return ", ".join(f"{int(simulation.model(f'geom_{mask}')[geom])}" for mask in ("contype", "conaffinity"))


def plane_heights(simulation: Simulation) -> list[float]:
    """How high the planes are, as the state is now, in m."""
    kinds, places = simulation.model("geom_type"), simulation.data("geom_xpos")
    return [places[3 * geom + 2] for geom, kind in enumerate(kinds) if int(kind) == PLANE]


def clear(simulation: Simulation, geom: int) -> bool:
    """Whether nobody sees a geom: it has next to no opacity."""
    return simulation.row("geom_rgba", geom, 4)[3] < CLEAR


def swims(simulation: Simulation, root: int) -> bool:
    """Whether a medium has the density of a liquid, and geoms of a tree are shaped for it (`fluidshape`)."""
    shaped = simulation.model("geom_fluid")[::FLUID]
    return simulation.model("opt.density")[0] > LIQUID and any(shaped[geom] for geom in geoms_of_tree(simulation, root))


def thickness(simulation: Simulation, geom: int) -> float:
    """The smallest extent of a geom in its own axes, in m; infinite for a plane."""
    if int(simulation.model("geom_type")[geom]) == PLANE:
        return float("inf")
    return 2 * min(simulation.row("geom_aabb", geom, 6)[3:])


def round_about(simulation: Simulation, joint: int) -> bool:
    """Whether a geom of a hinge's body has its middle on the hinge, to a tenth of the geom's radius."""
    of = simulation
    anchor, axis = of.data_row("xanchor", joint, 3), of.axis(joint)
    for geom in of.geoms_of(of.body_of("joint", joint)):
        middle = times(of.data_row("geom_xmat", geom, 9), of.row("geom_aabb", geom, 6)[:3])
        off = sub(add(of.data_row("geom_xpos", geom, 3), middle), anchor)
        if norm(across(off, axis)) < 0.1 * of.model("geom_rbound")[geom]:
            return True
    return False


def size(simulation: Simulation, body: int) -> float:
    """The largest radius of a body's geoms in m; of those of the whole tree where it has none."""
    radii = simulation.model("geom_rbound")
    own = [radii[geom] for geom in simulation.geoms_of(body)]
    return max([*own, 0.0]) or max([radii[geom] for geom in geoms_of_tree(simulation, body)], default=0.0)


def points(simulation: Simulation, geom: int) -> list[Vector]:
    """The vertices of a mesh in its geom's frame; the corners of the box around a geom of another kind."""
    if int(simulation.model("geom_type")[geom]) != MESH:
        box = simulation.row("geom_aabb", geom, 6)
        signs = product((-1, 1), repeat=3)
        return [tuple(c + s * h for c, s, h in zip(box[:3], each, box[3:], strict=True)) for each in signs]
    mesh, vertices = int(simulation.model("geom_dataid")[geom]), simulation.model("mesh_vert")
    first, count = (int(simulation.model(f"mesh_vert{of}")[mesh]) for of in ("adr", "num"))
    return [at(vertices, each) for each in range(first, first + count)]


def in_world(simulation: Simulation, geom: int, most: int = sys.maxsize) -> list[Vector]:
    """The points of a geom as the state is now, about so many of them at the most."""
    place, frame = simulation.data_row("geom_xpos", geom, 3), simulation.data_row("geom_xmat", geom, 9)
    found = points(simulation, geom)
    return [add(place, times(frame, point)) for point in found[:: max(1, len(found) // most)]]


def in_box(simulation: Simulation, geom: int, point: Vector, grown: float) -> bool:
    """Whether a point of the world is in the box around a geom along its axes, grown by so many m."""
    frame, box = simulation.data_row("geom_xmat", geom, 9), simulation.row("geom_aabb", geom, 6)
    seen = times(transpose(frame), sub(point, simulation.data_row("geom_xpos", geom, 3)))
    return all(abs(x - c) <= h + grown for x, c, h in zip(seen, box[:3], box[3:], strict=True))


def boxes(simulation: Simulation, geoms: Iterable[int]) -> dict[int, tuple[Vector, Vector]]:
    """The boxes around geoms along the world's axes, as the state is now: their centres and half sizes in m."""
    positions, axes = tuple(simulation.data("geom_xpos")), tuple(simulation.data("geom_xmat"))
    return {geom: box(simulation, positions, axes, geom) for geom in geoms}


def box(
    simulation: Simulation, positions: tuple[float, ...], axes: tuple[float, ...], geom: int
) -> tuple[Vector, Vector]:
    """The box around a geom along the world's axes: its centre and half sizes in m."""
    own, matrix = simulation.row("geom_aabb", geom, 6), axes[9 * geom : 9 * geom + 9]
    return add(at(positions, geom), times(matrix, own[:3])), times([abs(x) for x in matrix], own[3:])


def rods(of: Simulation, body: int, *, boxed: bool = False) -> list[tuple[int, Vector]]:
    """The rods of a body that begin at its origin, and long boxes, with where they end; the longest last."""
    made = []
    for geom in of.geoms_of(body):
        sizes, kind = of.row("geom_size", geom, 3), int(of.model("geom_type")[geom])
        along = 2
        if boxed and kind == BOX:
            along = sizes.index(max(sizes))
            radius, half = sorted(sizes)[1:]
        else:
            radius, half, _ = sizes
        middle, turn = of.row("geom_pos", geom, 3), of_quaternion(of.row("geom_quat", geom, 4))
        axis = times(turn, tuple(half if i == along else 0.0 for i in range(3)))
        near, far = sorted((add(middle, axis), sub(middle, axis)), key=norm)
        rod = kind in (CAPSULE, CYLINDER, *[BOX] * boxed) and half > SLENDER * radius
        if rod and norm(near) < max(radius, 0.1 * half):
            made.append((geom, far))
    return sorted(made, key=lambda each: norm(each[1]))
