"""The centre of mass has the wrong sign: it lies where the body would be if it were turned around.

`pos` of `<inertial>` in a frame whose axes point the other way, as when the frames of the joints were changed and the
numbers of the CAD program were not. The body weighs on its joint from the wrong side.

Bad:

    <mujoco>
      <worldbody>
        <body name="link" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0 -0.04 -0.05" mass="1" diaginertia="2e-3 2e-3 1e-3"/>
          <geom type="box" pos="0 0.03 0.03" size="0.05 0.08 0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 -0.04 -0.05" mass="1" diaginertia="2e-3 2e-3 1e-3"/>
    +       <inertial pos="0 0.04 0.05" mass="1" diaginertia="2e-3 2e-3 1e-3"/>

The number: how far the centre of mass is from that of the geoms, in sizes of the box around them: more than 0.4, and
with other signs less than a quarter of that. Of 234 healthy or repaired models two of one robot have such bodies, its
upper arms. Bodies of less than 1 % of the moving mass are left alone.

When it is wrong: a body whose heavy end is not drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product

from clinic.diagnosis.probes.inertia import set_inertial
from clinic.diagnosis.probes.matter import Matter, explicit, matter
from clinic.diagnosis.probes.vector import Vector, norm, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.mass import centre_of_mass_outside
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A centre of mass with the wrong sign"
FAMILIES = ("drifts", "sags", "wrong-mass")
AFLOAT = True
UNPLANTED = "most links of healthy models have their centre near the axis, where its sign matters little"

FAR, NEARER, LIGHT = 0.4, 0.25, 0.01


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each body that other signs bring near the middle of its geoms."""
    of = model.simulation
    turned = [(body, each, centre) for body, each in explicit(model) if (centre := _turned(each)) is not None]
    told = {name for each in centre_of_mass_outside.suspects(model) for name in each.elements} if turned else set()
    for body, each, centre in turned:
        if each.mass < LIGHT * of.moving_mass or of.name("body", body) in told:
            continue
        now, value = f"pos {written(each.centre)}", f"pos {written(centre)}"
        edits = set_inertial(model, body, each.mass, centre, each.about)
        says = f"{each.mass:.3g} kg lie {_off(each, each.centre):.2g} sizes of the body from the middle of its geoms; "
        says += f"with {'another sign' if _changed(each, centre) == 1 else 'other signs'} {_off(each, centre):.2g}."
        probe = Probe("centre of mass from the middle of the geoms", "sizes of the body", _far, (body,), dynamic=False)
        names = (of.name("body", body),)
        yield Suspect(names, "inertial", now, value, edits, probe, FAR, says, "below 0.4, or far with any sign")


def _far(of: Simulation, body: int) -> float:
    found = matter(of, body)
    return _off(found, found.centre) if found else 0.0


def _turned(found: Matter) -> Vector | None:
    """The centre of mass with the signs that bring it nearest to the geoms', where they bring it so much nearer."""
    far = _off(found, found.centre)
    ways = [tuple(s * x for s, x in zip(signs, found.centre, strict=True)) for signs in product((1, -1), repeat=3)]
    best = min(ways, key=lambda centre: _off(found, centre))
    return best if far > FAR and _off(found, best) < NEARER * far else None


def _changed(found: Matter, centre: Vector) -> int:
    return sum(a != b for a, b in zip(found.centre, centre, strict=True))


def _off(found: Matter, centre: Vector) -> float:
    """How far a place is from the centre of the geoms, in sizes of the box around them."""
    return math.dist(centre, found.solid_centre) / norm(found.half)
