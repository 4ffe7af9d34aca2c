"""A force or torque sensor on a free body reads nothing of its contacts.

`<force>` and `<torque>` measure what a body and its parent do to each other through their joint. The parent of a free
body is the world, and a free joint passes nothing to it of what contacts press: of that the sensor reads 0, whatever
the body stands on. It does read the free joint's `damping`, `gravcomp`, and motors at sites of the body.

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
        <force name="force" site="sole"/>
      </sensor>
    </mujoco>

Good:

    -       <site name="sole" pos="0 0 -0.05"/>
    +       <site name="sole" pos="0 0 -0.05" size="0.08"/>

    -     <force name="force" site="sole"/>
    +     <touch name="touch" site="sole"/>

The number: of the most that contacts of the body carry within 2 s after letting go, the share that the sensor's largest
reading lacks; above 0.99 is told.

When it is wrong: a sensor of the thrust of a drone's rotors.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, replace
from clinic.diagnosis.engine import SENS_FORCE, SENS_TORQUE
from clinic.diagnosis.probes.touched import touched, unread
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A force sensor on a free body"
FAMILIES = ("sensor-reads-zero",)
CASE = "force-sensor-reads-zero"
LEVEL = "cause"
UNPLANTED = "to set free what carries a healthy model's force sensor breaks more than the sensor"

MOST = 0.99
NOTHING = 1e-3  # N, N m: what rounding leaves


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each such sensor, replaced by a touch sensor with a site that holds the contacts."""
    simulation = model.simulation
    kinds, of, owners = (simulation.model(name) for name in ("sensor_type", "sensor_objid", "site_bodyid"))
    for sensor, seen in touched(simulation).items():
        site = int(of[sensor])
        if int(kinds[sensor]) not in (SENS_FORCE, SENS_TORQUE) or int(owners[site]) not in simulation.free_bodies:
            continue
        if not seen.carried:
            if seen.reading < NOTHING:
                yield _idle(simulation, sensor, site)
            continue
        element = model.element("sensor", sensor)
        if element is None:
            continue
        name = f'name="{element.get("name")}" ' if element.get("name") else ""
        edits: tuple[Edit, ...] = (replace(element, f'<touch {name}site="{element.get("site")}"/>'),)
        edits += model.set("site", [site], "size", " ".join([f"{1.1 * seen.reach:.3g}"] * 3))
        names = (
            simulation.name("sensor", sensor),
            simulation.name("site", site),
            simulation.name("body", int(owners[site])),
        )
        says = f"Contacts carry {seen.carried:.3g} N, the sensor reads {seen.reading:.3g}: a free joint passes none."
        yield Suspect(names, element.tag, element.tag, "touch", edits, unread(sensor), MOST, says)


def _idle(simulation: Simulation, sensor: int, site: int) -> Suspect:
    """Such a sensor whose own body touched nothing: what it should read shows in no run."""
    names = tuple(
        simulation.name(kind, index)
        for kind, index in (("sensor", sensor), ("site", site), ("body", simulation.body_of("site", site)))
    )
    says = "A free joint does not pass on what contacts press. A site in a body that hangs on this one reads it."
    probe = counted("sensors of a free body", 1)
    return Suspect(names, "site", "", "one in a body below", (), probe, 0.5, says, "0")
