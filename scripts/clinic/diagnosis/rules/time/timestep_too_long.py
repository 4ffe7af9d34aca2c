"""The timestep is too long for the fastest motion of the model.

An explicit integrator diverges where a spring or a gain swings something to and fro within a few steps. A model that is
well at a shorter timestep, and explodes or rattles at its own, may have no other fault.

Bad:

    <mujoco>
      <option timestep="0.02"/>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01" mass="0.3"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="hinge" kp="100" kv="2"/>
      </actuator>
    </mujoco>

Good:

    -   <option timestep="0.02"/>
    +   <option timestep="0.002"/>

The number: the fastest joint within 2 s after letting go, above 100 rad/s (16 turns a second). Where that is calm, how
much a joint's speed jumps to and fro from step to step after a nudge, how fast it gets under command, and how deep
contacts are.

A half, a quarter, an eighth and a sixteenth of the step are tried. The longest that leaves a tenth of that number, or a
third of a depth under command, is told. Where 95 % of the step is enough, nothing is told: a cable that whips about
explodes at one step and not at the next, by chance. What goes to infinity is told all the same where a quarter of the
step leaves less than a tenth of what 95 % of it does. A run under command that does not last the 2 s proves nothing,
for its later part is not seen.

There is only a hint under command at a step of 2 ms or less, for a gain may as well be the fault; for a spring that
swings within 6 steps, where a tenth of the step takes its joint elsewhere by more than 15 % of its range (in 260
healthy models a period has 10 steps and more); and for a step above 0.04 s, however calm (of 290 healthy models none
has more than 0.03 s). Nothing is told where a tendon starts far outside of its range, which another rule tells.

When it is wrong: something that is meant to spin fast. A gain or a spring that shakes at 2 ms too is the fault itself.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import DEFAULT_TIMESTEP
from clinic.diagnosis.probes.drive import commanded, pressed_in
from clinic.diagnosis.probes.run import FAST, fastest, sunk
from clinic.diagnosis.probes.shake import SHAKES, shake
from clinic.diagnosis.probes.solver import patient
from clinic.diagnosis.probes.springs import coarse, strays
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.joint.tendon_outside_range import far_outside
from clinic.diagnosis.rules.time.damping_explicit import overdamped
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Probe, Suspect

TITLE = "The timestep is too long"
FAMILIES = ("explodes", "oscillates", "falls-through")

SECONDS, WHOLE = 2.0, 0.9  # what is run, and the share of it that a run with a shorter step has to last
SUNK, PRESSED = 0.05, 0.035  # of the model's extent
UNUSUAL = 0.04  # s, which no healthy model has
STRAYS, FINE = 0.15, 10  # of a spring's range, from where a tenth of the step takes it
CHANCE = 0.95  # of the step: what is well at that is no matter of its length
TENTH, THIRD, HALF = 0.1, 1 / 3, 0.5  # what is left of a symptom that is gone; contacts are never without depth


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The timestep, where letting go makes something fast, or a nudge makes it rattle."""
    of, step = model.simulation, model.simulation.timestep
    if far_outside(of) or overdamped(model):
        return
    for probe, limit, share in (
        (fastest(), FAST, TENTH),
        (shake(), SHAKES, TENTH),
        (commanded(), FAST, TENTH),
        (sunk(), SUNK, TENTH),
        (pressed_in(), PRESSED, THIRD),
    ):
        before = model.measured(probe)
        if before <= limit:
            continue
        near = model.measured(probe, model.option("timestep", f"{CHANCE * step:g}")) if step <= UNUSUAL else math.inf
        quarter = model.option("timestep", f"{step / 4:g}")
        if near <= limit and (math.isfinite(before) or model.measured(probe, quarter) >= TENTH * near):
            continue
        edits = patient(model)
        if edits and math.isfinite(after := model.measured(probe, edits)) and after <= HALF * before:
            return  # the solver stops too early, which another rule tells
        for divisor in (2, 4, 8, 16):
            driven = probe == pressed_in() or (probe == commanded() and math.isfinite(before))
            if driven and of.steps(divisor * SECONDS) < WHOLE * divisor * of.steps(SECONDS):
                break  # a run cut short may be calm because nothing has been touched yet; what explodes does so early
            edits = model.option("timestep", f"{step / divisor:g}")
            if model.measured(probe, edits) <= min(limit, share * before):
                says = f"At {step / divisor:g} s the same motion stays calm."
                now, value = f"{step:g}", f"{step / divisor:g}"
                level: Level = "hint" if probe in (commanded(), pressed_in()) and step <= DEFAULT_TIMESTEP else "cause"
                yield Suspect(
                    ("the timestep",), "timestep", now, value, edits, probe, limit, says, share=share, level=level
                )
                return
    if coarse(of) and (before := model.measured(strays())) > STRAYS:
        joint, steps = min(coarse(of).items(), key=lambda each: each[1])
        edits = model.option("timestep", f"{step / FINE:g}")
        says = f"The spring of {of.name('joint', joint)} swings within {steps:.2g} steps, too few to follow it."
        now, value = f"{step:g}", f"{step / FINE:g}"
        healthy = "10 steps and more in 260 healthy models"
        told = Suspect(("the timestep",), "timestep", now, value, edits, strays(), STRAYS, says, healthy, level="hint")
        if model.measured(strays(), edits) <= THIRD * before:
            yield told
            return
    if step > UNUSUAL:
        edits = model.option("timestep", "0.002")
        says = (
            f"At 1 m/s a thing gets on by {1000 * step:.0f} mm in a step of {step:g} s before a contact is looked for."
        )
        probe = Probe("timestep", "s", _timestep, dynamic=False)
        healthy = "0.0001 to 0.03 s in 290 healthy models"
        elements = ("the timestep",)
        yield Suspect(elements, "timestep", f"{step:g}", "0.002", edits, probe, UNUSUAL, says, healthy, level="hint")


def _timestep(of: Simulation) -> float:
    return of.timestep
