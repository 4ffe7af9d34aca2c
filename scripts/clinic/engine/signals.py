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
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import mujoco
import numpy as np

from clinic.record.parts import WARNINGS
from clinic.record.problem import article, closest, listed

Reader = Callable[[], float]

KINDS = ("body", "joint", "geom", "site", "camera", "actuator", "tendon", "sensor", "light", "equality", "key")
COUNTS = {"joint": "njnt", "camera": "ncam", "actuator": "nu", "equality": "neq"}
CONTACT = {"friction": 5, "dist": 1, "pos": 3, "frame": 9, "includemargin": 1, "dim": 1, "force": 6, "count": 1}
"""What can be read of a contact, and how many numbers it has."""
PATH = re.compile(
    r"""(?P<model>model\.)?
        (?:(?P<kind>[a-z]+)\((?P<name>[^()]*)\)(?:\.(?=\w)|(?=\[|$)))?
        (?P<field>[A-Za-z_][A-Za-z0-9_.]*)?
        (?P<index>(?:\[-?\d+\])*)""",
    re.VERBOSE,
)


@dataclass(eq=False)
class SignalError(ValueError):
    """A path that cannot be read: what was found, what was expected, and the repair."""

    found: str
    expected: str
    repair: str

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
    """Reads the parts of a path.

    Raises:
        SignalError: If the text is no path.
    """
    match = PATH.fullmatch(text.strip())
    if match is None or not (match["kind"] or match["field"]):
        expected = "a path such as body(box).xpos[2], ncon or sensor(force)[0]"
        raise SignalError(text, expected, "see *Signal paths* in what `clinic reference` prints")
    kind, name, field = ((match[part] or "").strip() for part in ("kind", "name", "field"))
    kinds = (*KINDS, "contact", "warning", "printed")
    if kind and kind not in kinds:
        guess = closest(kind, kinds)
        repair = f"write {guess}({name})" if guess else "correct it"
        raise SignalError(f"{kind}(...)", f"one of {listed(kinds, 20)}", repair)
    if kind and not name:
        raise SignalError(f"{kind}()", "a name in the parentheses", "name the element")
    if kind == "sensor" and not field:
        field = "data"
    if kind in ("warning", "printed"):
        if field or match["index"] or match["model"]:
            raise SignalError(text, f"{kind}({name}) alone", "remove what stands around it")
    elif kind and not field:
        raise SignalError(text, f"a field, as in {kind}({name}).xpos[0]", "add the field after a dot")
    index = tuple(int(part) for part in re.findall(r"-?\d+", match["index"]))
    return Path(bool(match["model"]), kind, name, field, index)


def bind(path: Path, model: mujoco.MjModel, data: mujoco.MjData) -> Reader:
    """Gives a function of no arguments that reads the signal's present value from `data`.

    Raises:
        SignalError: If the model has no such element, field or index.
    """
    owner = model if path.model else data
    match path.kind:
        case "printed":
            raise SignalError(f"printed({path.name})", "a path into MuJoCo: this case is a model", "read the model")
        case "warning":
            if path.name not in WARNINGS:
                raise SignalError(f"warning({path.name})", f"one of {listed(WARNINGS, 20)}", "correct the name")
            number = int(getattr(mujoco.mjtWarning, f"mjWARN_{path.name}"))
            return lambda: float(data.warning.number[number])
        case "contact":
            return _bind_contact(path, model, data)
        case "":
            return _bind_field(path, owner, "model" if path.model else "data")
    shown = f"{path.kind}({path.name})"
    if not hasattr(owner, path.kind):
        raise SignalError(shown, "an element with data", f"write model.{shown}")
    if missing := missing_element(model, path.kind, path.name):
        raise SignalError(*missing)
    return _bind_field(path, getattr(owner, path.kind)(path.name), shown)


