"""A free object weighs what water of its size weighs: nobody said its mass.

Without `mass`, `density` or `<inertial>` MuJoCo fills a geom with 1000 kg/m3. A cardboard box of 30 cm then has 27 kg:
few arms lift it, and it stops a robot that pushes it.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="parcel" pos="0 0 0.2">
          <freejoint/>
          <geom type="box" size="0.2 0.2 0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom type="box" size="0.2 0.2 0.2"/>
    +       <geom type="box" size="0.2 0.2 0.2" mass="2"/>

The number: the mass of a free body alone, where no geom of it has a `mass` or a `density` but 0: more than 5 kg, or
more than all else that moves, where that is driven and has masses of its own. Of 289 healthy models one has such an
object, a ball of 14 kg.

When it is wrong: a block of wood, ice or water of that size.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.matter import mass_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, rounded

TITLE = "An object as heavy as water"
FAMILIES = ("wrong-mass", "stuck", "sags")
UNPLANTED = "what an object should weigh, only its maker knows"

HEAVY = 5.0  # kg


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The free bodies of the default density that are heavy, all together."""
    of = model.simulation
    if model.source is None or any(each.get("settotalmass") for each in model.source.elements("compiler")):
        return
    masses = of.model("body_mass")
    alone = [
        body
        for body in of.free_bodies
        if body not in of.children and model.element("body", body) is not None and _by_default(model, body)
    ]
    others = [body for body in of.moving_bodies if body not in alone]
    robot = sum(masses[body] for body in others)
    driven = of.count("actuator") and others and not any(_by_default(model, body) for body in others)
    limit = min(HEAVY, robot) if driven else HEAVY
    found = [body for body in alone if masses[body] > limit]
    if found:
        worst = max(found, key=lambda body: masses[body])
        beside = "" if masses[worst] > HEAVY else f" All else that moves weighs {rounded(robot)} kg."
        yield Suspect(
            tuple(of.name("body", body) for body in found),
            "density",
            "1000 (default)",
            "that of the object",
            (),
            mass_of(worst),
            limit,
            f"{of.name('body', worst)} weighs {rounded(masses[worst])} kg: nothing says its mass, and the default is "
            f"that of water.{beside}",
            "below 5 kg, or with a mass of its own",
        )


def _by_default(model: ReaderModel, body: int) -> bool:
    """Whether a body has geoms, and nothing says what they or it weigh, or that they do not."""
    geoms = model.simulation.geoms_of(body)
    unsaid = all(_weight(model, geom, name) for geom in geoms for name in ("mass", "density"))
    return bool(geoms) and unsaid and inertial(model, body) is None


def _weight(model: ReaderModel, geom: int, attribute: str) -> bool:
    """Whether nothing is written, or that the geom weighs nothing."""
    return not float(model.value("geom", geom, attribute) or "0")
