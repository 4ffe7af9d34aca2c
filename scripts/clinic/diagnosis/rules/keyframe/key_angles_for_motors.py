"""The controls of a keyframe are the positions of its pose, and the actuators are motors.

They were copied from a model with position servos. To a motor the numbers are torques in N m, or forces in N: they push
the robot out of the pose.

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

The number: of the motors and velocity servos of a keyframe whose control is not zero, how many have just the position
of their joint; two and more, and all of them, or all but one. The edit sets their controls to 0, and leaves `ctrl` out
where nothing else is in it.

When it is wrong: torques that happen to be the angles; so it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute, set_attribute
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.key import start_at
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A keyframe's torques are the angles of its pose"
FAMILIES = ("drifts", "jumps-at-start", "sags")
UNPLANTED = "no healthy model has a keyframe with controls of motors"
FEW = 1.0


def _copied(simulation: Simulation, key: int) -> float:
    """How many motors have their joint's position as their control."""
    return float(len(_same(simulation, key)))


def _taken(of: Simulation, actuator: int) -> str:
    """What an actuator takes its control as."""
    hinge = of.joint_type(of.driven_joint(actuator) or 0) == HINGE
    return "speeds" if of.bias(actuator)[2] else "torques" if hinge else "forces"


def _same(simulation: Simulation, key: int) -> list[int]:
    """The motors that have their joint's position as their control; none where two and more have something else."""
    start_at(simulation, key)
    given, same = 0, list[int]()
    for actuator, value in enumerate(simulation.data("ctrl")):
        joint = simulation.driven_joint(actuator)
        if joint is None or value == 0 or any(simulation.bias(actuator)[:2]):
            continue
        given += 1
        same += [actuator] * (abs(simulation.position(joint) - value) < 1e-6)
    return same if len(same) > FEW and given - len(same) <= 1 else []


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes of motors that hold angles for torques."""
    of = model.simulation
    for key in range(of.count("key")):
        element, same = model.element("key", key), _same(of, key)
        if same and element is not None and "ctrl" in element.attributes:
            left = [0.0 if each in same else value for each, value in enumerate(of.data("ctrl"))]
            edit = set_attribute(element, "ctrl", written(left)) if any(left) else remove_attribute(element, "ctrl")
            probe = Probe("motors whose control is their joint's position", "motors", _copied, (key,), dynamic=False)
            taken = " and ".join(dict.fromkeys(_taken(of, actuator) for actuator in same))
            says = f"The controls of {len(same)} actuators are the positions of their joints, and are taken as {taken}."
            yield Suspect(
                (of.name("key", key),),
                "ctrl",
                element.get("ctrl"),
                written(left) if any(left) else "left out",
                (edit,),
                probe,
                FEW,
                says,
                taken,
                level="hint",
            )
