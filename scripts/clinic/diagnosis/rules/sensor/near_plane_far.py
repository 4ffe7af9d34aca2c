"""A robot's camera looks through what stands close before it.

`znear` of `<map>` is no length: it is multiplied with the model's extent. In a hall of 80 m the default of 0.01 is a
plane 0.8 m ahead of the lens, and a small robot's camera sees nothing that is nearer.

Bad:

    <mujoco>
      <worldbody>
        <geom name="wall" type="box" size="0.1 30 2" pos="30 0 2"/>
        <geom name="far_wall" type="box" size="0.1 30 2" pos="-30 0 2"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.05"/>
          <camera name="front" pos="0.2 0 0.05" xyaxes="0 -1 0 0 0 1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

      <mujoco>
    +   <visual><map znear="0.0002"/></visual>

The number: how far ahead of a camera that moves along the near plane is, over the size of what the camera is built on;
more than 0.5.

When it is wrong: a camera that only looks at what is far away.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import HFIELD, PLANE
from clinic.diagnosis.probes.shape import geoms_of_tree, root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A near plane far before a robot's camera"
FAMILIES = ("camera",)
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "no harm is measured in images"

FAR, NEAR = 0.5, 0.02  # of the size of what the camera is built on


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The cameras of moving bodies before which the near plane is far, all together."""
    of = model.simulation
    found = [each for each in range(of.count("camera")) if _ahead(of, each) > FAR]
    if not found:
        return
    worst = max(found, key=lambda each: _ahead(of, each))
    extent = of.model("stat.extent")[0]
    plane = extent * of.model("vis.map.znear")[0]
    value = rounded(NEAR * plane / _ahead(of, worst) / extent)
    maps = list(model.source.elements("map")) if model.source else []
    edits = (set_attribute(maps[-1], "znear", value),) if maps else model.add("visual", f'<map znear="{value}"/>')
    now = f"{of.model('vis.map.znear')[0]:g}"
    says = f"znear {now} times the extent of {extent:.3g} m is {plane:.3g} m: what is nearer to it is not drawn."
    probe = Probe("the near plane's distance", "of the robot's size", _ahead, (worst,), dynamic=False)
    names = tuple(of.name("camera", each) for each in found)
    yield Suspect(names, "znear", now, value, edits, probe, FAR, says, "below half of the robot")


def _ahead(of: Simulation, camera: int) -> float:
    """How far ahead the near plane is, over the size of what the camera is built on; 0 for one that stands still."""
    body = int(of.model("cam_bodyid")[camera])
    root, kinds = root_of(of)[body], of.model("geom_type")
    geoms = [each for each in geoms_of_tree(of, root) if int(kinds[each]) not in (PLANE, HFIELD)] if root else []
    if not geoms or int(of.model("cam_mode")[camera]) != 0:
        return 0.0
    of.begin()
    places = [of.data_row("geom_xpos", each, 3) for each in geoms]
    sides = [max(axis) - min(axis) for axis in zip(*places, strict=True)]
    size = math.hypot(*sides) + 2 * max(of.model("geom_rbound")[each] for each in geoms)
    return of.model("stat.extent")[0] * of.model("vis.map.znear")[0] / size
