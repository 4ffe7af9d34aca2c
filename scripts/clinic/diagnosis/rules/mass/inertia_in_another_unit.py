"""The inertias of most bodies are a power of ten too large or too small.

Drawings have inertias in kg mm2, g cm2 or g mm2; MuJoCo takes what is written for kg m2. Servos then cannot move the
joints, or throw them about, and a single body looks no stranger than the others.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0.15 0 0" mass="1" diaginertia="200 7500 7500"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          <body name="fore" pos="0.3 0 0">
            <joint axis="0 1 0"/>
            <inertial pos="0.15 0 0" mass="1" diaginertia="200 7500 7500"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0.15 0 0" mass="1" diaginertia="200 7500 7500"/>
    +       <inertial pos="0.15 0 0" mass="1" diaginertia="0.0002 0.0075 0.0075"/>

    -         <inertial pos="0.15 0 0" mass="1" diaginertia="200 7500 7500"/>
    +         <inertial pos="0.15 0 0" mass="1" diaginertia="0.0002 0.0075 0.0075"/>

The number: the inertia of each body over that of its geoms, filled evenly with its mass. In healthy robots nearly all
lie between 0.1 and 10; told is a median beyond 300 or below 1/300, with most bodies within a factor of 30 of it.

When it is wrong: geoms that show little of the bodies.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import set_inertial
from clinic.diagnosis.probes.matter import explicit, joint_inertia
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "The inertias are in another unit"
FAMILIES = ("stuck", "explodes", "wrong-mass", "oscillates")
AFLOAT = True

TENS, WITHIN, LIMIT = 2.5, 1.5, 2.5  # powers of ten; times the inertia at the joint
FITS = 0.6  # of a power of ten: so near is it to that of a unit
UNITS = {3: "g m2", 6: "kg mm2", 7: "g cm2", 9: "g mm2", 4: "kg cm2"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All bodies with an `<inertial>`, where most of them are as far from their geoms."""
    found = explicit(model)
    powers = {body: 2 * math.log10(each.radius) for body, each in found}
    if len(found) < 2:
        return
    middle = sorted(powers.values())[len(found) // 2]
    alike = [(body, each) for body, each in found if abs(powers[body] - middle) < WITHIN]
    if abs(middle) < TENS or len(alike) < max(2, 0.6 * len(found)):
        return
    if 2 * sum(each.even for _, each in alike) > len(alike):  # placeholders, which have no unit
        return
    power = min((*UNITS, *(-each for each in UNITS)), key=lambda each: abs(each - middle))
    power = power if abs(power - middle) < FITS else round(middle)
    edits = tuple(
        edit
        for body, each in alike
        for edit in set_inertial(model, body, each.mass, each.centre, tuple(x / 10**power for x in each.about))
    )
    unit = f": as if they were {UNITS[power]}" if power in UNITS else ""
    yield Suspect(
        tuple(model.simulation.name("body", body) for body, _ in alike),
        "inertial",
        f"10^{power} times",
        f"1e{-power} times as much",
        edits,
        joint_inertia(*(body for body, _ in alike)),
        LIMIT,
        f"{len(alike)} of {len(found)} bodies have about 10^{middle:.1f} times the inertia of their geoms{unit}.",
        "kg m2",
        excess=10 ** abs(middle),
    )
