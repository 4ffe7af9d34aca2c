"""Figures: broken against fixed, as SVG in two palettes."""

from __future__ import annotations

import io
import math
from collections.abc import Callable
from functools import partial
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from clinic.pages.figures.palette import BROKEN, DASHES, FIXED, GRID, INK, darkened
from clinic.pages.figures.sweep_plot import sweep_plot, write_numbers
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.record.case import Case
from clinic.record.prose import quantity

SIZE = (4.8, 3.0)
EXPLODED = 50.0


def figures(case: Case, evidence: Evidence) -> dict[str, bytes]:
    """The case's plots, light and dark: `plot-light.svg`, and `sweep-<name>-light.svg` for each sweep."""
    drawn = {"plot": plot(case, evidence)}
    for name, swept in evidence.sweep.items():
        sweep = case.record.sweep[name]
        draw = partial(sweep_plot, sweep=sweep, outcome=axis_label(case, sweep.outcome.signal), swept=swept)
        drawn[f"sweep-{name}"] = figure(case, draw)
    light = {f"{name}-light.svg": svg.encode() for name, svg in drawn.items()}
    return light | {f"{name}-dark.svg": darkened(svg).encode() for name, svg in drawn.items()}


def axis_label(case: Case, name: str) -> str:
    """A signal's label with its unit in brackets."""
    signal = case.record.signals[name]
    return (signal.label or name) + (f" [{signal.unit}]" if signal.unit else "")


def plot(case: Case, evidence: Evidence) -> str:
    """The first signal of the broken variant and of every fix, over time; its final values when none changes."""
    name = next(iter(case.record.signals))
    shown = {key: v for key, v in evidence.variants.items() if v.kind != "refuted"}
    label = axis_label(case, name)

    def draw(axes: Axes) -> None:
        if all(_constant(variant.traces[name].value) for variant in shown.values()):
            _dots(axes, shown, name, label)
        else:
            _lines(axes, shown, name, label)

    return figure(case, draw)


def figure(case: Case, draw: Callable[[Axes], None]) -> str:
    """What `draw` draws, as SVG in the colours for a light page; the same drawing gives the same text."""
    settings: dict[Any, Any] = {
        "svg.hashsalt": case.slug,
        "text.parse_math": False,
        "font.size": 9.5,
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
    with mpl.rc_context():
        mpl.rcdefaults()  # whatever the user's matplotlibrc says
        mpl.rcParams.update(settings)
        made = Figure(figsize=SIZE, layout="constrained")
        draw(made.add_subplot())
        out = io.StringIO()
        made.savefig(out, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    return out.getvalue()


def _lines(axes: Axes, shown: dict[str, VariantEvidence], name: str, label: str) -> None:
    fixes = 0
    for key, variant in shown.items():
        trace = variant.traces[name]
        value = [math.nan if v is None else v for v in trace.value]
        colour, dash, title = BROKEN, "-", "broken"
        if variant.kind == "fix":
            colour, dash, title = FIXED[fixes % 3], DASHES[fixes % 3], key
            fixes += 1
        marker = "o" if variant.timestep is None else None
        axes.plot(trace.time, value, color=colour, linestyle=dash, linewidth=1.8, label=title, marker=marker)
    if any(variant.timestep for variant in shown.values()):
        axes.set_xlabel("time [s]")
    else:
        axes.set_xlabel("line of output")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(label)
    axes.grid(visible=True, linewidth=0.6)
    _tame(axes, shown, name)
    axes.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, handlelength=2.6)


def _tame(axes: Axes, shown: dict[str, VariantEvidence], name: str) -> None:
    """Compresses the axis when the broken run leaves the others' range by far."""
    spread = {key: _extent(variant, name) for key, variant in shown.items()}
    usual = max((extent for key, extent in spread.items() if key != "broken"), default=0.0)
    if usual > 0 and spread.get("broken", 0.0) > EXPLODED * usual:
        axes.set_yscale("symlog", linthresh=10 ** math.ceil(math.log10(usual)))
        write_numbers(axes.yaxis)


def _dots(axes: Axes, shown: dict[str, VariantEvidence], name: str, label: str) -> None:
    finals = {key: variant.values[name]["final"] for key, variant in shown.items()}
    unit = next(iter(shown.values())).traces[name].unit
    for row, (key, value) in enumerate(finals.items()):
        if value is None:
            axes.text(0, row, "  not measured", va="center")
            continue
        broken = shown[key].kind == "broken"
        colour = BROKEN if broken else FIXED[(row - 1) % 3]
        axes.plot([0, value], [row, row], color=colour, linewidth=2, linestyle="-" if broken else DASHES[(row - 1) % 3])
        axes.plot([value], [row], color=colour, marker="X" if broken else "o", markersize=9, linestyle="")
        axes.annotate(quantity(value, unit), (value, row), xytext=(0, 9), textcoords="offset points", ha="center")
    axes.set_yticks(range(len(finals)), list(finals))
    axes.set_ylim(len(finals) - 0.4, -0.7)
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.margins(x=0.15)
    axes.set_xlabel(label)
    axes.grid(visible=True, axis="x", linewidth=0.6)


def _constant(values: list[float | None]) -> bool:
    return len(set(values)) <= 1


def _extent(variant: VariantEvidence, name: str) -> float:
    values = [abs(v) for v in variant.traces[name].value if v is not None]
    return float(np.max(values)) if values else 0.0
