"""Something that moves and collides weighs less than the air in its place.

A density of 1e-5, or a mass in the wrong unit: a small force throws it away, and what is heavy goes through it. A box
of 5 kg stands on a cylinder of 80 g, and sinks through one of 40 g to the floor.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="puck" pos="0 0 0.1">
          <freejoint/>
          <geom type="cylinder" size="0.05 0.05" density="0.00001"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom type="cylinder" size="0.05 0.05" density="0.00001"/>
    +       <geom type="cylinder" size="0.05 0.05" density="500"/>

The number: the mass of the air that its geoms displace (1.2 kg/m3) over its own, for everything that moves together,
and for single links with a joint. More than 300 tells a cause: Gymnasium's second pusher pushes a puck of 120, its
first one of 120,000. A model in centimetres has 10. More than 1, of less than 0.1 kg, under the gravity of metres and
without a fluid, tells a hint: a density of 1.2 in g/cm3 is taken for kg/m3, and a cube has a mass of milligrams. So are
three and more geoms of links with a written density below 1.6, one whose density is the number of a metal in g/cm3
(2.7, 7.8, ...), and a free body below 15: even foam has more.

A geom with a density of its own of less than air has, in a mechanism whose other geoms have a mass, is told to have
that as its mass.

When it is wrong: a balloon. Where all of the model is so, it may be written in mm: another rule tells that.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import inertial, set_inertial
from clinic.diagnosis.probes.matter import matter, volume_of
from clinic.diagnosis.probes.shape import root_of, solid
from clinic.diagnosis.probes.vector import numbers
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.world.lengths_in_another_unit import unit_of_lengths
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, counted

TITLE = "Lighter than air"
FAMILIES = ("falls-through", "explodes", "stuck")

FEATHER = 0.005  # kg/m3
AIR, LIMIT, LIGHT, FEW = 1.2, 300.0, 1.0, 3
SHOVED = 0.1  # kg, below which a body is easily shoved away
METALS = (2.7, 7.8, 7.85, 7.87, 7.9, 8.9, 8.96)  # g/cm3
PLASTIC = AIR / 1.6  # of the densest: an ant of 5 kg/m3 is meant
FOAM = AIR / 15  # of the lightest, over the air in its place
METRES, CENTIMETRES = (5.0, 20.0), 500.0  # m/s2


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Trees of moving bodies that collide and weigh next to nothing."""
    of = model.simulation
    if unit_of_lengths(of) or of.gravity > CENTIMETRES:
        return
    masses = of.model("body_mass")
    in_metres = METRES[0] < of.gravity < METRES[1]
    most = LIGHT if in_metres and not of.model("opt.density")[0] else LIMIT  # in a fluid it may float
    yield from _links(model, most)
    yield from _for_mass(model, most)
    if most == LIGHT:
        yield from _free(model)
    for root, bodies in _groups(of):
        geoms = [geom for body in bodies for geom in of.geoms_of(body)]
        if not any(solid(of, geom) for geom in geoms):
            continue
        probe = Probe("mass of the air in its place over its own", "", _air, tuple(bodies), dynamic=False)
        mass = sum(masses[body] for body in bodies)
        if (times := model.measured(probe)) <= (most if mass < SHOVED else LIMIT):
            continue
        edits = list(model.set("geom", geoms, "density", "500"))
        edits += model.remove("geom", geoms, "mass")
        for body in bodies:
            if inertial(model, body) is not None and (found := matter(of, body)):
                scale = 500 / found.density
                edits += set_inertial(
                    model, body, 500 * found.volume, found.centre, tuple(scale * x for x in found.solid)
                )
        yield Suspect(
            (of.name("body", root),),
            "density",
            "",
            "500",
            tuple(edits),
            probe,
            LIMIT if times > LIMIT else LIGHT,
            f"All that moves with it weighs {mass:.3g} kg: 1 mN accelerates it by {1e-3 / max(mass, 1e-30):.3g} m/s2.",
            "wood has 500 kg/m3, air 1.2",
            level="cause" if times > LIMIT else "hint",
        )


def _groups(of: Simulation) -> list[tuple[int, list[int]]]:
    """What moves together by its root, and a light link or two by themselves, of a tree that is heavy enough."""
    owner, welds, trees, links = root_of(of), of.model("body_weldid"), dict[int, list[int]](), dict[int, list[int]]()
    for body in of.moving_bodies:
        trees.setdefault(owner[body], []).append(body)
        links.setdefault(int(welds[body]), []).append(body)
    light = {body: link for body, link in links.items() if of.joints_of(body) and _air(of, *link) > LIMIT}
    alone = [(body, link) for body, link in light.items() if trees.get(body) != link]
    return [*trees.items(), *(alone if len(light) <= 2 else [])]


