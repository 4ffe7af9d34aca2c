"""One of two that are mirror images, or one of several alike, gets another number."""

from __future__ import annotations

import re
from random import Random

from clinic.diagnosis.bench.faults import Fault, between, kind, numbers, pick, text_of, written
from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel

SIDES = (("left", "right"), ("Left", "Right"), ("LEFT", "RIGHT"), ("l", "r"), ("L", "R"))
TWINS = ("twin-joint-differs", "twin-inertia-differs", "twin-place-differs", "twin-actuator-differs")
FELT = ("strays", "reaches", "commands", "accelerates", "weighs", "misses", "jumps", "unstable", "faster")


def _pairs(model: ReaderModel, of: str, attribute: str) -> list[tuple[int, int]]:
    """Pairs whose names differ by their side alone, on mirrored bodies; the first has a value for the attribute."""
    names = {name: i for i, name in enumerate(model.simulation.names(of)) if name}
    made = []
    for name, i in names.items():
        for one, other in SIDES:
            if (mirrored := re.sub(rf"(?<![A-Za-z0-9]){one}(?![a-z0-9])", other, name)) != name and mirrored in names:
                made.append((i, names[mirrored]))
    kept = set(written(model, of, attribute))
    return [(i, k) for i, k in made if i in kept and model.element(of, k) is not None and _mirrored(model, of, i, k)]


def _mirrored(model: ReaderModel, of: str, i: int, k: int) -> bool:
    """Whether the bodies of two elements, or what carries them, hang from one body at places that are mirror images."""
    one, other = (_body(model, of, each) for each in (i, k))
    parents = model.simulation.model("body_parentid")
    while one and other and parents[one] != parents[other]:
        one, other = int(parents[one]), int(parents[other])
    places = [model.simulation.row("body_pos", each, 3) for each in (one, other)]
    alike = all(abs(abs(a) - abs(b)) < 1e-6 for a, b in zip(*places, strict=True))
    return one != other and alike and places[0] != places[1]


def _body(model: ReaderModel, of: str, i: int) -> int:
    """The body of an element; for an actuator that of its joint."""
    if of == "actuator":
        joint = model.simulation.driven_joint(i)
        return _body(model, "joint", joint) if joint is not None else 0
    owner = {"joint": "jnt_bodyid", "geom": "geom_bodyid"}.get(of)
    return int(model.simulation.model(owner)[i]) if owner else i


def _changed(
    model: ReaderModel, random: Random, of: str, attribute: str, change: list[float] | None, at: int | None = None
) -> Fault | None:
    """An attribute of one of a pair with its numbers times factors; `at` picks one of them."""
    pairs = _pairs(model, of, attribute)
    if not pairs:
        return None
    pair = random.choice(pairs)
    i = random.choice(pair)
    found = numbers(model.value(of, i, attribute))
    element = model.element(of, i)
    if not found or element is None or not any(found):
        return None
    factor = random.choice(change) if change else between(random, 1.3, 10) ** random.choice((-1, 1))
    new = [factor * each if at is None or k == at else each for k, each in enumerate(found)]
    if text_of(*new) == text_of(*found):
        return None
    names = tuple(model.simulation.name(of, each) for each in pair)
    if of == "geom":
        names += tuple(model.simulation.name("body", model.simulation.body_of("geom", each)) for each in pair)
    if of == "actuator":
        joints = [model.simulation.driven_joint(each) for each in pair]
        names += tuple(model.simulation.name("joint", each) for each in joints if each is not None)
    return Fault((set_attribute(element, attribute, text_of(*new)),), names, attribute, factor)


@kind("twin-joint-differs", *TWINS, harms=FELT)
def twin_axis(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of joints turns the other way."""
    return _changed(model, random, "joint", "axis", [-1.0])


@kind("twin-joint-differs", *TWINS, harms=FELT)
def twin_range(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of joints with its range mirrored, or another."""
    pairs = _pairs(model, "joint", "range")
    pair = pick(random, pairs)
    i = random.choice(pair)
    low, high = numbers(model.value("joint", i, "range"))[:2]
    element = model.element("joint", i)
    assert element is not None
    factor = between(random, 0.1, 0.8)
    new = random.choice(((-high, -low), (low * factor, high * factor), (low, high * factor)))
    names = tuple(model.simulation.name("joint", each) for each in pair)
    return Fault((set_attribute(element, "range", text_of(*new)),), names, "range", factor)


@kind("twin-joint-differs", *TWINS, harms=FELT)
def twin_damping(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of joints with 0.1 to 10 times its damping, stiffness, armature or dry friction."""
    attributes = ["damping", "stiffness", "armature", "frictionloss"]
    random.shuffle(attributes)
    made = (_changed(model, random, "joint", attribute, None) for attribute in attributes)
    return next((each for each in made if each), None)


@kind("twin-actuator-differs", *TWINS, harms=FELT)
def twin_gear(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of actuators with another gear, of the other sign too."""
    return _changed(model, random, "actuator", "gear", [-1.0, 0.1, 0.5, 2.0, 10.0])


@kind("twin-actuator-differs", *TWINS, harms=FELT)
def twin_gains(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of actuators with 0.1 to 10 times its gain, force range or control range."""
    attributes = ["kp", "forcerange", "ctrlrange", "kv"]
    random.shuffle(attributes)
    made = (_changed(model, random, "actuator", attribute, None) for attribute in attributes)
    return next((each for each in made if each), None)


@kind("twin-place-differs", *TWINS, harms=FELT)
def twin_position(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of bodies on the other side, or further out."""
    return _changed(model, random, "body", "pos", [-1.0, 0.5, 1.5, 2.0], at=random.randrange(3))


@kind("twin-place-differs", *TWINS, harms=FELT)
def twin_size(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of geoms 0.3 to 3 times its size."""
    return _changed(model, random, "geom", "size", [0.3, 0.5, 1.5, 2.0, 3.0])


@kind("twin-inertia-differs", *TWINS, "inertia-unlike-geoms", harms=FELT)
def twin_mass(model: ReaderModel, random: Random) -> Fault | None:
    """One of a pair of geoms with 0.1 to 10 times its mass."""
    pairs = _pairs(model, "geom", "")
    pair = pick(random, pairs)
    i, factor = random.choice(pair), between(random, 1.3, 10) ** random.choice((-1, 1))
    mass = model.simulation.model("body_mass")[model.simulation.body_of("geom", i)]
    element = model.element("geom", i)
    if element is None or not mass:
        return None
    names = tuple(model.simulation.name("geom", each) for each in pair)
    names += tuple(model.simulation.name("body", model.simulation.body_of("geom", each)) for each in pair)
    return Fault((set_attribute(element, "mass", text_of(mass * factor)),), names, "mass", factor)
