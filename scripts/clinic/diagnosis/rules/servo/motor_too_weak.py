"""A motor that takes seconds to set its joint moving.

`ctrlrange` times `gear`, or `forcerange` times it, is the most that a motor gives. On a mass that was left to its
geoms' density, or with a gear that was forgotten, it barely moves what it drives.

Bad:

    <mujoco>
      <worldbody>
        <body>
          <joint name="x" type="slide" axis="1 0 0" damping="1"/>
          <geom type="capsule" size="0.1 0.1" euler="0 90 0"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="x" ctrlrange="-3 3"/>
      </actuator>
    </mujoco>

Good:

    -     <motor joint="x" ctrlrange="-3 3"/>
    +     <motor joint="x" ctrlrange="-3 3" gear="100"/>

The number: the inertia at the joint over the motor's greatest force or torque, more than 1 s2/m or 1 s2/rad: it takes
a second and more to 1 m/s or 1 rad/s. Of the 289 healthy models one robot's have such a joint. Of a velocity servo the
greatest load of the joint's weight over kv times the greatest control: more than 1.

When it is wrong: large things that are meant to be slow.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import BIAS_AFFINE
from clinic.diagnosis.probes.load import loads
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A motor too weak for what it moves"
FAMILIES = ("stuck", "sags", "slow")
UNPLANTED = "how fast a joint should be, its maker knows"

SLOW = 1.0  # s2/m, s2/rad


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The motors with a limit that barely move their joints, all together, and velocity servos below the weight."""
    yield from _unlifted(model)
    of = model.simulation
    slow = {joint: value for joint, value in _slow(of).items() if value > SLOW}
    if not slow:
        return
    found = [each for each in range(of.count("actuator")) if of.driven_joint(each) in slow]
    joint = max(slow, key=lambda each: slow[each])
    worst = next(each for each in found if of.driven_joint(each) == joint)
    gear, unit = of.gear(worst), of.unit(joint)
    yield Suspect(
        tuple(of.name("actuator", each) for each in found),
        "gear",
        f"{gear:g}",
        rounded(10 * gear * slow[joint]),
        (),
        Probe("inertia over the motor's force", f"s2/{unit}", _slow_of, (joint,), dynamic=False),
        SLOW,
        f"{of.name('joint', joint)} gains {1 / slow[joint]:.2g} {unit}/s in a second at full control.",
        "1.5 m/s2 and 1.5 rad/s2 are the least of healthy models but one",
    )


def _unlifted(model: ReaderModel) -> Iterator[Suspect]:
    """Velocity servos that give less at their greatest speed error than the weight asks for."""
    of = model.simulation
    found = [each for each in range(of.count("actuator")) if _burden(of, each) > 1]
    if not found:
        return
    worst = max(found, key=lambda each: _burden(of, each))
    kv, joint = of.gain(worst)[0], of.name("joint", of.driven_joint(worst) or 0)
    most = _strongest(of, worst)
    value = rounded(10 * kv * _burden(of, worst))
    says = f"Against a {joint} that stands still it gives {most:.3g} N m (N) at most: kv times the greatest control. "
    says += f"The weight asks for {_burden(of, worst):.2g} times as much."
    probe = Probe("weight over what a velocity servo gives", "", _burden, (worst,), dynamic=False)
    names = tuple(of.name("actuator", each) for each in found)
    edits = model.set("actuator", found, "kv", value)
    yield Suspect(names, "kv", f"{kv:g}", value, edits, probe, 1, says, "well above the weight", level="hint")


def _strongest(of: Simulation, actuator: int) -> float:
    """What a velocity servo gives while its joint stands, at its greatest control."""
    most = -of.bias(actuator)[2] * max(map(abs, of.row("actuator_ctrlrange", actuator, 2)))
    limited = of.model("actuator_forcelimited")[actuator]
    return min(most, max(map(abs, of.row("actuator_forcerange", actuator, 2)))) if limited else most


def _burden(of: Simulation, actuator: int) -> float:
    """The greatest load of a joint's weight over what its velocity servo gives while it stands; 0 for what is none."""
    joint, bias = of.driven_joint(actuator), of.bias(actuator)[:3]
    velocity = int(of.model("actuator_biastype")[actuator]) == BIAS_AFFINE and not any(bias[:2]) and bias[2] < 0
    if joint is None or not velocity or not of.model("actuator_ctrllimited")[actuator] or len(of.drivers[joint]) > 1:
        return 0.0
    if of.model("jnt_stiffness")[joint] or of.count("equality") or of.count("tendon"):
        return 0.0
    most = _strongest(of, actuator) * abs(of.gear(actuator))
    held = loads(of)[of.dof(joint)] - of.model("dof_frictionloss")[of.dof(joint)]
    return held / most if most > 0 else 0.0


def _slow_of(of: Simulation, joint: int) -> float:
    return _slow(of).get(joint, 0.0)


def _slow(of: Simulation) -> dict[int, float]:
    """Inertia over the force of all that drives a joint, of joints that limited motors alone drive."""
    forces = {joint: sum(_force(of, each) for each in own) for joint, own in of.drivers.items()}
    return {joint: of.mass_diagonal[of.dof(joint)] / force for joint, force in forces.items() if 0 < force < math.inf}


def _force(of: Simulation, actuator: int) -> float:
    """The most that an actuator gives at its joint; infinite where it is no motor, or has no limit."""
    if not of.is_motor(actuator):
        return math.inf
    gain = of.gain(actuator)[0]
    limits = [math.inf]
    if of.model("actuator_ctrllimited")[actuator]:
        limits.append(abs(gain) * max(map(abs, of.row("actuator_ctrlrange", actuator, 2))))
    if of.model("actuator_forcelimited")[actuator]:
        limits.append(max(map(abs, of.row("actuator_forcerange", actuator, 2))))
    return min(limits) * abs(of.gear(actuator))
