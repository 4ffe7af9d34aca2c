"""All signals of a variant: read from runs, computed from each other, or measured over many runs."""

from __future__ import annotations

import math
from collections.abc import Mapping

import mujoco
import numpy as np

from clinic.case import Case
from clinic.checks import Trace, judge
from clinic.expression import evaluate, parse
from clinic.record import ExpressionSignal, PathSignal, Record, RowSignal, RunSpec, StartsSignal
from clinic.render import geom_row
from clinic.script import Output
from clinic.signals import Path, parse_path
from clinic.simulate import Run, simulate, state_at


def paths(record: Record) -> dict[str, Path]:
    """The parsed path signals of a record, by name."""
    return {name: parse_path(s.path) for name, s in record.signals.items() if isinstance(s, PathSignal)}


def measure_model(case: Case, model: mujoco.MjModel, spec: RunSpec) -> tuple[Run, dict[str, Trace]]:
    """Simulates the model and gives the run with every signal of the record.

    Raises:
        RunError, SignalError: If the run or a signal does not fit the model.
    """
    run = simulate(model, spec, paths(case.record))
    traces = with_expressions(case.record, run.traces)
    for name, signal in case.record.signals.items():
        if isinstance(signal, StartsSignal):
            traces[name] = _single(fraction_of_starts(case.record, signal, model, spec))
        elif isinstance(signal, RowSignal):
            traces[name] = _single(image_row(signal, model, spec))
    return run, {name: traces[name] for name in case.record.signals}


def measure_output(record: Record, output: Output) -> dict[str, Trace]:
    """Every signal of a code case, from what its script printed; an empty trace where it printed nothing."""
    printed = output.traces()
    empty = Trace(np.empty(0), np.empty(0))
    return with_expressions(record, {name: printed.get(path.name, empty) for name, path in paths(record).items()})


def with_expressions(record: Record, traces: Mapping[str, Trace]) -> dict[str, Trace]:
    """The traces and, computed from them sample by sample, the record's expression signals."""
    made = dict(traces)
    for name, signal in record.signals.items():
        if isinstance(signal, ExpressionSignal):
            time = next(iter(traces.values())).time
            with np.errstate(all="ignore"):
                value = evaluate(parse(signal.expr), {key: trace.value for key, trace in traces.items()})
            made[name] = Trace(time, np.broadcast_to(np.asarray(value, dtype=float), time.shape))
    return made


def fraction_of_starts(record: Record, signal: StartsSignal, model: mujoco.MjModel, spec: RunSpec) -> float:
    """The share of evenly spaced start positions from which `signal.holds` holds, 0 to 1."""
    address = model.joint(signal.joint).qposadr[0] + signal.index
    path = {signal.holds.signal: paths(record)[signal.holds.signal]}
    offsets = np.linspace(*signal.offset, signal.count)
    held = [
        judge(signal.holds, simulate(model, spec, path, {address: float(offset)}).traces).holds for offset in offsets
    ]
    return math.fsum(held) / signal.count


def image_row(signal: RowSignal, model: mujoco.MjModel, spec: RunSpec) -> float:
    """The mean row of a geom's pixels at the start of the run; 0 is the image's top edge, 1 its bottom."""
    return geom_row(model, state_at(model, spec, 0.0), signal.camera, signal.geom)


def _single(value: float) -> Trace:
    return Trace(np.zeros(1), np.array([value]))
