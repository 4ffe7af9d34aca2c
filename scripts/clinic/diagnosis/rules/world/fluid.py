"""The air is as dense as water, or as viscous as honey.

`density` and `viscosity` of `<option>` make a medium that holds everything back. Air has 1.2 kg/m3 and 0.00002 Pa s,
water 1000 kg/m3 and 0.0009 Pa s.

Bad:

    <mujoco>
      <option density="5000"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <option density="5000"/>
    +   <option density="1.2"/>

The number: what the medium holds back of something at the speed of a fall over half its own radius, as a share of its
weight; below 0.1 is well. A little viscosity is a usual way to bring what dangles to rest.

Where geoms have a `fluidshape`, the medium is meant, and hints tell what does not fit it: water's viscosity of 0.0009
without a density, or with the 1 of g/cm3, or, beside the density of water, written in mPa s. What has 0.8 to 1.25 times
the density of a liquid and sinks is told too, for MuJoCo has no buoyancy: it takes `gravity="0 0 0"`, or `gravcomp`.
And so is a density of air in g/m3, 1225 beside a viscosity of 0.000018, where geoms are shaped or it holds back too
little to be a cause; and a swimmer whose `density` is that of a solid in g/cm3, and less than a fiftieth of the
liquid's. Without any medium, a hint tells of what moves freely and has motors within itself alone, where no contact,
gravity, spring or damping acts on it from outside: its centre of mass stays where it is, whatever it does.

When it is wrong: a boat; a robot in space. What cannot fall, or has no gravity, is left alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from collections.abc import Set as AbstractSet

from clinic.diagnosis.engine import FREE, GRAVITY_OFF, SLIDE
from clinic.diagnosis.probes.matter import matter
from clinic.diagnosis.probes.shape import FLUID, falling, geoms_of_tree, roots, size, solid, swims
from clinic.diagnosis.probes.vector import dot
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A medium that holds everything back"
FAMILIES = ("slow", "stuck", "drifts")

MOST = 0.1  # of the weight
MEDIUM = (  # air, what is told, what is told where geoms are shaped for it, and the unit
    ("density", 1.2, 6.0, 1500.0, "kg/m3"),
    ("viscosity", 0.00002, 0.01, 2.0, "Pa s"),
)
WATER, THIN, THICK = (995.0, 1035.0), (0.0005, 0.002), (0.5, 2.0)  # kg/m3, fresh and salt; Pa s, and mPa s
STILL = 1e-3  # of gravity
THINNER = 1.1  # kg/m3, or the g/cm3 of water
AIR, GAS = (1.1, 1.35), (1.6e-5, 2.0e-5)  # kg/m3, and Pa s, of air
AFLOAT = 0.8, 1.25  # of the medium's density
NOTHING, SOLID = 0.02, (0.3, 20.0)  # of the medium's density; g/cm3


def _held_back(simulation: Simulation) -> float:
    simulation.begin()
    g = simulation.gravity
    falls = falling(simulation)
    for root, dof in falls.items():
        simulation.engine.write("qvel", [-math.sqrt(g * max(size(simulation, root), 1e-3))], dof)
    simulation.engine.forward()
    drag, masses = simulation.data("qfrc_fluid"), simulation.model("body_subtreemass")
    return max((abs(drag[dof]) / max(g * masses[root], 1e-12) for root, dof in falls.items()), default=0.0)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The medium, where something can fall in it."""
    simulation = model.simulation
    shaped = any(simulation.model("geom_fluid")[::FLUID])
    if shaped:
        yield from _unfit(model)
        yield from _sinking(model)
        yield from _light(model)
    yield from _in_vacuum(model)
    if not simulation.gravity or int(simulation.model("opt.disableflags")[0]) & GRAVITY_OFF:
        return
    probe = Probe("drag of a fall", "of the weight", _held_back, dynamic=False)
    if shaped or model.measured(probe) <= MOST:
        yield from _in_grams(model)
    for name, usual, most, liquid, unit in MEDIUM:
        now = simulation.model(f"opt.{name}")[0]
        if now > (liquid if shaped else most):
            says = f"The medium has {now:g} {unit}; air has {usual:g}."
            edits = model.option(name, f"{usual:g}")
            yield Suspect((name,), name, f"{now:g}", f"{usual:g}", edits, probe, MOST, says, f"{usual:g} {unit}, air")


