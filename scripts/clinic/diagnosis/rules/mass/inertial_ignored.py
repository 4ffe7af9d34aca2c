"""`<compiler inertiafromgeom="true"/>` overrules every `<inertial>` of the file.

With `true` masses and inertias are reckoned from the geoms, and what stands in `<inertial>` is not used. `auto`, the
default, takes the geoms where there is no `<inertial>` alone.

Bad:

    <mujoco>
      <compiler inertiafromgeom="true"/>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0.1 0 0" mass="0.5" diaginertia="0.0001 0.002 0.002"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" density="7800"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <compiler inertiafromgeom="true"/>

The number: how much a body's mass is off the one that its `<inertial>` says; more than a fifth.

When it is wrong: an `<inertial>` that was left in the file and is known to be wrong.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Every <inertial> is overruled"
FAMILIES = ("wrong-mass", "sags")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "no healthy model has the attribute and an <inertial>"

MOST = 0.2


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies whose mass is not that of their `<inertial>`, all together."""
    of = model.simulation
    if model.source is None or not any(
        each.get("inertiafromgeom") == "true" for each in model.source.elements("compiler")
    ):
        return
    said: dict[int, float] = {}
    for body in of.moving_bodies:
        element = inertial(model, body)
        mass = element.get("mass") if element is not None else None
        if mass and abs(of.model("body_mass")[body] / float(mass) - 1) > MOST:
            said[body] = float(mass)
    if not said:
        return
    worst = max(said, key=lambda body: of.model("body_mass")[body] / said[body])
    probe = Probe("share by which a body's mass is off its inertial's", "", _off, (worst, said[worst]), dynamic=False)
    yield Suspect(
        tuple(of.name("body", body) for body in said),
        "inertiafromgeom",
        "true",
        "auto",
        model.option("inertiafromgeom", "auto", "compiler"),
        probe,
        MOST,
        f"{of.name('body', worst)} weighs {of.model('body_mass')[worst]:.3g} kg, and its <inertial> says "
        f"{said[worst]:.3g} kg: it is not used.",
        "the mass that is written",
        level="hint",
    )


def _off(of: Simulation, body: int, mass: float) -> float:
    return abs(of.model("body_mass")[body] / mass - 1)
