"""Triage, step 6: a reduced scene. What never touches anything is removed, and parts of the physics are switched off."""

from __future__ import annotations

import copy

import mujoco
import numpy as np

from clinic.triage_cut import cut
from clinic.triage_run import Recording, Subject, apart, record, scale
from clinic.triage_text import shown
from clinic.triage_watch import Trial, Watch

SAME = 1e-9
"""Motions that differ by less than this share of the scene's size are the same."""
ALIKE = 1e-6
"""The same for a scene compiled anew."""
FELT = 0.05
LEAST = 0.5
"""Seconds that compiling anew may take at least."""
EFFECTS = ("gravity", "contact", "limit", "spring", "damper", "actuation", "equality", "frictionloss")


def look(trial: Trial) -> tuple[str, list[tuple[str, str, str]]]:
    """Says what the motion hangs on: which parts of the scene, and which parts of the physics."""
    s, (base, watch) = trial.subject, trial.base
    if s.model.nv == 0:
        return "nothing moves", []
    size = scale(s, base)
    said, found = _removed(trial)
    matter = []
    for effect in EFFECTS:
        at_work = works(s, watch, effect)
        if not at_work or trial.budget.left <= 0:
            continue
        gap = _largest(base, without(trial, effect)) / size
        if gap > FELT:
            matter.append(effect)
        if gap < SAME:
            found.append(("idle", effect, f"{at_work}, and switching it off changes nothing"))
    said.append(f"the motion hangs on {', '.join(matter) or 'nothing'}")
    return "; ".join(said), found


def works(s: Subject, watch: Watch, effect: str) -> str:
    """What a part of the physics has to act upon, in words; empty where it has nothing."""
    m = s.model
    if m.opt.disableflags & _flag(effect):
        return ""
    present = {
        "gravity": np.any(m.opt.gravity) and np.any(m.body_mass[m.body_treeid >= 0]),
        "contact": watch.touched,
        "limit": np.any(m.jnt_limited) or np.any(m.tendon_limited),
        "spring": np.any(m.jnt_stiffness) or np.any(m.tendon_stiffness),
        "damper": (np.any(m.dof_damping) or np.any(m.tendon_damping)) and watch.fastest[0] > 0,
        "actuation": watch.acted.any(),
        "equality": np.any(m.eq_active0),
        "frictionloss": np.any(m.dof_frictionloss) or np.any(m.tendon_frictionloss),
    }
    words = {
        "gravity": "bodies have weight",
        "contact": "contacts exist",
        "spring": "springs exist",
        "damper": "dampers exist",
        "actuation": "actuators push",
        "equality": "equalities exist",
    }
    return words.get(effect, "it exists") if present[effect] else ""


def without(trial: Trial, effect: str) -> Recording:
    """The run with a part of the physics switched off."""
    model = copy.copy(trial.subject.model)
    model.opt.disableflags |= _flag(effect)
    return record(trial.subject, model, trial.budget.part(0.2))


def _removed(trial: Trial) -> tuple[list[str], list[tuple[str, str, str]]]:
    """What was deleted and whether the rest moves as before."""
    base, watch = trial.base
    if trial.budget.left <= LEAST:
        return [], []
    try:
        made = cut(trial)
    except (ValueError, KeyError, mujoco.FatalError) as error:
        return [f"nothing was removed: {' '.join(str(error).split())[:80]}"], []
    if made is None:
        return ["nothing is untouched"], []
    parts = [
        _counted([trial.subject.called("geom", g) for g in made.geoms], "untouched fixed geoms"),
        _counted([trial.subject.called("body", b) for b in made.roots], "separate bodies with all that hangs on them"),
    ]
    n = min(len(made.points), len(base.points))
    gaps = np.linalg.norm(made.points[:n] - base.points[:n][:, made.kept], axis=2)
    gap = float(np.nan_to_num(gaps, nan=np.inf).max(initial=0.0)) / scale(trial.subject, base)
    name = " and ".join(part for part in parts if part)
    if gap < ALIKE:
        met = {g: pair for pair in watch.overlaps for g in pair if g in made.geoms}
        found = [
            ("passed", trial.subject.called("geom", g), "lies in the way, and deleting it changes nothing") for g in met
        ]
        return [f"without {name} the rest moves as before"], found
    return [f"{name} removed"], [
        ("removed", name, f"the rest moves otherwise without them: {shown(100 * gap, '%', 2)}")
    ]


def _counted(names: list[str], what: str) -> str:
    return ", ".join(names) if len(names) <= 2 else f"{len(names)} {what}"


def _flag(effect: str) -> int:
    return int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{effect.upper()}"))


def _largest(one: Recording, other: Recording) -> float:
    return float(np.nan_to_num(apart(one, other), nan=np.inf).max(initial=0.0))
