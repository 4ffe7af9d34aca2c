"""The controls of a keyframe are the angles of its pose, and the actuators are motors.

Copied from a model with position servos. To a motor the numbers are torques: the robot is pushed out of the pose.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hip" axis="0 1 0" damping="1" armature="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.01"/>
          <body pos="0.2 0 0">
            <joint name="knee" axis="0 1 0" damping="1" armature="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.01"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="hip"/>
        <motor joint="knee"/>
      </actuator>
      <keyframe>
        <key name="home" qpos="0.9 -1.8" ctrl="0.9 -1.8"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0.9 -1.8" ctrl="0.9 -1.8"/>
    +     <key name="home" qpos="0.9 -1.8"/>

The number: of the motors of a keyframe whose control is not zero, how many have just the position of their joint; two
and more, and all but one of them. So it is with velocity servos.

When it is wrong: torques that happen to be the angles; so it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.probes.key import start_at
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A keyframe's torques are the angles of its pose"
FAMILIES = ("drifts", "jumps-at-start", "sags")
UNPLANTED = "no healthy model has a keyframe with controls of motors"
FEW = 1.0


def _copied(simulation: Simulation, key: int) -> float:
    """How many motors have their joint's position as their control; none where two and more have something else."""
    start_at(simulation, key)
    given, same = 0, 0
    for actuator, value in enumerate(simulation.data("ctrl")):
        joint = simulation.driven_joint(actuator)
        if joint is None or value == 0 or any(simulation.bias(actuator)[:2]):
            continue
        given += 1
        same += abs(simulation.position(joint) - value) < 1e-6
    return float(same) if same > FEW and given - same <= 1 else 0.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes of motors that hold angles for torques."""
    of = model.simulation
    for key in range(of.count("key")):
        element, same = model.element("key", key), _copied(of, key)
        if same > FEW and element is not None and "ctrl" in element.attributes:
            probe = Probe("motors whose control is their joint's position", "motors", _copied, (key,), dynamic=False)
            speeds = any(of.bias(actuator)[2] for actuator in range(of.count("actuator")))
            says = f"The controls of {same:.0f} motors are the positions of their joints, and are taken as "
            says += "speeds." if speeds else "torques."
            yield Suspect(
                (of.name("key", key),),
                "ctrl",
                element.get("ctrl"),
                "left out",
                (remove_attribute(element, "ctrl"),),
                probe,
                FEW,
                says,
                "torques",
                level="hint",
            )
