"""Actuators: gains, forces, control ranges, gears."""

from __future__ import annotations

import math
from dataclasses import replace as replace_
from random import Random

from clinic.diagnosis.bench.faults import Fault, between, kind, numbers, pick, text_of, written
from clinic.diagnosis.edit import Edit, remove_attribute, replace, set_attribute
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element

SWAYS = ("misses", "unstable", "faster")
GOES = ("commands", "unstable", "faster")
TIMESTEP = "the timestep"  # what is too much for it may be said of either
PACE = 20.0  # rad/s: how fast a servo is that takes a motor's place


def with_servos(model: ReaderModel) -> tuple[Edit, ...]:
    """Edits that put a position servo, critically damped and as strong as its load asks, in the place of motors."""
    simulation, made = model.simulation, []
    simulation.begin()
    loads = list(simulation.data("qfrc_bias"))
    for i in written(model, "actuator"):
        joint, element = simulation.driven_joint(i), model.element("actuator", i)
        if element is None or element.tag not in ("motor", "general") or joint is None:
            continue
        if simulation.model("actuator_biastype")[i] or not simulation.model("jnt_limited")[joint]:
            continue
        dof, name = simulation.dof(joint), simulation.engine.name("joint", joint)
        strength = max(simulation.mass_diagonal[dof] * PACE**2, 20 * abs(loads[dof]))
        own = f' name="{element.get("name")}"' if element.get("name") else ""
        xml = f'<position{own} joint="{name}" kp="{strength:.4g}" dampratio="1" inheritrange="1"/>'
        made.append(replace(element, xml))
    return tuple(made)


def _servos(model: ReaderModel) -> list[int]:
    """Position servos of a hinge or slide that have a place in the text."""
    simulation = model.simulation
    found = [i for i in written(model, "actuator") if simulation.driven_joint(i) is not None]
    return [i for i in found if simulation.model("actuator_biastype")[i] == 1 and _gain(model, i) > 0]


def _gain(model: ReaderModel, i: int) -> float:
    return -float(model.simulation.bias(i)[1])


def _names(model: ReaderModel, i: int) -> tuple[str, ...]:
    joint = model.simulation.driven_joint(i)
    joints = (model.simulation.name("joint", joint),) if joint is not None else ()
    return (model.simulation.name("actuator", i), *joints)


def _position(model: ReaderModel, random: Random) -> tuple[int, Element] | None:
    """One that is written as `<position>`."""
    found = [(i, model.element("actuator", i)) for i in _servos(model)]
    positions = [(i, element) for i, element in found if element is not None and element.tag == "position"]
    return random.choice(positions) if positions else None


def _gains(model: ReaderModel, random: Random, factor: float, damping: float = 1.0) -> Fault | None:
    """A servo with its stiffness times a factor, its damping times another, as numbers rather than as a ratio."""
    if (chosen := _position(model, random)) is None:
        return None
    i, element = chosen
    kv = -float(model.simulation.bias(i)[2])
    edits = [set_attribute(element, "kp", text_of(_gain(model, i) * factor)), remove_attribute(element, "dampratio")]
    if model.value("actuator", i, "dampratio") is None or "dampratio" in element.attributes:
        edits.append(set_attribute(element, "kv", text_of(max(0.0, kv) * damping)))
    return Fault(tuple(edits), _names(model, i), "kv" if damping < 1 else "kp", factor if factor != 1 else damping)


@kind("undamped-servo", harms=SWAYS, servos=True)
def servo_undamped(model: ReaderModel, random: Random) -> Fault | None:
    """A position servo without its damping, or with a tenth of it and less."""
    return _gains(model, random, 1.0, random.choice((0.0, between(random, 0.001, 0.1))))


@kind("no-armature", "timestep-too-long", "undamped-servo", harms=SWAYS, servos=True)
def servo_stiff(model: ReaderModel, random: Random) -> Fault | None:
    """A position servo 10 to 10,000 times as stiff, its damping as it was."""
    made = _gains(model, random, between(random, 10, 1e4))
    return replace_(made, elements=(*made.elements, TIMESTEP)) if made else None


@kind("weak-servo", harms=SWAYS, servos=True)
def servo_weak(model: ReaderModel, random: Random) -> Fault | None:
    """A position servo with 0.2 to 20 % of its stiffness."""
    return _gains(model, random, between(random, 0.002, 0.2))


