"""A servo's control range misses most of its joint's range.

The target of a position servo is clipped to `ctrlrange`. Where that meets the joint's range in a point, or in a small
part of it, the joint cannot be sent to the rest.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-180 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="elbow" kp="20" ctrlrange="0 3.14"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="elbow" kp="20" ctrlrange="0 3.14"/>
    +     <position joint="elbow" kp="20" ctrlrange="-3.14 0"/>

The number: the share of the joint's range that no target reaches; more than 60 %, of at most a whole turn. Of a joint
that leads another by a factor it is the other one's range, more than 90 %, and a hint. So is a range that a keyframe's
control is outside of by a fifth of it, where that control holds the joint at the keyframe's own place. With
`--symptom stuck` it tells, as a hint, from 4 % on.

When it is wrong: a servo that is kept to a small part of the range on purpose.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.couplings import Coupling, couplings
from clinic.diagnosis.probes.key import against_range, start_at
from clinic.diagnosis.probes.servo import Servo, greatest, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.servo.control_range_too_wide import inherit, inherited
from clinic.diagnosis.rules.servo.control_range_unlike_range import of_image, ranged_like
from clinic.diagnosis.rules.servo.driven_twice import twice
from clinic.diagnosis.rules.servo.gain_unlike_bias import meets
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "The control range misses the joint's range"
FAMILIES = ("stuck", "passes-limit", "sags")
CASE = "servo-moves-a-fraction"

MISSED, UNLED = 0.6, 0.9
KEEN = 0.04  # of the range, where the reader sees something stop short
GEARED = 1.5
CLIPPED, AGREES = 0.2, 0.01  # of the targets' width; of the joint's place


def missed(servo: Servo) -> float:
    """The share of the joint's range that a servo cannot reach."""
    if servo.targets is None or servo.range is None or servo.range[1] <= servo.range[0]:
        return 0.0
    (low, high), (least, most) = servo.targets, servo.range
    return 1 - max(0.0, min(high, most) - max(low, least)) / min(most - least, 2 * math.pi)


def _missed(simulation: Simulation, actuators: Sequence[int]) -> float:
    return greatest(simulation, missed, actuators)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that miss most of the range; those whose gear divides the target apart."""
    simulation = model.simulation
    yield from _leaders(model)
    yield from _below_keyframes(model)
    shared = {actuator for each in twice(simulation).values() for actuator in each}  # meant for another joint
    keen = model.symptom == FAMILIES[0] and all(missed(each) <= MISSED for each in servos(simulation))
    most = KEEN if keen else MISSED
    found = [each for each in servos(simulation) if missed(each) > most and not meets(simulation, each)]
    held = {joint for key in range(simulation.count("key")) for joint in against_range(simulation, key)}
    found = [each for each in found if each.actuator not in shared and each.joint not in held]
    found = [each for each in found if ranged_like(simulation, each) is None and not of_image(simulation, each)]
    gears = {each.actuator: simulation.gear(each.actuator) for each in found}
    for geared in (True, False):
        some = [each for each in found if (abs(gears[each.actuator]) > GEARED) == geared]
        if not some:
            continue
        worst = max(some, key=missed)
        assert worst.targets is not None
        assert worst.range is not None
        assert worst.ctrl is not None
        gear = gears[worst.actuator]
        why = f": the gear of {gear:g} divides them" if geared else ""
        yield Suspect(
            tuple(simulation.name("actuator", each.actuator) for each in some),
            "gear" if geared else "ctrlrange",
            f"{gear:g}" if geared else " ".join(f"{each:g}" for each in worst.ctrl),
            "1" if geared else inherited(worst),
            tuple(edit for each in some for edit in (ungeared if geared else inherit)(model, each)),
            Probe(
                "share of the joint's range that no target reaches",
                "",
                _missed,
                (tuple(each.actuator for each in some),),
                dynamic=False,
            ),
            most,
            f"Targets from {worst.targets[0]:.3g} to {worst.targets[1]:.3g} {worst.unit} for "
            f"{simulation.name('joint', worst.joint)}, whose range is {worst.range[0]:.3g} to "
            f"{worst.range[1]:.3g}{why}.",
            'the joint\'s range (inheritrange="1")',
            level="hint" if keen else "cause",
        )


def _leaders(model: ReaderModel) -> Iterator[Suspect]:
    """Servos of joints without a range that lead another one next to nowhere."""
    of = model.simulation
    for servo in servos(of):
        (share, coupling) = _unled(of, servo)
        if share <= UNLED or coupling is None or servo.targets is None or servo.ctrl is None:
            continue
        follower, leader, factors = coupling
        low, high = of.row("jnt_range", follower, 2)
        begins = [of.model("qpos0")[of.place(joint)] for joint in (follower, leader)]
        ends = sorted(servo.holding(begins[1] + (end - begins[0]) / factors[1]) for end in (low, high))
        names = of.name("actuator", servo.actuator), of.name("joint", leader), of.name("joint", follower)
        now, value = (" ".join(f"{each:.4g}" for each in some) for some in (servo.ctrl, ends))
        says = f"{names[1]} goes from {servo.targets[0]:.3g} to {servo.targets[1]:.3g}, and leads {names[2]} by "
        says += f"{factors[1]:.3g} of that: over {100 * (1 - share):.2g} % of its range of {low:.3g} to {high:.3g}."
        probe = Probe("share of the follower's range that no target reaches", "", _idle, (servo.actuator,), False)
        edits = model.set("actuator", [servo.actuator], "ctrlrange", value)
        yield Suspect(names, "ctrlrange", now, value, edits, probe, UNLED, says, "what leads all over", level="hint")


def _below_keyframes(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that a keyframe tells to stay where it puts the joint, which their control range does not let them."""
    of = model.simulation
    for actuator, (key, ctrl) in clipped(of).items():
        own, joint = of.row("actuator_ctrlrange", actuator, 2), of.driven_joint(actuator) or 0
        alike = [each for each in range(of.count("actuator")) if each != actuator and _same(of, each, actuator)]
        others = {of.row("actuator_ctrlrange", each, 2) for each in alike}
        others = {(low, high) for low, high in others if low <= ctrl <= high}
        wide = others.pop() if len(others) == 1 else (min(own[0], ctrl), max(own[1], ctrl))
        now, value = (" ".join(f"{each:g}" for each in ends) for ends in (own, wide))
        names = of.name("actuator", actuator), of.name("key", key), of.name("joint", joint)
        says = f"{names[1]} has {names[2]} where its control of {ctrl:g} holds it, and the control is clipped to {now}."
        probe = how_many("servos that their control range keeps from a keyframe's place", clipped)
        edits = model.set("actuator", [actuator], "ctrlrange", value)
        yield Suspect(names, "ctrlrange", now, value, edits, probe, 0, says, "what keyframes ask for", level="hint")


