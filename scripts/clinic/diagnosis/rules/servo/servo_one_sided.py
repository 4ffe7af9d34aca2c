"""A servo works to one side only, or turns the joint to the other one.

`forcerange="0 40"` lets a servo push and never pull; `ctrlrange="0 1.5"` on a joint that goes from -1.5 to 1.5 leaves
half of its way out; and with `gear="-1"` a joint that is told 0.5 rad goes to -0.5 rad.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" damping="2" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="shoulder" kp="50" ctrlrange="-1.5 1.5" forcerange="0 40"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="shoulder" kp="50" ctrlrange="-1.5 1.5" forcerange="0 40"/>
    +     <position joint="shoulder" kp="50" ctrlrange="-1.5 1.5" forcerange="-40 40"/>

The number: how many position servos have a force range of which one end is less than a 20th of the other, a control
range that ends at 0 where a fifth of the joint's range and more lies beyond, or a negative gear. Of 96 healthy models
with servos none has such a force range or gear, and one such a control range.

So is a motor whose control has one sign, on a joint without a spring that it could hold at the start against a weight
of a tenth of its force and more, and that pushes the way that the weight goes; and one on a joint that no weight,
spring, tendon or equality moves, of whose range a fifth and more lies on the other side of the start. Of 260 healthy
models one has a motor of one side on a joint without a spring: a winch against a weight.

When it is wrong: a rope, a finger that a spring opens, or a joint that is counted the other way round on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.load import loads
from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.servo.control_range_too_wide import inherited
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A servo that works to one side only, or to the wrong one"
FAMILIES = ("stuck", "drifts", "sags")
UNPLANTED = "whether a joint needs both sides, only its maker knows"

LITTLE, END, BEYOND = 0.05, 0.001, 0.2
WEIGHT, AT_ITS_END = 0.1, 0.01  # of the motor's force; of the range
NO_LOAD = 0.01  # of the motor's force


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos of one side, together by what makes them so, and motors that push with the weight alone."""
    of = model.simulation
    for actuator in sinking(of):
        joint, gear = of.driven_joint(actuator) or 0, of.gear(actuator)
        name, moved = of.name("actuator", actuator), of.name("joint", joint)
        says = f"{name} pushes {moved} to one side, to which the weight pulls it; no spring or actuator brings it back."
        probe = how_many("motors that push with the weight alone", sinking)
        edits, now, value = model.set("actuator", [actuator], "gear", f"{-gear:g}"), f"{gear:g}", f"{-gear:g}"
        yield Suspect((name, moved), "gear", now, value, edits, probe, 0, says, "against the weight, or both sides")
    for actuator in stranding(of):
        (low, high), joint = of.row("actuator_ctrlrange", actuator, 2), of.driven_joint(actuator) or 0
        most, now = max(-low, high), f"{low:g} {high:g}"
        name, moved, value = of.name("actuator", actuator), of.name("joint", joint), f"-{most:g} {most:g}"
        says = f"{name} pushes {moved} to one side, and no weight, spring or actuator brings it back."
        probe = how_many("motors of one side that nothing acts against", stranding)
        edits = model.set("actuator", [actuator], "ctrlrange", value)
        yield Suspect((name, moved), "ctrlrange", now, value, edits, probe, 0, says, "both sides", level="hint")
    for attribute in ("forcerange", "ctrlrange", "gear"):
        found = [each for each in servos(of) if _one_sided(of, each, attribute)]
        if not found:
            continue
        numbers = tuple(each.actuator for each in found)
        now, value, says = _told(of, found[0], attribute)
        values = {each.actuator: _told(of, each, attribute)[1] for each in found}
        edits = model.set_each("actuator", attribute, values)
        names = tuple(of.name("actuator", each) for each in numbers)
        probe = Probe(f"servos of one side by their {attribute}", "", _count, (attribute, *numbers), dynamic=False)
        yield Suspect(names, attribute, now, value, edits, probe, 0, says, "both sides", level="hint")


