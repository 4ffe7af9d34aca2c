"""Evidence: what the runs of a case showed, as plain data; published as `evidence.json`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Literal

import mujoco
import numpy as np
from pydantic import BaseModel, ConfigDict

from clinic.engine import node
from clinic.engine.checks import TAKES, Trace, Verdict, judge, take
from clinic.engine.measure import SampleError, measure_model, measure_output
from clinic.engine.render import blindness
from clinic.engine.script import Output, ScriptError, run_script
from clinic.engine.simulate import RunError, compile_model
from clinic.engine.variant import Variant, remedies, variants
from clinic.proof.examine import examine
from clinic.proof.robustness import Robustness
from clinic.proof.sweep import SweepEvidence, asked_of
from clinic.proof.trials import trial_problems, try_text
from clinic.record.case import Case
from clinic.record.fields import Check, PathSignal, RowSignal, Trial
from clinic.record.problem import CaseError, LackError, Problem, listed
from clinic.record.yaml_lines import Where

MAX_SAMPLES = 400


class Plain(BaseModel):
    """Frozen data without unknown fields."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class CheckResult(Plain):
    """A check with its measured number; None where nothing could be measured."""

    signal: str
    take: str
    window: tuple[float, float] | None = None
    expected: dict[str, float | tuple[float, float]]
    measured: float | None
    holds: bool


class Samples(Plain):
    """At most MAX_SAMPLES samples of a signal, evenly spread over the run, the first and last included."""

    unit: str
    time: list[float]
    value: list[float | None]


class VariantEvidence(Plain):
    """What one variant showed.

    Attributes:
        timestep: In s; None for a script.
        trials: The checks of every trial, by its id.
        values: Every number that can be taken from a signal, by signal and take.
        output: What a script printed; None for a model.
    """

    kind: Literal["broken", "fix", "refuted"]
    title: str
    edits: list[dict[str, str]]
    timestep: float | None
    steps: int | None
    warnings: dict[str, int]
    messages: list[str]
    output: str | None
    checks: dict[Literal["broken", "fixed"], list[CheckResult]]
    values: dict[str, dict[str, float | None]]
    traces: dict[str, Samples]
    trials: dict[str, dict[Literal["broken", "fixed"], list[CheckResult]]] = {}

    @property
    def well(self) -> bool:
        """Whether every `fixed` check holds, in every trial too."""
        return all(check.holds for checks in (self.checks, *self.trials.values()) for check in checks["fixed"])

    @property
    def broken(self) -> bool:
        """Whether every `broken` check holds, in every trial too."""
        return all(check.holds for checks in (self.checks, *self.trials.values()) for check in checks["broken"])


class Evidence(Plain):
    """Everything measured for one case.

    Attributes:
        case: The case's slug.
        engine: The version of MuJoCo that ran.
        package: What it came from: `mujoco` for Python, `@mujoco/mujoco` for WebAssembly.
        snippet: What the diagnosis snippet printed; None without a snippet.
        sweep: The points of every sweep and how its predictions fared.
        robustness: How firmly each variant's verdict stands; empty for a code case.
    """

    case: str
    number: int
    engine: str
    package: str = "mujoco"
    snippet: str | None
    variants: dict[str, VariantEvidence]
    sweep: dict[str, SweepEvidence] = {}
    robustness: dict[str, Robustness] = {}


def collect(case: Case) -> Evidence:
    """Runs every variant and the snippet of a case.

    Raises:
        CaseError: With every problem that keeps the case from running.
        LackError: If this machine lacks what the runs need.
    """
    examine(case)
    if untried := list(trial_problems(case)):
        raise CaseError(untried)
    if missing := lack(case):
        raise LackError(f"case {case.record.number} is not measured: {missing.found}")
    package, version = engine(case)
    observed: dict[str, VariantEvidence] = {}
    problems: list[Problem] = []
    for variant in variants(case):
        try:
            observed[variant.id] = observe(case, variant)
        except ScriptError as error:
            problems.append(_script_problem(case, variant, error))
        except SampleError as error:
            where = ("signals", error.signal, "expr")
            problems.append(case.problem(where, error.found, error.expected, error.repair))
        except RunError as error:
            problems.append(case.problem(("run", *error.where), error.found, error.expected, error.repair))
    problems += _unprinted(case, observed)
    try:
        snippet = None if case.record.snippet is None else run_snippet(case)
    except ScriptError as error:
        problems.append(case.problem(("snippet",), error.found, "code that runs as it stands", error.repair))
    if problems:
        raise CaseError(problems)
    return Evidence(
        case=case.slug,
        number=case.record.number,
        engine=version,
        package=package,
        snippet=snippet,
        variants=observed,
    )


def lack(case: Case) -> Problem | None:
    """What this machine lacks to measure the case."""
    where = "script" if case.record.script else "signals"
    if draws(case) and (reason := blindness()):
        needed = "OpenGL: this case is measured in images"
        return case.problem((where,), reason, needed, "judge it on a machine that draws")
    if case.record.language == "javascript" and (node.program() is None or node.version(node.MUJOCO) is None):
        found, repair = node.NO_PROGRAM if node.program() is None else node.NO_PACKAGE
        return case.problem((where,), found, f"Node and {node.MUJOCO}: this case is run by them", repair)
    return None


