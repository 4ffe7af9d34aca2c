"""How triage words what it finds: findings, and numbers of a few digits that are never a failure."""

from __future__ import annotations

import math
from typing import NamedTuple

from clinic.record.prose import quantity


class Finding(NamedTuple):
    """Something unusual: the rule that saw it, the element it saw it at, and what it saw, in words."""

    rule: str
    element: str
    text: str


StepResult = tuple[str, list[Finding]]  # what a step looked at and measured, and what it found


def format_number(value: float, unit: str = "", digits: int = 3) -> str:
    """The number with its unit, whether finite or not."""
    value = float(value)
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else "infinity"
    return quantity(value, unit, digits)


def counted(n: int, one: str, many: str | None = None) -> str:
    """`1 body`, `2 bodies`."""
    return f"{n} {one if n == 1 else many or one + 's'}"
