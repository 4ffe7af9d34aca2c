"""Mass and inertia, and what can move at all."""

from __future__ import annotations

from random import Random

from clinic.diagnosis.bench.faults import Fault, between, kind, pick, text_of, written
from clinic.diagnosis.edit import Edit, delete, insert, set_attribute
from clinic.diagnosis.engine import FREE
from clinic.diagnosis.probes.shape import root_of, roots
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.world.mesh_in_another_unit import mesh_sizes, scaled

FELT = ("weighs", "accelerates", "unstable", "strays")
INERTIA = ("inertia-unlike-geoms", "inertia-across-geoms", "denser-than-metal", "lighter-than-air")


def _bodies(model: ReaderModel) -> list[int]:
    """Moving bodies of some mass, with geoms and a place in the text."""
    simulation, masses = model.simulation, model.simulation.model("body_mass")
    moving = [b for b in simulation.moving_bodies if masses[b] > 0 and simulation.geoms_of(b)]
    return [b for b in moving if model.element("body", b) is not None]


def _inertial(
    model: ReaderModel,
    body: int,
    mass: float = 1.0,
    moments: tuple[float, ...] = (1.0, 1.0, 1.0),
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
    absolute: tuple[float, float, float] | None = None,
) -> tuple[Edit, ...]:
    """Edits that write a body's inertia, as compiled, with its numbers times factors; `absolute` gives the moments."""
    simulation = model.simulation
    position = [a + b for a, b in zip(simulation.row("body_ipos", body, 3), offset, strict=True)]
    inertia = absolute or [a * b for a, b in zip(simulation.row("body_inertia", body, 3), moments, strict=True)]
    rotation = text_of(*simulation.row("body_iquat", body, 4))
    heavy = simulation.model("body_mass")[body] * mass
    xml = f'<inertial pos="{text_of(*position)}" quat="{rotation}" mass="{text_of(heavy)}"'
    xml += f' diaginertia="{text_of(*inertia)}"/>'
    element = model.element("body", body)
    assert element is not None
    old = element.first("inertial")
    return (*((delete(old),) if old else ()), insert(element, xml))


def _fault(model: ReaderModel, body: int, edits: tuple[Edit, ...], attribute: str, strength: float) -> Fault:
    return Fault(edits, (model.simulation.name("body", body),), attribute, strength)


@kind(*INERTIA, harms=FELT)
def inertia_placeholder(model: ReaderModel, random: Random) -> Fault | None:
    """A body's inertia is a placeholder: 1 1 1, 0.1, 0.01, 0.001 or 1e-6 in every direction."""
    body, value = pick(random, _bodies(model)), random.choice((1.0, 0.1, 0.01, 0.001, 1e-6))
    return _fault(model, body, _inertial(model, body, absolute=(value, value, value)), "diaginertia", value)


@kind(*INERTIA, harms=FELT)
def inertia_of_another_size(model: ReaderModel, random: Random) -> Fault | None:
    """A body's inertia 3 to 1,000 times too large or too small, its mass as it was."""
    body, factor = pick(random, _bodies(model)), between(random, 3, 1000) ** random.choice((-1, 1))
    return _fault(model, body, _inertial(model, body, moments=(factor,) * 3), "diaginertia", factor)


@kind("inertia-in-another-unit", *INERTIA, harms=FELT)
def inertias_in_another_unit(model: ReaderModel, random: Random) -> Fault | None:
    """All bodies' inertias in g m2, kg mm2, g cm2 or g mm2."""
    factor = random.choice((1e3, 1e6, 1e7, 1e9))
    edits = tuple(edit for body in _bodies(model) for edit in _inertial(model, body, moments=(factor,) * 3))
    names = tuple(model.simulation.name("body", body) for body in _bodies(model))
    return Fault(edits, names, "diaginertia", factor) if len(names) > 1 else None


@kind("inertia-across-geoms", *INERTIA, harms=FELT)
def inertia_not_turned(model: ReaderModel, random: Random) -> Fault | None:
    """A body's principal moments in another order."""
    inertia = {b: model.simulation.row("body_inertia", b, 3) for b in _bodies(model)}
    found = [b for b, (x, y, z) in inertia.items() if max(x, y, z) > 3 * min(x, y, z)]
    body = pick(random, found)
    x, y, z = inertia[body]
    return _fault(model, body, _inertial(model, body, absolute=(y, z, x)), "diaginertia", 1)


