"""A body is denser than any metal.

A mass in grams, a decimal point that is missing, a mesh that is scaled and a mass that is not. The servos above it
cannot carry it, and what it touches is pressed in.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="350"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="350"/>
    +       <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="0.35"/>

The number: the body's mass over the volume of its geoms, of a mesh that of the box around it; osmium, the densest
metal, has 22,600 kg/m3, and half of 1475 bodies in healthy models have 243 to 677. A cause has 24,000 and more than a
twentieth of the moving mass. A hint are four links and more, with inertias like those of their geoms, of which the one
in the middle has more than 5,000, two thirds of solid steel.

When it is wrong: a body of which a small part is drawn. One that slides by itself, as a point mass does, is not told.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.inertia import inertial, set_inertial
from clinic.diagnosis.probes.matter import Matter, density, explicit, matter, volume_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Denser than metal"
FAMILIES = ("sags", "wrong-mass", "explodes", "stuck")
AFLOAT = True

METAL, LIGHT, WATER = 24000.0, 0.05, 1000.0
ALONE = 4.0  # half lengths from what is drawn of a body to the middle of its mass
PARTLY = 1.5  # times as dense has a body to be of which the geoms are a part
STEEL, USUAL, MANY, MOST_OF = 5000.0, 1200.0, 4, 0.6
MATERIAL, LIKELY = (100.0, 8000.0), 450.0  # kg/m3: hollow plastic to steel; the body in the middle of 1475
SHOWN = 0.7, 1.4  # the radius of gyration over that of geoms that show the body


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies that no material makes, all together, or links that are all of solid steel."""
    yield from _steel(model)
    of = model.simulation
    dense = [
        (body, found)
        for body in of.moving_bodies
        if (found := matter(of, body)) and _dense(found) and found.mass > LIGHT * of.moving_mass
    ]
    slides = all(of.joint_type(joint) == SLIDE for joint in range(of.count("joint")))
    if not dense or (slides and len(of.moving_bodies) == 1):  # a point mass may be as small as one likes
        return
    worst = max(dense, key=lambda each: each[1].density)[1]
    factor = _tens(worst.density)
    edits = _lighter(model, dense)
    geoms = [geom for body, _ in dense if inertial(model, body) is None for geom in _alone(model, body)]
    by_density = bool(edits) and all(edit.attribute == "density" for edit in edits)
    now = f"{float(edits[0].value) * factor:g}" if by_density else f"{worst.mass:.3g} kg"
    if geoms:
        now = model.value("geom", geoms[0], "density" if by_density else "mass") or now
    yield Suspect(
        (*(of.name("geom", geom) for geom in geoms), *(of.name("body", body) for body, _ in dense)),
        "density" if by_density else "mass",
        now,
        edits[0].value if by_density or geoms else f"{worst.mass / factor:.3g} kg",
        edits,
        density(*(body for body, _ in dense)),
        METAL,
        f"{worst.mass:.3g} kg in {1000 * worst.volume:.3g} litres of geoms: {worst.density:.3g} kg/m3.",
        "22,600 kg/m3 is the densest metal, osmium",
        excess=worst.density / METAL,
    )


def _dense(found: Matter) -> bool:
    """Whether a body is denser than metal: by far, where its geoms are too small to show it.

    None whose centre of mass lies farther outside of them than they are long: they are a small part of it.
    """
    if found.radius > SHOWN[1] and found.outside > ALONE * max(found.half):
        return False
    return found.density > METAL * (1 if found.radius < SHOWN[1] else PARTLY)


def _steel(model: ReaderModel) -> Iterator[Suspect]:
    """The links of a mechanism of which the one in the middle is as dense as metal: one is, where one is a weight."""
    every = [(body, each) for body, each in explicit(model) if each.volume > 0]
    found = [(body, each) for body, each in every if SHOWN[0] < each.radius < SHOWN[1]]
    if len(found) < max(MANY, MOST_OF * len(every)):
        return
    middle = sorted(each.density for _, each in found)[len(found) // 2]
    if not STEEL < middle < METAL:
        return
    of, mass = model.simulation, sum(each.mass for _, each in found)
    yield Suspect(
        tuple(of.name("body", body) for body, _ in found),
        "mass",
        f"{mass:.3g} kg",
        f"{mass * USUAL / middle:.2g} kg",
        (),
        density(*(body for body, _ in found)),
        STEEL,
        f"Half of its {len(found)} links have more than {middle:.3g} kg/m3, as if they were of solid metal.",
        "300 to 3,000 kg/m3: 207 of 208 robots have less than 5,000 in the middle",
    )


def _alone(model: ReaderModel, body: int) -> dict[int, float]:
    """The geoms of a body that are denser than metal, by their factor, where others of it are not."""
    of, geoms = model.simulation, model.simulation.geoms_of(body)
    densities = {}
    for geom in geoms:
        mass, volume = model.value("geom", geom, "mass"), volume_of(of, geom)
        written = float(mass) / volume if mass and volume else model.value("geom", geom, "density")
        densities[geom] = float(written or WATER)
    heavy = {geom: each for geom, each in densities.items() if each > METAL}
    return {geom: _tens(each) for geom, each in heavy.items()} if len(heavy) < len(geoms) else {}


def _tens(density: float) -> float:
    """The power of ten that a density is above the usual one; a thousand, as of grams, where that leaves a material."""
    if MATERIAL[0] < density / 1000 < MATERIAL[1]:
        return 1000.0
    return float(10.0 ** round(math.log10(density / LIKELY)))


def _lighter(model: ReaderModel, dense: Sequence[tuple[int, Matter]]) -> tuple[Edit, ...]:
    """The edits that make bodies lighter: in a default class where all of its geoms are meant."""
    made: tuple[Edit, ...] = ()
    written: dict[tuple[str, str, float], list[int]] = {}
    for body, found in dense:
        factor = _tens(found.density)
        if inertial(model, body) is not None:
            kept = abs(math.log(found.radius * math.sqrt(factor))) < abs(math.log(found.radius))  # of the right mass
            about = found.about if kept else tuple(x / factor for x in found.about)
            made += set_inertial(model, body, found.mass / factor, found.centre, about)
            continue
        alone = _alone(model, body)
        for geom in alone or model.simulation.geoms_of(body):
            for name in ("mass", "density"):
                if float(text := model.value("geom", geom, name) or "0"):
                    written.setdefault((name, text, alone.get(geom, factor)), []).append(geom)
    of = model.simulation
    fixed = [geom for geom, body in enumerate(of.model("geom_bodyid")) if not of.model("body_weldid")[int(body)]]
    for (name, text, factor), geoms in written.items():
        without_weight = [geom for geom in fixed if model.value("geom", geom, name) == text]
        meant = model.set("geom", geoms + without_weight, name, f"{float(text) / factor:.6g}")
        made += meant if len(meant) == 1 else model.set("geom", geoms, name, f"{float(text) / factor:.6g}")
    return made
