"""A servo on a fixed tendon pulls joints past their limits.

A limit is a soft constraint. A target beyond what the joints' ranges and the couplings let the tendon reach, times the
servo's gain, is a force that presses through it: a phalanx bends backwards while another one is at its stop.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="proximal" axis="0 1 0" range="0 90" armature="0.001" damping="0.05"/>
          <geom type="capsule" fromto="0 0 0 0.04 0 0" size="0.008"/>
          <body pos="0.05 0 0">
            <joint name="distal" axis="0 1 0" range="0 90" armature="0.001" damping="0.05"/>
            <geom type="capsule" fromto="0 0 0 0.03 0 0" size="0.008"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="flexor">
          <joint joint="proximal" coef="1"/>
          <joint joint="distal" coef="1"/>
        </fixed>
      </tendon>
      <actuator>
        <position name="bend" tendon="flexor" kp="100" ctrlrange="0 8"/>
      </actuator>
    </mujoco>

Good:

    -     <position name="bend" tendon="flexor" kp="100" ctrlrange="0 8"/>
    +     <position name="bend" tendon="flexor" kp="1" ctrlrange="0 3.1"/>

The number: how much further a joint is beyond a limit after 1 s at an end of the control range, without gravity
and contacts, as a share of its range; above 0.3. The edit is half of the control range, or a half of that, until less
than a third of the excess is left.

When it is wrong: a joint that is meant to give way.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes import tendons
from clinic.diagnosis.probes.servo import alone, hold
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A servo on a tendon pulls joints past their limits"
FAMILIES = ("passes-limit", "stuck")
UNPLANTED = "few healthy models have servos on tendons"

MOST, SECONDS, HALVES = 0.3, 1.0, 6


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each servo on a fixed tendon that presses a joint through its limit."""
    of = model.simulation
    for actuator in range(of.count("actuator")):
        before = _past(of, actuator)
        if before <= MOST:
            continue
        probe = Probe(
            "farthest beyond a limit after 1 s at an end of the control range", "of its range", _past, (actuator,)
        )
        ctrl = of.row("actuator_ctrlrange", actuator, 2)
        for half in range(1, HALVES + 1):
            value = " ".join(f"{each / 2**half:.4g}" for each in ctrl)
            edits = model.set("actuator", [actuator], "ctrlrange", value)
            if not edits or model.measured(probe, edits) <= before / 3:
                break
        tendon = int(of.model("actuator_trnid")[2 * actuator])
        names = of.name("actuator", actuator), of.name("tendon", tendon)
        says = f"At an end of its control range a joint is {100 * before:.0f} % of its range past a limit."
        now = " ".join(f"{each:g}" for each in ctrl)
        yield Suspect(names, "ctrlrange", now, value, edits, probe, MOST, says, "targets within what the joints allow")


@kept
def _past(of: Simulation, actuator: int) -> float:
    """How far a servo on a fixed tendon presses a joint further beyond a limit, as a share of the joint's range."""
    tendon = int(of.model("actuator_trnid")[2 * actuator])
    if tendons.targets(of, actuator) is None or not tendons.joints_of(of, tendon):
        return 0.0
    of.begin()
    before, farthest = _outside(of), 0.0
    with alone(of):
        for ctrl in of.row("actuator_ctrlrange", actuator, 2):
            of.begin()
            hold(of)
            of.engine.write("ctrl", [ctrl], actuator)
            for _ in of.run(SECONDS, samples=5):
                if of.unstable():
                    return math.inf
            farthest = max(farthest, *(now - then for now, then in zip(_outside(of), before, strict=True)), 0.0)
    return farthest


def _outside(of: Simulation) -> list[float]:
    """How far each hinge and slide with a range is beyond it, as a share of it."""
    places = [(of.position(joint), *ends) for joint, ends in of.ranges.items()]
    return [max(low - place, place - high, 0.0) / (high - low) for place, low, high in places]
