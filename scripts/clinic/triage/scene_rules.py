"""Triage, step 3: what a picture with overlays would show, as numbers: cameras, contacts, overlaps."""

from __future__ import annotations

import copy

import mujoco
import numpy as np

from clinic.engine.simulate import captured_messages
from clinic.triage.findings import StepResult, counted, format_number
from clinic.triage.model_rules import Rule, Seen, apply, collides
from clinic.triage.recording import Subject

FLAT = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))


def cameras(s: Subject) -> Seen:
    """A camera fixed in the world has the up direction of its image more than 6° below the horizon."""
    gravity = np.asarray(s.model.opt.gravity, dtype=float)
    for i in range(s.model.ncam):
        up = s.data.cam_xmat[i].reshape(3, 3)[:, 1]
        if s.model.body_treeid[s.model.cam_bodyid[i]] < 0 and up @ gravity > 0.1 * np.linalg.norm(gravity):
            axis = ", ".join(format_number(round(float(x), 2) + 0.0, "", 2) for x in up)
            yield s.called("camera", i), f"the image's up is ({axis}): upside down"


def deep_start(s: Subject) -> Seen:
    """Two geoms start with a contact deeper than 5 % of the thinner one's smallest half-size."""
    for contact in s.data.contact:
        one, two = (int(g) for g in contact.geom)
        if min(one, two) >= 0 and -contact.dist > 0.05 * min(_half_size(s.model, one), _half_size(s.model, two)):
            yield _pair(s, one, two), f"start {format_number(-1e3 * contact.dist, 'mm')} inside each other"


def leaps(s: Subject) -> Seen:
    """A colliding geom goes farther in a step than its smallest half-size and the thinnest fixed geom's together."""
    m, farthest = s.model, s.watched.farthest
    colliding = [i for i in range(m.ngeom) if collides(m, i)]
    fixed = {i: _half_size(m, i) for i in colliding if m.body_treeid[m.geom_bodyid[i]] < 0}
    thinnest = min(fixed, key=lambda i: fixed[i], default=-1)
    for i in colliding:
        if fixed and i not in fixed and farthest[i] > fixed[thinnest] + _half_size(m, i):
            way, halves = (format_number(1e3 * far, "mm") for far in (farthest[i], fixed[thinnest] + _half_size(m, i)))
            thin = f"half of it and of {s.called('geom', thinnest)} are {halves} thick"
            yield s.called("geom", i), f"goes {way} in a step; {thin}"


def ghosts(s: Subject) -> Seen:
    """Two geoms that both have contact masks, which do not match, come to overlap (looked for at 100 moments)."""
    run = s.watched
    meeting = copy.copy(s.model)  # all masks match; MuJoCo itself leaves out parent and child, welded, excluded
    for kind in ("body", "geom"):  # it asks those of bodies first
        masks = [getattr(meeting, f"{kind}_{name}") for name in ("contype", "conaffinity")]
        masks[0][:] = masks[1][:] = (masks[0] | masks[1]) != 0
    data, since, every = mujoco.MjData(meeting), dict.fromkeys(run.touching, 0.0), run.time / max(1, len(run.qpos))
    with captured_messages():
        for k, qpos in enumerate([s.data.qpos, *run.qpos]):
            data.qpos[:] = qpos
            mujoco.mj_fwdPosition(meeting, data)
            for contact in data.contact:
                if contact.dist < 0 and contact.geom.min() >= 0:
                    since.setdefault(tuple(contact.geom.tolist()), k * every)
    for (one, two), time in since.items():
        if time > 0:
            yield _pair(s, one, two), f"overlap from {format_number(time, 's')} on without a contact"


RULES: tuple[Rule, ...] = (cameras, deep_start, leaps, ghosts)


def look(s: Subject) -> StepResult:
    """Applies every rule to the start and to the watched run."""
    run = s.watched
    pairs, time = counted(len(run.touching), "pair"), format_number(run.time, "s")
    said = f"{counted(s.data.ncon, 'contact')} at the start, {pairs} of geoms in contact within {time}"
    return said, apply(RULES, s)


def _half_size(m: mujoco.MjModel, i: int) -> float:
    """A geom's smallest half-size in m; infinite for planes and height fields, which have no thickness."""
    sizes = m.geom_size[i][m.geom_size[i] > 0]
    return np.inf if int(m.geom_type[i]) in FLAT else float(sizes.min(initial=np.inf))


def _pair(s: Subject, one: int, two: int) -> str:
    return f"{s.called('geom', one)} and {s.called('geom', two)}"
