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

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="hand" pos="0 0 0.5">
          <joint axis="0 1 0"/>
          <geom type="box" size="0.05 0.05 0.03" rgba="0.8 0.3 0.2 1"/>
          <camera name="wrist" pos="0 0 -0.13"/>
        </body>
      </worldbody>
    </mujoco>

The number: how many of nine rays through the image, the middle and those halfway to its edges and corners, meet the box
around a visible geom of the body that carries the camera, and of what is fixed to it; meshes are left out. All nine are
told, unless the camera is in such a box: of a shell only the outside is drawn. Nor is what is nearer than `znear` times
the extent, 1 % of the model's size: it is cut off.

When it is wrong: a camera that watches a part of its own mount.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.vector import Vector, add, at, sub, times, transpose
from clinic.diagnosis.probes.view import axes, opening, things, turned
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A camera that looks into its own mount"
FAMILIES = ("camera",)
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "few healthy models have a camera on a body"

MOST = 8.5
Box = tuple[Vector, Vector, Vector, Vector]  # place, turn, middle and half sizes of a geom's box


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera on a moving body that sees that body alone."""
    of = model.simulation
    moving = set(of.moving_bodies)
    for camera, body in enumerate(of.model("cam_bodyid")):
        if int(body) in moving and _blocked(of, camera) > MOST:
            right, up, _ = axes(of, camera)
            edits: tuple[Edit, ...] = turned(model, camera, sub((0.0, 0.0, 0.0), right), up)
            probe = Probe("rays of nine that meet the camera's own mount", "", _blocked, (camera,), dynamic=False)
            says = f"All of its image is {of.name('body', int(body))}, which carries it."
            value = edits[-1].value if edits else "away from its mount"
            names = (of.name("camera", camera),)
            yield Suspect(names, "xyaxes", "", value, edits, probe, MOST, says, "a view past its mount", level="hint")


def _blocked(of: Simulation, camera: int) -> float:
    of.begin()
    kinds, welds, bodies, own = (
        of.model("geom_type"),
        of.model("body_weldid"),
        of.model("geom_bodyid"),
        int(of.model("cam_bodyid")[camera]),
    )
    geoms = [geom for geom in things(of) if welds[int(bodies[geom])] == welds[own] and kinds[geom] != MESH]
    places, turns = tuple(of.data("geom_xpos")), tuple(of.data("geom_xmat"))
    boxes = [
        (at(places, geom), turns[9 * geom : 9 * geom + 9], box[:3], box[3:])
        for geom in geoms
        for box in [of.row("geom_aabb", geom, 6)]
    ]
    here = of.data_row("cam_xpos", camera, 3)
    if any(_within(box, here) for box in boxes):
        return 0.0
    right, up, forward = axes(of, camera)
    tall, aspect = opening(of, camera)
    rays = [add(add(forward, up, y * tall / 2), right, x * tall * aspect / 2) for x, y in product((-1, 0, 1), repeat=2)]
    nearest = of.model("vis.map.znear")[0] * of.model("stat.extent")[0]
    return float(sum(any(_meets(box, here, ray, nearest) for box in boxes) for ray in rays))


def _from_middle(box: Box, point: Vector) -> Vector:
    """A point in the axes of a box, from its middle."""
    place, turn, middle, _ = box
    return sub(times(transpose(turn), sub(point, place)), middle)


def _within(box: Box, point: Vector) -> bool:
    return all(abs(each) <= most for each, most in zip(_from_middle(box, point), box[3], strict=True))


def _meets(box: Box, start: Vector, way: Vector, nearest: float) -> bool:
    near, far = nearest, math.inf
    for each, along, most in zip(_from_middle(box, start), times(transpose(box[1]), way), box[3], strict=True):
        ends = sorted((side * most - each) / (along or 1e-12) for side in (-1, 1))
        near, far = max(near, ends[0]), min(far, ends[1])
    return nearest < near <= far
