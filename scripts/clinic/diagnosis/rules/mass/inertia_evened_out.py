"""`balanceinertia` hides an inertia that no body can have.

Each moment of a real body is at most the sum of the other two. MuJoCo refuses a file that breaks this, unless
`<compiler balanceinertia="true"/>` lets it read all three as their mean: a slip in one of them then spoils all.

Bad:

    <mujoco>
      <compiler balanceinertia="true"/>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <freejoint/>
          <inertial pos="0 0 0" mass="3.3" diaginertia="0.011 0.362 0.043"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 0 0" mass="3.3" diaginertia="0.011 0.362 0.043"/>
    +       <inertial pos="0 0 0" mass="3.3" diaginertia="0.011 0.0362 0.043"/>

The number: the largest moment over the sum of the others, told from 2 on. The edit takes decimal places off until it
fits, or writes the sum.

When it is wrong: this is a stopgap; the right numbers stand in the CAD model.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.inertia import DIAGONAL, inertial, possible
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "An impossible inertia that is evened out"
FAMILIES = ("wrong-mass", "oscillates")
UNPLANTED = "no healthy model has balanceinertia and moments of its own"

MOST = 2.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies whose moments were read as their mean, each with one that it could have."""
    compilers = model.source.elements("compiler") if model.source is not None else ()
    if not any(each.get("balanceinertia") == "true" for each in compilers):
        return
    for body in model.simulation.moving_bodies:
        held = inertial(model, body)
        if held is not None and model.urdf:
            held = held.first("inertia")
        if held is None or not (model.urdf or "diaginertia" in held.attributes):
            continue
        texts = [held.get(each) for each in DIAGONAL] if model.urdf else held.get("diaginertia").split()
        moments = [float(each or 0) for each in texts]
        largest = max(range(3), key=moments.__getitem__)
        rest = sum(moments) - moments[largest]
        if rest <= 0 or moments[largest] < MOST * rest:
            continue
        fitting = possible(moments)
        attribute = DIAGONAL[largest] if model.urdf else "diaginertia"
        value = f"{fitting[largest]:.4g}" if model.urdf else written(fitting)
        name = model.simulation.name("body", body)
        says = (
            f"{name} has a moment of {moments[largest]:.3g} kg m2, {moments[largest] / rest:.3g} times the sum of the "
            f"others, which no body can have; balanceinertia makes each {sum(moments) / 3:.3g}."
        )
        probe = counted("moments that no body can have", 1)
        edits = (set_attribute(held, attribute, value),)
        yield Suspect(
            (name,), attribute, held.get(attribute), value, edits, probe, 0, says, "at most their sum", level="hint"
        )
