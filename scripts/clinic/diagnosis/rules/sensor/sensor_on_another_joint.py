"""A sensor reads another joint, or another site, than its name says.

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

The number: how many sensors of a joint or site bear the name of another one, and not of their own. Of 568 healthy
models none has one of a joint.

When it is wrong: a sensor that is called after a place, where a joint has the same name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A sensor reads another part than its name says"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "only a name says what a sensor is for"

OF = {3: "joint", 6: "site"}  # mjtObj


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor that has another joint's name, or another site's."""
    of = model.simulation
    for sensor, (kind, meant) in _misnamed(of).items():
        names = of.names(kind)
        read, name = names[int(of.model("sensor_objid")[sensor])], names[meant]
        probe = Probe("whether a sensor reads another part than its name says", "", _wrong, (sensor,), dynamic=False)
        element = model.element("sensor", sensor)
        attribute = "objname" if element is not None and element.get("objname") else kind
        edits = model.set("sensor", [sensor], attribute, name)
        says = f'{of.name("sensor", sensor)} reads {kind} "{read}", and bears the name of {kind} "{name}".'
        elements, healthy = (of.name("sensor", sensor),), f"the {kind} of its name"
        yield Suspect(elements, attribute, read, name, edits, probe, 0.5, says, healthy, level="hint")


def _wrong(of: Simulation, sensor: int) -> float:
    return float(sensor in _misnamed(of))


def _misnamed(of: Simulation) -> dict[int, tuple[str, int]]:
    """By sensor of a joint or site: the one whose name it bears, where that is another one and not its own as well."""
    made = {}
    for sensor, name in enumerate(of.names("sensor")):
        kind = OF.get(int(of.model("sensor_objtype")[sensor]), "")
        names = of.names(kind) if kind and name else []
        own = names[int(of.model("sensor_objid")[sensor])] if names else ""
        if not own or _within(own, name) or (kind == "site" and _within(_holder(of, sensor), name)):
            continue
        found = [each for each, other in enumerate(names) if other and _within(other, name)]
        longest = max((len(names[each]) for each in found), default=0)
        found = [each for each in found if len(names[each]) == longest]
        if len(found) == 1:
            made[sensor] = (kind, found[0])
    return made


def _holder(of: Simulation, sensor: int) -> str:
    """The name of the body of a sensor's site."""
    return of.names("body")[of.body_of("site", int(of.model("sensor_objid")[sensor]))]


def _within(part: str, sensor: str) -> bool:
    """Whether a sensor's name has that of a part in it, as whole words."""
    return part.lower() in sensor.lower() and bool(
        re.search(rf"(?<![a-z0-9]){re.escape(part.lower())}(?![a-z0-9])", sensor.lower())
    )
