"""Which pairs, left and right, are one part used twice: a copy of it is right, as its mirror image would be."""

from __future__ import annotations

from functools import partial

from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.pairs import SAME, Pairs
from clinic.diagnosis.probes.vector import norm, sub
from clinic.diagnosis.simulation import Simulation

Fields = tuple[tuple[str, int], ...]

INERTIAL = (("body_mass", 1), ("body_ipos", 3), ("body_iquat", 4), ("body_inertia", 3))
PLACED = (("body_pos", 3), ("body_quat", 4))
JOINT = (("jnt_type", 1), ("jnt_axis", 3), ("jnt_pos", 3), ("jnt_range", 2), ("jnt_limited", 1))
MESHES = (("geom_dataid", 1), ("geom_pos", 3), ("geom_quat", 4))


def one_mesh(of: Simulation, left: int, right: int) -> bool:
    """Whether two bodies have the same meshes at the same places, and the same numbers for mass and inertia."""
    meshes = [[geom for geom in of.geoms_of(body) if of.model("geom_type")[geom] == MESH] for body in (left, right)]
    if not meshes[0] or len(meshes[0]) != len(meshes[1]):
        return False
    return _alike(of, INERTIAL, left, right) and all(_alike(of, MESHES, *pair) for pair in zip(*meshes, strict=True))


def copies(found: Pairs) -> dict[int, int]:
    """By body on the left: the body of a pair from which on all is written alike on the right, but for its place."""
    of, made = found.of, dict[int, int]()
    for left, right in sorted(found.pairs["body"], key=lambda pair: len(of.ancestors(pair[0]))):
        below, other = of.below(left)[1:], of.below(right)[1:]
        alike = len(below) == len(other) > 1 and all(map(partial(_written_alike, of), below, other))
        if alike and left not in made:
            own = [left] * _written_alike(of, left, right, INERTIAL)
            made |= dict.fromkeys((*own, *below), left)
    return made


def _written_alike(of: Simulation, left: int, right: int, fields: Fields = (*PLACED, *INERTIAL)) -> bool:
    """Whether place, mass and joints of two bodies have the same numbers."""
    joints = of.joints_of(left), of.joints_of(right)
    if len(joints[0]) != len(joints[1]) or not _alike(of, fields, left, right):
        return False
    return all(_alike(of, JOINT, *pair) for pair in zip(*joints, strict=True))


def _alike(of: Simulation, fields: Fields, one: int, other: int) -> bool:
    return all(norm(sub(of.row(field, one, width), of.row(field, other, width))) < SAME for field, width in fields)
