"""A joint's damping or dry friction is more than its actuators can move.

`frictionloss` above the greatest force of the actuators holds a joint, or lets it creep, for MuJoCo's friction is soft.
`damping` lets it go at no more than force / damping.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-90 90" damping="500"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="elbow" ctrlrange="-1 1" gear="5"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" range="-90 90" damping="500"/>
    +       <joint name="elbow" axis="0 1 0" range="-90 90" damping="0.5"/>

The number: driven for 2 s with all that its actuators give, without gravity and contacts, more than 70 % of the way to
1 rad (0.1 m), or to the far limit, is left; motors at sites and tendons count, where nothing else drives the joint. Or
the damping lets full force cross the joint's range in 25 s and more: of 260 healthy models none needs more than 6.7 s.
A hinge without a range that motors drive needs 4 s and more for a turn: of 20 healthy models none more than 1.3 s. A
position servo is told, too, of which friction takes more than 0.2 of the force, and more than it gives 0.05 rad (m) off
its target: of 38 models with dry friction at their servos none has more than 0.05.

In a URDF, whose efforts no actuator gives yet, friction above the effort, or damping above it at half a rad/s (m/s), is
told. So is a joint that nothing drives, beside others that are driven, and that its weight would swing, where friction
is more, or damping lets it move at less than 0.03 rad/s (m/s); or, without a range, where damping is more than twice
the critical, so that it creeps down: of 385 healthy models none has more than 0.2 times. And a door or a drawer that
nothing drives, its weight does not load, and a push of 50 N and twice its weight at its far end moves at less than 0.1
rad/s (0.1 m/s).

When it is wrong: a brake, a worm gear that is meant to hold, or a joint so light that it creeps on in spite of its
friction.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.drive import pull, pulls, way_left
from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.joint._undriven import undriven
from clinic.diagnosis.simulation import ENDLESS, Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "Damping or friction holds a joint"
FAMILIES = ("stuck", "sags")
LEVEL = "hint"

SLOW = 0.5  # rad/s or m/s that full force reaches
LEFT = 0.7
CROSSES, TURNS = 25.0, 4.0  # s: for a range, for a turn of a hinge without one
TAKEN, SHORT = 0.2, 0.05  # of a servo's force; rad or m of its way


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Joints that full force does not move, by damping and by friction."""
    simulation, told = model.simulation, set[int]()
    for attribute, resists in (("damping", SLOW), ("frictionloss", 1.0)):
        held = simulation.model(f"dof_{attribute}")
        found = [
            joint
            for joint, force in _forces(simulation).items()
            if held[simulation.dof(joint)] * resists > force and model.measured(way_left((joint,))) > LEFT
        ]
        if not found:
            continue
        told.update(found)
        edits: tuple[Edit, ...] = ()
        for joint in found:
            force = _forces(simulation)[joint]
            edits += model.set("joint", [joint], attribute, f"{force / 5:.2g}" if attribute == "damping" else "0")
        force, now = _forces(simulation)[found[0]], held[simulation.dof(found[0])]
        slow = f"less than its friction of {now:.3g}"
        if attribute == "damping":
            slow = f"which moves it at {force / now:.2g} rad/s (m/s) at most"
        yield Suspect(
            tuple(simulation.name("joint", each) for each in found),
            attribute,
            f"{now:.3g}",
            next((each.value for each in edits), ""),
            edits,
            way_left(tuple(found)),
            LEFT,
            f"The actuators of {simulation.name('joint', found[0])} give {force:.3g} N m (N), {slow}.",
            "full force that reaches 1 rad/s and more",
        )
    yield from _crawls(model, told)
    yield from _rubbed(model, told)
    yield from undriven(model)
    yield from _beyond_effort(model)


def _crawls(model: ReaderModel, told: Collection[int]) -> Iterator[Suspect]:
    """Joints that move, and that need far longer than any for their range or a turn, by their damping."""
    of = model.simulation
    times = {joint: time for joint in _forces(of) if joint not in told and (time := _crosses(of, joint))}
    for limit, way, healthy in ((CROSSES, "its range", "6.7 s"), (TURNS, "a turn", "1.3 s")):
        slow = {
            each: time for each, time in times.items() if time > limit and (each in of.ranges) == (limit == CROSSES)
        }
        if not slow:
            continue
        worst = max(slow, key=lambda joint: slow[joint])
        force, damping = _forces(of)[worst], of.model("dof_damping")[of.dof(worst)]
        values = {joint: rounded(of.model("dof_damping")[of.dof(joint)] / slow[joint]) for joint in slow}
        says = (
            f"The actuators of {of.name('joint', worst)} give {force:.3g} N m (N), which damping lets move at "
            f"{force / damping:.2g} rad/s (m/s): {way} takes {slow[worst]:.2g} s."
        )
        names, edits = tuple(of.name("joint", joint) for joint in slow), model.set_each("joint", "damping", values)
        probe = Probe(
            "time that a joint needs for its range against its damping", "s", _slowest, tuple(slow), dynamic=False
        )
        usual = f"{healthy} at the most in healthy models"
        yield Suspect(names, "damping", f"{damping:.3g}", values[worst], edits, probe, limit, says, usual)


