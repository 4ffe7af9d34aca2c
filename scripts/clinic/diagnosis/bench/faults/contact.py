"""Contacts, and what is around the model: gravity, the solver."""

from __future__ import annotations

from random import Random

from clinic.diagnosis.bench.faults import Fault, between, kind, pick, text_of
from clinic.diagnosis.edit import delete, set_attribute
from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.shape import falling, root_of, solid
from clinic.diagnosis.reader_model import ReaderModel

MOVES = ("strays", "sinks", "faster", "unstable")


def _colliding(model: ReaderModel) -> list[int]:
    return [geom for geom in range(model.simulation.count("geom")) if solid(model.simulation, geom)]


def _rests(model: ReaderModel) -> bool:
    """Whether something that can fall lies or stands on something after a second."""
    simulation = model.simulation
    owner, falls, bodies = root_of(simulation), falling(simulation), simulation.model("geom_bodyid")
    simulation.begin()
    for _ in simulation.run(1.0, samples=2):
        pass
    touching = [each for each in simulation.engine.contacts() if each.force > 0 and min(each.geoms) >= 0]
    trees = [{owner[int(bodies[geom])] for geom in each.geoms} for each in touching]
    return any(len(each) == 2 and each & set(falls) for each in trees)


def _of_all(model: ReaderModel, geoms: list[int], strength: float, **values: str) -> Fault | None:
    """Attributes of geoms set to the same value where something rests, in a default class where it is theirs alone."""
    edits = [edit for name, value in values.items() for edit in model.set("geom", geoms, name, value)]
    if not geoms or not edits or not _rests(model):
        return None
    names = tuple(model.simulation.name("geom", i) for i in geoms)
    return Fault(tuple(edits), names, next(iter(values)), strength)


@kind("condim-1", harms=MOVES)
def condim_1(model: ReaderModel, random: Random) -> Fault | None:
    """No friction between any two geoms: condim 1."""
    return _of_all(model, _colliding(model), 1, condim="1")


@kind("friction-too-low", harms=MOVES)
def friction_lost(model: ReaderModel, random: Random) -> Fault | None:
    """Friction of all geoms next to nothing."""
    value = between(random, 1e-4, 0.05)
    return _of_all(model, _colliding(model), value, friction=text_of(value, 0.005, 0.0001))


@kind("friction-too-low", harms=MOVES)
def priority_of_a_slippery_floor(model: ReaderModel, random: Random) -> Fault | None:
    """The floor has the last word on friction, and is slippery."""
    floors = [i for i in _colliding(model) if model.simulation.model("geom_type")[i] == PLANE]
    value = between(random, 1e-3, 0.1)
    return _of_all(model, floors[:1], value, friction=text_of(value, 0.005, 0.0001), priority="1")


@kind("friction-too-high", harms=MOVES)
def friction_huge(model: ReaderModel, random: Random) -> Fault | None:
    """Friction of all geoms far beyond what the pyramidal cone can bear."""
    value = between(random, 4, 500)
    return _of_all(model, _colliding(model), value, friction=text_of(value, 0.005, 0.0001))


@kind("masks", harms=MOVES)
def masks_of_the_floor(model: ReaderModel, random: Random) -> Fault | None:
    """The floor collides with nothing that stands on it."""
    floors = [i for i in _colliding(model) if model.simulation.model("geom_type")[i] == PLANE]
    bit = str(2 ** random.randrange(3, 20))
    return _of_all(model, floors[:1], 1, contype=bit, conaffinity=bit)


@kind("masks", "twin-place-differs", harms=MOVES)
def masks_of_a_body(model: ReaderModel, random: Random) -> Fault | None:
    """The geoms of one moving body collide with nothing."""
    simulation, colliding = model.simulation, set(_colliding(model))
    bodies = [b for b in simulation.moving_bodies if colliding.intersection(simulation.geoms_of(b))]
    geoms = sorted(colliding.intersection(simulation.geoms_of(pick(random, bodies))))
    return _of_all(model, geoms, len(geoms), contype="0", conaffinity="0")


@kind("soft-contact", harms=MOVES)
def contacts_soft(model: ReaderModel, random: Random) -> Fault | None:
    """The contacts of all geoms give way slowly: a long time constant."""
    value = between(random, 0.05, 2)
    return _of_all(model, _colliding(model), value, solref=text_of(value, 1))


