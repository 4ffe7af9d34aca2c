"""What a camera sees, by geometry: nothing is rendered."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from itertools import product

from clinic.diagnosis.edit import Edit, orient
from clinic.diagnosis.engine import CAM_FIXED, CAM_TRACK, CAM_TRACKCOM, HFIELD, PLANE
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.vector import IDENTITY, Vector, add, at, cross, dot, norm, sub, times, transpose, unit
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation

ASPECT = 1.0  # of the image's sides, where the model does not say
VISIBLE = 3  # groups from this one on are hidden by default
HEAD = re.compile("(?i)head|neck|skull")


def axes(simulation: Simulation, camera: int) -> tuple[Vector, Vector, Vector]:
    """The image's right and up, and the direction in which the camera looks, in the world at the start."""
    m = simulation.data_row("cam_xmat", camera, 9)
    return (m[0], m[3], m[6]), (m[1], m[4], m[7]), (-m[2], -m[5], -m[8])


def onlookers(simulation: Simulation) -> list[int]:
    """The cameras that look at the model from outside: fixed to the world, or following something."""
    bodies, modes = simulation.model("cam_bodyid"), simulation.model("cam_mode")
    made = []
    for camera, body in enumerate(bodies):
        still = int(body) == 0 and int(modes[camera]) == CAM_FIXED
        after = int(modes[camera]) in (CAM_TRACK, CAM_TRACKCOM)
        if still or after:
            made.append(camera)
    return made


def things(simulation: Simulation) -> list[int]:
    """The geoms that are something to look at: no floors, nothing hidden or clear."""
    kinds, groups = simulation.model("geom_type"), simulation.model("geom_group")
    return [
        geom
        for geom in range(simulation.count("geom"))
        if int(kinds[geom]) not in (PLANE, HFIELD)
        and groups[geom] < VISIBLE
        and simulation.row("geom_rgba", geom, 4)[3] > 0
    ]


def _sight(simulation: Simulation, camera: int) -> Callable[[Vector], float]:
    """Tells of a point how far along a camera's view it is in m at the start; 0 where it is out of the image."""
    simulation.begin()
    right, up, forward = axes(simulation, camera)
    place, tall, aspect = simulation.data_row("cam_xpos", camera, 3), *opening(simulation, camera)

    def ahead(point: Vector) -> float:
        way = sub(point, place)
        far = dot(way, forward)
        return far if abs(dot(way, up)) <= tall * far and abs(dot(way, right)) <= aspect * tall * far else 0.0

    return ahead


def in_sight(simulation: Simulation, camera: int) -> list[tuple[int, float]]:
    """The things whose centre is in a camera's image, and how far along its view they are in m."""
    sight = _sight(simulation, camera)
    positions = tuple(simulation.data("geom_xpos"))
    return [(geom, ahead) for geom in things(simulation) if (ahead := sight(at(positions, geom)))]


def sees(simulation: Simulation, camera: int, geom: int) -> bool:
    """Whether some of a geom may be in a camera's image: its box's middle, or a corner, or what is straight ahead."""
    sight = _sight(simulation, camera)
    place, (_, _, forward) = simulation.data_row("cam_xpos", camera, 3), axes(simulation, camera)
    frame, middle = simulation.data_row("geom_xmat", geom, 9), simulation.data_row("geom_xpos", geom, 3)
    x, y, z, *half = simulation.row("geom_aabb", geom, 6)
    near, far = through(simulation, geom, place, forward)
    corners = [(x + i * half[0], y + j * half[1], z + k * half[2]) for i, j, k in product((-1, 1), repeat=3)]
    ahead = max(0.0, near) <= far
    return ahead or any(sight(add(middle, times(frame, point))) for point in ((x, y, z), *corners))


def through(simulation: Simulation, geom: int, start: Vector, way: Vector) -> tuple[float, float]:
    """Where a line enters the box around a geom and leaves it, in lengths of `way` from its start.

    It misses the box where the first is greater than the second, and starts within it where 0 lies between them.
    """
    inverse = transpose(simulation.data_row("geom_xmat", geom, 9))
    box = simulation.row("geom_aabb", geom, 6)
    from_middle = sub(times(inverse, sub(start, simulation.data_row("geom_xpos", geom, 3))), box[:3])
    near, far = -math.inf, math.inf
    for each, along, reach in zip(from_middle, times(inverse, way), box[3:], strict=True):
        ends = [(side * reach - each) / (along or 1e-12) for side in (-1, 1)]
        near, far = max(near, min(ends)), min(far, max(ends))
    return near, far


def flat(model: ReaderModel, camera: int) -> bool:
    """Whether a camera is orthographic: its `fovy` is the height of the image in m at every distance."""
    written = {name: model.value("camera", camera, name) for name in ("projection", "orthographic")}
    return written["projection"] == "orthographic" or written["orthographic"] == "true"


def opening(simulation: Simulation, camera: int) -> tuple[float, float]:
    """Half of the image's height at a distance of 1, and its width as a share of its height; of perspective ones."""
    wide, high = (int(each) for each in simulation.row("cam_resolution", camera, 2))
    tall = math.tan(math.radians(min(simulation.model("cam_fovy")[camera], 179.0)) / 2)
    return tall, wide / high if wide > 1 and high > 1 else ASPECT


def middle(simulation: Simulation) -> Vector | None:
    """The mean place of what there is to look at; of what moves, where something does."""
    simulation.begin()
    positions, owner, bodies = tuple(simulation.data("geom_xpos")), root_of(simulation), simulation.model("geom_bodyid")
    seen = things(simulation)
    places = [at(positions, geom) for geom in ([each for each in seen if owner[int(bodies[each])]] or seen)]
    if not places:
        return None
    x, y, z = (sum(place[i] for place in places) / len(places) for i in range(3))
    return (x, y, z)


def turned(model: ReaderModel, camera: int, right: Sequence[float], up: Sequence[float]) -> tuple[Edit, ...]:
    """Edits that give a camera's image other axes, told in the world's frame."""
    element = model.element("camera", camera)
    if element is None:
        return ()
    simulation = model.simulation
    simulation.begin()
    body = simulation.body_of("camera", camera)
    m = simulation.data_row("xmat", body, 9)
    if int(simulation.model("cam_mode")[camera]) in (CAM_TRACK, CAM_TRACKCOM):
        m = m if any(m) else IDENTITY
    local = [sum(m[3 * row + column] * axis[row] for row in range(3)) for axis in (right, up) for column in range(3)]
    return orient(element, "xyaxes", " ".join(f"{round(each, 6) + 0.0:.4g}" for each in local))


def aimed(model: ReaderModel, camera: int) -> tuple[Edit, ...]:
    """Edits that let a camera look at the middle of things, upright."""
    simulation = model.simulation
    target = middle(simulation)
    if target is None:
        return ()
    way = sub(target, simulation.data_row("cam_xpos", camera, 3))
    if norm(way) < 1e-6:
        return ()
    forward = unit(way)
    right = unit(cross(forward, (0.0, 0.0, 1.0) if abs(forward[2]) < 0.99 else (0.0, 1.0, 0.0)))
    return turned(model, camera, right, cross(right, forward))
