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

from clinic.record import closed_forms

Value = float | NDArray[np.float64]

NUMPY = ("abs", "sqrt", "exp", "log", "sin", "cos", "tan", "arccos", "minimum", "maximum", "floor")
FUNCTIONS: dict[str, Callable[..., Any]] = {name: getattr(np, name) for name in NUMPY} | closed_forms.FUNCTIONS
BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: np.divide,
    ast.Pow: np.power,
}
LANGUAGE = (ast.Constant, ast.Name, ast.Load, ast.UnaryOp, ast.USub, ast.BinOp, *BINARY, ast.Call)


class ExpressionError(ValueError):
    """Text that is no expression; the message says what was expected."""


def parse(text: str) -> ast.expr:
    """The expression's tree, with nothing in it but the language above.

    Raises:
        ExpressionError: For anything else.
    """
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError):
        raise ExpressionError("arithmetic that can be parsed") from None
    for node in ast.walk(tree):
        number = not isinstance(node, ast.Constant) or type(node.value) in (int, float)
        if not isinstance(node, LANGUAGE) or not number:
            raise ExpressionError("numbers, names, + - * / **, parentheses and functions")
        if isinstance(node, ast.Call):
            name = ast.unparse(node.func)
            if name not in FUNCTIONS:
                raise ExpressionError(f"one of the functions {', '.join(FUNCTIONS)}")
            function = FUNCTIONS[name]
            wanted = function.nin if isinstance(function, np.ufunc) else len(inspect.signature(function).parameters)
            if len(node.args) != wanted or node.keywords:
                raise ExpressionError(f"{name} with {wanted} argument{'s' if wanted > 1 else ''}")
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
        case ast.Name(id=name):
            return float(np.pi) if name == "pi" else values[name]
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
