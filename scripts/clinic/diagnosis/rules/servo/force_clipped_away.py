"""An actuator's force range leaves nothing of its force: it pulls, and may only push.

What can only pull has `forcerange="-20 0"`, and controls that ask for such a force. With the sign of one and not of the
other every force is clipped to zero, and the control changes nothing. The force range is that of the actuator, before
the gear.

Bad:

    <mujoco>
      <worldbody>
        <body name="finger" pos="0 0 1">
          <joint name="knuckle" axis="0 1 0" range="-90 0"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01"/>
        </body>
      </worldbody>
      <actuator>
        <motor name="flexor" joint="knuckle" ctrlrange="-1 0" forcerange="0 20"/>
      </actuator>
    </mujoco>

Good:

    -     <motor name="flexor" joint="knuckle" ctrlrange="-1 0" forcerange="0 20"/>
    +     <motor name="flexor" joint="knuckle" ctrlrange="-1 0" forcerange="-20 0"/>

The number: actuators without a spring or damper of their own whose forces at both ends of their control range are
clipped to the same.

When it is wrong: an actuator that is switched off in this way.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import DYN_MUSCLE
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A force range that leaves no force"
FAMILIES = ("stuck",)
UNPLANTED = "no healthy model has an actuator that may only push or pull"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each such actuator, with the range of the other sign where that leaves some."""
    of = model.simulation
    for actuator in range(of.count("actuator")):
        if not _nothing(of, actuator):
            continue
        low, high = of.row("actuator_forcerange", actuator, 2)
        forces = sorted(_forces(of, actuator))
        says = f"Its controls ask for {forces[0]:.3g} to {forces[1]:.3g}, and it may give {low:.3g} to {high:.3g}."
        value, edits = "one that the force is in", tuple[Edit, ...]()
        if forces[0] < -low and forces[1] > -high:
            value = written((-high, -low))
            edits = model.set("actuator", [actuator], "forcerange", value)
        probe = Probe("actuators whose force is clipped to one number", "", _nothing, (actuator,), dynamic=False)
        name, now, healthy = of.name("actuator", actuator), written((low, high)), "a range that the force is in"
        yield Suspect((name,), "forcerange", now, value, edits, probe, 0.5, says, healthy, level="hint")


def _nothing(of: Simulation, actuator: int) -> float:
    """1 where both ends of the controls give the same clipped force, else 0."""
    limited = of.model("actuator_forcelimited")[actuator] and of.model("actuator_ctrllimited")[actuator]
    biased = int(of.model("actuator_biastype")[actuator]) or int(of.model("actuator_dyntype")[actuator]) == DYN_MUSCLE
    if not limited or biased:
        return 0.0
    low, high = of.row("actuator_forcerange", actuator, 2)
    asked = _forces(of, actuator)
    given = [min(max(force, low), high) for force in asked]
    return float(asked[0] != asked[1] and given[0] == given[1])


def _forces(of: Simulation, actuator: int) -> list[float]:
    return [of.gain(actuator)[0] * ctrl for ctrl in of.row("actuator_ctrlrange", actuator, 2)]