def draws(case: Case) -> bool:
    """Whether the runs draw images: for a signal, in the script or in the snippet."""
    code = case.text + (case.record.snippet or "")
    return "Renderer(" in code or any(isinstance(signal, RowSignal) for signal in case.record.signals.values())


def engine(case: Case) -> tuple[str, str]:
    """The package that brings MuJoCo to the case's source, and its version; that one must be installed."""
    if case.record.language != "javascript":
        return "mujoco", mujoco.__version__
    version = node.version(node.MUJOCO)
    assert version is not None
    return node.MUJOCO, version


def run_snippet(case: Case) -> str:
    """What the diagnosis snippet prints, run beside the case's files and in the language of its script.

    Raises:
        ScriptError: If it does not end well.
    """
    assert case.record.snippet is not None
    name = "snippet.mjs" if case.record.language == "javascript" else "snippet.py"
    return run_script(case.record.snippet, case.texts, name=name).text


def observe(case: Case, variant: Variant) -> VariantEvidence:
    """Runs one variant of a case and judges it by the record's checks."""
    record = case.record
    details: dict[str, Any]
    if record.run is not None:
        run, traces = measure_model(record, compile_model(variant.text), record.run)
        details = {
            "timestep": run.timestep,
            "steps": run.steps,
            "warnings": run.warnings,
            "messages": list(run.messages),
            "output": None,
        }
    else:
        output = run_script(variant.text, case.texts, name=record.source)
        traces = measure_output(record, output)
        details = {"timestep": None, "steps": None, "warnings": {}, "messages": [], "output": output.text}
    return VariantEvidence(
        kind=variant.kind,
        title=variant.title,
        edits=[edit.model_dump() for edit in variant.edits],
        checks={
            "broken": [_result(judge(check, traces)) for check in record.checks.broken],
            "fixed": [_result(judge(check, traces)) for check in record.checks.fixed],
        },
        values={name: {which: _number(take(trace, which)) for which in TAKES} for name, trace in traces.items()},
        traces={name: samples(trace, record.signals[name].unit) for name, trace in traces.items()},
        trials={trial.id: _tried(case, variant, trial) for trial in record.trials},
        **details,
    )


def samples(trace: Trace, unit: str) -> Samples:
    """The trace thinned to MAX_SAMPLES; a constant one to its two ends."""
    n = len(trace.value)
    constant = n > 2 and bool(np.all(trace.value == trace.value[0]))
    chosen = np.unique(np.linspace(0, n - 1, min(n, 2 if constant else MAX_SAMPLES)).round().astype(int))
    return Samples(
        unit=unit,
        time=[round(float(t), 9) for t in trace.time[chosen]],
        value=[_number(v) for v in trace.value[chosen]],
    )


def comparison(check: Check) -> dict[str, float | tuple[float, float]]:
    """The check's comparison as data: `{"below": 0.1}`."""
    return check.model_dump(include={"above", "below", "between", "equals", "within"}, exclude_none=True)


def _unprinted(case: Case, observed: dict[str, VariantEvidence]) -> Iterator[Problem]:
    """Signals of a script that no variant prints, but for those that only a sweep's text prints."""
    swept = {name for sweep in case.record.sweep.values() for name in asked_of(sweep)}
    for name, signal in case.record.signals.items():
        seen = any(variant.values[name]["final"] is not None for variant in observed.values())
        if isinstance(signal, PathSignal) and case.record.script and observed and not seen and name not in swept:
            printed = sorted({key for v in observed.values() for key in Output(v.output or "").traces()})
            yield case.problem(
                ("signals", name, "path"),
                f"{signal.path}, which no variant prints",
                f"printed(...) of: {listed(printed)}",
                "correct the name, or print `name = value` on a line of its own",
            )


def _script_problem(case: Case, variant: Variant, error: ScriptError) -> Problem:
    places = {remedy.id: where for where, _, remedy in remedies(case)}
    where: Where = (*places[variant.id], "edits") if variant.id in places else ("script",)
    after = " after these edits" if variant.id in places else ""
    return case.problem(
        where, f"{case.record.source}{after}: {error.found}", "a script that ends by itself", error.repair
    )


def _result(verdict: Verdict) -> CheckResult:
    check = verdict.check
    return CheckResult(
        signal=check.signal,
        take=check.take,
        window=check.window,
        expected=comparison(check),
        measured=_number(verdict.measured),
        holds=verdict.holds,
    )


def _tried(case: Case, variant: Variant, trial: Trial) -> dict[Literal["broken", "fixed"], list[CheckResult]]:
    made = try_text(case, variant.text, trial)
    return {"broken": [_result(one) for one in made.broken], "fixed": [_result(one) for one in made.fixed]}


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
