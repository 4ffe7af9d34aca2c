"""An inertia that would need a body larger than the whole model.

`diaginertia="1 1 1"` for a frame of a gram: so spread, its mass would lie tens of metres away. The joint becomes
sluggish beyond all motors, or the solver badly conditioned.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint axis="0 1 0" damping="1"/>
          <inertial pos="0 0 0" mass="0.001" diaginertia="1 1 1"/>
          <body pos="0.3 0 0">
            <joint axis="0 1 0" damping="1"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 0 0" mass="0.001" diaginertia="1 1 1"/>
    +       <inertial pos="0 0 0" mass="0.001" diaginertia="1e-6 1e-6 1e-6"/>

The number: the radius of gyration, the root of inertia over mass, over the size of the model, `stat.extent`; more than
2 is told. In 81 healthy models the most is 0.67, but for a link of 11.7 g in two copies of an arm, whose inertia is
that of a rod of metres: 2.2 and 2.5.

When it is wrong: a rotor that is geared up, whose inertia is written at the slow side: `armature` is meant for that.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.inertia import inertial, tensor
from clinic.diagnosis.probes.matter import turns
from clinic.diagnosis.probes.vector import dot, times, turned
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An inertia larger than the whole model"
FAMILIES = ("wrong-mass", "stuck", "explodes", "wrong-numbers")
UNPLANTED = "the kinds of wrong inertias are planted in bodies with geoms, of which other rules tell"
MOST, FELT = 2.0, 0.01  # of the inertia at a joint
USUAL = 0.1  # of the model's size, which the edit gives


def _over(simulation: Simulation, *bodies: int) -> float:
    masses, size = simulation.model("body_mass"), max(simulation.extent, 1e-6)
    spread = (max(simulation.row("body_inertia", body, 3)) / max(masses[body], 1e-12) for body in bodies)
    return math.sqrt(max(spread, default=0.0)) / size


def _felt(simulation: Simulation, bodies: Sequence[int]) -> float:
    """The largest share that some bodies' own inertia has of what a joint turns."""
    whole, own = simulation.mass_diagonal, dict[int, float]()
    simulation.begin()
    for body in bodies:
        about = turned(simulation.data_row("xmat", body, 9), tensor(simulation, body))
        for above in simulation.ancestors(body)[:-1]:
            for dof, axis in (each for joint in simulation.joints_of(above) for each in turns(simulation, joint)):
                own[dof] = own.get(dof, 0.0) + dot(axis, times(about, axis))
    return max((inertia / whole[dof] for dof, inertia in own.items() if whole[dof] > 0), default=0.0)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Moving bodies with an `<inertial>` of such an inertia, all together."""
    of = model.simulation
    found = [body for body in of.moving_bodies if _over(of, body) > MOST and inertial(model, body) is not None]
    if not found or _felt(of, found) < FELT:
        return
    size, edits = of.extent, []
    for body in found:
        element = inertial(model, body)
        if element is not None and "diaginertia" in element.attributes:
            small = f"{of.model('body_mass')[body] * (USUAL * size) ** 2:.2g}"
            edits.append(set_attribute(element, "diaginertia", " ".join([small] * 3)))
    worst = max(found, key=lambda body: _over(of, body))
    now = " ".join(f"{each:g}" for each in of.row("body_inertia", worst, 3))
    says = f"Its radius of gyration is {_over(of, worst):.3g} times the size of the whole model, {size:.3g} m."
    probe = Probe("radius of gyration over the size of the model", "", _over, tuple(found), dynamic=False)
    yield Suspect(
        tuple(of.name("body", body) for body in found),
        "diaginertia",
        now,
        edits[0].value if edits else "that of a body of its size",
        tuple(edits),
        probe,
        MOST,
        says,
        "0.67 is the most of 79 healthy models",
        level="hint",
    )
