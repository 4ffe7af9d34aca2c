"""Closing jaws on a free thing that is put between them: what friction carries of it, and whether it slides."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from clinic.diagnosis.engine import FREE, Contact
from clinic.diagnosis.probes.servo import hold
from clinic.diagnosis.probes.shape import size, solid
from clinic.diagnosis.probes.tendons import joints_of, pulled
from clinic.diagnosis.probes.touch import Deciding, deciding
from clinic.diagnosis.probes.vector import Vector, across, at, cross, dot, norm, sub, times, transpose, unit
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, probe

PAD = re.compile(r"(?i)finger|thumb|grip|jaw|pad|(?<![a-z])tip")  # what parts that hold something are called
CLOSING, CARRYING = 1.0, 2.0  # s
OPPOSITE = -0.7  # cosine of the normals of two jaws
PLACES, MOMENTS = 4, 40  # between the jaws, and while they close
ALONE = 2  # jaws that close on what they hang on: more are the fingers of a hand, or legs
FAR = 100.0  # m


@dataclass(frozen=True)
class Jaws:
    """Two bodies that close on each other, what they hang on, and the actuators that move them."""

    palm: int
    sides: tuple[int, int]
    actuators: tuple[int, ...]


@dataclass(frozen=True)
class Grasp:
    """A free thing between jaws that closed on it: forces in N, and how fast it leaves, in its radii a second.

    `force` is the sum of the normal forces, `carries` what friction bears of them. The speed is infinite where the
    thing falls.
    """

    body: int
    jaws: Jaws
    force: float
    carries: float
    weight: float
    deciding: tuple[Deciding, ...]
    leaves: float


class _Moment(NamedTuple):
    """While empty jaws close: the state, and where the middles of their geoms are."""

    qpos: list[float]
    middles: dict[int, Vector]


@kept
def grasps(simulation: Simulation) -> list[Grasp]:
    """What jaws hold of the free things that fit between them: for each pair of jaws the first."""
    of = simulation
    if not of.gravity:
        return []
    things = [body for body in of.free_bodies if len(of.below(body)) == 1 and _solids(of, body)]
    tries = ((_carried(of, jaws, body) for body in things) for jaws in (_jaws(of) if things else ()))
    found = (next((each for each in made if each is not None), None) for made in tries)
    return [each for each in found if each is not None]


def _jaws(of: Simulation) -> Iterator[Jaws]:
    """Pairs of links at the end of something, or one and what it hangs on, which an actuator moves."""
    jointed = [body for body in of.moving_bodies if of.model("body_jntnum")[body]]
    carriers = {above for body in jointed for above in of.ancestors(body)[1:]}
    palms: dict[int, list[int]] = {}
    for body in jointed:
        kinds = [of.joint_type(joint) for joint in of.joints_of(body)]
        if body not in carriers and len(kinds) == 1 and FREE not in kinds:
            palms.setdefault(of.parent(body), []).append(body)
    single = sum(len(found) == 1 for found in palms.values())
    for palm, found in palms.items():
        sides = (found[0], found[1]) if len(found) == 2 else (palm, found[0])
        joints = {joint for body in found for joint in of.joints_of(body)}
        moved = tuple(each for each in range(of.count("actuator")) if _moves(of, each, joints))
        few = len(found) == 2 or (len(found) == 1 and palm and single <= ALONE)
        if few and moved and all(_solids(of, side) for side in sides):
            yield Jaws(palm, sides, moved)


def _solids(of: Simulation, body: int) -> list[int]:
    return [geom for geom in of.geoms_of(body) if solid(of, geom)]


def _moves(of: Simulation, actuator: int, joints: set[int]) -> bool:
    """Whether an actuator that has a control range moves one of these joints, by itself or by a tendon."""
    if not of.model("actuator_ctrllimited")[actuator]:
        return False
    if (tendon := pulled(of).get(actuator)) is None:
        return of.driven_joint(actuator) in joints
    return any(joint in joints for joint, _ in joints_of(of, tendon))


def _carried(of: Simulation, jaws: Jaws, body: int) -> Grasp | None:
    """The first grasp that holds the thing without gravity, and then with it; None where there is none."""
    gravity = list(of.model("opt.gravity"))
    of.engine.write_model("opt.gravity", [0.0, 0.0, 0.0])
    try:
        for end in (0, 1):
            closing = _closing(of, jaws, body, end)
            for pair in _pairs(of, jaws, closing):
                if _closed(of, jaws, body, end, pair, closing) and (held := _held(of, jaws, body)):
                    decided = {each: deciding(of, each) for _, each, _ in pressing(of, of.engine.contacts(), body)}
                    forces = [(each.force, one.friction) for each, one in decided.items()]
                    weight = tuple(of.model("body_mass")[body] * x for x in _across(gravity, held[0].normal))
                    return Grasp(
                        body, jaws, sum(force for force, _ in forces), sum(force * each for force, each in forces),
                        norm(weight), tuple(dict.fromkeys(decided.values())),
                        _slides(of, jaws, body, weight) / max(size(of, body), 1e-9),
                    )  # fmt: skip
    finally:
        of.engine.write_model("opt.gravity", gravity)
    return None


def _across(gravity: list[float], normal: Vector) -> Vector:
    """Gravity turned until it is at right angles to the direction in which the jaws press."""
    down = across(gravity, normal)
    if norm(down) < norm(gravity) / 2:
        down = cross(normal, (1.0, 0.0, 0.0) if abs(normal[0]) < 0.9 else (0.0, 1.0, 0.0))
    return tuple(norm(gravity) * x for x in unit(down))


def _drive(of: Simulation, jaws: Jaws, end: int) -> None:
    for actuator in jaws.actuators:
        of.engine.write("ctrl", [of.row("actuator_ctrlrange", actuator, 2)[end]], actuator)


def _closing(of: Simulation, jaws: Jaws, body: int, end: int) -> list[_Moment]:
    """The way of the empty jaws, from where they rest at one end of their controls straight to the other."""
    of.begin()
    hold(of)
    of.engine.write("qpos", [0.0, 0.0, FAR], of.place(of.joints_of(body)[0]))
    rests = []
    for target in (1 - end, end):
        _drive(of, jaws, target)
        for _ in of.run(CLOSING, samples=1):
            pass
        rests.append(list(of.data("qpos")))
    geoms = [geom for side in jaws.sides for geom in _solids(of, side)]
    made = []
    for share in (moment / MOMENTS for moment in range(MOMENTS + 1)):
        qpos = [(1 - share) * wide + share * tight for wide, tight in zip(*rests, strict=True)]
        of.engine.write("qpos", qpos)
        of.engine.forward()
        made.append(_Moment(qpos, {geom: at(of.data("geom_xpos"), geom) for geom in geoms}))
    return made


def _pairs(of: Simulation, jaws: Jaws, closing: list[_Moment]) -> list[tuple[int, int]]:
    """Geoms of the two jaws, those first that come nearest to each other."""
    pairs = [(one, other) for one in _solids(of, jaws.sides[0]) for other in _solids(of, jaws.sides[1])]
    return sorted(pairs, key=lambda pair: min(norm(_gap(each, pair)) for each in closing))[:PLACES]


def _gap(moment: _Moment, pair: tuple[int, int]) -> Vector:
    return sub(moment.middles[pair[1]], moment.middles[pair[0]])


def _closed(of: Simulation, jaws: Jaws, body: int, end: int, pair: tuple[int, int], closing: list[_Moment]) -> bool:
    """Puts the thing between two geoms at the last moment when there is room for it, and lets the jaws close."""
    half = of.row("geom_aabb", _solids(of, body)[0], 6)[3:]
    wide = 2 * min(half) + sum(min(of.row("geom_aabb", each, 6)[3:]) for each in pair)
    fits = [each for each in closing if norm(_gap(each, pair)) > wide]
    if not fits or len(fits) == len(closing):
        return False
    one, other = (fits[-1].middles[geom] for geom in pair)
    middle = [(x + y) / 2 for x, y in zip(one, other, strict=True)]
    along = unit(_gap(fits[-1], pair))
    thin = tuple(float(i == half.index(min(half))) for i in range(3))
    along = along if dot(along, thin) >= 0 else tuple(-x for x in along)
    turn = unit((1 + dot(thin, along), *cross(thin, along)))
    of.begin()
    of.engine.write("qpos", fits[-1].qpos)
    of.engine.write("qpos", [*middle, *turn], of.place(of.joints_of(body)[0]))
    of.engine.forward()
    hold(of)
    _drive(of, jaws, end)
    for _ in of.run(CLOSING, samples=1):
        pass
    return not of.unstable()


def _held(of: Simulation, jaws: Jaws, body: int) -> tuple[Contact, Contact] | None:
    """Two contacts with which the jaws press on the thing from opposite sides."""
    pressed = pressing(of, of.engine.contacts(), body)
    one, other = ([each[1:] for each in pressed if each[0] == side] for side in jaws.sides)
    return next(((a, b) for a, inwards in one for b, back in other if dot(inwards, back) < OPPOSITE), None)


def pressing(of: Simulation, contacts: Iterable[Contact], body: int) -> list[tuple[int, Contact, Vector]]:
    """All that presses on a body: the other body, the contact, and its normal into the body."""
    made = []
    for contact in contacts:
        sides = _sides(of, contact)
        if body in sides and contact.force > 0:
            sign = 1 if sides[1] == body else -1
            made.append((sum(sides) - body, contact, tuple(sign * x for x in contact.normal)))
    return made


def _sides(of: Simulation, contact: Contact) -> list[int]:
    """The bodies of a contact's two geoms; the world for a flex, which has no geom."""
    return [of.body_of("geom", geom) if geom >= 0 else 0 for geom in contact.geoms]


