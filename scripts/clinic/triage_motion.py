"""Triage, steps 1, 4 and 5: MuJoCo's warnings, conservation, and half the timestep."""

from __future__ import annotations

import copy

import mujoco
import numpy as np

from clinic.triage_run import Array, Recording, Subject, apart, record, scale
from clinic.triage_text import shown
from clinic.triage_watch import Trial, Watch

Look = tuple[str, list[tuple[str, str, str]]]
FAST = 1000.0
"""A degree of freedom faster than this, in rad/s or m/s, is unusual."""
SHARE = 0.05
"""A drift of more than this share is unusual."""
NUDGE = 1e-9
"""How far every velocity is changed to see whether a motion is chaotic, in rad/s or m/s."""
FREED = ("CONSTRAINT", "DAMPER", "ACTUATION")


def warnings(trial: Trial) -> Look:
    """What MuJoCo warns of, how often time goes back, and whether numbers stay finite and moderate."""
    s = trial.subject
    run, watch = trial.base
    found = [
        ("warned", name, next((t for t in run.messages), f"raised {count} times"))
        for name, count in run.warnings.items()
    ]
    if run.resets:
        found.append(("reset", "data.time", f"goes back on {run.resets} of {run.steps} steps: the state is reset"))
    if not run.finite:
        found.append(("finite", "state", f"is no longer finite after {shown(run.time, 's')}"))
    if watch.fastest[0] > FAST:
        joint = s.called("joint", int(s.model.dof_jntid[watch.fastest[1]]))
        found.append(("fast", joint, f"reaches {shown(watch.fastest[0], 'rad/s or m/s')}"))
    return _covered("no warning" if not run.warnings else "warnings", run), found


def conservation(trial: Trial) -> Look:
    """Whether energy appears in the run as it is, drifts with all that may take it away removed, or momentum changes."""
    s = trial.subject
    run, watch = trial.base
    if s.model.nv == 0:
        return "nothing moves", []
    found, said = [], []
    gained = gain(watch)
    if gained is not None:
        said.append("energy never exceeds what was put in" if gained <= SHARE else "energy appears")
        if gained > SHARE:
            found.append(("gain", "energy", f"{100 * gained:.0f} % more than actuators put in"))
    drifted = drift(trial)
    if drifted is not None:
        said.append(f"freed of contacts, limits, dampers and actuators it drifts by {shown(100 * drifted, '%', 2)}")
        if not drifted <= SHARE:
            found.append(("drift", "energy", f"drifts by {shown(100 * drifted, '%', 2)} where it should stay"))
    for tree, share in flying(s, watch):
        if share > SHARE:
            body = s.called("body", int(s.model.tree_bodyadr[tree]))
            found.append(("momentum", body, f"flies free, yet its momentum is off by {shown(100 * share, '%', 2)}"))
    return "; ".join(said) or "nothing to compare", found


def halved(trial: Trial) -> Look:
    """Whether the outcome changes with half the timestep, or a twentieth of it."""
    s, (base, _) = trial.subject, trial.base
    found, said = [], []
    size = scale(s, base)
    wild = _run(trial, 1, nudge=True)
    chaos = _gap(base, wild) / size
    for finer, name in ((2, "half"), (20, "a twentieth")):
        run = _run(trial, finer)
        if not run.points.size:
            continue
        if run.warnings.keys() != base.warnings.keys() or run.finite != base.finite:
            now = ", ".join(run.warnings) or "none"
            found.append(
                (name, "warnings", f"at {name} of the timestep: {now}, before: {', '.join(base.warnings) or 'none'}")
            )
            continue
        gap = _gap(base, run) / size
        if gap > SHARE and chaos < 0.5 * gap:
            found.append((name, "motion", f"at {name} of the timestep up to {shown(gap * size, 'm')} elsewhere"))
        said.append(f"{name}: {shown(100 * gap, '%', 2)} of {shown(size, 'm')}")
    if chaos > SHARE:
        said.append(f"chaotic: a change of {NUDGE:g} at the start gives {shown(100 * chaos, '%', 2)}")
    return "; ".join(said) or "not enough time for it", found


def gain(watch: Watch) -> float | None:
    """The energy that nobody supplied, as a share of the energy in play; None where there is none in play."""
    energies = watch.energies
    if len(energies) < 2 or not np.isfinite(energies).all():
        return None
    total = energies.sum(axis=1)
    play = float(energies[:, 1].max() + np.ptp(energies[:, 0]))
    with np.errstate(all="ignore"):
        surplus = float(np.max(total - total[0] - watch.supplied))
    return surplus / play if play > 1e-9 and np.isfinite(surplus) else None


def drift(trial: Trial) -> float | None:
    """How far energy drifts, as a share of the largest kinetic energy, with nothing left that may change it.

    Contacts, limits, equalities, friction, dampers, fluids, actuators and gravity compensation are taken away. None
    where nothing moves then; infinite where the run explodes.
    """
    s = trial.subject
    model = copy.copy(s.model)
    for name in FREED:
        model.opt.disableflags |= getattr(mujoco.mjtDisableBit, f"mjDSBL_{name}")
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    model.opt.density = model.opt.viscosity = 0.0
    model.body_gravcomp[:] = 0
    energies: list[tuple[float, float]] = []
    run = record(
        s, model, trial.budget.part(0.2), watch=lambda _, data: energies.append((data.energy[0], data.energy[1]))
    )
    if not run.finite or run.resets or run.warnings:
        return float("inf")
    values: Array = np.array(energies)
    kinetic = float(values[:, 1].max())
    return float(np.ptp(values.sum(axis=1))) / kinetic if kinetic > 1e-9 else None


def flying(s: Subject, watch: Watch) -> list[tuple[int, float]]:
    """Each tree on a free joint that never touched anything, and how far its momentum is from a free fall's, as a share."""
    m = s.model
    if (
        m.neq
        or m.ntendon
        or m.nflex
        or m.opt.density
        or m.opt.viscosity
        or m.body_gravcomp.any()
        or not len(watch.momenta)
    ):
        return []
    touched = {int(m.body_treeid[m.geom_bodyid[g]]) for pair in watch.touched for g in pair if g >= 0}
    made = []
    times = np.arange(len(watch.momenta)) * m.opt.timestep
    for tree in range(m.ntree):
        body = int(m.tree_bodyadr[tree])
        free = m.body_jntnum[body] == 1 and m.jnt_type[m.body_jntadr[body]] == mujoco.mjtJoint.mjJNT_FREE
        if free and tree not in touched:
            momentum = watch.momenta[:, tree]
            fall = momentum[0] + m.body_subtreemass[body] * times[:, None] * m.opt.gravity
            largest = float(np.linalg.norm(momentum, axis=1).max())
            if largest > 0 and np.isfinite(momentum).all():
                made.append((tree, float(np.linalg.norm(momentum - fall, axis=1).max()) / largest))
    return made


def _run(trial: Trial, finer: int, nudge: bool = False) -> Recording:
    model = copy.copy(trial.subject.model)
    model.opt.timestep /= finer

    def shake(_: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.qvel[:] += NUDGE

    return record(trial.subject, model, trial.budget.part(0.3), finer, nudge=shake if nudge else None)


def _gap(one: Recording, other: Recording) -> float:
    """The largest distance between the two recordings, in m."""
    gaps = apart(one, other)
    return float(np.nan_to_num(gaps, nan=np.inf).max(initial=0.0))


def _covered(what: str, run: Recording) -> str:
    cut = "" if run.whole else f" of {run.planned}, then the time or the numbers ended"
    return f"{what} in {run.steps} steps{cut}, {shown(run.time, 's')}"
