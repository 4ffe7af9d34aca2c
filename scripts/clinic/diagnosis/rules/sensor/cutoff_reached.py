"""A sensor reads nothing but its `cutoff`.

`cutoff` clips each number of a reading at plus and minus that value. An accelerometer that stands upright and still
reads 9.81 m/s2 on its z axis; with a cutoff of 5 it reads 5.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          <site name="imu"/>
        </body>
      </worldbody>
      <sensor>
        <accelerometer name="imu" site="imu" cutoff="1"/>
      </sensor>
    </mujoco>

Good:

    -     <accelerometer name="imu" site="imu" cutoff="1"/>
    +     <accelerometer name="imu" site="imu" cutoff="100"/>

The number: the share of the time after letting go in which some value of the sensor is at its cutoff; below 0.8 is
well. A rangefinder is told only where two others and more have one cutoff, at least 5 times as much: else what it sees
may be farther. A hint tells of an actuator's force or a joint's position whose cutoff is a fifth or less of the force
range or of the range; and of a touch sensor, which may be meant as a switch.

When it is wrong: a bumper among rangefinders that look far.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from clinic.diagnosis.edit import Edit, remove_attribute
from clinic.diagnosis.engine import SENS_ACTUATORFRC, SENS_JOINTPOS, SENS_RANGEFINDER, SENS_TOUCH
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A sensor that reads its cutoff"
FAMILIES = ("sensor-reads-zero",)
LEVEL = "cause"
UNPLANTED = "one healthy model has a sensor with a cutoff"

MOST, MUCH = 0.8, 5.0


def _clipped(simulation: Simulation, sensor: int) -> float:
    cutoff, first = simulation.model("sensor_cutoff")[sensor], int(simulation.model("sensor_adr")[sensor])
    width = int(simulation.model("sensor_dim")[sensor])
    if cutoff <= 0:
        return 0.0
    simulation.begin()
    seen = []
    for _ in simulation.run(simulation.begin_with.duration / 4):
        seen.append(any(abs(each) >= cutoff for each in simulation.data("sensordata")[first : first + width]))
    return sum(seen) / max(1, len(seen))


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor that stays at its cutoff, without it."""
    simulation = model.simulation
    kinds = simulation.model("sensor_type")
    for sensor, cutoff in enumerate(simulation.model("sensor_cutoff")):
        usual = _usual(simulation, sensor) if int(kinds[sensor]) == SENS_RANGEFINDER else 0.0
        if cutoff <= 0 or (int(kinds[sensor]) == SENS_RANGEFINDER and cutoff * MUCH > usual):
            continue
        probe = Probe("time at its cutoff", "of the run", _clipped, (sensor,))
        if (share := model.measured(probe)) > MOST:
            element = model.element("sensor", sensor)
            has = element is not None and "cutoff" in element.attributes
            edits: tuple[Edit, ...] = (remove_attribute(element, "cutoff"),) if element is not None and has else ()
            says, value = f"For {100 * share:.0f} % of the run it is at its cutoff of {cutoff:g}.", "left out"
            if usual:
                edits, value = model.set("sensor", [sensor], "cutoff", f"{usual:g}"), f"{usual:g}"
                says += f" The other rangefinders read up to {usual:g}."
            names = (simulation.name("sensor", sensor),)
            found = Suspect(names, "cutoff", f"{cutoff:g}", value, edits, probe, MOST, says)
            yield replace(found, level="hint") if int(kinds[sensor]) == SENS_TOUCH else found
        elif (much := _clips(simulation, sensor)) >= MUCH:
            names, value = (simulation.name("sensor", sensor),), f"{much * cutoff:g}"
            edits = model.set("sensor", [sensor], "cutoff", value)
            says = f"It reads {cutoff:g} at most, and by its range what it reads goes up to {value}."
            probe = Probe("what a sensor is to read over its cutoff", "times", _clips, (sensor,), dynamic=False)
            yield Suspect(names, "cutoff", f"{cutoff:g}", value, edits, probe, 1.0, says, "above", level="hint")


def _clips(of: Simulation, sensor: int) -> float:
    """How many times its cutoff the force of an actuator, or a joint's place, goes by its range; 0 without one."""
    kind, cutoff = int(of.model("sensor_type")[sensor]), of.model("sensor_cutoff")[sensor]
    limited, reach = {
        SENS_ACTUATORFRC: ("actuator_forcelimited", "actuator_forcerange"),
        SENS_JOINTPOS: ("jnt_limited", "jnt_range"),
    }.get(kind, ("", ""))
    read = int(of.model("sensor_objid")[sensor])
    if not limited or cutoff <= 0 or not of.model(limited)[read]:
        return 0.0
    return max(map(abs, of.row(reach, read, 2))) / cutoff


def _usual(of: Simulation, sensor: int) -> float:
    """The cutoff that all other rangefinders have, two and more; 0 where they have none or differ."""
    kinds, cutoffs = of.model("sensor_type"), of.model("sensor_cutoff")
    others = [cutoffs[each] for each, kind in enumerate(kinds) if int(kind) == SENS_RANGEFINDER and each != sensor]
    return others[0] if len(others) > 1 and len(set(others)) == 1 else 0.0
