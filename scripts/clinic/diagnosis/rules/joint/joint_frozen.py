"""A joint's damping or dry friction is more than its actuators can move.

`frictionloss` above the greatest force of the actuators holds a joint for good; `damping` lets it go at no more than
force / damping.

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

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-90 90" damping="0.5"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="elbow" ctrlrange="-1 1" gear="5"/>
      </actuator>
    </mujoco>

The number: driven for 2 s with all that its actuators give, without gravity and contacts, more than 80 % of the way to
1 rad (0.1 m), or to the far limit, is left.

When it is wrong: a brake, or a worm gear that is meant to hold.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.drive import way_left
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect

TITLE = "Damping or friction holds a joint"
FAMILIES = ("stuck", "sags")
SINCE = "0.2"

SLOW = 0.5  # rad/s or m/s that full force reaches
LEFT = 0.8


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Joints that full force does not move, by damping and by friction."""
    simulation = model.simulation
    for attribute, resists in (("damping", SLOW), ("frictionloss", 1.0)):
        held = simulation.model(f"dof_{attribute}")
        found = [
            joint
            for joint, force in _forces(simulation).items()
            if held[simulation.dof(joint)] * resists > force and model.measured(way_left((joint,))) > LEFT
        ]
        if not found:
            continue
        edits: tuple[Edit, ...] = ()
        for joint in found:
            force = _forces(simulation)[joint]
            edits += model.set("joint", [joint], attribute, f"{force / 5:.2g}" if attribute == "damping" else "0")
        force, now = _forces(simulation)[found[0]], held[simulation.dof(found[0])]
        can = f"{force / now:.2g} rad/s (m/s) at most" if attribute == "damping" else "nothing"
        yield Suspect(
            tuple(simulation.name("joint", each) for each in found),
            attribute,
            f"{now:.3g}",
            next((each.value for each in edits), ""),
            edits,
            way_left(tuple(found)),
            LEFT,
            f"The actuators of {simulation.name('joint', found[0])} give {force:.3g} N m (N), "
            f"which moves it with {can}.",
            "full force that reaches 1 rad/s and more",
        )


def _forces(simulation: Simulation) -> dict[int, float]:
    """The greatest force of the actuators of each joint, where it is known."""
    made: dict[int, float] = {}
    known = {each.actuator: min(each.force, each.stiffness) for each in servos(simulation)}  # a servo 1 rad off
    for actuator in range(simulation.count("actuator")):
        joint = simulation.driven_joint(actuator)
        if joint is None:
            continue
        if actuator not in known:
            gain = simulation.model("actuator_gainprm")
            ends = simulation.row("actuator_ctrlrange", actuator, 2)
            gear = simulation.model("actuator_gear")[6 * actuator]
            if not simulation.model("actuator_ctrllimited")[actuator]:
                continue
            known[actuator] = abs(gain[len(gain) // simulation.count("actuator") * actuator] * gear) * max(
                map(abs, ends)
            )
        made[joint] = made.get(joint, 0.0) + known[actuator]
    return {joint: force for joint, force in made.items() if force > 0}
