"""Cases in error: what is known of them, and the pages that say so."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.problem import Problem
from clinic.ward import Name, by_case, error_page, marked, ordered, read_name, without
from helpers import tiny_case, write_folder

PROBLEM = Problem("cases/falling-box/case.yaml", 7, "run", "nothing", "```a fence```", "mend it")


@pytest.mark.parametrize(
    ("record", "name"),
    [
        pytest.param("number: 7\ntitle: A title\n", Name("a-case", 7, "A title"), id="plain"),
        pytest.param('title: "A: title"  \nnumber: 7 # seven\n', Name("a-case", 7, "A: title"), id="quoted"),
        pytest.param("title: A title\n  broken: [\n", Name("a-case", None, "A title"), id="no-number"),
        pytest.param("nonsense", Name("a-case", None, "a-case"), id="nothing"),
    ],
)
def test_the_name_is_read_where_it_can_be(tmp_path: Path, record: str, name: Name) -> None:
    assert read_name(write_folder(tmp_path, "a-case", {"case.yaml": record})) == name


def test_a_folder_without_a_record_is_named_by_itself(tmp_path: Path) -> None:
    assert read_name(write_folder(tmp_path, "a-case", {})).heading == "a-case"


def test_names_are_by_number_and_those_without_come_last() -> None:
    names = [Name("c", None, "c"), Name("b", 10, "b"), Name("a", 9, "a")]
    assert [name.slug for name in ordered(names)] == ["a", "b", "c"]


def test_problems_are_by_case() -> None:
    other = Problem("messages.yaml", 1, "", "x", "y", "z")
    assert by_case([PROBLEM, other]) == {"falling-box": [PROBLEM], "": [other]}


def test_an_error_page_holds_the_message_to_the_letter() -> None:
    page = error_page('7. A "title"', [PROBLEM])
    assert 'title: "7. A \\"title\\""' in page
    assert '\n# 7. A "title"\n' in page
    for line in str(PROBLEM).splitlines():
        assert f"\n    {line}\n" in page
    assert "\n    ````text\n" in page


def test_a_marked_page_keeps_all_it_has() -> None:
    page = "---\ntitle: x\n---\n\n# 7. A title\n\nSymptom.\n# 7. A title\n"
    made = marked(page, [PROBLEM])
    assert made.index("# 7. A title") < made.index("!!! failure") < made.index("Symptom.")
    assert made.count("!!! failure") == 1


def test_relations_to_cases_that_cannot_be_shown_are_left_out(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("tags: [contact]", "tags: [contact]\nsee: [one, two]"))
    known = {"falling-box": case, "one": case}
    assert without(case, (), known).record.see == ["one"]
    assert without(case, (), {**known, "two": case}) is case
