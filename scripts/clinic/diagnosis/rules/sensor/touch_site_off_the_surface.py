"""A touch sensor's site does not reach the surface of anything that its body touches with.

A `<touch>` sensor sums the contacts of its site's own body that lie inside of the site, and contacts lie at the surface
of a geom. The default site, a sphere of 5 mm, hides in the middle of a finger; a site on the link above, or with a sign
changed, is beside it. Such a sensor reads 0 whatever the robot touches.

Bad:

    <mujoco>
      <worldbody>
        <body name="finger" pos="0 0 1">
          <joint name="close" type="slide" axis="0 1 0" range="0 0.04"/>
          <geom type="box" size="0.012 0.008 0.03"/>
          <site name="pad"/>
        </body>
      </worldbody>
      <sensor>
        <touch name="pad" site="pad"/>
      </sensor>
    </mujoco>

Good:

    -       <site name="pad"/>
    +       <site name="pad" type="box" size="0.014 0.01 0.032"/>

The number: 1 for a site of which all of 7 x 7 x 7 points lie more than 1 mm inside of the same geom, or outside of all
geoms of its body that collide. Bodies with meshes or planes are left alone.

When it is wrong: geoms that code lets collide later.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product

from clinic.diagnosis.engine import BOX, CAPSULE, CYLINDER, ELLIPSOID, SPHERE
from clinic.diagnosis.probes.shape import in_pairs, solid
from clinic.diagnosis.probes.touched import TOUCH
from clinic.diagnosis.probes.vector import Vector, add, norm, sub, times, transpose
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A touch sensor whose site is off the surface"
FAMILIES = ("sensor-reads-zero",)
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "what the sensor is to feel, only intent knows"

NEAR, SHARE = 1e-3, 0.1  # m; of the geom's smallest half size
FINE = 3  # points to each side
INSIDE, OUTSIDE = (
    "lies inside of its geom, and contacts are at the surface",
    "touches no geom of its body that collides",
)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Sites of touch sensors where no contact can be."""
    of = model.simulation
    for sensor, kind in enumerate(of.model("sensor_type")):
        site = int(of.model("sensor_objid")[sensor])
        if int(kind) != TOUCH or not (why := _why(of, site)):
            continue
        body = of.name("body", of.body_of("site", site))
        inside = why == INSIDE
        yield Suspect(
            (of.name("sensor", sensor), of.name("site", site)),
            "size" if inside else "pos",
            " ".join(f"{x:.3g}" for x in of.row("site_size" if inside else "site_pos", site, 3)),
            "a little larger than the geom" if inside else "at the surface of a geom of its body",
            (),
            Probe("1 where no contact can be inside of a touch sensor's site", "", _off, (site,), dynamic=False),
            0.5,
            f"{of.name('site', site)} of {body} {why}: the sensor reads 0.",
            "a site that holds the surface",
        )


def _off(of: Simulation, site: int) -> float:
    return float(bool(_why(of, site)))


def _why(of: Simulation, site: int) -> str:
    """Why no contact can be inside of a site; empty where one can."""
    body = of.body_of("site", site)
    pairs = in_pairs(of)
    geoms = [geom for geom in of.geoms_of(body) if solid(of, geom) or geom in pairs]
    if any(int(of.model("geom_type")[geom]) not in (SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX) for geom in geoms):
        return ""
    of.begin()
    points, spacing = _points(of, site)
    hidden = False
    for geom in geoms:
        far = [_distance(of, geom, point) for point in points]
        slack = min(NEAR, SHARE * min(of.row("geom_aabb", geom, 6)[3:])) + of.model("geom_margin")[geom]
        middle = sub(of.data_row("geom_xpos", geom, 3), of.data_row("site_xpos", site, 3))
        if max(far) < -slack:
            hidden = True
        elif min(far) <= slack + spacing or norm(middle) <= max(_half(of, "site", site)):
            return ""
    return INSIDE if hidden else OUTSIDE


def _half(of: Simulation, kind: str, index: int) -> Vector:
    """The half sizes of a geom's or site's box, along its own axes."""
    shape, (a, b, c) = int(of.model(f"{kind}_type")[index]), of.row(f"{kind}_size", index, 3)
    if shape in (SPHERE, CAPSULE, CYLINDER):
        return (a, a, {SPHERE: a, CAPSULE: a + b, CYLINDER: b}[shape])
    return (a, b, c)


def _points(of: Simulation, site: int) -> tuple[list[Vector], float]:
    """Points all over a site, in the world, and how far apart they are."""
    half, frame, place = _half(of, "site", site), of.data_row("site_xmat", site, 9), of.data_row("site_xpos", site, 3)
    shape = int(of.model("site_type")[site])
    steps = [step / FINE for step in range(-FINE, FINE + 1)]
    made = []
    for x, y, z in product(steps, repeat=3):
        if shape == BOX or (shape == CYLINDER and math.hypot(x, y) <= 1) or math.hypot(x, y, z) <= 1:
            made.append(add(place, times(frame, (x * half[0], y * half[1], z * half[2]))))
    return made, max(half) / FINE


def _distance(of: Simulation, geom: int, point: Vector) -> float:
    """How far a point is outside of a geom in m; negative inside."""
    shape, half = int(of.model("geom_type")[geom]), _half(of, "geom", geom)
    x, y, z = times(transpose(of.data_row("geom_xmat", geom, 9)), sub(point, of.data_row("geom_xpos", geom, 3)))
    if shape == SPHERE:
        return math.hypot(x, y, z) - half[0]
    if shape == CAPSULE:
        return math.hypot(x, y, max(0.0, abs(z) - (half[2] - half[0]))) - half[0]
    if shape == ELLIPSOID:
        return (math.hypot(*(each / size for each, size in zip((x, y, z), half, strict=True))) - 1) * min(half)
    if shape == CYLINDER:
        over = [math.hypot(x, y) - half[0], abs(z) - half[2]]
    else:
        over = [abs(each) - size for each, size in zip((x, y, z), half, strict=True)]
    outside = math.hypot(*(max(each, 0.0) for each in over))
    return outside if outside > 0 else max(over)
