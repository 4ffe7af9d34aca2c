"""The equations of a record, set for the page and held against what its runs measured."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress

import numpy as np

from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.expression import ExpressionError, evaluate, parse
from clinic.record.fields import Formula
from clinic.record.latex import latex
from clinic.record.problem import Problem
from clinic.record.sweep import Sweep

RELATION = re.compile(r"[=~]")
NEIGHBOURS = {"sin": ["cos"], "cos": ["sin"], "tan": ["sin"]}
SAME = 1e-12
SIGNS = {"=": "=", "~": r"\approx"}


def sides_as_latex(says: str) -> dict[str, str]:
    """The `left` and the `right` side of an equation, and the `whole` of it, as LaTeX."""
    sides = [latex(parse(side)) for side in RELATION.split(says)]
    signs = [SIGNS[sign] for sign in RELATION.findall(says)]
    whole = sides[0] + "".join(f" {sign} {side}" for sign, side in zip(signs, sides[1:], strict=True))
    return {"left": sides[0], "right": sides[-1], "whole": whole}


def formulas(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, equations. The sides of each agree with what was measured, those of a wrong one do not."""
    for name, formula in case.record.formulas.items():
        where, repair = ("formulas", name, "says"), "correct the equation or its `where`"
        try:
            apart = largest_difference(case, evidence, formula)
        except (ExpressionError, KeyError, TypeError) as error:
            found = f"{formula.says}: {error.args[0] if error.args else error}"
            yield case.problem(where, found, f"sides that can be computed for {formula.of}", repair)
            continue
        if not apart <= formula.within:
            found = f"{formula.says}: its sides differ by {100 * apart:.3g} % of the largest"
            yield case.problem(where, found, f"at most {100 * formula.within:g} % for {formula.of}", repair)
            continue
        for wrong in mutants(formula.says):
            with suppress(ExpressionError):
                off = largest_difference(case, evidence, formula.model_copy(update={"says": wrong}))
                if off <= formula.within and abs(off - apart) > SAME:  # none: a quantity of 1, whose powers are alike
                    found, wanted = f"agrees as well when it says {wrong}", "an equation of which a wrong one disagrees"
                    repair = "lessen `within`, or choose an `of` that can tell"
                    yield case.problem((*where[:2], "within"), found, wanted, repair)


def mutants(says: str) -> Iterator[str]:
    """The equation with each number doubled and halved, each symbol larger or squared, each function its neighbour."""
    sides, signs = [parse(side) for side in RELATION.split(says)], [*RELATION.findall(says), ""]
    for side in sides:
        called = {id(node.func) for node in ast.walk(side) if isinstance(node, ast.Call)}
        for node in ast.walk(side):
            if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
                own, changed = "value", [str(2 * node.value), str(node.value / 2)]
            elif isinstance(node, ast.Name) and id(node) in called:
                own, changed = "id", NEIGHBOURS.get(node.id, [])
            elif isinstance(node, ast.Name) and node.id != "pi":
                own, changed = "id", [f"(1.5 * {node.id})", f"({node.id} * {node.id})"]
            else:
                continue
            kept = getattr(node, own)
            for value in changed:
                setattr(node, own, float(value) if own == "value" else value)
                yield "".join(f"{ast.unparse(each)} {sign} " for each, sign in zip(sides, signs, strict=True)).strip()
            setattr(node, own, kept)


def largest_difference(case: Case, evidence: Evidence, formula: Formula) -> float:
    """The largest difference between sides over the situations of a formula, as a share of the largest side.

    It is NaN where a side is, and without a situation.

    Raises:
        ExpressionError, KeyError: If a side reads a name that there is not, or cannot be computed.
    """
    symbols = {symbol: parse(text) for symbol, text in formula.where.items()}
    sides = [parse(side) for side in RELATION.split(formula.says)]
    rows = []
    for known in _situations(case, evidence, formula.of):
        values = {symbol: evaluate(tree, known) for symbol, tree in symbols.items()}
        with np.errstate(invalid="ignore"):
            rows.append([float(evaluate(side, values)) for side in sides])
    if not rows:
        return float("nan")
    largest, apart = float(np.max(np.abs(rows))), float(np.max(np.ptp(rows, axis=1)))
    return apart / largest if largest else apart


def _situations(case: Case, evidence: Evidence, of: str) -> Iterator[Mapping[str, float]]:
    """The numbers that an equation may read: those of a variant, or of each point of a sweep."""
    kind, _, name = of.partition(".")
    sweep: Sweep | None = case.record.sweep[name] if kind == "sweep" else None
    variant = evidence.variants[of if sweep is None else sweep.base]
    known: dict[str, float] = {}
    for signal, takes in variant.values.items():
        known |= {f"{signal}_{take}": value for take, value in takes.items() if value is not None}
        known |= {signal: takes["final"]} if takes["final"] is not None else {}
    if variant.timestep is not None and variant.steps is not None:
        known |= {"timestep": variant.timestep, "duration": variant.timestep * variant.steps}
    if sweep is None:
        yield known
        return
    for point in evidence.sweep[name].points:
        told = {key.replace("-", "_"): value for key, value in point.predicted.items() if value is not None}
        yield {**known, **point.at, **told, **({} if point.outcome is None else {"outcome": point.outcome})}
