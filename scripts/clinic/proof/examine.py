"""What only the compiled model can tell about a record, asked before anything is simulated."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import mujoco

from clinic.engine.mjcf import ModelError, check_text
from clinic.engine.signals import SignalError, bind, element_names, missing_element, parse_path
from clinic.engine.simulate import RunError, compile_model, controls, initial_data, step_count
from clinic.engine.variant import Variant, place_of, variants
from clinic.record.case import Case
from clinic.record.fields import PathSignal, Record, RowSignal, StartsSignal
from clinic.record.problem import CaseError, Problem
from clinic.record.yaml_lines import Where


def examine(case: Case) -> None:
    """Compiles every variant of a case and looks up in it what the record names.

    Raises:
        CaseError: With all problems found; each names a variant only once.
    """
    texts = ((name, text) for name, text in case.texts.items() if name.endswith(".xml"))
    problems = [problem for name, text in texts for problem in _text_problems(case, name, text)]
    if problems:
        raise CaseError(problems)
    problems = list(_path_problems(case))
    try:
        made = variants(case)
    except CaseError as error:
        raise CaseError([*problems, *error.problems]) from None
    if case.record.run is not None:
        problems += _model_problems(case, made)
    elif case.record.picture.scene is not None:
        problems += _scene_problems(case, case.record.picture.scene)
    if problems:
        raise CaseError(problems)


def _text_problems(case: Case, name: str, text: str) -> Iterator[Problem]:
    """The first mistake in the text of an XML file; that of a script's scene may name the files beside it."""
    try:
        check_text(text, () if case.record.model else case.texts)
    except ModelError as error:
        yield Problem(f"cases/{case.slug}/{name}", error.line, "", error.found, error.expected, error.repair)


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


def _scene_problems(case: Case, scene: str) -> Iterator[Problem]:
    try:
        model = compile_model(case.texts[scene])
    except ValueError as error:
        yield _compile_problem(case, scene, (), error)
        return
    if missing := missing_element(model, "camera", case.record.picture.camera):
        yield case.problem(("picture", "camera"), *missing)


def _path_problems(case: Case) -> Iterator[Problem]:
    """The signals' paths that cannot be read, and in a code case the signals that are no printed number."""
    for name, signal in case.record.signals.items():
        if isinstance(signal, PathSignal):
            where: Where = ("signals", name, "path")
            try:
                path = parse_path(signal.path)
            except SignalError as error:
                yield case.problem(where, error.found, error.expected, error.repair)
                continue
            if case.record.script and path.kind != "printed":
                expected = "printed(name): this case is a script"
                yield case.problem(where, signal.path, expected, "let the script print it")
        elif case.record.script and isinstance(signal, StartsSignal | RowSignal):
            expected = "`path: printed(...)` or `expr`"
            yield case.problem(("signals", name), "a measure of a model", expected, "print it")


def _variant_problems(case: Case, variant: Variant) -> Iterator[Problem]:
    """What does not fit the variant's model: its text, the run, and the names of what is measured and shown."""
    record = case.record
    assert record.run is not None
    try:
        model = compile_model(variant.text)
    except ValueError as error:
        yield _compile_problem(case, record.source, place_of(case, variant.id), error)
        return
    for prepare in (initial_data, step_count, lambda m, spec: controls(m, spec, 1)):
        try:
            prepare(model, record.run)
        except RunError as error:
            yield case.problem(error.where, error.found, error.expected, error.repair)
    data = mujoco.MjData(model)
    for name, signal in record.signals.items():
        if isinstance(signal, PathSignal):
            try:
                bind(parse_path(signal.path), model, data)
            except SignalError as error:
                yield case.problem(("signals", name, "path"), error.found, error.expected, error.repair)
        elif isinstance(signal, StartsSignal) and signal.joint in element_names(model, "joint"):
            size = len(data.joint(signal.joint).qpos)
            if signal.index >= size:
                found, expected = f"index {signal.index} of {signal.joint}", f"an index below {size}"
                yield case.problem(("signals", name, "index"), found, expected, "correct the index")
    for where, kind, element in _elements_named(record):
        if missing := missing_element(model, kind, element):
            yield case.problem(where, *missing)


def _elements_named(record: Record) -> Iterator[tuple[Where, str, str]]:
    """The place, kind and name of every element that a measure, the picture or the film names."""
    for name, signal in record.signals.items():
        for kind in ("joint", "camera", "geom"):
            if isinstance(signal, StartsSignal | RowSignal) and hasattr(signal, kind):
                yield ("signals", name, kind), kind, getattr(signal, kind)
    yield ("picture", "camera"), "camera", record.picture.camera
    if record.film is not None and record.film.camera is not None:
        yield ("film", "camera"), "camera", record.film.camera


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
