"""Arithmetic of a record set as LaTeX, so that a formula on a page is the one that was computed."""

from __future__ import annotations

import ast

LETTERS = "alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi pi rho sigma tau phi chi psi omega"
GREEK = LETTERS.split()
SIGNS = {ast.Add: "+", ast.Sub: "-"}
BRACKETS = {"abs": "|{}|", "sqrt": r"\sqrt{{{}}}", "exp": "e^{{{}}}", "floor": r"\lfloor {} \rfloor"}
ATOM, POWER, PRODUCT, SUM = 3, 2, 1, 0


def latex(tree: ast.expr) -> str:
    """The expression as LaTeX; `k_p` has a subscript, `tau` is the Greek letter, a division stands as a fraction."""
    return _set(tree)[0]


def _set(tree: ast.expr) -> tuple[str, int]:
    """The LaTeX, and how tightly its outermost operation binds."""
    match tree:
        case ast.Constant(value=int() | float() as value):
            return f"{value:g}", ATOM
        case ast.Name(id=name):
            return _symbol(name), ATOM
        case ast.UnaryOp(operand=operand):
            return f"-{_within(operand, PRODUCT)}", SUM
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            return f"{_within(left, ATOM)}^{{{latex(right)}}}", POWER
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return rf"\frac{{{latex(left)}}}{{{latex(right)}}}", POWER
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            sign = r"\cdot" if isinstance(right, ast.Constant) or _begins_with_number(right) else r"\,"
            return rf"{_within(left, PRODUCT)} {sign} {_within(right, PRODUCT)}", PRODUCT
        case ast.BinOp(left=left, op=op, right=right):
            inner = PRODUCT if isinstance(op, ast.Sub) else SUM
            return f"{latex(left)} {SIGNS[type(op)]} {_within(right, inner)}", SUM
        case ast.Call(func=ast.Name(id=name), args=args):
            return _call(name, args)
    raise AssertionError(ast.dump(tree))


def _call(name: str, args: list[ast.expr]) -> tuple[str, int]:
    if name in BRACKETS:
        return BRACKETS[name].format(latex(args[0])), POWER if name == "exp" else ATOM
    if name == "bits":
        return rf"({_within(args[0], ATOM)} \wedge {_within(args[1], ATOM)})", ATOM
    function = {"minimum": r"\min", "maximum": r"\max"}.get(
        name, rf"\{name}" if len(args) == 1 else rf"\text{{{name}}}"
    )
    inner, tight = _set(args[0]) if len(args) == 1 else (", ".join(map(latex, args)), SUM)
    return (f"{function} {inner}", PRODUCT) if tight == ATOM else (f"{function}({inner})", ATOM)


def _within(tree: ast.expr, tightness: int) -> str:
    inner, tight = _set(tree)
    return inner if tight >= tightness else f"({inner})"


def _begins_with_number(tree: ast.expr) -> bool:
    while isinstance(tree, ast.BinOp) and not isinstance(tree.op, ast.Div):
        tree = tree.left
    return isinstance(tree, ast.Constant)


def _symbol(name: str) -> str:
    base, _, below = name.partition("_")
    letter = rf"\{base}" if base in GREEK else base if len(base) == 1 else rf"\text{{{base}}}"
    return letter + (f"_{below}" if len(below) == 1 else rf"_\text{{{below}}}" if below else "")
