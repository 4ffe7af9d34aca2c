"""One sensor of a unit is at another site than the rest of it.

A gyro, an accelerometer and a magnetometer are mostly one chip, and force and torque are read by one cell. Where one of
them names the site of something else it reads in other axes, or with the lever of another place.

Bad:

    <mujoco>
      <worldbody>
        <body name="drone" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.03"/>
          <site name="imu"/>
          <site name="sonar" pos="0 0 -0.04" euler="180 0 0"/>
        </body>
      </worldbody>
      <sensor>
        <gyro site="imu"/>
        <accelerometer site="sonar"/>
        <rangefinder site="sonar"/>
      </sensor>
    </mujoco>

Good:

    -     <accelerometer site="sonar"/>
    +     <accelerometer site="imu"/>

The number: gyros, accelerometers, velocimeters and magnetometers, and force and torque sensors, alone of their unit at
a site that a sensor of something else reads. Others of the unit are at a site of the same body, or of the next one,
and nothing but the unit reads that. And the one orientation of a site, at one of a pair of sites that both are read
alike, such as a foot, whose name it does not have; a gyro and an accelerometer are at a site of what carries that.

When it is wrong: a second sensor that sits elsewhere on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from clinic.diagnosis.engine import OBJ_SITE, SENS_FORCE, SENS_TORQUE
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A sensor apart from its unit"
FAMILIES = ("wrong-numbers",)
UNPLANTED = "readings that differ are not counted as harm"

UNITS = ({1, 2, 3, 6}, {SENS_FORCE, SENS_TORQUE})  # mjtSensor: accelerometer, velocimeter, gyro, magnetometer
UNIT, FRAME_QUATERNION = {1, 3}, 27  # accelerometer and gyro; framequat
QUATERNION = 4  # numbers: how the unit's frame is turned belongs to it


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor that is alone at the site of something else."""
    of, names = model.simulation, model.simulation.names("site")
    for sensor, (site, unit) in _astray(of).items():
        told, here, there = of.name("sensor", sensor), of.name("site", site), of.name("site", unit)
        element = model.element("sensor", sensor)
        attribute = "objname" if element is not None and element.get("objname") else "site"
        edits = model.set("sensor", [sensor], attribute, names[unit])
        says = f"It is at {here}, which a sensor of another kind reads, and the rest of its unit is at {there}."
        probe = how_many("sensors at another site than their unit", _astray)
        yield Suspect((told, here), attribute, names[site], names[unit], edits, probe, 0, says, "one site for a unit")


def _astray(of: Simulation) -> dict[int, tuple[int, int]]:
    """By sensor: the site that it is at, and that of its unit."""
    kinds, sites = [int(kind) for kind in of.model("sensor_type")], of.model("sensor_objid")
    at: dict[int, list[int]] = {}
    for sensor, kind in enumerate(of.model("sensor_objtype")):
        if int(kind) == OBJ_SITE and of.model("sensor_dim")[sensor] != QUATERNION:
            at.setdefault(int(sites[sensor]), []).append(sensor)
    made = {}
    for unit in UNITS:
        own = {site: [each for each in some if kinds[each] in unit] for site, some in at.items()}
        whole = [site for site, some in own.items() if some == at[site]]
        for site, some in own.items():
            near = [each for each in whole if _near(of, each, site)]
            if len(some) != 1 or site in whole or len(near) != 1:
                continue
            if kinds[some[0]] not in {kinds[each] for each in own[near[0]]}:
                made[some[0]] = (site, near[0])
    return made | _turned(of, at)


def _turned(of: Simulation, at: Mapping[int, Sequence[int]]) -> dict[int, tuple[int, int]]:
    """The orientation that is read at one of a pair of sites, in place of that of the unit."""
    kinds, names = [int(kind) for kind in of.model("sensor_type")], of.names("site")
    quats = [
        each
        for each, kind in enumerate(of.model("sensor_objtype"))
        if int(kind) == OBJ_SITE and kinds[each] == FRAME_QUATERNION
    ]
    units = [site for site, some in at.items() if {kinds[each] for each in some} >= UNIT]
    if len(quats) != 1 or len(units) != 1:
        return {}
    site = int(of.model("sensor_objid")[quats[0]])
    twin = sided(of, "site").get(site, ("", -1))[1]
    read = [{kinds[each] for each in at.get(one, ())} for one in (site, twin)]
    carried = of.body_of("site", units[0]) in of.ancestors(of.body_of("site", site))[1:]
    named = names[site].lower() in of.names("sensor")[quats[0]].lower()
    return {quats[0]: (site, units[0])} if read[0] and read[0] == read[1] and carried and not named else {}


def _near(of: Simulation, one: int, other: int) -> bool:
    """Whether two sites are of one body, or of a body and its parent."""
    bodies = [of.body_of("site", site) for site in (one, other)]
    return bodies[0] == bodies[1] or any(of.parent(a) == b for a, b in (bodies, bodies[::-1]))
