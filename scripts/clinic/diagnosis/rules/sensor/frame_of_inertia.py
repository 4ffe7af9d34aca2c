"""A sensor of a body's orientation reads the axes of its inertia.

With `objtype="body"` MuJoCo means the inertial frame, whose axes are the principal axes of inertia; the frame that is
written in the XML is `xbody`. The torso below stands upright, and reads as turned by 24.5 degrees.

Bad:

    <mujoco>
      <worldbody>
        <body name="torso" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.15 0.2" mass="5"/>
          <geom type="box" pos="-0.15 0 0.1" size="0.05 0.1 0.1" mass="2"/>
          <body pos="0 0 0.25">
            <joint axis="0 1 0"/>
            <geom size="0.05" mass="0.5"/>
          </body>
        </body>
      </worldbody>
      <sensor>
        <framequat name="orientation" objtype="body" objname="torso"/>
      </sensor>
    </mujoco>

Good:

    -     <framequat name="orientation" objtype="body" objname="torso"/>
    +     <framequat name="orientation" objtype="xbody" objname="torso"/>

The number: the angle between the two frames of the body, in degrees; told of `framequat` and `framexaxis`, `frameyaxis`
and `framezaxis` from 5 degrees on, and where such a body is what a frame is measured in. MuJoCo's manual, XML
Reference, framepos.

When it is wrong: where the principal axes are what is to be read.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An orientation of the inertia's axes"
FAMILIES = ("wrong-numbers",)
UNPLANTED = "hardly any healthy model reads the orientation of a body"

TURNED = 5.0  # degrees
ORIENTATIONS = ("framequat", "framexaxis", "frameyaxis", "framezaxis")
SIDES = {"objtype": "objname", "reftype": "refname"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor of an orientation in an inertial frame that is turned, all of one body together."""
    of = model.simulation
    found: dict[str, list[tuple[Element, str]]] = {}
    for element in model.source.section("sensor") if model.source else ():
        for side, name in SIDES.items():
            if element.tag in ORIENTATIONS and element.get(side) == "body":
                found.setdefault(element.get(name), []).append((element, side))
    known = {*of.names("body")} if found else set()
    for name, sensors in found.items():
        if name not in known or (turned := _turned(of, name)) <= TURNED:
            continue
        names = tuple(f'sensor "{each.get("name")}"' if each.get("name") else f"<{each.tag}>" for each, _ in sensors)
        side = sensors[0][1]
        edits = tuple(set_attribute(element, side, "xbody") for element, side in sensors)
        says = f'The principal axes of body "{name}" are turned by {turned:.3g} degrees from the axes of its frame.'
        probe = Probe("angle of a body's inertial frame to its own", "degrees", _turned, (name,), dynamic=False)
        yield Suspect((*names, f'body "{name}"'), side, "body", "xbody", edits, probe, TURNED, says, at=sensors[0][0])


def _turned(of: Simulation, body: str) -> float:
    """The angle between a body's frame and its principal axes, in degrees."""
    w = of.row("body_iquat", of.names("body").index(body), 4)[0]
    return 2 * math.degrees(math.acos(min(1.0, abs(w))))
