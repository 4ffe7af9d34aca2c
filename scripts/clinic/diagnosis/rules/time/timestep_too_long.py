"""The timestep is too long for the fastest motion of the model.

An explicit integrator diverges where a spring, a contact or a gain moves something within a few steps. A model that
is well at a shorter timestep, and explodes or rattles at its own, has no other fault.

Bad:

    <mujoco>
      <option timestep="0.01"/>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0" stiffness="2000" springref="2"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01" mass="0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <option timestep="0.0005"/>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0" stiffness="2000" springref="2"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01" mass="0.05"/>
        </body>
      </worldbody>
    </mujoco>

The number: the fastest joint within 2 s after letting go; 100 rad/s are 16 turns a second. Of the steps that are
tried (a half, a quarter, an eighth, a sixteenth) the longest that brings it to a tenth is told.

When it is wrong: something that is meant to spin fast.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.run import fastest
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "The timestep is too long"
FAMILIES = ("explodes", "oscillates", "falls-through")
SINCE = "0.2"

FAST = 100.0  # rad/s


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The timestep, where letting go makes something fast."""
    step, probe = model.simulation.timestep, fastest()
    if model.measured(probe) <= FAST:
        return
    for divisor in (2, 4, 8, 16):
        edits = model.option("timestep", f"{step / divisor:g}")
        if model.measured(probe, edits) <= min(FAST, 0.1 * model.measured(probe)):
            says = f"At {step / divisor:g} s the same motion stays calm."
            yield Suspect(
                ("the timestep",), "timestep", f"{step:g}", f"{step / divisor:g}", edits, probe, FAST, says, share=0.1
            )
            return
