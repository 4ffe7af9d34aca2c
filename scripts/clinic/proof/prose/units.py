"""Law 5, units: a signal has the unit of what it reads, or that which its arithmetic gives."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Iterator

import mujoco

from clinic.engine.signals import Path, parse_path
from clinic.engine.simulate import compile_model
from clinic.proof.evidence import Evidence
from clinic.proof.prose_laws import prose_of
from clinic.record.case import Case
from clinic.record.expression import parse
from clinic.record.problem import Problem, listed
from clinic.record.prose import FORMULA, bare
from clinic.record.signal import ExpressionSignal, PathSignal
from clinic.record.units import Unit, UnitError, powers_of, unit

PLAIN = {
    **dict.fromkeys(("xpos", "xipos", "ipos", "xanchor", "size", "dist", "pos", "rbound"), "m"),
    **dict.fromkeys(("xmat", "xquat", "quat", "xaxis", "frame", "friction", "count", "dim", "ncon", "nefc"), ""),
    **dict.fromkeys(("contype", "conaffinity", "priority"), ""),
    **dict.fromkeys(("time", "timestep"), "s"),
    "mass": "kg",
    "gravity": "m/s²",
    "energy": "J",
}
TURNED = {  # of a hinge, and of a slide
    **dict.fromkeys(("qpos", "range", "length", "qpos0"), ("rad", "m")),
    **dict.fromkeys(("qvel", "velocity"), ("rad/s", "m/s")),
    "qacc": ("rad/s²", "m/s²"),
    **dict.fromkeys(("qfrc_bias", "qfrc_actuator", "qfrc_passive", "qfrc_constraint", "force"), ("N m", "N")),
    "stiffness": ("N m/rad", "N/m"),
    "damping": ("N m s/rad", "N s/m"),
    **dict.fromkeys(("armature", "dof_M0", "M"), ("kg m²", "kg")),
}
SENSORS = {"FORCE": "N", "TOUCH": "N", "TORQUE": "N m", "FRAMEPOS": "m", "VELOCIMETER": "m/s", "ACCELEROMETER": "m/s²"}
SENSORS |= {"GYRO": "rad/s", "CLOCK": "s", "SUBTREECOM": "m", "RANGEFINDER": "m"}
HINGE, SLIDE = int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)
QUANTITIES = {
    "force": ("N",),
    "torque": ("N m",),
    "angle": ("rad", "°"),
    "speed": ("m/s", "rad/s"),
    "velocity": ("m/s", "rad/s"),
    "height": ("m", ""),
    "distance": ("m",),
    "depth": ("m",),
    "thickness": ("m",),
    "radius": ("m",),
    "mass": ("kg",),
    "timestep": ("s",),
    "time": ("s",),
    "share": ("",),
    "ratio": ("",),
}
"""The units of what a label says first."""
ATTRIBUTES = {"density": "kg/m³", "viscosity": "Pa s"}
"""The units of attributes of which no signal need be read."""
BELOW = r"\s?/\s?\(?(?:s|m|cm|mm|kg|rad|N)[²³]?(?: (?:s|m|kg)[²³]?)*\)?"
COMPOUND = re.compile(rf"(?<![\w/])(?:k?g|mm|cm|k?m|s|ms|m?rad|deg|k?N|J|W)(?:[²³]|{BELOW})+")
QUANTITY = re.compile(rf"^(?:[a-z]+ )*?({'|'.join(QUANTITIES)})\b(?! constant| gain| term)")
RELATIVE = re.compile(r" in [a-z]+s$")  # in edges, in diameters
TENS = {10.0**power for power in range(-9, 10)} - {1.0}


def in_units(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, units. A signal's unit is that of the field it reads, or the one its arithmetic gives."""
    model = compile_model(case.text) if case.record.run is not None else None
    for name, signal in case.record.signals.items():
        where, said, own = ("signals", name, "unit"), QUANTITY.search(signal.label), unit(signal.unit)
        fitting = [unit(each) for each in QUANTITIES[said[1]]] if said else []
        if (
            said
            and own
            and not RELATIVE.search(signal.label)
            and not any(each is not None and each.powers == own.powers for each in fitting)
        ):
            expected = f"a unit of {said[1]}: {listed(QUANTITIES[said[1]])}"
            yield case.problem(where, signal.unit or "no unit", expected, "correct the unit or the label")
        if isinstance(signal, PathSignal) and model is not None:
            wanted = unit_of(model, parse_path(signal.path))
            if wanted is not None and unit(wanted) != unit(signal.unit):
                expected = f"{wanted or 'no unit'}, in which {signal.path} is"
                yield case.problem(where, signal.unit or "no unit", expected, "correct the unit or the path")
        elif isinstance(signal, ExpressionSignal):
            yield from _computed(case, name, signal)


