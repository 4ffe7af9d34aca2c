"""A wheel, or what else turns round and round, does not get near the speed that its servo is told.

A velocity servo gives kv times the error of the speed. Where that is less than friction and damping at a small error,
the wheel turns slowly whatever is asked: kv is too small, or the joint's `damping` too large.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03" mass="3"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint name="left_wheel" axis="0 1 0" damping="5"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0" mass="0.3"/>
          </body>
          <body name="right_wheel" pos="0 -0.15 0">
            <joint name="right_wheel" axis="0 1 0" damping="5"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0" mass="0.3"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <velocity joint="left_wheel" kv="0.2" ctrlrange="-20 20"/>
        <velocity joint="right_wheel" kv="0.2" ctrlrange="-20 20"/>
      </actuator>
    </mujoco>

Good:

    -         <joint name="left_wheel" axis="0 1 0" damping="5"/>
    +         <joint name="left_wheel" axis="0 1 0" damping="0.01"/>

    -         <joint name="right_wheel" axis="0 1 0" damping="5"/>
    +         <joint name="right_wheel" axis="0 1 0" damping="0.01"/>

The number: all velocity servos of hinges without limits are told half of their greatest speed; the share of it that is
missing after 2 s, of the fastest wheel. Above 0.8 is told, and above 0.4 where kv times twice the greatest speed, which
a full reversal asks for, is less than a fifth of the servo's force limit, or where damping alone takes more than that
limit at the speed that is told. Where a servo gives three times what speeds up its part of the model in that time,
against friction, damping and weight, its force is not what is missing, and neither kv nor `forcerange` is told.

When it is wrong: a robot that stands against something, or wheels that are meant to be slow.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import BIAS_AFFINE
from clinic.diagnosis.probes.load import loads
from clinic.diagnosis.probes.servo import speed_gain
from clinic.diagnosis.probes.shape import size
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A joint far below the speed it is told"
FAMILIES = ("stuck", "slow")
UNPLANTED = "nearly no healthy model has velocity servos of wheels"

MISSING, HALF, SECONDS, MORE = 0.8, 0.5, 2.0, 20.0
LATE, ASKED = 0.4, 0.2  # of the speed, of the force: less is asked of a servo that needs seconds
AMPLE = 3.0  # times what speeds it up


@dataclass(frozen=True)
class Wheel:
    """A hinge without limits and its velocity servo: kv at the joint in N m s/rad, and the greatest speed in rad/s."""

    actuator: int
    joint: int
    gain: float
    fastest: float


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The wheels of a model, where none comes near to what it is told."""
    of = model.simulation
    wheels = _wheels(of)
    allowed = LATE if all(_asked(of, each) < ASKED or _braked(of, each) for each in wheels) else MISSING
    if not wheels or _missing(of) <= allowed:
        return
    damping = of.model("dof_damping")[of.dof(wheels[0].joint)]
    joints, actuators = [each.joint for each in wheels], [each.actuator for each in wheels]
    most = of.row("actuator_forcerange", actuators[0], 2)[1]
    limited = bool(of.model("actuator_forcelimited")[actuators[0]])
    names = tuple(
        name for each in wheels for name in (of.name("joint", each.joint), of.name("actuator", each.actuator))
    )
    who = "the fastest of them" if len(wheels) > 1 else names[0]
    says = f"Told {HALF * wheels[0].fastest:.3g} rad/s, {who} misses {100 * _missing(of):.0f} % after 2 s: "
    says += f"kv is {wheels[0].gain:.3g}, damping {damping:.3g}" + f", the greatest force {most:.3g}" * limited + "."
    probe = Probe("share of the speed that is missing", "", _missing)
    for attribute, now, value, edits in (
        ("damping", damping, text := rounded(wheels[0].gain / MORE), model.set("joint", joints, "damping", text)),
        *(
            ("kv", wheels[0].gain, text := rounded(more * wheels[0].gain), model.set("actuator", actuators, "kv", text))
            for more in (MORE, MORE**2)
        ),
        ("forcerange", most, text := rounded(MORE * most), _forces(model, actuators, text) if limited else ()),
    ):
        helps = edits and (damping > wheels[0].gain if attribute == "damping" else not _ample(of, wheels))
        if helps and model.measured(probe, edits) <= allowed:  # else something else holds it
            yield Suspect(names, attribute, f"{now:.3g}", value, edits, probe, allowed, says, "next to nothing")
            return


