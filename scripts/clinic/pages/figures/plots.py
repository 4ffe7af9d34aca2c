"""The plots of a case, as SVG for light and dark pages: its first signal, broken against fixed, and its sweeps."""

from __future__ import annotations

import io
import math
from collections.abc import Callable
from functools import partial
from typing import Any, cast

from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from clinic.pages.figures.palette import BROKEN, GRID, INK, fix_style, with_dark_scheme
from clinic.pages.figures.sweep_plot import axis_label, largest, numbers, sweep_plot, write_numbers
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.record.case import Case
from clinic.record.prose import quantity
from clinic.work.cache import Files

SIZE = (4.8, 3.0)
EXPLODED = 50.0
SETTINGS: dict[Any, Any] = {
    "text.parse_math": False,
    "font.size": 9.5,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    "axes.edgecolor": GRID,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "grid.color": GRID,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
}


def plots(case: Case, evidence: Evidence) -> Files:
    """`plot.svg`, and `sweep-<name>.svg` for each sweep; the same evidence gives the same bytes."""
    name, signal = next(iter(case.record.signals.items()))
    shown = {key: variant for key, variant in evidence.variants.items() if variant.kind != "refuted"}
    constant = all(len(set(variant.traces[name].value)) <= 1 for variant in shown.values())
    draw = partial(_final_values if constant else _traces, shown=shown, name=name)
    made = {"plot.svg": _svg(case, partial(draw, label=axis_label(signal.label or name, signal.unit)))}
    for name, swept in evidence.sweep.items():
        sweep = case.record.sweep[name]
        signal = case.record.signals[sweep.outcome.signal]
        outcome = signal.label or sweep.outcome.signal
        draw_sweep = partial(sweep_plot, sweep=sweep, outcome=outcome, unit=signal.unit, swept=swept)
        made[f"sweep-{name}.svg"] = _svg(case, draw_sweep)
    return made


def _svg(case: Case, draw: Callable[[Axes], None]) -> bytes:
    with style.context(["default", SETTINGS | {"svg.hashsalt": case.slug}]):  # whatever the user's matplotlibrc says
        figure = Figure(figsize=SIZE, layout="constrained")
        draw(figure.add_subplot())
        out, canvas = io.StringIO(), cast(Any, FigureCanvasSVG(figure))
        canvas.print_svg(out, metadata={"Date": None, "Creator": None})  # savefig draws twice
    return with_dark_scheme(out.getvalue()).encode()


def _traces(axes: Axes, shown: dict[str, VariantEvidence], name: str, label: str) -> None:
    """Draws the signal of every variant over time, or over a script's lines of output."""
    over_time = any(variant.timestep for variant in shown.values())
    fixes = [key for key, variant in shown.items() if variant.kind == "fix"]
    values = {key: numbers(variant.traces[name].value) for key, variant in shown.items()}
    marker = None if over_time else "o"
    for key, variant in shown.items():
        look = fix_style(fixes.index(key)) if key in fixes else {"color": BROKEN}
        axes.plot(variant.traces[name].time, values[key], linewidth=1.8, label=key, marker=marker, **look)
    axes.set_xlabel("time [s]" if over_time else "printed values, in turn")
    if not over_time:
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(label)
    axes.grid(visible=True, linewidth=0.6)
    usual = max((largest(values[key]) for key in fixes), default=0.0)
    if 0 < EXPLODED * usual < largest(values["broken"]):
        axes.set_yscale("symlog", linthresh=10 ** math.ceil(math.log10(usual)))
        write_numbers(axes.yaxis)
    axes.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, handlelength=2.6)


def _final_values(axes: Axes, shown: dict[str, VariantEvidence], name: str, label: str) -> None:
    """Draws a bar from zero to the last value of each variant."""
    for row, variant in enumerate(shown.values()):
        value = variant.values[name]["final"]
        if value is None:
            axes.text(0, row, "  not measured", va="center")
            continue
        broken = variant.kind == "broken"
        look = {"color": BROKEN} if broken else fix_style(row - 1)
        axes.plot([0, value], [row, row], linewidth=2, **look)
        axes.plot([value], [row], **look | {"marker": "X" if broken else "o", "markersize": 9, "linestyle": ""})
        text = quantity(value, variant.traces[name].unit)
        axes.annotate(text, (value, row), xytext=(0, 9), textcoords="offset points", ha="center")
    axes.set_yticks(range(len(shown)), list(shown))
    axes.set_ylim(len(shown) - 0.4, -0.7)
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.margins(x=0.15)
    axes.set_xlabel(label)
    axes.grid(visible=True, axis="x", linewidth=0.6)
