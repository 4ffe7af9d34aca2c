"""Problems: how a mistake is said."""

from __future__ import annotations

import pytest
from clinic.record.problem import CaseError, Problem, closest, listed, problems_by_case


def problem(file: str = "cases/a/case.yaml", line: int = 3, where: str = "run", found: str = "x") -> Problem:
    return Problem(file, line, where, found, "a number", "write one")


def test_message_has_the_place_then_found_expected_and_repair() -> None:
    assert str(problem()) == ("cases/a/case.yaml:3: run\n  found:    x\n  expected: a number\n  repair:   write one")


def test_message_without_a_field_ends_its_first_line_after_the_line_number() -> None:
    assert str(problem(where="")).splitlines()[0] == "cases/a/case.yaml:3:"


def test_further_lines_are_aligned_under_the_first() -> None:
    assert str(problem(found="\none\ntwo\n")).splitlines()[1:3] == ["  found:    one", "            two"]


def test_a_name_does_not_speak_to_the_terminal() -> None:
    assert str(problem(file="cases/\x1b[31mred\u202e", found="a\x07")).splitlines()[:2] == [
        "cases/?[31mred?:3: run",
        "  found:    a?",
    ]


def test_problems_are_by_case() -> None:
    one, other = problem(), problem(file="messages.yaml")
    assert problems_by_case([one, other]) == {"a": [one], "": [other]}


def test_error_holds_each_problem_once_sorted_by_file_then_line() -> None:
    late, early, other = problem(line=10), problem(line=9), problem(file="cases/b/case.yaml", line=1)

    error = CaseError([other, late, early, late])

    assert error.problems == (early, late, other)
    assert str(error) == f"{early}\n{late}\n{other}"


@pytest.mark.parametrize(
    ("word", "guess"),
    [
        pytest.param("titel", "title", id="letters-swapped"),
        pytest.param("title", "title", id="the-word-itself"),
        pytest.param("zzz", None, id="nothing-alike"),
        pytest.param("camera", None, id="too-little-alike"),
        pytest.param("", None, id="empty"),
    ],
)
def test_closest(word: str, guess: str | None) -> None:
    assert closest(word, ["tags", "title", "number"]) == guess


@pytest.mark.parametrize(
    ("names", "text"),
    [
        pytest.param([], "none", id="none"),
        pytest.param(["a"], "a", id="one"),
        pytest.param(["a", "b", "c"], "a, b, c", id="as-many-as-fit"),
        pytest.param(["a", "b", "c", "d", "e"], "a, b, c, and 2 more", id="too-many"),
    ],
)
def test_listed(names: list[str], text: str) -> None:
    assert listed(names, limit=3) == text