def _links(model: ReaderModel, most: float) -> Iterator[Suspect]:
    """The links whose density is written, or that of their class, in g/cm3, where what they hang on is heavier."""
    of = model.simulation
    found: dict[str, list[int]] = {}
    for body in of.moving_bodies if most == LIGHT else ():
        weighed = [geom for geom in of.geoms_of(body) if not model.value("geom", geom, "mass")]
        texts = {model.value("geom", geom, "density") or "" for geom in weighed}
        if len(texts) == 1 and of.joints_of(body) and inertial(model, body) is None:
            found.setdefault(texts.pop(), []).append(body)
    owner = root_of(of)
    for text, bodies in found.items():
        every = [geom for geom in range(of.count("geom")) if model.value("geom", geom, "density") == text]
        moved = [geom for geom in every if of.body_of("geom", geom) in bodies and volume_of(of, geom)]
        density = next(iter(numbers(text)), 0.0)
        metal = density in METALS
        if not metal and (len(moved) < FEW or not FEATHER < density < AIR / PLASTIC):
            continue
        roots = {owner[body] for body in bodies}
        whole = tuple(body for body in of.moving_bodies if owner[body] in roots)
        if _air(of, *whole) > LIGHT or (of.free_bodies and set(bodies) <= set(of.free_bodies)):
            continue  # it is told of the whole, or of each
        value, links = f"{1000 * float(text):g}", f"{len(bodies)} link{'s' * (len(bodies) > 1)}"
        why = "less than foam; in g/cm3 it is that of a metal" if metal else "near that of air; it is one in g/cm3"
        yield Suspect(
            tuple(of.name("body", body) for body in bodies),
            "density",
            text,
            value,
            model.set("geom", every, "density", value),
            counted("geoms that move with a density in g/cm3", len(moved)),
            0.5,
            f"Geoms of {links} have {text} kg/m3, {why}.",
            "wood has 500 kg/m3, air 1.2",
            level="hint",
        )


def _for_mass(model: ReaderModel, most: float) -> Iterator[Suspect]:
    """A geom whose own density is less than that of air, beside others of its mechanism that have a mass."""
    of, owner = model.simulation, root_of(model.simulation)
    bodies = [int(body) for body in of.model("geom_bodyid")]
    weighed = {owner[body] for geom, body in enumerate(bodies) if (model.value("geom", geom, "mass") or "0") != "0"}
    for geom, body in enumerate(bodies if most == LIGHT else ()):
        element = model.element("geom", geom)
        if element is None or owner[body] not in weighed or model.value("geom", geom, "mass"):
            continue
        text, name = element.get("density"), of.name("geom", geom)
        if not text or not FEATHER < float(text) < AIR or inertial(model, body) is not None:
            continue
        edits = (*model.remove("geom", [geom], "density"), *model.set("geom", [geom], "mass", text))
        says = f"Its density of {text} kg/m3 is less than that of air, and other geoms of its mechanism have a mass."
        probe = counted("geoms with a density less than that of air, beside others with a mass", 1)
        now, value = f"density {text}", f"mass {text}"
        yield Suspect((name,), "mass", now, value, edits, probe, 0, says, f"{text} kg", level="hint")


def _free(model: ReaderModel) -> Iterator[Suspect]:
    """The free bodies whose density is written in g/cm3, each, where it makes them heavier than air."""
    of = model.simulation
    for body in of.free_bodies:
        geoms = of.geoms_of(body)
        texts = {model.value("geom", geom, "density") or "" for geom in geoms if solid(of, geom)}
        own = inertial(model, body) is not None or any(model.value("geom", geom, "mass") for geom in geoms)
        if own or len(texts) != 1 or of.below(body) != [body] or not FOAM < _air(of, body) <= LIGHT:
            continue
        text, name = texts.pop(), of.name("body", body)
        if text:
            value = f"{1000 * float(text):g}"
            edits = model.set("geom", geoms, "density", value)
            says = f"{name} has {text} kg/m3, less than foam; in g/cm3 it is that of a solid."
            probe = Probe("mass of the air in its place over its own", "", _air, (body,), dynamic=False)
            yield Suspect((name,), "density", text, value, edits, probe, FOAM, says, "water has 1000", level="hint")


def _air(simulation: Simulation, *bodies: int) -> float:
    found = [each for body in bodies if (each := matter(simulation, body)) is not None]
    return AIR * sum(each.volume for each in found) / max(1e-30, sum(each.mass for each in found))
