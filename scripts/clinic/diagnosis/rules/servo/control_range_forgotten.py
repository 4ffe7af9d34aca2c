"""All servos have a control range, but for one; or none has.

It was forgotten. The servo takes any target, and one beyond the joint's range, from a policy or a slider, presses the
joint against its limit.

Bad:

    <mujoco>
      <default>
        <joint axis="0 1 0" range="-60 60" damping="1" armature="0.1"/>
        <position kp="100" kv="10"/>
      </default>
      <worldbody>
        <body pos="0 0 1">
          <joint name="a"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
          <body pos="0.2 0 0">
            <joint name="b"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
            <body pos="0.2 0 0">
              <joint name="c"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
              <body pos="0.2 0 0">
                <joint name="d"/>
                <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
      <actuator>
        <position name="a" joint="a" ctrlrange="-1 1"/>
        <position name="b" joint="b" ctrlrange="-1 1"/>
        <position name="c" joint="c"/>
        <position name="d" joint="d" ctrlrange="-1 1"/>
      </actuator>
    </mujoco>

Good:

    -     <position name="c" joint="c"/>
    +     <position name="c" joint="c" ctrlrange="-1 1"/>

The number: how many servos of joints with a range take any target; told are at most two, where three and three times
as many have a control range, or three and more that are all servos of the model: none of the bench's 81 healthy models
is so.

When it is wrong: a servo that is driven by hand alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.servo.control_range_too_wide import inherited
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "One servo without a control range"
FAMILIES = ("passes-limit", "explodes", "stuck")
UNPLANTED = "a servo without a range harms only when it is sent beyond"

FEW, MORE = 2, 3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that take any target, where most others do not."""
    of = model.simulation
    bare = [each for each in servos(of) if each.ctrl is None and each.range]
    others = sum(each.ctrl is not None for each in servos(of))
    if not others and MORE <= len(bare) == len(servos(of)):
        yield _suspect(model, bare, f"None of {len(bare)} servos has a control range: each takes any target.")
    elif len(bare) <= FEW and others >= MORE * max(len(bare), 1):
        yield from (_suspect(model, [each], f"{others} other servos have a control range.") for each in bare)


def _suspect(model: ReaderModel, bare: Sequence[Servo], says: str) -> Suspect:
    """Servos without a control range, each to be given the range of its joint."""
    of = model.simulation
    values = {each.actuator: inherited(each) for each in bare if each.range}
    edits = model.set_each("actuator", "ctrlrange", values)
    names = (*(of.name("actuator", each) for each in values), of.name("joint", bare[0].joint))
    probe = Probe("servos that take any target", "", _bare, dynamic=False)
    value = next(iter(values.values()))
    return Suspect(names, "ctrlrange", "left out", value, edits, probe, 0.0, says, 'inheritrange="1"')


def _bare(of: Simulation) -> float:
    return float(sum(each.ctrl is None and each.range is not None for each in servos(of)))
