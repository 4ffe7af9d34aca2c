"""All signals of a variant: read from runs, computed from each other, or measured over many runs."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

import mujoco
import numpy as np

from clinic.engine.checks import Trace, judge
from clinic.engine.render import geom_row
from clinic.engine.script import Output
from clinic.engine.signals import Path, parse_path
from clinic.engine.simulate import Nudge, Run, simulate, state_at
from clinic.record.expression import ExpressionError, evaluate, parse
from clinic.record.expression import names as names_in
from clinic.record.fields import ExpressionSignal, PathSignal, Record, RowSignal, RunSpec, StartsSignal


class SampleError(ValueError):
    """An expression that cannot be computed from the samples: what was found, expected, and the repair."""

    def __init__(self, signal: str, found: str, expected: str, repair: str) -> None:
        self.signal, self.found, self.expected, self.repair = signal, found, expected, repair
        super().__init__(signal, found, expected, repair)

    def __str__(self) -> str:
        return f"{self.signal}: {self.found}"


def paths(record: Record, wanted: Collection[str] | None = None) -> dict[str, Path]:
    """The parsed path signals of a record, by name; only those that the signals in `wanted` need, if given."""
    needed = set(record.signals if wanted is None else wanted)
    for name in list(needed):
        signal = record.signals[name]
        needed |= names_in(parse(signal.expr)) if isinstance(signal, ExpressionSignal) else set()
    found = {name: s for name, s in record.signals.items() if name in needed and isinstance(s, PathSignal)}
    return {name: parse_path(signal.path) for name, signal in found.items()}


def measure_model(
    record: Record,
    model: mujoco.MjModel,
    spec: RunSpec,
    wanted: Collection[str] | None = None,
    nudge: Nudge | None = None,
    data: mujoco.MjData | None = None,
    last: bool = False,
) -> tuple[Run, dict[str, Trace]]:
    """Simulates the model and gives the run with every signal of the record, or with those in `wanted`.

    `nudge`, `data` and `last` are as `simulate` takes them.

    Raises:
        RunError, SignalError: If the run or a signal does not fit the model.
        RenderError: If a signal asks for an image, and this machine cannot draw it.
    """
    run = simulate(model, spec, paths(record, wanted), nudge, data, last)
    traces = with_expressions(record, run.traces)
    names = [name for name in record.signals if wanted is None or name in wanted]
    for name in names:
        signal = record.signals[name]
        if isinstance(signal, StartsSignal):
            traces[name] = _single(fraction_of_starts(record, signal, model, spec))
        elif isinstance(signal, RowSignal):
            traces[name] = _single(image_row(signal, model, spec))
    return run, {name: traces[name] for name in names}


def measure_output(record: Record, output: Output) -> dict[str, Trace]:
    """Every signal of a code case, from what its script printed; an empty trace where it printed nothing."""
    printed = output.traces()
    empty = Trace(np.empty(0), np.empty(0))
    return with_expressions(record, {name: printed.get(path.name, empty) for name, path in paths(record).items()})


def with_expressions(record: Record, traces: Mapping[str, Trace]) -> dict[str, Trace]:
    """The traces and, computed from them sample by sample, every expression signal that they suffice for.

    Raises:
        SampleError: If an expression reads signals with different numbers of samples, or a function cannot take them.
    """
    made = dict(traces)
    values = {name: trace.value for name, trace in traces.items()}
    for name, signal in record.signals.items():
        if isinstance(signal, ExpressionSignal):
            tree = parse(signal.expr)
            if (read := names_in(tree)) <= traces.keys():
                counts = {key: len(values[key]) for key in sorted(read)}
                if 0 in counts.values():
                    made[name] = Trace(np.empty(0), np.empty(0))
                    continue
                if len(set(counts.values())) > 1:
                    found = "samples that do not pair up: " + ", ".join(f"{key} has {n}" for key, n in counts.items())
                    expected, repair = "signals with equally many samples", "print each as often as the others"
                    raise SampleError(name, found, expected, repair)
                time = next((traces[key].time for key in [*counts, *traces]), np.zeros(1))
                try:
                    with np.errstate(all="ignore"):
                        value = np.asarray(evaluate(tree, values), float)
                except ExpressionError as error:
                    raise SampleError(name, signal.expr, str(error), "correct the expression") from None
                made[name] = Trace(time, np.broadcast_to(value, time.shape))
    return made


def fraction_of_starts(record: Record, signal: StartsSignal, model: mujoco.MjModel, spec: RunSpec) -> float:
    """The share of evenly spaced start positions from which `signal.holds` holds, 0 to 1."""
    path = {signal.holds.signal: paths(record)[signal.holds.signal]}
    kept = mujoco.MjData(model)

    def held_from(offset: float) -> bool:
        def nudge(_: mujoco.MjModel, data: mujoco.MjData) -> None:
            data.joint(signal.joint).qpos[signal.index] += offset

        return judge(signal.holds, simulate(model, spec, path, nudge, kept, signal.holds.last).traces).holds

    held = [held_from(offset) for offset in np.linspace(*signal.offset, signal.count)]
    return math.fsum(held) / signal.count


def image_row(signal: RowSignal, model: mujoco.MjModel, spec: RunSpec) -> float:
    """The mean row of a geom's pixels at the start of the run; 0 is the image's top edge, 1 its bottom."""
    return geom_row(model, state_at(model, spec, 0.0), signal.camera, signal.geom)


def _single(value: float) -> Trace:
    return Trace(np.zeros(1), np.array([value]))
