"""Checks: one number taken from a signal, compared with a bound."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from clinic.record.parts import Check, Comparison, Interval, Take

TAKES: tuple[Take, ...] = get_args(Take)
OVER_ALL: dict[str, Callable[..., float]] = {"min": np.min, "max": np.max, "mean": np.mean, "span": np.ptp}


@dataclass(frozen=True)
class Trace:
    """A signal's samples.

    Args:
        time: Simulated time of each sample in s, shape (n,), increasing.
        value: The samples, shape (n,), in the signal's unit; not a number where there was nothing to read.
    """

    time: NDArray[np.float64]
    value: NDArray[np.float64]


@dataclass(frozen=True)
class Verdict:
    """A check's outcome: the measured number, and whether it satisfies the check."""

    measured: float
    holds: bool


def take(trace: Trace, which: Take, window: Interval | None = None) -> float:
    """Takes one number from a trace; not a number when there is no sample to take it from.

    Samples that are not numbers are skipped, except by `final` and `first`.
    """
    time, value = trace.time, trace.value
    if window is not None:
        inside = (time >= window[0]) & (time <= window[1])
        time, value = time[inside], value[inside]
    if which in ("final", "first"):
        return float(value[-1 if which == "final" else 0]) if len(value) else math.nan
    seen = ~np.isnan(value)
    time, value = time[seen], value[seen]
    if not len(value):
        return math.nan
    if which == "onset":
        return float(time[np.argmax(value != 0)]) if np.any(value != 0) else math.nan
    return float(OVER_ALL[which](value))


def judge(check: Check, traces: Mapping[str, Trace]) -> Verdict:
    """Measures a check and says whether it holds. A number that could not be measured satisfies no check."""
    measured = take(traces[check.signal], check.take, check.window)
    return Verdict(measured, satisfies(check, measured))


def satisfies(check: Comparison, measured: float) -> bool:
    """Whether a measured number satisfies the check's comparison; what is not a number satisfies none."""
    if check.above is not None:
        return measured > check.above
    if check.below is not None:
        return measured < check.below
    if check.between is not None:
        return check.between[0] <= measured <= check.between[1]
    assert check.equals is not None
    return abs(measured - check.equals) <= (check.within or 0.0)


def expected(check: Comparison, show: Callable[[float], str] = "{:g}".format) -> str:
    """The comparison in words, without the unit: `between 0.505 and 0.52`."""
    if check.above is not None:
        return f"above {show(check.above)}"
    if check.below is not None:
        return f"below {show(check.below)}"
    if check.between is not None:
        return f"between {show(check.between[0])} and {show(check.between[1])}"
    assert check.equals is not None
    return f"{show(check.equals)} ± {show(check.within)}" if check.within else f"exactly {show(check.equals)}"
