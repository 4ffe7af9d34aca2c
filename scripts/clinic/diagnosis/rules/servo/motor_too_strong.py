"""A motor spins its joint up to thousands of rad/s.

A gear of 1000 where N mm were meant, or the torque limit of a leg at a wheel: full control turns the joint so fast
that nothing can be controlled, and wheels spin or the robot flips.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0" damping="0.01"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.02" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="hinge" gear="1000" ctrlrange="-2 2"/>
      </actuator>
    </mujoco>

Good:

    -     <motor joint="hinge" gear="1000" ctrlrange="-2 2"/>
    +     <motor joint="hinge" gear="1" ctrlrange="-2 2"/>

The number: the speed in rad/s that the greatest force of a motor gives its hinge within 0.2 s at the inertia of the
start, or that damping lets it reach, if that is less; more than 1000, where no range ends it.

When it is wrong: a spindle or a gyroscope. What is called so, or a propeller, is left alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A motor far too strong for its joint"
FAMILIES = ("explodes", "oscillates", "slips")
UNPLANTED = "a gear that is too large by a hundred is planted as that of a pair"

FAST, USUAL, SECONDS = 1000.0, 300.0, 0.2  # rad/s, rad/s, s
SPINS = re.compile(r"prop|rotor|blade|fan(?![a-z])|spindle|spinner|gyro|flywheel|turbine|drill", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The motors that spin their joints too fast, all together."""
    of = model.simulation
    fast = {each: speed for each, speed in _speeds(of).items() if speed > FAST}
    if not fast:
        return
    worst = max(fast, key=lambda each: fast[each])
    gear = of.gear(worst)
    low, high = of.row("actuator_ctrlrange", worst, 2)
    attribute = "gear" if abs(gear) > max(abs(low), abs(high)) else "ctrlrange"
    numbers, less = ([gear] if attribute == "gear" else [low, high]), USUAL / fast[worst]
    now, value = " ".join(f"{x:g}" for x in numbers), " ".join(rounded(less * x) for x in numbers)
    says = f"Full control brings {of.name('joint', of.driven_joint(worst) or 0)} to {fast[worst]:.0f} rad/s within "
    says += f"{SECONDS:g} s."
    probe = Probe("speed that full control gives a hinge within 0.2 s", "rad/s", _fastest, dynamic=False)
    names = tuple(of.name("actuator", each) for each in fast)
    yield Suspect(names, attribute, now, value, (), probe, FAST, says, f"below {USUAL:g} rad/s")


def _fastest(of: Simulation) -> float:
    return max(_speeds(of).values(), default=0.0)


def _speeds(of: Simulation) -> dict[int, float]:
    """By motor of a hinge without a range: the speed in rad/s that full control gives it."""
    made = {}
    for each in range(of.count("actuator")):
        joint = of.driven_joint(each)
        plain = not any(of.actuator_types(each)[1:])
        if joint is None or not of.continuous(joint) or not plain or not of.model("actuator_ctrllimited")[each]:
            continue
        if SPINS.search(f"{of.name('joint', joint)} {of.name('actuator', each)}"):
            continue
        force = abs(of.gain(each)[0]) * max(map(abs, of.row("actuator_ctrlrange", each, 2)))
        if of.model("actuator_forcelimited")[each]:
            force = min(force, max(map(abs, of.row("actuator_forcerange", each, 2))))
        torque = force * abs(of.gear(each))
        dof = of.dof(joint)
        damping, inertia = of.model("dof_damping")[dof], of.mass_diagonal[dof]
        made[each] = min(SECONDS * torque / max(inertia, 1e-12), torque / damping if damping > 0 else float("inf"))
    return made
