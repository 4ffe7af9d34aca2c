"""A rangefinder sees the robot that carries it.

The ray begins at the site and goes along its z axis. MuJoCo leaves out the geoms of the site's own body, and not those
of the bodies below and above: a site inside of a cover that is a body of its own reads a few millimetres for ever.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="car" pos="0 0 0.2">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.05"/>
          <site name="front" pos="0.2 0 0" zaxis="1 0 0"/>
          <body name="bumper" pos="0.22 0 0">
            <geom type="box" size="0.01 0.1 0.05"/>
          </body>
        </body>
      </worldbody>
      <sensor>
        <rangefinder name="ahead" site="front"/>
      </sensor>
    </mujoco>

Good:

    -       <site name="front" pos="0.2 0 0" zaxis="1 0 0"/>
    +       <site name="front" pos="0.24 0 0" zaxis="1 0 0"/>

The number: rangefinders whose reading at the start ends at a geom of their own robot, on another body.

When it is wrong: one that measures a gap between two parts of the robot, or a scan of which some rays meet it.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import OBJ_SITE, SENS_RANGEFINDER
from clinic.diagnosis.probes.shape import boxes, root_of
from clinic.diagnosis.probes.vector import add
from clinic.diagnosis.probes.view import through
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A rangefinder that sees its own robot"
FAMILIES = ("sensor-reads-zero",)
UNPLANTED = "healthy models with a rangefinder are too few"

MOST = 0.5  # of the rangefinders of a model: fewer are rays of a scan
NEAR = 1e-3  # m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Rangefinders that see a geom of their own robot, where it is not a few of a scan."""
    of = model.simulation
    rays = [each for each, kind in enumerate(of.model("sensor_type")) if int(kind) == SENS_RANGEFINDER]
    found = _blind(of)
    if not found or len(found) < MOST * len(rays):
        return
    sensor, (geom, reading) = next(iter(found.items()))
    says = f"Its ray ends after {reading:.3g} m at {of.name('geom', geom)}, which is of the same robot."
    names = tuple(dict.fromkeys(name for each, (hit, _) in found.items()
                                for name in (of.name("sensor", each), of.name("geom", hit))))  # fmt: skip
    probe = how_many("rangefinders that see their own robot", _blind)
    site = int(of.model("sensor_objid")[sensor])
    now = " ".join(f"{x:.3g}" for x in of.row("site_pos", site, 3))
    yield Suspect(names, "pos of the site", now, "outside", (), probe, 0, says, "a free view")


def _blind(of: Simulation) -> dict[int, tuple[int, float]]:
    """The geom of its own robot that each rangefinder sees at the start, and the reading in m."""
    of.begin()
    owner, made = root_of(of), {}
    bodies = of.model("geom_bodyid")
    readings, kinds = of.data("sensordata"), of.model("sensor_objtype")
    for sensor, kind in enumerate(of.model("sensor_type")):
        reading = readings[int(of.model("sensor_adr")[sensor])]
        if int(kind) != SENS_RANGEFINDER or int(kinds[sensor]) != OBJ_SITE or reading < 0:
            continue
        site = int(of.model("sensor_objid")[sensor])
        body = of.body_of("site", site)
        start, way = of.data_row("site_xpos", site, 3), of.data_row("site_xmat", site, 9)[2::3]
        end = add(start, way, reading)
        for geom, (centre, half) in boxes(of, range(len(bodies))).items():
            other = int(bodies[geom])
            inside = all(abs(x - c) <= h + NEAR for x, c, h in zip(end, centre, half, strict=True))
            if inside and owner[body] and owner[other] == owner[body] and other != body:
                near, far = through(of, geom, start, way)  # of the box along the geom's own axes
                if near - NEAR <= reading <= far + NEAR:
                    made[sensor] = (geom, reading)
                    break
    return made
