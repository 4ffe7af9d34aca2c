"""Tags, symptoms, phrases and relatives, held against the words of the record."""

from __future__ import annotations

from dataclasses import replace

import pytest
from clinic.proof.filing import filing_problems
from clinic.record.claims import Claims
from helpers import tiny_case


@pytest.mark.parametrize(
    ("change", "where"),
    [
        (("tags: [contact]", "tags: [contact, actuator]"), ["tags[1]"]),
        (("tags: [contact]", "tags: [contact, code]"), ["tags[1]"]),
        (("film:", "family: falls-through\nfilm:"), []),
        (("film:", "family: oscillates\nfilm:"), ["family"]),
    ],
)
def test_a_case_is_filed_under_its_own_words(tmp_path, change: tuple[str, str], where: list[str]) -> None:
    case = replace(tiny_case(tmp_path, change), claims=Claims())
    assert [problem.where for problem in filing_problems({case.slug: case})] == where


def test_a_first_version_is_filed_where_its_author_says(tmp_path) -> None:
    case = tiny_case(tmp_path, ("film:", "family: oscillates\nfilm:"))
    assert [*filing_problems({case.slug: case})] == []


@pytest.mark.parametrize(
    ("phrase", "wrong"),
    [("mujoco servo oscillates", True), ("mujoco box sinks", False), ("the servo does not oscillate", False)],
)
def test_a_phrase_is_of_its_own_case(tmp_path, phrase: str, wrong: bool) -> None:
    mine = tiny_case(tmp_path / "mine", ("[box falls through floor]", f"[box falls through floor, {phrase}]"))
    theirs = tiny_case(tmp_path / "theirs", ("title: A box falls", "title: The servo oscillates, a box falls"))
    told = [problem.where for problem in filing_problems({"mine": mine, "theirs": theirs})]
    assert told == ["phrases[1]"] * wrong


@pytest.mark.parametrize(("tags", "wrong"), [("[contact]", False), ("[floor]", True)])
def test_relatives_have_something_in_common(tmp_path, tags: str, wrong: bool) -> None:
    mine = tiny_case(tmp_path / "mine", ("film:", "see: [theirs]\nfilm:"))
    theirs = tiny_case(tmp_path / "theirs", ("tags: [contact]", f"tags: {tags}"))
    assert [p.where for p in filing_problems({"mine": mine, "theirs": theirs})] == ["see[0]"] * wrong