def _slides(of: Simulation, jaws: Jaws, body: int, weight: Vector) -> float:
    """The speed in m/s of the thing in the palm's frame under its weight alone, over the second half of the time.

    It is infinite where the thing falls, or comes to lie on something else.
    """
    of.engine.write("xfrc_applied", weight, 6 * body)
    seen = []
    for _ in of.run(CARRYING, samples=4):
        apart = sub(at(of.data("xpos"), body), at(of.data("xpos"), jaws.palm))
        seen.append(times(transpose(of.data_row("xmat", jaws.palm, 9)), apart))
    touched = {side for each in of.engine.contacts() for side in _sides(of, each) if body in _sides(of, each)}
    if of.unstable() or _held(of, jaws, body) is None or touched - {body, jaws.palm, *jaws.sides}:
        return math.inf
    return norm(sub(seen[-1], seen[len(seen) // 2 - 1])) / (of.steps(CARRYING) * of.timestep / 2)


def _needed(simulation: Simulation, body: int, palm: int) -> float:
    held = (each for each in grasps(simulation) if (each.body, each.jaws.palm) == (body, palm))
    return max((each.weight / max(each.carries, 1e-9) for each in held), default=0.0)


def needed(grasp: Grasp) -> Probe:
    """The weight of what is held over what the friction of these jaws carries; above 1 it slips."""
    title = "weight over what friction of the closed fingers carries"
    return Probe(title, "", _needed, (grasp.body, grasp.jaws.palm))


@probe("between jaws that closed on it, it slides with", "radii a second")
def leaves(simulation: Simulation, body: int) -> float:
    """How fast a thing slides out of the jaws that closed on it, in its radii a second; infinite where it falls."""
    return max((each.leaves for each in grasps(simulation) if each.body == body), default=0.0)
