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
places, of the same kinds and sizes, and touch; without solid geoms, with all their geoms, and of the same mass. Of 499
healthy models none has one. Where a link goes back by what its parent goes forth, its sign is turned. Of a propeller's
blades, which stand in one place and are turned, the second of the two that are turned alike is named.

So are the two sites of a body that are called alike but for a number and read by sensors, in one place that is not its
origin, and turned alike; the second is put on the other side. And a left and a right body that hang in one place, aside
of the middle of what they hang on, and whose geoms are mirror images, or without geoms their masses and what hangs on
them.

When it is wrong: parts that are meant to start in one place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import combinations

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import OBJ_SITE
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.vector import Vector, at, flipped, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import ORIENTATIONS
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "Two parts in one place"
FAMILIES = ("jumps-at-start", "stuck", "slips")
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
        attribute, now = "pos", " ".join(f"{x:.4g}" for x in of.row("body_pos", odd, 3))
        if not edits and (turned_alike := _turned_alike(model, bodies)):
            odd, attribute, now = turned_alike
        names = tuple(dict.fromkeys((of.name("body", odd), *names)))
        yield Suspect(names, attribute, now, value, edits, probe, 0.1, says, "none")
    for odd, other in _one_side(of):
        moved, side = list(of.row("body_pos", odd, 3)), _mirrored(of, odd, other)
        moved[side] = -moved[side]
        names, value = (of.name("body", odd), of.name("body", other)), written(moved)
        says = f"{names[0]} and {names[1]} hang in one place, and their parts are mirror images."
        now, edits = written(of.row("body_pos", odd, 3)), model.placed(odd, moved)
        probe = how_many("left and right bodies in one place", _one_side)
        yield Suspect(names, "pos", now, value, edits, probe, 0, says, "none")
    for first, second in _sites(of):
        place, names = of.row("site_pos", second, 3), (of.name("site", second), of.name("site", first))
        far = max(range(3), key=lambda i: abs(place[i]))
        value = written(flipped(place, far))
        edits = model.set("site", [second], "pos", value)
        says = f"{names[1]} and {names[0]} are in one place of {of.name('body', of.body_of('site', second))}."
        probe = how_many("sites in the place of another one of their row", _sites)
        yield Suspect(names, "pos", written(place), value, edits, probe, 0, says, "none")


def _one_side(of: Simulation) -> list[tuple[int, int]]:
    """The pairs in one place aside of their parent's middle, that body first whose geoms go to the other side."""
    made = []
    for pair in by_name(of, "body"):
        side, above = _mirrored(of, *pair), {of.parent(each) for each in pair}
        places = [(*of.row("body_pos", each, 3), *of.row("body_quat", each, 4)) for each in pair]
        if side < 0 or len(above) > 1 or norm(sub(*places)) > NEAR or abs(places[0][side]) < NEAR:
            continue
        middle = [of.row("geom_pos", geom, 3)[side] for geom in of.geoms_of(*above)] or [0.0]
        if abs(sum(middle)) < len(middle) * abs(places[0][side]) / 2:
            own = _parts(of, pair[0])[0][side]
            made.append(pair if own * places[0][side] < 0 else (pair[1], pair[0]))
    return made


def _mirrored(of: Simulation, one: int, other: int) -> int:
    """The axis across which the geoms of two bodies are mirror images; -1 for none."""
    places = [_parts(of, body) for body in (one, other)]
    sizes = [[of.row("geom_size", geom, 3) for geom in of.geoms_of(body)] for body in (one, other)]
    if not places[0] or len(places[0]) != len(places[1]) or sizes[0] != sizes[1]:
        return -1
    for side in range(3):
        images = [flipped(place, side) for place in places[0]]
        if abs(images[0][side]) > NEAR and all(norm(sub(*both)) < NEAR for both in zip(images, places[1], strict=True)):
            return side
    return -1


def _parts(of: Simulation, body: int) -> list[Vector]:
    """The places of a body's geoms; without any, of the bodies that hang on it and of its mass."""
    hung = [of.row("body_pos", each, 3) for each in of.children.get(body, [])]
    return [of.row("geom_pos", geom, 3) for geom in of.geoms_of(body)] or [*hung, of.row("body_ipos", body, 3)] * bool(
        hung
    )


