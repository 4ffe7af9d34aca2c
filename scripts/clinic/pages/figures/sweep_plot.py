"""The figure of a sweep: measured points, the prediction over them, rivals dashed, the variants marked."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from clinic.pages.figures.palette import BROKEN, DASHES, FIXED, INK, RIVAL
from clinic.proof.sweep import Point, SweepEvidence
from clinic.record.prose import plain
from clinic.record.sweep import Parameter, Prediction, Sweep

MANY = 1e4  # of the last number to the first, from which on an axis names powers of ten alone


def sweep_plot(axes: Axes, sweep: Sweep, outcome: str, swept: SweepEvidence) -> None:
    """Draws the sweep: outcome over its one parameter, or a map of its two.

    Args:
        axes: Where to draw.
        sweep: The record's sweep.
        outcome: The label of the measured number with its unit.
        swept: The points and predictions.
    """
    if len(sweep.vary) == 1:
        _curve(axes, sweep, outcome, swept)
    else:
        _map(axes, sweep, outcome, swept)
    axes.grid(visible=True, linewidth=0.6)
    axes.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, handlelength=2.4, fontsize=8.5)


def write_numbers(axis: Axis) -> None:
    """Labels a logarithmic axis with numbers as prose has them; by itself it writes TeX, which figures do not read."""
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))


def _curve(axes: Axes, sweep: Sweep, outcome: str, swept: SweepEvidence) -> None:
    parameter = sweep.vary[0]
    x = [point.at[parameter.name] for point in swept.points]
    y = [_value(point.outcome) for point in swept.points]
    for key, prediction, style in _predictions(sweep):
        axes.plot(x, [_value(point.predicted[key]) for point in swept.points], label=prediction.label, **style)
    axes.plot(x, y, "o", color=INK, markersize=4, fillstyle="none", label="measured")
    for name, at, style in _marks(swept):
        value = at[parameter.name]
        axes.plot([value], [np.interp(value, x, y)], label=name, **style)
    _scale(axes, parameter, "x")
    measured = [abs(v) for v in y if math.isfinite(v)]
    drawn = [abs(v) for point in swept.points for v in point.predicted.values() if v is not None]
    if parameter.scale == "log" and min(measured, default=0) > 0 and max(measured) > 30 * min(measured):
        axes.set_yscale("log")
        write_numbers(axes.yaxis)
    elif max(drawn, default=0) > 3 * max(measured, default=1):
        axes.set_ylim(top=1.6 * max(measured), bottom=min(0.0, *y))
    axes.set_ylabel(outcome)


def _map(axes: Axes, sweep: Sweep, outcome: str, swept: SweepEvidence) -> None:
    down, across = sweep.vary
    if sweep.holds is None:
        dots = axes.scatter(
            [p.at[across.name] for p in swept.points],
            [p.at[down.name] for p in swept.points],
            c=[_value(p.outcome) for p in swept.points],
            cmap="cividis",
            s=26,
            marker="s",
        )
        bar = axes.figure.colorbar(dots, ax=axes)
        bar.set_label(outcome, fontsize=8.5)
    else:
        for answer, label, fill in ((True, sweep.yes, "full"), (False, sweep.no, "none")):
            chosen = [p for p in swept.points if p.holds is answer]
            axes.plot(
                [p.at[across.name] for p in chosen],
                [p.at[down.name] for p in chosen],
                linestyle="",
                marker="o" if answer else "x",
                markersize=3.2,
                fillstyle=fill,
                color=FIXED[0] if answer else BROKEN,
                label=label,
            )
        for key, prediction, style in _predictions(sweep):
            line = _boundary(swept.points, across, key)
            axes.plot([x for x, _ in line], [y for _, y in line], label=prediction.label, **style)
    for name, at, style in _marks(swept):
        axes.plot([at[across.name]], [at[down.name]], label=name, **style)
    _scale(axes, across, "x")
    _scale(axes, down, "y")
    values = sorted({p.at[down.name] for p in swept.points})
    edge = max(1.07, (values[-1] / values[0]) ** 0.03) if down.scale == "log" else 1.07
    axes.set_ylim(values[0] / edge, values[-1] * edge)


def _boundary(points: list[Point], across: Parameter, key: str) -> list[tuple[float, float]]:
    """The predicted line: the median prediction at each value of the parameter across."""
    values: dict[float, list[float]] = {}
    for point in points:
        if (predicted := point.predicted[key]) is not None:
            values.setdefault(point.at[across.name], []).append(predicted)
    return [(x, float(np.median(ys))) for x, ys in sorted(values.items())]


def _predictions(sweep: Sweep) -> list[tuple[str, Prediction, dict[str, Any]]]:
    made: list[tuple[str, Prediction, dict[str, Any]]] = [
        ("prediction", sweep.prediction, {"color": FIXED[1], "linewidth": 1.8})
    ]
    for k, rival in enumerate(sweep.rivals):
        made.append((rival.id, rival, {"color": RIVAL, "linewidth": 1.6, "linestyle": DASHES[k % 3]}))
    return made


def _marks(swept: SweepEvidence) -> list[tuple[str, dict[str, float], dict[str, Any]]]:
    made, fixes = [], 0
    for name, at in swept.marks.items():
        style: dict[str, Any] = {"linestyle": "", "markersize": 10, "markeredgewidth": 2.2, "zorder": 5}
        if name == "broken":
            style |= {"marker": "X", "color": BROKEN, "markeredgecolor": INK, "markeredgewidth": 0.8}
        else:
            style |= {"marker": "Ds^"[fixes % 3], "color": "none", "markeredgecolor": INK}
            fixes += 1
        made.append((name, at, style))
    return made


def _scale(axes: Axes, parameter: Parameter, side: str) -> None:
    label = (parameter.label or parameter.name) + (f" [{parameter.unit}]" if parameter.unit else "")
    (axes.set_xlabel if side == "x" else axes.set_ylabel)(label)
    if parameter.scale == "log":
        (axes.set_xscale if side == "x" else axes.set_yscale)("log")
        axis = axes.xaxis if side == "x" else axes.yaxis
        low, high = axes.get_xlim() if side == "x" else axes.get_ylim()
        axis.set_major_locator(LogLocator(subs=(1.0,) if high > MANY * low else (1.0, 2.0, 5.0)))
        write_numbers(axis)
        axis.set_minor_formatter(NullFormatter())


def _value(number: float | None) -> float:
    return math.nan if number is None else number
