"""The plot of a sweep: measured points, the prediction over them, rivals dashed, the variants marked."""

from __future__ import annotations

import math
import re
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from numpy.typing import NDArray

from clinic.engine.checks import expected
from clinic.pages.figures.palette import BROKEN, DASHES, FIXED, INK, RIVAL
from clinic.proof.sweep import SweepEvidence
from clinic.record.prose import plain
from clinic.record.sweep import Parameter, Prediction, Sweep

MANY = 1e3  # the last number, or its ratio to the first, from which on an axis names powers of ten alone
SHORT = 24  # characters of a formula that a legend has room for
OPERATOR = re.compile(r" [-+·/] |\^")
NOUGHT = re.compile(r"(?<![\d.])0 ·")  # an expression that has a parameter and does not depend on it
WIDE = 60  # characters of the two longest labels, from which on a legend has one column


def axis_label(name: str, unit: str) -> str:
    """The name, with the unit in brackets."""
    return f"{name} [{unit}]" if unit else name


def numbers(values: list[float | None]) -> NDArray[np.float64]:
    """The values, NaN for those that are not there."""
    return np.array(values, dtype=float)


def largest(values: NDArray[np.float64]) -> float:
    """The largest magnitude among the values that are finite; 0 when there is none."""
    return float(np.abs(values[np.isfinite(values)]).max(initial=0))


def write_numbers(axis: Axis) -> None:
    """Labels a logarithmic axis with numbers as prose has them; by itself it writes TeX, which figures do not read."""
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))


def legend(prediction: Prediction) -> str:
    """What a prediction's line is called: its label, and its formula where that is short and no mere name."""
    formula = (
        prediction.expr.replace(" ** ", "^")
        .replace("*", "·")
        .replace("sqrt", "√")
        .replace("pi", "π")
        .replace("omega", "ω")
    )
    told = len(formula) <= SHORT and OPERATOR.search(formula) and not NOUGHT.search(formula)
    return f"{prediction.label}: {formula}" if told else prediction.label


def sweep_plot(axes: Axes, sweep: Sweep, outcome: str, unit: str, swept: SweepEvidence) -> None:
    """Draws a sweep's outcome, whose name is given, over its one parameter, or as a map of its two."""
    draw = _curve if len(sweep.vary) == 1 else _map
    draw(axes, sweep, outcome, unit, swept)
    axes.grid(visible=True, linewidth=0.6)
    lengths = sorted(len(label) for label in axes.get_legend_handles_labels()[1])
    columns = 2 if sum(lengths[-2:]) < WIDE else 1
    above: dict[str, Any] = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0)}
    axes.legend(frameon=False, ncols=columns, handlelength=2.4, fontsize=8.5, **above)


def _curve(axes: Axes, sweep: Sweep, outcome: str, unit: str, swept: SweepEvidence) -> None:
    (parameter,) = sweep.vary
    x = [point.at[parameter.name] for point in swept.points]
    y = numbers([point.outcome for point in swept.points])
    predicted = {key: numbers([point.predicted[key] for point in swept.points]) for key in _styles(sweep)}
    for key, style in _styles(sweep).items():
        axes.plot(x, predicted[key], **style)
    axes.plot(x, y, "o", color=INK, markersize=4, fillstyle="none", label="measured")
    _mark(axes, {name: (at[parameter.name], np.interp(at[parameter.name], x, y)) for name, at in swept.marks.items()})
    _scale(axes, "x", parameter)
    least, most = np.nanmin(np.abs(y), initial=math.inf), largest(y)
    if parameter.scale == "log" and 0 < least < most / 30:
        axes.set_yscale("log")
        write_numbers(axes.yaxis)
    elif max(map(largest, predicted.values())) > 3 * most > 0:
        axes.set_ylim(top=1.6 * most, bottom=min(0.0, np.nanmin(y)))
    axes.set_ylabel(axis_label(outcome, unit))


def _map(axes: Axes, sweep: Sweep, outcome: str, unit: str, swept: SweepEvidence) -> None:
    down, across = sweep.vary
    x, y = (np.array([point.at[parameter.name] for point in swept.points]) for parameter in (across, down))
    if sweep.holds is None:
        dots = axes.scatter(
            x,
            y,
            c=numbers([p.outcome for p in swept.points]),
            cmap="cividis",
            s=26,
            marker="s",
            edgecolors=INK,
            linewidths=0.4,
        )
        axes.figure.colorbar(dots, ax=axes).set_label(axis_label(outcome, unit), fontsize=8.5)
    else:
        holds = np.array([point.holds is True for point in swept.points])
        fails = np.array([point.holds is False for point in swept.points])
        size: dict[str, Any] = {"linestyle": "", "markersize": 3.2}
        axes.plot(
            x[holds],
            y[holds],
            marker="o",
            color=FIXED[0],
            label=f"{outcome} {expected(sweep.holds)} {unit}".strip(),
            **size,
        )
        axes.plot(x[fails], y[fails], marker="x", color=BROKEN, label="otherwise", **size)
        for key, style in _styles(sweep).items():
            predicted = numbers([point.predicted[key] for point in swept.points])
            known = [value for value in np.unique(x) if np.isfinite(predicted[x == value]).any()]
            axes.plot(known, [np.nanmedian(predicted[x == value]) for value in known], **style)
    _mark(axes, {name: (at[across.name], at[down.name]) for name, at in swept.marks.items()})
    _scale(axes, "x", across)
    _scale(axes, "y", down)
    if down.scale == "log":
        edge = max(1.07, (y.max() / y.min()) ** 0.03)
        axes.set_ylim(y.min() / edge, y.max() * edge)


def _styles(sweep: Sweep) -> dict[str, dict[str, Any]]:
    """How the line of each prediction is drawn."""
    made = {"prediction": {"label": legend(sweep.prediction), "color": FIXED[1], "linewidth": 1.8}}
    for k, rival in enumerate(sweep.rivals):
        made[rival.id] = {"label": legend(rival), "color": RIVAL, "linewidth": 1.6, "linestyle": DASHES[k % 3]}
    return made


def _mark(axes: Axes, places: dict[str, tuple[float, float]]) -> None:
    """Marks where the variants stand."""
    fixes = [name for name in places if name != "broken"]
    for name, (x, y) in places.items():
        if name == "broken":
            style: dict[str, Any] = {"marker": "X", "color": BROKEN, "markeredgewidth": 0.8}
        else:
            style = {"marker": "Ds^"[fixes.index(name) % 3], "color": "none", "markeredgewidth": 2.2}
        style |= {"markersize": 10, "markeredgecolor": INK, "zorder": 5, "clip_on": False}  # whole at an edge too
        axes.plot([x], [y], label=name, linestyle="", **style)


def _scale(axes: Axes, side: Literal["x", "y"], parameter: Parameter) -> None:
    """Labels an axis with the parameter, on its scale."""
    axes.set(**{f"{side}label": axis_label(parameter.label or parameter.name, parameter.unit)})
    if parameter.scale == "log":
        axes.set(**{f"{side}scale": "log"})
        axis: Axis = getattr(axes, f"{side}axis")
        low, high = axis.get_view_interval()
        axis.set_major_locator(LogLocator(subs=(1.0,) if high > MANY * min(low, 1.0) else (1.0, 2.0, 5.0)))
        write_numbers(axis)
        axis.set_minor_formatter(NullFormatter())
