"""The near or far clipping plane cuts everything away.

`znear` and `zfar` of `<map>` are not metres: they are multiplied with the model's extent. Nothing nearer or farther
is drawn.

Bad:

    <mujoco>
      <visual>
        <map znear="3" zfar="5"/>
      </visual>
      <statistic extent="1"/>
      <worldbody>
        <camera name="front" pos="1 0 0.5" xyaxes="0 1 0 -0.4 0 1"/>
        <geom type="box" size="0.05 0.05 0.05"/>
      </worldbody>
    </mujoco>

Good:

    -   <visual>
    -     <map znear="3" zfar="5"/>
    -   </visual>

The number: of the geoms in a camera's sight, the share that is nearer than `znear` or farther than `zfar` times the
extent; above 0.9 is told.

When it is wrong: a camera that looks from within.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.probes.view import flat, in_sight, onlookers
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Clipping planes that cut everything away"
FAMILIES = ("camera",)
LEVEL = "cause"
UNPLANTED = "no harm is measured in images"

MOST = 0.9
DEFAULTS = {"znear": "0.01", "zfar": "50"}  # MuJoCo's


def _clipped(simulation: Simulation, camera: int) -> float:
    near, far = (simulation.extent * simulation.model(f"vis.map.{name}")[0] for name in ("znear", "zfar"))
    radii, seen = simulation.model("geom_rbound"), in_sight(simulation, camera)
    cut = [geom for geom, ahead in seen if ahead + radii[geom] < near or ahead - radii[geom] > far]
    return len(cut) / len(seen) if seen else 0.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Both planes, for the first camera that sees nothing for them."""
    simulation = model.simulation
    maps = [
        each
        for each in (model.source.elements("map") if model.source else ())
        if {"znear", "zfar"} & set(each.attributes)
    ]
    for camera in onlookers(simulation) if maps else ():
        if flat(model, camera):
            continue
        probe = Probe("cut away", "of what is in sight", _clipped, (camera,), dynamic=False)
        if (share := model.measured(probe)) > MOST:
            names = [name for name in ("znear", "zfar") if name in maps[-1].attributes]
            now = ", ".join(f"{name} {maps[-1].get(name)}" for name in names)
            edits = tuple(remove_attribute(maps[-1], name) for name in names)
            value = ", ".join(DEFAULTS[name] for name in names)
            says = f"{now}, times the extent of {simulation.extent:.3g} m, cut away "
            says += f"{100 * share:.0f} % of the geoms in its sight."
            camera_name = simulation.name("camera", camera)
            yield Suspect(("<map>", camera_name), ", ".join(names), now, value, edits, probe, MOST, says)
            return
