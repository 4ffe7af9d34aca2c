"""A camera looks into the body that carries it.

A camera looks along -z of its frame. Where that was taken for +z or for x, or `euler` has a turn too few, a camera on a
hand or a head looks at its own mount, and its image shows little else.

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
whole robot; meshes are left out. Told where all nine do. What the camera is in does not count: of a shell only the
outside is drawn. Nor does what is nearer than `znear` times the extent, by default 1 % of that: it is cut off.
Orthographic cameras are not asked.

A camera that is below a plane and does not look up is told too, where what carries it, or most of what there is to see,
is above.

And so is the one of a left and a right camera of a body, turned alike, that looks towards the other: two eyes that look
ahead are beside each other. So is the camera on a hand that looks the other way than the fingers on it are, to 45
degrees. So is one called after a wrist, a hand, a gripper or a tool that looks away from all that moves beyond it. So
is a camera on what drives, flies or walks that is off its middle by half of the way to the edge and more, and looks
level and back over the middle, lengthways, from no higher than a quarter of that way above all the rest. One that is
called after a driver or a pilot, or that follows or chases, is left alone.

When it is wrong: a camera that watches a part of its own mount.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import product

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import CAM_FIXED, MESH, PLANE
from clinic.diagnosis.probes.shape import boxes
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.vector import add, dot, flipped, sub, times, transpose, unit, written
from clinic.diagnosis.probes.view import HEAD, axes, flat, opening, things, through, turned
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A camera that looks into its own mount"
FAMILIES = ("camera",)
UNPLANTED = "few healthy models have a camera on a body"

MOST = 8.5  # of nine rays
UPRIGHT = 0.7  # cosine of a floor's slope
FINGER = re.compile(r"(?i)finger|jaw|claw|thumb")
ALONG = 0.7  # cosine of the angle between a view and the fingers' middle
WRIST = re.compile(r"(?i)wrist|hand(?!le)|grip|tool|(?<![a-z])eef?(?![a-z])")
WATCHES = re.compile(r"(?i)driver|pilot|follow|chase")
BACK, MAST, SLOPE = 0.5, 0.25, 0.5  # of half a length, both; sine of a view's slope
SAME, BESIDE = 1e-6, 0.8  # of quaternions; cosine of the angle between a view and the way to the twin


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera on a moving body that sees that body alone, or on a head that sees its robot alone."""
    of = model.simulation
    yield from _buried(model)
    yield from _inwards(model)
    yield from _backwards(model)
    yield from _across(model)
    moving = set(of.moving_bodies)
    for camera, body in enumerate(of.model("cam_bodyid")):
        if int(body) in moving and not flat(model, camera) and _blocked(of, camera) > MOST:
            right, up, _ = axes(of, camera)
            edits: tuple[Edit, ...] = turned(model, camera, sub((0.0, 0.0, 0.0), right), up)
            probe = Probe("rays of nine that meet the camera's own mount", "", _blocked, (camera,), dynamic=False)
            carrier = of.name("body", int(body))
            seen = f"the robot of {carrier}" if HEAD.search(carrier) else f"{carrier}, which carries it"
            says = f"All nine rays through its image meet {seen}."
            value = edits[-1].value if edits else "away from its mount"
            names = (of.name("camera", camera),)
            yield Suspect(names, "xyaxes", "", value, edits, probe, MOST, says, "a view past its mount", level="hint")


