"""A camera looks past everything.

A camera looks along its own -z, not along x as one expects of other programs: a camera of the world without an
orientation looks straight down.

Bad:

    <mujoco>
      <worldbody>
        <camera name="front" pos="2 0 0.5" xyaxes="0 -1 0 0 0 1"/>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <camera name="front" pos="2 0 0.5" xyaxes="0 -1 0 0 0 1"/>
    +     <camera name="front" pos="2 0 0.5" xyaxes="0 1 0 0 0 1"/>

The number: the share of visible geoms, floors left out, whose box has neither its middle nor a corner in the image, and
is not straight ahead; 1 is nothing in sight. By geometry, for a square image where `resolution` does not say otherwise,
at the start. A camera of the world is told, too, where all that is to be seen takes less than 0.5 % of the image's
height: its place may be in mm. Orthographic cameras are left alone.

When it is wrong: things come into view later, or the camera is meant for the floor. Cameras on moving bodies are left
alone, and of one that is called a head's there is a hint.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.probes.view import HEAD, aimed, flat, middle, onlookers, opening, sees, things
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Probe, Suspect

TITLE = "A camera that looks past everything"
FAMILIES = ("camera",)

MOST = 0.999
LEAST, CLOSE, OUTSIDE = 0.005, 20.0, 1.2  # of the image's height; of the model's; of its radius
UNITS = (("mm", 1000), ("cm", 100))


def _unseen(simulation: Simulation, camera: int) -> float:
    there = things(simulation)
    return 1.0 - sum(sees(simulation, camera, geom) for geom in there) / len(there) if there else 0.0


def _small(simulation: Simulation, camera: int) -> float:
    """What all that is to be seen takes of the image's height."""
    centre, there = middle(simulation), things(simulation)
    if centre is None or simulation.model("cam_bodyid")[camera]:
        return 1.0
    far = math.dist(centre, simulation.data_row("cam_xpos", camera, 3))
    reach = [math.dist(centre, simulation.data_row("geom_xpos", geom, 3)) for geom in there]
    radius = max(each + simulation.model("geom_rbound")[geom] for each, geom in zip(reach, there, strict=True))
    return radius / max(far * opening(simulation, camera)[0], 1e-9)


def _in_mm(model: ReaderModel, camera: int, small: float) -> Iterator[Suspect]:
    """A camera so far away that all of the model is a dot: its place is in mm, or else in cm."""
    of, place = model.simulation, model.simulation.row("cam_pos", camera, 3)
    probe = Probe("height of the image over that of the model in it", "", _over, (camera,), dynamic=False)
    tries = [(unit, model.set("camera", [camera], "pos", written([x / by for x in place]))) for unit, by in UNITS]
    outside = OUTSIDE * opening(of, camera)[0]
    near = ((unit, each) for unit, each in tries if each and outside < model.measured(probe, each) < CLOSE)
    unit, edits = next(near, ("", ()))
    says = (
        f"All of the model takes {100 * small:.2g} % of its image's height."
        + f" As {unit} its place is near." * bool(unit)
    )
    value = edits[0].value if edits else "nearer"
    yield Suspect(
        (of.name("camera", camera),), "pos", written(place), value, edits, probe, 1 / LEAST, says, level="hint"
    )


def _over(of: Simulation, camera: int) -> float:
    return 1 / _small(of, camera)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each camera that looks from outside and has nothing in sight."""
    simulation = model.simulation
    for camera in (each for each in onlookers(simulation) if not flat(model, each)):
        if (small := _small(simulation, camera)) < LEAST:
            yield from _in_mm(model, camera, small)
            continue
        if simulation.count("geom") and _unseen(simulation, camera) > MOST:
            edits = aimed(model, camera)
            probe = Probe("out of sight", "of all geoms but floors", _unseen, (camera,), dynamic=False)
            value = edits[-1].value if edits else "towards the things"
            says = "Nothing but floors is in its image."
            name = simulation.name("camera", camera)
            level: Level = "hint" if HEAD.search(name) else "cause"
            yield Suspect((name,), "xyaxes", "", value, edits, probe, MOST, says, level=level)