def _ample(of: Simulation, wheels: list[Wheel]) -> bool:
    """Whether the first servo gives by far what its part of the model needs to reach its speed in time."""
    wheel, speed = wheels[0], HALF * wheels[0].fastest
    dof, limited = of.dof(wheel.joint), bool(of.model("actuator_forcelimited")[wheel.actuator])
    most = of.row("actuator_forcerange", wheel.actuator, 2)[1] * abs(of.gear(wheel.actuator))
    rolls = of.moving_mass / len(wheels) * size(of, of.body_of("joint", wheel.joint)) ** 2
    needs = (rolls + of.mass_diagonal[dof]) * speed / SECONDS + of.model("dof_damping")[dof] * speed
    needs += of.model("dof_frictionloss")[dof] + loads(of)[dof]
    return min(wheel.gain * speed, most if limited else math.inf) > AMPLE * needs


def _forces(model: ReaderModel, actuators: list[int], most: str) -> tuple[Edit, ...]:
    return model.set("actuator", actuators, "forcerange", f"-{most} {most}")


def _wheels(of: Simulation) -> list[Wheel]:
    made = []
    for actuator in range(of.count("actuator")):
        joint = of.driven_joint(actuator)
        limited = of.model("actuator_ctrllimited")[actuator]
        if joint is None or not limited or int(of.model("actuator_biastype")[actuator]) != BIAS_AFFINE:
            continue
        gain = speed_gain(of, actuator)
        gear = of.gear(actuator)
        fastest = of.row("actuator_ctrlrange", actuator, 2)[1]
        if of.continuous(joint) and gain and gear and fastest > 0:
            made.append(Wheel(actuator, joint, gain * gear**2, fastest / abs(gear)))
    return made


def _asked(of: Simulation, wheel: Wheel) -> float:
    """The share of its greatest force that a servo asks for at most; 1 where nothing limits it."""
    most = max(map(abs, of.row("actuator_forcerange", wheel.actuator, 2))) * abs(of.gear(wheel.actuator))
    limited = of.model("actuator_forcelimited")[wheel.actuator] and most > 0
    return 2 * wheel.gain * wheel.fastest / most if limited else 1.0


def _braked(of: Simulation, wheel: Wheel) -> bool:
    """Whether damping takes more at the speed that is told than a servo with a limit can give."""
    most = max(map(abs, of.row("actuator_forcerange", wheel.actuator, 2))) * abs(of.gear(wheel.actuator))
    takes = of.model("dof_damping")[of.dof(wheel.joint)] * HALF * wheel.fastest
    return bool(of.model("actuator_forcelimited")[wheel.actuator]) and takes > most


def _missing(of: Simulation) -> float:
    """The share of what the fastest wheel was told that it lacks at its fastest in the second half; 0 without wheels.

    Not at the end: a car that drives well may have met a wall by then.
    """
    wheels, least = _wheels(of), 1.0
    of.begin()
    for each in wheels:
        of.engine.write("ctrl", [HALF * of.row("actuator_ctrlrange", each.actuator, 2)[1]], each.actuator)
    for time in of.run(SECONDS, samples=10):
        if of.unstable():
            return 0.0
        speeds = of.data("qvel")
        missed = [1 - abs(speeds[of.dof(each.joint)]) / (HALF * each.fastest) for each in wheels]
        least = min([least, *missed]) if time > 0.45 * SECONDS else least
    return least if wheels else 0.0
