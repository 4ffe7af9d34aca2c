"""What only the compiled model can tell about a record, asked before anything is simulated."""

from __future__ import annotations

import re
from collections.abc import Iterator

import mujoco

from clinic.case import Case
from clinic.problem import CaseError, Problem, closest, listed
from clinic.record import PathSignal, RowSignal, StartsSignal
from clinic.signals import SignalError, bind, element_names, parse_path
from clinic.simulate import RunError, compile_model, controls, start, step_count
from clinic.variant import Variant, remedies, variants
from clinic.yamlmap import Where


def examine(case: Case) -> None:
    """Compiles every variant of a case and binds the record's names to it.

    Raises:
        CaseError: With all problems found; each names a variant only once.
    """
    problems = list(_path_problems(case))
    try:
        made = variants(case)
    except CaseError as error:
        raise CaseError([*problems, *error.problems]) from None
    if case.record.run is not None:
        places = {remedy.id: where for where, _, remedy in remedies(case)}
        for variant in made:
            problems += _variant_problems(case, variant, places.get(variant.id, ()))
    if problems:
        raise CaseError(problems)


def _path_problems(case: Case) -> Iterator[Problem]:
    for name, signal in case.record.signals.items():
        where: Where = ("signals", name, "path")
        if not isinstance(signal, PathSignal):
            if case.record.script and isinstance(signal, StartsSignal | RowSignal):
                yield case.problem(where[:2], "a measure of a model", "`path: printed(...)` or `expr`", "print it")
            continue
        try:
            path = parse_path(signal.path)
        except SignalError as error:
            yield case.problem(where, error.found, error.expected, error.repair)
            continue
        if case.record.script and path.kind != "printed":
            yield case.problem(where, signal.path, "printed(name): this case is a script", "let the script print it")


def _variant_problems(case: Case, variant: Variant, place: Where) -> Iterator[Problem]:
    record = case.record
    assert record.run is not None
    try:
        model = compile_model(variant.text)
    except ValueError as error:
        yield _compile_problem(case, variant, place, str(error))
        return
    try:
        data = start(model, record.run)
        controls(model, record.run, step_count(model, record.run))
    except RunError as error:
        yield case.problem(("run", *error.where), error.found, error.expected, error.repair)
        data = mujoco.MjData(model)
    for name, signal in record.signals.items():
        if isinstance(signal, PathSignal):
            try:
                bind(parse_path(signal.path), model, data)
            except SignalError as error:
                yield case.problem(("signals", name, "path"), error.found, error.expected, error.repair)
        elif isinstance(signal, StartsSignal):
            yield from _named(case, model, ("signals", name, "joint"), "joint", signal.joint)
        elif isinstance(signal, RowSignal):
            yield from _named(case, model, ("signals", name, "camera"), "camera", signal.camera)
            yield from _named(case, model, ("signals", name, "geom"), "geom", signal.geom)
    yield from _named(case, model, ("picture", "camera"), "camera", record.picture.camera)


def _named(case: Case, model: mujoco.MjModel, where: Where, kind: str, name: str) -> Iterator[Problem]:
    known = element_names(model, kind)
    if name not in known:
        guess = closest(name, known)
        yield case.problem(
            where,
            f"{name}, which is no {kind} of the model",
            f"a {kind}: {listed(known)}",
            f"write {guess}" if guess else f"correct it, or name the {kind} in the model",
        )


def _compile_problem(case: Case, variant: Variant, place: Where, message: str) -> Problem:
    expected, said = "XML that MuJoCo compiles", " ".join(message.split())
    if place:
        return case.problem((*place, "edits"), f"after these edits: {said}", expected, "correct `replace`")
    line = re.search(r"line(?: number)?[ =](\d+)", message, re.IGNORECASE)
    file = f"cases/{case.slug}/{case.record.source}"
    return Problem(file, int(line[1]) if line else 1, "", said, expected, "correct the model")
