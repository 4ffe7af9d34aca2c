"""A link does not hang on the end of the one before it.

A rod ends 0.6 m from its joint, and the next one hangs 6 m away in the same direction, or both begin in one place: a
`pos` that was forgotten, a decimal point in one of two numbers that say the same length.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          <body name="lower">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0.25 0 0" size="0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <body name="lower">
    +       <body name="lower" pos="0.3 0 0">

The number: where the next link with a joint begins, in lengths of a capsule or cylinder that begins at its own body's
origin: 10, 100, ... times as far, where no other geom is; a tenth, a hundredth, ..., where the rod is the one that is
unlike the others, or where it is so to the digit, of two digits and more, and nothing is at the rod's end; or at its
beginning, where the next one's is a rod in the same direction. And, of a long box too, as far on the other side, where
no other geom is, of two links at most.

And, of links of any shape that hinges move, the one that is more than 0.3 of its size away from what it hangs on, where
two and more others all touch theirs, and so does it with two digits of its `pos` exchanged, or with another sign.

When it is wrong: a telescope that is drawn pushed in.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HFIELD, HINGE, PLANE
from clinic.diagnosis.probes.shape import boxes, rods
from clinic.diagnosis.probes.vector import Vector, add, dot, norm, of_quaternion, sub, times, unit, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A link off the end of the one before"
FAMILIES = ("drifts", "stuck", "jumps-at-start", "wrong-numbers")
AFLOAT = True
UNPLANTED = "where a link belongs, only a drawing tells"

APART, TOUCHES, LINKS, LARGE = 0.3, 0.05, 3, 100  # sizes of the link; bodies
WITHIN, PARALLEL, OFF, OPPOSITE, FEW = 0.15, 0.985, 0.5, 0.98, 2
EXACT, AT_END = 1e-5, 0.2


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each link that is in one line with the rod before it, and not at its end."""
    of = model.simulation
    if (alone := _alone(of)) is not None:
        yield from _slipped(model, alone)
    for body in of.moving_bodies:
        parent, share = of.parent(body), _share(of, body)
        if not parent or not of.joints_of(body) or share == 1:
            continue
        geom, rod = rods(of, parent, boxed=share < 0)[-1]
        place, above = of.row("body_pos", body, 3), of.name("body", parent)
        length = f"The rod of {above} ends {norm(rod):.3g} m from where that begins, and {of.name('body', body)}"
        says = f"{length} hangs {norm(place):.3g} m away in the same direction."
        if share == -1:
            says = f"{length} hangs as far away in the opposite direction."
        if share == 0:
            says = f"{length}, a rod in the same direction, begins where {above} does."
        probe = Probe("a link from the end of the rod before it", "of the rod's length", _off, (body,), dynamic=False)
        names, text = [of.name("body", body), above], model.value("geom", geom, "fromto")
        if share > 0 and text and _odd_rod(of, geom, rod, place):
            names, attribute, now = [of.name("geom", geom), *names], "fromto", text
            value = written([share * float(each) for each in text.split()])
            edits = model.set("geom", [geom], "fromto", value)
        else:
            attribute, now = "pos", written(place)
            back = add(place, unit(rod), -2 * dot(place, unit(rod)))
            value = written(rod if share == 0 else back if share < 0 else [x / share for x in place])
            edits = model.placed(body, [float(each) for each in value.split()])
        yield Suspect(
            tuple(names), attribute, now, value, edits, probe, OFF, says, "at the end of a rod, or on its way"
        )


def _slipped(model: ReaderModel, body: int) -> Iterator[Suspect]:
    """The link that is away from what it hangs on, where a slip of the pen in its place tells why."""
    of, probe = model.simulation, Probe("a link from the one before", "of its size", _gap, (body,), dynamic=False)
    place = of.row("body_pos", body, 3)
    meets = [each for each in _slips(place) if model.measured(probe, model.placed(body, each)) <= TOUCHES]
    if not meets:
        return
    value, above = max(meets, key=norm), of.name("body", of.parent(body))
    names = (of.name("body", body), above)
    says = f"It begins {_gap(of, body):.2g} times its own size away from {above}; all other links touch theirs."
    edits = model.placed(body, value)
    yield Suspect(names, "pos", written(place), written(value), edits, probe, APART, says, "at the link before")


def _slips(place: Vector) -> Iterator[Vector]:
    """A place with two neighbouring digits of a number exchanged, or another sign of it."""
    for at, number in enumerate(place):
        text = f"{abs(number):.6g}"
        pairs = [i for i in range(len(text) - 1) if text[i : i + 2].isdigit()] if "e" not in text else []
        swapped = {float(text[:i] + text[i + 1] + text[i] + text[i + 2 :]) for i in pairs}
        for other in {math.copysign(each, number) for each in swapped} | {-number}:
            if other != number:
                yield tuple(other if i == at else x for i, x in enumerate(place))


def _alone(of: Simulation) -> int | None:
    """The one link that is away from what it hangs on, where all others touch it and are two at least."""
    found = _gaps(of)
    away = [body for body, gap in found.items() if gap > TOUCHES]
    return away[0] if len(away) == 1 and len(found) >= LINKS and found[away[0]] > APART else None


def _gap(of: Simulation, body: int) -> float:
    return _gaps(of).get(body, 0.0)


