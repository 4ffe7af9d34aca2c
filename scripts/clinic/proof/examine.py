"""What only the compiled model can tell about a record, asked before anything is simulated."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import mujoco

from clinic.engine.mjcf import ModelError, check_text
from clinic.engine.signals import SignalError, bind, element_names, parse_path
from clinic.engine.simulate import MAX_STEPS, RunError, compile_model, controls, start, step_count
from clinic.engine.variant import EditError, Variant, remedies, variants
from clinic.proof.sweep import grid, substituted
from clinic.record.case import Case
from clinic.record.fields import PathSignal, RowSignal, StartsSignal
from clinic.record.problem import CaseError, Problem, article, closest, listed
from clinic.record.yaml_lines import Where


def examine(case: Case) -> None:
    """Compiles every variant of a case and binds the record's names to it.

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
    if not problems:
        problems = list(_sweep_problems(case, made))
    if problems:
        raise CaseError(problems)


def _text_problems(case: Case, name: str, text: str) -> Iterator[Problem]:
    """The first mistake in the text of an XML file; that of a script's scene may name the files beside it."""
    try:
        check_text(text, () if case.record.model else case.texts)
    except ModelError as error:
        yield Problem(f"cases/{case.slug}/{name}", error.line, "", error.found, error.expected, error.repair)


def _sweep_problems(case: Case, made: list[Variant]) -> Iterator[Problem]:
    """The first and the last point of every sweep, written and compiled."""
    for name, sweep in case.record.sweep.items():
        base = next(variant for variant in made if variant.id == sweep.base)
        for at in (grid(sweep)[0], grid(sweep)[-1]):
            try:
                text = substituted(base.text, sweep, at)
                if case.record.run is not None:
                    compile_model(text)
            except EditError as error:
                k = error.index - len(sweep.edits)
                place: Where = ("edits", error.index, "find") if k < 0 else ("vary", k, "find")
                found = f"text that occurs {error.count} times in the text of {base.id}"
                yield case.problem(("sweep", name, *place), found, "text that occurs exactly once", "correct `find`")
                break
            except ValueError as error:
                found = f"at {at}: {' '.join(str(error).split())}"
                yield case.problem(("sweep", name, "vary"), found, "XML that MuJoCo compiles", "correct `replace`")
                break


def _model_problems(case: Case, made: list[Variant]) -> list[Problem]:
    """The broken model's problems, then those that only the edits of a remedy bring."""
    broken, *others = made
    problems = list(_variant_problems(case, broken, ()))
    if any(problem.file != case.file for problem in problems):
        return problems  # It does not compile.
    known = {problem.where for problem in problems}
    places = {remedy.id: where for where, _, remedy in remedies(case)}
    for variant in others:
        for problem in _variant_problems(case, variant, places[variant.id]):
            if problem.where.endswith(".edits"):
                problems.append(problem)
            elif problem.where not in known:
                problems.append(replace(problem, found=f"after the edits of {variant.id}: {problem.found}"))
    return problems


def _scene_problems(case: Case, scene: str) -> Iterator[Problem]:
    try:
        model = compile_model(case.texts[scene])
    except ValueError as error:
        yield _compile_problem(case, scene, (), error)
        return
    yield from _named(case, model, ("picture", "camera"), "camera", case.record.picture.camera)


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
        yield _compile_problem(case, record.source, place, error)
        return
    for prepare in (start, step_count, lambda m, spec: controls(m, spec, 1)):
        try:
            prepare(model, record.run)
        except RunError as error:
            yield case.problem(("run", *error.where), error.found, error.expected, error.repair)
    if record.picture.time > MAX_STEPS * model.opt.timestep > 0:
        expected = f"{MAX_STEPS * model.opt.timestep:g} s at most, which is {MAX_STEPS:,} steps"
        yield case.problem(("picture", "time"), f"{record.picture.time:g} s", expected, "show an earlier moment")
    data = mujoco.MjData(model)
    for name, signal in record.signals.items():
        if isinstance(signal, PathSignal):
            try:
                bind(parse_path(signal.path), model, data)
            except SignalError as error:
                yield case.problem(("signals", name, "path"), error.found, error.expected, error.repair)
        elif isinstance(signal, StartsSignal):
            yield from _named(case, model, ("signals", name, "joint"), "joint", signal.joint)
            if signal.joint in element_names(model, "joint"):
                size = len(data.joint(signal.joint).qpos)
                if signal.index >= size:
                    found, expected = f"index {signal.index} of {signal.joint}", f"an index below {size}"
                    yield case.problem(("signals", name, "index"), found, expected, "correct the index")
        elif isinstance(signal, RowSignal):
            yield from _named(case, model, ("signals", name, "camera"), "camera", signal.camera)
            yield from _named(case, model, ("signals", name, "geom"), "geom", signal.geom)
    yield from _named(case, model, ("picture", "camera"), "camera", record.picture.camera)
    if record.film is not None and record.film.camera is not None:
        yield from _named(case, model, ("film", "camera"), "camera", record.film.camera)


def _named(case: Case, model: mujoco.MjModel, where: Where, kind: str, name: str) -> Iterator[Problem]:
    known = element_names(model, kind)
    if name not in known:
        guess = closest(name, known)
        yield case.problem(
            where,
            f"{name}, which is no {kind} of the model",
            f"{article(kind)}: {listed(known)}",
            f"write {guess}" if guess else f"correct it, or name the {kind} in the model",
        )


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
