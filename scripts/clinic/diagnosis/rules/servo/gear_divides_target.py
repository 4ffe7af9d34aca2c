"""A servo's gear divides its target.

The length of a transmission is gear times the joint's position, and a position servo compares its control with that
length: `gear="10"` moves the joint to a tenth of what it is told, and makes it a hundred times as stiff.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 0 1" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="hinge" gear="10"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="hinge" gear="10"/>
    +     <position joint="hinge" kp="10"/>

The number: the gear of a position servo without a control range; above 1.5 is told. Where the joint and the servo have
ranges, `control-range-too-narrow` says how much of the range is out of reach.

When it is wrong: controls in the angle of the motor, before the gear; so it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.servo.control_range_too_narrow import ungeared
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A gear that divides the servo's target"
FAMILIES = ("sags", "stuck", "oscillates")
LEVEL = "hint"
MOST = 1.5


def _gear(simulation: Simulation, *actuators: int) -> float:
    return max((abs(simulation.gear(each)) for each in actuators), default=0.0)


def _divided(simulation: Simulation, servo: Servo) -> bool:
    plain = abs(abs(servo.scale) * _gear(simulation, servo.actuator) - 1) < 0.01  # the control is a length
    return plain and servo.ctrl is None and _gear(simulation, servo.actuator) > MOST


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Position servos with a gear and no control range, all together."""
    of = model.simulation
    found = [each for each in servos(of) if _divided(of, each)]
    if found:
        numbers = tuple(each.actuator for each in found)
        probe = Probe("gear of position servos", "", _gear, numbers, dynamic=False)
        says = f"It sends {of.name('joint', found[0].joint)} to its control divided by {_gear(of, numbers[0]):g}."
        names = tuple(of.name("actuator", each) for each in numbers)
        edits = tuple(edit for each in found for edit in ungeared(model, each))
        gear = f"{_gear(of, numbers[0]):g}"
        yield Suspect(names, "gear", gear, "1", edits, probe, MOST, says, "1", level="hint")
