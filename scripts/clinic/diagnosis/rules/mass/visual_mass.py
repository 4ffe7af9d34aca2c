"""Geoms that are only seen have mass beside those that collide.

A geom with `contype="0" conaffinity="0"` still counts into the inertia of its body, at 1000 kg/m3 where nothing else is
written. Beside a colliding geom of the same shape the same matter counts twice. Geoms of the same group that are larger
or smaller than what collides are taken for parts, not for a skin.

Bad:

    <mujoco>
      <worldbody>
        <body name="drill" pos="0 0 1">
          <freejoint/>
          <geom type="sphere" size="0.05" contype="0" conaffinity="0"/>
          <geom type="sphere" size="0.05" mass="0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom type="sphere" size="0.05" contype="0" conaffinity="0"/>
    +       <geom type="sphere" size="0.05" contype="0" conaffinity="0" mass="0"/>

The number: the body's mass, with and without such geoms: those for which no mass and no density is written, those with
the very mass of a colliding geom of the same type, and meshes with the density of those that collide in another group,
as where the compiler's `inertiagrouprange` was lost. Half as much again is a cause, or a hint where it is less than 1 %
of the mass of the whole mechanism.

When it is wrong: where the visible geoms are meant to be the mass; a mass or density that is written says so.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import MESH, CompileError
from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.matter import mass_of
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect

TITLE = "Geoms that are only seen have mass"
FAMILIES = ("sags", "wrong-mass", "drifts")
AFLOAT = True
CASE = "drone-will-not-hover"

MORE = 1.5
LITTLE = 0.01  # of the mass of the mechanism that the bodies belong to


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All seen geoms at the default density, beside colliding ones of the same body."""
    of = model.simulation
    seen: list[int] = []
    for body in of.moving_bodies:
        if inertial(model, body) is not None:
            continue
        others = [geom for geom in of.geoms_of(body) if solid(of, geom)]
        mine = [
            geom
            for geom in of.geoms_of(body)
            if not (solid(of, geom) or _meant_to_touch(of, geom))
            and (not _written(model, geom) or _copies(model, geom, others))
        ]
        if others:
            seen += [geom for geom in mine if _is_skin(of, geom, others)]
    edits = model.set("geom", seen, "mass", "0")
    without = model.with_edits(edits) if edits else None
    if without is None or isinstance(without, CompileError):
        return
    mass, other = of.model("body_mass"), without.model("body_mass")
    bodies = tuple(body for body in of.moving_bodies if mass[body] > MORE * other[body] > 0)
    if bodies:
        now, rest = sum(mass[body] for body in bodies), sum(other[body] for body in bodies)
        roots = {int(of.model("body_rootid")[body]) for body in bodies}
        whole = sum(of.model("body_subtreemass")[root] for root in roots)
        yield Suspect(
            tuple(of.name("body", body) for body in bodies),
            "mass",
            "left out",
            "0",
            edits,
            mass_of(*bodies),
            MORE * rest,
            f"Geoms that touch nothing add {now - rest:.3g} kg to the {rest:.3g} kg of those that collide.",
            'mass="0" for geoms that are only seen',
            share=0.95,
            excess=now / rest,
            level="cause" if now - rest > LITTLE * whole else "hint",
        )


def _meant_to_touch(of: Simulation, geom: int) -> bool:
    """Whether its twin on the other side collides."""
    twin = twins(of).partner("geom", geom)
    return twin is not None and solid(of, twin)


def _copies(model: ReaderModel, geom: int, others: list[int]) -> bool:
    """Whether a geom has what one that collides has, so that it counts twice: mass and type, or density in a group."""
    types, mass = model.simulation.model("geom_type"), model.value("geom", geom, "mass")
    like = [other for other in others if types[other] == types[geom]]
    if mass is not None:
        return any(model.value("geom", other, "mass") == mass for other in like)
    groups, density = model.simulation.model("geom_group"), model.value("geom", geom, "density")
    apart = others and types[geom] == MESH and all(groups[other] != groups[geom] for other in others)
    return bool(apart) and all(model.value("geom", other, "density") == density for other in others)


def _is_skin(of: Simulation, geom: int, others: list[int]) -> bool:
    """Whether a geom shows what others collide as: a mesh, of another group, or about as large."""
    group, sizes = of.model("geom_group"), of.model("geom_rbound")
    if int(of.model("geom_type")[geom]) == MESH or all(group[geom] != group[other] for other in others):
        return True
    return any(0.8 < sizes[geom] / sizes[other] < 1.25 for other in others if sizes[other] > 0)


def _written(model: ReaderModel, geom: int) -> bool:
    """Whether somebody gave it a mass: itself, or as a member of a class."""
    element = model.element("geom", geom)
    if element is None or element.get("class"):
        return element is None or any(model.value("geom", geom, name) for name in ("mass", "density"))
    return any(name in element.attributes for name in ("mass", "density"))
