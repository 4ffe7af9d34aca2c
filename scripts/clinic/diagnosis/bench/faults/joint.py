"""Joints: ranges, axes, springs, damping."""

from __future__ import annotations

import math
from dataclasses import replace
from random import Random

from clinic.diagnosis.bench.faults import Fault, between, kind, numbers, pick, text_of, written
from clinic.diagnosis.edit import replace as replace_element
from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import FREE, HINGE
from clinic.diagnosis.reader_model import ReaderModel

ENDS = ("reaches", "jumps", "strays")
BURSTS = ("unstable", "faster", "jumps")
BY_TIME = ("the integrator", "the timestep")


def _single(model: ReaderModel, attribute: str = "") -> list[int]:
    """Hinges and slides that have a place, and a value for the attribute."""
    return [i for i in written(model, "joint", attribute) if i in model.simulation.scalar_joints]


def _set(model: ReaderModel, joint: int, attribute: str, value: str, strength: float) -> Fault:
    element = model.element("joint", joint)
    assert element is not None
    return Fault(
        (set_attribute(element, attribute, value),), (model.simulation.name("joint", joint),), attribute, strength
    )


def _limited(model: ReaderModel) -> list[int]:
    limited = model.simulation.model("jnt_limited")
    return [i for i in _single(model, "range") if limited[i]]


def _range(model: ReaderModel, joint: int, low: float, high: float, strength: float) -> Fault:
    return _set(model, joint, "range", text_of(low, high), strength)


@kind("range-in-the-wrong-unit", "start-outside-range", harms=ENDS)
def range_of_a_joint_in_the_other_unit(model: ReaderModel, random: Random) -> Fault | None:
    """The range of one hinge in degrees among radians, or in radians among degrees."""
    hinges = [i for i in _limited(model) if model.simulation.joint_type(i) == HINGE]
    joint = pick(random, hinges)
    low, high = numbers(model.value("joint", joint, "range"))[:2]
    factor = math.pi / 180 if max(abs(low), abs(high)) > 7 else 180 / math.pi
    return _range(model, joint, low * factor, high * factor, factor)


@kind("range-in-the-wrong-unit", "start-outside-range", harms=ENDS)
def angles_in_the_other_unit(model: ReaderModel, random: Random) -> Fault | None:
    """The compiler reads all angles in the other unit: `angle` of `<compiler>`."""
    assert model.source is not None
    there = [each.get("angle") for each in model.source.elements("compiler") if each.get("angle")]
    other = "degree" if there == ["radian"] else "radian"
    hinges = [i for i in _limited(model) if model.simulation.joint_type(i) == HINGE]
    if not hinges:
        return None
    return Fault(model.option("angle", other, tag="compiler"), (), "angle")


@kind("start-outside-range", harms=ENDS)
def start_outside_of_the_range(model: ReaderModel, random: Random) -> Fault | None:
    """The range of a joint begins beyond where the joint starts, by 2 to 100 % of the range."""
    joint, share = pick(random, _limited(model)), between(random, 0.02, 1)
    low, high = numbers(model.value("joint", joint, "range"))[:2]
    way = share * (high - low)
    if random.random() < 0.5:
        return _range(model, joint, way, way + high - low, share)
    return _range(model, joint, -way - (high - low), -way, share)


@kind("range-too-narrow", harms=ENDS)
def range_narrow(model: ReaderModel, random: Random) -> Fault | None:
    """The range of a joint 0.1 to 10 % of what it was, about the start."""
    joint, share = pick(random, _limited(model)), between(random, 0.001, 0.1)
    low, high = numbers(model.value("joint", joint, "range"))[:2]
    return _range(model, joint, low * share, high * share, share)


@kind("range-empty", harms=ENDS)
def range_emptied(model: ReaderModel, random: Random) -> Fault | None:
    """A range from its upper end to its lower, or of nothing; `limited` is left to the compiler."""
    joint = pick(random, _limited(model))
    low, high = numbers(model.value("joint", joint, "range"))[:2]
    fault, element = _range(model, joint, *random.choice(((high, low), (0.0, 0.0))), 1.0), model.element("joint", joint)
    assert element is not None
    return replace(fault, edits=(*fault.edits, set_attribute(element, "limited", "auto")))


@kind("range-not-applied", harms=ENDS)
def range_not_applied(model: ReaderModel, random: Random) -> Fault | None:
    """A joint's range is written on it, and not applied; that of a class may be taken back on purpose."""
    own = [each for each in _limited(model) if (written := model.element("joint", each)) and written.get("range")]
    return _set(model, pick(random, own), "limited", "false", 1)