@kind("centre-of-mass-outside", harms=("accelerates", "strays"))
def centre_of_mass_displaced(model: ReaderModel, random: Random) -> Fault | None:
    """A body's centre of mass away from where its geoms are, by 0.5 to 10 of their size."""
    body, factor = pick(random, _bodies(model)), between(random, 0.5, 10)
    simulation = model.simulation
    size = max(simulation.model("geom_rbound")[g] for g in simulation.geoms_of(body)) or 0.1
    offset = [0.0, 0.0, 0.0]
    offset[random.randrange(3)] = random.choice((-1, 1)) * factor * size
    x, y, z = offset
    return _fault(model, body, _inertial(model, body, offset=(x, y, z)), "pos", factor)


@kind("denser-than-metal", *INERTIA, harms=FELT)
def mass_too_large(model: ReaderModel, random: Random) -> Fault | None:
    """A body's mass and inertia 30 to 10,000 times too large."""
    body, factor = pick(random, _bodies(model)), random.choice((1000.0, between(random, 30, 1e4)))
    return _fault(model, body, _inertial(model, body, mass=factor, moments=(factor,) * 3), "mass", factor)


@kind("whole-mass", "twin-inertia-differs", "denser-than-metal", harms=FELT)
def mass_doubled(model: ReaderModel, random: Random) -> Fault | None:
    """A body's mass and inertia 2 or 7 times too large or too small."""
    body, factor = pick(random, _bodies(model)), random.choice((0.5, 1 / 7, 2.0, 7.0))
    return _fault(model, body, _inertial(model, body, mass=factor, moments=(factor,) * 3), "mass", factor)


@kind("whole-mass", *INERTIA, harms=FELT)
def mass_without_its_inertia(model: ReaderModel, random: Random) -> Fault | None:
    """A body's mass 3 to 1,000 times too large or too small, its inertia as it was."""
    body, factor = pick(random, _bodies(model)), between(random, 3, 1000) ** random.choice((-1, 1))
    return _fault(model, body, _inertial(model, body, mass=factor), "mass", factor)


@kind("lighter-than-air", *INERTIA, harms=FELT)
def mass_near_zero(model: ReaderModel, random: Random) -> Fault | None:
    """The last body of a chain, which collides, weighs a millionth of what it did, or less."""
    simulation, parents = model.simulation, set(model.simulation.model("body_parentid"))
    collides = simulation.model("geom_contype")
    found = [b for b in _bodies(model) if b not in parents and any(collides[g] for g in simulation.geoms_of(b))]
    body, factor = pick(random, found), between(random, 1e-10, 1e-6)
    return _fault(model, body, _inertial(model, body, mass=factor, moments=(factor,) * 3), "mass", factor)


@kind("visual-mass", harms=FELT)
def visual_geom_with_mass(model: ReaderModel, random: Random) -> Fault | None:
    """A geom for the eyes alone, of 1 to 3 times a colliding geom's size, that weighs as water does."""
    simulation, found = model.simulation, []
    for body in _bodies(model):
        element = model.element("body", body)
        if element is not None and element.first("inertial") is None:
            found += [
                (body, g)
                for g in simulation.geoms_of(body)
                if simulation.model("geom_type")[g] in (2, 3, 4, 5, 6) and simulation.model("geom_contype")[g]
            ]
    body, geom = pick(random, found)
    factor = between(random, 1, 3)
    shape = ("sphere", "capsule", "ellipsoid", "cylinder", "box")[int(simulation.model("geom_type")[geom]) - 2]
    size = [factor * each for each in simulation.row("geom_size", geom, 3)]
    place = (
        f'pos="{text_of(*simulation.row("geom_pos", geom, 3))}" quat="{text_of(*simulation.row("geom_quat", geom, 4))}"'
    )
    xml = f'<geom type="{shape}" size="{text_of(*size)}" {place} contype="0" conaffinity="0" group="2"/>'
    element = model.element("body", body)
    assert element is not None
    name = simulation.name("body", body)
    own = f"geom {simulation.geoms_of(body)[-1] + 1} of {name}"
    return Fault((insert(element, xml),), (name, own), "mass", factor)


@kind("inertial-forgotten", "visual-mass", "denser-than-metal", *INERTIA, harms=FELT)
def inertial_forgotten(model: ReaderModel, random: Random) -> Fault | None:
    """A body without the `<inertial>` that it and at least three others had: its geoms weigh as water does."""
    found = [(b, model.element("body", b)) for b in _bodies(model)]
    there = [(b, e.first("inertial")) for b, e in found if e is not None and e.first("inertial") is not None]
    if len(there) < 4:
        return None
    body, inertial = random.choice(there)
    assert inertial is not None
    geoms = tuple(model.simulation.name("geom", g) for g in model.simulation.geoms_of(body))
    return Fault((delete(inertial),), (model.simulation.name("body", body), *geoms), "mass")


