"""A cloth, rope or soft body begins inside of a geom.

Its points are pushed out: it leaps. Those in the middle of a thick geom may leave by the other side, and a cloth then
hangs on a post that goes through it. `pos` of a `<flexcomp>` is the middle of its grid, not its base.

Bad:

    <mujoco>
      <worldbody>
        <geom name="step" type="box" size="0.3 0.3 0.05" pos="0 0 0.05"/>
        <flexcomp name="gel" type="grid" dim="3" count="4 4 4" spacing="0.04 0.04 0.04" pos="0 0 .1" radius="0.005">
          <elasticity young="1e4" poisson="0.3" damping="0.001"/>
          <contact selfcollide="none"/>
        </flexcomp>
      </worldbody>
    </mujoco>

Good:

    -     <flexcomp name="gel" type="grid" dim="3" count="4 4 4" spacing="0.04 0.04 0.04" pos="0 0 .1" radius="0.005">
    +     <flexcomp name="gel" type="grid" dim="3" count="4 4 4" spacing="0.04 0.04 0.04" pos="0 0 .166" radius="0.005">

The number: the deepest contact of a flex with a geom at the start, as a share of the flex's largest extent; more than
0.1, and more than twice its radius. It is raised by what brings it out, where that does. With several flexes the one is
told beside which the contact is. Where some of it is pinned it is left alone.

When it is wrong: a cloth that is draped by code after the reset.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.shape import boxes
from clinic.diagnosis.probes.vector import Vector, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A soft body that begins inside of a geom"
FAMILIES = ("jumps-at-start", "explodes", "wrong-numbers")
LEVEL = "hint"
UNPLANTED = "no healthy model with a flex is planted with faults"

MOST, RADII, CLEAR = 0.1, 2.0, 1e-3  # of the flex's extent; of its radius; m above the geom


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each flexcomp without pins that is in a geom."""
    of = model.simulation
    for flex in model.source.elements("flexcomp") if model.source else ():
        name = flex.get("name") or ""
        if name not in of.names("flex") or flex.first("pin") is not None or _deep(of, name) <= MOST:
            continue
        depth, geom = _deepest(of, name)
        probe = Probe("depth of a flex in a geom at the start", "of its extent", _deep, (name,), dynamic=False)
        x, y, z = (float(each) for each in (flex.get("pos") or "0 0 0").split())
        value = written((x, y, round(z + _lift(of, name, geom), 4)))
        edits: tuple[Edit, ...] = (set_attribute(flex, "pos", value),)
        if model.measured(probe, edits) > MOST:
            edits, value = (), "clear of what it is in"
        told = (f'flexcomp "{name}"', of.name("geom", geom))
        says = f"It begins {1000 * depth:.3g} mm inside of {told[1]}."
        yield Suspect(told, "pos", written((x, y, z)), value, edits, probe, MOST, says, "clear of all geoms")


def _deep(of: Simulation, name: str) -> float:
    """The depth over the flex's extent; 0 where it is less than some radii."""
    depth, _ = _deepest(of, name)
    low, high = _box(of, name)
    radius = of.model("flex_radius")[of.names("flex").index(name)]
    return depth / max(b - a for a, b in zip(low, high, strict=True)) if depth > RADII * radius else 0.0


def _deepest(of: Simulation, name: str) -> tuple[float, int]:
    """How deep in m a flex is in a geom at the start, and that geom."""
    of.begin()
    low, high = _box(of, name)
    found = [(0.0, -1)]
    for contact in of.engine.contacts():
        depth = -contact.distance  # the contact is half as far from the flex
        near = all(a - depth < x < b + depth for a, x, b in zip(low, contact.position, high, strict=True))
        if min(contact.geoms) < 0 <= max(contact.geoms) and near:
            found.append((depth, max(contact.geoms)))
    return max(found)


def _box(of: Simulation, name: str) -> tuple[Vector, Vector]:
    """The lowest and the highest corner of the box around a flex, with its radius, as the state is now."""
    flex = of.names("flex").index(name)
    first, count = (int(of.model(f"flex_vert{field}")[flex]) for field in ("adr", "num"))
    places, radius = of.data("flexvert_xpos")[3 * first : 3 * (first + count)], of.model("flex_radius")[flex]
    low = tuple(min(places[axis::3]) - radius for axis in range(3))
    return low, tuple(max(places[axis::3]) + radius for axis in range(3))


def _lift(of: Simulation, name: str, geom: int) -> float:
    """By how much in m a flex has to be raised until it is above a geom."""
    low, _ = _box(of, name)
    if int(of.model("geom_type")[geom]) == PLANE:
        return of.data_row("geom_xpos", geom, 3)[2] - low[2] + CLEAR
    place, half = boxes(of, [geom])[geom]
    return place[2] + half[2] - low[2] + CLEAR
