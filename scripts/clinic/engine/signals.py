"""Signals: paths into MuJoCo's named access, parsed and bound to a model, never evaluated as code.

A path is one of

    body(box).xpos[2]           a field of a named body, joint, geom, site, camera, actuator, tendon,
                                sensor, light, equality or key, as `MjData` names it
    sensor(force)[0]            short for sensor(force).data[0]
    model.joint(elbow).range[1] the same of `MjModel`
    qpos[0], ncon, energy[1]    a field of `MjData`; model.opt.timestep, model.nq: of `MjModel`
    efc_R[0], efc_KBIP[0][2]    of the active constraints; not a number while there are fewer
    warning(BADQACC)            how often MuJoCo raised the warning (mind that a reset clears it)
    contact(*).friction[0]      the largest over all contacts; not a number while there is none
    contact(pad, cube).dist     the same over the contacts between two geoms
    contact(*).force[0]         normal force in N, then the two friction forces and three torques
    contact(*).count            how many contacts; 0 while there is none
    printed(error)              the numbers a script printed in lines `error = 1.5`

An index defaults to 0. Several indices are allowed on a field with as many dimensions.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import mujoco
import numpy as np

from clinic.record.parts import WARNINGS
from clinic.record.problem import article, closest, listed

Reader = Callable[[], float]

KINDS = ("body", "joint", "geom", "site", "camera", "actuator", "tendon", "sensor", "light", "equality", "key")
CONTACT = ("friction", "dist", "pos", "frame", "includemargin", "dim", "force", "count")
PATH = re.compile(
    r"""(?P<model>model\.)?
        (?:(?P<kind>[a-z]+)\((?P<name>[^()]*)\)(?:\.(?=\w)|(?=\[|$)))?
        (?P<field>[A-Za-z_][A-Za-z0-9_.]*)?
        (?P<index>(?:\[-?\d+\])*)""",
    re.VERBOSE,
)


class SignalError(ValueError):
    """A path that cannot be read: what was found, expected, and the repair."""

    def __init__(self, found: str, expected: str, repair: str) -> None:
        self.found, self.expected, self.repair = found, expected, repair
        super().__init__(found, expected, repair)

    def __str__(self) -> str:
        return f"{self.found}; expected {self.expected}; {self.repair}"


@dataclass(frozen=True)
class Path:
    """A parsed signal path.

    Args:
        model: Whether the field is the model's rather than the data's.
        kind: `body`, `contact`, `warning`, `printed`, ...; empty for a plain field.
        name: The text in parentheses.
        field: The attribute, with dots for nested ones.
        index: The indices; empty when none was written.
    """

    model: bool
    kind: str
    name: str
    field: str
    index: tuple[int, ...]


def parse_path(text: str) -> Path:
    """The path's parts.

    Raises:
        SignalError: If the text is no path.
    """
    match = PATH.fullmatch(text.strip())
    kinds = (*KINDS, "contact", "warning", "printed")
    if match is None or not (match["kind"] or match["field"]):
        raise SignalError(text, "a path such as body(box).xpos[2], ncon or sensor(force)[0]", "see *Signal paths*")
    kind, name, field = match["kind"] or "", match["name"] or "", match["field"] or ""
    if kind and kind not in kinds:
        guess = closest(kind, kinds)
        raise SignalError(
            f"{kind}(...)", f"one of {listed(kinds, 20)}", f"write {guess}({name})" if guess else "correct it"
        )
    if kind and not name.strip():
        raise SignalError(f"{kind}()", "a name in the parentheses", "name the element")
    if kind == "sensor" and not field:
        field = "data"
    if kind in ("warning", "printed") and (field or match["index"] or match["model"]):
        raise SignalError(text, f"{kind}({name}) alone", "remove what stands around it")
    if kind not in ("", "warning", "printed") and not field:
        raise SignalError(text, f"a field, as in {kind}({name}).xpos[0]", "add the field after a dot")
    index = tuple(int(part) for part in re.findall(r"-?\d+", match["index"]))
    return Path(bool(match["model"]), kind, name.strip(), field, index)


def bind(path: Path, model: mujoco.MjModel, data: mujoco.MjData) -> Reader:
    """A function of no arguments that reads the signal's present value from `data`.

    Raises:
        SignalError: If the model has no such element, field or index.
    """
    match path.kind:
        case "printed":
            raise SignalError(f"printed({path.name})", "a path into MuJoCo: this case is a model", "read the model")
        case "warning":
            return _bind_warning(path, data)
        case "contact":
            return _bind_contact(path, model, data)
        case "":
            return _bind_field(path, model if path.model else data, "model" if path.model else "data")
    owner = model if path.model else data
    if not hasattr(owner, path.kind):
        raise SignalError(f"{path.kind}({path.name})", "an element with data", f"write model.{path.kind}({path.name})")
    known = element_names(model, path.kind)
    if path.name not in known:
        guess = closest(path.name, known)
        raise SignalError(
            f"{path.kind}({path.name}), which the model does not have",
            f"{article(path.kind)}: {listed(known)}",
            f"write {path.kind}({guess})" if guess else f"correct the name, or name the {path.kind} in the model",
        )
    return _bind_field(path, getattr(owner, path.kind)(path.name), f"{path.kind}({path.name})")


def element_names(model: mujoco.MjModel, kind: str) -> list[str]:
    """The names of the model's elements of a kind; unnamed ones are left out."""
    obj = getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}")
    count = {"body": "nbody", "joint": "njnt", "camera": "ncam", "actuator": "nu", "equality": "neq"}
    number = getattr(model, count.get(kind, f"n{kind}"))
    names = (mujoco.mj_id2name(model, obj, i) for i in range(number))
    return [name for name in names if name]


