"""The same task: what a reader's model changes besides what a repair may, told in sentences.

Every repair may change how the model is simulated and how things touch: a smaller timestep, integrator, solver, contact
parameters, masks, pairs and excludes, damping, armature, friction, but for a free joint's, and an actuator's gains, up
to a bound; colours, lights, further cameras, sites, sensors, keyframes and empty bodies of the
world. A record's `task.may` names more. Elements
are compared by name, unnamed ones by their order; a geom or site may have another name at the same place, and a geom
may be turned as its symmetry hides.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.record.fields import Task

TABLES: dict[str, Any] = json.loads(Path(__file__).with_name("task.json").read_text(encoding="utf-8"))
"""What is compared and how it is told; docs/playground/judge/task.js reads the same tables.

Args:
    fields: What belongs to the task, by kind: fields of MjModel, without the kind's prefix.
    words, units: How a field is called and what it is measured in.
    prefix, count: What MjModel calls a kind's fields and its number, where that is not the kind's own name.
    bodies, transmissions: Fields that refer to a body, and what the kinds of an actuator's transmission refer to.
    types: The enumeration that names the types of an element.
    further: Kinds of which a repair may add some.
    renamed: Kinds that a repair may call otherwise: no record drives them, and a measured name that is gone is told.
    counted: Kinds of which only the number is compared.
    limited: The field that says whether a range applies. Ranges are the same when rounded: 1.57 and a quarter turn.
    ranges: Those that a repair may set where there was none.
    flags, options: Flags and numbers of `<option>`.
    most: Beyond it nothing is repaired, but frozen; SI units.
    heaviest: How many times the inertia that a joint turns an armature may be.
