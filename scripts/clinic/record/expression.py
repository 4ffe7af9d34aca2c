"""Arithmetic as data: a small language for numbers computed from other numbers.

expression := + - * / ** , unary -, parentheses, numbers, names, pi, and the functions below
"""

from __future__ import annotations

import ast
import inspect
import operator
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clinic.record import predictions

Value = float | NDArray[np.float64]

FUNCTIONS: dict[str, Callable[..., Any]] = {
    "abs": np.abs,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "arccos": np.arccos,
    "minimum": np.minimum,
    "maximum": np.maximum,
    "floor": np.floor,
    **predictions.FUNCTIONS,
}
BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: np.divide,
    ast.Pow: np.power,
}


LONGEST = 300  # characters
LARGEST = 1e300


class ExpressionError(ValueError):
    """Text that is no expression; the message says what was expected."""


def parse(text: str) -> ast.expr:
    """The expression's tree, with nothing in it but the language above.

    Raises:
        ExpressionError: For anything else.
    """
    if len(text) > LONGEST:
        raise ExpressionError(f"{LONGEST} characters at most")
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ExpressionError("arithmetic that can be parsed") from None
    for node in ast.walk(tree):
        _allow(node)
    return tree


def names(tree: ast.expr) -> set[str]:
    """The names the expression reads."""
    called = {id(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and id(node) not in called} - {"pi"}


def evaluate(tree: ast.expr, values: Mapping[str, Value]) -> Value:
    """The expression's value; arrays are combined element by element.

    Raises:
        ExpressionError: If a function cannot take what it is given.
    """
    match tree:
        case ast.Constant(value=int() | float() as value):
            return float(value)
        case ast.Name(id="pi"):
            return float(np.pi)
        case ast.Name(id=name):
            return values[name]
        case ast.UnaryOp(operand=operand):
            return -evaluate(operand, values)
        case ast.BinOp(left=left, op=op, right=right):
            result: Value = BINARY[type(op)](evaluate(left, values), evaluate(right, values))
            return result
        case ast.Call(func=ast.Name(id=name), args=args):
            given = [evaluate(arg, values) for arg in args]
            try:
                return FUNCTIONS[name](*given)  # type: ignore[no-any-return]
            except (ArithmeticError, TypeError, ValueError) as error:
                raise ExpressionError(f"numbers that {name} can take: {error}") from None
    raise AssertionError(ast.dump(tree))


def _allow(node: ast.AST) -> None:
    match node:
        case ast.Constant(value=value) if isinstance(value, int | float) and not isinstance(value, bool):
            if value > LARGEST:
                raise ExpressionError(f"numbers of {LARGEST:g} at most")
            return
        case ast.UnaryOp(op=ast.USub()) | ast.USub() | ast.Name() | ast.Load():
            return
        case ast.BinOp(op=op) if type(op) in BINARY:
            return
        case ast.operator() if type(node) in BINARY:
            return
        case ast.Call(func=ast.Name(id=name), keywords=[], args=[_, *_] as args):
            if name in FUNCTIONS:
                wanted = _arity(FUNCTIONS[name])
                if len(args) == wanted:
                    return
                raise ExpressionError(f"{name} with {wanted} argument{'s' if wanted > 1 else ''}")
            instead = f"{name}imum in place of {name}: " if name in ("max", "min") else ""
            raise ExpressionError(f"{instead}one of the functions {', '.join(FUNCTIONS)}")
    raise ExpressionError("numbers, names, + - * / **, parentheses and functions")


def _arity(function: Callable[..., Any]) -> int:
    return function.nin if isinstance(function, np.ufunc) else len(inspect.signature(function).parameters)
