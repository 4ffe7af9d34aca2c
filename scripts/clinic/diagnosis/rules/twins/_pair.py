"""What is odd about the pairs of a model: the comparisons that stand out, and the edit that makes a pair alike."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.comparison import Comparison
from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.siblings import FIELDS, SOME, odd_ones, swapped
from clinic.diagnosis.probes.twins import Twins, twins
from clinic.diagnosis.probes.vector import dot, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._edits import COPIED, edits_of
from clinic.diagnosis.rules.twins._side import INERTIAL, odd_side
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Probe, Suspect

ODD_SHARE = 0.12  # of all comparisons: more of them, and the model is not meant to be its own mirror image
FEW = 0.2  # of the comparisons of one quantity
SWAPPED = " It has the same digits in another order."
EITHER = " Nothing here tells which of the two is wrong."
TURNED = " The numbers are the same, and the axes are not each other's image as those of the other pairs are."
PLACES = ("axis", "axis sign", "pos", "quat", "center of mass", "direction")
PARTS = ("geom", "site", "camera")
COMPILED = {
    ("body", "pos"): ("body_pos", 3),
    ("body", "mass"): ("body_mass", 1),
    ("body", "center of mass"): ("body_ipos", 3),
    ("joint", "axis"): ("jnt_axis", 3),
    ("joint", "range"): ("jnt_range", 2),
}
ALONG = 0.9  # cosine of the angle between axes that count as one direction
SAME = 1e-6  # m
FAR = 4.0  # times the limit
ENOUGH = 12  # comparisons that make a model one of pairs


def odd(model: ReaderModel, kinds: Sequence[str], quantities: Sequence[str]) -> Iterator[tuple[list[Comparison], bool]]:
    """Comparisons of a model of pairs that stand out, those of equal pairs together; and whether they do so clearly."""
    found = twins(model.simulation)
    groups: dict[int, list[Comparison]] = {}
    for each in found.comparisons:
        groups.setdefault(found.group(each), []).append(each)
    trusted = [each for group, some in groups.items() if found.trusted(group, some) for each in some]
    if len(trusted) < ENOUGH or sum(each.odd for each in trusted) > max(2, ODD_SHARE * len(trusted)):
        return
    told: dict[tuple[object, ...], tuple[list[Comparison], bool]] = {}
    for kind in kinds:
        for quantity in quantities:
            like = {quantity, "stiffness"} if quantity == "type" else {quantity}  # compared where types are alike
            same = [each for each in trusted if each.kind == kind and each.quantity in like]
            few = [
                each
                for each in same
                if each.odd and each.quantity == quantity and not (kind == "body" and _of_geoms(model, found, each))
            ]
            agree = len(same) - len(few)
            close = sum(each.unlike <= each.limit / 5 for each in same)
            most = max(1, FEW * len(same), 2 if agree >= 3 else 0)
            bodies = {found.bodies(each) for each in few}
            alone = len(trusted) >= 30 and not any(each.odd and found.bodies(each) not in bodies for each in trusted)
            far = alone and len(few) == 1 and few[0].unlike > FAR * few[0].limit
            far = far and kind in PARTS and not (quantity == "pos" and _same_part(model.simulation, few[0]))
            known = agree >= (2 if not far else kind != "camera") or quantity in ("joint", "target")
            known = known or (len(few) == 1 and _only(found, trusted, few[0]))
            known = known or (far and quantity == "pos" and _sign_apart(model.simulation, few[0]))
            if not few or len(few) > most or not known or close < 0.6 * agree:
                continue
            enough = 6 if kind in ("geom", "site", "camera") and quantity in ("pos", "quat") else 3
            clear = (
                agree >= (2 if alone and len(few) == 1 and enough == 3 else enough)
                and len(few) <= 3
                and all(each.unlike > each.clear for each in few)
            )
            if clear or far or (kind in ("body", "joint", "actuator", "sensor") and len(few) <= 2):
                pairs = tuple((each.left, each.right) for each in few)
                before, was_clear = told.get((kind, *pairs), ([], False))
                told[kind, *pairs] = ([*before, *few], clear or was_clear)
    yield from told.values()


def _axis_turned(model: ReaderModel, each: Comparison) -> bool:
    """Whether a range differs because an axis points the other way: the same numbers, as in the pairs that agree."""
    of, found = model.simulation, twins(model.simulation)
    if (each.kind, each.quantity) != ("joint", "range"):
        return False
    axis = found.at("xaxis", each.left)
    others = [
        one
        for one in found.comparisons
        if (one.kind, one.quantity, one.odd) == ("joint", "range", False)
        and abs(dot(axis, found.at("xaxis", one.left))) > ALONG
    ]
    same = [of.row("jnt_range", one.left, 2) == of.row("jnt_range", one.right, 2) for one in (each, *others)]
    signs = [found.interval_sign(one) for one in others]
    return all(same) and len(others) > 1 and found.interval_sign(each) < 0 < min(signs, default=-1)


def _same_part(of: Simulation, each: Comparison) -> bool:
    """Whether both sides have the very numbers: the same part, mounted on both."""
    if each.kind == "camera":
        return False
    return of.row(f"{each.kind}_pos", each.left, 3) == of.row(f"{each.kind}_pos", each.right, 3)


def _sign_apart(of: Simulation, each: Comparison) -> bool:
    """Whether the numbers of both sides are the same but for signs: no other pair of the kind need agree."""
    field = {"camera": "cam"}.get(each.kind, each.kind)
    places = (of.row(f"{field}_pos", one, 3) for one in (each.left, each.right))
    return all(abs(abs(a) - abs(b)) < SAME for a, b in zip(*places, strict=True))


def _only(found: Twins, trusted: Sequence[Comparison], odd: Comparison) -> bool:
    """Whether it is the one difference of a pair that is alike in all else, such as two fingers."""
    group, placed = found.group(odd), odd.quantity in PLACES
    if (odd.kind, odd.quantity) == ("body", "pos") and found.displaced(odd.left):
        placed = False
    beside = [each for each in trusted if found.group(each) == group and each is not odd]
    return not placed and len(beside) >= ENOUGH and all(each.unlike <= each.limit / 5 for each in beside)


def suspect(model: ReaderModel, found: Sequence[Comparison], clear: bool) -> Suspect:
    """The suspect that makes the pairs alike; a hint where it stands out little or no edit does it."""
    first, simulation = found[0], model.simulation
    alone = [each for each in found if each.quantity == first.quantity]
    judged = [odd_side(model, each) for each in found]
    sides, sure = [side for side, _ in judged], all(sure for _, sure in judged)
    probe = Probe(
        f"{first.quantity} of {first.kind} and twin, unlike by",
        first.unit,
        _unlike,
        tuple((each.kind, each.quantity, each.left, each.right) for each in alone),
        dynamic=False,
    )
    limit = max(each.limit for each in alone)
    edits = _together(edit for each, side in zip(found, sides, strict=True) for edit in edits_of(model, each, side))
    if any(each.quantity == "axis sign" for each in found):  # the axis turned, a range that differs is mirrored too
        turned_axes = [(each, side) for each, side in zip(found, sides, strict=True) if each.quantity == "axis sign"]
        edits = _together(edit for each, side in turned_axes for edit in edits_of(model, each, side))
    turned = len(alone) == len(found) == 1 and _axis_turned(model, first)
    edits = model.turned_axis(sides[0]) if turned else edits
    digits = len(alone) == 1 and swapped(
        *(model.value(first.kind, side, first.quantity) or "" for side in (first.left, first.right))
    )
    clear = (clear or digits or _outvoted(model, first, sides[0])) and not (_absent(model, found) or _led(model, first))
    if edits and not model.measured(probe, edits) <= limit:
        edits = ()
    level: Level = "cause" if clear and edits else "hint"
    if not sure and not (level == "cause" and first.quantity in INERTIAL and not _copied(simulation, first)):
        edits, level = (), "hint"  # the one that an edit would spoil may be the healthy one
    names = [simulation.name(first.kind, side) for side in sides]
    others = [
        simulation.name(first.kind, each.left + each.right - side) for each, side in zip(found, sides, strict=True)
    ]
    attribute = "axis" if turned else first.quantity
    says = _differs(simulation, found, others[0]) + SWAPPED * digits + TURNED * turned
    now = _told(model, first.kind, sides[0], attribute)
    says += "" if sure else EITHER + _both(model, first, attribute)
    if edits and first.quantity == "target":
        attribute = edits[0].attribute
        now = _told(model, first.kind, sides[0], attribute)
    return Suspect(
        tuple(dict.fromkeys(names if sure else names + others)),
        attribute,
        now,
        edits[0].value if edits else f"that of {others[0]}" if sure else "",
        edits,
        probe,
        limit,
        says,
        f"at most {limit:.3g} {first.unit}: of the models of 14 robots all but a few pairs agree to less",
        level=level,
    )


def _differs(of: Simulation, found: Sequence[Comparison], other: str) -> str:
    """The sentence on what differs from the twin, and how many pairs agree in that."""
    first, quantities = found[0], " and ".join(dict.fromkeys(each.quantity for each in found))
    like = (first.kind, "stiffness" if first.quantity == "type" else first.quantity)
    alike = sum(
        (each.kind, each.quantity) == like and not (each.odd and like[1] == first.quantity)
        for each in twins(of).comparisons
    )
    says = f"It differs from its twin, {other}" + f", in a model where {alike} other pairs agree" * (alike > 0)
    return says + (f" in their {quantities}." if alike else f", in its {quantities}.")


def _copied(of: Simulation, each: Comparison) -> bool:
    """Whether both sides have the same numbers for mass, centre of mass and inertia: one part, mounted on both."""
    fields = {"body_mass": 1, "body_ipos": 3, "body_inertia": 3}
    return all(of.row(field, each.left, width) == of.row(field, each.right, width) for field, width in fields.items())


def _led(model: ReaderModel, each: Comparison) -> bool:
    """Whether the range is of a pair of which one joint is driven, so that the other is led."""
    of = model.simulation
    driven = of.drivers
    return each.quantity == "range" and each.kind == "joint" and (each.left in driven) != (each.right in driven)


def _outvoted(model: ReaderModel, each: Comparison, side: int) -> bool:
    """Whether the side differs clearly from three or more that agree, its twin among them."""
    ones = odd_ones(model.simulation, each.kind, SOME) if each.kind in FIELDS else ()
    return any((one.attribute, one.index) == (each.quantity, side) and one.clear for one in ones)


def _of_geoms(model: ReaderModel, found: Twins, each: Comparison) -> bool:
    """Whether a body's mass differs because its geoms do, which is told of them."""
    if each.quantity in ("pos", "gravcomp") or inertial(model, each.left) is not None:
        return False
    pair = found.bodies(each)
    return any(other.odd and other.kind == "geom" and found.bodies(other) == pair for other in found.comparisons)


