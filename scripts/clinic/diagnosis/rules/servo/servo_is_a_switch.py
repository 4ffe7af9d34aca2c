"""A servo's gain is so high, and its force so small, that it only switches from one end of its force to the other.

With `kp="1000000"` and `forcerange="-20 20"` a finger gives all of its force at an error of 0.02 mm. Within one
timestep it goes farther than that, so that the force turns at every step.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 0.5">
          <joint name="finger" type="slide" axis="0 1 0" range="0 0.04" damping="100"/>
          <geom type="box" size="0.01 0.01 0.03" mass="0.1"/>
        </body>
      </worldbody>
      <actuator>
        <position name="finger" joint="finger" kp="1000000" ctrlrange="0 0.04" forcerange="-20 20"/>
      </actuator>
    </mujoco>

Good:

    -     <position name="finger" joint="finger" kp="1000000" ctrlrange="0 0.04" forcerange="-20 20"/>
    +     <position name="finger" joint="finger" kp="1000" ctrlrange="0 0.04" forcerange="-20 20"/>

The number: told in the middle of the joint's range without contacts, in how many of the last steps of 0.2 s the force
is at an end of its range and turns; more than 0.3. h^2 kp / M is above 4 there, where the explicit integration of a
spring ends. A velocity gain does the same above h kv / M = 2 once the joint is so fast that its force is at an end:
`implicit` and `implicitfast` too are explicit in a force that is clamped. There the joint begins with 1.2 times that
speed, and what lacks is `armature`. It is told from 5 on: the wrist of a Panda has 2.8.

When it is wrong: a relay that is meant.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from clinic.diagnosis.probes.servo import Servo, alone, command, hold, servo_of, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A servo that switches from end to end of its force"
FAMILIES = ("oscillates", "slips")
UNPLANTED = "a gain that high is planted as one that is too high for the inertia"

STIFF, SWIFT, TURNS = 4.0, 5.0, 0.3
TIME = 0.2  # s
WELL = 0.1  # of what the step bears
FASTER = 1.2  # times the speed at which the force of the velocity gain is all that it can give


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos with a force range whose gains the timestep does not bear."""
    of = model.simulation
    for servo in servos(of):
        stiff, swift = of.timestep**2 * servo.stiffness / servo.inertia, of.timestep * _kv(of, servo) / servo.inertia
        if servo.force == float("inf") or (stiff <= STIFF and swift <= SWIFT):
            continue
        name, title = of.name("actuator", servo.actuator), "steps in which the force turns from end to end"
        probe = Probe(title, "of 0.2 s", _turns, (servo.actuator, stiff <= STIFF))
        unit = servo.force_unit
        if stiff > STIFF:
            kp = of.gain(servo.actuator)[0]
            value = rounded(kp * WELL / stiff)
            written = model.value("actuator", servo.actuator, "kp") is not None
            edits = model.set("actuator", [servo.actuator], "kp", value) if written else ()
            says = f"Its {servo.force:.3g} {unit} are reached {servo.force / servo.stiffness:.2g} "
            says += f"{servo.unit} off its target, and timestep^2 x kp / inertia is {stiff:.3g}."
            well = "timestep^2 x kp / inertia < 4 (explicit integration)"
            yield Suspect((name,), "kp", f"{kp:g}", value, edits, probe, TURNS, says, well)
            continue
        armature = of.model("dof_armature")[servo.dof]
        value = rounded(armature + of.timestep * _kv(of, servo) - servo.inertia)
        edits = model.set("joint", [servo.joint], "armature", value)
        says = f"Its {servo.force:.3g} {unit} are reached at {servo.force / _kv(of, servo):.2g} {servo.unit}/s, and "
        says += f"timestep x kv / inertia is {swift:.3g}: once it is faster, the force turns at every step."
        names = (of.name("joint", servo.joint), name)
        well = "timestep x kv / inertia < 2 (explicit where the force is clamped)"
        yield Suspect(names, "armature", f"{armature:g}", value, edits, probe, TURNS, says, well)


def _kv(of: Simulation, servo: Servo) -> float:
    """The velocity gain at the joint, without the joint's own damping."""
    return servo.damping - of.model("dof_damping")[servo.dof]


def _turns(of: Simulation, actuator: int, pushed: bool) -> float:
    """In how many of the steps the force turns from one end of its range to the other, of those of half the time."""
    servo = servo_of(of, actuator)
    if servo is None:
        return 0.0
    of.begin()
    low, high = servo.range or (of.position(servo.joint), of.position(servo.joint))
    with alone(of):
        if pushed:
            hold(of)
            of.engine.write("qvel", [FASTER * servo.force / max(_kv(of, servo), 1e-9)], servo.dof)
        else:
            command(of, servo, (low + high) / 2)
        forces = []
        for _ in range(of.steps(TIME)):
            of.engine.step()
            forces.append(of.data("actuator_force")[servo.actuator])
    last = forces[len(forces) // 2 :]
    most = 0.9 * max(map(abs, last), default=0.0)
    turned = sum(one * other < 0 and min(abs(one), abs(other)) >= most for one, other in pairwise(last))
    return turned / max(len(last), 1)
