"""Triage, steps 1, 4 and 5: MuJoCo's warnings, conservation, half the timestep."""

from __future__ import annotations

import copy
from dataclasses import replace

import mujoco
import numpy as np

from clinic.triage.findings import Finding, StepResult, format_number
from clinic.triage.recording import Subject, distance, record_run, scale

FAST = 1000.0  # rad/s or m/s; a degree of freedom faster than this is unusual
SHARE = 0.05  # a drift or a change of motion of more than this share is unusual
NUDGE = 1e-9  # rad/s or m/s; how far every velocity is changed to see whether a motion is chaotic


def warnings(s: Subject) -> StepResult:
    """What MuJoCo warns of, how often time goes back, and whether numbers stay finite and moderate."""
    run = s.watched
    found = [Finding("warned", name, message) for name, message in run.warnings.items()]
    found += [Finding("compiler", "model", note) for note in s.notes]
    if run.resets:
        found.append(Finding("reset", "data.time", f"goes back on {run.resets} of {run.steps} steps by a reset"))
    if not run.finite:
        found.append(Finding("finite", "state", f"is no longer finite after {format_number(run.time, 's')}"))
    if (speed := run.fastest.max(initial=0.0)) > FAST:
        dof = int(run.fastest.argmax())
        reached = f"reaches {_speed(s.model, dof, speed)}"
        found.append(Finding("fast", s.called("joint", s.model.dof_jntid[dof]), reached))
    cut = "" if run.steps == run.planned else f" of {run.planned}, then the time or the numbers ended"
    said = f"{'warnings' if run.warnings else 'no warning'} in {run.steps} steps{cut}, {format_number(run.time, 's')}"
    return said, found


def _speed(model: mujoco.MjModel, dof: int, speed: float) -> str:
    """With its unit: a slide goes, and the first three of a free joint's degrees of freedom."""
    joint = model.dof_jntid[dof]
    goes = {mujoco.mjtJoint.mjJNT_SLIDE: 1, mujoco.mjtJoint.mjJNT_FREE: 3}.get(
        mujoco.mjtJoint(model.jnt_type[joint]), 0
    )
    return format_number(speed, "m/s" if dof < model.jnt_dofadr[joint] + goes else "rad/s")


def conservation(s: Subject) -> StepResult:
    """Whether energy appears in the run, or drifts where nothing takes it away."""
    if s.model.nv == 0:
        return "nothing moves", []
    found, said = [], []
    gained = energy_gained(s)
    if gained is not None:
        said.append("energy appears" if gained > SHARE else "no energy appears")
        if gained > SHARE:
            text = f"{100 * gained:.0f} % of the energy in play was put in by no actuator"
            found.append(Finding("gain", "energy", text))
    drift = energy_drift(s)
    if drift == np.inf:
        said.append("without contacts, dampers and actuators the motion explodes")
        found.append(Finding("explodes", "energy", "grows beyond all bounds where it should stay"))
    elif drift is not None:
        percent = format_number(100 * drift, "%", 2)
        said.append(f"it drifts by {percent} without contacts, dampers and actuators")
        if drift > SHARE:
            found.append(Finding("drift", "energy", f"drifts by {percent} where it should stay"))
    return "; ".join(said) or "nothing to compare", found


def halved(s: Subject) -> StepResult:
    """Whether the outcome changes with half the timestep, or a twentieth of it."""
    run = s.watched
    if len(run.points) < 2:
        return "too few steps to compare", []
    found, said = [], []
    size, chaotic = scale(s, run), chaos(s)
    for finer, name in ((2, "half"), (20, "a twentieth")):
        again = record_run(s, 0.3, finer=finer)
        if not len(again.points):
            continue
        if again.warnings.keys() != run.warnings.keys() or again.finite != run.finite:
            now, before = (", ".join(each.warnings) or "none" for each in (again, run))
            found.append(Finding(name, "warnings", f"at {name} of the timestep: {now}, before: {before}"))
            continue
        share = distance(run, again) / size
        if share > SHARE and chaotic < 0.5 * share:
            text = f"at {name} of the timestep up to {format_number(share * size, 'm')} elsewhere"
            found.append(Finding(name, "motion", text))
        part = "" if len(again.points) >= len(run.points) else f" in the first {format_number(again.time, 's')}"
        said.append(f"{name}: {format_number(100 * share, '%', 2)} of {format_number(size, 'm')}{part}")
    if chaotic > SHARE:
        said.append(f"chaotic: a change of {NUDGE:g} at the start gives {format_number(100 * chaotic, '%', 2)}")
    return "; ".join(said) or "not enough time for it", found


def chaos(s: Subject) -> float:
    """How far the motion changes with every start velocity changed by NUDGE, as a share of the scene's scale."""
    run = s.watched
    return distance(run, record_run(s, 0.15, nudge=NUDGE)) / scale(s, run)


def energy_gained(s: Subject) -> float | None:
    """The energy that nobody supplied, as a share of the energy in play; None where there is none in play.

    In play is at least what lifts the whole model by a thousandth of the scene's extent.
    """
    m, run = s.model, s.watched
    if run.steps < 2 or not np.isfinite(run.energies).all():
        return None
    total, (potential, kinetic) = np.sum(run.energies, axis=1), np.transpose(run.energies)
    weight = float(m.body_subtreemass[0] * np.linalg.norm(m.opt.gravity))
    play = max(float(kinetic.max() + np.ptp(potential)), 1e-3 * m.stat.extent * weight)
    surplus = float(np.max(total - total[0] - run.supplied))
    return surplus / play if play > 1e-9 and np.isfinite(surplus) else None


def energy_drift(s: Subject) -> float | None:
    """How far energy drifts, as a share of the largest kinetic energy, with nothing left that may change it.

    Contacts, limits, equalities, friction, dampers, fluids, actuators and gravity compensation are taken away. None
    where nothing moves then; infinite where the run explodes.
    """
    model = copy.copy(s.model)
    model.opt.density = model.opt.viscosity = 0.0
    model.body_gravcomp[:] = 0
    bare = replace(s, model=model)
    run = record_run(bare, 0.2, without=("constraint", "damper", "actuation"))
    if not run.finite or run.resets or run.warnings:
        return float("inf")
    kinetic = max((float(kinetic) for _, kinetic in run.energies), default=0.0)
    return float(np.ptp(np.sum(run.energies, axis=1))) / kinetic if kinetic > 1e-9 else None
