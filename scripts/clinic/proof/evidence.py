"""Evidence: what the runs of a case showed, as plain data; published as `evidence.json`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, Literal

import mujoco
import numpy as np
from pydantic import Field

from clinic.engine import node
from clinic.engine.checks import TAKES, Trace, judge, take
from clinic.engine.measure import measure_model, measure_output
from clinic.engine.render import why_no_images
from clinic.engine.script import ScriptError, printed_numbers, run_script
from clinic.engine.simulate import RunError, compile_model
from clinic.engine.variant import Variant, variants
from clinic.proof.model_problems import check_against_model
from clinic.proof.robustness import Robustness
from clinic.proof.sweep import SweepEvidence, names_read
from clinic.proof.tightness import Loose
from clinic.proof.trials import checks_in, run_trial, trial_problems
from clinic.record.case import Case
from clinic.record.fields import Trial
from clinic.record.parts import Check, Strict
from clinic.record.problem import CaseError, MissingRequirementError, Problem, listed
from clinic.record.signal import PathSignal, RowSignal
from clinic.record.yaml_lines import Where

MAX_SAMPLES = 400


class CheckResult(Strict):
    """A check with its measured number; None where nothing could be measured."""

    signal: str
    take: str
    window: tuple[float, float] | None = None
    expected: dict[str, float | tuple[float, float]]
    measured: float | None
    holds: bool


class Samples(Strict):
    """At most MAX_SAMPLES samples of a signal, evenly spread over the run, the first and last included."""

    unit: str
    time: list[float]
    value: list[float | None]


class VariantEvidence(Strict):
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
    timestep: float | None = None
    steps: int | None = None
    warnings: dict[str, int] = Field(default={})
    messages: list[str] = Field(default=[])
    output: str | None = None
    checks: dict[Literal["broken", "fixed"], list[CheckResult]]
    values: dict[str, dict[str, float | None]]
    traces: dict[str, Samples]
    trials: dict[str, dict[Literal["broken", "fixed"], list[CheckResult]]] = Field(default={})

    @property
    def well(self) -> bool:
        """Whether every `fixed` check holds, in every trial too."""
        return all(check.holds for checks in (self.checks, *self.trials.values()) for check in checks["fixed"])

    @property
    def broken(self) -> bool:
        """Whether every `broken` check holds, in every trial too."""
        return all(check.holds for checks in (self.checks, *self.trials.values()) for check in checks["broken"])


class Evidence(Strict):
    """Everything measured for one case.

    Attributes:
        case: The case's slug.
        engine: The version of MuJoCo that ran.
        package: What it came from: `mujoco` for Python, `@mujoco/mujoco` for WebAssembly.
        snippet: What the diagnosis snippet printed; None without a snippet.
        sweep: The points of every sweep and how its predictions fared.
        robustness: How firmly each variant's verdict stands; empty for a code case.
        releases: What each variant does on other releases of MuJoCo; empty if the case has changed since.
        loose: The numbers that no check notices when they are halved or doubled; None where it was not asked.
        claims: The claims of the prose whose code does not hold, by number; None where it was not asked.
    """

    case: str
    number: int | None
    engine: str
    package: str = "mujoco"
    snippet: str | None
    variants: dict[str, VariantEvidence]
    sweep: dict[str, SweepEvidence] = Field(default={})
    robustness: dict[str, Robustness] = Field(default={})
    releases: dict[str, Any] = Field(default={})
    loose: list[Loose] | None = None
    claims: dict[int, str] | None = None


def collect(case: Case) -> Evidence:
    """Runs every variant and the snippet of a case.

    Raises:
        CaseError: With every problem that keeps the case from running.
        MissingRequirementError: If this machine lacks what the runs need.
    """
    check_against_model(case)
    if untried := list(trial_problems(case)):
        raise CaseError(untried)
    if missing := missing_requirement(case):
        raise MissingRequirementError(f"case {case.record.number or case.slug} is not measured: {missing.found}")
    observed: dict[str, VariantEvidence] = {}
    problems: list[Problem] = []
    for variant in variants(case):
        try:
            observed[variant.id] = observe(case, variant)
        except ScriptError as error:
            where: Where = (*variant.where, "edits") if variant.edits else ("script",)
            found, expected = f"{variant.id}: {error.found}", "a script that ends by itself"
            problems.append(case.problem(where, found, expected, error.repair))
        except RunError as error:
            problems.append(case.problem(error.where, error.found, error.expected, error.repair))
    problems += _unprinted(case, observed)
    snippet = None
    if case.record.snippet is not None:
        name = "snippet.mjs" if case.record.language == "javascript" else "snippet.py"
        try:
            snippet = run_script(case.record.snippet, case.texts, name=name)
        except ScriptError as error:
            problems.append(case.problem(("snippet",), error.found, "code that runs as it stands", error.repair))
    if problems:
        raise CaseError(problems)
    in_node = case.record.language == "javascript"
    return Evidence(
        case=case.slug,
        number=case.record.number,
        engine=(node.version(node.MUJOCO) or "") if in_node else mujoco.__version__,
        package=node.MUJOCO if in_node else "mujoco",
        snippet=snippet,
        variants=observed,
    )


def missing_requirement(case: Case) -> Problem | None:
    """What this machine lacks to measure the case."""
    where = "script" if case.record.script else "signals"
    if needs_images(case) and (reason := why_no_images()):
        needed = "OpenGL: this case is measured in images"
        return case.problem((where,), reason, needed, "judge it on a machine that draws")
    if case.record.language == "javascript" and (node.executable() is None or node.version(node.MUJOCO) is None):
        found, repair = node.NO_PROGRAM if node.executable() is None else node.NO_PACKAGE
        return case.problem((where,), found, f"Node and {node.MUJOCO}: this case is run by them", repair)
    return None


def needs_images(case: Case) -> bool:
    """Whether images are drawn while the case is measured: for a signal, in the script or in the snippet."""
    code = case.text + (case.record.snippet or "")
    return "Renderer(" in code or any(isinstance(signal, RowSignal) for signal in case.record.signals.values())


def observe(case: Case, variant: Variant, tried: bool = True) -> VariantEvidence:
    """Runs one variant of a case and judges it by the record's checks, where `tried` in its trials too."""
    record = case.record
    details: dict[str, Any]
    if record.run is not None:
        run, traces = measure_model(record, compile_model(variant.text), record.run)
        details = {"timestep": run.timestep, "steps": run.steps, "warnings": run.warnings, "messages": [*run.messages]}
    else:
        output = run_script(variant.text, case.texts, name=record.source)
        traces = measure_output(record, output)
        details = {"output": output}
    return VariantEvidence(
        kind=variant.kind,
        title=variant.title,
        edits=[edit.model_dump() for edit in variant.edits],
        checks={
            "broken": [_result(check, traces) for check in record.checks.broken],
            "fixed": [_result(check, traces) for check in record.checks.fixed],
        },
        values={name: {which: _number(take(trace, which)) for which in TAKES} for name, trace in traces.items()},
        traces={name: samples(trace, record.signals[name].unit) for name, trace in traces.items()},
        trials={trial.id: _tried(case, variant, trial) for trial in record.trials if tried},
        **details,
    )


