"""Triage, steps 1, 4 and 5: MuJoCo's warnings, conservation, half the timestep."""

from __future__ import annotations

import copy

import mujoco
import numpy as np

from clinic.triage.run import Subject, distance, record, scale
from clinic.triage.text import Finding, Look, shown
from clinic.triage.watched_run import NUDGE, Examination, Watcher

FAST = 1000.0
"""A degree of freedom faster than this, in rad/s or m/s, is unusual."""
SHARE = 0.05
"""A drift or a change of motion of more than this share is unusual."""


def warnings(examination: Examination) -> Look:
    """What MuJoCo warns of, how often time goes back, and whether numbers stay finite and moderate."""
    s = examination.subject
    run, watcher = examination.watched
    found = [Finding("warned", name, _message(name, run.messages)) for name in run.warnings]
    found += [Finding("compiler", "model", note) for note in s.notes]
    if run.resets:
        found.append(Finding("reset", "data.time", f"goes back on {run.resets} of {run.steps} steps by a reset"))
    if not run.finite:
        found.append(Finding("finite", "state", f"is no longer finite after {shown(run.time, 's')}"))
    speed, dof = watcher.fastest
    if speed > FAST:
        joint = s.called("joint", int(s.model.dof_jntid[dof]))
        found.append(Finding("fast", joint, f"reaches {shown(speed, 'rad/s or m/s')}"))
    cut = "" if run.steps == run.planned else f" of {run.planned}, then the time or the numbers ended"
    said = f"{'warnings' if run.warnings else 'no warning'} in {run.steps} steps{cut}, {shown(run.time, 's')}"
    return said, found


def conservation(examination: Examination) -> Look:
    """Whether energy appears in the run, or drifts where nothing takes it away."""
    if examination.subject.model.nv == 0:
        return "nothing moves", []
    found, said = [], []
    gained = energy_gained(examination.subject, examination.watched[1])
    if gained is not None:
        said.append("energy appears" if gained > SHARE else "no energy appears")
        if gained > SHARE:
            text = f"{100 * gained:.0f} % of the energy in play was put in by no actuator"
            found.append(Finding("gain", "energy", text))
    drift = energy_drift(examination)
    if drift == np.inf:
        said.append("without contacts, dampers and actuators the motion explodes")
        found.append(Finding("explodes", "energy", "grows beyond all bounds where it should stay"))
    elif drift is not None:
        said.append(f"it drifts by {shown(100 * drift, '%', 2)} without contacts, dampers and actuators")
        if drift > SHARE:
            found.append(Finding("drift", "energy", f"drifts by {shown(100 * drift, '%', 2)} where it should stay"))
    return "; ".join(said) or "nothing to compare", found


def halved(examination: Examination) -> Look:
    """Whether the outcome changes with half the timestep, or a twentieth of it."""
    s, (run, _) = examination.subject, examination.watched
    if len(run.points) < 2:
        return "too few steps to compare", []
    found, said = [], []
    size, chaos = scale(s, run), examination.chaos
    for finer, name in ((2, "half"), (20, "a twentieth")):
        model = copy.copy(s.model)
        model.opt.timestep /= finer
        again = record(s, model, examination.budget.part(0.3), finer)
        if not len(again.points):
            continue
        if again.warnings.keys() != run.warnings.keys() or again.finite != run.finite:
            now, before = (", ".join(each.warnings) or "none" for each in (again, run))
            found.append(Finding(name, "warnings", f"at {name} of the timestep: {now}, before: {before}"))
            continue
        share = distance(run, again) / size
        if share > SHARE and chaos < 0.5 * share:
            text = f"at {name} of the timestep up to {shown(share * size, 'm')} elsewhere"
            found.append(Finding(name, "motion", text))
        part = "" if len(again.points) >= len(run.points) else f" in the first {shown(again.time, 's')}"
        said.append(f"{name}: {shown(100 * share, '%', 2)} of {shown(size, 'm')}{part}")
    if chaos > SHARE:
        said.append(f"chaotic: a change of {NUDGE:g} at the start gives {shown(100 * chaos, '%', 2)}")
    return "; ".join(said) or "not enough time for it", found


def energy_gained(s: Subject, watcher: Watcher) -> float | None:
    """The energy that nobody supplied, as a share of the energy in play; None where there is none in play.

    In play is at least what lifts the whole model by a thousandth of the scene's extent.
    """
    energies = np.array(watcher.energies).reshape(-1, 2)
    if len(energies) < 2 or not np.isfinite(energies).all():
        return None
    total = energies.sum(axis=1)
    weight = float(s.model.body_subtreemass[0] * np.linalg.norm(s.model.opt.gravity))
    play = max(float(energies[:, 1].max() + np.ptp(energies[:, 0])), 1e-3 * s.model.stat.extent * weight)
    surplus = float(np.max(total - total[0] - watcher.supplied[:-1]))
    return surplus / play if play > 1e-9 and np.isfinite(surplus) else None


def energy_drift(examination: Examination) -> float | None:
    """How far energy drifts, as a share of the largest kinetic energy, with nothing left that may change it.

    Contacts, limits, equalities, friction, dampers, fluids, actuators and gravity compensation are taken away. None
    where nothing moves then; infinite where the run explodes.
    """
    model = copy.copy(examination.subject.model)
    for name in ("CONSTRAINT", "DAMPER", "ACTUATION"):
        model.opt.disableflags |= getattr(mujoco.mjtDisableBit, f"mjDSBL_{name}")
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    model.opt.density = model.opt.viscosity = 0.0
    model.body_gravcomp[:] = 0
    energies: list[tuple[float, float]] = []

    def keep(_: mujoco.MjModel, data: mujoco.MjData) -> None:
        energies.append((float(data.energy[0]), float(data.energy[1])))

    run = record(examination.subject, model, examination.budget.part(0.2), after_step=keep)
    if not run.finite or run.resets or run.warnings:
        return float("inf")
    values = np.array(energies).reshape(-1, 2)
    kinetic = float(values[:, 1].max(initial=0.0))
    return float(np.ptp(values.sum(axis=1))) / kinetic if kinetic > 1e-9 else None


def _message(name: str, messages: tuple[str, ...]) -> str:
    """What MuJoCo printed for a warning."""
    words = mujoco.mju_warningText(getattr(mujoco.mjtWarning, f"mjWARN_{name}"), 7).partition("7")[0]
    return next((message for message in messages if message.startswith(words)), "raised")
