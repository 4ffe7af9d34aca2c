"""A moving body has no mass, or no inertia.

MuJoCo refuses a body that a joint moves where neither the body nor what is fixed to it has mass and inertia: `mass and
inertia of moving bodies must be larger than mjMINVAL`. A link that hangs on it by another joint does not count. Empty
frames of a URDF and helper links are the usual ones.

Bad:

    <mujoco>
      <worldbody>
        <body name="wrist" pos="0 0 1">
          <joint name="turn" axis="0 0 1"/>
          <site name="tip" pos="0.1 0 0"/>
        </body>
      </worldbody>
    </mujoco>

Good:

            <joint name="turn" axis="0 0 1"/>
    +       <inertial pos="0 0 0" mass="0.01" diaginertia="1e-5 1e-5 1e-5"/>

The number: mjMINVAL is 1e-15. The edit gives a body without mass 10 g, or, where its inertia is written, what a ball of
50 mm radius with that has, or, in URDF, the link's own box, cylinder or sphere; and a body without inertia that of such
a ball; of moments of which some are 0 these get the mean of the others. A body whose geoms do have mass is too small: a
box of 0.1 mm has an inertia of 2e-18 kg m2; the compiler then gives all bodies the least that it takes, and lengths in
mm are better. Where a mesh has a `scale` below 0.01, it is taken for one that was in metres already: a thousand times
as much is tried first. Where two bodies and more are written alike but for the class or mass of one geom, a wheel among
wheels, it gets theirs.

When it is wrong: the body may not be meant to move: then its joint is too much.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit, delete, insert, remove_attribute, replace, set_attribute
from clinic.diagnosis.probes.inertia import possible
from clinic.diagnosis.probes.vector import numbers, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._ball import mass_of_a_ball, mass_of_its_shape
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.rules.errors._scale import scaled_back
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "A moving body without mass"
FAMILIES = ("will-not-compile",)

WEIGH = ("class", "mass", "density")
UNKNOWN = "0.01"  # kg of a ball without inertia
LEAST, MASS = "1e-13", "1e-9"  # kg m2, kg: what the compiler gives bodies that are too small


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The body that is too light, with a little mass; one that has mass, with the inertia of a ball."""
    if "must be larger than mjMINVAL" not in model.error or model.source is None:
        return
    for element in meant(model, "body", "link")[:1]:
        inertial = element.first("inertial")
        mass = _mass(inertial) if inertial else 0.0
        named, said = f'{element.tag} "{element.get("name")}"', sentence(model)
        yield from _as_others(model, element, f"{named} moves and has no mass: {said}.")
        if inertial is None and _matter(model, element):
            back, now, value = scaled_back(model)
            if back:
                says = f"{named} has geoms, which are too small: {said}. Meshes that are in metres need no scale."
                yield mends(element, back, says, attribute="scale", now=now, value=value)
            says = f"{named} has geoms, which are too small: {said}. In mm and g the model has larger numbers."
            edits = _bounds(model.source.root)
            yield mends(element, edits, says, attribute="boundinertia", now="0", value=LEAST)
        elif inertial is None or mass <= 0:
            says = f"{named} moves and has no mass: {said}."
            own = inertial.first("mass") if inertial and model.urdf else inertial
            if inertial and own and (value := mass_of_a_ball(inertial)) != UNKNOWN:
                own_mass, shape = mass_of_its_shape(inertial) if inertial and model.urdf else ("", "")
                value, shape = own_mass or value, f"its {shape}" if shape else "a ball of 50 mm radius"
                says += f" With {value} kg {shape} has its inertia."
                edits = (set_attribute(own, "value" if model.urdf else "mass", value),)
                yield mends(element, edits, says, attribute="mass", now="0", value=value)
                return
            edits = (*((delete(inertial),) if inertial else ()), insert(element, _inertial(0.01, model.urdf)))
            yield mends(element, edits, says, attribute="mass", now="0", value="0.01")
        elif any(moments := numbers(inertial.get("diaginertia"))) and min(moments) >= 0:
            value = written(possible(moments))
            says = f"{named} moves, and a moment of its inertia is 0: {said}."
            edits = (set_attribute(inertial, "diaginertia", value),)
            yield mends(element, edits, says, attribute="diaginertia", now=written(moments), value=value)
        else:
            says = f"{named} moves and has a mass of {mass:g} kg without inertia: {said}."
            edits = (replace(inertial, _inertial(mass, model.urdf, inertial)),)
            yield mends(element, edits, says, attribute="inertia", now="0", value=f"{_ball(mass):.2g}")