@kept
def clipped(of: Simulation) -> dict[int, tuple[int, float]]:
    """By servo whose target in a keyframe is its joint's place there, far outside of its control range: both."""
    made = dict[int, tuple[int, float]]()
    for key in range(of.count("key")):
        start_at(of, key)
        for each in servos(of):
            if each.targets is None or each.actuator in made or missed(each) > MISSED:
                continue
            (low, high), at = each.targets, of.position(each.joint)
            ctrl = of.data("ctrl")[each.actuator]
            agrees = at and abs(each.target(ctrl) - at) <= AGREES * abs(at)
            inside = each.range is None or each.range[0] <= at <= each.range[1]
            if agrees and inside and max(low - at, at - high) > CLIPPED * (high - low):
                made[each.actuator] = (key, ctrl)
    return made


def _same(of: Simulation, one: int, other: int) -> bool:
    """Whether two actuators are of one gain, bias and gear."""
    fields: tuple[Callable[[int], object], ...] = (of.gain, of.bias, of.gear)
    return all(field(one) == field(other) for field in fields)


def _idle(of: Simulation, actuator: int) -> float:
    return greatest(of, lambda servo: _unled(of, servo)[0], (actuator,))


def _unled(of: Simulation, servo: Servo) -> tuple[float, Coupling | None]:
    """The share of a follower's range where a servo without a range of its own cannot lead it, and the coupling."""
    for _, coupling in couplings(of):
        follower, leader, factors = coupling
        if leader != servo.joint or servo.range or not servo.targets or follower not in of.ranges or any(factors[2:]):
            continue
        low, high = of.ranges[follower]
        if factors[1] and high > low:
            way = abs(factors[1]) * (servo.targets[1] - servo.targets[0])
            return 1 - min(1.0, way / (high - low)), coupling
    return 0.0, None


def ungeared(model: ReaderModel, servo: Servo) -> tuple[Edit, ...]:
    """A gear of 1 in place of the gear, and gains that leave the joint as stiff and as damped as it was.

    Gains that another servo without a gear has as well were meant without one.
    """
    of, one = model.simulation, [servo.actuator]
    gears = [of.gear(each) for each in range(of.count("actuator"))]
    gear = gears[servo.actuator]
    written = {gain: model.value("actuator", servo.actuator, gain) for gain in ("kp", "kv")}
    others = [each for each, other in enumerate(gears) if other == 1]
    shared = any(all(model.value("actuator", each, gain) == value for gain, value in written.items())
                 for each in others)  # fmt: skip
    gains = ((gain, f"{float(value) * gear**2:g}") for gain, value in written.items() if value and not shared)
    return sum((model.set("actuator", one, *each) for each in gains), model.set("actuator", one, "gear", "1"))