def _in_grams(model: ReaderModel) -> Iterator[Suspect]:
    """A density that is that of air in g/m3, beside the viscosity of air."""
    of = model.simulation
    density, viscosity = (of.model(f"opt.{name}")[0] for name in ("density", "viscosity"))
    if AIR[0] < density / 1000 < AIR[1] and GAS[0] < viscosity < GAS[1]:
        now, value = f"{density:g}", f"{density / 1000:g}"
        says = f"The viscosity of {viscosity:g} Pa s is that of air, and {now} is the density of air in g/m3."
        probe, edits = Probe("density of the medium", "kg/m3", _density, dynamic=False), model.option("density", value)
        yield Suspect(("density",), "density", now, value, edits, probe, AIR[1], says, f"{value} kg/m3", level="hint")


def _density(of: Simulation) -> float:
    return of.model("opt.density")[0]


def _unfit(model: ReaderModel) -> Iterator[Suspect]:
    """The number of water that does not fit the other one."""
    of = model.simulation
    density, viscosity = (of.model(f"opt.{name}")[0] for name in ("density", "viscosity"))
    if density < THINNER and THIN[0] < viscosity < THIN[1]:
        name, now, value = "density", density, "1000"
        beside = f"with a density of {density:g} kg/m3" if density else "without a density"
        says = f"The viscosity of {viscosity:g} Pa s is that of water, and {beside} it hardly resists."
    elif WATER[0] < density < WATER[1] and THICK[0] < viscosity < THICK[1]:
        name, now, value = "viscosity", viscosity, f"{viscosity / 1000:g}"
        says = f"Water has {value} Pa s: {viscosity:g} is its viscosity in mPa s."
    else:
        return
    probe = Probe(f"the medium's {name} beside that of water", "", _unlike, (name, float(value)), dynamic=False)
    yield Suspect((name,), name, f"{now:g}", value, model.option(name, value), probe, 0.5, says, value, level="hint")


def _unlike(of: Simulation, name: str, usual: float) -> float:
    """How far a number of the medium is from a usual one, in decades, or as a share where it is nothing."""
    now = of.model(f"opt.{name}")[0]
    return abs(math.log10(now / usual)) if now > 0 else 1.0


def _sinking(model: ReaderModel) -> Iterator[Suspect]:
    """All that can fall, where it is as dense as the medium and sinks."""
    of = model.simulation
    falls = list(falling(of))
    if any(of.model("body_gravcomp")[body] for root in falls for body in of.below(root)):
        return  # what makes it float is gravcomp-on-some's
    if not all(swims(of, root) and AFLOAT[0] < _dense(of, root) < AFLOAT[1] for root in falls):
        return
    probe = Probe("weight that nothing carries", "N", _weight, dynamic=False)
    if not falls or _weight(of) <= 0:
        return
    medium, now = of.model("opt.density")[0], " ".join(f"{each:g}" for each in of.model("opt.gravity"))
    names = tuple(of.name("body", root) for root in falls)
    says = f"{names[0]} is as dense as the medium of {medium:g} kg/m3, and sinks: MuJoCo has no buoyancy."
    edits = model.option("gravity", "0 0 0")
    yield Suspect(("gravity", *names), "gravity", now, "0 0 0", edits, probe, 0, says, "0 0 0", level="hint")


def _in_vacuum(model: ReaderModel) -> Iterator[Suspect]:
    """What its own motors move, and nothing pushes."""
    of = model.simulation
    if found := _unpushed(of):
        names = tuple(of.name("body", root) for root in found)
        says = f"No fluid, contact, gravity or damping acts on {names[0]} from outside: its centre of mass stays."
        probe, edits = how_many("robots that nothing outside pushes", _unpushed), model.option("density", "1000")
        yield Suspect(("density", *names), "density", "0", "1000", edits, probe, 0, says, "1000, water", level="hint")


