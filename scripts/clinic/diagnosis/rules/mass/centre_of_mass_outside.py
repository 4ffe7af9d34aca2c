"""The centre of mass is outside of the body's geoms.

`pos` of `<inertial>` in millimetres, with a wrong sign, or in the frame of another body. The joint then carries a
moment that is not there, and a robot leans or tips over.

Bad:

    <mujoco>
      <worldbody>
        <body name="link" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0 0 200" mass="1" diaginertia="0.0135 0.0135 0.0002"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.4" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 0 200" mass="1" diaginertia="0.0135 0.0135 0.0002"/>
    +       <inertial pos="0 0 0.2" mass="1" diaginertia="0.0135 0.0135 0.0002"/>

The number: how far outside of the box around the geoms, in half lengths of that box. 0 for 95 % of 1475 bodies in
healthy models; 0.5 for one body of five and more, else 1.5, are told. Where the other sign of one coordinate brings it
inside, 0.1 is: so it is with 5 of 2440 bodies, four of them of one robot. Bodies of less than 1 % of the moving mass
are left alone, and those whose geoms are written to have no mass; of these one is told that is 1.5 half lengths outside
and with a tenth or a thousandth of its place inside.

When it is wrong: a body that is drawn only in part.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from clinic.diagnosis.probes.inertia import inertial, set_inertial
from clinic.diagnosis.probes.matter import Matter, centre_outside, explicit, matter
from clinic.diagnosis.probes.vector import Vector, flipped, norm, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "The centre of mass is outside of the body"
FAMILIES = ("drifts", "sags", "wrong-mass")
AFLOAT = True
LEVEL = "hint"

LIMIT, LIGHT, LITTLE = 0.5, 0.01, 0.1
MILLI = 50  # half lengths that a place in mm is off at the least
FAR = 1.5  # where a unit is wrong, whatever the other bodies are like


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """A body whose centre of mass is far out of its geoms, where the others' are in theirs."""
    of = model.simulation
    heavy = [(body, each) for body, each in explicit(model) if each.mass > LIGHT * of.moving_mass]
    found = [(body, each) for body, each in heavy if each.outside > LIMIT * max(each.half)]
    alone = len(found) == 1 and len(heavy) >= 5
    if not alone:
        found = [(body, each) for body, each in found if each.outside > FAR * max(each.half)]
    yield from _slipped(model)
    turned = [(body, each, sign) for body, each in heavy if (sign := _other_sign(each)) is not None]
    for body, each, centre in turned:
        now, value = f"pos {written(each.centre)}", f"pos {written(centre)}"
        edits = set_inertial(model, body, each.mass, centre, each.about)
        says = f"{each.mass:.3g} kg lie {each.outside:.3g} m outside of the box around its geoms; with the other sign "
        says += "inside."
        name = (of.name("body", body),)
        yield Suspect(name, "inertial", now, value, edits, centre_outside(body), LITTLE, says, "inside")
    for body, each in found:
        if any(body == other for other, *_ in turned):
            continue
        centre = _scaled(each, 1000) or each.solid_centre
        yield Suspect(
            (of.name("body", body),),
            "inertial",
            f"pos {written(each.centre)}",
            f"pos {written(centre)}",
            set_inertial(model, body, each.mass, centre, each.about),
            centre_outside(body),
            LIMIT,
            f"{each.mass:.3g} kg lie {each.outside:.3g} m outside of the box around its geoms.",
            "inside, as in 95 % of 1475 bodies of healthy models",
            excess=each.outside / max(each.half),
        )


def _slipped(model: ReaderModel) -> Iterator[Suspect]:
    """The centres outside of geoms without a mass that a tenth or a thousandth brings inside."""
    of = model.simulation
    told = {body for body, _ in explicit(model)}
    for body in of.moving_bodies:
        found = matter(of, body) if body not in told and inertial(model, body) is not None else None
        if found is not None and (centre := _scaled(found, 10, 1000)):
            now, value = f"pos {written(found.centre)}", f"pos {written(centre)}"
            edits = set_inertial(model, body, found.mass, centre, found.about)
            says = f"{found.mass:.3g} kg lie {found.outside:.3g} m outside of the box around its geoms."
            name, probe = (of.name("body", body),), centre_outside(body)
            yield Suspect(name, "inertial", now, value, edits, probe, LIMIT, says, "inside", level="hint")


def _scaled(found: Matter, *divisors: int) -> Vector | None:
    """A centre of mass far outside of the geoms over the first of some numbers that brings it inside; else None.

    A thousandth is tried where the centre is farther out than any that is in m.
    """
    size = max(found.half)
    if found.outside <= FAR * size:
        return None
    tried = [by for by in divisors if by < 1000 or norm(found.centre) > MILLI * size]
    centres = [tuple(x / by for x in found.centre) for by in tried]
    return next((each for each in centres if replace(found, centre=each).outside == 0), None)


def _other_sign(found: Matter) -> Vector | None:
    """The centre of mass with the sign of one coordinate changed, where that brings it inside; else None."""
    if found.outside <= LITTLE * max(found.half):
        return None
    for axis in range(3):
        centre = flipped(found.centre, axis)
        ways = zip(centre, found.middle, found.half, strict=True)
        if all(abs(x - middle) <= half for x, middle, half in ways):
            return centre
    return None