@kind("no-armature", "timestep-too-long", harms=SWAYS, servos=True)
def servo_damped_too_much(model: ReaderModel, random: Random) -> Fault | None:
    """A position servo with 10 to 10,000 times its damping."""
    if (chosen := _position(model, random)) is None:
        return None
    i, element = chosen
    mass = model.simulation.mass_diagonal[model.simulation.dof(model.simulation.driven_joint(i) or 0)]
    kv = max(2 * math.sqrt(_gain(model, i) * mass) * between(random, 10, 1e4), 1e-9)
    edits = (set_attribute(element, "kv", text_of(kv)), remove_attribute(element, "dampratio"))
    return Fault(edits, (*_names(model, i), TIMESTEP), "kv", kv)


def _own(model: ReaderModel, random: Random, attribute: str, of_stiffness: float) -> Fault | None:
    """A joint that a servo drives, with a damping or an armature of its own, as a multiple of the servo's stiffness."""
    found = [(i, model.simulation.driven_joint(i)) for i in _servos(model)]
    joints = [(i, joint, model.element("joint", joint)) for i, joint in found if joint is not None]
    joints = [each for each in joints if each[2] is not None]
    i, _, element = pick(random, joints)
    assert element is not None
    gear = model.simulation.gear(i) or 1.0
    value = of_stiffness * _gain(model, i) * gear**2
    return Fault((set_attribute(element, attribute, text_of(value)),), _names(model, i), attribute, of_stiffness)


@kind("servo-held-back", "weak-servo", "joint-frozen", harms=SWAYS, servos=True)
def joint_damped(model: ReaderModel, random: Random) -> Fault | None:
    """A joint whose own damping lets its servo follow in 0.2 to 100 s."""
    return _own(model, random, "damping", between(random, 0.2, 100))


@kind("servo-held-back", "weak-servo", harms=SWAYS, servos=True)
def joint_armed(model: ReaderModel, random: Random) -> Fault | None:
    """A joint whose own armature lets its servo move at 0.2 to 10 rad/s."""
    return _own(model, random, "armature", between(random, 0.2, 10) ** -2)


@kind("target-not-held", harms=SWAYS, servos=True)
def bias_forgotten(model: ReaderModel, random: Random) -> Fault | None:
    """A position servo as a general actuator with its gain and without its bias, so that it only pushes."""
    if (chosen := _position(model, random)) is None:
        return None
    i, element = chosen
    kept = "".join(
        f' {name}="{element.get(name)}"' for name in ("name", "joint", "ctrlrange", "gear") if element.get(name)
    )
    xml = f'<general{kept} gainprm="{text_of(_gain(model, i))}" biastype="affine"/>'
    return Fault((replace(element, xml),), _names(model, i), "biasprm")


@kind("force-range-too-small", "weak-servo", harms=("misses", "commands"), servos=True)
def force_range_small(model: ReaderModel, random: Random) -> Fault | None:
    """A servo that may push with 2 to 80 % of what its joint's load takes."""
    model.simulation.begin()
    loads = list(model.simulation.data("qfrc_bias"))
    found = []
    for i in _servos(model):
        load = abs(loads[model.simulation.dof(model.simulation.driven_joint(i) or 0)])
        if load > 1e-3:
            found.append((i, load))
    i, load = pick(random, found)
    share = between(random, 0.02, 0.8)
    gear = abs(model.simulation.gear(i)) or 1.0
    limit = share * load / gear
    element = model.element("actuator", i)
    assert element is not None
    edits = (
        set_attribute(element, "forcerange", text_of(-limit, limit)),
        set_attribute(element, "forcelimited", "true"),
    )
    return Fault(edits, _names(model, i), "forcerange", share)


def _control_range(model: ReaderModel, random: Random, low: float, high: float) -> Fault | None:
    """The control range of a servo times a factor."""
    i, factor = pick(random, _servos(model)), between(random, low, high)
    return _controlled(model, i, [factor * end for end in model.simulation.row("actuator_ctrlrange", i, 2)], factor)


def _controlled(model: ReaderModel, i: int, ends: list[float], strength: float) -> Fault | None:
    """A servo with another control range; None where that is empty."""
    element = model.element("actuator", i)
    assert element is not None
    if ends[0] >= ends[1]:
        return None
    edits = (
        remove_attribute(element, "inheritrange"),
        set_attribute(element, "ctrlrange", text_of(*ends)),
        set_attribute(element, "ctrllimited", "true"),
    )
    return Fault(edits, _names(model, i), "ctrlrange", strength)


