"""An actuator has a `lengthrange`, and is no muscle: nothing reads it.

`lengthrange` tells a muscle how its tendon's length is scaled. For any other actuator it does nothing. A `<general>`
without gains is a motor: its control is a force, whatever lengths it is told. `<position>` with a `ctrlrange` holds a
length.

Bad:

    <mujoco>
      <worldbody>
        <site name="wall"/>
        <body pos="1 0 0">
          <joint type="slide" axis="1 0 0" damping="5"/>
          <geom type="box" size="0.1 0.1 0.1"/>
          <site name="load"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope">
          <site site="wall"/>
          <site site="load"/>
        </spatial>
      </tendon>
      <actuator>
        <general tendon="rope" lengthrange="0.5 1"/>
      </actuator>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <site name="wall"/>
        <body pos="1 0 0">
          <joint type="slide" axis="1 0 0" damping="5"/>
          <geom type="box" size="0.1 0.1 0.1"/>
          <site name="load"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope">
          <site site="wall"/>
          <site site="load"/>
        </spatial>
      </tendon>
      <actuator>
        <position tendon="rope" ctrlrange="0.5 1" kp="100" dampratio="1"/>
      </actuator>
    </mujoco>

The number: how many actuators without a muscle's gain and bias have the attribute. MuJoCo's manual, XML reference,
actuator/general: `lengthrange` is the range of feasible lengths, which muscles use.

When it is wrong: a range that your own code reads.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A lengthrange that nothing reads"
FAMILIES = ("stuck", "drifts", "wrong-numbers")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "no healthy model has the attribute but on muscles"

MUSCLE, USER = 2, 3  # mjtGain, mjtBias


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The actuators with a `lengthrange` that are no muscles, all together."""
    of, found = model.simulation, []
    for actuator in range(of.count("actuator")):
        kinds = {int(of.model(f"actuator_{what}type")[actuator]) for what in ("gain", "bias")}
        element = model.element("actuator", actuator)
        if not kinds & {MUSCLE, USER} and element is not None and "lengthrange" in element.attributes:
            found.append((actuator, element))
    if not found:
        return
    first = found[0][1]
    motor = not any(of.bias(found[0][0])[:3])
    says = "It is no muscle, and nothing else reads its lengthrange."
    says += " Its control is a force." if motor else ""
    edits = tuple(remove_attribute(element, "lengthrange") for _, element in found)
    names = tuple(of.name("actuator", actuator) for actuator, _ in found)
    value = "<position> with a ctrlrange" if motor else "none"
    probe = counted("ranges of lengths that nothing reads", len(found))
    now = first.get("lengthrange")
    yield Suspect(names, "lengthrange", now, value, edits, probe, 0, says, "none, or a muscle", level="hint", at=first)