def samples(trace: Trace, unit: str) -> Samples:
    """The trace thinned to MAX_SAMPLES; a constant one to its two ends."""
    n, constant = len(trace.value), len(set(trace.value)) == 1
    chosen = np.unique(np.linspace(0, n - 1, min(n, 2 if constant else MAX_SAMPLES)).round().astype(int))
    return Samples(
        unit=unit,
        time=[round(float(t), 9) for t in trace.time[chosen]],
        value=[_number(v) for v in trace.value[chosen]],
    )


def _unprinted(case: Case, observed: dict[str, VariantEvidence]) -> Iterator[Problem]:
    """Signals of a script that no variant prints, but for those that only a sweep's text prints."""
    if case.record.script is None or not observed:
        return
    swept = {name for sweep in case.record.sweep.values() for name in names_read(sweep)}
    printed = {f"printed({key})" for variant in observed.values() for key in printed_numbers(variant.output or "")}
    for name, signal in case.record.signals.items():
        if isinstance(signal, PathSignal) and signal.path not in printed and name not in swept:
            found, expected = f"{signal.path}, which no variant prints", f"printed(...) of: {listed(sorted(printed))}"
            repair = "correct the name, or print `name = value` on a line of its own"
            yield case.problem(("signals", name, "path"), found, expected, repair)


def _result(check: Check, traces: Mapping[str, Trace]) -> CheckResult:
    verdict = judge(check, traces)
    bounds = {"above", "below", "between", "equals", "within"}
    return CheckResult(
        signal=check.signal,
        take=check.take,
        window=check.window,
        expected=check.model_dump(include=bounds, exclude_none=True),
        measured=_number(verdict.measured),
        holds=verdict.holds,
    )


def _tried(case: Case, variant: Variant, trial: Trial) -> dict[Literal["broken", "fixed"], list[CheckResult]]:
    checks, (_, traces) = checks_in(case.record, trial), run_trial(case, variant.text, trial)
    broken, fixed = ([_result(check, traces) for check in kind] for kind in (checks.broken, checks.fixed))
    return {"broken": broken, "fixed": fixed}


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
