"""A check in words, as the pages, the terminal and the playground say it."""

from __future__ import annotations

from clinic.engine.checks import expected
from clinic.record.case import Case
from clinic.record.parts import Check, Interval

TAKE_WORDS = {
    "final": "at the end",
    "first": "after one step",
    "min": "lowest",
    "max": "highest",
    "mean": "mean",
    "span": "span",
    "onset": "first differs from zero at",
}
PRINTED = {"final": "last printed", "first": "first printed"}


def claim(case: Case, check: Check) -> str:
    """What a check says: `height of the box, at the end: 0.05 ± 0.001 m`."""
    unit = "s" if check.take == "onset" else case.record.signals[check.signal].unit
    return f"{taken(case, check.signal, check.take, check.window)}: {expected(check)} {unit}".rstrip()


def taken(case: Case, name: str, take: str, window: Interval | None) -> str:
    """What is taken of a signal: `height of the box, at the end, 1 to 2 s`."""
    signal = case.record.signals[name]
    words = {**TAKE_WORDS, **(PRINTED if case.record.script is not None else {})}[take]
    words = "" if hasattr(signal, "measure") else f", {words}"
    span = f", {window[0]:g} to {window[1]:g} s" if window else ""
    return f"{signal.label or name}{words}{span}"
