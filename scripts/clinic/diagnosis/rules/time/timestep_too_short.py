"""The timestep is so short that a second takes more than 50,000 steps.

`timestep` is in seconds, and 0.002 is usual. With a value in another unit, or with some zeros too many, the same
movement takes many times as many steps, here 1000 times, and nothing seems to move.

Bad:

    <mujoco>
      <option timestep="0.000002"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1" mass="2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <option timestep="0.000002"/>
    +   <option timestep="0.002"/>

The number: the steps for a second; more than 50,000. The shortest timestep of 568 healthy models is 0.0001 s: 10,000.

When it is wrong: very stiff and very small things, such as the wing of a fly.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A timestep that is too short"
FAMILIES = ("slow", "stuck")
UNPLANTED = "it does no harm but to patience"

MANY, USUAL = 50_000, "0.002"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The timestep, where a second takes too many."""
    of = model.simulation
    if _steps(of) > MANY:
        edits = model.option("timestep", USUAL)
        probe = Probe("steps for a second", "", _steps, dynamic=False)
        says = f"One second takes {_steps(of):.3g} steps."
        now = f"{of.timestep:g}"
        yield Suspect(("timestep",), "timestep", now, USUAL, edits, probe, MANY, says, "500 with 0.002 s", level="hint")


def _steps(of: Simulation) -> float:
    return 1 / of.timestep
