"""A robot's camera looks through what stands close before it.

`znear` of `<map>` is no length: it is multiplied with the model's extent. With an extent of 80 m the default of 0.01 is
a plane 0.8 m ahead of the lens, and a small robot's camera sees nothing that is nearer. The extent of the 60 m wide
hall below is 120 m.

Bad:

    <mujoco>
      <worldbody>
        <geom name="wall" type="box" size="0.1 30 2" pos="30 0 2"/>
        <geom name="far_wall" type="box" size="0.1 30 2" pos="-30 0 2"/>
        <geom name="floor" type="plane" size="0 0 1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.05" mass="2"/>
          <camera name="front" pos="0.2 0 0.05" xyaxes="0 -1 0 0 0 1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

      <mujoco>
    +   <visual><map znear="0.0002"/></visual>

The number: how far the near plane is ahead of a camera that is fixed to a robot, over the robot's size; more than 0.5,
where something else is nearer at the start than 1.5 times the plane's distance. A camera of the world is told where all
of a mechanism before it is nearer than the plane.

When it is wrong: a camera that only looks at what is far away.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import CAM_FIXED, PLANE
from clinic.diagnosis.probes.shape import mechanisms, root_of
from clinic.diagnosis.probes.vector import Vector, dot, norm, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A near plane far before a robot's camera"
FAMILIES = ("camera",)
UNPLANTED = "no harm is measured in images"

FAR, NEAR = 0.5, 0.02  # of the size of what the camera is built on
NEARLY = 1.5  # times the plane's distance
IN_SIGHT = 0.9  # cosine


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The cameras on board of something before which the near plane is far, all together."""
    of = model.simulation
    plane = of.extent * of.model("vis.map.znear")[0]
    ahead = {each: _ahead(of, each) for each in range(of.count("camera"))}
    found = [each for each, share in ahead.items() if share > FAR and _meets(of, each, plane)]
    if not found:
        return
    worst = max(found, key=lambda each: ahead[each])
    value = rounded(NEAR * plane / ahead[worst] / of.extent)
    maps = list(model.source.elements("map")) if model.source else []
    edits = (set_attribute(maps[-1], "znear", value),) if maps else model.add("visual", f'<map znear="{value}"/>')
    now = f"{of.model('vis.map.znear')[0]:g}"
    says = f"znear {now} times the extent of {of.extent:.3g} m is {plane:.3g} m: what is nearer than that is not drawn."
    probe = Probe("the near plane's distance", "of the robot's size", _ahead, (worst,), dynamic=False)
    names = tuple(of.name("camera", each) for each in found)
    yield Suspect(names, "znear", now, value, edits, probe, FAR, says, "below half of the robot")


def _ahead(of: Simulation, camera: int) -> float:
    """How far ahead the near plane is, over the size of what the camera is on board of; 0 for one that is not."""
    owner = root_of(of)[of.body_of("camera", camera)]
    plane = of.extent * of.model("vis.map.znear")[0]
    places, size = _mechanisms(of).get(owner, ((), 0.0))
    of.begin()
    lens, view = of.data_row("cam_xpos", camera, 3), of.data_row("cam_xmat", camera, 9)[2::3]
    if not owner:  # of all that is before it, the far end of the nearest
        seen = [far for each, _ in _mechanisms(of).values() if (far := _far_end(lens, view, each))]
        return FAR * plane / min(seen) if seen else 0.0
    on_board = any(math.dist(lens, place) < size for place in places)
    return plane / size if on_board and int(of.model("cam_mode")[camera]) == CAM_FIXED else 0.0


def _far_end(lens: Vector, view: Vector, places: Sequence[Vector]) -> float:
    """How far ahead of a lens, which looks against `view`, the farthest of some places is; 0 if one is out of sight."""
    ahead = [(-dot(view, sub(place, lens)), math.dist(place, lens)) for place in places]
    return max(along for along, _ in ahead) if all(along > IN_SIGHT * far for along, far in ahead) else 0.0


@kept
def _mechanisms(of: Simulation) -> dict[int, tuple[list[Vector], float]]:
    """Where the geoms of each mechanism are at the start, and how large it is in m, by its root."""
    of.begin()
    radii = of.model("geom_rbound")
    made = {}
    for root, geoms in mechanisms(of).items():
        places = [of.data_row("geom_xpos", each, 3) for each in geoms]
        sides = [max(axis) - min(axis) for axis in zip(*places, strict=True)]
        made[root] = places, math.hypot(*sides) + 2 * max(radii[each] for each in geoms)
    return made


def _meets(of: Simulation, camera: int, plane: float) -> bool:
    """Whether something that the camera is not built on is at the start as near as the near plane, or nearly."""
    owners, bodies, radii = root_of(of), of.model("geom_bodyid"), of.model("geom_rbound")
    own, lens = owners[of.body_of("camera", camera)], of.data_row("cam_xpos", camera, 3)
    for geom, kind in enumerate(of.model("geom_type")):
        if owners[int(bodies[geom])] == own:
            continue
        to = sub(lens, of.data_row("geom_xpos", geom, 3))
        normal = of.data_row("geom_xmat", geom, 9)[2::3]
        if (abs(dot(to, normal)) if int(kind) == PLANE else norm(to) - radii[geom]) < NEARLY * plane:
            return True
    return False
