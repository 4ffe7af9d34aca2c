"""A link's mass belongs neither to its inertia nor to the other links.

A mass that was typed wrongly, or taken from another link, stands beside an inertia that is right. The inertia over that
of the geoms then gives the mass that was meant, and with it the link is as dense as the others.

Bad:

    <mujoco>
      <default>
        <joint axis="0 1 0" damping="1" armature="0.1"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/>
      </default>
      <worldbody>
        <body pos="0 0 1">
          <joint/>
          <inertial pos="0.15 0 0" mass="2" diaginertia="0.0016 0.02 0.02"/>
          <geom/>
          <body pos="0.3 0 0">
            <joint/>
            <inertial pos="0.15 0 0" mass="12" diaginertia="0.0016 0.02 0.02"/>
            <geom/>
            <body pos="0.3 0 0">
              <joint/>
              <inertial pos="0.15 0 0" mass="2" diaginertia="0.0016 0.02 0.02"/>
              <geom/>
              <body pos="0.3 0 0">
                <joint/>
                <inertial pos="0.15 0 0" mass="2" diaginertia="0.0016 0.02 0.02"/>
                <geom/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <inertial pos="0.15 0 0" mass="12" diaginertia="0.0016 0.02 0.02"/>
    +         <inertial pos="0.15 0 0" mass="2" diaginertia="0.0016 0.02 0.02"/>

The number: the mass over that which its inertia asks for; more than 4. Much less is common in healthy arms, whose
inertias were identified. The mass so found makes it as dense as half of the others, within a factor of 2; there are
three others at least.

When it is wrong: a heavy motor in the middle of a light link.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import set_inertial
from clinic.diagnosis.probes.matter import explicit, mass_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, rounded

TITLE = "A mass that is not its inertia's"
FAMILIES = ("wrong-mass", "sags", "drifts")
AFLOAT = True
UNPLANTED = "what is planted in the mass alone other rules tell by its density"

TIMES, ALIKE, OTHERS = 4.0, 2.0, 3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Links whose inertia asks for the mass that the other links let expect."""
    found = [(body, each) for body, each in explicit(model) if each.volume > 0]
    for body, each in found:
        others = [other.density for index, other in found if index != body]
        times = 1 / each.radius**2 if each.radius > 0 else 1.0
        if len(others) < OTHERS or times < TIMES or each.even:
            continue
        usual = sorted(others)[len(others) // 2]
        if not usual / ALIKE < each.density / times < usual * ALIKE:
            continue
        meant = each.mass / times
        yield Suspect(
            (model.simulation.name("body", body),),
            "mass",
            f"{each.mass:.4g}",
            rounded(meant),
            set_inertial(model, body, meant, each.centre, each.about),
            mass_of(body),
            each.mass / TIMES,
            f"Its inertia is that of {meant:.2g} kg in its geoms, {usual:.3g} kg/m3 as in the other links; it has "
            f"{each.mass:.4g} kg.",
            "the mass of its inertia",
            level="hint",
        )
