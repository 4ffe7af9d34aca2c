"""An inertia that no body can have.

The three principal moments of a real body satisfy A + B >= C; a full inertia is positive definite; and an inertia is
given once, by `diaginertia` or by `fullinertia`. Values that were rounded, typed or exported wrongly break this.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="1"/>
          <inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="1"/>
          <inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
        </body>
      </worldbody>
    </mujoco>

The number: A + B >= C is checked by MuJoCo. `balanceinertia="true"` sets all three to their mean.

When it is wrong: the mean is a stopgap; the right numbers stand in the CAD model.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.suspect import Suspect

TITLE = "An impossible inertia"
FAMILIES = ("will-not-compile",)
SINCE = "0.2"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Moments that are balanced, or one of two inertias that is taken off."""
    said = sentence(model)
    if model.source is None or not any(word in said for word in ("A + B", "inertia", "eigenvalue")):
        return
    if "mjMINVAL" in said:
        return
    for element in meant(model):
        inertial = element if element.tag == "inertial" else element.first("inertial") or element
        if "fullinertia" in inertial.attributes:
            for attribute in ("diaginertia", "quat", "euler", "axisangle", "xyaxes", "zaxis"):
                if attribute in inertial.attributes:
                    edits = (remove_attribute(inertial, attribute),)
                    now = inertial.get(attribute)
                    yield mends(inertial, edits, f"{said}.", attribute=attribute, now=now, value="none")
            numbers = inertial.get("fullinertia").split()
            if len(numbers) == 6:
                edits = (set_attribute(inertial, "fullinertia", " ".join([*numbers[:3], "0", "0", "0"])),)
                now = inertial.get("fullinertia")
                yield mends(inertial, edits, f"{said}.", attribute="fullinertia", now=now, value=edits[0].value)
        if "A + B" in said:
            balanced = model.option("balanceinertia", "true", "compiler")
            now = inertial.get("diaginertia") or inertial.get("fullinertia")
            yield mends(inertial, balanced, f"{said}.", attribute="diaginertia", now=now, value="balanced")
            return
