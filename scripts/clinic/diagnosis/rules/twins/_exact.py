"""Pairs that are mirrored to the digit across an axis of the body on which they hang: one alone tells what is wrong."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.probes.vector import Vector, flipped, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

SAME, OFF = 1e-6, 1e-4  # m: of two places, and from the plane between both sides
BESIDE = 0.5  # of the geom's radius


@dataclass(frozen=True)
class Stray:
    """A body or geom that is not where the mirror image of its twin is, both in the axes of what they hang on.

    Attributes:
        kind: body or geom.
        index: The one that is wrong.
        twin: The other one.
        wanted: The place that the image has, in m.
        copied: Whether it has the very place of its twin.
    """

    kind: str
    index: int
    twin: int
    wanted: Vector
    copied: bool


@kept
def stray(of: Simulation) -> Stray | None:
    """The one part that is copied to the other side, or the one body that differs from its twin in one coordinate."""
    made: list[Stray] = []
    apart, mirrored = [], []
    for pair in twins(of).pairs["body"]:
        places = [of.row("body_pos", each, 3) for each in pair]
        if of.parent(pair[0]) != of.parent(pair[1]):
            continue
        across = [i for i in range(3) if abs(places[0][i] + places[1][i]) < SAME and abs(places[0][i]) > OFF]
        along = [i for i in range(3) if abs(places[0][i] - places[1][i]) < SAME]
        if len(across) == 1 and len(along) == 2:
            mirrored.append(pair)
            if _unturned(of, "body", *pair) and not _cast(of, pair[0]):
                made += _copied(of, *pair, across[0], places[0][across[0]] > 0)
        elif len(across) == len(along) == 1:
            apart.append((pair, across[0], 3 - across[0] - along[0]))
    if len(apart) == 1 and mirrored:
        pair, axis, other = apart[0]
        usual = [round(of.row("body_pos", each, 3)[other], 6) for one in mirrored for each in one]
        wrong = [each for each in pair if round(of.row("body_pos", each, 3)[other], 6) not in usual]
        if len(wrong) == 1:
            twin = pair[0] + pair[1] - wrong[0]
            made.append(Stray("body", wrong[0], twin, flipped(of.row("body_pos", twin, 3), axis), copied=False))
    return made[0] if len(made) == 1 else None  # with more the sides are not meant to be mirrored


def _copied(of: Simulation, left: int, right: int, axis: int, above: bool) -> Iterator[Stray]:
    """By pair of bodies and what hangs on them unturned: the geoms that have one place on both sides.

    A geom counts where it is beside its joint, and nothing else hangs on the body: else one part may be built in twice.
    """
    below, others = (of.children.get(side, []) for side in (left, right))
    for one, other in zip(below, others, strict=False):
        if _unturned(of, "body", one, other):
            yield from _copied(of, one, other, axis, above)
    geoms = [list(of.geoms_of(side)) for side in (left, right)]
    if below or others or len(geoms[0]) != len(geoms[1]):
        return
    places = {geom: of.row("geom_pos", geom, 3) for side in geoms for geom in side}
    for one, other in zip(*geoms, strict=True):
        image = flipped(places[one], axis)
        alone = not any(math.dist(places[geom], image) < SAME for geom in geoms[0])
        beside = abs(image[axis]) > BESIDE * of.model("geom_rbound")[one]
        if alone and beside and math.dist(places[one], places[other]) < SAME and _unturned(of, "geom", one, other):
            inward = (places[one][axis] > 0) != above
            yield Stray("geom", *((one, other) if inward else (other, one)), image, copied=True)


def _cast(of: Simulation, side: int) -> bool:
    """Whether meshes hang on a side, which may be mirrored themselves."""
    return any(int(of.model("geom_type")[geom]) == MESH for body in of.below(side) for geom in of.geoms_of(body))


def _unturned(of: Simulation, kind: str, one: int, other: int) -> bool:
    """Whether two parts are turned alike against what they hang on, bodies not at all."""
    turns = [of.row(f"{kind}_quat", each, 4) for each in (one, other)]
    return math.dist(*turns) < SAME and (kind == "geom" or turns[0][0] > 1 - SAME)


def exact(model: ReaderModel) -> Iterator[Suspect]:
    """The part that is not where its twin's image is, with that place."""
    of = model.simulation
    if (found := stray(of)) is None:
        return
    names = of.name(found.kind, found.index), of.name(found.kind, found.twin)
    now, value = written(of.row(f"{found.kind}_pos", found.index, 3)), written(found.wanted)
    says = f"It has the place of {names[1]} on the other side, and goes inwards where that goes outwards."
    if not found.copied:
        says = f"It is not at the mirror image of its twin, {names[1]}, and other pairs are."
    edits = model.set(found.kind, [found.index], "pos", value)
    if model.value(found.kind, found.index, "fromto"):
        edits = ()
    probe = Probe("distance from the twin's mirror image", "m", _off, dynamic=False)
    yield Suspect(names, "pos", now, value, edits, probe, OFF, says, "at the mirror image", level="hint")


def _off(of: Simulation) -> float:
    found = stray(of)
    return math.dist(of.row(f"{found.kind}_pos", found.index, 3), found.wanted) if found else 0.0
