"""Triage, step 6: a reduced scene. Parts of the physics are switched off, one at a time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from clinic.triage.findings import Finding, StepResult, counted
from clinic.triage.model_rules import collides
from clinic.triage.recording import Recording, Subject, distance, flags, record_run, scale

FELT = 0.05  # a motion depends on what changes it by more than this share of the scene's size
SAME = 1e-9  # motions that differ by less than this share are the same


def look(s: Subject) -> StepResult:
    """Says what the motion depends on and what touches nothing, and finds the parts that its warnings need."""
    run = s.watched
    if s.model.nv == 0:
        return "nothing moves", []
    if len(run.points) < 2:
        return "too few steps to compare", []
    found, matter, idle, size = [], [], [], scale(s, run)
    for effect in effects(s, run):
        without = record_run(s, 0.2, without=(effect,))
        if not without.steps:
            break
        share = distance(run, without) / size
        if share > FELT:
            matter.append(effect)
        elif share < SAME:
            idle.append(effect)
        if run.warnings and without.steps == without.planned and not without.warnings:
            text = f"switched off, MuJoCo no longer warns of {', '.join(run.warnings)}"
            found.append(Finding("needed", effect, text))
    still = float(np.ptp(run.points, axis=0).max(initial=0.0)) < SAME * size
    if still and "gravity" in idle and not run.touching:
        text = "nothing moves or touches, and switching it off changes nothing"
        found.append(Finding("idle", "gravity", text))
    said = [f"the motion hangs on {', '.join(matter) or 'nothing'}"]
    said += [f"{', '.join(idle)}: switched off, nothing changes"] if idle else []
    touched = {geom for pair in run.touching for geom in pair}
    alone = [s.called("geom", i) for i in range(s.model.ngeom) if i not in touched and collides(s.model, i)]
    if alone:
        said.append(f"nothing touches {', '.join(alone) if len(alone) < 4 else counted(len(alone), 'geom')}")
    return "; ".join(said), found


def effects(s: Subject, run: Recording) -> Iterator[str]:
    """The parts of the physics that are switched on and have something to act upon."""
    m = s.model
    present = {
        "gravity": np.any(m.opt.gravity),
        "contact": run.touching,
        "limit": np.any(m.jnt_limited) or np.any(m.tendon_limited),
        "spring": np.any(m.jnt_stiffness) or np.any(m.tendon_stiffness),
        "damper": np.any(m.dof_damping) or np.any(m.tendon_damping),
        "actuation": m.nu,
        "equality": np.any(m.eq_active0),
        "frictionloss": np.any(m.dof_frictionloss) or np.any(m.tendon_frictionloss),
    }
    return (effect for effect, there in present.items() if there and not m.opt.disableflags & flags(effect))
