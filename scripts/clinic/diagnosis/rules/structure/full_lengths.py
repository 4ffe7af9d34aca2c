"""A box is sunk into the ground: its size has full lengths.

The `size` of a box, and the second one of a cylinder, are half lengths in MuJoCo. Written in full, a box that was
meant to stand on the floor is twice as large, and a quarter of it is below the floor.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <geom name="step" type="box" size="0.3 1.2 0.1" pos="0.65 0 0.05"/>
        <body pos="0 0 1">
          <freejoint/>
          <geom size="0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="step" type="box" size="0.3 1.2 0.1" pos="0.65 0 0.05"/>
    +     <geom name="step" type="box" size="0.15 0.6 0.05" pos="0.65 0 0.05"/>

The number: upright boxes and cylinders whose middle is as high above a plane, or above the box that they stand on, as a
half of their half height: with half the size they would stand on it. And a wall of a maze: of four boxes and more of a
body that are as wide and as high, the one that ends beyond all its other boxes, and with half its length would not.
And a box of something that moves which begins in two and more things that stand still, and with half its size in none,
but nearer to two of them than a quarter of it. And the site of a touch sensor, in the middle and along the axis of a
capsule or cylinder of its body, hardly thicker and twice as long.

When it is wrong: a box that is to be sunk by exactly so much.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import BOX, CAPSULE, CYLINDER, PLANE
from clinic.diagnosis.probes.overlap import sunk_by_half
from clinic.diagnosis.probes.shape import boxes, thickness
from clinic.diagnosis.probes.touched import touch_sites
from clinic.diagnosis.probes.vector import dot, norm, of_quaternion, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, counted, how_many

TITLE = "A size with full lengths"
FAMILIES = ("jumps-at-start", "explodes", "wrong-numbers")
UNPLANTED = "how large a box should be, only its maker knows"

DEEP = 0.1  # of the thickness
TWICE, THICK = (1.9, 2.1), 1.3  # of the geom's half length; of its radius
BESIDE, ALONG = 0.1, 0.99  # of its half length; the cosine
WALLS, OUT = 3, 0.02  # others in a row; of the length of all others


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All boxes and cylinders that would stand on something with half their size, and walls that stick out."""
    of = model.simulation
    for geom in _sticking_out(of):
        half = of.row("geom_size", geom, 3)
        value = written([x / 2 if x == max(half) else x for x in half])
        says = "It ends beyond all else of its body, and with half its length would not; the others are as wide."
        probe = how_many("walls that stick out of their body", _sticking_out)
        wall = (of.name("geom", geom),)
        yield Suspect(wall, "size", written(half), value, model.set("geom", [geom], "size", value), probe, 0, says, "")
    yield from _stuck(model)
    yield from _sensed(model)
    of.begin()
    found = [geom for geom in range(of.count("geom")) if sunk_by_half(of, geom)]
    placed = [(geom, element) for geom in found if (element := model.element("geom", geom)) is not None]
    placed = [(geom, element) for geom, element in placed if element.get("size") and not element.get("fromto")]
    if not placed:
        return
    edits, names = [], tuple(of.name("geom", geom) for geom, _ in placed)
    for geom, element in placed:
        sizes = [float(word) for word in element.get("size").split()]
        round_ = int(of.model("geom_type")[geom]) == CYLINDER
        halves = [size if round_ and not index else size / 2 for index, size in enumerate(sizes)]
        edits.append(set_attribute(element, "size", " ".join(f"{size:.6g}" for size in halves)))
    says = "size is half of a length: with half of this one it would stand on what it is sunk into."
    now, probe = placed[0][1].get("size"), counted("boxes that are sunk by half their half height", len(placed))
    yield Suspect(names, "size", now, edits[0].value, tuple(edits), probe, 0.5, says, "half lengths")


def _sensed(model: ReaderModel) -> Iterator[Suspect]:
    """The sites of touch sensors that are twice as long as what they are around."""
    of = model.simulation
    for site in _around(of):
        radius, half, _ = of.row("site_size", site, 3)
        value, name = written([radius, half / 2]), of.name("site", site)
        says = f"{name} of a touch sensor is twice as long as the geom that it is around."
        probe = how_many("touch sites that are twice as long as their geom", _around)
        edits = model.set("site", [site], "size", value)
        yield Suspect((name,), "size", written([radius, half]), value, edits, probe, 0, says, "half lengths")


