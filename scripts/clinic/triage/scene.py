"""Triage, step 3: what a picture with overlays would show, as numbers: cameras, contacts, overlaps."""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np

from clinic.triage.model import Seen, collides
from clinic.triage.run import Subject
from clinic.triage.text import Finding, Look, counted, shown
from clinic.triage.watched_run import Examination, Watcher

FLAT = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))
Rule = Callable[[Subject, Watcher], Seen]


def cameras(s: Subject, watcher: Watcher) -> Seen:
    """A camera fixed in the world has the up direction of its image more than 6° below the horizon."""
    gravity = np.asarray(s.model.opt.gravity, dtype=float)
    for i in range(s.model.ncam):
        up = s.data.cam_xmat[i].reshape(3, 3)[:, 1]
        if s.model.body_treeid[s.model.cam_bodyid[i]] < 0 and up @ gravity > 0.1 * np.linalg.norm(gravity):
            axis = ", ".join(shown(round(float(x), 2) + 0.0, "", 2) for x in up)
            yield s.called("camera", i), f"the image's up is ({axis}): upside down"


def deep_start(s: Subject, watcher: Watcher) -> Seen:
    """Two geoms start with a contact deeper than 5 % of the thinner one's smallest half-size."""
    for contact in s.data.contact:
        one, two = (int(g) for g in contact.geom)
        if min(one, two) >= 0 and -contact.dist > 0.05 * min(_half_size(s.model, one), _half_size(s.model, two)):
            yield _pair(s, one, two), f"start {shown(-1e3 * contact.dist, 'mm')} inside each other"


def leaps(s: Subject, watcher: Watcher) -> Seen:
    """A colliding geom goes farther in a step than its smallest half-size and the thinnest fixed geom's together."""
    m = s.model
    colliding = [i for i in range(m.ngeom) if collides(m, i)]
    fixed = {i: _half_size(m, i) for i in colliding if m.body_treeid[m.geom_bodyid[i]] < 0}
    thinnest = min(fixed, key=lambda i: fixed[i], default=-1)
    for i in colliding:
        way = watcher.farthest[i]
        if fixed and i not in fixed and way > fixed[thinnest] + _half_size(m, i):
            yield (
                s.called("geom", i),
                f"goes {shown(1e3 * way, 'mm')} in a step; {s.called('geom', thinnest)} is thinner",
            )


def ghosts(s: Subject, watcher: Watcher) -> Seen:
    """Two geoms that both have contact masks, which do not match, come to overlap (looked for at 20 moments)."""
    for (one, two), since in watcher.overlaps.items():
        if since > 0:
            yield _pair(s, one, two), f"overlap from {shown(since, 's')} on without a contact"


RULES: tuple[Rule, ...] = (cameras, deep_start, leaps, ghosts)


def look(examination: Examination) -> Look:
    """Applies every rule to the start and to the watched run."""
    s, (run, watcher) = examination.subject, examination.watched
    found = [Finding(rule.__name__, *seen) for rule in RULES for seen in dict(rule(s, watcher)).items()]
    pairs = counted(len(watcher.touching), "pair")
    said = f"{counted(s.data.ncon, 'contact')} at the start, {pairs} of geoms in contact within {shown(run.time, 's')}"
    return said, found


def _half_size(m: mujoco.MjModel, i: int) -> float:
    """A geom's smallest half-size in m; infinite for planes and height fields, which have no thickness."""
    sizes = m.geom_size[i][m.geom_size[i] > 0]
    return np.inf if int(m.geom_type[i]) in FLAT else float(sizes.min(initial=np.inf))


def _pair(s: Subject, one: int, two: int) -> str:
    return f"{s.called('geom', one)} and {s.called('geom', two)}"