def _pushers(of: Simulation) -> Iterator[tuple[int, int, float]]:
    """The joints without a spring that one motor of one side drives, with that and the most that it gives, signed."""
    for joint, (actuator, *others) in of.drivers.items():
        low, high = of.row("actuator_ctrlrange", actuator, 2)
        one_sided = of.model("actuator_ctrllimited")[actuator] and low * high == 0 and low < high
        if one_sided and not others and of.is_motor(actuator) and not of.model("jnt_stiffness")[joint]:
            yield joint, actuator, of.gain(actuator)[0] * of.gear(actuator) * (low + high)


def sinking(of: Simulation) -> list[int]:
    """The motors of one side that could hold their joint's weight at the start, and push the way that it goes."""
    of.begin()
    bias, made = of.data("qfrc_bias"), list[int]()
    if of.model("opt.gravity")[2] >= 0:
        return made  # what is wrong is which way things fall
    for joint, actuator, force in _pushers(of):
        weight = -bias[of.dof(joint)]
        least, most = of.ranges.get(joint, (-1e9, 1e9))
        left = most - of.position(joint) if force > 0 else of.position(joint) - least
        if force * weight > 0 and WEIGHT * abs(force) < abs(weight) < abs(force) and left > AT_ITS_END * (most - least):
            made.append(actuator)
    return made


def stranding(of: Simulation) -> list[int]:
    """The motors of one side on joints with a range to both sides that nothing takes to the other one."""
    made = list[int]()
    tied = of.count("tendon") or of.count("equality") or any(of.model("opt.wind"))
    for joint, actuator, force in _pushers(of) if not tied else ():
        if joint not in of.ranges:
            continue
        least, most = of.ranges[joint]
        of.begin()
        behind = of.position(joint) - least if force > 0 else most - of.position(joint)
        if behind > BEYOND * (most - least) and loads(of)[of.dof(joint)] <= NO_LOAD * abs(force):
            made.append(actuator)
    return made


def _one_sided(of: Simulation, servo: Servo, attribute: str) -> bool:
    if attribute == "gear":
        return of.gear(servo.actuator) < 0
    if attribute == "forcerange":
        low, high = of.row("actuator_forcerange", servo.actuator, 2)
        one = max(low, -high) > -LITTLE * max(-low, high)
        return bool(of.model("actuator_forcelimited")[servo.actuator]) and low < high and one
    if servo.targets is None or servo.range is None:
        return False
    (least, most), (low, high) = servo.targets, servo.range
    end, beyond = END * (high - low), BEYOND * (high - low)
    return (abs(least) < end and low < -beyond) or (abs(most) < end and high > beyond)


def _count(of: Simulation, attribute: str, *actuators: int) -> float:
    return float(sum(_one_sided(of, each, attribute) for each in servos(of) if each.actuator in actuators))


def _told(of: Simulation, servo: Servo, attribute: str) -> tuple[str, str, str]:
    """What is written, what would work to both sides, and the sentence."""
    name = of.name("joint", servo.joint)
    if attribute == "gear":
        gear = of.gear(servo.actuator)
        says = f"Its gear is negative: {name} goes to the other side than its control says."
        return f"{gear:g}", f"{-gear:g}", says
    if attribute == "forcerange":
        low, high = of.row("actuator_forcerange", servo.actuator, 2)
        most = max(-low, high)
        says = f"Its force goes from {low:g} to {high:g}: it pushes {name} to one side only."
        return f"{low:g} {high:g}", f"{-most:g} {most:g}", says
    assert servo.ctrl is not None
    assert servo.targets is not None
    assert servo.range is not None
    says = (
        f"It sends {name} from {servo.targets[0]:.3g} to {servo.targets[1]:.3g} {servo.unit}; its range is "
        f"{servo.range[0]:.3g} to {servo.range[1]:.3g}."
    )
    return " ".join(f"{each:g}" for each in servo.ctrl), inherited(servo), says
