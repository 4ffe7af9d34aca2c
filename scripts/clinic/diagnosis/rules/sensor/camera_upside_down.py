"""A camera's image is upside down.

A camera looks along its own -z, and its y axis is up in the image. `xyaxes`, `euler` and `quat` with a wrong sign
turn it by 180 degrees about the view.

Bad:

    <mujoco>
      <worldbody>
        <camera name="front" pos="1.6 0 0.5" xyaxes="0 -1 0 0 0 -1"/>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <camera name="front" pos="1.6 0 0.5" xyaxes="0 -1 0 0 0 -1"/>
    +     <camera name="front" pos="1.6 0 0.5" xyaxes="0 1 0 0 0 1"/>

The number: the angle between the image's up and the world's z; above 100 degrees is told, of a camera that is fixed to
the world or follows a robot, and does not look within 25 degrees of straight up or down. On a body with a free joint or
a head it is a hint. So is, on all of these, an image that lies on its side by more than 45 degrees.

When it is wrong: a camera that is mounted upside down on purpose. Cameras on arms are left alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import CAM_FIXED
from clinic.diagnosis.probes.view import HEAD, axes, onlookers, turned
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Probe, Suspect

TITLE = "A camera that is upside down"
FAMILIES = ("camera",)
CASE = "camera-upside-down"

MOST, ASIDE, UPSIDE = 100.0, 45.0, 0.9  # degrees, degrees; of the view's direction along the vertical


def _tilt(simulation: Simulation, camera: int) -> float:
    simulation.begin()
    _, up, forward = axes(simulation, camera)
    return math.degrees(math.acos(max(-1.0, min(1.0, up[2])))) if abs(forward[2]) < UPSIDE else 0.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera that looks from outside, turned by 180 degrees about its view."""
    simulation = model.simulation
    aboard = [camera for camera in _aboard(simulation) if camera not in onlookers(simulation)]
    for camera in (*onlookers(simulation), *aboard):
        if _tilt(simulation, camera) > MOST:
            right, up, _ = axes(simulation, camera)
            edits = turned(model, camera, [-each for each in right], [-each for each in up])
            name, probe = (
                simulation.name("camera", camera),
                Probe("image up against world up", "degrees", _tilt, (camera,), dynamic=False),
            )
            says = "The image's up points down in the world."
            value = edits[-1].value if edits else "turned by 180 degrees"
            level: Level = "hint" if camera in aboard else "cause"
            yield Suspect((name,), "xyaxes", "", value, edits, probe, MOST, says, "0 to 90 degrees", level=level)
    yield from _aside(simulation)


def _aboard(simulation: Simulation) -> list[int]:
    """The cameras that are fixed to a body with a free joint, or to a head."""
    bodies, modes = simulation.model("cam_bodyid"), simulation.model("cam_mode")
    heads = [body for body in range(1, simulation.count("body")) if HEAD.search(simulation.name("body", body))]
    carriers = {*simulation.free_bodies, *heads}
    pairs = enumerate(zip(bodies, modes, strict=True))
    return [camera for camera, (body, mode) in pairs if int(mode) == CAM_FIXED and int(body) in carriers]


def _aside(simulation: Simulation) -> Iterator[Suspect]:
    """Each camera of the world, of a body with a free joint or of a head whose image lies on its side."""
    modes, aboard = simulation.model("cam_mode"), _aboard(simulation)
    for camera in range(simulation.count("camera")):
        if int(modes[camera]) != CAM_FIXED or not (camera in onlookers(simulation) or camera in aboard):
            continue
        roll = _roll(simulation, camera)
        if roll > ASIDE and _tilt(simulation, camera) <= MOST:  # else told as upside down
            probe = Probe("image's horizon against the world's", "degrees", _roll, (camera,), dynamic=False)
            says = f"The image's right points {roll:.0f} degrees up or down in the world: the image lies on its side."
            name, turned_by = (simulation.name("camera", camera),), f"turned by {roll:.0f} degrees"
            yield Suspect(name, "xyaxes", "", turned_by, (), probe, ASIDE, says, "0 to 45 degrees")


def _roll(simulation: Simulation, camera: int) -> float:
    """The angle in degrees between the image's right and the level."""
    simulation.begin()
    right, _, _ = axes(simulation, camera)
    return math.degrees(math.asin(min(1.0, abs(right[2]))))
