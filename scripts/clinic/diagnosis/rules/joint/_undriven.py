"""Joints that nothing drives, and that damping or friction holds: pendulums, doors and drawers."""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, TRN_IN_PARENT
from clinic.diagnosis.probes.load import loads
from clinic.diagnosis.probes.shape import size
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

FIELDS = ("damping", "frictionloss")
CRITICAL, SWINGS = 2.0, 0.02  # of a pendulum's critical damping: too much, and what is usual
STILL = 0.03  # rad/s or m/s that its own weight gives what nothing drives
HEAVY = 0.05  # of weight times size: a joint that is balanced has less
LEVER = 0.1  # m: a knob is turned by what is longer than it
PUSH, WEIGHTS, OPENING = 50.0, 2.0, 0.1  # N, times its weight, and the rad/s or m/s that it is to reach by them


def undriven(model: ReaderModel) -> Iterator[Suspect]:
    """What its own weight does not move, or lets creep, and what a strong push does not open."""
    yield from _hung(model)
    yield from _creeps(model)
    yield from _shut(model)


def _hung(model: ReaderModel) -> Iterator[Suspect]:
    """Joints that nothing drives, and that their own weight does not move."""
    simulation = model.simulation
    held = {joint: held for joint, held in _held(simulation).items() if held > 1}
    for joint in held:
        damping, friction = (simulation.model(f"dof_{name}")[simulation.dof(joint)] for name in FIELDS)
        attribute = "damping" if STILL * damping >= friction else "frictionloss"
        edits = model.set("joint", [joint], attribute, "0")
        moves = (
            f"moves it at less than {STILL:g} rad/s (m/s)" if attribute == "damping" else "is less than its friction"
        )
        yield Suspect(
            (simulation.name("joint", joint),),
            attribute,
            f"{max(damping, friction) if attribute == 'damping' else friction:.3g}",
            "0",
            edits,
            Probe("what holds the joint, times its own weight", "", _most_held, (joint,), dynamic=False),
            1.0,
            f"Nothing drives {simulation.name('joint', joint)}, and its own weight, "
            f"{loads(simulation)[simulation.dof(joint)]:.3g} N m (N) at most, {moves}.",
            "a joint that swings where nothing drives it",
        )


def _creeps(model: ReaderModel) -> Iterator[Suspect]:
    """Pendulums that creep down, as nothing that swings does."""
    of = model.simulation
    for joint, held in _held(of).items():
        if held > 1 or (ratio := _ratio(of, joint)) <= CRITICAL:
            continue
        now, name = of.model("dof_damping")[of.dof(joint)], of.name("joint", joint)
        value = rounded(now * SWINGS / ratio)
        mass = of.model("body_subtreemass")[of.body_of("joint", joint)]
        says = (
            f"Nothing drives it, and for its {mass:.2g} kg damping is {ratio:.2g} times the critical: it creeps down."
        )
        edits, probe = (
            model.set("joint", [joint], "damping", value),
            Probe("damping ratio", "", _ratio, (joint,), False),
        )
        healthy = "0.2 and less in healthy models"
        yield Suspect((name,), "damping", f"{now:.3g}", value, edits, probe, CRITICAL, says, healthy)


def _ratio(of: Simulation, joint: int) -> float:
    """The damping of a hinge without a range over the critical of a pendulum, from its greatest load and inertia."""
    dof = of.dof(joint)
    critical = 2 * math.sqrt(loads(of)[dof] * of.mass_diagonal[dof])
    return of.model("dof_damping")[dof] / critical if of.continuous(joint) and critical > 0 else 0.0


def _shut(model: ReaderModel) -> Iterator[Suspect]:
    """Doors and drawers that a strong push does not open."""
    of = model.simulation
    for joint in range(of.count("joint")):
        if _push_held(of, joint) <= 1:
            continue
        damping, friction = (of.model(f"dof_{name}")[of.dof(joint)] for name in FIELDS)
        attribute = "damping" if OPENING * damping >= friction else "frictionloss"
        now = damping if attribute == "damping" else friction
        edits = model.set("joint", [joint], attribute, f"{now / 1000:.2g}")
        slow = f"at {_push(of, joint) * _reach(of, joint) / max(damping, 1e-9):.2g} rad/s (m/s)"
        moves = f"moves it {slow} at most" if attribute == "damping" else "gives less than its friction"
        says = f"Nothing drives it, and a push of {_push(of, joint):.3g} N at its far end {moves}."
        probe = Probe("what holds it, times a strong push", "", _push_held, (joint,), dynamic=False)
        name = of.name("joint", joint)
        yield Suspect((name,), attribute, f"{now:.3g}", f"{now / 1000:.2g}", edits, probe, 1.0, says, "below 1")


def _push_held(of: Simulation, joint: int) -> float:
    """What holds a joint that nothing moves over what a strong push at its far end gives."""
    told = joint in _held(of) or bool(of.model("jnt_actfrclimited")[joint])  # an effort of a URDF drives it
    if joint not in of.scalar_joints or joint in _moved(of) or told:
        return 0.0
    damping, friction = (of.model(f"dof_{name}")[of.dof(joint)] for name in FIELDS)
    most = _push(of, joint) * _reach(of, joint)
    return max(OPENING * damping, friction) / most if most > 0 else 0.0


def _moved(of: Simulation) -> set[int]:
    """The joints that an actuator, a spring, a tendon or an equality may move."""
    every = set(range(of.count("joint")))
    if of.count("tendon") or _cranked(of):
        return every
    tied = every if of.count("equality") else set()
    return set(of.drivers) | {joint for joint in every if of.model("jnt_stiffness")[joint]} | tied


def _cranked(of: Simulation) -> bool:
    """Whether an actuator moves what it moves otherwise than by its joint: by a crank, at a site."""
    return any(int(kind) > TRN_IN_PARENT for kind in of.model("actuator_trntype"))


def _push(of: Simulation, joint: int) -> float:
    body = of.body_of("joint", joint)
    return PUSH + WEIGHTS * of.model("body_subtreemass")[body] * of.gravity


def _reach(of: Simulation, joint: int) -> float:
    """The lever of a push in m; 1 for a slide, which has none."""
    return max(LEVER, size(of, of.body_of("joint", joint))) if of.joint_type(joint) == HINGE else 1.0


def _held(simulation: Simulation) -> dict[int, float]:
    """What holds each joint that neither an actuator nor a spring moves over what its weight gives, on one side."""
    if not simulation.count("actuator") or simulation.count("tendon") or simulation.count("equality"):
        return {}
    if _cranked(simulation):
        return {}
    springs, made = simulation.model("jnt_stiffness"), {}
    for joint in simulation.scalar_joints:
        if joint in simulation.drivers or springs[joint]:
            continue
        dof, body = simulation.dof(joint), simulation.body_of("joint", joint)
        lever = size(simulation, body) if simulation.joint_type(joint) == HINGE else 1.0
        load = loads(simulation)[dof]
        if load > HEAVY * simulation.gravity * simulation.model("body_subtreemass")[body] * lever > 0:
            damping, friction = (simulation.model(f"dof_{name}")[dof] for name in FIELDS)
            made[joint] = max(STILL * damping, friction) / load
    return made


def _most_held(simulation: Simulation, joint: int) -> float:
    return _held(simulation).get(joint, 0.0)