def _crosses(of: Simulation, joint: int) -> float:
    """How long in s all that a joint's actuators give takes for its range, or motors for a turn of a hinge without."""
    low, high = of.ranges.get(joint, ENDLESS)
    if of.continuous(joint) and all(of.is_motor(actuator) for actuator in of.drivers.get(joint, ())):
        low, high = 0.0, 2 * math.pi
    force = _forces(of).get(joint, 0.0) if math.isfinite(high - low) else 0.0
    return (high - low) * of.model("dof_damping")[of.dof(joint)] / force if force > 0 else 0.0


def _slowest(of: Simulation, *joints: int) -> float:
    return max(_crosses(of, joint) for joint in joints)


def _rubbed(model: ReaderModel, told: Collection[int]) -> Iterator[Suspect]:
    """The position servos that friction takes a good part of the force of, or all of it, all together."""
    of = model.simulation
    rubbed = {each.joint: each for each in servos(of) if each.joint not in told and _taken(of, each) > TAKEN}
    if not rubbed:
        return
    worst, joints = next(iter(rubbed.values())), list(rubbed)
    friction, value = of.model("dof_frictionloss")[worst.dof], rounded(worst.force / 100)
    says = f"Friction takes {friction:.3g} of the {worst.force:.3g} {worst.force_unit} that its servo can give, "
    says += f"as much as it gives {friction / worst.stiffness:.2g} {worst.unit} off its target."
    names, edits = tuple(of.name("joint", each) for each in joints), model.set("joint", joints, "frictionloss", value)
    probe = Probe("share of a servo's force that friction takes", "", _most_taken, tuple(joints), dynamic=False)
    yield Suspect(names, "frictionloss", f"{friction:.3g}", value, edits, probe, TAKEN, says, "below 0.05 in 38 models")


def _taken(of: Simulation, servo: Servo) -> float:
    """The share of a servo's force that dry friction takes; 0 where it stops near its target.

    Friction above the force lets a joint creep, for its constraint is soft.
    """
    friction = of.model("dof_frictionloss")[servo.dof]
    stops = friction > SHORT * servo.stiffness and math.isfinite(servo.force)
    return friction / servo.force if stops else 0.0


def _most_taken(of: Simulation, *joints: int) -> float:
    return max((_taken(of, each) for each in servos(of) if each.joint in joints), default=0.0)


def _beyond_effort(model: ReaderModel) -> Iterator[Suspect]:
    """Joints of a URDF whose `<dynamics>` resists more than their effort gives, all together by what resists."""
    if not model.urdf or model.simulation.count("actuator"):
        return
    of = model.simulation
    for attribute, resists in (("damping", SLOW), ("frictionloss", 1.0)):
        found = [joint for joint in range(of.count("joint")) if _beyond(of, attribute, joint) * resists > 1]
        if not found:
            continue
        now, effort = of.model(f"dof_{attribute}")[of.dof(found[0])], of.row("jnt_actfrcrange", found[0], 2)[1]
        edits = model.set("joint", found, attribute, f"{effort / 10:.2g}")
        names = tuple(of.name("joint", joint) for joint in found)
        what = "at 1 rad/s (m/s)" if attribute == "damping" else "before it moves"
        says = f"The {attribute} of {names[0]} takes {now:.3g} N m (N) {what}, and its effort is {effort:.3g}."
        probe = Probe("what resists over the effort", "", _most_beyond, (attribute, *found), dynamic=False)
        yield Suspect(names, attribute, f"{now:.3g}", "", edits, probe, 1 / resists, says, "below the effort")


def _beyond(of: Simulation, attribute: str, joint: int) -> float:
    effort = of.row("jnt_actfrcrange", joint, 2)[1]
    if joint not in of.scalar_joints or not of.model("jnt_actfrclimited")[joint] or effort <= 0:
        return 0.0
    return of.model(f"dof_{attribute}")[of.dof(joint)] / effort


def _most_beyond(of: Simulation, attribute: str, *joints: int) -> float:
    return max(_beyond(of, attribute, joint) for joint in joints)


def _forces(simulation: Simulation) -> dict[int, float]:
    """The greatest force of the actuators of each joint, where it is known."""
    made = {joint: pull(simulation, joint) for joint in pulls(simulation)}
    known = {each.actuator: min(each.force, each.stiffness) for each in servos(simulation)}  # a servo 1 rad off
    for actuator in range(simulation.count("actuator")):
        joint = simulation.driven_joint(actuator)
        if joint is None:
            continue
        if actuator not in known:
            ends = simulation.row("actuator_ctrlrange", actuator, 2)
            gear = simulation.gear(actuator)
            if not simulation.model("actuator_ctrllimited")[actuator]:
                continue
            known[actuator] = abs(simulation.gain(actuator)[0] * gear) * max(map(abs, ends))
        made[joint] = made.get(joint, 0.0) + known[actuator]
    return {joint: force for joint, force in made.items() if force > 0}
