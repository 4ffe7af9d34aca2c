"""One of several that are called alike but for a number or a finger, and differs from all others."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.siblings import FIELDS, LIKE, SOME, Odd, odd_ones, swapped, unlike
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._edits import COPIED, copied
from clinic.diagnosis.rules.twins._pair import SWAPPED, odd
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Suspect


def siblings(model: ReaderModel, kind: str, attributes: Collection[str] = ()) -> Iterator[Suspect]:
    """One of three or more that are alike but for a number or a finger in their names, where its twin tells nothing."""
    of = model.simulation
    told = [each for found, _ in odd(model, (kind,), (*FIELDS[kind], "gear sign")) for each in found]
    paired = {(each.quantity.removesuffix(" sign"), side) for each in told for side in (each.left, each.right)}
    found = [
        each
        for each in odd_ones(of, kind, 2 * LIKE)
        if each.attribute in (attributes or FIELDS[kind])
        and (each.attribute, each.index) not in paired
        and (each.clear or (each.little and len(each.siblings) >= 3 and each.unlike > SOME) or _swapped(model, each))
    ]
    heavier = {each.index for each in found if each.attribute == "mass"}
    found = [each for each in found if each.attribute != "inertia" or each.index not in heavier]
    if len({each.index for each in found}) > 1:  # two that differ alike, left and right, are meant
        return
    made = [_suspect(model, each) for each in found]
    yield from _of_another_class(model, found, made) or made


def _suspect(model: ReaderModel, each: Odd) -> Suspect:
    """The suspect that gives the odd one what its siblings have."""
    of, names = model.simulation, COPIED.get(each.attribute, (each.attribute,))
    edits = copied(model, each.kind, each.index, each.siblings[0], names)
    if each.attribute == "inertia":
        edits = _moments_of(model, each)
    if edits and not model.measured(unlike(each), edits) <= LIKE:
        edits = ()
    now = next((text for name in names if (text := model.value(each.kind, each.index, name))), "")
    says = f"{_told(of, each)} agree in their {each.attribute}, and it differs by {each.unlike:.3g} %."
    value, digits = edits[0].value if edits else "that of its siblings", _swapped(model, each)
    level: Level = "cause" if edits and (each.clear or digits) and not _none(of, each) else "hint"
    elements, says = (of.name(each.kind, each.index),), says + SWAPPED * digits
    return Suspect(elements, each.attribute, now, value, edits, unlike(each), LIKE, says, "siblings alike", level=level)


def _of_another_class(model: ReaderModel, found: Sequence[Odd], made: Sequence[Suspect]) -> list[Suspect]:
    """The one suspect in the place of all, where the siblings share a class that mends the odd one; else none."""
    if not found:
        return []
    first, (kind, index) = found[0], (found[0].kind, found[0].index)
    element, *others = (model.element(kind, each) for each in (index, *first.siblings))
    shared = {each.get("class") if each is not None else "" for each in others}
    if element is None or len(shared) > 1 or not all(shared) or element.get("class") in shared:
        return []
    edits, now = (set_attribute(element, "class", shared.pop()),), element.get("class")
    if not all(model.measured(each.probe, edits) <= each.limit for each in made):
        return []
    quantities, value = " and ".join(each.attribute for each in found), edits[0].value
    says = f"{_told(model.simulation, first)} are of class {value!r} and agree in their {quantities}; it differs by "
    says += f"{max(each.unlike for each in found):.3g} %."
    return [replace(made[0], attribute="class", now=now, value=value, edits=edits, says=says)]


def _told(of: Simulation, each: Odd) -> str:
    return ", ".join(of.name(each.kind, other) for other in each.siblings[:3])


def _moments_of(model: ReaderModel, each: Odd) -> tuple[Edit, ...]:
    """The edit that gives a body the moments of its sibling, where both are written alike."""
    bodies = [model.element("body", body) for body in (each.index, each.siblings[0])]
    own, other = (body.first("inertial") if body is not None else None for body in bodies)
    if own is None or other is None or not other.get("diaginertia") or "diaginertia" not in own.attributes:
        return ()
    return (set_attribute(own, "diaginertia", other.get("diaginertia")),)


def _swapped(model: ReaderModel, each: Odd) -> bool:
    """Whether a number of the odd one has the digits of its sibling's in another order."""
    texts = [model.value(each.kind, index, each.attribute) or "" for index in (each.index, each.siblings[0])]
    return swapped(*texts)


def _none(of: Simulation, each: Odd) -> bool:
    """Whether the one or the others have none of it."""
    return each.unlike >= 99.9 and each.attribute in ("damping", "armature", "frictionloss", "stiffness")