def _stuck(model: ReaderModel) -> Iterator[Suspect]:
    """The boxes that are in what stands around them, and with half their size would fit between."""
    of = model.simulation
    for geom, others in _between(of).items():
        half = of.row("geom_size", geom, 3)
        value = written([x / 2 for x in half])
        names = tuple(of.name("geom", each) for each in (geom, *others))
        says = f"It begins in {len(others)} things that stand still, and with half its size fits between them."
        probe = how_many("boxes in what stands around them", _between)
        edits = model.set("geom", [geom], "size", value)
        yield Suspect(names, "size", written(half), value, edits, probe, 0, says, "half lengths")


def _between(of: Simulation) -> dict[int, list[int]]:
    """By box of something that moves, the things that stand still in which it begins, where half of it would fit."""
    of.begin()
    kinds, bodies, moving, found = (
        of.model("geom_type"),
        of.model("geom_bodyid"),
        set(of.moving_bodies),
        dict[int, set[int]](),
    )
    for contact in of.engine.contacts():
        for geom, other in (contact.geoms, contact.geoms[::-1]):
            still = int(bodies[geom]) in moving and int(bodies[other]) not in moving
            if still and int(kinds[geom]) == BOX and -contact.distance > DEEP * thickness(of, geom):
                found.setdefault(geom, set()).add(other)
    return {geom: sorted(others) for geom, others in found.items() if len(others) > 1 and _fits(of, geom, others)}


def _fits(of: Simulation, geom: int, others: set[int]) -> bool:
    """Whether a box of half the size is in none of the others, and near two of them."""
    size, there = of.row("geom_size", geom, 3), boxes(of, [geom, *others])
    place, half = there[geom]
    gaps = []
    for other in others:
        at, reach = there[other]
        if int(of.model("geom_type")[other]) == PLANE:
            gaps.append(place[2] - of.data_row("geom_xpos", other, 3)[2] - half[2] / 2)
        else:
            apart = (abs(a - b) - c / 2 - d for a, b, c, d in zip(place, at, half, reach, strict=True))
            gaps.append(max(apart))
    return min(gaps) > 0 and sum(gap < max(size) / 8 for gap in gaps) > 1


def _around(of: Simulation) -> list[int]:
    """The sites of touch sensors that have the place and axis of a round geom of their body, and twice its length."""
    return sorted(
        site
        for site in {*touch_sites(of)}
        if any(_twice(of, site, geom) for geom in of.geoms_of(of.body_of("site", site)))
    )


def _twice(of: Simulation, site: int, geom: int) -> bool:
    kinds = int(of.model("site_type")[site]), int(of.model("geom_type")[geom])
    (thick, long, _), (radius, half, _) = of.row("site_size", site, 3), of.row("geom_size", geom, 3)
    if not {*kinds} <= {CAPSULE, CYLINDER} or not TWICE[0] * half < long < TWICE[1] * half or thick > THICK * radius:
        return False
    place, middle = of.row("site_pos", site, 3), of.row("geom_pos", geom, 3)
    axes = [of_quaternion(of.row(name, each, 4))[2::3] for name, each in (("site_quat", site), ("geom_quat", geom))]
    return norm(sub(place, middle)) < BESIDE * half and abs(dot(*axes)) > ALONG


def _sticking_out(of: Simulation) -> list[int]:
    """The walls that end beyond all other boxes of their body and with half the length do not, one of a body."""
    kinds, made = of.model("geom_type"), []
    for body in range(1, of.count("body")):
        boxes = [geom for geom in of.geoms_of(body) if int(kinds[geom]) == BOX and _upright(of, geom)]
        found = [geom for geom in boxes if _sticks_out(of, geom, [each for each in boxes if each != geom])]
        made += found if len(found) == 1 else []
    return made


def _upright(of: Simulation, geom: int) -> bool:
    return of.row("geom_quat", geom, 4)[0] == 1


def _sticks_out(of: Simulation, geom: int, others: list[int]) -> bool:
    half, place = of.row("geom_size", geom, 3), of.row("geom_pos", geom, 3)
    row = [each for each in others if sorted(of.row("geom_size", each, 3))[:2] == sorted(half)[:2]]
    if len(row) < WALLS:
        return False
    along = half.index(max(half))
    ends = [(of.row("geom_pos", each, 3)[along], of.row("geom_size", each, 3)[along]) for each in others]
    low, high = min(at - size for at, size in ends), max(at + size for at, size in ends)
    beyond, inside = (
        max(low - place[along] + size, place[along] + size - high) for size in (half[along], half[along] / 2)
    )
    return beyond > OUT * (high - low) and inside <= 0
