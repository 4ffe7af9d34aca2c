"""A joint of a URDF has no `<axis>`, and turns about the x axis.

URDF takes `1 0 0` where no axis is written. A joint that was fixed before, or that was copied in part, turns about its
link's x axis then, whatever the others do.

Bad:

    <robot name="arm">
      <link name="base"/>
      <link name="upper">
        <inertial><origin xyz="0 0 0.1"/><mass value="1"/>
          <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.0005"/></inertial>
      </link>
      <link name="fore">
        <inertial><origin xyz="0 0 0.1"/><mass value="1"/>
          <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.0005"/></inertial>
      </link>
      <joint name="shoulder" type="revolute">
        <parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="20" velocity="3"/>
      </joint>
      <joint name="elbow" type="revolute">
        <parent link="upper"/><child link="fore"/><origin xyz="0 0 0.25" rpy="0 0 0"/>
        <limit lower="-1" upper="1" effort="20" velocity="3"/>
      </joint>
    </robot>

Good:

    -     <parent link="upper"/><child link="fore"/><origin xyz="0 0 0.25" rpy="0 0 0"/>
    +     <parent link="upper"/><child link="fore"/><origin xyz="0 0 0.25" rpy="0 0 0"/><axis xyz="0 1 0"/>

The number: the joints that move and have no axis. Where no joint that moves has one, none is told, unless one is called
a wheel.

When it is wrong: a joint that does turn about x; an axis that is written says so.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A joint whose axis is left out"
FAMILIES = ("stuck", "drifts", "wrong-numbers")
UNPLANTED = "only URDF has such joints, and the healthy models are MJCF"

MOVES = ("revolute", "continuous", "prismatic")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints without an axis, all together, where others have one."""
    if model.source is None or not model.urdf:
        return
    joints = [each for each in model.source.root.children if each.tag == "joint" and each.get("type") in MOVES]
    bare = [each for each in joints if each.first("axis") is None]
    wheels = len(bare) == len(joints) and any("wheel" in each.get("name") for each in bare)
    if bare and (wheels or len(bare) < len(joints)):
        names = tuple(f'joint "{each.get("name")}"' for each in bare)
        says = f"No <axis> is written for {names[0]}, and URDF takes x, 1 0 0, where there is none."
        probe = counted("joints without an axis", len(bare))
        yield Suspect(names, "axis", "left out", "", (), probe, 0.5, says, "an axis that is written")