def element_names(model: mujoco.MjModel, kind: str) -> list[str]:
    """The names of the model's elements of a kind; unnamed ones are left out."""
    obj = getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}")
    number = getattr(model, COUNTS.get(kind, f"n{kind}"))
    return [name for i in range(number) if (name := mujoco.mj_id2name(model, obj, i))]


def missing_element(model: mujoco.MjModel, kind: str, name: str) -> tuple[str, str, str] | None:
    """What was found, what was expected, and the repair, if the model has no element of that kind and name."""
    known = element_names(model, kind)
    if name in known:
        return None
    guess = closest(name, known)
    repair = f"write {guess}" if guess else f"correct the name, or name the {kind} in the model"
    return f"the {kind} {name}, which the model does not have", f"{article(kind)}: {listed(known)}", repair


def _bind_field(path: Path, owner: Any, shown: str) -> Reader:
    *parents, last = path.field.split(".")
    for parent in parents:
        owner = _attribute(owner, parent, shown)
    value: Any = _attribute(owner, last, shown)
    if shown == "data" and last.startswith("efc_"):
        return partial(_of_constraint, owner, last, path.index or (0,))
    if not isinstance(value, bool | int | float | np.number | np.ndarray):
        raise SignalError(f"{shown}.{path.field}", "a field that holds numbers", "name a numeric field")
    shape: tuple[int, ...] = np.shape(value)
    index = path.index or (0,) * len(shape)
    if len(index) != len(shape) or not all(0 <= i < n for i, n in zip(index, shape, strict=True)):
        found = f"{shown}.{path.field}" + "".join(f"[{i}]" for i in path.index)
        size = " x ".join(map(str, shape))
        expected = f"{len(shape)} index(es) from 0 into {size} numbers" if shape else "no index: it is one number"
        raise SignalError(found, expected, "correct the index")
    return partial(np.asarray(value).item, *index) if shape else lambda: float(getattr(owner, last))


def _of_constraint(data: mujoco.MjData, field: str, index: tuple[int, ...]) -> float:
    """A number of an active constraint; not a number while there are fewer constraints."""
    value = getattr(data, field)
    return float(value[index]) if index[0] < len(value) and value[index].ndim == 0 else float("nan")


def _attribute(owner: Any, name: str, shown: str) -> Any:
    value = None if name.startswith("_") else getattr(owner, name, None)
    if value is None or callable(value):
        known = [field for field in dir(owner) if not field.startswith("_")]
        guess = closest(name, known)
        repair = f"write {guess}" if guess else "correct the field"
        raise SignalError(f"{shown}.{name}, which does not exist", f"a field of {shown}: {listed(known, 12)}", repair)
    return value


def _bind_contact(path: Path, model: mujoco.MjModel, data: mujoco.MjData) -> Reader:
    field, index = path.field, path.index or (0,)
    if field not in CONTACT:
        raise SignalError(f"contact(...).{field}", f"one of {listed(CONTACT)}", "correct the field")
    if len(index) != 1 or not 0 <= index[0] < CONTACT[field]:
        raise SignalError(f"contact(...).{field}{list(index)}", f"an index below {CONTACT[field]}", "correct it")
    pair: list[int] = []
    if path.name != "*":
        names, known = [name.strip() for name in path.name.split(",")], element_names(model, "geom")
        if len(names) != 2 or not {*names} <= {*known}:
            expected = f"`*`, or two geoms: {listed(known)}"
            raise SignalError(f"contact({path.name})", expected, "name the two geoms of the contact")
        pair = sorted(int(model.geom(name).id) for name in names)

    def read() -> float:
        found = [i for i, geoms in enumerate(data.contact.geom.tolist()) if not pair or sorted(geoms) == pair]
        if field == "count":
            return float(len(found))
        if field == "force":
            numbers = np.zeros((len(found), 6))
            for row, i in zip(numbers, found, strict=True):
                mujoco.mj_contactForce(model, data, i, row)
        else:
            numbers = getattr(data.contact, field)[found].reshape(len(found), CONTACT[field])
        return float(numbers[:, index[0]].max()) if found else float("nan")

    return read
