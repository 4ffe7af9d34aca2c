"""Units as records write them, `N m/rad`: their dimension and size, and those of arithmetic over numbers with units."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass

from clinic.record.expression import evaluate

Powers = tuple[float, float, float]
UNITS: dict[str, tuple[float, Powers]] = {
    "m": (1.0, (0, 1, 0)),
    "mm": (1e-3, (0, 1, 0)),
    "cm": (1e-2, (0, 1, 0)),
    "um": (1e-6, (0, 1, 0)),
    "s": (1.0, (0, 0, 1)),
    "ms": (1e-3, (0, 0, 1)),
    "kg": (1.0, (1, 0, 0)),
    "g": (1e-3, (1, 0, 0)),
    "N": (1.0, (1, 1, -2)),
    "J": (1.0, (1, 2, -2)),
    "W": (1.0, (1, 2, -3)),
    "Hz": (1.0, (0, 0, -1)),
    "rad": (1.0, (0, 0, 0)),
    "°": (0.017453292519943295, (0, 0, 0)),
    "%": (0.01, (0, 0, 0)),
}
NONE: Powers = (0, 0, 0)
SYMBOL = re.compile(r"([A-Za-z°%]+)([²³]?)")
SAME = ("abs", "minimum", "maximum", "floor")
PURE = ("exp", "log", "sin", "cos", "tan", "arccos")


class UnitError(ValueError):
    """Arithmetic that adds or compares what has different dimensions; the message says which."""


@dataclass(frozen=True)
class Unit:
    """How many SI units one of it is, and its powers of kilogram, metre and second."""

    size: float
    powers: Powers


def unit(text: str) -> Unit | None:
    """The unit that a text such as `N m/rad` or `kg m²` names; None if it has an unknown part."""
    size, powers = 1.0, NONE
    for index, part in enumerate(text.split("/")):
        for word in part.split():
            found = SYMBOL.fullmatch(word)
            if found is None or found[1] not in UNITS:
                return None
            power = {"": 1, "²": 2, "³": 3}[found[2]] * (-1 if index else 1)
            factor, own = UNITS[found[1]]
            size, powers = size * factor**power, _sum(powers, own, power)
    return Unit(size, powers)


def powers_of(tree: ast.expr, known: Mapping[str, Powers]) -> Powers | None:
    """The dimension of an expression; None where a name or a function has none that is known.

    Raises:
        UnitError: If it adds numbers of different dimensions, or takes the sine, the logarithm, ... of one with a unit.
    """
    match tree:
        case ast.Constant():
            return NONE
        case ast.Name(id=name):
            return NONE if name == "pi" else known.get(name)
        case ast.UnaryOp(operand=operand):
            return powers_of(operand, known)
        case ast.BinOp(left=left, op=op, right=right):
            return _of_two(tree, op, powers_of(left, known), powers_of(right, known), right)
        case ast.Call(func=ast.Name(id=name), args=args):
            given = [powers_of(arg, known) for arg in args]
            if name == "sqrt":
                return None if given[0] is None else _sum(NONE, given[0], 0.5)
            if name in SAME:
                return _equal(tree, given)
            if name in PURE:
                _equal(tree, [*given, NONE])
                return NONE
    return None


def _of_two(
    tree: ast.BinOp, op: ast.operator, left: Powers | None, right: Powers | None, of: ast.expr
) -> Powers | None:
    if isinstance(op, ast.Add | ast.Sub):
        written = [isinstance(side, ast.Constant) for side in (tree.left, tree.right)]  # in whatever unit
        return left if written[1] else right if written[0] else _equal(tree, [left, right])
    if left is None or right is None:
        return None
    if isinstance(op, ast.Pow):
        return _sum(NONE, left, float(evaluate(of, {}))) if isinstance(of, ast.Constant | ast.UnaryOp) else None
    return _sum(left, right, -1 if isinstance(op, ast.Div) else 1)


def _equal(tree: ast.expr, given: list[Powers | None]) -> Powers | None:
    if len({each for each in given if each is not None}) > 1:
        raise UnitError(ast.unparse(tree))
    return None if None in given else given[0]


def _sum(here: Powers, there: Powers, times: float) -> Powers:
    made = [a + times * b for a, b in zip(here, there, strict=True)]
    return made[0], made[1], made[2]