def _sites(of: Simulation) -> list[tuple[int, int]]:
    """The two sites of a body called alike but for a number, both read by sensors, that stand in one place."""
    ends = [zip(of.model(f"sensor_{end}type"), of.model(f"sensor_{end}id"), strict=True) for end in ("obj", "ref")]
    read = {int(site) for end in ends for kind, site in end if int(kind) == OBJ_SITE}
    rows: dict[tuple[int, str], list[int]] = {}
    for site, name in enumerate(of.names("site")):
        if (row := re.sub(r"\d+", "#", name)) != name:
            rows.setdefault((of.body_of("site", site), row), []).append(site)
    pairs = [(row[0], row[1]) for row in rows.values() if len(row) == 2 and read.issuperset(row)]
    return [pair for pair in pairs if _one_place(of, *pair)]


def _one_place(of: Simulation, one: int, other: int) -> bool:
    """Whether two sites have one place, which is not their body's origin, and are turned alike."""
    places = [(*of.row("site_pos", site, 3), *of.row("site_quat", site, 4)) for site in (one, other)]
    return any(places[0][:3]) and all(abs(a - b) < NEAR for a, b in zip(*places, strict=True))


def _turned_back(model: ReaderModel, bodies: Sequence[int]) -> tuple[Edit, ...]:
    """The edit that lets a link go on as its parent does, where it goes back by as much and most others do not."""
    of = model.simulation
    parent = of.parent(bodies[1])
    places = [of.row("body_pos", body, 3) for body in range(of.count("body"))]
    back, own = places[parent], places[bodies[1]]
    beyond = norm([a + b for a, b in zip(back, own, strict=True)]) > NEAR
    if of.parent(parent) != bodies[0] or beyond or places.count(back) <= places.count(own):
        return ()
    return model.placed(bodies[1], back)


def _turned_alike(model: ReaderModel, bodies: Sequence[int]) -> tuple[int, str, str] | None:
    """The second of two that hang turned alike where a third in their place is turned otherwise: how it is turned."""
    of = model.simulation
    lines = [reversed(of.ancestors(body)) for body in bodies[:2]]
    hung = next(((one, other) for one, other in zip(*lines, strict=False) if one != other), None)
    if hung is None:
        return None
    beside = {each: of.row("body_pos", each, 3) for each in of.children.get(of.parent(hung[1]), [])}
    turns = {of.row("body_quat", each, 4) for each, place in beside.items() if place == beside[hung[1]]}
    element = model.element("body", hung[1])
    said = next((name for name in ORIENTATIONS if element is not None and element.get(name)), None)
    if element is None or said is None or len(turns) < 2 or beside[hung[0]] != beside[hung[1]]:
        return None
    return hung[1], said, element.get(said)


def _together(of: Simulation) -> list[list[int]]:
    """Bodies with joints that stand in one place with the same solid geoms at the start, and touch."""
    of.begin()
    places, owners = tuple(of.data("geom_xpos")), of.model("geom_bodyid")
    touching = {frozenset(int(owners[geom]) for geom in each.geoms if geom >= 0) for each in of.engine.contacts()}
    groups: dict[tuple[float, ...], list[int]] = {}
    for body in of.moving_bodies:
        key: list[float] = []
        bare = not any(solid(of, geom) for geom in of.geoms_of(body))
        for geom in of.geoms_of(body) if of.joints_of(body) else ():
            if solid(of, geom) or bare:
                key += [round(x, 4) for x in at(places, geom)]
                key += [round(x, 3) + 0.0 for x in of.data_row("geom_xmat", geom, 9)]
                key += [of.model("geom_type")[geom], *(round(x, 6) for x in of.row("geom_size", geom, 3))]
        if key:
            key += [round(of.model("body_mass")[body], 6)] if bare else []
            groups.setdefault(tuple(key), []).append(body)
    return [
        bodies
        for bodies in groups.values()
        if any({*pair} in touching or _unseen(of, *pair) for pair in combinations(bodies, 2))
    ]


def _unseen(of: Simulation, one: int, other: int) -> bool:
    """Whether two bodies have geoms that touch nothing at all, and neither hangs on the other."""
    geoms = (*of.geoms_of(one), *of.geoms_of(other))
    hung = one in of.ancestors(other) or other in of.ancestors(one)
    return not hung and not any(solid(of, geom) for geom in geoms)
