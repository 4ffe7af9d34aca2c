"""What is let go gains energy from the integrator: the timestep is too long for how it tumbles.

Nothing drives it, and it gets faster from swing to swing, until MuJoCo warns of `Nan, Inf or huge value in QACC`, often
after half a minute and more. Euler's method takes the forces of a fast turn from the step before.

Bad:

    <mujoco>
      <option timestep="0.02"/>
      <worldbody>
        <body name="upper" pos="1 0 5">
          <joint type="hinge" axis="0 1 0" pos="-1 0 0"/>
          <geom type="box" size="1 0.1 0.1" mass="2"/>
          <body name="lower" pos="1 1 0" euler="0 0 90">
            <joint type="ball" pos="-1 0 0"/>
            <geom type="box" size="1 0.1 0.1" mass="2"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <option timestep="0.02"/>
    +   <option timestep="0.02" integrator="RK4"/>

The number: without contacts, actuators and springs, the most by which kinetic and potential energy together exceed what
there was at the start, over the most kinetic energy, in 2 s after letting go (less for a large model, or a very short
timestep); more than 0.08, where a quarter of the timestep brings it below half of that.

When it is wrong: a start that is unstable for another reason.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import ENERGY_ON, RK4
from clinic.diagnosis.probes.run import resets
from clinic.diagnosis.probes.servo import alone
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "Energy from nowhere"
FAMILIES = ("explodes", "oscillates")
UNPLANTED = "a timestep that is too long is planted for timestep-too-long"

GAIN, SHARE = 0.08, 0.5
TIME = 2.0  # s


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The integrator, where a shorter timestep takes the energy away."""
    of = model.simulation
    probe = Probe("energy gained without a drive", "of the most kinetic energy", _gained)
    if int(of.model("opt.integrator")[0]) == RK4 or model.measured(resets()) or model.measured(probe) <= GAIN:
        return
    shorter = model.option("timestep", rounded(of.timestep / 4))
    gained = model.measured(probe)
    if not shorter or model.measured(probe, shorter) > SHARE * gained:
        return
    says = f"At a timestep of {of.timestep:g} s what is let go gains {100 * gained:.2g} % of its kinetic energy in 2 s."
    edits = model.option("integrator", "RK4")
    yield Suspect(("the integrator",), "integrator", "", "RK4", edits, probe, GAIN, says, "no gain", share=SHARE)


def _gained(of: Simulation) -> float:
    """The most energy beyond that of the start, as a share of the most kinetic energy, in 2 s."""
    flags = of.model("opt.enableflags")[0]
    of.engine.write_model("opt.enableflags", [int(flags) | ENERGY_ON])
    try:
        of.begin()
        with alone(of, gravity=True, limp=True):
            of.engine.forward()
            begun, gained, moving = sum(of.data("energy")), 0.0, 1e-9
            for _ in range(of.steps(TIME)):
                of.engine.step()
                potential, kinetic = of.data("energy")
                gained, moving = max(gained, potential + kinetic - begun), max(moving, kinetic)
    finally:
        of.engine.write_model("opt.enableflags", [flags])
    return gained / moving
