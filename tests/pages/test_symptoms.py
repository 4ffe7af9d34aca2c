"""Finding a case by its symptom."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.pages.case_page import Card
from clinic.pages.symptoms import HEADINGS, looks_of, symptom_problems, symptoms_page
from clinic.record.case import load_case
from helpers import tiny_case

PHRASES = "phrases: [box falls through floor]"


def test_phrases_put_a_case_in_its_place(tmp_path: Path) -> None:
    assert looks_of(tiny_case(tmp_path)) == ["passes-through"]


def test_looks_come_before_phrases(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, (PHRASES, f"{PHRASES}\nlooks: [sags, explodes]"))
    assert looks_of(case) == ["explodes", "sags"]


def test_a_case_that_nobody_would_find_is_a_problem(tmp_path: Path) -> None:
    assert list(symptom_problems([tiny_case(tmp_path / "found")])) == []
    problem, *others = symptom_problems([tiny_case(tmp_path / "lost", (PHRASES, "phrases: [something odd]"))])
    assert not others
    assert problem.where == "phrases"
    assert problem.repair == "add `looks: [...]`"


def test_a_case_that_nobody_would_find_stands_at_the_end(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, (PHRASES, "phrases: [something odd]"))
    page = symptoms_page([case], {case.slug: Card(case.slug, 1, case.record.title, "It falls.", "", "")})
    assert "falls through the floor" in page.partition("## Something else")[2]


def test_a_look_that_does_not_exist_is_a_problem(tmp_path: Path) -> None:
    with pytest.raises(Exception, match="looks"):
        tiny_case(tmp_path, (PHRASES, f"{PHRASES}\nlooks: [smells]"))


def test_every_case_of_the_clinic_has_a_place(slug: str, root: Path) -> None:
    assert list(symptom_problems([load_case(root / "cases" / slug)])) == []


def test_the_page_lists_each_case_under_its_looks(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    card = Card(case.slug, 1, case.record.title, "It falls.", "", "")
    page = symptoms_page([case], {case.slug: card})
    assert [heading.title for heading in HEADINGS.values() if f"## {heading.title} {{" not in page] == []
    part = page.partition("{ #passes-through }")[2].partition("\n## ")[0]
    assert f"[1. A box falls through the floor](cases/{case.slug}/index.md)" in part
    assert page.count("No case yet.") == len(HEADINGS) - 1