"""
FIELDS: dict[str, str] = TABLES["fields"]
WORDS: dict[str, str] = TABLES["words"]


def changes(broken: mujoco.MjModel, model: mujoco.MjModel, task: Task) -> list[str]:
    """What `model` has changed of the task of `broken`, a sentence each; empty for a fair repair."""
    kinds = (said for kind in FIELDS for said in _of_kind(broken, model, kind, task.may))
    return [*kinds, *_counted(broken, model), *_options(broken, model), *_excessive(broken, model)]


def _of_kind(broken: mujoco.MjModel, model: mujoco.MjModel, kind: str, may: Sequence[str]) -> Iterator[str]:
    here, there = _elements(broken, kind), _elements(model, kind)
    if kind in TABLES["renamed"]:
        old = {i: name for name, i in here.items() if name not in there}
        there = {name if name in here else old.get(i, name): i for name, i in there.items()}
    for name, i in here.items():
        if name not in there:
            if f"{kind}({name})" not in may:
                yield f"You removed or renamed {kind} {name}."
            continue
        for field in FIELDS[kind].split():
            before, after = _value(broken, kind, field, i), _value(model, kind, field, there[name])
            allowed = {f"{kind}({name}).{word}" for word in (field, WORDS.get(field, field))} & set(may)
            same = _same(before, after, field) or (
                (kind, field) == ("geom", "quat") and _fills_the_same(int(broken.geom_type[i]), before, after)
            )
            if not allowed and not same:
                yield _changed(field, f" of {kind} {name}", before, after)
                if (kind, field) == ("sensor", "type"):
                    break  # what else differs is because of it
    for name in there if kind not in (*TABLES["further"], *may) else ():
        if name not in here and not (kind == "body" and _is_frame(model, there[name])):
            yield f"You added {kind} {name}."


def _counted(broken: mujoco.MjModel, model: mujoco.MjModel) -> Iterator[str]:
    for kind in TABLES["counted"]:
        before, after = (_count(each, kind) for each in (broken, model))
        if before != after:
            yield f"You {'added' if after > before else 'removed'} {'an' if kind[0] in 'aeiou' else 'a'} {kind}."


def _options(broken: mujoco.MjModel, model: mujoco.MjModel) -> Iterator[str]:
    if model.opt.timestep > broken.opt.timestep:
        yield f"The timestep is {model.opt.timestep:g} s, longer than the model's {broken.opt.timestep:g} s."
    for field in TABLES["options"]:
        before, after = (np.atleast_1d(getattr(each.opt, field)) for each in (broken, model))
        if not _same(before, after, field):
            yield _changed(field, "", before, after)
    changed = broken.opt.disableflags ^ model.opt.disableflags
    for flag in TABLES["flags"].split():
        bit = int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{flag}", 0))
        if changed & bit:
            yield f"You switched {flag.lower()} {'off' if model.opt.disableflags & bit else 'on'}."
    if (broken.opt.enableflags ^ model.opt.enableflags) & int(getattr(mujoco.mjtEnableBit, "mjENBL_SLEEP", 0)):
        yield "You switched sleep on or off."
    if (
        model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_OVERRIDE)
        and model.opt.o_margin < 0 <= broken.opt.o_margin
    ):
        yield "You switched contact off, by a margin below zero for all of them."
    if broken.opt.disableactuator != model.opt.disableactuator:
        yield "You switched actuators on or off."


def _excessive(broken: mujoco.MjModel, model: mujoco.MjModel) -> Iterator[str]:
    for field, most in TABLES["most"].items():
        size = np.abs if field.endswith("prm") else np.positive
        before, after = (np.max(size(getattr(each, field, 0.0)), initial=0.0) for each in (broken, model))
        if after > max(most, before):
            yield f"{field} is {after:g}: that holds what should move; at most {most:g} is accepted."
    for kind in ("geom", "pair"):
        before, after = (np.min(getattr(each, f"{kind}_margin"), initial=0.0) for each in (broken, model))
        if after < before:
            yield f"{kind}_margin is {after:g}: below zero things go into each other before they push."
    times, reflected = TABLES["heaviest"], _armature(model)
    for i, (armature, inertia) in enumerate(zip(reflected, broken.dof_M0, strict=False)):
        if armature > times * inertia:
            of = _name(broken, "JOINT", int(broken.dof_jntid[i]))
            yield f"The armature of joint {of} is {armature:g}, more than {times} times its inertia {inertia:.3g}."
    if (after := _friction_of_free(model)) > _friction_of_free(broken):
        yield f"A free joint has a frictionloss of {after:g}: that holds to the world what should be free."


def _armature(model: mujoco.MjModel) -> NDArray[np.float64]:
    """The armature of each degree of freedom, with those of actuators, which a gear multiplies twice."""
    made = np.array(model.dof_armature)
    for i, armature in enumerate(getattr(model, "actuator_armature", ())):
        if armature and model.actuator_trntype[i] <= int(mujoco.mjtTrn.mjTRN_JOINTINPARENT):
            made[model.jnt_dofadr[model.actuator_trnid[i, 0]]] += armature * model.actuator_gear[i, 0] ** 2
    return made


def _is_frame(model: mujoco.MjModel, body: int) -> bool:
    """Whether a body is a place in the world and nothing more: what a camera is turned to."""
    return bool(model.body_weldid[body] == 0 and not model.body_geomnum[body])


def _friction_of_free(model: mujoco.MjModel) -> float:
    first = model.jnt_dofadr[model.jnt_type == mujoco.mjtJoint.mjJNT_FREE]
    return max((float(np.max(model.dof_frictionloss[i : i + 6])) for i in first), default=0.0)


def _elements(model: mujoco.MjModel, kind: str) -> dict[str, int]:
    """The ids of a kind's elements by name; unnamed ones are called by their order: `#0`."""
    names = [_name(model, kind.upper(), i) for i in range(_count(model, kind))]
    unnamed = iter(range(len(names)))
    return {name or f"#{next(unnamed)}": i for i, name in enumerate(names)}


def _count(model: mujoco.MjModel, kind: str) -> int:
    return int(getattr(model, TABLES["count"].get(kind, f"n{kind}"), 0))


def _name(model: mujoco.MjModel, kind: str, index: int) -> str:
    return mujoco.mj_id2name(model, getattr(mujoco.mjtObj, f"mjOBJ_{kind}"), index) or ""


