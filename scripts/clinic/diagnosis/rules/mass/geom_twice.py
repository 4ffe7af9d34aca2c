"""A geom stands twice in its body.

Copied and not changed: without an `<inertial>` its mass counts twice, and nothing of it can be seen.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 1">
          <joint axis="0 1 0" range="-90 90"/>
          <geom type="box" size="0.05 0.02 0.04"/>
          <geom type="box" size="0.05 0.02 0.04"/>
        </body>
      </worldbody>
    </mujoco>

Good:

            <geom type="box" size="0.05 0.02 0.04"/>
    -       <geom type="box" size="0.05 0.02 0.04"/>

The number: the body's mass, and without the copy. Geoms count as the same when type, size, place, mesh, masks and color
are. Of two that are called left and right the one is told whose y is on the other side. Of the world two that collide
and are called differently are told, in a hint: one wall of a box is missing.

When it is wrong: two layers that are meant; more than two copies in a model are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.probes.matter import mass_of
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.tendons import path
from clinic.diagnosis.probes.vector import flipped, norm, numbers, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A geom stands twice"
FAMILIES = ("wrong-mass", "sags", "drifts")
AFLOAT = True

MORE = 1.05
FIELDS = {"type": 1, "size": 3, "pos": 3, "quat": 4, "dataid": 1, "contype": 1, "conaffinity": 1, "group": 1, "rgba": 4}
SIDES = ("east", "north", "west", "south")
MANY, SAME = 2, 1e-6  # so many are no slip; m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies that a second copy of a geom makes heavier."""
    of = model.simulation
    copies = [(body, *pair) for body in range(1, of.count("body")) for pair in _copies(of, body)]
    yield from _walls(model)
    for body, geom, first in copies if len(copies) <= MANY else ():
        if {geom, first} in map(set, by_name(of, "geom")):
            yield from _twins(model, geom, first)
            continue
        element = model.element("geom", geom)
        edits = (delete(element),) if element is not None else ()
        without = model.with_edits(edits)
        if isinstance(without, CompileError):
            continue
        rest = without.model("body_mass")[body]
        yield Suspect(
            (of.name("geom", geom), of.name("body", body)),
            "",
            "",
            f"without {of.name('geom', geom)}",
            edits,
            mass_of(body),
            MORE * rest if edits else 0.0,
            f"It has the type, the size and the place of {of.name('geom', first)}.",
            "one geom in one place",
            share=0.95,
            level="cause" if body in of.moving_bodies else "hint",
        )


def _twins(model: ReaderModel, *pair: int) -> Iterator[Suspect]:
    """A left and a right geom in one place: the one that is on the other side than it is called, x being ahead."""
    of = model.simulation
    left, right = next(each for each in by_name(of, "geom") if set(each) == set(pair))
    x, y, z = of.row("geom_pos", left, 3)
    wrong, twin = (left, right) if y < 0 else (right, left)
    value, name = written((x, -y, z)), of.name("geom", wrong)
    edits = model.set_each("geom", "pos", {wrong: value}) if y and _as_written(model, wrong) else ()
    probe = how_many("geoms that stand twice in a body", _copies, of.body_of("geom", wrong))
    says = f"It has the place of {of.name('geom', twin)}: a left and a right one stand on two sides."
    yield Suspect(
        (name, of.name("geom", twin)), "pos", written((x, y, z)), value, edits, probe, 0, says,
        "the mirror image of its twin", level="hint",
    )  # fmt: skip


def _walls(model: ReaderModel) -> Iterator[Suspect]:
    """Two geoms of the world in one place: the one that stands across from where its name says, mirrored."""
    of = model.simulation
    for pair in _standing_twice(of) if len(_standing_twice(of)) <= MANY else ():
        place, names = of.row("geom_pos", pair[0], 3), tuple(of.name("geom", geom) for geom in pair)
        across = [(geom, side) for geom in pair if (side := _across(of, geom)) is not None]
        value = written(flipped(place, across[0][1])) if len(across) == 1 else "apart from each other"
        if len(across) == 1 and across[0][0] != pair[0]:
            names = names[::-1]
        placed = len(across) == 1 and _as_written(model, across[0][0])
        edits = model.set("geom", [across[0][0]], "pos", value) if placed else ()
        probe = how_many("geoms of the world that stand where another one does", _standing_twice)
        says = f"{names[0]} and {names[1]} have the same place and size."
        yield Suspect(names, "pos", written(place), value, edits, probe, 0, says, "a wall on each side", level="hint")


def _as_written(model: ReaderModel, geom: int) -> bool:
    """Whether the place of a geom is its `pos`: not so of a `fromto`, in a frame, or of a mesh beside its origin."""
    written_at = tuple(numbers(model.value("geom", geom, "pos") or "0 0 0"))
    apart = norm(sub(written_at, model.simulation.row("geom_pos", geom, 3)))
    return not model.value("geom", geom, "fromto") and apart < SAME


def _standing_twice(of: Simulation) -> list[tuple[int, int]]:
    names = of.names("geom")
    found = [pair for pair in _copies(of, 0) if all(names[geom] and solid(of, geom) for geom in pair)]
    return [pair for pair in found if set(pair) not in map(set, by_name(of, "geom"))]


def _across(of: Simulation, geom: int) -> int | None:
    """The coordinate in which a geom is on another side than its name says, of east, north, west and south."""
    words = re.split(r"[^a-z]+", of.names("geom")[geom].lower())
    place = of.row("geom_pos", geom, 3)
    sides = [(at % 2, 1 - 2 * (at // 2)) for at, side in enumerate(SIDES) if {side, side[0]} & set(words)]
    return next((axis for axis, sign in sides if place[axis] * sign < 0), None) if len(sides) == 1 else None


def _copies(of: Simulation, body: int) -> list[tuple[int, int]]:
    """Geoms of a body that are like one before them, and that one."""
    made = []
    first: dict[tuple[float, ...], int] = {}
    wraps = {index for tendon in range(of.count("tendon")) for kind, index in path(of, tendon) if kind == "geom"}
    for geom in of.geoms_of(body):
        key = tuple(round(x, 6) for name, width in FIELDS.items() for x in of.row(f"geom_{name}", geom, width))
        if first.setdefault(key, geom) != geom and not {geom, first[key]} & wraps:  # each tendon has its own
            made.append((geom, first[key]))
    return made