def _as_others(model: ReaderModel, body: Element, says: str) -> Iterator[Suspect]:
    """The geom that gives other bodies, which are written alike, their mass, with their class or their number."""
    assert model.source is not None
    own = [each for each in body.children if each.tag == "geom"]
    like = [each for each in model.source.bodies()[1:] if each is not body and _kin(each) == _kin(body)]
    others = [[each for each in one.children if each.tag == "geom"] for one in like]
    for rank, geom in enumerate(own):
        for name in WEIGH:
            same = [some[rank] for some in others if len(some) == len(own) and _alike(own, some, rank, name)]
            if len(same) > 1 and len(theirs := {each.get(name) for each in same}) == 1 and theirs != {geom.get(name)}:
                (value,) = theirs
                edits = (set_attribute(geom, name, value) if value else remove_attribute(geom, name),)
                told = f"{says} {len(same)} bodies are written alike but for this {name}."
                now, value = geom.get(name) or "left out", value or "left out"
                yield mends(geom, edits, told, attribute=name, now=now, value=value)


def _alike(own: Sequence[Element], some: Sequence[Element], rank: int, name: str) -> bool:
    """Whether the geoms of two bodies agree in all that weighs, but for an attribute of one of them."""
    pairs = [(at, each) for at in range(len(own)) for each in (*WEIGH, "type") if (at, each) != (rank, name)]
    return all(own[at].get(each) == some[at].get(each) for at, each in pairs)


def _kin(body: Element) -> list[tuple[str, str, str]]:
    found = [each for each in body.children if each.tag in ("joint", "freejoint", "inertial", "body")]
    return [(each.tag, each.get("class"), each.get("type")) for each in found]


def _bounds(root: Element) -> tuple[Edit, ...]:
    """The least mass and inertia of all bodies, told to the compiler."""
    there = [child for child in root.children if child.tag == "compiler"]
    if there:
        return set_attribute(there[-1], "boundinertia", LEAST), set_attribute(there[-1], "boundmass", MASS)
    return (insert(root, f'<compiler boundinertia="{LEAST}" boundmass="{MASS}"/>'),)


def _matter(model: ReaderModel, body: Element) -> bool:
    """Whether a body of MJCF has a geom that nobody made massless."""
    if model.source is None or model.urdf:
        return False
    geoms = [each for each in body.children if each.tag == "geom"]
    written = [(model.source.value(geom, "mass"), model.source.value(geom, "density")) for geom in geoms]
    return any(float(mass or density or "1") > 0 for mass, density in written)


def _mass(inertial: Element) -> float:
    holder = inertial.first("mass") if "mass" not in inertial.attributes else None
    return float(holder.get("value", "0") if holder else inertial.get("mass", "0"))


def _ball(mass: float) -> float:
    """The inertia of a ball of 50 mm radius, in kg m2."""
    return 0.4 * mass * 0.05**2


def _inertial(mass: float, urdf: bool, before: Element | None = None) -> str:
    """An `<inertial>` of a ball, where the one before had its centre."""
    own = f"{_ball(mass):.2g}"
    if urdf:
        origin = before.first("origin") if before else None
        place = f'<origin xyz="{origin.get("xyz", "0 0 0")}"/>' if origin else ""
        moments = f'<inertia ixx="{own}" iyy="{own}" izz="{own}" ixy="0" ixz="0" iyz="0"/>'
        return f'<inertial>{place}<mass value="{mass:g}"/>{moments}</inertial>'
    pos = before.get("pos", "0 0 0") if before else "0 0 0"
    return f'<inertial pos="{pos}" mass="{mass:g}" diaginertia="{own} {own} {own}"/>'
