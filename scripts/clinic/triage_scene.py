"""Triage, step 3: what a picture with overlays would show, as numbers: axes, frames, contacts, overlaps."""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.triage_model import HINGE, Seen
from clinic.triage_run import Recording, Subject
from clinic.triage_text import shown
from clinic.triage_watch import Trial, Watch

Rule = Callable[[Subject, Recording, Watch], Seen]


def cameras(s: Subject, run: Recording, watch: Watch) -> Seen:
    """A camera fixed in the world has the up direction of its image more than 6° below the horizon."""
    up = _up(s)
    for i in range(s.model.ncam):
        if up is not None and s.model.body_treeid[s.model.cam_bodyid[i]] < 0:
            axis = s.data.cam_xmat[i].reshape(3, 3)[:, 1]
            if float(axis @ up) < -0.1:
                yield s.called("camera", i), f"the image's up is {_vector(axis)}: upside down"


def axes(s: Subject, run: Recording, watch: Watch) -> Seen:
    """The last hinge of a chain is within 1° of gravity's line, and the mass beyond it is off the axis by over 1 mm."""
    up, m, d = _up(s), s.model, s.data
    with_joints = {int(b) for b in m.jnt_bodyid}
    for i in range(m.njnt):
        body = int(m.jnt_bodyid[i])
        last = not any(_below(m, other, body) for other in with_joints if other != body)
        if up is None or m.jnt_type[i] != HINGE or m.body_jntnum[body] != 1 or not last:
            continue
        axis = d.xaxis[i]
        arm = d.subtree_com[body] - d.xanchor[i]
        off = float(np.linalg.norm(arm - axis * (arm @ axis)))
        if abs(float(axis @ up)) > np.cos(np.radians(1)) and off > 1e-3 and not _feels(s, int(m.jnt_dofadr[i])):
            yield (
                s.called("joint", i),
                f"axis {_vector(axis)} is parallel to gravity, mass {shown(1e3 * off, 'mm')} off it",
            )


def deep_start(s: Subject, run: Recording, watch: Watch) -> Seen:
    """Two geoms start with a contact deeper than 5 % of the thinner one's smallest half-size."""
    for contact in s.data.contact:
        one, two = (int(g) for g in contact.geom)
        if min(one, two) >= 0 and -contact.dist > 0.05 * _thickness(s.model, one, two):
            yield _couple(s, one, two), f"start {shown(-1e3 * contact.dist, 'mm')} inside each other"


def deep(s: Subject, run: Recording, watch: Watch) -> Seen:
    """Two geoms press into each other by more than half of the thinner one's smallest half-size."""
    for (one, two), touch in watch.touched.items():
        if min(one, two) >= 0 and touch.deepest > 0.5 * _thickness(s.model, one, two):
            yield _couple(s, one, two), f"up to {shown(1e3 * touch.deepest, 'mm')} inside each other"


def leaps(s: Subject, run: Recording, watch: Watch) -> Seen:
    """A colliding geom goes farther in one step than its own smallest half-size and the thinnest fixed geom's together."""
    m = s.model
    fixed = [
        i for i in range(m.ngeom) if m.body_treeid[m.geom_bodyid[i]] < 0 and _collides(m, i) and _size(m, i) < np.inf
    ]
    for i in range(m.ngeom):
        if m.body_treeid[m.geom_bodyid[i]] >= 0 and _collides(m, i) and fixed:
            thinnest = min(fixed, key=lambda j: _size(m, j))
            if watch.farthest[i] > _size(m, thinnest) + _size(m, i):
                yield (
                    s.called("geom", i),
                    f"goes {shown(1e3 * watch.farthest[i], 'mm')} in a step; {s.called('geom', thinnest)} is thinner",
                )


def ghosts(s: Subject, run: Recording, watch: Watch) -> Seen:
    """Two geoms that both have contact masks, which do not match, overlap at one of 20 moments of the run."""
    for (one, two), since in watch.overlaps.items():
        yield _couple(s, one, two), f"overlap at {shown(since, 's')} without a contact"


RULES: tuple[Rule, ...] = (cameras, axes, deep_start, deep, leaps, ghosts)


def look(trial: Trial) -> tuple[str, list[tuple[str, str, str]]]:
    """Applies every rule to the start and to the watched run."""
    s = trial.subject
    run, watch = trial.base
    found = [(rule.__name__, *seen) for rule in RULES for seen in dict(rule(s, run, watch)).items()]
    contacts = len(watch.touched)
    return f"{s.data.ncon} contacts at the start, {contacts} pairs touch in {shown(run.time, 's')}", found


def _up(s: Subject) -> NDArray[np.float64] | None:
    gravity = np.asarray(s.model.opt.gravity, dtype=float)
    size = float(np.linalg.norm(gravity))
    return -gravity / size if size > 0 else None


def _below(m: mujoco.MjModel, body: int, root: int) -> bool:
    """Whether `body` hangs on `root`."""
    while body > root:
        body = int(m.body_parentid[body])
    return body == root


def _feels(s: Subject, dof: int) -> bool:
    """Whether gravity pulls the degree of freedom at the start."""
    return abs(float(s.data.qfrc_bias[dof])) > 1e-6 * float(s.model.body_subtreemass[0]) * 9.81


def _collides(m: mujoco.MjModel, i: int) -> bool:
    return bool(m.geom_contype[i] or m.geom_conaffinity[i])


def _size(m: mujoco.MjModel, i: int) -> float:
    """A geom's smallest half-size in m; infinite for planes and height fields, which have no thickness."""
    kind = m.geom_type[i]
    if kind in (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD):
        return np.inf
    if kind in (mujoco.mjtGeom.mjGEOM_SPHERE, mujoco.mjtGeom.mjGEOM_CAPSULE):
        return float(m.geom_size[i, 0])
    count = 2 if kind == mujoco.mjtGeom.mjGEOM_CYLINDER else 3
    return float(m.geom_size[i, :count].min()) or float(m.geom_rbound[i])


def _thickness(m: mujoco.MjModel, one: int, two: int) -> float:
    return min(_size(m, one), _size(m, two))


def _couple(s: Subject, one: int, two: int) -> str:
    return f"{s.called('geom', one)} and {s.called('geom', two)}"


def _vector(v: NDArray[np.float64]) -> str:
    return "(" + ", ".join(shown(round(float(x), 2) + 0.0, "", 2) for x in v) + ")"
