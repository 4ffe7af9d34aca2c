"""A smaller scene with the same motion: what nothing touches is deleted, and the rest is run again."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from clinic.engine.simulate import captured_messages
from clinic.record.fields import RunSpec
from clinic.triage.run import Recording, Subject, record
from clinic.triage.watch import Trial, Watch


@dataclass(frozen=True)
class Cut:
    """A reduced scene.

    Args:
        geoms: The fixed geoms that were deleted: those that nothing touched.
        roots: The first bodies of the trees that were deleted: those that neither touch the largest group of trees nor
            are tied to it.
        kept: Ids in the whole model of the moving bodies that are left, in the order of `points`.
        run: The run of what is left.
        points: Its body frames, shape (samples, len(kept), 3).
    """

    geoms: list[int]
    roots: list[int]
    kept: list[int]
    run: Recording
    points: np.ndarray


def groups(s: Subject, watch: Watch) -> list[set[int]]:
    """The model's trees in groups that touch each other or share a constraint, tendon or actuator; largest first."""
    m = s.model
    found: list[set[int]] = [{tree} for tree in range(m.ntree)]
    pairs = [[int(m.body_treeid[m.geom_bodyid[g]]) for g in pair if g >= 0] for pair in watch.touched]
    if m.neq or m.ntendon or m.nflex:  # too many kinds of ties to follow: all trees together
        pairs.append(list(range(m.ntree)))
    for pair in pairs:
        tied = {tree for tree in pair if tree >= 0}
        if len(tied) > 1:
            joined = set().union(*(group for group in found if group & tied))
            found = [group for group in found if not group & tied] + [joined]
    return sorted(found, key=lambda group: (-sum(int(m.tree_dofnum[t]) for t in group), min(group)))


def cut(trial: Trial) -> Cut | None:
    """The reduced scene, run; None where there is nothing to delete.

    Raises:
        ValueError: If the scene does not compile without what was deleted.
    """
    s, (_, watch) = trial.subject, trial.base
    m = s.model
    touched = {g for pair in watch.touched for g in pair}
    geoms = [g for g in range(m.ngeom) if m.body_treeid[m.geom_bodyid[g]] < 0 and g not in touched]
    _, *others = groups(s, watch)
    roots = [int(m.tree_bodyadr[tree]) for group in others for tree in sorted(group)]
    if not geoms and not roots:
        return None
    spec = s.spec.copy()
    for kind, elements in (("body", spec.bodies[1:]), ("joint", spec.joints), ("geom", spec.geoms)):
        _name(kind, elements)
    _name("actuator", spec.actuators)
    bodies, shapes = {b.name for b in spec.bodies}, list(spec.geoms)
    whole = _compiled(spec)
    for key in list(spec.keys):
        spec.delete(key)
    for g in geoms:
        spec.delete(shapes[g])
    for root in roots:
        spec.delete(spec.body(mujoco.mj_id2name(whole, mujoco.mjtObj.mjOBJ_BODY, root)))
    model = _compiled(spec)
    names = [n for n in sorted(bodies - {"world"}) if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, n) >= 0]
    kept = [n for n in names if m.body_treeid[whole.body(n).id] >= 0]
    known = {mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_ACTUATOR, i) for i in range(model.nu)}
    run = RunSpec(duration=s.run.duration, ctrl={name: value for name, value in s.run.ctrl.items() if name in known})

    def transplant(_: mujoco.MjModel, data: mujoco.MjData) -> None:
        for i in range(model.njnt):
            name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, i)
            old = s.data.joint(whole.joint(name).id)
            data.joint(name).qpos[:], data.joint(name).qvel[:] = old.qpos, old.qvel
        for name in known:
            data.actuator(name).ctrl[:] = s.data.actuator(whole.actuator(name).id).ctrl

    recording = record(Subject(s.name, spec, model, run), model, trial.budget.part(0.2), nudge=transplant)
    ids = [model.body(name).id for name in kept]
    return Cut(geoms, roots, [whole.body(n).id for n in kept], recording, recording.points[:, ids])


def _name(kind: str, elements: list[object]) -> None:
    for i, element in enumerate(elements):
        if not element.name:  # type: ignore[attr-defined]
            element.name = f"unnamed {kind} {i}"  # type: ignore[attr-defined]


def _compiled(spec: mujoco.MjSpec) -> mujoco.MjModel:
    with captured_messages():
        return spec.compile()
