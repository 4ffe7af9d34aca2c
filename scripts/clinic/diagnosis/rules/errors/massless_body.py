"""A moving body has no mass, or no inertia.

A body that a joint moves, with no geom and no `<inertial>`, or with geoms without mass, cannot be accelerated: `mass
and inertia of moving bodies must be larger than mjMINVAL`. Empty frames of a URDF and helper links are the usual
ones.

Bad:

    <mujoco>
      <worldbody>
        <body name="wrist" pos="0 0 1">
          <joint name="turn" axis="0 0 1"/>
          <site name="tip" pos="0.1 0 0"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="wrist" pos="0 0 1">
          <joint name="turn" axis="0 0 1"/>
          <inertial pos="0 0 0" mass="0.01" diaginertia="1e-5 1e-5 1e-5"/>
          <site name="tip" pos="0.1 0 0"/>
        </body>
      </worldbody>
    </mujoco>

The number: mjMINVAL is 1e-15. The edit gives the body 10 g and the inertia of a ball of 50 mm radius.

When it is wrong: the body may not be meant to move: then its joint is too much.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, delete, insert
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "A moving body without mass"
FAMILIES = ("will-not-compile",)
SINCE = "0.2"

INERTIAL = '<inertial pos="0 0 0" mass="0.01" diaginertia="1e-5 1e-5 1e-5"/>'
IN_URDF = '<inertial><mass value="0.01"/><inertia ixx="1e-5" iyy="1e-5" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial>'


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies that are too light, with a little mass."""
    if "must be larger than mjMINVAL" not in model.error or model.source is None:
        return
    xml = IN_URDF if model.source.urdf else INERTIAL
    for element in meant(model, "body", "link")[:1]:
        says = f'{element.tag} "{element.get("name")}" moves and has no mass: {sentence(model)}.'
        yield mends(element, _edits(element, xml), says, attribute="mass", now="0", value="0.01")


def _edits(element: Element, xml: str) -> tuple[Edit, ...]:
    there = element.first("inertial")
    return (*((delete(there),) if there else ()), insert(element, xml))