def _bind_field(path: Path, owner: Any, shown: str) -> Reader:
    *parents, last = path.field.split(".")
    for parent in parents:
        owner = _attribute(owner, parent, shown)
    value = _attribute(owner, last, shown)
    if shown == "data" and last.startswith("efc_"):
        return _constraint_reader(path, owner)
    if isinstance(value, np.ndarray) and value.ndim:
        where = _checked_index(path, value.shape, shown)
        return partial(value.item, *where)
    if isinstance(value, bool | int | float | np.number) or (isinstance(value, np.ndarray) and value.ndim == 0):
        if path.index:
            raise SignalError(f"an index on {shown}.{last}", "no index: it is one number", "remove the brackets")
        return lambda: float(getattr(owner, last))
    raise SignalError(f"{shown}.{path.field}", "a field that holds numbers", "name a numeric field")


def _constraint_reader(path: Path, data: mujoco.MjData) -> Reader:
    """Reads a field whose length follows the number of active constraints; not a number beyond it."""

    def read() -> float:
        value, where = getattr(data, path.field), path.index or (0,)
        return float(value[where]) if where[0] < len(value) and value[where].ndim == 0 else float("nan")

    return read


def _attribute(owner: Any, name: str, shown: str) -> Any:
    value = None if name.startswith("_") else getattr(owner, name, None)
    if value is None or callable(value):
        known = [field for field in dir(owner) if not field.startswith("_")]
        guess = closest(name, known)
        raise SignalError(
            f"{shown}.{name}, which does not exist",
            f"a field of {shown}: {listed(known, 12)}",
            f"write {guess}" if guess else "correct the field",
        )
    return value


def _checked_index(path: Path, shape: tuple[int, ...], shown: str) -> tuple[int, ...]:
    where = path.index or (0,) * len(shape)
    if len(where) != len(shape) or not all(0 <= i < n for i, n in zip(where, shape, strict=True)):
        found = "".join(f"[{i}]" for i in path.index)
        size = " x ".join(str(n) for n in shape)
        raise SignalError(
            f"{shown}.{path.field}{found}", f"{len(shape)} index(es) from 0 into {size} numbers", "correct the index"
        )
    return where


def _bind_warning(path: Path, data: mujoco.MjData) -> Reader:
    if path.name not in WARNINGS:
        raise SignalError(f"warning({path.name})", f"one of {listed(WARNINGS, 20)}", "correct the name")
    number = int(getattr(mujoco.mjtWarning, f"mjWARN_{path.name}"))
    return lambda: float(data.warning.number[number])


def _bind_contact(path: Path, model: mujoco.MjModel, data: mujoco.MjData) -> Reader:
    if path.field not in CONTACT:
        raise SignalError(f"contact(...).{path.field}", f"one of {listed(CONTACT)}", "correct the field")
    pair: list[list[int]] | None = None
    if path.name != "*":
        known = element_names(model, "geom")
        names = [name.strip() for name in path.name.split(",")]
        if len(names) != 2 or any(name not in known for name in names):
            raise SignalError(
                f"contact({path.name})", f"`*`, or two geoms: {listed(known)}", "name the two geoms of the contact"
            )
        ids = [int(model.geom(name).id) for name in names]
        pair = [ids, ids[::-1]]
    sizes = {"friction": 5, "pos": 3, "frame": 9, "force": 6}
    index = path.index or (0,)
    if len(index) != 1 or not 0 <= index[0] < sizes.get(path.field, 1):
        raise SignalError(
            f"contact(...).{path.field}{list(index)}", f"an index below {sizes.get(path.field, 1)}", "correct it"
        )
    force = np.zeros(6)

    def chosen() -> Sequence[int]:
        if pair is None:
            return range(data.ncon)
        return [i for i, geoms in enumerate(data.contact.geom.tolist()) if geoms in pair]

    def normal_force(i: int) -> float:
        mujoco.mj_contactForce(model, data, i, force)
        return float(force[index[0]])

    def read() -> float:
        found = chosen() if data.ncon else ()
        match path.field:
            case "count":
                return float(len(found))
            case "force":
                values = [normal_force(i) for i in found]
            case field:
                whole = getattr(data.contact, field) if found else np.empty(0)
                values = [float(whole[i][index[0]] if whole.ndim > 1 else whole[i]) for i in found]
        return max(values, default=float("nan"))

    return read