def _together(edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """The edits without those of what another one writes anew."""
    made = {(each.file, each.start, each.action, each.attribute): each for each in edits}
    return tuple(made.values())


def _absent(model: ReaderModel, found: Sequence[Comparison]) -> bool:
    """Whether one side has none of it, as where a default was left in force: that may be meant."""
    fields = {"stiffness": "jnt_stiffness"} | {name: f"dof_{name}" for name in ("damping", "armature", "frictionloss")}
    field = fields.get(found[0].quantity)
    if field is None:
        return False
    of = model.simulation
    index = (lambda joint: joint) if field.startswith("jnt") else of.dof
    return any(of.model(field)[index(joint)] == 0 for each in found for joint in (each.left, each.right))


def _unlike(simulation: Simulation, *pairs: tuple[str, str, int, int]) -> float:
    found = twins(simulation).comparisons
    return max(
        (each.unlike for each in found if (each.kind, each.quantity, each.left, each.right) in pairs), default=0.0
    )


def _both(model: ReaderModel, each: Comparison, attribute: str) -> str:
    """The values of both sides, as they are written, or in the compiled model."""
    field, width = COMPILED.get((each.kind, attribute), ("", 0))
    of, values = model.simulation, []
    for side in (each.left, each.right):
        compiled = written(of.row(field, side, width)) if field else ""
        values.append(_told(model, each.kind, side, attribute) or compiled or "none")
    names = [of.name(each.kind, side) for side in (each.left, each.right)]
    if values[0] == values[1]:
        return f" Both have {values[0]}." * (values[0] != "none")
    return f" {names[0]} has {values[0]}, {names[1]} {values[1]}."


def _told(model: ReaderModel, kind: str, side: int, attribute: str) -> str:
    names = COPIED.get(attribute, (attribute,))
    return next((text for name in names if (text := model.value(kind, side, name))), "")
