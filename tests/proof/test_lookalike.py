"""Look-alikes: one measurement a case, true for that case alone."""

from __future__ import annotations

from pathlib import Path

from clinic.proof.lookalike import alike_problems, matrix, matrix_problems
from clinic.record.case import Case, load_case
from helpers import MODEL, RECORD, write_case


def pair(root: Path, first: str, second: str) -> dict[str, Case]:
    """Two cases: a box without contacts, and the same box with them; each with its `alike`."""
    resting = MODEL.replace(' contype="2" conaffinity="2"', "")
    written = [
        write_case(root, slug="falling-box", record=RECORD + first),
        write_case(root, ("number: 1", "number: 2"), slug="resting-box", record=RECORD + second, model=resting),
    ]
    return {path.name: load_case(path) for path in written}


NONE = "alike: {{cases: [{}], path: ncon, take: max, equals: 0}}\n"
SOME = "alike: {{cases: [{}], path: ncon, take: max, above: 0}}\n"


def test_a_clear_matrix_holds_on_its_diagonal_alone(tmp_path: Path) -> None:
    cases = pair(tmp_path, NONE.format("resting-box"), SOME.format("falling-box"))

    made = matrix(list(cases.values()))

    assert made.measured == [[0.0, 4.0], [0.0, 4.0]]
    assert made.holds == [[True, False], [False, True]]
    assert list(matrix_problems(cases["falling-box"], made)) == []
    assert list(alike_problems(cases)) == []


def test_a_measurement_that_holds_for_both_is_unclear(tmp_path: Path) -> None:
    both = "alike: {cases: [falling-box], path: time, above: 0}\n"
    cases = pair(tmp_path, NONE.format("resting-box"), both)

    (problem,) = matrix_problems(cases["resting-box"], matrix(list(cases.values())))
    assert (problem.where, problem.found) == ("alike", "the measurement of resting-box holds for falling-box (0.4)")


def test_look_alikes_name_each_other(tmp_path: Path) -> None:
    cases = pair(tmp_path, NONE.format("resting-box"), "")

    assert [str(problem) for problem in alike_problems(cases)] == [
        "cases/falling-box/case.yaml:34: alike.cases[0]\n"
        "  found:    resting-box, which does not name falling-box\n"
        "  expected: cases that name each other\n"
        "  repair:   add it in resting-box"
    ]
