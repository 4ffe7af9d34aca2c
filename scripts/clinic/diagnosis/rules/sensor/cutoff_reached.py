"""A sensor reads nothing but its `cutoff`.

`cutoff` clips the readings at plus and minus that value. An accelerometer at rest reads 9.81 m/s2; with a cutoff of 5
it reads 5 for ever.

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
well.

When it is wrong: a rangefinder with nothing in reach, which is left alone.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.probes.touched import RANGE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A sensor that reads its cutoff"
FAMILIES = ("sensor-reads-zero",)
SINCE = "0.1"
UNPLANTED = "one healthy model has a sensor with a cutoff"

MOST = 0.8


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
        if cutoff <= 0 or int(kinds[sensor]) == RANGE:
            continue
        probe = Probe("time at its cutoff", "of the run", _clipped, (sensor,))
        if model.measured(probe) > MOST:
            element = model.element("sensor", sensor)
            has = element is not None and "cutoff" in element.attributes
            edits = (remove_attribute(element, "cutoff"),) if element is not None and has else ()
            says = f"It reads {cutoff:g} and no more."
            yield Suspect(
                (simulation.name("sensor", sensor),), "cutoff", f"{cutoff:g}", "left out", edits, probe, MOST, says
            )
