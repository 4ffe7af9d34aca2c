"""A camera's principal point lies far from the middle of its image.

`principal` and `principalpixel` are offsets from the middle, in metres and pixels. Calibrations give the point from a
corner: half of the resolution, which shifts the image by half of its width and of its height.

Bad:

    <mujoco>
      <worldbody>
        <camera name="front" pos="1 0 0.5" xyaxes="0 1 0 -0.4 0 1"
          resolution="640 480" sensorsize="0.004 0.003" focal="0.003 0.003" principalpixel="320 240"/>
        <geom type="box" size="0.05 0.05 0.05"/>
      </worldbody>
    </mujoco>

Good:

    -       resolution="640 480" sensorsize="0.004 0.003" focal="0.003 0.003" principalpixel="320 240"/>
    +       resolution="640 480" sensorsize="0.004 0.003" focal="0.003 0.003" principalpixel="2 -1"/>

The number: the offset as a share of the sensor's side; below 0.25 is well. Real lenses are off by a few pixels.

When it is wrong: a shift lens.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A principal point far from the middle"
FAMILIES = ("camera",)
LEVEL = "cause"
UNPLANTED = "no camera of the healthy models has a principal point"

MOST = 0.25  # of the sensor's side


def _aside(simulation: Simulation, camera: int) -> float:
    sides = simulation.row("cam_sensorsize", camera, 2)
    offsets = simulation.row("cam_intrinsic", camera, 4)[2:]
    return max(abs(offset) / side if side > 0 else 0.0 for offset, side in zip(offsets, sides, strict=True))


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera with such an offset, without it."""
    simulation = model.simulation
    for camera in range(simulation.count("camera")):
        if _aside(simulation, camera) > MOST:
            element = model.element("camera", camera)
            names = [
                each for each in ("principal", "principalpixel") if element is not None and each in element.attributes
            ]
            edits = tuple(remove_attribute(element, each) for each in names) if element is not None else ()
            probe = Probe("principal point off the middle", "of the sensor's side", _aside, (camera,), dynamic=False)
            now = element.get(names[0]) if element is not None and names else ""
            says = "It is an offset from the middle of the image, not a place from its corner."
            attribute = names[0] if names else "principal"
            yield Suspect((simulation.name("camera", camera),), attribute, now, "0 0", edits, probe, MOST, says)