def _buried(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera below a floor, with the sign of the coordinate that brings it above."""
    of = model.simulation
    for camera in range(of.count("camera")):
        if (deep := _depth(of, camera)) <= 0:
            continue
        place = of.row("cam_pos", camera, 3)
        probe = Probe("how deep the camera is below a floor", "m", _depth, (camera,), dynamic=False)
        turned = [written(flipped(place, at)) for at in (2, 1, 0) if place[at]]
        every = [model.set("camera", [camera], "pos", value) for value in turned]
        edits = next((each for each in every if each and model.measured(probe, each) <= 0), ())
        says = f"It is {deep:.2g} m below a floor."
        name, value = of.name("camera", camera), edits[0].value if edits else "above the floor"
        yield Suspect((name,), "pos", written(place), value, edits, probe, 0, says, "above the floor")


def _inwards(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera that has the orientation of its twin, and looks towards it through what carries both."""
    of = model.simulation
    for camera, twin in _copied(of):
        right, up, _ = axes(of, camera)
        edits = turned(model, camera, sub((0.0, 0.0, 0.0), right), up)
        names = of.name("camera", camera), of.name("camera", twin)
        says = f"It is turned as {names[1]} is, and looks towards it; that one looks away."
        value = edits[-1].value if edits else "the mirror image of its twin"
        probe = how_many("cameras that look towards their twins, which look away", _copied)
        yield Suspect(names, "xyaxes", "", value, edits, probe, 0, says, "both away from each other", level="hint")


def _backwards(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera on a hand that looks the other way than its fingers point, turned by half a turn about its up."""
    of = model.simulation
    for camera in range(of.count("camera")):
        if _along_fingers(of, camera) < -ALONG:
            right, up, _ = axes(of, camera)
            edits = turned(model, camera, sub((0.0, 0.0, 0.0), right), up)
            name, value = of.name("camera", camera), edits[-1].value if edits else "towards the fingers"
            probe = Probe("cosine of its view and the way from the fingers", "", _away, (camera,), dynamic=False)
            says = f"It looks away from the fingers or jaws beyond {of.name('body', of.body_of('camera', camera))}."
            yield Suspect((name,), "xyaxes", "", value, edits, probe, ALONG, says, "along the fingers", level="hint")


def _across(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera near an edge of what moves about that looks back over its middle, turned by half a turn."""
    of = model.simulation
    for camera in range(of.count("camera")):
        if (share := _over_itself(of, camera)) > BACK:
            right, up, _ = axes(of, camera)
            edits = turned(model, camera, sub((0.0, 0.0, 0.0), right), up)
            carrier, name = of.name("body", of.body_of("camera", camera)), of.name("camera", camera)
            probe = Probe("how far behind the middle, in half lengths", "", _over_itself, (camera,), dynamic=False)
            says = f"It looks back over the middle of {carrier}, {share:.2g} of half its length away."
            value = edits[-1].value if edits else "away from the middle"
            yield Suspect((name,), "xyaxes", "", value, edits, probe, BACK, says, "away from the middle", level="hint")


def _over_itself(of: Simulation, camera: int) -> float:
    """How far a level camera on a free body is behind its middle along the view, in half lengths; 0 from outside."""
    body = of.body_of("camera", camera)
    watches = WATCHES.search(of.names("camera")[camera])
    if watches or body not in of.free_bodies or int(of.model("cam_mode")[camera]) != CAM_FIXED:
        return 0.0
    of.begin()
    view, here = axes(of, camera)[2], of.data_row("cam_xpos", camera, 3)
    ends = list(boxes(of, of.geoms_of(body)).values())
    if abs(view[2]) > SLOPE or not ends:
        return 0.0
    low, high = (
        [pick(at[i] + sign * half[i] for at, half in ends) for i in (0, 1, 2)] for pick, sign in ((min, -1), (max, 1))
    )
    within = all(low[i] <= here[i] <= high[i] for i in (0, 1))
    length = sum(abs(view[i]) * (high[i] - low[i]) / 2 for i in (0, 1))
    behind = sum(view[i] * ((low[i] + high[i]) / 2 - here[i]) for i in (0, 1))
    mast = here[2] - high[2] > MAST * length  # which looks over its own front
    lengthways = 2 * length > max(high[i] - low[i] for i in (0, 1)) / 2
    return behind / length if within and lengthways and not mast else 0.0


def _away(of: Simulation, camera: int) -> float:
    return -_along_fingers(of, camera)


def _along_fingers(of: Simulation, camera: int) -> float:
    """The cosine of a camera's view and the way from its hand to the middle of the fingers on it; 0 without two."""
    body = of.body_of("camera", camera)
    names = of.names("body")
    fingers = [each for each in of.children.get(body, []) if FINGER.search(names[each]) and of.joints_of(each)]
    if len(fingers) < 2 and WRIST.search(of.names("camera")[camera]):  # all that moves beyond it
        fingers = [each for each in of.children.get(body, []) if any(map(of.joints_of, of.below(each)))]
        joints = [joint for each in fingers for below in of.below(each) for joint in of.joints_of(below)]
        fingers = [each for each in fingers if of.model("body_subtreemass")[each] > 0 and len(joints) > 1]
    elif len(fingers) < 2:
        return 0.0
    if not body or not fingers or int(of.model("cam_mode")[camera]) != CAM_FIXED:
        return 0.0
    of.begin()
    middle = [sum(of.data_row("subtree_com", each, 3)[i] for each in fingers) / len(fingers) for i in range(3)]
    return dot(axes(of, camera)[2], unit(sub(middle, of.data_row("xpos", body, 3))))


def _copied(of: Simulation) -> list[tuple[int, int]]:
    """The cameras on a body that look towards their left or right twin on it and are turned as that is, with it."""
    of.begin()
    made = []
    for pair in by_name(of, "camera"):
        bodies = {of.body_of("camera", each) for each in pair}
        turns = [of.row("cam_quat", each, 4) for each in pair]
        if len(bodies) == 2 or 0 in bodies or max(map(abs, sub(*turns))) > SAME:
            continue
        way = unit(sub(*(of.data_row("cam_xpos", each, 3) for each in reversed(pair))))
        towards = dot(axes(of, pair[0])[2], way)
        if abs(towards) > BESIDE:
            made.append(pair if towards > 0 else (pair[1], pair[0]))
    return made


def _depth(of: Simulation, camera: int) -> float:
    """How deep a camera is below a floor that what carries it is above; for one of the world, what there is to see."""
    of.begin()
    kinds, here, body = of.model("geom_type"), of.data_row("cam_xpos", camera, 3), of.body_of("camera", camera)
    others = [of.data_row("geom_xpos", geom, 3) for geom in things(of)]
    if body:
        others = [of.data_row("xpos", body, 3)]
    deepest = 0.0
    for geom, kind in enumerate(kinds):
        frame, size = of.data_row("geom_xmat", geom, 9), of.row("geom_size", geom, 3)
        if int(kind) != PLANE or frame[8] < UPRIGHT:
            continue
        origin, up = of.data_row("geom_xpos", geom, 3), (frame[2], frame[5], frame[8])
        x, y, z = times(transpose(frame), sub(here, origin))
        beside = any(half and abs(at) > half for at, half in zip((x, y), size, strict=False))
        above = [dot(up, sub(other, origin)) > 0 for other in others]
        if not beside and 2 * sum(above) > len(above) and dot(up, axes(of, camera)[2]) < UPRIGHT:
            deepest = max(deepest, -z)
    return deepest


def _blocked(of: Simulation, camera: int) -> float:
    of.begin()
    kinds, bodies, body = of.model("geom_type"), of.model("geom_bodyid"), of.body_of("camera", camera)
    part_of = of.model("body_rootid" if HEAD.search(of.name("body", body)) else "body_weldid")
    geoms = [geom for geom in things(of) if part_of[int(bodies[geom])] == part_of[body] and kinds[geom] != MESH]
    here, (right, up, forward) = of.data_row("cam_xpos", camera, 3), axes(of, camera)
    tall, aspect = opening(of, camera)
    rays = [add(add(forward, up, y * tall / 2), right, x * tall * aspect / 2) for x, y in product((-1, 0, 1), repeat=2)]
    met = [[through(of, geom, here, ray) for geom in geoms] for ray in rays]
    around = {which for which, (near, far) in enumerate(met[0]) if near <= 0 <= far}
    met = [[each for which, each in enumerate(ray) if which not in around] for ray in met]
    nearest = of.model("vis.map.znear")[0] * of.extent
    return float(sum(any(nearest < near <= far for near, far in each) for each in met))
