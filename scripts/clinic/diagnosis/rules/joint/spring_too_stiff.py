"""A joint's spring is stiffer than the timestep allows.

MuJoCo integrates the force of a joint's spring explicitly with every integrator but `discrete`. What swings faster than
the timestep can follow gains energy at each step until the simulation ends.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0" stiffness="2000"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01" mass="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="hinge" axis="0 1 0" stiffness="2000"/>
    +       <joint name="hinge" axis="0 1 0" stiffness="20" damping="0.05"/>

The number: with the timestep h, stiffness k and inertia M of the joint, h sqrt(k / M) must stay below 2 (2.8 with
`RK4`), without damping, for the fastest mode of the whole chain, which is at least as fast as each joint alone. Joints
of one stiffness get one again. It is the timestep that is too long where 2 ms suffice.

When it is wrong: a timestep of a few hundred microseconds for a stiff mechanism is a choice as good as a softer spring.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import DEFAULT_TIMESTEP
from clinic.diagnosis.probes.run import FAST, fastest
from clinic.diagnosis.probes.shake import SHAKES, shake
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A spring too stiff for the timestep"
FAMILIES = ("explodes", "oscillates")
CASE = "arm-explodes"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges and slides whose springs are near what one joint alone allows, all together."""
    simulation = model.simulation
    step, stiffness, mass = simulation.timestep, simulation.model("jnt_stiffness"), simulation.mass_diagonal
    found: dict[int, float] = {}
    for joint, each in enumerate(stiffness):
        if each > 0 and joint in simulation.scalar_joints:
            rate = (each / max(mass[simulation.dof(joint)], 1e-12)) ** 0.5
            if min(step, DEFAULT_TIMESTEP) * rate > 0.6:  # a chain's fastest mode is up to three times as fast
                found[joint] = rate
    if not found:
        return
    stiffest = max(found, key=lambda joint: found[joint])
    probe = next((each for each in (fastest(), shake()) if model.measured(each) > FAST), shake())
    softer = {joint: f"{stiffness[joint] * (0.2 / (step * rate)) ** 2:.1g}" for joint, rate in found.items()}
    if len(found) > 1 and len({stiffness[joint] for joint in found}) == 1:  # one number, that of a class or a chain
        softer = dict.fromkeys(found, softer[stiffest])
    edits = model.set_each("joint", "stiffness", softer)
    yield Suspect(
        tuple(simulation.name("joint", each) for each in found),
        "stiffness",
        f"{stiffness[stiffest]:g}",
        next((each.value for each in edits), ""),
        edits,
        probe,
        FAST if probe == fastest() else SHAKES,
        f"{simulation.name('joint', stiffest)} alone swings at {found[stiffest]:.3g} rad/s; a timestep of {step:g} s "
        f"follows less than {2 / step:.3g} rad/s, and a chain's fastest swing is at least as fast as each joint's.",
        "timestep x sqrt(stiffness / inertia) < 2 (explicit integration of a spring)",
        share=0.1,
        excess=1 + step * found[stiffest] / 2,
    )