def unit_of(model: mujoco.MjModel, path: Path) -> str | None:
    """The unit of what a path reads; None if it is not known here."""
    field = path.field.rpartition(".")[2]
    if path.kind == "contact" and field == "force":
        return "N" if (path.index or (0,))[0] < 3 else "N m"
    if path.kind == "sensor":
        return SENSORS.get(mujoco.mjtSensor(int(model.sensor(path.name).type[0])).name.removeprefix("mjSENS_"))
    if path.kind == "warning":
        return ""
    if field in PLAIN:
        return PLAIN[field]
    joint = _joint(model, path)
    if field not in TURNED or joint is None:
        return None
    return TURNED[field][0 if int(model.jnt_type[joint]) == HINGE else 1]


def _joint(model: mujoco.MjModel, path: Path) -> int | None:
    """The hinge or slide whose number a path reads."""
    if path.kind == "joint":
        joint = model.joint(path.name).id
    elif path.kind == "actuator":
        moved = model.actuator(path.name)
        if int(moved.trntype[0]) != int(mujoco.mjtTrn.mjTRN_JOINT) or abs(moved.gear[0]) != 1:
            return None
        joint = int(moved.trnid[0])
    elif not path.kind and path.index and path.field != "M" and path.index[0] < model.nv:
        joint = int(model.dof_jntid[path.index[0]])
    elif path.field == "M" and len({*model.jnt_type}) == 1:
        joint = 0
    else:
        return None
    return int(joint) if int(model.jnt_type[joint]) in (HINGE, SLIDE) else None


def _computed(case: Case, name: str, signal: ExpressionSignal) -> Iterator[Problem]:
    where, own, tree = ("signals", name, "unit"), unit(signal.unit), parse(signal.expr)
    parts = {key: unit(each.unit) for key, each in case.record.signals.items()}
    try:
        powers = powers_of(tree, {key: each.powers for key, each in parts.items() if each is not None})
    except UnitError as error:
        found = f"{error}, of numbers with different units"
        yield case.problem(("signals", name, "expr"), found, "numbers of one unit", "correct the expression or a unit")
        return
    if powers is None or own is None:
        return
    read = [part for key, part in parts.items() if part is not None and key in _named(tree)]
    constants = [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    factors = [float(value) for value in constants if isinstance(value, int | float) and value in TENS]
    if own.powers != powers or not _sized(own, read, factors):
        expected = "the unit of " + signal.expr
        yield case.problem(where, signal.unit or "no unit", expected, "correct the unit or the expression")


def _named(tree: ast.expr) -> set[str]:
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}


def _sized(own: Unit, read: list[Unit], factors: list[float]) -> bool:
    """Whether a unit's size fits: that of a unit read, or the SI unit's, by a power of ten that is written."""
    sizes = {1.0, *(part.size for part in read)}
    return any(math.isclose(own.size * factor, size) for factor in (1.0, *factors) for size in sizes)


def written(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, units in prose. A compound unit that is typed is that of a signal, or of an attribute that is quoted."""
    units = {signal.unit for signal in case.record.signals.values()}
    for where, text in prose_of(case):
        units_here = units | {unit for name, unit in ATTRIBUTES.items() if f".{name}" in text}
        for found in COMPOUND.finditer(FORMULA.sub("", bare(text))):
            if found[0] not in units_here:
                wanted = f"the unit of a signal: {listed(sorted(filter(None, units_here)))}"
                yield case.problem(where, found[0], wanted, "correct the unit, or say it by a field", found[0])
