"""The joints of a URDF have an effort of zero.

CAD exporters write `effort="0" velocity="0"` where nobody gave a number. ROS controllers then command a joint that may
give nothing; MuJoCo reads it as no limit at all, and the joint's motor is as strong as it likes.

Bad:

    <robot name="arm">
      <link name="base"/>
      <link name="arm">
        <inertial><origin xyz="0 0 0.1"/><mass value="1"/>
          <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.0005"/></inertial>
      </link>
      <link name="hand">
        <inertial><origin xyz="0 0 0.05"/><mass value="0.3"/>
          <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.0005"/></inertial>
      </link>
      <joint name="shoulder" type="revolute">
        <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="20" velocity="3"/>
      </joint>
      <joint name="wrist" type="revolute">
        <origin xyz="0 0 0.2"/><parent link="arm"/><child link="hand"/><axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="0" velocity="0"/>
      </joint>
    </robot>

Good:

    -     <limit lower="-1" upper="1" effort="0" velocity="0"/>
    +     <limit lower="-1" upper="1" effort="10" velocity="3"/>

The number: how many joints have no limit of force once the model is compiled, although the text states an effort. Where
no joint of the file has another effort, it is told with `--symptom stuck` or `explodes` only.

When it is wrong: a joint that nothing drives.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An effort of zero"
FAMILIES = ("stuck", "explodes")
UNPLANTED = "only URDF has efforts, and the healthy models are MJCF"
MINOR = True


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints of a URDF that may turn and may give nothing; they get the largest effort of the others."""
    if not model.urdf:
        return
    of = model.simulation
    joints = {joint: each for joint in range(of.count("joint")) if (each := model.element("joint", joint))}
    limits = {joint: limit for joint, each in joints.items() if (limit := each.first("limit"))}
    efforts = {joint: float(limit.get("effort") or -1) for joint, limit in limits.items()}
    without = tuple(joint for joint, effort in efforts.items() if effort == 0)
    most = max(efforts.values(), default=0.0)
    if not without or (most == 0 and model.symptom not in FAMILIES):
        return
    edits = tuple(set_attribute(limits[joint], "effort", f"{most:g}") for joint in without if most)
    says = "A joint that may give nothing cannot be driven in ROS; MuJoCo reads it as a joint without a limit."
    probe = Probe("joints without a limit of force", "", _unlimited, without, dynamic=False)
    names, value = tuple(of.name("joint", joint) for joint in without), f"{most:g}" if most else "that of the motor"
    yield Suspect(names, "effort", "0", value, edits, probe, 0.0, says, "the motor's torque in N m, or force in N")


def _unlimited(simulation: Simulation, *joints: int) -> float:
    return float(sum(not simulation.model("jnt_actfrclimited")[joint] for joint in joints))
