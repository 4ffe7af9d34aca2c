"""A touch sensor's site does not hold the points of contact.

A `<touch>` sensor sums the normal forces of contacts of its site's body whose points lie inside of the site, or whose
normal meets it on the way out of the body. The default site is a sphere of 5 mm: most contacts of a larger face miss
it.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
          <site name="sole" pos="0 0 -0.05"/>
        </body>
      </worldbody>
      <sensor>
        <touch name="touch" site="sole"/>
      </sensor>
    </mujoco>

Good:

    -       <site name="sole" pos="0 0 -0.05"/>
    +       <site name="sole" pos="0 0 -0.05" type="box" size="0.06 0.06 0.01"/>

The number: of the most that contacts of the body carry within 2 s after letting go, the share that the sensor's largest
reading lacks; above 0.95 is told. A site that touches none of its body's geoms gets the place of the one that collides,
where it is large enough there.

When it is wrong: a sensor that is meant for a part of its body. Of several on one body only one far smaller
than the others is told.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import SENS_TOUCH
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.touched import touch_sites, touched, unread
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.sensor.touch_site_off_the_surface import OUTSIDE
from clinic.diagnosis.rules.sensor.touch_site_off_the_surface import why as outside
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect

TITLE = "A touch sensor whose site misses the contacts"
FAMILIES = ("sensor-reads-zero",)
LEVEL = "hint"
CASE = "touch-sensor-reads-zero"

MOST = 0.95
SMALL = 20.0  # times the size of a site that a body has across
AWAY = 3.0  # sizes of the site; nearer contacts may be beside it on purpose,
NEAR = 2.5  # unless no contact at all is read


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each touch sensor that is alone on its body, with a site as large as the contacts are far."""
    simulation = model.simulation
    kinds, of, owners = (simulation.model(name) for name in ("sensor_type", "sensor_objid", "site_bodyid"))
    sites = touch_sites(simulation)
    bodies = [owners[site] for site in sites]
    yield from _none_of_many(model)
    for sensor, seen in touched(simulation).items():
        site = int(of[sensor])
        if int(kinds[sensor]) != SENS_TOUCH or (bodies.count(owners[site]) > 1 and not _dwarf(simulation, site, sites)):
            continue
        if seen.reach < (AWAY if seen.reading > 0 else NEAR) * max(simulation.row("site_size", site, 3)):
            continue
        if seen.carried > 0 and model.measured(unread(sensor)) > MOST and seen.reach < 2 * _reach(simulation, site):
            size = f"{1.1 * seen.reach:.3g}"
            value = " ".join([size] * 3)
            edits = model.set("site", [site], "size", value)
            if model.value("site", site, "type") not in (None, "sphere", "box", "ellipsoid"):
                edits += model.set("site", [site], "type", "sphere")
            names = (simulation.name("sensor", sensor), simulation.name("site", site))
            if (misplaced := _misplaced(model, sensor, site, names)) is not None:
                yield misplaced
                continue
            now = " ".join(f"{each:g}" for each in simulation.row("site_size", site, 3))
            says = f"Contacts carry up to {seen.carried:.3g} N on its body, up to {seen.reach:.3g} m from the site."
            yield Suspect(names, "size", now, value, edits, unread(sensor), MOST, says)


def _misplaced(model: ReaderModel, sensor: int, site: int, names: tuple[str, ...]) -> Suspect | None:
    """A site off its body's one geom that collides, and large enough where that geom is; else None."""
    of = model.simulation
    geoms = [geom for geom in of.geoms_of(of.body_of("site", site)) if solid(of, geom)]
    if len(geoms) != 1 or outside(of, site) != OUTSIDE:
        return None
    value = written(of.row("geom_pos", geoms[0], 3))
    edits = model.set("site", [site], "pos", value)
    if not edits or model.measured(unread(sensor), edits) > MOST:
        return None
    now = written(of.row("site_pos", site, 3))
    says = f"{names[1]} {OUTSIDE}; around {of.name('geom', geoms[0])} it holds the contacts."
    return Suspect(names, "pos", now, value, edits, unread(sensor), MOST, says)


def _none_of_many(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies with several touch sensors of which none reads a contact, with sites that are small beside the body."""
    of = model.simulation
    sites, owners = of.model("sensor_objid"), of.model("site_bodyid")
    bodies: dict[int, list[int]] = {}
    for sensor, seen in touched(of).items():
        if int(of.model("sensor_type")[sensor]) == SENS_TOUCH and seen.carried > 0:
            bodies.setdefault(int(owners[int(sites[sensor])]), []).append(sensor)
    for body, sensors in bodies.items():
        several = [int(sites[sensor]) for sensor in sensors]
        small = all(SMALL * max(of.row("site_size", site, 3)) < _reach(of, site) for site in several)
        if len(sensors) < 2 or not small or any(model.measured(unread(sensor)) <= MOST for sensor in sensors):
            continue
        most = max(touched(of)[sensor].carried for sensor in sensors)
        names = (*(of.name("sensor", sensor) for sensor in sensors), of.name("site", several[0]))
        now = " ".join(f"{each:g}" for each in of.row("site_size", several[0], 3))
        says = f"Contacts carry up to {most:.3g} N on {of.name('body', body)}, none of it in a site of its "
        says += f"{len(sensors)} touch sensors."
        yield Suspect(names, "size", now, "as large as the face", (), unread(sensors[0]), MOST, says)


def _dwarf(simulation: Simulation, site: int, sites: list[int]) -> bool:
    """Whether it is far smaller than the other sites of touch sensors."""
    sizes = sorted(max(simulation.row("site_size", each, 3)) for each in sites)
    return max(simulation.row("site_size", site, 3)) < sizes[len(sizes) // 2] / AWAY


def _reach(simulation: Simulation, site: int) -> float:
    radii = simulation.model("geom_rbound")
    return 2 * max((radii[geom] for geom in simulation.geoms_of(simulation.body_of("site", site))), default=0.0)