@kept
def _gaps(of: Simulation) -> dict[int, float]:
    """How far the links that hinges alone move are from what they hang on, box from box, in sizes of their own.

    What is fixed to a body is part of it; bodies that hang on the world are left out, and large models.
    """
    if of.count("body") > LARGE:
        return {}
    of.as_written()
    kinds, welds, links = of.model("geom_type"), of.model("body_weldid"), dict[int, list[int]]()
    shapes = [geom for geom, kind in enumerate(kinds) if int(kind) not in (PLANE, HFIELD)]
    every = boxes(of, shapes)
    for geom in shapes:
        if on := of.body_of("geom", geom):
            links.setdefault(int(welds[on]), []).append(geom)
    made = {}
    for body in of.moving_bodies:
        joints, parent = of.joints_of(body), of.parent(body)
        own, above = links.get(int(welds[body]), []), links.get(int(welds[parent]), [])
        hinged = bool(joints) and all(of.joint_type(joint) == HINGE for joint in joints)
        if hinged and parent and own and above:
            gaps = [_between(every[one], every[other]) for one in own for other in above]
            made[body] = min(gaps) / max(2 * max(_radius(of, geom) for geom in own), 1e-12)
    return made


def _between(one: tuple[Vector, Vector], other: tuple[Vector, Vector]) -> float:
    """How far two boxes along the world's axes are apart, in m."""
    places, halves = zip(one[0], other[0], strict=True), zip(one[1], other[1], strict=True)
    return norm([max(0.0, abs(a - b) - c - d) for (a, b), (c, d) in zip(places, halves, strict=True)])


def _odd_rod(of: Simulation, geom: int, rod: Vector, place: Vector) -> bool:
    """Whether it is the rod's length, and not the next link's place, that is unlike the other rods of the model."""
    others = [norm(end) for body in of.moving_bodies for other, end in rods(of, body) if other != geom]
    if not others:
        return False
    usual = sorted(others)[len(others) // 2]
    return abs(math.log(norm(rod) / usual)) > abs(math.log(norm(place) / usual))


def _off(of: Simulation, body: int) -> float:
    """How far a link begins from the end of the rod before it, in lengths of the rod; 0 where that is no mistake's."""
    if _share(of, body) == 1:
        return 0.0
    rod = rods(of, of.parent(body), boxed=_share(of, body) < 0)[-1][1]
    return norm(sub(of.row("body_pos", body, 3), rod)) / norm(rod)


def _share(of: Simulation, body: int) -> float:
    """Where a link is along the rod before it, where that is a mistake's number: 0, -1 or a power of ten; else 1."""
    parent, place = of.parent(body), of.row("body_pos", body, 3)
    above = rods(of, parent)
    if body in _opposite(of):
        return -1.0
    if not above:
        return 1.0
    rod = above[-1][1]
    if norm(place) < 0.02 * norm(rod):
        own = [times(of_quaternion(of.row("body_quat", body, 4)), end) for _, end in rods(of, body)[-1:]]
        beside = any(dot(unit(end), unit(rod)) > PARALLEL and norm(end) > 0.4 * norm(rod) for end in own)
        return 0.0 if beside else 1.0
    along, power = dot(unit(place), unit(rod)), round(math.log10(norm(place) / norm(rod)))
    if along > 1 - EXACT and power < 0 and _slip(of, parent, norm(place) / 10.0**power, norm(rod)):
        return float(10.0**power)
    near = [geom for geom in of.geoms_of(parent) if norm(sub(of.row("geom_pos", geom, 3), place)) < _radius(of, geom)]
    if along < PARALLEL or len(near) > (power < 0):  # the rod itself
        return 1.0
    if abs(math.log10(norm(place) / norm(rod)) - power) > math.log10(1 + WITHIN):
        return 1.0
    if power < 0 and not _odd_rod(of, above[-1][0], rod, place):  # what hangs on its way
        return 1.0
    return float(10.0**power)


def _slip(of: Simulation, body: int, written_: float, length: float) -> bool:
    """Whether it is a rod's length to the digit, of two and more, and nothing is at the rod's end."""
    digits = f"{length:.6e}".partition("e")[0].replace(".", "").rstrip("0")
    if len(digits) == 1 or abs(written_ / length - 1) > EXACT:
        return False
    places = [of.row("geom_pos", geom, 3) for geom in of.geoms_of(body)]
    places += [of.row("body_pos", each, 3) for each in of.children.get(body, [])]
    places += [of.row("site_pos", site, 3) for site in range(of.count("site")) if of.body_of("site", site) == body]
    return all(norm(place) < (1 - AT_END) * length for place in places)


@kept
def _opposite(of: Simulation) -> set[int]:
    """The links as far from their parent's joint as the end of its rod, on the other side; none of more than two."""
    found = {body for body in of.moving_bodies if of.parent(body) and of.joints_of(body) and _across(of, body)}
    return found if len(found) <= FEW else set()


def _across(of: Simulation, body: int) -> bool:
    parent, place = of.parent(body), of.row("body_pos", body, 3)
    for _, end in rods(of, parent, boxed=True)[-1:] if any(place) else ():
        as_far = abs(norm(place) / norm(end) - 1) < WITHIN
        near = (
            geom for geom in of.geoms_of(parent) if norm(sub(of.row("geom_pos", geom, 3), place)) < _radius(of, geom)
        )
        return as_far and dot(unit(place), unit(end)) < -OPPOSITE and not any(True for _ in near)
    return False


def _radius(of: Simulation, geom: int) -> float:
    return of.model("geom_rbound")[geom]
