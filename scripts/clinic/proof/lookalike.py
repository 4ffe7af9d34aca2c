"""Look-alikes: cases with the same symptom, and one measurement a case that holds for it alone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from clinic.engine.checks import satisfies, take
from clinic.engine.signals import SignalError, parse_path
from clinic.engine.simulate import compile_model, simulate
from clinic.record.case import Case
from clinic.record.parts import Strict
from clinic.record.problem import Problem


class LookalikeMatrix(Strict):
    """Measurements by cases: `measured[i][j]` is what case i's measurement gives for case j.

    Attributes:
        cases: The cases' slugs.
        measured: The numbers; None where nothing could be measured.
        holds: Whether each satisfies the measurement's bound; wanted on the diagonal alone.
    """

    cases: list[str]
    measured: list[list[float | None]]
    holds: list[list[bool]]


def alike_problems(cases: Mapping[str, Case]) -> Iterator[Problem]:
    """What is wrong with the cases' `alike` before anything is run."""
    for case in cases.values():
        if case.record.alike is None:
            continue
        if case.record.run is None:
            yield case.problem(("alike",), "a script", "a model case", "remove `alike`")
        for index, slug in enumerate(case.record.alike.cases):
            other, where = cases.get(slug), ("alike", "cases", index)
            if other is None or other.record.run is None or slug == case.slug:
                yield case.problem(where, slug, "the folder of another model case", "correct the name")
            elif other.record.alike is None or case.slug not in other.record.alike.cases:
                found = f"{slug}, which does not name {case.slug}"
                yield case.problem(where, found, "cases that name each other", f"add it in {slug}")
        try:
            parse_path(case.record.alike.path)
        except SignalError as error:
            yield case.problem(("alike", "path"), error.found, error.expected, error.repair)


def matrix(members: list[Case]) -> LookalikeMatrix:
    """Every member's measurement, run on the broken variant of every member.

    Raises:
        SignalError: If a model lacks what a path names.
    """
    runs = [(compile_model(member.text), member.record.run) for member in members if member.record.run is not None]
    made = LookalikeMatrix(cases=[member.slug for member in members], measured=[], holds=[])
    for alike in (member.record.alike for member in members if member.record.alike is not None):
        path = {"x": parse_path(alike.path)}
        values = [take(simulate(model, run, path).traces["x"], alike.take) for model, run in runs]
        made.measured.append([value if math.isfinite(value) else None for value in values])
        made.holds.append([satisfies(alike, value) for value in values])
    return made


def matrix_problems(case: Case, made: LookalikeMatrix) -> Iterator[Problem]:
    """Every cell that is not as it should be."""
    for i, row in enumerate(made.holds):
        for j, holds in enumerate(row):
            if holds != (i == j):
                state = "holds for" if holds else "does not hold for"
                value = made.measured[i][j]
                seen = "nothing" if value is None else f"{value:.4g}"
                found = f"the measurement of {made.cases[i]} {state} {made.cases[j]} ({seen})"
                wanted = "measurements that hold for their own case alone"
                yield case.problem(("alike",), found, wanted, "correct its `path`, `take` or bound")
