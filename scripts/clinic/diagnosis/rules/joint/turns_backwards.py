"""The wheels or the steering of a URDF turn the other way than ROS has it.

In ROS a base has x forward, y to the left and z up (REP 103). A wheel whose axis points to the left drives forward at a
positive speed; a steering hinge whose axis points up steers to the left at a positive angle. With the axes the other
way, often by a frame with `rpy="1.57 0 0"` that should have been `-1.57 0 0`, the car drives backwards, or steers to
the other side than the odometry says.

Bad:

    <robot name="car">
      <link name="base_link">
        <inertial><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
        <collision><geometry><box size="0.4 0.2 0.1"/></geometry></collision>
      </link>
      <link name="left_wheel">
        <inertial><mass value="0.2"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial>
        <collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision>
      </link>
      <link name="right_wheel">
        <inertial><mass value="0.2"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial>
        <collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision>
      </link>
      <joint name="left_wheel_joint" type="continuous">
        <origin xyz="0 0.12 0" rpy="1.5708 0 0"/>
        <parent link="base_link"/><child link="left_wheel"/>
        <axis xyz="0 0 1"/>
      </joint>
      <joint name="right_wheel_joint" type="continuous">
        <origin xyz="0 -0.12 0" rpy="1.5708 0 0"/>
        <parent link="base_link"/><child link="right_wheel"/>
        <axis xyz="0 0 1"/>
      </joint>
    </robot>

Good:

    -     <origin xyz="0 0.12 0" rpy="1.5708 0 0"/>
    +     <origin xyz="0 0.12 0" rpy="-1.5708 0 0"/>

    -     <origin xyz="0 -0.12 0" rpy="1.5708 0 0"/>
    +     <origin xyz="0 -0.12 0" rpy="-1.5708 0 0"/>

The number: how far the axes of all hinges that are called a wheel's point to the right of the base, or those that are
called a steering's down, from -1 to 1; told from 0.9 on, where there are two at least.

When it is wrong: a driver that turns the sign round, or a base whose x is not forward.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.vector import Vector, dot, written
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Wheels or a steering that turn the other way"
FAMILIES = ("drifts", "wrong-numbers")
UNPLANTED = "the models of the bench are MJCF"

STEERING = re.compile(r"steer", re.IGNORECASE)
FAR = 0.9
RIGHT, DOWN = (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The wheels, and the steering, where all of them turn against the convention."""
    if not model.urdf:
        return
    of = model.simulation
    hinges = [joint for joint in range(of.count("joint")) if of.joint_type(joint) == HINGE]
    steering = [joint for joint in hinges if STEERING.search(of.names("joint")[joint])]
    wheels = [joint for joint in hinges if joint not in steering and is_wheel(of.names("joint")[joint])]
    for joints, against, says in (
        (wheels, RIGHT, "A positive speed drives it backwards: its axis points to the right of the root link."),
        (steering, DOWN, "A positive angle steers to the right: its axis points down."),
    ):
        if len(joints) > 1 and (least := _least(of, tuple(joints), against)) > FAR:
            probe = Probe("axes against the convention of ROS", "", _least, (tuple(joints), against), dynamic=False)
            edits = tuple(edit for joint in joints for edit in model.turned_axis(joint))
            names = tuple(of.name("joint", joint) for joint in joints)
            now, value = written(of.row("jnt_axis", joints[0], 3)), edits[0].value if edits else ""
            yield Suspect(
                names, "axis", now, value, edits, probe, FAR, says, "the other way", share=least, level="hint"
            )


def _least(of: Simulation, joints: tuple[int, ...], against: Vector) -> float:
    """How far all of some axes point along a direction."""
    of.begin()
    return min(dot(of.axis(joint), against) for joint in joints)
