"""A sensor's `noise` is written, and nothing adds it.

Since MuJoCo 3.1.4 `noise` is information for your code: the readings have none.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
      <sensor>
        <jointpos name="angle" joint="elbow" noise="0.01"/>
      </sensor>
    </mujoco>

Good:

    -     <jointpos name="angle" joint="elbow" noise="0.01"/>
    +     <jointpos name="angle" joint="elbow"/>

The number: how many sensors have it. MuJoCo's changelog, 3.1.4.

When it is wrong: your code adds the noise; so it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Sensor noise that nothing adds"
FAMILIES = ("sensor-reads-zero",)
SINCE = "0.1"
LEVEL = "hint"
MINOR = True
UNPLANTED = "no release since 3.1.4 adds noise: with or without it a model moves and reads alike"


def _noisy(simulation: Simulation) -> float:
    return float(sum(noise > 0 for noise in simulation.model("sensor_noise")))


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All sensors with noise."""
    simulation = model.simulation
    noise = simulation.model("sensor_noise")
    names = tuple(simulation.name("sensor", i) for i, each in enumerate(noise) if each > 0)
    if names:
        says = "Since MuJoCo 3.1.4 the readings are exact; add the noise in your code."
        probe = Probe("sensors with noise", "", _noisy, dynamic=False)
        yield Suspect(names, "noise", f"{max(noise):g}", "in your code", (), probe, 0.0, says, level="hint")
