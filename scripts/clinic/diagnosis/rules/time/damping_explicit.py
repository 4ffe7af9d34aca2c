"""A joint's damping, or its servo's, is more than an explicit integrator can follow.

All integrators but `RK4` take a joint's damping implicitly: it may be as high as one likes. `Euler` with
`eulerdamp="disable"` does not. The `kv` of a servo is implicit with `implicit` and `implicitfast` alone, and with
`discrete` unless the solver is PGS. A damper that stops a light wheel within one step throws it back instead, farther
each time.

Bad:

    <mujoco>
      <option integrator="RK4"/>
      <worldbody>
        <body pos="0 0 0.5">
          <joint name="wheel" axis="0 1 0" damping="4" armature="0.002"/>
          <geom type="cylinder" size="0.05 0.01" mass="0.2" quat="0.7071068 0.7071068 0 0"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="wheel" ctrlrange="-10 10"/>
      </actuator>
    </mujoco>

Good:

    -   <option integrator="RK4"/>
    +   <option integrator="implicitfast"/>

The number: with the timestep h, the damping d and the inertia M, h d / M is at most 2.79 with RK4 and 2 with an
explicit Euler (stability of a damper), M as it is where the joints around give way; and whether a joint becomes faster
than 100 rad/s, or rattles, when the model is let go, nudged or driven. A joint's damping of more than 20 M / h is a
hint by itself, with any integrator, where there are equalities and a tenth of it, or less, keeps the model calm.

When it is wrong: an inertia or a damping that is itself the mistake.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.drive import commanded
from clinic.diagnosis.probes.run import FAST, fastest
from clinic.diagnosis.probes.servo import BEARS, COEFFICIENTS, damped_beyond, damping_is_implicit, explicit_damping
from clinic.diagnosis.probes.shake import SHAKES, shake
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Damping that the integrator cannot follow"
FAMILIES = ("explodes", "oscillates")
CASE = "finger-explodes-at-once"

TENTH = 0.1  # of the symptom is left
SYMPTOMS = ((fastest(), FAST), (shake(), SHAKES), (commanded(), FAST))
STOPS = 20.0  # h d / M of a joint that is at rest within a twentieth of a step


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The integrator, where it takes damping explicitly that the timestep does not bear."""
    of = model.simulation
    integrator, shares = int(of.model("opt.integrator")[0]), damped_beyond(of)
    edits = model.option("integrator", "implicitfast")
    if (damped := overdamped(model)) is not None:
        yield damped
    if not shares or not edits:
        return
    dof = max(shares, key=lambda each: shares[each])
    for probe, limit in SYMPTOMS:
        before = model.measured(probe)
        if before > limit and model.measured(probe, edits) <= max(limit, TENTH * before):
            name = of.name("joint", of.dof_joints[dof])
            damping, share = explicit_damping(of)[dof], shares[dof]
            _, damps, mass = COEFFICIENTS[of.unit(of.dof_joints[dof])]
            inertia = f"{of.timestep * damping / share:.2g} {mass}"
            says = (
                f"At {name}: explicit damping {damping:.3g} {damps} on an inertia of {inertia}, with the joints around "
            )
            says += f"it free; timestep x damping / inertia is {share:.3g}."
            well = f"timestep x damping / inertia < {BEARS[integrator]:g}"
            now = "RK4" if integrator else "Euler" if damping_is_implicit(of) else "Euler without eulerdamp"
            yield Suspect(
                ("the integrator", name),
                "integrator",
                now,
                "implicitfast",
                edits,
                probe,
                limit,
                says,
                well,
                TENTH,
                level="cause" if integrator else "hint",  # under Euler it is as much the servo's gain
            )
            return


def overdamped(model: ReaderModel) -> Suspect | None:
    """Damping of joints that equalities tie, which stops them within a small part of a step, where less keeps calm."""
    of = model.simulation
    damping, masses = of.model("dof_damping"), of.mass_diagonal
    dofs = {joint: of.dof(joint) for joint in of.scalar_joints}
    shares = {joint: of.timestep * damping[dof] / max(masses[dof], 1e-12) for joint, dof in dofs.items()}
    found = sorted((joint for joint, share in shares.items() if share > STOPS), key=lambda joint: -shares[joint])
    shown = [(probe, limit) for probe, limit in SYMPTOMS if found and model.measured(probe) > limit]
    if not shown or not of.count("equality"):
        return None
    (probe, limit), now = shown[0], damping[dofs[found[0]]]
    for less in (10, 100, 1000):
        edits = model.set_each("joint", "damping", {each: f"{damping[dofs[each]] / less:.3g}" for each in found})
        if edits and model.measured(probe, edits) <= min(limit, TENTH * model.measured(probe)):
            names = tuple(of.name("joint", joint) for joint in found)
            _, damps, mass = COEFFICIENTS[of.unit(found[0])]
            inertia = f"{masses[dofs[found[0]]]:.2g} {mass}"
            says = f"At {names[0]}: damping {now:.3g} {damps} on an inertia of {inertia}; timestep x damping / inertia "
            says += f"is {shares[found[0]]:.3g}, beside equalities that cannot hold against it."
            value, well = f"{now / less:.3g}", f"timestep x damping / inertia < {STOPS:g}"
            return Suspect(names, "damping", f"{now:g}", value, edits, probe, limit, says, well, TENTH, level="hint")
    return None
