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

The number: the steps for a second, more than 50,000; and a timestep that is not above 0, which MuJoCo takes as it is.
The shortest timestep of 568 healthy models is 0.0001 s: 10,000 steps.

When it is wrong: very stiff and very small things, such as the wing of a fly.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A timestep that is too short"
FAMILIES = ("slow", "stuck")
UNPLANTED = "it does no harm but to patience"

MANY, USUAL = 50_000, "0.002"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The timestep, where a second takes too many, or none."""
    of, written = model.simulation, f"{model.simulation.timestep:g}"
    if _still(of):
        probe, most = how_many("timesteps that are not above 0", _still), 0
        says = "Time stands still, or runs backwards."
    elif _steps(of) > MANY:
        probe, most = Probe("steps for a second", "", _steps, dynamic=False), MANY
        says = f"One second takes {_steps(of):.3g} steps."
    else:
        return
    edits, usual = model.option("timestep", USUAL), "500 steps a second, with 0.002 s"
    yield Suspect(("timestep",), "timestep", written, USUAL, edits, probe, most, says, usual, level="hint")


def _steps(of: Simulation) -> float:
    return 1 / of.timestep


def _still(of: Simulation) -> list[float]:
    return [of.timestep] if of.timestep <= 0 else []
