"""A camera looks into the body that carries it.

A camera looks along -z of its frame. Where that was taken for +z or for x, or `euler` has a turn too few, a camera on a
hand or a head looks at its own mount, and the image is of one colour.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="hand" pos="0 0 0.5">
          <joint axis="0 1 0"/>
          <geom type="box" size="0.05 0.05 0.03" rgba="0.8 0.3 0.2 1"/>
          <camera name="wrist" pos="0 0 -0.13" euler="180 0 0"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <camera name="wrist" pos="0 0 -0.13" euler="180 0 0"/>
    +       <camera name="wrist" pos="0 0 -0.13"/>

The number: how many of nine rays through the image, the middle and those halfway to its edges and corners, meet the box
around a visible geom of the body that carries the camera, and of what is fixed to it, or, of a head's camera, of its
whole robot; meshes are left out. All nine are told. What the camera is in does not count: of a shell only the outside
is drawn. Nor does what is nearer than `znear` times the extent, 1 % of the model's size: it is cut off.

When it is wrong: a camera that watches a part of its own mount.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.vector import add, sub
from clinic.diagnosis.probes.view import HEAD, axes, opening, things, through, turned
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A camera that looks into its own mount"
FAMILIES = ("camera",)
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "few healthy models have a camera on a body"

MOST = 8.5  # of nine rays


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera on a moving body that sees that body alone, or on a head that sees its robot alone."""
    of = model.simulation
    moving = set(of.moving_bodies)
    for camera, body in enumerate(of.model("cam_bodyid")):
        if int(body) in moving and _blocked(of, camera) > MOST:
            right, up, _ = axes(of, camera)
            edits: tuple[Edit, ...] = turned(model, camera, sub((0.0, 0.0, 0.0), right), up)
            probe = Probe("rays of nine that meet the camera's own mount", "", _blocked, (camera,), dynamic=False)
            carrier = of.name("body", int(body))
            seen = f"the robot of {carrier}" if HEAD.search(carrier) else f"{carrier}, which carries it"
            says = f"All of its image is {seen}."
            value = edits[-1].value if edits else "away from its mount"
            names = (of.name("camera", camera),)
            yield Suspect(names, "xyaxes", "", value, edits, probe, MOST, says, "a view past its mount", level="hint")


def _blocked(of: Simulation, camera: int) -> float:
    of.begin()
    kinds, bodies, body = of.model("geom_type"), of.model("geom_bodyid"), int(of.model("cam_bodyid")[camera])
    part_of = of.model("body_rootid" if HEAD.search(of.name("body", body)) else "body_weldid")
    geoms = [geom for geom in things(of) if part_of[int(bodies[geom])] == part_of[body] and kinds[geom] != MESH]
    here, (right, up, forward) = of.data_row("cam_xpos", camera, 3), axes(of, camera)
    tall, aspect = opening(of, camera)
    rays = [add(add(forward, up, y * tall / 2), right, x * tall * aspect / 2) for x, y in product((-1, 0, 1), repeat=2)]
    met = [[through(of, geom, here, ray) for geom in geoms] for ray in rays]
    around = {which for which, (near, far) in enumerate(met[0]) if near <= 0 <= far}
    met = [[each for which, each in enumerate(ray) if which not in around] for ray in met]
    nearest = of.model("vis.map.znear")[0] * of.model("stat.extent")[0]
    return float(sum(any(nearest < near <= far for near, far in each) for each in met))
