"""The table of what the checks measured: a column for each number, a row for each outcome."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from clinic.engine.checks import expected, satisfies
from clinic.pages.text.claim import taken
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.record.case import Case
from clinic.record.parts import Check, Interval
from clinic.record.prose import plain, quantity

NOTHING = 1e-9  # of the largest that a signal was, or of what a check allows; less is what rounding left of zero
FINE = 1e-6  # of the largest that a signal was; a tolerance below it goes without saying
WELL, ILL = "\u00a0✓", "\u00a0✗"
MANY = 5  # columns; more do not fit beside each other
Column = tuple[str, str, Interval | None]  # a number taken from a signal: the signal, which number, over which window
Row = tuple[str, list[str]]


@dataclass(frozen=True)
class Table:
    """What was measured.

    Attributes:
        heads: What each column is.
        rows: A label and a cell for each column: what counts as broken and as repaired, then what was measured;
            variants that measured the same share a row.
        same: What every variant measured alike, in words.
        lists: Whether there are too many columns to stand beside each other.
    """

    heads: list[str]
    rows: list[Row]
    same: list[str]
    lists: bool


def table(case: Case, evidence: Evidence) -> Table:
    """The checks of a case as a table."""
    columns: dict[Column, dict[str, list[Check]]] = {}
    for kind, checks in case.record.checks:
        for check in checks:
            column = columns.setdefault((check.signal, check.take, check.window), {"broken": [], "fixed": []})
            column[kind].append(check)
    cells = {
        column: [_cell(evidence, variant, column, checks["fixed"]) for variant in evidence.variants.values()]
        for column, checks in columns.items()
    }
    alike = [column for column in columns if len(set(cells[column])) == 1 and len(columns) > 1]
    shown = [column for column in columns if column not in alike]
    rows = [
        (
            f"counts as {word}",
            ["; ".join(_expected(case, evidence, check) for check in columns[c][kind]) for c in shown],
        )
        for kind, word in (("broken", "broken"), ("fixed", "repaired"))
    ]
    rows += _outcomes(evidence, list(zip(*(cells[column] for column in shown), strict=True)))
    heads = [taken(case, *column) for column in shown]
    same = [f"{taken(case, *column)}: {cells[column][0].removesuffix(WELL)}" for column in alike]
    return Table(heads, rows, same, len(shown) > MANY)


def measure(value: float | None, name: str, evidence: Evidence, digits: int = 4) -> str:
    """A number that was taken from a signal, with its unit; what rounding left of zero is zero.

    Args:
        value: The number; None if there was none.
        name: The signal.
        evidence: All that was measured, which tells how large the signal gets.
        digits: How many significant ones to show.
    """
    if value is None:
        return "not measured"
    tiny = abs(value) < NOTHING * _largest(name, evidence)
    return quantity(0.0 if tiny else value, evidence.variants["broken"].traces[name].unit, digits)


def _largest(name: str, evidence: Evidence) -> float:
    """The largest magnitude of a signal in any run."""
    numbers = (
        variant.values.get(name, {}).get(end) for variant in evidence.variants.values() for end in ("min", "max")
    )
    return max((abs(number) for number in numbers if number is not None), default=0.0)


def _expected(case: Case, evidence: Evidence, check: Check) -> str:
    """What a check asks for."""
    unit = "s" if check.take == "onset" else case.record.signals[check.signal].unit
    if check.within and check.within < FINE * _largest(check.signal, evidence):
        check = check.model_copy(update={"within": None})
    return f"{expected(check, plain).removeprefix('exactly ')}\u00a0{unit}".strip()


def _cell(evidence: Evidence, variant: VariantEvidence, column: Column, wanted: list[Check]) -> str:
    """What was measured, and whether it is as the checks `wanted` ask."""
    signal, take, _ = column
    results = (result for kind in variant.checks.values() for result in kind)
    measured = next(result.measured for result in results if (result.signal, result.take, result.window) == column)
    if measured is not None and any(abs(measured) < NOTHING * (check.within or 0.0) for check in wanted):
        measured = 0.0
    at = take == "onset" and measured is not None
    value = quantity(measured or 0.0, "s", 4) if at else measure(measured, signal, evidence)
    if not wanted:
        return value
    holds = measured is not None and all(satisfies(check, measured) for check in wanted)
    return value + (WELL if holds else ILL)


def _outcomes(evidence: Evidence, cells: list[tuple[str, ...]]) -> Iterator[Row]:
    """A row for all variants that measured the same."""
    shared: dict[tuple[str, ...], list[str]] = {}
    for key, numbers in zip(evidence.variants, cells, strict=True):
        shared.setdefault(numbers, []).append(key)
    for numbers, keys in shared.items():
        yield _label(evidence, keys), list(numbers)


def _label(evidence: Evidence, keys: list[str]) -> str:
    """What a row is about: `broken, also after a, b`, `repaired: c`, `does not help: d`."""
    named = ", ".join(key for key in keys if key != "broken")
    if keys[0] == "broken":
        return f"broken, also after {named}" if named else "broken"
    return f"{'repaired' if evidence.variants[keys[0]].kind == 'fix' else 'does not help'}: {named}"
