"""The adapter for MkDocs: what it hands over besides the pages."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from project import SILENT, run, write_project

pytestmark = pytest.mark.xdist_group("kill")


def linked(page: Path) -> set[str]:
    """The cases that a page's navigation links to."""
    navigation = re.search(
        r'<nav class="md-nav md-nav--primary.*?\n</nav>', page.read_text(encoding="utf-8"), re.DOTALL
    )
    assert navigation is not None
    return set(re.findall(r'href="[^"]*?([a-z-]+\d*)/index\.html"', navigation[0]))


def test_a_page_among_many_links_to_its_section_alone(tmp_path: Path, kept: Path) -> None:
    folder = write_project(tmp_path, SILENT, kept=kept)
    for number in range(3, 56):
        case = folder / "cases" / f"case-{number}"
        case.mkdir()
        (case / "case.yaml").write_text(f"number: {number}\ntitle: Case {number}\n", encoding="utf-8")
    done = run(folder, "-m", "mkdocs", "build")
    assert done.returncode == 0, done.stderr
    site = folder / "site"
    first, last = ({f"case-{number}" for number in numbers} for numbers in (range(3, 51), range(51, 56)))
    assert linked(site / "cases" / "case-55" / "index.html") & (first | last) == last - {"case-55"}
    assert linked(site / "cases" / "case-9" / "index.html") & first == first - {"case-9"}
    assert not linked(site / "symptoms.html") & (first | last)
