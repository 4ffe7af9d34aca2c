"""Finding a case by its symptom."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.pages.cases import CasePage
from clinic.pages.symptoms import HEADINGS, symptoms_page
from clinic.record.case import Case
from clinic.record.problem import CaseError
from helpers import tiny_case


def looking(root: Path, looks: str) -> Case:
    return tiny_case(root, ("tags: [contact]", f"tags: [contact]\nlooks: {looks}"))


def page_with(case: Case) -> str:
    return symptoms_page([CasePage(case, "", "It falls.", {})])


def test_a_case_without_a_place_stands_at_the_end(tmp_path: Path) -> None:
    assert "falls through the floor" in page_with(tiny_case(tmp_path)).partition("## Something else")[2]


def test_a_look_that_does_not_exist_is_a_problem(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="looks"):
        looking(tmp_path, "[smells]")


def test_the_page_lists_a_case_under_each_of_its_looks(tmp_path: Path) -> None:
    case = looking(tmp_path, "[sags, explodes]")
    page = page_with(case)
    assert [heading.title for heading in HEADINGS.values() if f"## {heading.title} {{" not in page] == []
    for look in ("sags", "explodes"):
        part = page.partition(f"{{ #{look} }}")[2].partition("\n## ")[0]
        assert f"[1. A box falls through the floor](cases/{case.slug}/index.md)" in part
    assert page.count("No case yet.") == len(HEADINGS) - 2
