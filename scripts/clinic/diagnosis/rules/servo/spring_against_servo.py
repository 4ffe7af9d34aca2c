"""The spring of a joint keeps its servo from the target.

A position servo and the spring of its joint pull at the same joint: it rests between the servo's target and where the
spring is at rest, nearer to the end of the stiffer one. With `kp` 10 and `stiffness` 10 it goes half of the way, and
needs no load for that. A `stiffness` in a default for joints comes so to joints that a servo drives.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-60 60" stiffness="10" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02" mass="0.1"/>
        </body>
      </worldbody>
      <actuator>
        <position name="elbow" joint="elbow" kp="10" ctrlrange="-1 1"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" range="-60 60" stiffness="10" damping="1"/>
    +       <joint name="elbow" axis="0 1 0" range="-60 60" damping="1"/>

The number: the joint is put at 0.8 of the way from the spring's rest to the farther end of what range and control range
allow, without gravity and contacts; what its spring pulls there, over that and what the servo pulls per rad (m) times
the way. It is the share of the way that is left when both are in balance. Above 0.2 is told, and of the healthy models
one: a fruit fly with springs in its head, whose lips go a quarter of the way. Of a joint that motors at sites pull, as
a hand does at the grip of a door, more than 0.8 is told.

When it is wrong: a joint that is elastic by nature, such as a finger that its spring opens, and a learned policy that
was trained with it.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.drive import pull, pulls
from clinic.diagnosis.probes.servo import Servo, alone, greatest, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A spring that holds its servo back"
FAMILIES = ("sags", "stuck")
UNPLANTED = "a spring beside a servo may be meant"

MOST = 0.2  # of the way
WAY, LITTLE = 0.8, 0.8
FREE = {True: 1.0, False: 0.1}  # rad, m: the way without a range


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that the springs of their joints keep from their targets, all together, and joints pulled at sites."""
    yield from _pulled(model)
    of, springs = model.simulation, model.simulation.model("jnt_stiffness")
    stiff = [each for each in servos(of) if springs[each.joint] > MOST * (springs[each.joint] + each.stiffness)]
    kept = {each: share for each in stiff if (share := _kept(of, each)) > MOST}
    if not kept:
        return
    worst, *_ = kept = dict(sorted(kept.items(), key=lambda pair: -pair[1]))
    numbers = tuple(each.actuator for each in kept)
    joints = tuple(dict.fromkeys(each.joint for each in kept))
    stiffness, unit = springs[worst.joint], "N m/rad" if worst.hinge else "N/m"
    yield Suspect(
        tuple(of.name("joint", joint) for joint in joints),
        "stiffness",
        f"{stiffness:g}",
        "0",
        model.set("joint", joints, "stiffness", "0"),
        Probe("share of the way that the spring keeps the servo from", "", _most, (numbers,), dynamic=False),
        MOST,
        f"{of.name('joint', worst.joint)} has a spring of {stiffness:.3g} {unit} against the {worst.stiffness:.3g} of "
        f"{of.name('actuator', worst.actuator)}.",
        "0, or far below kp",
    )


def _pulled(model: ReaderModel) -> Iterator[Suspect]:
    """Each joint whose spring motors at sites cannot work against."""
    of, springs = model.simulation, model.simulation.model("jnt_stiffness")
    for joint in pulls(of):
        if (left := _unpulled(of, joint)) > LITTLE:
            name, gives = of.name("joint", joint), f"{pull(of, joint):.3g} N m (N)"
            value = rounded((1 - left) * springs[joint] / 5)
            says = f"{name} has a spring of {springs[joint]:.3g} N m/rad (N/m) against the {gives} of motors."
            probe = Probe("share of the way that the spring keeps it from", "", _unpulled, (joint,), dynamic=False)
            edits = model.set("joint", [joint], "stiffness", value)
            yield Suspect((name,), "stiffness", f"{springs[joint]:g}", value, edits, probe, LITTLE, says, "far below")


def _unpulled(of: Simulation, joint: int) -> float:
    """The share of the way from the spring's rest to the farther end that all motors at sites leave."""
    low, high = of.ranges.get(joint, (0.0, 0.0))
    rest, spring = of.model("qpos_spring")[of.place(joint)], of.model("jnt_stiffness")[joint]
    way = max(abs(low - rest), abs(high - rest))
    return 1 - pull(of, joint) / (spring * way) if spring * way > 0 else 0.0


def _most(of: Simulation, actuators: tuple[int, ...]) -> float:
    return greatest(of, lambda each: _kept(of, each), actuators)


def _kept(of: Simulation, servo: Servo) -> float:
    """The share of the way from the spring's rest that is left when spring and servo are in balance."""
    place = of.place(servo.joint)
    rest = of.model("qpos_spring")[place]
    goal = _goal(servo, rest)
    with alone(of):
        of.begin(forward=False)
        of.engine.write("qpos", [goal], place)
        of.engine.forward()
        pull = abs(of.data("qfrc_passive")[servo.dof])
    return pull / (pull + servo.stiffness * abs(goal - rest))


def _goal(servo: Servo, rest: float) -> float:
    """Where the servo is told to go: towards the end that is farther from the spring's rest."""
    ends = [each for each in (servo.range, servo.targets) if each]
    far = FREE[servo.hinge]
    low, high = max([rest - far, *(each[0] for each in ends)]), min([rest + far, *(each[1] for each in ends)])
    way = max(high - rest, low - rest, key=abs)
    return rest + WAY * way if abs(way) > 1e-6 else rest + 1e-6
