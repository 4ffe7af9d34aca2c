"""Which of a pair is the odd one: what outvotes it, and what in it is strange by itself."""

from __future__ import annotations

import math
from collections import Counter

from clinic.diagnosis.probes.attached import attached
from clinic.diagnosis.probes.comparison import Comparison
from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.matter import matter
from clinic.diagnosis.probes.overlap import at_start, of_relatives
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.probes.siblings import FIELDS, LIKE, odd_ones
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.probes.vector import dot, norm, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._edits import COPIED, edits_of
from clinic.diagnosis.simulation import Simulation

INERTIAL = ("mass", "center of mass", "inertia")
TIE = 0.01  # of what is counted


def odd_side(model: ReaderModel, each: Comparison) -> tuple[int, bool]:
    """Which of a pair is the odd one, the left one where nothing tells; and whether something does."""
    simulation, pair = model.simulation, (each.left, each.right)
    for one in odd_ones(simulation, each.kind, 2 * LIKE) if each.kind in FIELDS else ():
        if one.attribute == each.quantity and one.index in pair:
            return one.index, True
    strange = [_strange(model, each, side) for side in pair]
    if abs(strange[0] - strange[1]) < 1e-6 and (overlaps := _overlapping(model, each)):
        return overlaps[0], True
    return each.right if strange[1] > strange[0] else each.left, abs(strange[0] - strange[1]) > 1e-6


