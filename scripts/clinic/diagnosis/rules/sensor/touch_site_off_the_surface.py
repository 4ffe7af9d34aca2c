"""A touch sensor's site does not reach the surface of anything that its body touches with.

A `<touch>` sensor sums the contacts of its site's own body that lie inside of the site, or whose normal meets it on the
way out of the body. Contacts lie at the surface of a geom. The default site, a sphere of 5 mm, hides in the middle of a
finger, and reads none of its contacts. A site with a sign changed is beside the finger, and reads only contacts whose
normal happens to meet it.

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

The number: 1 for a site of which all of 7 x 7 x 7 points lie more than 1 mm inside of the same geom, or that is farther
than that from all geoms of its body that collide; of a thin geom it is a tenth of its half size. Bodies with meshes or
planes are left alone. Where no geom of the body collides, and one is at the site, that one's masks are told.

When it is wrong: geoms that code lets collide later, or a site that stands before the surface on purpose.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product

from clinic.diagnosis.engine import BOX, CAPSULE, CYLINDER, ELLIPSOID, SENS_TOUCH, SPHERE
from clinic.diagnosis.probes.shape import in_pairs, solid
from clinic.diagnosis.probes.vector import Vector, add, sub, times, transpose
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A touch sensor whose site is off the surface"
FAMILIES = ("sensor-reads-zero",)
UNPLANTED = "what the sensor is to feel, only intent knows"

NEAR, SHARE = 1e-3, 0.1  # m; of the geom's smallest half size
TINY = 1e-9
FINE, HALVINGS = 3, 7  # points to each side; of the way between two, in search of the nearest
INSIDE, OUTSIDE = (
    "lies inside of its geom, and contacts are at the surface",
    "touches no geom of its body that collides",
)
READS = {INSIDE: "the sensor reads none of these", OUTSIDE: "the sensor reads only contacts whose normal meets it"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Sites of touch sensors where no contact can be."""
    of = model.simulation
    for sensor, kind in enumerate(of.model("sensor_type")):
        site = int(of.model("sensor_objid")[sensor])
        if int(kind) != SENS_TOUCH or not (reason := why(of, site)):
            continue
        body = of.name("body", of.body_of("site", site))
        inside = reason == INSIDE
        if geoms := _bare_at(of, site):
            edits = model.set("geom", geoms, "contype", "1") + model.set("geom", geoms, "conaffinity", "1")
            names = of.name("geom", geoms[0]), of.name("sensor", sensor), of.name("site", site)
            probe = Probe("1 where no contact can be inside of a touch sensor's site", "", _off, (site,), dynamic=False)
            says = f"No geom of {body} collides, {names[0]} neither, which is in {names[2]}: the sensor reads 0."
            yield Suspect(
                names, "contype, conaffinity", "0, 0", "1, 1", edits, probe, 0.5, says, "a geom that collides"
            )
            continue
        yield Suspect(
            (of.name("sensor", sensor), of.name("site", site)),
            "size" if inside else "pos",
            " ".join(f"{x:.3g}" for x in of.row("site_size" if inside else "site_pos", site, 3)),
            "a little larger than the geom" if inside else "at the surface of a geom of its body",
            (),
            Probe("1 where no contact can be inside of a touch sensor's site", "", _off, (site,), dynamic=False),
            0.5,
            f"{of.name('site', site)} of {body} {reason}: {READS[reason]}.",
            "a site that holds the surface",
        )


def _bare_at(of: Simulation, site: int) -> list[int]:
    """The geoms that a touch sensor's site is about, and that cannot touch, where no geom of its body can."""
    own, pairs = of.geoms_of(of.body_of("site", site)), in_pairs(of)
    if any(solid(of, geom) or geom in pairs for geom in own):
        return []
    of.begin()
    place = of.data_row("site_xpos", site, 3)
    return [
        geom for geom in own if math.dist(place, of.data_row("geom_xpos", geom, 3)) < of.model("geom_rbound")[geom]
    ][-1:]


def _off(of: Simulation, site: int) -> float:
    return float(bool(why(of, site)))


def why(of: Simulation, site: int) -> str:
    """Why no contact can be inside of a site; empty where one can."""
    body = of.body_of("site", site)
    pairs = in_pairs(of)
    geoms = [geom for geom in of.geoms_of(body) if solid(of, geom) or geom in pairs]
    if any(int(of.model("geom_type")[geom]) not in (SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX) for geom in geoms):
        return ""
    of.begin()
    hidden = False
    for geom in geoms:
        nearest, farthest = _distances(of, site, geom)
        slack = min(NEAR, SHARE * min(of.row("geom_aabb", geom, 6)[3:])) + of.model("geom_margin")[geom]
        if farthest < -slack:
            hidden = True
        elif nearest <= slack:
            return ""
    return INSIDE if hidden else OUTSIDE


def _half(of: Simulation, kind: str, index: int) -> Vector:
    """The half sizes of a geom's or site's box, along its own axes."""
    shape, (a, b, c) = int(of.model(f"{kind}_type")[index]), of.row(f"{kind}_size", index, 3)
    if shape in (SPHERE, CAPSULE, CYLINDER):
        return (a, a, {SPHERE: a, CAPSULE: a + b, CYLINDER: b}[shape])
    return (a, b, c)


def _distances(of: Simulation, site: int, geom: int) -> tuple[float, float]:
    """How far the nearest and the farthest point of a site are outside of a geom, in m.

    Both are convex: steps that grow smaller from the nearest point of a grid lead to the nearest of all.
    """
    half, frame, place = _half(of, "site", site), of.data_row("site_xmat", site, 9), of.data_row("site_xpos", site, 3)
    shape = int(of.model("site_type")[site])

    def far(shares: Vector) -> float:
        x, y, z = (share * size for share, size in zip(shares, half, strict=True))
        return _distance(of, geom, add(place, times(frame, (x, y, z))))

    def around(middle: Vector, step: float, many: int) -> list[Vector]:
        steps = [step * each for each in range(-many, many + 1)]
        near = (add(middle, shares) for shares in product(steps, repeat=3))
        return [shares for shares in near if _within(shape, half, shares)]

    grid = {shares: far(shares) for shares in around((0.0, 0.0, 0.0), 1 / FINE, FINE)}
    nearest = min(grid, key=lambda shares: grid[shares])
    for halving in range(1, HALVINGS + 1):
        nearest = min(around(nearest, 0.5**halving / FINE, 1), key=far)
    return far(nearest), max(grid.values())


def _within(shape: int, half: Vector, shares: Vector) -> bool:
    """Whether a point, in half sizes from the middle, is in a box, cylinder, capsule or ellipsoid."""
    x, y, z = shares
    if shape == CAPSULE:
        return math.hypot(x, y, max(0.0, 1 - half[2] / half[0] * (1 - abs(z)))) <= 1 + TINY
    if shape in (BOX, CYLINDER):
        return max(map(abs, shares)) <= 1 + TINY and (shape == BOX or math.hypot(x, y) <= 1 + TINY)
    return math.hypot(x, y, z) <= 1 + TINY


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
