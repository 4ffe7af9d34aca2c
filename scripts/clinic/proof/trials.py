"""Trials: a text judged in every situation of its record, for a repair that holds in one alone is luck."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping

import mujoco

from clinic.engine.checks import Trace
from clinic.engine.measure import measure_model, measure_output
from clinic.engine.script import run_script
from clinic.engine.signals import bind, parse_path
from clinic.engine.simulate import compile_model, controls, initial_data
from clinic.engine.variant import apply_edits, variants
from clinic.record.case import Case
from clinic.record.fields import Checks, Record, RunSpec, Trial
from clinic.record.parts import Interval
from clinic.record.problem import Problem, listed
from clinic.record.yaml_lines import Where

FACTOR = 2.0
NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")


def checks_in(record: Record, trial: Trial | None) -> Checks:
    """The checks that apply in a trial."""
    own = trial.checks if trial else None
    if own is None:
        return record.checks
    return Checks(broken=own.broken or record.checks.broken, fixed=own.fixed or record.checks.fixed)


def trial_problems(case: Case) -> Iterator[Problem]:
    """Trials that do not fit a variant, and trials of which none differs from the run by FACTOR or in sign."""
    telling = False
    for index, trial in enumerate(case.record.trials):
        where: Where = ("trials", index)
        if trial.id in [other.id for other in case.record.trials[:index]]:
            yield case.problem((*where, "id"), f"{trial.id}, which is taken", "an id used once", "rename it")
        other = ("set", "start", "ctrl", "duration") if case.record.run is None else ("edits", "file")
        if misplaced := [name for name in other if getattr(trial, name)]:
            expected = "`edits` for a script; `set`, `start`, `ctrl` or `duration` for a model"
            yield case.problem(where, listed(misplaced), expected, "change the situation in the case's own way")
            return
        if trial.file not in (None, *case.texts):
            expected = f"a file of the folder: {listed(case.texts)}"
            yield case.problem((*where, "file"), str(trial.file), expected, "correct the name")
            return
        for variant in variants(case):
            try:
                telling |= any(far(*pair) for pair in changed_numbers(case, variant.text, trial))
            except ValueError as error:
                found = f"in the text of {variant.id}: {' '.join(str(error).split())}"
                yield case.problem(where, found, "what every variant has", "correct the path, the name or the text")
                return
    if case.record.trials and not telling:
        found, wanted = "no number that differs by a factor of two or in sign", "a trial in which what decides differs"
        yield case.problem(("trials",), found, wanted, "double the load, turn the scene, drive it the other way")


def far(here: float, there: float) -> bool:
    """Whether two numbers differ by FACTOR or more, or in sign."""
    low, high = sorted((abs(here), abs(there)))
    return here * there < 0 or high >= max(FACTOR * low, 1e-300)


def run_trial(case: Case, text: str, trial: Trial | None) -> tuple[Mapping[str, int], Mapping[str, Trace]]:
    """Runs a model or script in a trial, or as the record says: how often MuJoCo warned, by type, and what checks read.

    Raises:
        ValueError: If the text does not compile or run, or lacks what the trial changes or the checks measure.
    """
    record = case.record
    if record.run is None:
        files = dict(case.texts)
        if trial is not None and trial.file is not None:
            files[trial.file] = apply_edits(files[trial.file], trial.edits)
        elif trial is not None:
            text = apply_edits(text, trial.edits)
        return {}, measure_output(record, run_script(text, files, name=record.source))
    model, spec = compile_model(text), record.run
    checks = checks_in(record, trial)
    wanted = {check.signal for check in checks.broken + checks.fixed}
    if trial is not None:
        spec = run_in(record.run, trial)
        for path, value in trial.set.items():
            write(model, mujoco.MjData(model), path, value)
        if trial.set:
            mujoco.mj_setConst(model, mujoco.MjData(model))

    def begin(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        for path, value in trial.start.items() if trial else ():
            write(model, data, path, value)

    run, traces = measure_model(record, model, spec, wanted, begin)
    return run.warnings, traces


def run_in(run: RunSpec, trial: Trial) -> RunSpec:
    """The record's run as a trial drives it, and for how long."""
    return run.model_copy(update={"ctrl": {**run.ctrl, **trial.ctrl}, "duration": trial.duration or run.duration})


def write(model: mujoco.MjModel, data: mujoco.MjData, text: str, value: float) -> None:
    """Writes one number to where a signal's path reads it.

    Raises:
        SignalError: If the model has no such number, or the path names what cannot be written.
    """
    path = parse_path(text)
    bind(path, model, data)
    owner = model if path.model else data
    if path.kind:
        owner = getattr(owner, path.kind)(path.name)
    *parents, last = path.field.split(".")
    for parent in parents:
        owner = getattr(owner, parent)
    if hasattr(getattr(owner, last), "shape"):
        field = getattr(owner, last)
        field[path.index or (0,) * field.ndim] = value
    else:
        setattr(owner, last, value)


def changed_numbers(case: Case, text: str, trial: Trial) -> Iterator[tuple[float, float]]:
    """Each number that a trial changes: as the case has it, and as the trial does."""
    if case.record.run is None:
        apply_edits(case.texts[trial.file] if trial.file else text, trial.edits)
        for edit in trial.edits:
            found, made = ([float(n) for n in NUMBER.findall(part)] for part in (edit.find, edit.replace))
            yield from zip(found, made, strict=False)
        return
    model = compile_model(text)
    data = initial_data(model, case.record.run)
    controls(model, run_in(case.record.run, trial), 1)
    for path, value in {**trial.set, **trial.start}.items():
        yield bind(parse_path(path), model, data)(), value
    for name, control in trial.ctrl.items():
        yield _largest(case.record.run.ctrl.get(name, 0.0)), _largest(control)


def _largest(control: float | list[Interval]) -> float:
    """The control's value farthest from zero."""
    if isinstance(control, list):
        return max((value for _, value in control), key=abs, default=math.nan)
    return control