@kind("control-range-too-wide", harms=GOES, servos=True)
def control_range_wide(model: ReaderModel, random: Random) -> Fault | None:
    """A servo's target may lie 1.5 to 20 times as far out as its joint may go."""
    return _control_range(model, random, 1.5, 20)


@kind("control-range-too-wide", harms=GOES, servos=True)
def control_range_in_degrees(model: ReaderModel, random: Random) -> Fault | None:
    """A servo's control range in degrees."""
    return _control_range(model, random, 180 / math.pi, 180 / math.pi)


@kind("control-range-too-narrow", harms=GOES, servos=True)
def control_range_narrow(model: ReaderModel, random: Random) -> Fault | None:
    """A servo's control range 0.1 to 20 % of what it was, about zero."""
    return _control_range(model, random, 0.001, 0.2)


@kind("control-range-unlike-range", harms=GOES, servos=True)
def control_range_of_one(model: ReaderModel, random: Random) -> Fault | None:
    """The control range of one servo of four or more ends short of what it was, by 5 to 80 %."""
    if len(found := _servos(model)) < 4:
        return None
    i, end, share = random.choice(found), random.randrange(2), between(random, 0.05, 0.8)
    ends = list(model.simulation.row("actuator_ctrlrange", i, 2))
    ends[end] += share * (ends[1 - end] - ends[end])
    return _controlled(model, i, ends, share)


@kind("gear-divides-target", harms=("misses", *GOES), servos=True)
def gear_of_a_servo(model: ReaderModel, random: Random) -> Fault | None:
    """A gear of 3 to 300 on a position servo, which divides its target."""
    i, factor = pick(random, _servos(model)), between(random, 3, 300)
    element = model.element("actuator", i)
    assert element is not None
    return Fault((set_attribute(element, "gear", text_of(factor)),), _names(model, i), "gear", factor)


@kind("strength-unlike-others", "twin-actuator-differs", harms=("strays", *GOES))
def gear_of_a_motor(model: ReaderModel, random: Random) -> Fault | None:
    """A motor's gear 0.02 to 50 times what it was, or of the other sign."""
    simulation = model.simulation
    found = [
        i for i in written(model, "actuator") if simulation.driven_joint(i) is not None and i not in _servos(model)
    ]
    i, factor = pick(random, found), random.choice((-1.0, between(random, 0.02, 0.5), between(random, 2, 50)))
    element = model.element("actuator", i)
    assert element is not None
    gear = simulation.gear(i) * factor
    return Fault((set_attribute(element, "gear", text_of(gear)),), _names(model, i), "gear", factor)


@kind("actuator-on-another-joint", "twin-actuator-differs", harms=("strays", *GOES))
def actuators_swapped(model: ReaderModel, random: Random) -> Fault | None:
    """Two actuators with names that drive each other's joint."""
    found = [(i, model.element("actuator", i)) for i in written(model, "actuator")]
    named = [(i, element) for i, element in found if element is not None and element.get("name")]
    with_joints = [(i, element) for i, element in named if "joint" in element.attributes]
    if len(with_joints) < 2:
        return None
    (i, one), (k, other) = random.sample(with_joints, 2)
    if one.get("joint") == other.get("joint"):
        return None
    edits = (set_attribute(one, "joint", other.get("joint")), set_attribute(other, "joint", one.get("joint")))
    return Fault(edits, (*_names(model, i), *_names(model, k)), "joint")


@kind("no-armature", "spring-too-stiff", "timestep-too-long", harms=("unstable", "faster"))
def armature_removed(model: ReaderModel, random: Random) -> Fault | None:
    """Every joint without the armature that it had."""
    with_it = [i for i in written(model, "joint", "armature") if numbers(model.value("joint", i, "armature"))[0] > 0]
    edits = model.set("joint", with_it, "armature", "0")
    names = tuple(model.simulation.name("joint", i) for i in with_it)
    driven = [i for i in written(model, "actuator") if model.simulation.driven_joint(i) in with_it]
    names += tuple(model.simulation.name("actuator", i) for i in driven)
    hinges = [i for i in with_it if model.simulation.joint_type(i) == HINGE]
    return Fault(edits, (*names, TIMESTEP), "armature") if edits and hinges else None
