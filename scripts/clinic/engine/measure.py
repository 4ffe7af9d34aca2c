"""All signals of a variant, read from runs, computed or measured over many runs; and numbers of the compiled model."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

import mujoco
import numpy as np

from clinic.engine.checks import Trace, judge
from clinic.engine.releases import mass_matrix
from clinic.engine.render import geom_row
from clinic.engine.script import printed_numbers
from clinic.engine.signals import Path, parse_path
from clinic.engine.simulate import Nudge, Run, RunError, data_at, simulate
from clinic.record.expression import ExpressionError, evaluate, parse
from clinic.record.expression import names as names_in
from clinic.record.fields import Record, RunSpec
from clinic.record.signal import ExpressionSignal, PathSignal, RowSignal, StartsSignal

NOTHING = Trace(np.empty(0), np.empty(0))


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
) -> tuple[Run, dict[str, Trace]]:
    """Simulates the model and gives the run with every signal of the record, or with those in `wanted`.

    `nudge` changes the start, as `simulate` takes it.

    Raises:
        RunError, SignalError: If the run or a signal does not fit the model.
        RenderError: If a signal asks for an image, and this machine cannot draw it.
    """
    run = simulate(model, spec, paths(record, wanted), nudge)
    traces = with_expressions(record, run.traces)
    names = [name for name in record.signals if wanted is None or name in wanted]
    for name in names:
        signal = record.signals[name]
        if isinstance(signal, StartsSignal):
            traces[name] = Trace(np.zeros(1), np.array([fraction_of_starts(record, signal, model, spec)]))
        elif isinstance(signal, RowSignal):
            row = geom_row(model, data_at(model, spec, 0.0), signal.camera, signal.geom)
            traces[name] = Trace(np.zeros(1), np.array([row]))
    return run, {name: traces[name] for name in names}


def measure_output(record: Record, output: str) -> dict[str, Trace]:
    """Every signal of a code case, from what its script printed; an empty trace where it printed nothing."""
    printed = printed_numbers(output)
    return with_expressions(record, {name: printed.get(path.name, NOTHING) for name, path in paths(record).items()})


def with_expressions(record: Record, traces: Mapping[str, Trace]) -> dict[str, Trace]:
    """The traces and, computed from them sample by sample, every expression signal that they suffice for.

    Raises:
        RunError: If an expression reads signals with different numbers of samples, or a function cannot take them.
    """
    made = dict(traces)
    for name, signal in record.signals.items():
        if isinstance(signal, ExpressionSignal) and names_in(parse(signal.expr)) <= traces.keys():
            made[name] = _computed(name, signal, traces)
    return made


def _computed(name: str, signal: ExpressionSignal, traces: Mapping[str, Trace]) -> Trace:
    tree, where = parse(signal.expr), ("signals", name, "expr")
    counts = {key: len(traces[key].value) for key in sorted(names_in(tree))}
    if 0 in counts.values():
        return NOTHING
    if len(set(counts.values())) > 1:
        found = "samples that do not pair up: " + ", ".join(f"{key} has {n}" for key, n in counts.items())
        raise RunError(where, found, "signals with equally many samples", "print each as often as the others")
    time = next((traces[key].time for key in [*counts, *traces]), np.zeros(1))
    try:
        with np.errstate(all="ignore"):
            value = np.asarray(evaluate(tree, {key: traces[key].value for key in counts}), float)
    except ExpressionError as error:
        raise RunError(where, signal.expr, str(error), "correct the expression") from None
    return Trace(time, np.broadcast_to(value, time.shape))


def fraction_of_starts(record: Record, signal: StartsSignal, model: mujoco.MjModel, spec: RunSpec) -> float:
    """The share of evenly spaced start positions from which `signal.holds` holds, 0 to 1."""
    path = paths(record, [signal.holds.signal])

    def holds_from(offset: float) -> bool:
        def nudge(_: mujoco.MjModel, data: mujoco.MjData) -> None:
            data.joint(signal.joint).qpos[signal.index] += offset

        return judge(signal.holds, simulate(model, spec, path, nudge).traces).holds

    return sum(map(holds_from, np.linspace(*signal.offset, signal.count))) / signal.count


def omega_max(model: mujoco.MjModel) -> float:
    """The highest natural frequency of the joint springs at qpos0, in rad/s: sqrt of the largest eigenvalue of M^-1 K.

    An undamped linear oscillator under semi-implicit Euler is stable for h < 2 / omega; coupled joints have one such
    limit a mode, and the highest mode decides. See Hairer, Lubich, Wanner, *Geometric Numerical Integration*, I.5.
    """
    stiffness = np.diag(model.jnt_stiffness[model.dof_jntid])
    return math.sqrt(float(np.max(np.linalg.eigvals(np.linalg.solve(mass_matrix(model), stiffness)).real)))


def omega_one_link(model: mujoco.MjModel) -> float:
    """The popular estimate of the same, in rad/s: sqrt(k / I) of the last joint with its own link's inertia."""
    return math.sqrt(float(model.jnt_stiffness[-1]) / float(mass_matrix(model)[-1, -1]))


MODEL_NUMBERS = {"omega_max": omega_max, "omega_one_link": omega_one_link}
