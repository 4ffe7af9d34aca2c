"""A servo's control range goes far beyond the range of its joint.

A joint's limit is soft: a servo whose target lies far beyond it presses with kp times the distance, and the joint
passes its limit.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="finger" axis="0 1 0" range="0 90" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="finger" kp="20" ctrlrange="-3 5"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="finger" kp="20" ctrlrange="-3 5"/>
    +     <position joint="finger" kp="20" inheritrange="1"/>

The number: after 1 s at each end of the control range the joint is more than 30 % of its range beyond a limit; or
a hinge's targets lie more than 120 % of its range beyond (0.56 is the most in 55 healthy models with servos). A hint
tells of some servos among others with targets more than 25 % of the range beyond, and of slides with a limited force
from 50 times the range on.

Where the range is a tenth of the targets, and these end at whole multiples of 5 degrees as it does not, the range has a
misplaced point, and it is told instead.

When it is wrong: a target beyond the limit as a way to command a force, as grippers do.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.press import past_limit
from clinic.diagnosis.probes.servo import Servo, greatest, servos
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.servo.control_range_unlike_range import of_image
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Probe, Suspect

TITLE = "The control range goes beyond the joint's range"
FAMILIES = ("passes-limit", "stuck", "explodes")
LEVEL = "hint"
CASE = "finger-passes-its-limit"

BEYOND = 0.25  # of the joint's range
PAST = 0.3
FAR = 1.2  # of the joint's range
MILLIMETRES = 50.0  # of the joint's range: a finger squeezes with a target that is less far
TITLE_OF_FAR = "how far targets lie beyond a limit, as a share of the joint's range"
CLOSE, EXACT = 1e-3, 0.02  # of a target, degrees
NARROW = 0.12  # rad: a range of radians that was read as degrees


def beyond(servo: Servo) -> float:
    """How far the targets of a servo go beyond its joint's range, as a share of it."""
    if servo.targets is None or servo.range is None or servo.range[1] <= servo.range[0]:
        return 0.0
    (low, high), (least, most) = servo.targets, servo.range
    return max(least - low, high - most) / (most - least)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges with targets far out, and servos that push their joints past a limit."""
    simulation = model.simulation
    wide = [each for each in servos(simulation) if beyond(each) > BEYOND and not _of_the_joint(each)]
    wide = [each for each in wide if not of_image(simulation, each)]
    shifted = [each for each in wide if _tenth(each)]
    wide = [each for each in wide if each not in shifted]
    yield from (_range(model, each) for each in shifted)
    far = [each for each in wide if each.hinge and beyond(each) > FAR and not _amplified(model, each)]
    rest = [each for each in wide if each not in far]
    rest = rest if rest and model.measured(past_limit([each.actuator for each in rest])) > PAST else []
    if rest:
        rest = [each for each in rest if model.measured(past_limit([each.actuator])) > PAST]
        yield from _suspect(model, rest, past_limit([each.actuator for each in rest]), PAST)
    yield from _suspect(model, far, _farthest_of(far), FAR)
    quiet = [each for each in wide if each not in far and each not in rest and not _amplified(model, each)]
    squeezing = [each for each in quiet if not each.hinge and each.force < math.inf and beyond(each) < MILLIMETRES]
    quiet = [each for each in quiet if each not in squeezing]
    if 0 < 2 * len(quiet) <= len(servos(simulation)):
        yield from _suspect(model, quiet, _farthest_of(quiet), BEYOND, "hint")


def _farthest_of(found: list[Servo]) -> Probe:
    return Probe(TITLE_OF_FAR, "", _farthest, (tuple(each.actuator for each in found),), dynamic=False)


def _farthest(simulation: Simulation, actuators: tuple[int, ...]) -> float:
    return greatest(simulation, beyond, actuators)


def _amplified(model: ReaderModel, servo: Servo) -> bool:
    """Whether the target is more than the control on purpose, by gain and bias that differ."""
    return abs(abs(servo.scale * model.simulation.gear(servo.actuator)) - 1) > 0.05


def _suspect(
    model: ReaderModel, found: list[Servo], probe: Probe, limit: float, level: Level = "cause"
) -> Iterator[Suspect]:
    simulation = model.simulation
    if not found:
        return
    worst = max(found, key=beyond)
    assert worst.targets is not None
    assert worst.range is not None
    assert worst.ctrl is not None
    yield Suspect(
        tuple(simulation.name("actuator", each.actuator) for each in found),
        "ctrlrange",
        " ".join(f"{each:g}" for each in worst.ctrl),
        inherited(worst),
        tuple(edit for each in found for edit in inherit(model, each)),
        probe,
        limit,
        f"Targets from {worst.targets[0]:.3g} to {worst.targets[1]:.3g} {worst.unit} for "
        f"{simulation.name('joint', worst.joint)}, whose range is {worst.range[0]:.3g} to {worst.range[1]:.3g}"
        f"{in_degrees(worst)}.",
        'the joint\'s range (inheritrange="1")',
        level=level,
    )


def _tenth(servo: Servo) -> bool:
    """Whether the range is a tenth of the targets, and these alone end at whole degrees: its point is misplaced."""
    if not servo.hinge or servo.range is None or servo.targets is None:
        return False
    ends = list(zip(servo.range, servo.targets, strict=True))
    tenth = all(abs(10 * least - target) <= CLOSE * abs(target) for least, target in ends)
    return tenth and all(map(_whole, servo.targets)) and not all(map(_whole, servo.range))


def _whole(angle: float) -> bool:
    """Whether an angle in rad is a multiple of 5 degrees."""
    return abs(math.remainder(math.degrees(angle), 5.0)) < EXACT


def _range(model: ReaderModel, servo: Servo) -> Suspect:
    """A range whose decimal point is misplaced, as its servo's targets tell."""
    of = model.simulation
    assert servo.range is not None
    assert servo.targets is not None
    names = of.name("joint", servo.joint), of.name("actuator", servo.actuator)
    now, value = (written([end / model.angle_unit for end in ends]) for ends in (servo.range, servo.targets))
    says = f"{names[1]} has targets up to ten times as far, {math.degrees(servo.targets[0]):.4g} to "
    says += f"{math.degrees(servo.targets[1]):.4g} degrees: a point is misplaced in the range."
    edits, probe = model.set("joint", [servo.joint], "range", value), _farthest_of([servo])
    return Suspect(names, "range", now, value, edits, probe, FAR, says, "its targets, a tenth", level="hint")


def _of_the_joint(servo: Servo) -> bool:
    """Whether it is the joint's range that is in the wrong unit."""
    return servo.hinge and servo.range is not None and servo.range[1] - servo.range[0] < NARROW


def in_degrees(servo: Servo) -> str:
    """What to say of a control range that is the joint's in degrees."""
    assert servo.targets is not None
    assert servo.range is not None
    apart = max(abs(math.radians(far) - near) for far, near in zip(servo.targets, servo.range, strict=True))
    near = servo.hinge and apart < BEYOND * (servo.range[1] - servo.range[0])
    return ": as degrees they are about that range, and MuJoCo takes radians" if near else ""


def inherited(servo: Servo) -> str:
    """The control range that reaches the joint's range."""
    assert servo.range is not None
    return " ".join(f"{each:.4g}" for each in sorted(map(servo.holding, servo.range)))


def inherit(model: ReaderModel, servo: Servo) -> tuple[Edit, ...]:
    """The edit that gives a servo the control range of its joint."""
    edits = model.set("actuator", [servo.actuator], "ctrlrange", inherited(servo))
    return edits + model.remove("actuator", [servo.actuator], "inheritrange")
