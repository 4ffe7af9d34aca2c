"""`<compiler inertiafromgeom="true"/>` overrules the `<inertial>` of every body with geoms.

With `true` their masses and inertias are reckoned from the geoms. `auto`, the default, takes the geoms only where there
is no `<inertial>`.

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

The number: how much a body's mass is off the one that its `<inertial>` says; more than a fifth. Without the attribute
it is the other way round, and a body is told whose geoms have masses of their own, which add to more than a fifth above
that of its `<inertial>`, unless each is that: drawn and colliding copies.

When it is wrong: an `<inertial>` that was left in the file and is known to be wrong.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Inertial elements are overruled"
FAMILIES = ("wrong-mass", "sags")
UNPLANTED = "no healthy model has the attribute and an <inertial>"

MOST, SAME = 0.2, 0.02


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies whose mass is not that of their `<inertial>`, all together."""
    yield from _masked(model)
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


def _masked(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies whose `<inertial>` leaves out masses that are written on their geoms."""
    of = model.simulation
    for body, mass in _written(model).items():
        element, own = inertial(model, body), of.model("body_mass")[body]
        edits = (delete(element),) if element is not None else ()
        says = (
            f"Its geoms have {mass:.3g} kg, as is written on them, and do not count: the <inertial> says {own:.3g} kg."
        )
        probe = Probe("share by which a body's mass is off its geoms'", "", _off, (body, mass), dynamic=False)
        wanted = "one of the two"
        yield Suspect((of.name("body", body),), "mass", f"{own:.4g}", f"{mass:.4g}", edits, probe, MOST, says, wanted)


def _written(model: ReaderModel) -> dict[int, float]:
    """By body with an `<inertial>` that is less: the mass of its geoms; copies of what it says are not added."""
    of, made = model.simulation, dict[int, float]()
    for body in of.moving_bodies if model.source is not None and not model.urdf else ():
        own, element = of.model("body_mass")[body], inertial(model, body)
        masses = [float(each) for geom in of.geoms_of(body) if (each := model.value("geom", geom, "mass"))]
        drawn = all(abs(mass - own) < SAME * own for mass in masses)
        if element is not None and len(masses) > 1 and sum(masses) > (1 + MOST) * own and not drawn:
            made[body] = sum(masses)
    return made


def _off(of: Simulation, body: int, mass: float) -> float:
    return abs(of.model("body_mass")[body] / mass - 1)
