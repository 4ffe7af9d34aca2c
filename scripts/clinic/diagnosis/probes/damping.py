"""Damping that the integrator takes explicitly, against what the timestep bears."""

from __future__ import annotations

from typing import NamedTuple

from clinic.diagnosis.probes.servo import feedback
from clinic.diagnosis.simulation import Simulation

BEARS = {0: 2.0, 1: 2.79}  # h d / M, by mjtIntegrator: Euler, RK4
EULERDAMP_OFF = 1 << 15  # mjtDisableBit


class Damped(NamedTuple):
    """A degree of freedom whose damping is explicit: in N m s/rad and kg m2, or N s/m and kg.

    `bears` is the most of h d / M for which a damper is stable, and `share` how many times that it is.
    """

    damping: float
    inertia: float
    bears: float
    share: float
    integrator: str


def explicit_damping(of: Simulation, *, servos: bool = True) -> dict[int, Damped]:
    """What the integrator does not take implicitly, by degree of freedom: damping of joints, and that of servos."""
    integrator, inertia = int(of.model("opt.integrator")[0]), of.mass_diagonal
    if integrator not in BEARS:
        return {}
    implicit = not integrator and not int(of.model("opt.disableflags")[0]) & EULERDAMP_OFF
    called = "RK4" if integrator else "Euler" if implicit else "Euler without eulerdamp"
    damping = [0.0 if implicit else each for each in of.model("dof_damping")]
    for joint, (_, kv) in feedback(of).items() if servos else ():
        damping[of.dof(joint)] += kv
    bears = BEARS[integrator]
    return {
        dof: Damped(each, inertia[dof], bears, of.timestep * each / max(inertia[dof], 1e-12) / bears, called)
        for dof, each in enumerate(damping)
    }