def _value(model: mujoco.MjModel, kind: str, field: str, i: int) -> Any:
    """A field of an element: an array, or the name of what it refers to; None where this MuJoCo has no such field."""
    prefix = TABLES["prefix"].get(kind, kind)
    if field in TABLES["bodies"]:
        other = int(getattr(model, f"{prefix}_{field}")[i])
        return _name(model, "BODY", other) if other >= 0 else "none"
    if enumeration := TABLES["types"].get(f"{kind}.{field}"):
        member = getattr(mujoco, enumeration)(int(getattr(model, f"{prefix}_{field}")[i]))
        return str(member.name.partition("_")[2].lower())
    if field == "trnid":
        kinds = TABLES["transmissions"]
        type_, ids = int(model.actuator_trntype[i]), model.actuator_trnid[i]
        return _name(model, kinds[type_], int(ids[0])) if type_ < len(kinds) else ids
    if field in ("objid", "refid"):
        type_, other = (int(getattr(model, f"sensor_{field[:3]}{part}")[i]) for part in ("type", "id"))
        return (mujoco.mj_id2name(model, type_, other) or str(other)) if other >= 0 else "none"
    if field == "bias":
        return model.actuator_biasprm[i, :1]
    if field in ("qpos0", "qpos_spring"):
        scalar = int(model.jnt_type[i]) >= int(mujoco.mjtJoint.mjJNT_SLIDE)
        return np.atleast_1d(getattr(model, field)[model.jnt_qposadr[i]]) if scalar else np.zeros(1)
    if field in TABLES["limited"] and not getattr(model, f"{prefix}_{TABLES['limited'][field]}")[i]:
        return np.array([-np.inf, np.inf])
    whole = getattr(model, f"{prefix}_{field}", None)
    return None if whole is None else np.atleast_1d(whole[i])


def _same(before: Any, after: Any, field: str) -> bool:
    if field in TABLES["ranges"] and np.all(np.isinf(before)):
        return True  # a range where there was none: the checks tell whether it holds anything back
    if before is None or after is None or isinstance(before, str) or isinstance(after, str):
        return bool(np.array_equal(before, after))
    after = after[: len(before)]  # a keyframe is longer where an actuator was added
    if np.shape(before) != np.shape(after):
        return False
    rtol = 1e-3 if field in TABLES["limited"] else 1e-4
    close = np.allclose(before, after, rtol=rtol, atol=1e-6)
    return bool(close or (field == "quat" and np.allclose(before, -after, rtol=rtol, atol=1e-6)))


def _fills_the_same(type_: int, before: Any, after: Any) -> bool:
    """Whether a geom of a type is where it was after a turn that its symmetry hides."""
    turn, inverse = np.zeros(4), np.zeros(4)
    mujoco.mju_negQuat(inverse, before)
    mujoco.mju_mulQuat(turn, inverse, after)
    w, x, y, z = zero = np.abs(turn) < 1e-5
    kinds = mujoco.mjtGeom
    if type_ == kinds.mjGEOM_SPHERE:
        return True
    if type_ in (kinds.mjGEOM_CAPSULE, kinds.mjGEOM_CYLINDER):
        return bool((x and y) or (w and z))
    return type_ in (kinds.mjGEOM_BOX, kinds.mjGEOM_ELLIPSOID) and int(np.sum(zero)) == 3


def _changed(field: str, of: str, before: Any, after: Any) -> str:
    if field == "gravity" and not np.any(after):
        return "You turned gravity off."
    here, there = (value if isinstance(value, str) else _numbers(value) for value in (before, after))
    unit = TABLES["units"].get(field, "")
    return f"You changed the {WORDS.get(field, field)}{of} from {here} to {there} {unit}".rstrip() + "."


def _numbers(value: Any) -> str:
    found = np.ravel(value)
    return "none" if np.all(np.isinf(found)) else " ".join(f"{float(number):.4g}" for number in found)
