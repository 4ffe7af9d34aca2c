"""A sensor is of another kind than its name says.

A line of sensors is copied and one word is left: what is called a gyro is a `<velocimeter>`, and gives m/s where rad/s
are read. Both have three numbers, so that nothing complains.

Bad:

    <mujoco>
      <worldbody>
        <body name="robot" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.05"/>
          <site name="imu"/>
        </body>
      </worldbody>
      <sensor>
        <accelerometer name="robot_accel" site="imu"/>
        <velocimeter name="robot_gyro" site="imu"/>
      </sensor>
    </mujoco>

Good:

    -     <velocimeter name="robot_gyro" site="imu"/>
    +     <gyro name="robot_gyro" site="imu"/>

The number: how many sensors of motion have a name that names one other kind of them, and not their own.

When it is wrong: a name that says what is made of the reading.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import replace
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A sensor of another kind than its name says"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
UNPLANTED = "what a sensor is meant to read stands in its name alone"

SAID = {  # the words for what a sensor reads, and the kinds that read it; the first is what is meant
    r"gyro(?:scope)?|ang(?:ular)?_?vel(?:ocity)?": ("gyro", "frameangvel", "ballangvel", "subtreeangmom"),
    r"acc(?:el[a-z]*)?|lin(?:ear)?_?acc[a-z]*": ("accelerometer", "framelinacc"),
    r"velocimeter|lin(?:ear)?_?vel(?:ocity)?": ("velocimeter", "framelinvel", "subtreelinvel"),
    r"magnetometer": ("magnetometer",),
}
WORDS = {re.compile(rf"(?<![a-z])(?:{words})(?![a-z])", re.IGNORECASE): kinds for words, kinds in SAID.items()}
OWN = {"frame": "pos|quat|ori|rot|att|vel|acc|axis", "subtree": "com|vel|mom|subtree", "ball": "quat|vel|ball"}
SITED = ("gyro", "accelerometer", "velocimeter", "magnetometer")  # written alike
KINDS = {kind for kinds in SAID.values() for kind in kinds}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor whose name says one kind, and that is another."""
    sensors = model.source.section("sensor") if model.source else ()
    found = [(each, meant) for each in sensors if (meant := _meant(each))]
    for element, meant in found:
        attributes = "".join(f' {name}="{value}"' for name, value in element.attributes.items())
        plain = element.get("site") and meant in SITED and not set(attributes) & set("&<")
        edits = (replace(element, f"<{meant}{attributes}/>"),) if plain else ()
        says = f"It is called so, and is a <{element.tag}>."
        probe = counted("sensors of another kind than their name says", len(found))
        name = f'sensor "{element.get("name")}"'
        yield Suspect((name,), "", f"<{element.tag}>", f"<{meant}>", edits, probe, 0, says, at=element)


def _meant(sensor: Element) -> str:
    """The kind that a sensor's name says, where it is of another; empty where it says none, or several."""
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", sensor.get("name"))
    own = next((words for kind, words in OWN.items() if sensor.tag.startswith(kind)), "")
    if own and re.search(own, name, re.IGNORECASE):
        return ""
    said = [kinds for words, kinds in WORDS.items() if words.search(name)]
    return said[0][0] if len(said) == 1 and sensor.tag in KINDS and sensor.tag not in said[0] else ""
