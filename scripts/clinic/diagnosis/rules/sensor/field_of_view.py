"""A camera's field of view is next to nothing, or all around.

`fovy` is the vertical angle of view, in degrees whatever `<compiler angle>` says: 1.0 is a telescope.

Bad:

    <mujoco>
      <worldbody>
        <camera name="front" pos="1 0 0.5" xyaxes="0 1 0 -0.5 0 1" fovy="0.8"/>
        <geom type="plane" size="1 1 0.1"/>
        <geom type="box" size="0.05 0.05 0.05"/>
      </worldbody>
    </mujoco>

Good:

    -     <camera name="front" pos="1 0 0.5" xyaxes="0 1 0 -0.5 0 1" fovy="0.8"/>
    +     <camera name="front" pos="1 0 0.5" xyaxes="0 1 0 -0.5 0 1" fovy="45"/>

The number: `fovy` over 145 degrees; below 15 degrees, a quarter of the scene's size over what the image shows of it.
Told above 1. Cameras of robots have 30 to 100 degrees, fish eyes 180 that no perspective image can show. Where
`resolution` is given and no field of view, the default of 45 degrees is a hint. Orthographic cameras, whose `fovy` is a
length, are left alone.

When it is wrong: a telescope.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.vector import at
from clinic.diagnosis.probes.view import flat, middle, things
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A field of view next to nothing, or all around"
FAMILIES = ("camera",)

NARROW, HIGH = 15.0, 145.0  # degrees
PART = 0.25  # of the scene that an image should hold
LENSES = ("fovy", "focal", "focalpixel", "sensorsize")


def _beyond(simulation: Simulation, camera: int) -> float:
    angle, target = simulation.model("cam_fovy")[camera], middle(simulation)
    if angle > NARROW or target is None:
        return angle / HIGH
    positions, radii = tuple(simulation.data("geom_xpos")), simulation.model("geom_rbound")
    scene = max(math.dist(at(positions, geom), target) + radii[geom] for geom in things(simulation))
    image = math.dist(simulation.data_row("cam_xpos", camera, 3), target) * math.tan(math.radians(angle) / 2)
    return PART * scene / max(image, 1e-9)


def _default(simulation: Simulation, camera: int) -> float:
    return simulation.model("cam_fovy")[camera]


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera whose angle is no camera's; and those with pixels and no angle."""
    simulation = model.simulation
    for camera, angle in enumerate(simulation.model("cam_fovy")):
        name = (simulation.name("camera", camera),)
        if flat(model, camera):
            continue
        if _beyond(simulation, camera) > 1:
            probe = Probe("field of view beyond a scene of this size by", "times", _beyond, (camera,), dynamic=False)
            lens = model.value("camera", camera, "sensorsize")  # then fovy has no effect
            edits = () if lens else model.set("camera", [camera], "fovy", "45")
            says = f"The image spans {angle:.3g} degrees from top to bottom."
            yield Suspect(name, "fovy", f"{angle:g}", "45", edits, probe, 1.0, says, "15 to 145 degrees")
        elif model.value("camera", camera, "resolution") and not any(
            model.value("camera", camera, lens) for lens in LENSES
        ):
            probe = Probe("field of view", "degrees", _default, (camera,), dynamic=False)
            says = "It has a resolution and no field of view: MuJoCo takes 45 degrees, whatever the real lens has."
            yield Suspect(name, "fovy", "45", "the lens's", (), probe, 0.0, says)