@kind("geom-twice", harms=FELT)
def geom_twice(model: ReaderModel, random: Random) -> Fault | None:
    """A geom that stands twice in its body."""
    assert model.source is not None
    simulation, found = model.simulation, [(b, model.element("body", b)) for b in _bodies(model)]
    geoms = [(b, e, g) for b, e in found if e and not e.first("inertial") for g in simulation.geoms_of(b)]
    placed = [(b, e, g, model.element("geom", g)) for b, e, g in geoms]
    copies = [(b, e, g, geom) for b, e, g, geom in placed if geom is not None and geom.empty]
    body, around, geom, element = pick(random, copies)
    written_ = "".join(f' {name}="{value}"' for name, value in element.attributes.items() if name != "name")
    name = simulation.name("body", body)
    own = f"geom {simulation.geoms_of(body)[-1] + 1} of {name}"
    return Fault((insert(around, f"<geom{written_}/>"),), (name, simulation.name("geom", geom), own), "mass")


@kind("root-is-fixed", "nothing-can-move", harms=("strays",))
def freejoint_removed(model: ReaderModel, random: Random) -> Fault | None:
    """A body without the free joint that it had, so that it hangs in the air."""
    free = [j for j in written(model, "joint") if model.simulation.joint_type(j) == 0]
    joint = pick(random, free)
    element = model.element("joint", joint)
    assert element is not None
    body = model.simulation.body_of("joint", joint)
    return Fault((delete(element),), (model.simulation.name("body", body),), "freejoint")


@kind("missing-joint", "twin-joint-differs", harms=("strays",))
def joint_removed(model: ReaderModel, random: Random) -> Fault | None:
    """A body without the hinge or slide that it had."""
    assert model.source is not None
    used = {value for each in model.source.root.walk() for name, value in each.attributes.items() if name != "name"}
    joints = [j for j in written(model, "joint") if model.simulation.joint_type(j) > 1]
    joints = [j for j in joints if model.simulation.engine.name("joint", j) not in used]
    joint = pick(random, joints)
    element = model.element("joint", joint)
    assert element is not None
    body = model.simulation.name("body", model.simulation.body_of("joint", joint))
    return Fault((delete(element),), (body, model.simulation.name("joint", joint)), "joint")


@kind("gravity-compensated", harms=("strays", "accelerates"))
def gravity_compensated(model: ReaderModel, random: Random) -> Fault | None:
    """Every body floats: `gravcomp="1"`."""
    edits = tuple(e for b in written(model, "body") if b for e in model.set("body", [b], "gravcomp", "1"))
    names = tuple(model.simulation.name("body", b) for b in written(model, "body") if b)
    return Fault(edits, names, "gravcomp") if edits else None


@kind("gravcomp-on-some", harms=("strays", "accelerates"))
def gravity_compensated_in_part(model: ReaderModel, random: Random) -> Fault | None:
    """Every link of an arm floats but one, which is not the last."""
    simulation, owner, masses = model.simulation, root_of(model.simulation), model.simulation.model("body_mass")
    fixed = [r for r in roots(simulation) if all(simulation.joint_type(j) != FREE for j in simulation.joints_of(r))]
    arms = [[b for b in written(model, "body") if owner[b] == root and masses[b] > 0] for root in fixed]
    arm = pick(random, [arm for arm in arms if len(arm) > 1])
    bare = random.choice(arm[:-1])
    edits = tuple(edit for b in arm if b != bare for edit in model.set("body", [b], "gravcomp", "1"))
    return Fault(edits, (simulation.name("body", bare),), "gravcomp")


@kind("denser-than-metal", harms=FELT)
def geom_too_dense(model: ReaderModel, random: Random) -> Fault | None:
    """A geom of 30,000 to 1,000,000 kg/m3, where gold has 19,300."""
    found = [g for b in _bodies(model) for g in model.simulation.geoms_of(b) if model.value("geom", g, "mass") is None]
    found = [g for g in found if model.element("geom", g) is not None]
    geom, density = pick(random, found), between(random, 3e4, 1e6)
    element = model.element("geom", geom)
    assert element is not None
    body = model.simulation.name("body", model.simulation.body_of("geom", geom))
    edit = set_attribute(element, "density", text_of(density))
    return Fault((edit,), (model.simulation.name("geom", geom), body), "density", density)


@kind("mesh-in-another-unit", "overlap-at-start", harms=(*FELT, "faster", "sinks"))
def mesh_in_millimetres(model: ReaderModel, random: Random) -> Fault | None:
    """A mesh that stands in millimetres, without its `scale`."""
    meshes = [mesh for mesh in mesh_sizes(model.simulation) if any(scaled(model, mesh, 1000.0))]
    mesh = pick(random, meshes)
    return Fault(tuple(scaled(model, mesh, 1000.0)), (model.simulation.name("mesh", mesh),), "scale", 1000.0)
