"""One coefficient of a fixed tendon is many times larger than all others of the model.

A decimal point that was lost, or one coefficient in rad among others in degrees: the tendon hangs on that joint alone,
and what it limits or drives hardly sees the others.

Bad:

    <mujoco>
      <worldbody>
        <body name="finger" pos="0 0 1">
          <joint name="base" axis="0 1 0" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01"/>
          <body name="middle" pos="0.05 0 0">
            <joint name="middle" axis="0 1 0" range="-90 90"/>
            <geom type="capsule" fromto="0 0 0 0.04 0 0" size="0.01"/>
            <body name="tip" pos="0.04 0 0">
              <joint name="tip" axis="0 1 0" range="-90 90"/>
              <geom type="capsule" fromto="0 0 0 0.03 0 0" size="0.01"/>
            </body>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="flexor">
          <joint joint="base" coef="0.018"/>
          <joint joint="middle" coef="1.3"/>
          <joint joint="tip" coef="0.011"/>
        </fixed>
      </tendon>
    </mujoco>

Good:

    -       <joint joint="middle" coef="1.3"/>
    +       <joint joint="middle" coef="0.013"/>

The number: the size of the largest coefficient over that of the next, of all fixed tendons of the model together, which
have three at least; more than 8.

When it is wrong: a transmission with one large ratio.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.tendons import joints_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A tendon's coefficient unlike the others"
FAMILIES = ("stuck", "wrong-numbers", "oscillates")
UNPLANTED = "few healthy models have three coefficients"

ENOUGH, TIMES = 3, 8.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The one coefficient that is far larger than all others."""
    of = model.simulation
    found = _coefficients(of)
    if len(found) < ENOUGH or (times := _times(of)) <= TIMES:
        return
    largest, tendon, which = found[-1]
    middle = found[len(found) // 2][0]
    joint, signed = joints_of(of, tendon)[which]
    element = model.element("tendon", tendon)
    parts = [each for each in element.children if each.tag == "joint"] if element is not None else []
    value = f"{signed / 10.0 ** round(math.log10(largest / middle)):.6g}"
    edits = (set_attribute(parts[which], "coef", value),) if which < len(parts) else ()
    says = f"Its coefficient of {of.name('joint', joint)} is {times:.3g} times that of any other in the model."
    probe = Probe("largest coefficient of a fixed tendon over the next", "times", _times, dynamic=False)
    yield Suspect((of.name("tendon", tendon),), "coef", f"{signed:g}", value, edits, probe, TIMES, says, "below 8")


def _times(of: Simulation) -> float:
    found = _coefficients(of)
    return found[-1][0] / found[-2][0]


def _coefficients(of: Simulation) -> list[tuple[float, int, int]]:
    """The sizes of all coefficients but 0, the smallest first, with their tendon and place in it."""
    return sorted(
        (abs(coefficient), tendon, which)
        for tendon in range(of.count("tendon"))
        for which, (_, coefficient) in enumerate(joints_of(of, tendon))
        if coefficient
    )
