"""A sensor reads another joint than its name says.

A block of sensors was copied, and one has the new name and the old joint: `elbow_pos` reads the shoulder.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="shoulder" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
          <body pos="0.3 0 0">
            <joint name="elbow" axis="0 1 0"/>
            <geom type="capsule" fromto="0.05 0 0 0.3 0 0" size="0.03"/>
          </body>
        </body>
      </worldbody>
      <sensor>
        <jointpos name="elbow_pos" joint="shoulder"/>
      </sensor>
    </mujoco>

Good:

    -     <jointpos name="elbow_pos" joint="shoulder"/>
    +     <jointpos name="elbow_pos" joint="elbow"/>

The number: how many sensors of a joint bear the name of another joint, or of another actuator, and not of their own. Of
568 healthy models none has one.

When it is wrong: a sensor that is called after a place, where a joint has the same name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A sensor reads another joint than its name says"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "only a name says what a sensor is for"

JOINT = 3  # mjtObj


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor that has another joint's name."""
    of = model.simulation
    names = of.names("joint")
    for sensor, meant in _misnamed(of).items():
        read, name = names[int(of.model("sensor_objid")[sensor])], names[meant]
        probe = Probe("whether a sensor reads another joint than its name says", "", _wrong, (sensor,), dynamic=False)
        edits = model.set("sensor", [sensor], "joint", name)
        says = f'{of.name("sensor", sensor)} reads joint "{read}", and bears the name of joint "{name}".'
        elements = (of.name("sensor", sensor),)
        yield Suspect(elements, "joint", read, name, edits, probe, 0.5, says, "the joint of its name", level="hint")


def _wrong(of: Simulation, sensor: int) -> float:
    return float(sensor in _misnamed(of))


def _misnamed(of: Simulation) -> dict[int, int]:
    """By sensor of a joint: the one joint whose name it bears, where that is another one and not its own as well."""
    joints, sensors, kinds = of.names("joint"), of.names("sensor"), of.model("sensor_objtype")
    made = {}
    for sensor, name in enumerate(sensors):
        own = joints[int(of.model("sensor_objid")[sensor])] if name and int(kinds[sensor]) == JOINT else ""
        if not own or _within(own, name):
            continue
        found = [joint for joint, other in enumerate(joints) if other and _within(other, name)]
        longest = max((len(joints[joint]) for joint in found), default=0)
        found = [joint for joint in found if len(joints[joint]) == longest]
        if len(found) == 1:
            made[sensor] = found[0]
    return made


def _within(joint: str, sensor: str) -> bool:
    """Whether a sensor's name has a joint's in it, as whole words."""
    return bool(re.search(rf"(?<![a-z0-9]){re.escape(joint.lower())}(?![a-z0-9])", sensor.lower()))
