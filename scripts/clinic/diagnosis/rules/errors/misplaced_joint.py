"""A joint where none can be, or more than a body can have.

A free joint belongs to a body directly below the world, alone. The world has no joints. A plane or height field does
not move. A body has at most six degrees of freedom, and a ball joint is not followed by a hinge.

Bad:

    <mujoco>
      <worldbody>
        <body name="base">
          <geom name="foot" type="box" size="0.05 0.05 0.05"/>
          <body name="robot" pos="0 0 1">
            <freejoint name="root"/>
            <geom name="trunk" type="box" size="0.05 0.05 0.05"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom name="foot" type="box" size="0.05 0.05 0.05"/>
        <body name="robot" pos="0 0 1">
          <freejoint name="root"/>
          <geom name="trunk" type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit, which takes the joint out.

When it is wrong: where the body is meant to move: move it below the world instead.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import delete, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "A joint where none can be"
FAMILIES = ("will-not-compile",)
SINCE = "0.1"

SAID = ("free joint can only", "World body cannot have joints", "more than 6 dofs", "ball followed by")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joint that is too much, taken out; a plane in a moving body, made a box."""
    said = sentence(model)
    for element in meant(model):
        if any(said.startswith(each) for each in SAID):
            joints = [each for each in element.walk() if each.tag in ("joint", "freejoint") and _own(each, element)]
            for joint in [each for each in joints if _free(each)] + joints[::-1]:
                yield mends(joint, (delete(joint),), f"{said}.", value="removed")
        elif said.startswith("plane only allowed"):
            planes = [each for each in element.walk() if each.get("type") == "plane"]
            for plane in planes[:1]:
                yield mends(plane, (set_attribute(plane, "type", "box"),), f"{said}.", attribute="type", value="box")


def _own(joint: Element, element: Element) -> bool:
    return joint is element or joint.parent is element or (joint.parent is not None and joint.parent.tag == "frame")


def _free(joint: Element) -> bool:
    return joint.tag == "freejoint" or joint.get("type") == "free"
