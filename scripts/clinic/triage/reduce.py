"""Triage, step 6: a reduced scene. What touches nothing is deleted, parts of the physics are switched off."""

from __future__ import annotations

import copy

import mujoco
import numpy as np

from clinic.triage.cut import cut
from clinic.triage.run import Recording, Subject, gap, record, scale
from clinic.triage.text import shown
from clinic.triage.watch import Trial, Watch

SAME = 1e-9
"""Motions that differ by less than this share of the scene's size are the same."""
ALIKE = 1e-6
"""The same for a scene compiled anew."""
FELT = 0.05
LEAST = 0.5
"""Seconds that compiling anew may take at least."""
EFFECTS = ("gravity", "contact", "limit", "spring", "damper", "actuation", "equality", "frictionloss")
IDLE = {
    "gravity": "bodies have weight",
    "contact": "there are contacts",
    "spring": "there are springs",
    "damper": "there are dampers",
    "actuation": "actuators push",
}
"""Parts of the physics that usually change a motion, and what to say when one does not."""


def look(trial: Trial) -> tuple[str, list[tuple[str, str, str]]]:
    """Says what the motion hangs on: which parts of the scene, and which parts of the physics."""
    s, (base, watch) = trial.subject, trial.base
    if s.model.nv == 0:
        return "nothing moves", []
    if len(base.points) < 2:
        return "too few steps to compare", []
    size = scale(s, base)
    said, found = _removed(trial)
    matter = []
    for effect in EFFECTS:
        if not works(s, watch, effect) or trial.budget.left <= 0:
            continue
        share = gap(base, without(trial, effect)) / size
        if share > FELT:
            matter.append(effect)
        if share < SAME and effect in IDLE:
            found.append(("idle", effect, f"{IDLE[effect]}, and switching it off changes nothing"))
    still = float(np.ptp(base.points, axis=0).max(initial=0.0)) < SAME * size if base.finite else False
    said.append("nothing moves" if still else f"the motion hangs on {', '.join(matter) or 'nothing'}")
    return "; ".join(said), found


def works(s: Subject, watch: Watch, effect: str) -> bool:
    """Whether a part of the physics is switched on and has something to act upon."""
    m = s.model
    if m.opt.disableflags & _flag(effect):
        return False
    present = {
        "gravity": np.any(m.opt.gravity) and np.any(m.body_mass[m.body_treeid >= 0]),
        "contact": len(watch.touched),
        "limit": np.any(m.jnt_limited) or np.any(m.tendon_limited),
        "spring": np.any(m.jnt_stiffness) or np.any(m.tendon_stiffness),
        "damper": (np.any(m.dof_damping) or np.any(m.tendon_damping)) and watch.fastest[0] > 0,
        "actuation": watch.acted.any(),
        "equality": np.any(m.eq_active0),
        "frictionloss": np.any(m.dof_frictionloss) or np.any(m.tendon_frictionloss),
    }
    return bool(present[effect])


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
    share = float(np.nan_to_num(gaps, nan=np.inf).max(initial=0.0)) / scale(trial.subject, base)
    name = " and ".join(part for part in parts if part)
    if share < ALIKE:
        met = sorted({g for pair, since in watch.overlaps.items() for g in pair if g in made.geoms and since > 0})
        found = [
            ("passed", trial.subject.called("geom", g), "lies in the way, and deleting it changes nothing") for g in met
        ]
        return [f"without {name} the rest moves as before"], found
    if share <= 10 * trial.chaos:
        return [f"without {name} the motion is too chaotic to compare"], []
    return [f"{name} removed"], [
        ("removed", name, f"the rest moves otherwise without them: {shown(100 * share, '%', 2)}")
    ]


def _counted(names: list[str], what: str) -> str:
    return ", ".join(names) if len(names) <= 2 else f"{len(names)} {what}"


def _flag(effect: str) -> int:
    return int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{effect.upper()}"))
