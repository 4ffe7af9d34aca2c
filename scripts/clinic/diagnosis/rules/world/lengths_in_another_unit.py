"""Lengths in millimetres or centimetres under the gravity of metres.

MuJoCo has no units: 9.81 says that lengths are in metres. A part that was drawn in millimetres, of 200 long and 0.1 kg,
is then 200 m long and lighter than air; it falls in slow motion, and no motor of ordinary size turns it.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1000 1000 1"/>
        <body name="arm" pos="0 0 200">
          <joint name="elbow" axis="0 1 0"/>
          <geom type="box" size="100 15 10" pos="100 0 0" mass="0.3"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="arm" pos="0 0 0.2">
          <joint name="elbow" axis="0 1 0"/>
          <geom type="box" size="0.1 0.015 0.01" pos="0.1 0 0" mass="0.3"/>
        </body>
      </worldbody>
    </mujoco>

The number: told where all that moves is larger than 5 m, weighs less than 10 kg/m3, and would weigh 100 to 20,000 kg/m3
if its lengths were in mm, or in cm. The gravity of that unit over the model's own; 1 is well. The edit changes gravity
alone: gains, damping and torques then are in that unit too. Lengths in metres, as `scale="0.001 0.001 0.001"` of a mesh
gives them, are better.

When it is wrong: a balloon, or a kite.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.matter import matter
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Lengths in another unit than gravity"
FAMILIES = ("drifts", "sags", "stuck", "explodes", "wrong-mass")
UNPLANTED = "to write a model in millimetres changes nearly all of its numbers"

LARGE, THIN = 5.0, 10.0  # m, kg/m3
SOLID = (100.0, 20000.0)  # kg/m3
UNITS = {"mm": 1000.0, "cm": 100.0}
EARTH = (5.0, 15.0)  # m/s2


def unit_of_lengths(simulation: Simulation) -> str:
    """The unit in which all that moves would be of ordinary matter; empty where metres do, or none."""
    if not EARTH[0] < simulation.gravity < EARTH[1]:
        return ""
    found = [each for body in simulation.moving_bodies if (each := matter(simulation, body)) is not None]
    volume = sum(each.volume for each in found)
    if not volume or max(max(each.half) for each in found) < LARGE / 2:
        return ""
    density = sum(each.mass for each in found) / volume
    if density > THIN:
        return ""
    return next((name for name, many in UNITS.items() if SOLID[0] < density * many**3 < SOLID[1]), "")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The gravity of the unit in which the model seems to be written."""
    if not (name := unit_of_lengths(model.simulation)):
        return
    gravity = model.simulation.row("opt.gravity", 0, 3)
    value = written([UNITS[name] * each for each in gravity])
    yield Suspect(
        ("the lengths",),
        "gravity",
        written(gravity),
        value,
        model.option("gravity", value),
        Probe("gravity in the unit of the lengths over the model's own", "", _over, (), dynamic=False),
        math.sqrt(10),
        f"Gravity is that of metres; in metres all that moves is lighter than 10 kg/m3, in {name} it is ordinary.",
        "lengths in m under 9.81 m/s2",
    )


def _over(simulation: Simulation) -> float:
    return UNITS.get(unit_of_lengths(simulation), 1.0)
