"""The spring and the damper of a servo are two actuators, and each has a limit of force of its own.

A motor's torque is limited as a whole. Where a `<position>` and a `<velocity>` drive one joint and each is clipped by
itself, the spring pulls with all it may while the damper brakes with as much: at forcerange over kv, here 3.8 rad/s,
nothing is left, and the joint gets no faster. With one limit for the sum it gets to 13.8 rad/s on a step of 1.5 rad.

Bad:

    <mujoco>
      <compiler angle="radian"/>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hip" axis="0 1 0" range="-1.8 0.5" armature="0.3"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.06"/>
        </body>
      </worldbody>
      <actuator>
        <position name="hip" joint="hip" kp="1000" ctrlrange="-1.8 0.5" forcerange="-340 340"/>
        <velocity name="hip_damper" joint="hip" kv="90" forcerange="-340 340"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="hip" axis="0 1 0" range="-1.8 0.5" armature="0.3"/>
    +       <joint name="hip" axis="0 1 0" range="-1.8 0.5" armature="0.3" actuatorfrcrange="-340 340"/>

    -     <position name="hip" joint="hip" kp="1000" ctrlrange="-1.8 0.5" forcerange="-340 340"/>
    -     <velocity name="hip_damper" joint="hip" kv="90" forcerange="-340 340"/>
    +     <position name="hip" joint="hip" kp="1000" ctrlrange="-1.8 0.5"/>
    +     <velocity name="hip_damper" joint="hip" kv="90"/>

The number: joints on which an actuator that answers to position and one that answers to speed alone are both limited,
where the first meets its limit within the joint's range. MuJoCo adds what each gives after it was clipped; a joint's
`actuatorfrcrange` clips the sum. One position servo with both gains and a `forcerange` does the same.

When it is wrong: a brake beside a motor, which has a limit of its own.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A servo's two parts are clipped apart"
FAMILIES = ("sags", "stuck")
UNPLANTED = "no healthy model of the bench has a servo of two actuators"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints whose spring and damper are limited apart, all together."""
    of = model.simulation
    if not (found := _apart(of)):
        return
    limits = {joint: written(_limit(of, pair[0])) for joint, pair in found.items()}
    pairs = [actuator for pair in found.values() for actuator in pair]
    first = next(iter(found))
    names = tuple(of.name("actuator", actuator) for actuator in pairs)
    yield Suspect(
        (*names, *(of.name("joint", joint) for joint in found)),
        "forcerange",
        limits[first],
        "of the joint",
        (*model.set("actuator", pairs, "forcelimited", "false"), *model.set_each("joint", "actuatorfrcrange", limits)),
        how_many("servos whose parts are clipped apart", _apart),
        0.0,
        f"{names[0]} and {names[1]} drive {of.name('joint', first)}, and each is clipped at {limits[first]} by itself, "
        "not their sum.",
        "one limit for the sum",
    )


def _limit(of: Simulation, actuator: int) -> list[float]:
    """The limits of an actuator's force at its joint."""
    return sorted(of.gear(actuator) * end for end in of.row("actuator_forcerange", actuator, 2))


def _apart(of: Simulation) -> dict[int, tuple[int, int]]:
    """Of joints with a spring and a damper that are limited apart: the two actuators."""
    made = {}
    for joint, driving in of.drivers.items():
        limited = [each for each in driving if of.model("actuator_forcelimited")[each]]
        springs = [each for each in limited if of.bias(each)[1] < 0]
        dampers = [each for each in limited if of.bias(each)[1] == 0 > of.bias(each)[2]]
        if len(springs) == len(dampers) == 1 and not of.model("jnt_actfrclimited")[joint]:
            low, high = of.ranges.get(joint, (-1.57, 1.57))
            most = of.row("actuator_forcerange", springs[0], 2)[1]
            if -of.bias(springs[0])[1] * abs(of.gear(springs[0])) * (high - low) > most:
                made[joint] = (springs[0], dampers[0])
    return made
