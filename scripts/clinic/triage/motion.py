"""Triage, steps 1, 4 and 5: MuJoCo's warnings, conservation, and half the timestep."""

from __future__ import annotations

import copy

import mujoco
import numpy as np

from clinic.triage.run import Array, Recording, Subject, gap, record, scale
from clinic.triage.text import shown
from clinic.triage.watch import NUDGE, Trial, Watch

Look = tuple[str, list[tuple[str, str, str]]]
FAST = 1000.0
"""A degree of freedom faster than this, in rad/s or m/s, is unusual."""
SHARE = 0.05
"""A drift of more than this share is unusual."""
FREE = int(mujoco.mjtJoint.mjJNT_FREE)
FREED = ("CONSTRAINT", "DAMPER", "ACTUATION")


def warnings(trial: Trial) -> Look:
    """What MuJoCo warns of, how often time goes back, and whether numbers stay finite and moderate."""
    s = trial.subject
    run, watch = trial.base
    found = [("warned", name, _message(name, run.messages)) for name in run.warnings]
    found += [("compiler", "model", note) for note in s.notes]
    if run.resets:
        found.append(("reset", "data.time", f"goes back on {run.resets} of {run.steps} steps: the state is reset"))
    if not run.finite:
        found.append(("finite", "state", f"is no longer finite after {shown(run.time, 's')}"))
    if watch.fastest[0] > FAST:
        joint = s.called("joint", int(s.model.dof_jntid[watch.fastest[1]]))
        found.append(("fast", joint, f"reaches {shown(watch.fastest[0], 'rad/s or m/s')}"))
    return _covered("no warning" if not run.warnings else "warnings", run), found


def conservation(trial: Trial) -> Look:
    """Whether energy appears in the run, drifts where nothing takes it away, or a free momentum changes."""
    s = trial.subject
    _, watch = trial.base
    if s.model.nv == 0:
        return "nothing moves", []
    found, said = [], []
    gained = gain(s, watch)
    if gained is not None:
        said.append("energy appears" if gained > SHARE else "no energy appears")
        if gained > SHARE:
            found.append(("gain", "energy", f"{100 * gained:.0f} % of the energy in play was put in by no actuator"))
    drifted = drift(trial)
    if drifted is not None:
        said.append(
            f"it drifts by {shown(100 * drifted, '%', 2)} without contacts, dampers and actuators"
            if np.isfinite(drifted)
            else "without contacts, dampers and actuators the motion explodes"
        )
        if not np.isfinite(drifted):
            found.append(("explodes", "energy", "grows beyond all bounds where it should stay"))
        elif drifted > SHARE:
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
    if len(base.points) < 2:
        return "too few steps to compare", []
    size = scale(s, base)
    chaos = trial.chaos
    for finer, name in ((2, "half"), (20, "a twentieth")):
        run = _finer(trial, finer)
        if not run.points.size:
            continue
        if run.warnings.keys() != base.warnings.keys() or run.finite != base.finite:
            now = ", ".join(run.warnings) or "none"
            found.append(
                (name, "warnings", f"at {name} of the timestep: {now}, before: {', '.join(base.warnings) or 'none'}")
            )
            continue
        share = gap(base, run) / size
        if share > SHARE and chaos < 0.5 * share:
            found.append((name, "motion", f"at {name} of the timestep up to {shown(share * size, 'm')} elsewhere"))
        part = "" if len(run.points) >= len(base.points) else f" in the first {shown(run.time, 's')}"
        said.append(f"{name}: {shown(100 * share, '%', 2)} of {shown(size, 'm')}{part}")
    if chaos > SHARE:
        said.append(f"chaotic: a change of {NUDGE:g} at the start gives {shown(100 * chaos, '%', 2)}")
    return "; ".join(said) or "not enough time for it", found


def gain(s: Subject, watch: Watch) -> float | None:
    """The energy that nobody supplied, as a share of the energy in play; None where there is none in play.

    In play is at least what lifts the whole model by a thousandth of the scene's extent.
    """
    energies = watch.energies
    if len(energies) < 2 or not np.isfinite(energies).all():
        return None
    total = energies.sum(axis=1)
    weight = float(s.model.body_subtreemass[0] * np.linalg.norm(s.model.opt.gravity))
    play = max(float(energies[:, 1].max() + np.ptp(energies[:, 0])), 1e-3 * s.model.stat.extent * weight)
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
    """Each tree on a free joint that touched nothing, and how far its momentum is from a free fall's, as a share."""
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
        free = m.body_jntnum[body] == 1 and m.jnt_type[m.body_jntadr[body]] == FREE
        if free and tree not in touched:
            momentum = watch.momenta[:, tree]
            fall = momentum[0] + m.body_subtreemass[body] * times[:, None] * m.opt.gravity
            largest = float(np.linalg.norm(momentum, axis=1).max())
            if largest > 0 and np.isfinite(momentum).all():
                made.append((tree, float(np.linalg.norm(momentum - fall, axis=1).max()) / largest))
    return made


def _finer(trial: Trial, finer: int) -> Recording:
    model = copy.copy(trial.subject.model)
    model.opt.timestep /= finer
    return record(trial.subject, model, trial.budget.part(0.3), finer)


def _message(name: str, messages: tuple[str, ...]) -> str:
    """What MuJoCo printed for a warning."""
    words = mujoco.mju_warningText(getattr(mujoco.mjtWarning, f"mjWARN_{name}"), 7).partition("7")[0]
    return next((message for message in messages if message.startswith(words)), "raised")


def _covered(what: str, run: Recording) -> str:
    cut = "" if run.whole else f" of {run.planned}, then the time or the numbers ended"
    return f"{what} in {run.steps} steps{cut}, {shown(run.time, 's')}"
