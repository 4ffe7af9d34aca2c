"""Law 5: numbers in prose come from the runs, quotations from the files."""

from __future__ import annotations

import pytest
from clinic.proof.evidence import collect
from clinic.proof.prose_laws import quoted, typed
from helpers import tiny_case


def case_with(tmp_path, lesson: str):
    case = tiny_case(tmp_path, ("lesson: Look at the masks.", f"lesson: |\n  {lesson}"))
    return case, collect(case)


@pytest.mark.parametrize("text", ['It has `contype="2"`.', 'Write `timestep="0.001"`.', "The attribute `contype`."])
def test_a_quotation_that_stands_in_a_variant(tmp_path, text: str) -> None:
    assert list(quoted(*case_with(tmp_path, text))) == []


def test_a_quotation_that_no_variant_has(tmp_path) -> None:
    (problem,) = quoted(*case_with(tmp_path, 'It has `contype="3" conaffinity="2"`.'))
    assert (problem.where, problem.found) == ("lesson", 'contype="3"')
    assert (problem.expected, problem.repair) == ("an attribute that some variant has", "correct the quotation")


def test_a_problem_of_prose_stands_at_the_line_of_its_words(tmp_path) -> None:
    case, evidence = case_with(tmp_path, 'One line.\n  Another.\n  It falls 3 m, and `axis="0"` is wrong.')
    lines = {problem.line - case.lines.at(("lesson",)) for law in (typed, quoted) for problem in law(case, evidence)}
    assert lines == {3}


@pytest.mark.parametrize("text", ["It falls 3 m.", "After 20ms it", "turned by 90°", "by 90 degrees", "weighs 3.9 N."])
def test_a_number_typed_by_hand(tmp_path, text: str) -> None:
    (problem,) = typed(*case_with(tmp_path, text))
    assert problem.where == "lesson"
    assert problem.found.endswith(", typed by hand")
    assert problem.repair == "write a field such as {{ broken.signal.final }}"


@pytest.mark.parametrize(
    "text", ["two boxes", "in 3 steps", "`0.5 m`", "$3 m$", "{{ broken.height.final }}", "MuJoCo 4.0 sees"]
)
def test_what_no_run_could_have_given(tmp_path, text: str) -> None:
    assert list(typed(*case_with(tmp_path, text))) == []
