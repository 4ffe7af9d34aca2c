"""A servo's `gainprm` is not its `biasprm`: it goes to another place than its control says.

A position servo gives `gainprm[0] ctrl + biasprm[1] length`. Without a load it rests where the two cancel: at `ctrl`
where `biasprm="0 -kp"` has the kp of `gainprm`, and at twice `ctrl` where `gainprm` alone was doubled.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-120 120"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
        </body>
      </worldbody>
      <actuator>
        <general joint="elbow" gainprm="200" biastype="affine" biasprm="0 -100 -10" ctrlrange="-1 1"/>
      </actuator>
    </mujoco>

Good:

    -     <general joint="elbow" gainprm="200" biastype="affine" biasprm="0 -100 -10" ctrlrange="-1 1"/>
    +     <general joint="elbow" gainprm="200" biastype="affine" biasprm="0 -200 -10" ctrlrange="-1 1"/>

The number: where the servo rests over its control: `gainprm[0] / -biasprm[1]`, from 0.2 to 5 and off 1 by more than
2 %. Farther off the control has another unit, such as 0 to 255, but where `ctrlrange` is the joint's own range. Where
its ends are led to those of the joint's range, and where half of the servos have it, it is meant.

When it is wrong: a control that is scaled on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.servo import Servo, greatest, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A gain that is not the servo's bias"
FAMILIES = ("stuck", "passes-limit", "wrong-numbers")
UNPLANTED = "a control that is scaled differs from a slip by intent alone"

OFF, SCALED = 0.02, 5.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The servos whose gain and bias differ by a little, all together."""
    of = model.simulation
    ratios = {each.actuator: _ratio(of, each) for each in servos(of)}
    scaled = {each.actuator for each in servos(of) if _spans(each)}
    found = [each for each, ratio in ratios.items() if abs(ratio - 1) > OFF and 1 / SCALED < ratio < SCALED]
    found = [each for each in found if each not in scaled]
    if len(ratios) > 2 and 2 * len(found) >= len(ratios):
        found = []
    found += [each.actuator for each in servos(of) if meets(of, each) and each.actuator not in found]
    if not found:
        return
    gain, bias = of.gain(found[0])[0], of.bias(found[0])
    says = f"It rests at {ratios[found[0]]:.3g} times its control: gainprm {gain:g}, biasprm {bias[1]:g}."
    edits = model.set_each("actuator", "biasprm", {each: _mended(of, each) for each in found})
    probe = Probe("where a servo rests over its control, off 1 by", "", _off, (found[0],), dynamic=False)
    names, now = tuple(of.name("actuator", each) for each in found), f"{bias[0]:g} {bias[1]:g} {bias[2]:g}"
    yield Suspect(names, "biasprm", now, _mended(of, found[0]), edits, probe, OFF, says, "1", level="hint")


def _mended(of: Simulation, actuator: int) -> str:
    bias = of.bias(actuator)
    return f"{bias[0]:g} {-of.gain(actuator)[0]:g} {bias[2]:g}"


def _spans(servo: Servo) -> bool:
    """Whether the control's range is led to the joint's own: it is scaled on purpose."""
    if servo.targets is None or servo.range is None:
        return False
    (low, high), (least, most) = servo.targets, servo.range
    return max(abs(low - least), abs(high - most)) < OFF * (most - least)


def meets(of: Simulation, servo: Servo) -> bool:
    """Whether the control's range is the joint's, so that the two have one unit, and the servo rests elsewhere."""
    if servo.ctrl is None or servo.range is None or abs(_ratio(of, servo) - 1) <= OFF or _spans(servo):
        return False
    if of.model("jnt_stiffness")[servo.joint]:
        return False
    (low, high), (least, most) = servo.ctrl, servo.range
    return max(abs(low - least), abs(high - most)) < OFF * (most - least)


def _ratio(of: Simulation, servo: Servo) -> float:
    """Where a servo rests, as the actuator's length, over its control."""
    return servo.scale * of.gear(servo.actuator)


def _off(of: Simulation, actuator: int) -> float:
    return greatest(of, lambda each: abs(_ratio(of, each) - 1), [actuator])