def _strange(model: ReaderModel, each: Comparison, side: int) -> float:
    """How far a side is from what else the model has, to be compared with its twin's alone."""
    simulation = model.simulation
    if each.kind == "body" and each.quantity in INERTIAL and inertial(model, each.left) is not None:
        found = matter(simulation, side)
        if each.quantity == "inertia":
            return round(abs(math.log(found.radius)), 1) if found else 0.0
        return round(_centre_off(simulation, side), 3) if each.quantity == "center of mass" else 0.0
    if each.quantity == "axis sign":
        axes = [simulation.row("jnt_axis", joint, 3) for joint in _same_side(simulation, each, side)]
        return -sum(round(dot(axis, simulation.row("jnt_axis", side, 3))) for axis in axes)
    if each.quantity == "gear sign":
        gears = [simulation.gear(index) for index in range(simulation.count("actuator"))]
        return -float(sum(gear * gears[side] > 0 for gear in gears))
    if each.quantity == "ctrlrange" and len({_in_reach(simulation, one) for one in (each.left, each.right)}) > 1:
        return -_in_reach(simulation, side)
    if each.kind == "joint" and each.quantity == "range":
        place, (low, high) = simulation.place(side), simulation.row("jnt_range", side, 2)
        start = simulation.model("qpos0")[place]
        if not low - 0.01 <= start <= high + 0.01:
            return 1e6
        reach = [_reach_apart(simulation, one) for one in (each.left, each.right)]
        if min(reach) < TIE < max(reach) < math.inf:
            return reach[side == each.right]
    if each.quantity in ("joint", "target"):
        to = attached(simulation, each.kind, side)
        names = simulation.names(each.kind)[side], simulation.names(to[0])[to[1]] if to else ""
        return len(set(_pieces(names[0])) ^ set(_pieces(names[1])))
    alike = (one for one in twins(simulation).comparisons if (one.kind, one.quantity) == (each.kind, each.quantity))
    both = [index for one in alike for index in (one.left, one.right)]
    values = Counter(_value(model, each, index) for index in both)
    if each.quantity == "pos" and each.kind == "body":
        signed = Counter(_signed(simulation, index) for index in both)
        agree = _beside_its_own(simulation, each, side)
        return -values[_value(model, each, side)] - TIE * (signed[_signed(simulation, side)] + TIE * agree)
    if each.quantity == "pos" and each.kind == "site":  # on the side of its body where what hangs on that is not
        simulation.as_written()
        mass = simulation.data_row("subtree_com", simulation.body_of("site", side), 3)
        return -values[_value(model, each, side)] + TIE * round(
            norm(sub(mass, simulation.data_row("site_xpos", side, 3))), 3
        )
    if each.quantity in ("gear", "gain"):
        others = sorted(size for index in both if index not in (each.left, each.right)
                        and (size := _strength(simulation, index)))  # fmt: skip
        own = _strength(simulation, side)
        if others and own:
            return -values[_value(model, each, side)] + TIE * round(abs(math.log10(own / others[len(others) // 2])))
    return -values[_value(model, each, side)]


def _overlapping(model: ReaderModel, each: Comparison) -> list[int]:
    """The one side that overlaps at the start with something, and does not as its twin's image; none where both do."""
    if each.quantity not in ("pos", "size"):
        return []
    for probe, most in ((of_relatives(), 0.1), (at_start(), 0.05)):
        ends = [side for side in (each.left, each.right)
                if (edits := edits_of(model, each, side)) and model.measured(probe, edits) <= most]  # fmt: skip
        if model.measured(probe) > most and len(ends) == 1:
            return ends
    return []


def _beside_its_own(simulation: Simulation, each: Comparison, side: int) -> int:
    """How often a body is on the side of its parent where the others of its side are, less how often it is not."""
    own, made = simulation.row("body_pos", side, 3), 0
    for one in twins(simulation).comparisons:
        placed = not one.odd and (one.kind, one.quantity) == ("body", "pos")
        if not placed or not simulation.parent(one.left) == simulation.parent(one.right) == simulation.parent(side):
            continue
        mine, other = (one.left, one.right) if side == each.left else (one.right, one.left)
        places = zip(own, simulation.row("body_pos", mine, 3), simulation.row("body_pos", other, 3), strict=True)
        made += sum((a * b > 0) - (a * b < 0) for a, b, c in places if b and b == -c)
    return made


def _signed(simulation: Simulation, body: int) -> tuple[float, ...]:
    return tuple(round(x, 6) + 0.0 for x in simulation.row("body_pos", body, 3))


def _strength(simulation: Simulation, actuator: int) -> float:
    """What an actuator gives at a control of 1."""
    return abs(simulation.gain(actuator)[0] * simulation.gear(actuator))


def _value(model: ReaderModel, each: Comparison, index: int) -> tuple[object, ...]:
    """What is written for the quantity, without signs."""
    texts = [model.value(each.kind, index, name) or "" for name in COPIED.get(each.quantity, (each.quantity,))]
    try:
        return tuple(sorted(round(abs(float(number)), 6) for text in texts for number in text.split()))
    except ValueError:
        return tuple(texts)


def _same_side(simulation: Simulation, each: Comparison, side: int) -> list[int]:
    """The joints of pairs that are on the same side."""
    return [pair[side == each.right] for pair in twins(simulation).pairs["joint"] if side not in pair]


def _in_reach(simulation: Simulation, actuator: int) -> float:
    """The share of an actuator's control range that is in its joint's range."""
    joint = simulation.driven_joint(actuator)
    if joint is None or joint not in simulation.ranges:
        return 1.0
    low, high = simulation.row("actuator_ctrlrange", actuator, 2)
    bottom, top = simulation.ranges[joint]
    return max(0.0, min(high, top) - max(low, bottom)) / max(high - low, 1e-9)


def _reach_apart(simulation: Simulation, joint: int) -> float:
    """How far the targets of a joint's one servo are from its range, in parts of it; infinity without one."""
    low, high = simulation.row("jnt_range", joint, 2)
    own = [each.targets for each in servos(simulation) if each.joint == joint and each.targets]
    if len(own) != 1 or high <= low:
        return math.inf
    return max(abs(own[0][0] - low), abs(own[0][1] - high)) / (high - low)


def _pieces(name: str) -> list[str]:
    return name.lower().replace("-", "_").replace("/", "_").split("_")


def _centre_off(simulation: Simulation, body: int) -> float:
    """How far the centre of mass is from the middle of the body's geoms, in m."""
    places = [simulation.row("geom_pos", geom, 3) for geom in simulation.geoms_of(body)]
    if not places:
        return 0.0
    middle = tuple(sum(each) / len(places) for each in zip(*places, strict=True))
    off = sub(simulation.row("body_ipos", body, 3), middle)
    return norm(off)
