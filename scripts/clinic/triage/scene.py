"""Triage, step 3: what a picture with overlays would show, as numbers: axes, frames, contacts, overlaps."""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.triage.model import Seen
from clinic.triage.run import Recording, Subject
from clinic.triage.stiffness import HINGE
from clinic.triage.text import counted, shown
from clinic.triage.watch import Trial, Watch

FLAT = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))
ROUND = (int(mujoco.mjtGeom.mjGEOM_SPHERE), int(mujoco.mjtGeom.mjGEOM_CAPSULE))
CYLINDER = int(mujoco.mjtGeom.mjGEOM_CYLINDER)
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
    """Two geoms press into each other by more than half of the thinner one's smallest half-size, and start apart."""
    begun = {name for name, _ in deep_start(s, run, watch)}
    for (one, two), touch in watch.touched.items():
        if (
            _couple(s, one, two) not in begun
            and min(one, two) >= 0
            and touch.deepest > 0.5 * _thickness(s.model, one, two)
        ):
            yield _couple(s, one, two), f"up to {shown(1e3 * touch.deepest, 'mm')} inside each other"


def leaps(s: Subject, run: Recording, watch: Watch) -> Seen:
    """A colliding geom goes farther in a step than its smallest half-size and the thinnest fixed geom's together."""
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
    """Two geoms that both have contact masks, which do not match, come to overlap (looked for at 20 moments)."""
    for (one, two), since in watch.overlaps.items():
        if since > 0:
            yield _couple(s, one, two), f"overlap from {shown(since, 's')} on without a contact"


RULES: tuple[Rule, ...] = (cameras, axes, deep_start, deep, leaps, ghosts)


def look(trial: Trial) -> tuple[str, list[tuple[str, str, str]]]:
    """Applies every rule to the start and to the watched run."""
    s = trial.subject
    run, watch = trial.base
    found = [(rule.__name__, *seen) for rule in RULES for seen in dict(rule(s, run, watch)).items()]
    pairs = counted(len(watch.touched), "pair")
    return (
        f"{counted(s.data.ncon, 'contact')} at the start, {pairs} of geoms in contact within {shown(run.time, 's')}",
        found,
    )


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
    kind = int(m.geom_type[i])
    if kind in FLAT:
        return np.inf
    if kind in ROUND:
        return float(m.geom_size[i, 0])
    count = 2 if kind == CYLINDER else 3
    return float(m.geom_size[i, :count].min()) or float(m.geom_rbound[i])


def _thickness(m: mujoco.MjModel, one: int, two: int) -> float:
    return min(_size(m, one), _size(m, two))


def _couple(s: Subject, one: int, two: int) -> str:
    return f"{s.called('geom', one)} and {s.called('geom', two)}"


def _vector(v: NDArray[np.float64]) -> str:
    return "(" + ", ".join(shown(round(float(x), 2) + 0.0, "", 2) for x in v) + ")"
