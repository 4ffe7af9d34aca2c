"""The laws, over every case. The folder is the registry: nothing here lists cases."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.proof.laws import LAWS, breaches
from clinic.proof.releases import read_lock
from clinic.record.case import load_case, read_cases


@pytest.mark.parametrize("law", LAWS)
def test_law(slug: str, law: str, proven) -> None:
    case, evidence = proven(slug)

    found = breaches(case, evidence, law)

    assert not found, f"case {case.record.number} {slug}:\n" + "\n".join(map(str, found))


def test_every_case_that_releases_were_asked_about_is_grade_a(root: Path) -> None:
    lacking = {slug: list(load_case(root / "cases" / slug).lacking) for slug in read_lock(root)}
    assert {slug: fields for slug, fields in lacking.items() if fields} == {}


def test_every_file_belongs_to_a_case_and_every_relation_resolves(root: Path) -> None:
    cases = read_cases(root / "cases")[0]

    assert {case.slug for case in cases} == {path.name for path in (root / "cases").iterdir()}
