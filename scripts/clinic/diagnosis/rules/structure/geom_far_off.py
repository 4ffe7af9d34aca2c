"""A geom lies far away from the rest of its mechanism.

A mesh in millimetres, a point where a comma was typed, an `origin` that was never set: one part floats metres away from
the robot. It hits things that are nowhere near, and whoever plans around it finds no way.

Bad:

    <mujoco>
      <worldbody>
        <body name="base" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.05"/>
          <geom name="bumper" size="0.03" pos="-19.4 0 15.5"/>
          <body name="arm" pos="0 0 0.1">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="bumper" size="0.03" pos="-19.4 0 15.5"/>
    +       <geom name="bumper" size="0.03" pos="-0.12 0 0"/>

The number: how far the geom's middle is from the nearest other geom of its mechanism at the start, in sizes of the box
around all the others; more than 3. And a rod that begins at its body's joint and ends in the air, where the one other
geom of that body, which touches nothing, is where the rod would end with another sign.

When it is wrong: two things of one mechanism that are meant to be far apart.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.shape import mechanisms, rods
from clinic.diagnosis.probes.vector import Vector, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A geom far away from the rest"
FAMILIES = ("jumps-at-start", "drifts", "stuck")
AFLOAT = True
UNPLANTED = "what is far away harms by what happens to be there"

FAR, ENOUGH, PAIR = 3.0, 3, 2
SAME = 1e-4  # m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms that no other of their mechanism is near: such a one is the outermost along some axis."""
    of = model.simulation
    yield from _across(model)
    of.begin()
    for root, places in _places(of).items():
        if len(places) < ENOUGH:
            continue
        for geom in sorted(
            {end(places, key=lambda each: places[each][axis]) for axis in range(3) for end in (min, max)}
        ):
            far = _apart(of, places, geom)
            if far > FAR:
                probe = Probe("distance from the rest", "of its size", _far, (root, geom), dynamic=False)
                where = of.row("geom_pos", geom, 3)
                says = (
                    f"The nearest other geom of its mechanism is {far:.3g} times the size of all others together away."
                )
                now = " ".join(f"{x:.4g}" for x in where)
                yield Suspect((of.name("geom", geom),), "pos", now, "near its body", (), probe, FAR, says, "below 3")


def _across(model: ReaderModel) -> Iterator[Suspect]:
    """The rods that point away from what they carry, each."""
    of = model.simulation
    for rod, (geom, signs) in _astray(of).items():
        now = model.value("geom", rod, "fromto") or ""
        ends = [float(each) for each in now.split()]
        value = written([*ends[:3], *(sign * x for sign, x in zip(signs, ends[3:], strict=True))])
        names, edits = (of.name("geom", rod), of.name("geom", geom)), model.set("geom", [rod], "fromto", value)
        says = f"It ends in the air; {names[1]} is where it would end with another sign, and touches nothing."
        probe = how_many("rods that point away from what they carry", _astray)
        yield Suspect(names, "fromto", now, value, edits if now else (), probe, 0, says, "at what it carries")


def _astray(of: Simulation) -> dict[int, tuple[int, Vector]]:
    """By rod the geom of its body that is across from its end, and by which signs."""
    made = {}
    for body in of.moving_bodies:
        geoms = of.geoms_of(body)
        things = [of.row("geom_pos", each, 3) for each in geoms]
        things += [of.row("body_pos", each, 3) for each in of.children.get(body, [])]
        things += [of.row("site_pos", each, 3) for each in range(of.count("site")) if of.body_of("site", each) == body]
        for rod, end in rods(of, body) if len(geoms) == PAIR else ():
            (geom,) = {*geoms} - {rod}
            place, reach = of.row("geom_pos", geom, 3), of.model("geom_rbound")[geom]
            same = all(abs(abs(a) - abs(b)) < SAME for a, b in zip(place, end, strict=True))
            apart = norm(sub(place, end)) > norm(end) and norm(place) > 2 * reach
            if same and apart and not any(norm(sub(each, end)) < reach for each in things):
                made[rod] = geom, tuple(-1.0 if a * b < 0 else 1.0 for a, b in zip(place, end, strict=True))
    return made


def _places(of: Simulation) -> dict[int, dict[int, Vector]]:
    """Where the geoms are that have an end and may move, by the root of their mechanism."""
    return {root: {geom: of.data_row("geom_xpos", geom, 3) for geom in geoms} for root, geoms in mechanisms(of).items()}


def _far(of: Simulation, root: int, geom: int) -> float:
    of.begin()
    return _apart(of, _places(of)[root], geom)


def _apart(of: Simulation, places: dict[int, Vector], geom: int) -> float:
    """How far a geom is from the nearest other one, in sizes of the box around the others."""
    others = [place for each, place in places.items() if each != geom]
    sides = [max(axis) - min(axis) for axis in zip(*others, strict=True)]
    size = math.hypot(*sides) + 2 * max(of.model("geom_rbound")[each] for each in places if each != geom)
    return min(math.dist(places[geom], other) for other in others) / size if size > 0 else 0.0
