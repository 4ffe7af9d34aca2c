"""A camera looks past everything.

A camera looks along its own -z, not along x as one expects of other programs: without an orientation it looks straight
down.

Bad:

    <mujoco>
      <worldbody>
        <camera name="front" pos="2 0 0.5" euler="0 -90 0"/>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <camera name="front" pos="2 0 0.5" euler="0 -90 0"/>
    +     <camera name="front" pos="2 0 0.5" xyaxes="0 1 0 0 0 1"/>

The number: the share of visible geoms, floors left out, of which neither the middle nor a corner of the box around it
is in the image; 1 is nothing in sight. By geometry, for a square image where `resolution` does not say otherwise, at
the start.

When it is wrong: things come into view later, or the camera is meant for the floor. Cameras on moving bodies are left
alone, and of one that is called a head's there is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.view import HEAD, aimed, onlookers, sees, things
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Probe, Suspect

TITLE = "A camera that looks past everything"
FAMILIES = ("camera",)
SINCE = "0.1"

MOST = 0.999


def _unseen(simulation: Simulation, camera: int) -> float:
    there = things(simulation)
    return 1.0 - sum(sees(simulation, camera, geom) for geom in there) / len(there) if there else 0.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera that looks from outside and has nothing in sight."""
    simulation = model.simulation
    for camera in onlookers(simulation):
        if simulation.count("geom") and _unseen(simulation, camera) > MOST:
            edits = aimed(model, camera)
            probe = Probe("out of sight", "of all geoms but floors", _unseen, (camera,), dynamic=False)
            value = edits[-1].value if edits else "towards the things"
            says = "Nothing but floors is in its image."
            name = simulation.name("camera", camera)
            level: Level = "hint" if HEAD.search(name) else "cause"
            yield Suspect((name,), "xyaxes", "", value, edits, probe, MOST, says, level=level)
