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

The number: the fastest joint within 2 s after letting go (100 rad/s are 16 turns a second), or, where that is calm, how
much a joint's speed jumps to and fro from step to step after a nudge. Of the steps that are tried (a half, a quarter,
an eighth, a sixteenth) the longest that brings it to a tenth is told.

When it is wrong: something that is meant to spin fast. A gain or a spring that shakes at 2 ms too is the fault itself.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.drive import commanded
from clinic.diagnosis.probes.run import fastest, sunk
from clinic.diagnosis.probes.shake import SHAKES, shake
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "The timestep is too long"
FAMILIES = ("explodes", "oscillates", "falls-through")
SINCE = "0.2"
LEVEL = "hint"

FAST = 100.0  # rad/s
SUNK = 0.05  # of the model's extent


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The timestep, where letting go makes something fast, or a nudge makes it rattle."""
    step = model.simulation.timestep
    for probe, limit in ((fastest(), FAST), (shake(), SHAKES), (commanded(), FAST), (sunk(), SUNK)):
        before = model.measured(probe)
        if before <= limit:
            continue
        for divisor in (2, 4, 8, 16, 32, 64):
            edits = model.option("timestep", f"{step / divisor:g}")
            if model.measured(probe, edits) <= min(limit, 0.1 * before):
                says = f"At {step / divisor:g} s the same motion stays calm."
                now, value = f"{step:g}", f"{step / divisor:g}"
                yield Suspect(("the timestep",), "timestep", now, value, edits, probe, limit, says, share=0.1)
                return
