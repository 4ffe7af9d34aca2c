"""A gain too high for an inertia that has no armature.

The rotor of a motor, seen through its gear, is most of the inertia of a small joint; `armature` is that. Without it a
usual gain moves a light link further than its target within one step, and the joint shakes or the simulation ends.

Bad:

    <mujoco>
      <worldbody>
        <body>
          <joint name="wrist" axis="0 0 1"/>
          <geom type="capsule" fromto="0 0 0 0.03 0 0" size="0.01" mass="0.02"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="wrist" kp="200" kv="20"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="wrist" axis="0 0 1"/>
    +       <joint name="wrist" axis="0 0 1" armature="0.1"/>

The number: with the timestep h and the inertia M a velocity gain is stable below h kv / M = 2, a position gain below
h^2 kp / M = 4 (with Euler; RK4 bears 2.7 and 7.9). A velocity gain that is integrated implicitly has no such limit, and
adds h kv / 2 to M. A model that keeps these at 2 ms, and not at its own timestep, has a timestep that is too long, but
where one joint is ten times as far beyond as the others. Where no gain is the reason and something is faster than 100
rad/s, driven joints below 0.01 kg m2 are told, but for those that carry no geom.

When it is wrong: a gain that is a hundred times too high shakes as well; then the gain is the fault.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import DEFAULT_TIMESTEP, IMPLICIT, IMPLICITFAST
from clinic.diagnosis.probes.drive import commanded
from clinic.diagnosis.probes.matter import explicit
from clinic.diagnosis.probes.run import FAST, fastest
from clinic.diagnosis.probes.servo import COEFFICIENTS, damped_beyond, feedback
from clinic.diagnosis.probes.shake import SHAKES, shake
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A gain too high for a joint without armature"
FAMILIES = ("explodes", "oscillates")
CASE = "hand-shakes-at-once"

NEAR = 0.5  # of what one joint alone bears: in a chain it is less
ROTOR = 0.01  # kg m2 at the joint, of a motor behind its gear
ABSURD = 30.0  # h d / M: ten times what RK4 bears, and no damping of that inertia


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Joints whose gains are beyond what the inertia allows, all together."""
    simulation = model.simulation
    step = simulation.timestep
    thin = {body for body, each in explicit(model) if each.absurd and each.radius < 1}  # the inertia is the fault
    bodies = simulation.model("jnt_bodyid")
    gains = {joint: each for joint, each in _gains(simulation).items() if bodies[joint] not in thin}
    found = {joint: each for joint, each in gains.items() if _excess(each, min(step, DEFAULT_TIMESTEP)) > NEAR}
    if not found and len(gains) > 1 and step <= 5 * DEFAULT_TIMESTEP:
        usual = sorted(_excess(each, step) for each in gains.values())[(len(gains) - 1) // 2]
        found = {joint: each for joint, each in gains.items() if _excess(each, step) > max(NEAR, 10 * usual)}
    if not found:
        yield from _bare(model, thin)
        return
    edits: list[Edit] = []
    for joint, (kp, kv, inertia, _) in found.items():
        value = max(step * kv / 0.5, step**2 * kp / 0.1) - inertia
        edits += model.set("joint", [joint], "armature", f"{value:.1g}")
    joint, worst = max(found.items(), key=lambda each: _excess(each[1], step))
    kp, kv, inertia, _ = worst
    probe = _symptom(model) or shake()
    stiff, damps, mass = COEFFICIENTS[simulation.unit(joint)]
    yield Suspect(
        tuple(simulation.name("joint", each) for each in found),
        "armature",
        f"{simulation.model('dof_armature')[simulation.dof(joint)]:.2g}",
        next((each.value for each in edits), ""),
        tuple(edits),
        probe,
        SHAKES if probe == shake() else FAST,
        f"At {simulation.name('joint', joint)}: kv {kv:.3g} {damps} and kp {kp:.3g} {stiff} on an inertia of "
        f"{inertia:.2g} {mass}: timestep x kv / inertia is {step * kv / inertia:.3g}, and timestep^2 x kp / inertia "
        f"{step**2 * kp / inertia:.3g}.",
        "timestep x kv / inertia < 2, timestep^2 x kp / inertia < 4 (explicit integration)",
        share=0.1,
        excess=_excess(worst, step),
    )


def _bare(model: ReaderModel, thin: Collection[int]) -> Iterator[Suspect]:
    """Driven joints of light links without armature, where something gets too fast and no gain is the reason."""
    of, inertia = model.simulation, model.simulation.mass_diagonal
    bare = [joint for joint in of.drivers if of.model("dof_armature")[of.dof(joint)] == 0]
    bodies = of.model("jnt_bodyid")
    shown = {above for body in of.model("geom_bodyid") for above in of.ancestors(int(body))}
    bare = [joint for joint in bare if bodies[joint] not in thin and int(bodies[joint]) in shown]
    light = sorted(joint for joint in bare if inertia[of.dof(joint)] < ROTOR and not of.model("jnt_stiffness")[joint])
    shares = damped_beyond(of)
    if any(0 < shares.get(of.dof(joint), 0.0) < ABSURD for joint in light):
        return  # the integrator is the fault
    probe = _symptom(model)
    bounded = probe == commanded() and math.isfinite(model.measured(probe))
    if bounded:  # so fast may a wheel be, and a propeller
        light = [joint for joint in light if joint in of.ranges]
    if not light or probe is None or of.timestep > 5 * DEFAULT_TIMESTEP:
        return
    least = min(light, key=lambda joint: inertia[of.dof(joint)])
    few = f"{inertia[of.dof(least)]:.2g} {COEFFICIENTS[of.unit(least)][2]}"
    yield Suspect(
        tuple(of.name("joint", joint) for joint in light),
        "armature",
        "0",
        f"{ROTOR:g}",
        model.set("joint", light, "armature", f"{ROTOR:g}"),
        probe,
        FAST,
        f"{of.name('joint', least)} is driven, has no armature and an inertia of {few}: less than the rotor of a motor "
        "behind its gear has.",
        "0.01 kg m2 and more for the joint of a walking robot",
        share=0.1,
        excess=2.0,
        level="hint" if bounded else "cause",
    )


def _symptom(model: ReaderModel) -> Probe | None:
    """Where it shows first: let go, after a nudge, or under command."""
    return next((each for each in (fastest(), shake(), commanded()) if model.measured(each) > FAST), None)


def _gains(simulation: Simulation) -> dict[int, tuple[float, float, float, float]]:
    """Position gain, velocity gain where it is explicit, inertia, and velocity gain where it is implicit, by joint."""
    made: dict[int, tuple[float, float, float, float]] = {}
    implicit = int(simulation.model("opt.integrator")[0]) in (IMPLICIT, IMPLICITFAST)
    for joint, (kp, kv) in feedback(simulation).items():
        inertia = max(simulation.mass_diagonal[simulation.dof(joint)], 1e-12)
        made[joint] = (kp, kv * (not implicit), inertia, kv * implicit)
    return made


def _excess(gains: tuple[float, float, float, float], step: float) -> float:
    kp, kv, inertia, held = gains
    return max(step * kv / inertia / 2, step**2 * kp / (inertia + step * held / 2) / 2)
