"""What only the compiled model can tell about a record, asked before anything is simulated."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import mujoco

from clinic.engine.mjcf import ModelError
from clinic.engine.signals import SignalError, bind, missing_element, parse_path
from clinic.engine.simulate import RunError, compile_model, controls, initial_data, step_count
from clinic.engine.variant import BROKEN, Variant, variants
from clinic.record.case import Case
from clinic.record.problem import CaseError, Problem
from clinic.record.signal import ExpressionSignal, PathSignal, RowSignal, StartsSignal
from clinic.record.yaml_lines import Where


def check_against_model(case: Case) -> None:
    """Compiles every variant of a case and looks up in it what the record names.

    Raises:
        CaseError: With all problems found; each names a variant only once.
    """
    problems: list[Problem] = []
    try:
        made = variants(case)
    except CaseError as error:
        problems += error.problems
        made = [Variant("broken", BROKEN, "", (), case.text)]
    problems += _script_problems(case) if case.record.run is None else _model_problems(case, made)
    if problems:
        raise CaseError(problems)


def _model_problems(case: Case, made: list[Variant]) -> list[Problem]:
    """The broken model's problems, then those that only the edits of a remedy bring; one at each place."""
    problems: dict[str, Problem] = {}
    for variant in made:
        for problem in _variant_problems(case, variant):
            told = variant.kind == "broken" or problem.where.endswith(".edits")
            found = problem.found if told else f"after the edits of {variant.id}: {problem.found}"
            problems.setdefault(problem.where, replace(problem, found=found))
        if any(problem.file != case.file for problem in problems.values()):
            break  # The broken model does not compile.
    return list(problems.values())


def _script_problems(case: Case) -> Iterator[Problem]:
    """The signals of a code case that are no printed number, and what does not fit its picture's scene."""
    for name, signal in case.record.signals.items():
        path = signal.path if isinstance(signal, PathSignal) else "a measure of a model"
        if not isinstance(signal, ExpressionSignal) and not re.fullmatch(r"printed\([^()]+\)", path):
            expected = "`path: printed(name)` or `expr`: this case is a script"
            yield case.problem(("signals", name), path, expected, "let the script print it")
    if (scene := case.record.picture.scene) is not None:
        try:
            model = compile_model(case.texts[scene])
        except ValueError as error:
            yield _compile_problem(case, scene, (), error)
            return
        camera = case.record.picture.camera
        if camera is not None and (missing := missing_element(model, "camera", camera)):
            yield case.problem(("picture", "camera"), *missing)
        for joint in case.record.picture.shows:
            if missing := missing_element(model, "joint", joint):
                yield case.problem(("picture", "shows", joint), *missing)


def _variant_problems(case: Case, variant: Variant) -> Iterator[Problem]:
    """What does not fit the variant's model: its text, the run, and the names of what is measured and shown."""
    record = case.record
    assert record.run is not None
    try:
        model = compile_model(variant.text)
    except ValueError as error:
        yield _compile_problem(case, record.source, variant.where, error)
        return
    for prepare in (initial_data, step_count, lambda m, spec: controls(m, spec, 1)):
        try:
            prepare(model, record.run)
        except RunError as error:
            yield case.problem(error.where, error.found, error.expected, error.repair)
    data = mujoco.MjData(model)
    for name, signal in record.signals.items():
        try:
            if isinstance(signal, PathSignal):
                bind(parse_path(signal.path), model, data)
            elif isinstance(signal, StartsSignal):
                bind(parse_path(f"joint({signal.joint}).qpos[{signal.index}]"), model, data)
        except SignalError as error:
            yield case.problem(("signals", name), error.found, error.expected, error.repair)
    named: list[tuple[Where, str, str]] = []
    if record.picture.camera is not None:
        named.append((("picture", "camera"), "camera", record.picture.camera))
    for name, signal in record.signals.items():
        if isinstance(signal, RowSignal):
            named.append((("signals", name, "camera"), "camera", signal.camera))
            named.append((("signals", name, "geom"), "geom", signal.geom))
    for where, kind, element in named:
        if missing := missing_element(model, kind, element):
            yield case.problem(where, *missing)


def _compile_problem(case: Case, name: str, place: Where, error: ValueError) -> Problem:
    if isinstance(error, ModelError):
        said, expected, repair = error.found, error.expected, error.repair
    else:
        said, expected = " ".join(str(error).split()), "XML that MuJoCo compiles"
        repair = "correct `replace`" if place else "correct the model"
    if place:
        return case.problem((*place, "edits"), f"after these edits: {said}", expected, repair)
    told = re.search(r"line(?: number)?[ =](\d{1,6})", str(error), re.IGNORECASE)
    line = int(told[1]) if told else 1
    inside = line <= case.texts[name].count("\n") + 1  # else it is one of MuJoCo's own source
    return Problem(f"cases/{case.slug}/{name}", line if inside else 1, "", said, expected, repair)