def _unpushed(of: Simulation) -> list[int]:
    """The trees that move freely and have motors on inner joints alone, on which nothing outside acts."""
    joints = {of.driven_joint(actuator) for actuator in range(of.count("actuator"))}
    others = any(of.count(kind) for kind in ("equality", "pair", "tendon"))
    if not joints or None in joints or others or any(of.model(f"opt.{name}")[0] for name, *_ in MEDIUM):
        return []
    return [root for root in roots(of) if _driven_within(of, root, joints) and _loose(of, root)]


def _driven_within(of: Simulation, root: int, driven: AbstractSet[int | None]) -> bool:
    inner = {joint for body in of.below(root) if body != root for joint in of.joints_of(body)}
    touches = any(solid(of, geom) for geom in geoms_of_tree(of, root))
    return bool(inner & driven) and not driven & set(of.joints_of(root)) and not touches


def _loose(of: Simulation, root: int) -> bool:
    """Whether a body moves freely in a plane or in space, and neither gravity nor its joints act along its ways."""
    of.begin()
    joints, off = of.joints_of(root), int(of.model("opt.disableflags")[0]) & GRAVITY_OFF
    ways = [joint for joint in joints if of.joint_type(joint) in (FREE, SLIDE)]
    free = any(of.joint_type(joint) == FREE for joint in joints)
    dofs = [dof for dof, joint in enumerate(of.dof_joints) if joint in joints]
    held = any(of.model(f"dof_{name}")[dof] for name in ("damping", "frictionloss") for dof in dofs)
    held = (
        held or any(of.model("jnt_stiffness")[joint] for joint in joints) or any(joint in of.ranges for joint in ways)
    )
    pull = 0.0 if off else max((abs(dot(of.axis(joint), of.model("opt.gravity"))) for joint in ways), default=0.0)
    falls = free and bool(of.gravity) and not off
    return (free or len(ways) > 1) and not held and not falls and pull <= STILL * of.gravity


def _light(model: ReaderModel) -> Iterator[Suspect]:
    """The swimmers that weigh next to nothing in a liquid, by a density that is right in g/cm3."""
    of = model.simulation
    for root in (each for each in roots(of) if swims(of, each) and _dense(of, each) < NOTHING):
        geoms = geoms_of_tree(of, root)
        texts = {model.value("geom", geom, "density") or "" for geom in geoms}
        text, name = texts.pop(), of.name("body", root)
        if texts or not text or not SOLID[0] < float(text) < SOLID[1]:
            continue
        value = f"{1000 * float(text):g}"
        says = f"{name} has {text} kg/m3 in a liquid of {of.model('opt.density')[0]:g}; in g/cm3 it is that of a solid."
        probe = Probe("density of the liquid over the swimmer's", "", _thinner, (root,), dynamic=False)
        edits = model.set("geom", geoms, "density", value)
        yield Suspect((name,), "density", text, value, edits, probe, 1 / NOTHING, says, "as its liquid", level="hint")


def _thinner(of: Simulation, root: int) -> float:
    return 1 / max(_dense(of, root), 1e-12)


def _dense(of: Simulation, root: int) -> float:
    """The density of a tree over that of the medium."""
    found = [each for body in of.below(root) if (each := matter(of, body)) is not None]
    volume = sum(each.volume for each in found)
    return sum(each.mass for each in found) / volume / of.model("opt.density")[0] if volume else 0.0


def _weight(of: Simulation) -> float:
    """What of the weight of all that can fall gravcomp does not carry."""
    if int(of.model("opt.disableflags")[0]) & GRAVITY_OFF:
        return 0.0
    bodies = [body for root in falling(of) for body in of.below(root)]
    mass = sum(of.model("body_mass")[body] * (1 - of.model("body_gravcomp")[body]) for body in bodies)
    return of.gravity * mass
