"""Gravity pulls away from the floor.

`gravity="0 0 9.81"`: what is free leaves the floor, upwards.

Bad:

    <mujoco>
      <option gravity="0 0 9.81"/>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <option gravity="0 0 -9.81"/>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1"/>
        </body>
      </worldbody>
    </mujoco>

The number: the component of gravity along the normal of a level plane, in m/s2. A model on the ground has -9.81.

When it is wrong: a ceiling that things are meant to fall to.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.vector import dot, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Gravity points upwards"
FAMILIES = ("stuck", "drifts")
SINCE = "0.2"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The option, where gravity points out of a plane."""
    gravity = model.simulation.model("opt.gravity")
    down = written(tuple(-x for x in gravity))
    probe = Probe("gravity away from the floor", "m/s2", _upwards, dynamic=False)
    says = "It pulls away from the plane that things should rest on."
    edits = model.option("gravity", down)
    yield Suspect(("gravity",), "gravity", written(gravity), down, edits, probe, 0.1, says, "0 0 -9.81, z up")


def _upwards(simulation: Simulation) -> float:
    simulation.begin()
    kinds = simulation.model("geom_type")
    planes = [geom for geom, kind in enumerate(kinds) if int(kind) == PLANE and geom in simulation.geoms_of(0)]
    normals = [simulation.data_row("geom_xmat", geom, 9)[2::3] for geom in planes]
    gravity = simulation.model("opt.gravity")
    return max((dot(gravity, normal) for normal in normals), default=0.0) if len(normals) == 1 else 0.0