@kind("soft-contact", harms=MOVES)
def contacts_weak(model: ReaderModel, random: Random) -> Fault | None:
    """The contacts of all geoms have hardly any impedance."""
    value = between(random, 0.001, 0.3)
    return _of_all(model, _colliding(model), value, solimp=text_of(value, value, 0.001))


@kind("margin", harms=MOVES)
def margin_large(model: ReaderModel, random: Random) -> Fault | None:
    """Contacts push before anything touches: a margin of a part of the model's size."""
    value = model.simulation.extent * between(random, 0.005, 0.3)
    return _of_all(model, _colliding(model), value, margin=text_of(value))


@kind("overlap-at-start", harms=("jumps", *MOVES))
def start_in_the_floor(model: ReaderModel, random: Random) -> Fault | None:
    """A free body begins lower by a part of the model's size."""
    free = [b for b in model.simulation.free_bodies if model.element("body", b) is not None]
    body = pick(random, free)
    x, y, z = model.simulation.row("body_pos", body, 3)
    depth = model.simulation.extent * between(random, 0.01, 1)
    place = model.element("body", body)
    assert place is not None
    edit = set_attribute(place, "pos", text_of(x, y, z - depth))
    names = [model.simulation.name("geom", i) for i in model.simulation.geoms_of(body)]
    return Fault((edit,), (model.simulation.name("body", body), *names), "pos", depth)


@kind("overlap-of-relatives", "overlap-at-start", harms=("jumps", "reaches", *MOVES))
def exclude_removed(model: ReaderModel, random: Random) -> Fault | None:
    """Two bodies that may not collide with each other collide: their `<exclude>` is gone."""
    assert model.source is not None
    there = [each for each in model.source.section("contact") if each.tag == "exclude"]
    gone = pick(random, there)
    return Fault((delete(gone),), (f'body "{gone.get("body1")}"', f'body "{gone.get("body2")}"'), "")


@kind("springy-contact", harms=MOVES)
def contacts_springy(model: ReaderModel, random: Random) -> Fault | None:
    """The contacts of all geoms by stiffness and damping: 3 to 3,000 times as stiff as the timestep bears."""
    stiffness = between(random, 3, 3000) / model.simulation.timestep**2
    damping = between(random, 0.001, 0.3) * 2 * stiffness**0.5
    return _of_all(model, _colliding(model), stiffness, solref=text_of(-stiffness, -damping))


@kind("gravity", harms=MOVES)
def gravity_wrong(model: ReaderModel, random: Random) -> Fault | None:
    """Gravity of the other sign, along another axis, in millimetres, or none."""
    g = model.simulation.model("opt.gravity")
    size = max(map(abs, g))
    if not size:
        return None
    choices = [(0, 0, size), (0, 0, 0), (size, 0, 0), (0, -size, 0), (0, 0, -1000 * size), (0, 0, -size / 1000)]
    return Fault(model.option("gravity", text_of(*random.choice(choices))), (), "gravity")


@kind("contact-disabled", harms=MOVES)
def contact_disabled(model: ReaderModel, random: Random) -> Fault | None:
    """Contacts are switched off."""
    return Fault(model.add("option", '<flag contact="disable"/>'), (), "contact")


@kind("switched-off", harms=("commands", "reaches", *MOVES))
def flag_disabled(model: ReaderModel, random: Random) -> Fault | None:
    """Actuators, limits or equality constraints are switched off."""
    flag = random.choice(("actuation", "limit", "equality"))
    return Fault(model.add("option", f'<flag {flag}="disable"/>'), (), flag)


@kind("solver-iterations", harms=MOVES)
def few_iterations(model: ReaderModel, random: Random) -> Fault | None:
    """The solver stops after one or two iterations."""
    count = random.choice((1, 2))
    return Fault(model.option("iterations", str(count)), (), "iterations", count)


@kind("fluid", harms=MOVES)
def fluid_thick(model: ReaderModel, random: Random) -> Fault | None:
    """The air in which something can fall is as dense as water, or as viscous as honey."""
    name, low, high = random.choice((("density", 10.0, 1e4), ("viscosity", 0.1, 100.0)))
    value = between(random, low, high)
    return Fault(model.option(name, text_of(value)), (), name, value) if falling(model.simulation) else None


@kind("timestep-too-long", harms=("unstable", "faster", "sinks"))
def timestep_long(model: ReaderModel, random: Random) -> Fault | None:
    """A timestep 2 to 50 times as long."""
    factor = between(random, 2, 50)
    return Fault(model.option("timestep", text_of(model.simulation.timestep * factor)), (), "timestep", factor)