@kind("axis-wrong", "twin-joint-differs", harms=ENDS)
def axis_wrong(model: ReaderModel, random: Random) -> Fault | None:
    """A joint's axis of the other sign, or along another direction of its body."""
    joint = pick(random, _single(model))
    x, y, z = model.simulation.row("jnt_axis", joint, 3)
    return _set(model, joint, "axis", text_of(*random.choice(((-x, -y, -z), (y, z, x), (z, x, y)))), 1)


@kind("spring-too-stiff", "timestep-too-long", harms=BURSTS)
def spring_stiff(model: ReaderModel, random: Random) -> Fault | None:
    """A joint's spring 2 to 1,000 times as stiff as the timestep bears, without damping."""
    joint, factor = pick(random, _single(model)), between(random, 2, 1000)
    mass = model.simulation.mass_diagonal[model.simulation.dof(joint)]
    made = _set(model, joint, "stiffness", text_of(factor * mass * (2 / model.simulation.timestep) ** 2), factor)
    more = _set(model, joint, "damping", "0", factor)
    rest = "5" if model.simulation.joint_type(joint) == HINGE else "0.05"  # somewhere else than the start
    off = _set(model, joint, "springref", rest, factor)
    return Fault((*made.edits, *more.edits, *off.edits), (*made.elements, "the timestep"), "stiffness", factor)


@kind("spring-far-off", "spring-too-stiff", harms=("strays", *BURSTS))
def spring_pulls_away(model: ReaderModel, random: Random) -> Fault | None:
    """A joint's spring that holds it away from its start, 2 to 200 times as strong as its load."""
    joint, factor = pick(random, _single(model)), between(random, 2, 200)
    model.simulation.begin()
    dof = model.simulation.dof(joint)
    load = max(abs(model.simulation.data("qfrc_bias")[dof]), model.simulation.mass_diagonal[dof])
    made = _set(model, joint, "stiffness", text_of(factor * load), factor)
    more = _set(model, joint, "springref", text_of(random.choice((-1, 1)) * random.uniform(20, 170)), factor)
    return Fault((*made.edits, *more.edits), made.elements, "springref", factor)


@kind("joint-frozen", harms=("strays", "commands"))
def joint_frozen(model: ReaderModel, random: Random) -> Fault | None:
    """A joint with so much damping or dry friction that it hardly moves."""
    joint, factor = pick(random, _single(model)), between(random, 10, 1e5)
    mass = model.simulation.mass_diagonal[model.simulation.dof(joint)]
    attribute = random.choice(("damping", "frictionloss"))
    return _set(model, joint, attribute, text_of(10 * mass * factor), factor)


@kind("negative-damping", harms=("strays", *BURSTS))
def damping_negative(model: ReaderModel, random: Random) -> Fault | None:
    """A joint's damping with a minus before it."""
    joint, factor = pick(random, _single(model)), between(random, 0.3, 100)
    mass = model.simulation.mass_diagonal[model.simulation.dof(joint)]
    return _set(model, joint, "damping", text_of(-factor * mass), factor)


@kind("free-joint-held", harms=("strays", "sinks", "jumps", "accelerates"))
def free_joint_of_a_default(model: ReaderModel, random: Random) -> Fault | None:
    """A free joint has damping, dry friction or armature, as joints have them from a default."""
    of = model.simulation
    free = [i for i in written(model, "joint") if of.joint_type(i) == FREE]
    joint = pick(random, free)
    element = model.element("joint", joint)
    assert element is not None
    mass = of.model("body_subtreemass")[of.body_of("joint", joint)]
    attribute = random.choice(("damping", "frictionloss", "armature"))
    strength = between(random, 0.1, 10) * mass * (1 if attribute == "armature" else 9.81)
    if element.tag == "joint":
        return _set(model, joint, attribute, text_of(strength), strength)
    name = f' name="{element.get("name")}"' if element.get("name") else ""
    edit = replace_element(element, f'<joint{name} type="free" {attribute}="{text_of(strength)}"/>')
    return Fault((edit,), (of.name("joint", joint),), attribute, strength)


@kind("damping-explicit", "timestep-too-long", "no-armature", harms=("unstable", "faster"))
def damping_under_rk4(model: ReaderModel, random: Random) -> Fault | None:
    """RK4, and a hinge or slide with 1.5 to 300 times the damping that slows it down within a step."""
    joints = _single(model)
    joint, share = pick(random, joints), between(random, 1.5, 300)
    damping = share * model.simulation.mass_diagonal[model.simulation.dof(joint)] / model.simulation.timestep
    fault = _set(model, joint, "damping", text_of(damping), share)
    return replace(
        fault, edits=(*fault.edits, *model.option("integrator", "RK4")), elements=(*fault.elements, *BY_TIME)
    )
