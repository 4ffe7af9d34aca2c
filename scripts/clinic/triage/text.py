"""How triage prints numbers: a few digits, and never a failure."""

from __future__ import annotations

import math

from clinic.record.prose import quantity


def shown(value: float, unit: str, digits: int = 3) -> str:
    """The number with its unit, whether finite or not."""
    value = float(value)
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else "infinity"
    return quantity(value, unit, digits)


def counted(n: int, one: str, many: str | None = None) -> str:
    """`1 body`, `2 bodies`."""
    return f"{n} {one if n == 1 else many or one + 's'}"
