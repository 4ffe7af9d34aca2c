"""Two parts that are alike stand in one place.

A second finger, box or wheel is a copy of the first one with the same `pos` (in a URDF: the same `origin`), or hangs on
the other side's parent: one is inside of the other.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 0.5">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body name="left_finger" pos="0 0 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
          <body name="right_finger" pos="0 0 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <body name="left_finger" pos="0 0 0.05">
    +       <body name="left_finger" pos="0 0.005 0.05">

    -       <body name="right_finger" pos="0 0 0.05">
    +       <body name="right_finger" pos="0 -0.005 0.05">

The number: groups of moving bodies, none of which hangs on another, that begin with all their solid geoms in the same
places, of the same kinds and sizes, and touch. Of 499 healthy models none has one. Where a link goes back by what its
parent goes forth, its sign is turned. And sites of one body, alike in name but for a number, with one place that is not
its origin, and one orientation; sites of tendons are left out. Of two alone the second is put on the other side.

When it is wrong: parts that are meant to start in one place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import combinations

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.tendons import path
from clinic.diagnosis.probes.vector import Vector, at, norm, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "Two parts in one place"
FAMILIES = ("jumps-at-start", "stuck", "slips")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "fingers of healthy models that are put in one place are told as overlapping"

NEAR = 1e-6  # m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each group of parts in one place; where one link that goes back explains all of them, that one."""
    of, probe = model.simulation, how_many("groups of parts in one place", _together)
    groups = _together(of)
    turned = [(bodies, edits) for bodies in groups if (edits := _turned_back(model, bodies))]
    explains = [each for each in turned if not model.measured(probe, each[1])]
    for bodies, edits in explains[:1] or [(bodies, ()) for bodies in groups]:
        names = tuple(of.name("body", body) for body in bodies)
        says = f"{names[0]} and {names[1]} begin in the same place, and have the same shape."
        odd, value = (bodies[1], edits[0].value) if edits else (bodies[0], "apart from each other")
        now = " ".join(f"{x:.4g}" for x in of.row("body_pos", odd, 3))
        names = tuple(dict.fromkeys((of.name("body", odd), *names)))
        yield Suspect(names, "pos", now, value, edits, probe, 0.1, says, "none")
    for first, second in _sites(of).items():
        place, names = of.row("site_pos", second, 3), (of.name("site", second), of.name("site", first))
        edits, value = (), "apart from each other"
        if (mirrored := _mirrored(of, second)) is not None:
            edits, value = model.set("site", [second], "pos", written(mirrored)), written(mirrored)
        says = f"{names[1]} and {names[0]} are in one place of {of.name('body', of.body_of('site', second))}."
        probe = how_many("sites in the place of another one of their row", _sites)
        yield Suspect(names, "pos", written(place), value, edits, probe, 0, says, "none")


def _row(name: str) -> str:
    return re.sub(r"\d+", "#", name)


def _sites(of: Simulation) -> dict[int, int]:
    """Sites of one body that are called alike but for a number and stand in one place: by the first, the second."""
    roped = {each for tendon in range(of.count("tendon")) for kind, each in path(of, tendon) if kind == "site"}
    seen: dict[tuple[object, ...], int] = {}
    made: dict[int, int] = {}
    for site, name in enumerate(of.names("site")):
        where = [round(x, 6) for x in (*of.row("site_pos", site, 3), *of.row("site_quat", site, 4))]
        if any(where[:3]) and site not in roped and _row(name) != name:
            first = seen.setdefault((of.body_of("site", site), _row(name), *where), site)
            made |= {first: site} if first != site else {}
    return made


def _mirrored(of: Simulation, site: int) -> Vector | None:
    """The place of one of two sites of a row on the other side of their body, along its longest way; else None."""
    names, body = of.names("site"), of.body_of("site", site)
    beside = [name for each, name in enumerate(names) if of.body_of("site", each) == body]
    place = of.row("site_pos", site, 3)
    far = max(range(3), key=lambda i: abs(place[i]))
    two = [_row(name) for name in beside].count(_row(names[site])) == 2
    return tuple(-x if i == far else x for i, x in enumerate(place)) if two else None


def _turned_back(model: ReaderModel, bodies: Sequence[int]) -> tuple[Edit, ...]:
    """The edit that lets a link go on as its parent does, where it goes back by as much and most others do not."""
    of = model.simulation
    parent = int(of.model("body_parentid")[bodies[1]])
    places = [of.row("body_pos", body, 3) for body in range(of.count("body"))]
    back, own = places[parent], places[bodies[1]]
    beyond = norm([a + b for a, b in zip(back, own, strict=True)]) > NEAR
    if int(of.model("body_parentid")[parent]) != bodies[0] or beyond or places.count(back) <= places.count(own):
        return ()
    return model.placed(bodies[1], back)


def _together(of: Simulation) -> list[list[int]]:
    """Bodies with joints that stand in one place with the same solid geoms at the start, and touch."""
    of.begin()
    places, owners = tuple(of.data("geom_xpos")), of.model("geom_bodyid")
    touching = {frozenset(int(owners[geom]) for geom in each.geoms if geom >= 0) for each in of.engine.contacts()}
    groups: dict[tuple[float, ...], list[int]] = {}
    for body in of.moving_bodies:
        key: list[float] = []
        for geom in of.geoms_of(body) if of.joints_of(body) else ():
            if solid(of, geom):
                key += [round(x, 4) for x in at(places, geom)]
                key += [round(x, 3) + 0.0 for x in of.data_row("geom_xmat", geom, 9)]
                key += [of.model("geom_type")[geom], *(round(x, 6) for x in of.row("geom_size", geom, 3))]
        if key:
            groups.setdefault(tuple(key), []).append(body)
    return [bodies for bodies in groups.values() if any({*pair} in touching for pair in combinations(bodies, 2))]
