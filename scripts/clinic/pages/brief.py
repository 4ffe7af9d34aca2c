"""A case in a line of numbers, for lists: what was measured of the broken model, and what of the repaired one."""

from __future__ import annotations

from typing import NamedTuple

from clinic.pages.text.claim import TAKE_WORDS
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.prose import quantity

WHEN = {
    "final": "at the end",
    "first": "at first",
    "max": "at its highest",
    "min": "at its lowest",
    "mean": "on average",
    "span": "from lowest to highest",
    "onset": "from",
}
SMALL = 1e-3  # m; what is less is told in mm, and what it is compared with too
NOTHING = 1e-3  # of the other number, or of one; less is told as zero


class Brief(NamedTuple):
    """What is measured, and its value in the broken and the repaired variant."""

    measured: str
    broken: str
    repaired: str


def brief(case: Case, evidence: Evidence) -> Brief | None:
    """The first number that the repaired model has as it should be and the broken one has not.

    Numbers of the record's first signal come first: it is the one that the plot shows.
    """
    broken, fix = evidence.variants["broken"], evidence.variants[case.record.fixes[0].id]
    plotted = next(iter(case.record.signals))
    pairs = sorted(
        zip(broken.checks["fixed"], fix.checks["fixed"], strict=True), key=lambda pair: pair[0].signal != plotted
    )
    for was, now in pairs:
        if was.holds or was.measured is None or now.measured is None:
            continue
        signal = case.record.signals[was.signal]
        unit = "s" if was.take == "onset" else signal.unit
        large = max(abs(was.measured), abs(now.measured))
        values = [v if abs(v) > NOTHING * min(large, 1.0) else 0.0 for v in (was.measured, now.measured)]
        if unit == "m" and any(0 < abs(v) < SMALL for v in values):
            values, unit = [1e3 * v for v in values], "mm"
        told = (quantity(v, unit, 3) for v in values)
        return Brief(f"{signal.label or was.signal}{_when(case, was.signal, was.take)}", *told)
    return None


def _when(case: Case, name: str, take: str) -> str:
    """Of which moment the number is; what is measured or printed once has none of its own."""
    if hasattr(case.record.signals[name], "measure"):
        return ""
    if case.record.script is None:
        return f" {WHEN[take]}"
    return "" if take in ("final", "first") else f", {TAKE_WORDS[take]}"
