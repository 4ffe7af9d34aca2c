"""A rangefinder looks into the sky, or through the body that carries it.

The ray goes along the z axis of the site, and without an orientation that axis is up: in the open a rangefinder then
reads -1 for ever. MuJoCo leaves out the geoms of the site's own body, so that one which looks inward reads what is on
the other side of that body.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.05" mass="2"/>
          <site name="front" pos="0.21 0 0"/>
        </body>
      </worldbody>
      <sensor>
        <rangefinder name="ahead" site="front"/>
      </sensor>
    </mujoco>

Good:

    -       <site name="front" pos="0.21 0 0"/>
    +       <site name="front" pos="0.21 0 0" zaxis="1 0 0"/>

The number: rangefinders that see nothing and point up at the start and at every keyframe, where no joint but a free one
can tilt them; and those on one side of their body whose ray goes through it to the other. The edit lets them look the
other way, where an orientation is written and something is to be seen there, or else away from the middle of their
body. A model with more than 8 has a scan, whose rays go everywhere.

When it is wrong: one that looks for a ceiling which another file has.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product

from clinic.diagnosis.edit import Edit, orient
from clinic.diagnosis.engine import FREE, HINGE, OBJ_SITE, SENS_RANGEFINDER, SLIDE, CompileError
from clinic.diagnosis.probes.key import start_at
from clinic.diagnosis.probes.vector import Vector, add, dot, sub, times, transpose, written
from clinic.diagnosis.probes.view import through
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import ORIENTATIONS
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A rangefinder that looks the wrong way"
FAMILIES = ("sensor-reads-zero", "wrong-numbers")
UNPLANTED = "healthy models with a rangefinder are too few"

SCAN = 8  # rangefinders
DIGITS = 6  # of a direction
UP = 0.7  # cosine with the vertical
ASIDE, OUTSIDE = 0.4, 0.9  # of the way from the middle of its body to the side


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The rangefinders that look up, and those that look through their own body, each."""
    of = model.simulation
    for sensor, site in _astray(of).items():
        where = of.name("body", of.body_of("site", site))
        inward = _inward(of, site)
        says = f"It looks through {where}, at whose side it is." if inward else "It points up, and sees nothing."
        way = _back(model, sensor, site) or _outward(of, site)
        value = written(way) if way else "to what it is to see"
        edits = _turned(model, site, value) if way else ()
        names = (of.name("sensor", sensor), of.name("site", site))
        probe = how_many("rangefinders that look up, or through their own body", _found, sensor)
        at = model.element("site", site)
        now = next((f"{name} {at.get(name)}" for name in ORIENTATIONS if at and at.get(name)), "left out")
        yield Suspect(names, "zaxis", now, value, edits, probe, 0, says, "away from its body", at=at)


def _back(model: ReaderModel, sensor: int, site: int) -> Vector:
    """The other way than a site is written to look, where its rangefinder sees something there; else nothing."""
    of, at = model.simulation, model.element("site", site)
    of.begin()
    if at is None or not any(at.get(name) for name in ORIENTATIONS):
        return ()
    looks = of.data_row("site_xmat", site, 9)[2::3]
    frame = transpose(of.data_row("xmat", of.body_of("site", site), 9))
    way = tuple(round(-each, DIGITS) + 0.0 for each in times(frame, looks))
    found = model.with_edits(_turned(model, site, written(way)))
    if isinstance(found, CompileError):
        return ()
    found.begin()
    return way if found.data("sensordata")[int(found.model("sensor_adr")[sensor])] >= 0 else ()


def _found(of: Simulation, sensor: int) -> list[int]:
    return [each for each in _astray(of) if each == sensor]


def _astray(of: Simulation) -> dict[int, int]:
    """The site of each rangefinder that looks the wrong way."""
    kinds = [int(kind) for kind in of.model("sensor_type")]
    if not 0 < kinds.count(SENS_RANGEFINDER) <= SCAN:
        return {}
    sites = {
        sensor: int(of.model("sensor_objid")[sensor])
        for sensor, kind in enumerate(kinds)
        if kind == SENS_RANGEFINDER and int(of.model("sensor_objtype")[sensor]) == OBJ_SITE
    }
    blind = dict(sites)
    for key in range(-1, of.count("key")):
        start_at(of, key)
        readings, places = tuple(of.data("sensordata")), of.model("sensor_adr")
        blind = {
            sensor: site
            for sensor, site in blind.items()
            if readings[int(places[sensor])] < 0 and of.data_row("site_xmat", site, 9)[8] > UP
        }
    of.begin()
    return {
        sensor: site for sensor, site in sites.items() if _inward(of, site) or (sensor in blind and _level(of, site))
    }


def _level(of: Simulation, site: int) -> bool:
    """Whether no joint but a free one tilts what carries a site."""
    joints = [joint for body in of.ancestors(of.body_of("site", site)) for joint in of.joints_of(body)]
    tilting = [each for each in joints if of.joint_type(each) not in (FREE, SLIDE)]
    return all(of.joint_type(each) == HINGE and abs(of.axis(each)[2]) > UP for each in tilting)


def _inward(of: Simulation, site: int) -> bool:
    """Whether a site at the side of its body looks through all of it, and not back."""
    of.begin()
    body = of.body_of("site", site)
    place, way = of.data_row("site_xpos", site, 3), of.data_row("site_xmat", site, 9)[2::3]
    outward = _outward(of, site) if max(map(abs, _off_middle(of, site))) > OUTSIDE else ()
    if not outward or dot(times(of.data_row("xmat", body, 9), outward), way) > -UP:
        return False
    ways = [through(of, geom, place, way) for geom in of.geoms_of(body)]
    return any(near <= far and near + far > 0 for near, far in ways)


def _outward(of: Simulation, site: int) -> Vector:
    """The axis of its body along which a site looks away from the body's middle; nothing where that is up."""
    of.begin()
    if not of.body_of("site", site):
        return ()
    off = _off_middle(of, site)
    axis = max(range(3), key=lambda i: abs(off[i]))
    way = tuple(math.copysign(1.0, off[axis]) if i == axis else 0.0 for i in range(3))
    return way if abs(off[axis]) > ASIDE and way[2] <= 0 else ()


def _off_middle(of: Simulation, site: int) -> list[float]:
    """Where a site is between the middle of its body, 0, and its sides, 1 and -1, along the body's axes."""
    body = of.body_of("site", site)
    back, origin = transpose(of.data_row("xmat", body, 9)), of.data_row("xpos", body, 3)
    low, high = [math.inf] * 3, [-math.inf] * 3
    for geom in of.geoms_of(body):
        frame, (*inner, a, b, c) = of.data_row("geom_xmat", geom, 9), of.row("geom_aabb", geom, 6)
        for corner in product((-a, a), (-b, b), (-c, c)):
            point = add(of.data_row("geom_xpos", geom, 3), times(frame, add(inner, corner)))
            there = times(back, sub(point, origin))
            low, high = list(map(min, low, there)), list(map(max, high, there))
    place = of.row("site_pos", site, 3)
    return [(2 * x - a - b) / max(b - a, 1e-6) if a < b else 0.0 for x, a, b in zip(place, low, high, strict=True)]


def _turned(model: ReaderModel, site: int, value: str) -> tuple[Edit, ...]:
    """Edits that give a site's z axis a direction in its body, in place of how it is turned now."""
    element = model.element("site", site)
    if element is None:
        return ()
    edits = orient(element, "zaxis", value)
    return () if isinstance(model.with_edits(edits), CompileError) else edits
