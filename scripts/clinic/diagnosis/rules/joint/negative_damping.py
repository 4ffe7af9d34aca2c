"""A joint's damping or stiffness is negative.

Negative damping adds energy with each swing, and a negative spring pushes away from its rest.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="-0.05"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" damping="-0.05"/>
    +       <joint name="elbow" axis="0 1 0" damping="0.05"/>

The number: the most negative coefficient; 0 and more is well.

When it is wrong: a van der Pol oscillator, or a buckling spring.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Negative damping or stiffness"
FAMILIES = ("explodes", "oscillates", "drifts")

FIELDS = {"damping": "dof_damping", "stiffness": "jnt_stiffness"}
DOES = {"damping": "feeds the motion", "stiffness": "pushes away from its rest"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Joints with a negative coefficient."""
    simulation = model.simulation
    for attribute, field in FIELDS.items():
        found = {joint: value for joint, value in _values(simulation, field).items() if value < 0}
        if not found:
            continue
        edits = model.set_each("joint", attribute, {joint: f"{-value:g}" for joint, value in found.items()})
        first = next(iter(found.values()))
        yield Suspect(
            tuple(simulation.name("joint", each) for each in found),
            attribute,
            f"{first:g}",
            f"{-first:g}",
            edits,
            Probe(f"most negative {attribute} of a joint, without its sign", "", _most, (field,), dynamic=False),
            0.0,
            f"The {attribute} of {simulation.name('joint', next(iter(found)))} is {first:g}: it {DOES[attribute]}.",
            "0 and more",
        )


def _values(simulation: Simulation, field: str) -> dict[int, float]:
    values, joints = simulation.model(field), range(simulation.count("joint"))
    return {joint: values[simulation.dof(joint) if field.startswith("dof") else joint] for joint in joints}


def _most(simulation: Simulation, field: str) -> float:
    return max((-value for value in _values(simulation, field).values()), default=0.0)
