"""The adapter for MkDocs: what it hands over besides the pages."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from project import SILENT, run, write_project

pytestmark = pytest.mark.xdist_group("kill")
RECORD = "cases/falling-box/case.yaml"
DIRTY = """
import sys
from pathlib import Path
import markdown
from mkdocs.commands.build import build
from mkdocs.config import load_config

converted, convert = [], markdown.Markdown.convert
markdown.Markdown.convert = lambda self, text: converted.append(text) or convert(self, text)
for old, new in (("", ""), ("Look at the masks.", "Look twice."), ("title: A box", "title: One box")):
    path = Path(sys.argv[1])
    path.write_text(path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    converted.clear()
    build(load_config(site_dir="site"), dirty=True)
    print(len(converted))
"""


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


def test_a_dirty_build_converts_what_changed_and_everything_if_the_navigation_did(tmp_path: Path, kept: Path) -> None:
    folder = write_project(tmp_path, SILENT, kept=kept)
    done = run(folder, "-c", DIRTY, RECORD)
    assert done.returncode == 0, done.stderr
    first, prose, title = map(int, done.stdout.split())
    assert 0 < prose < first / 2
    assert title >= prose + 4
    page = (folder / "site" / "cases" / "falling-box" / "index.html").read_text(encoding="utf-8")
    assert "Look twice." in page
    assert "One box" in page
    assert "One box" in (folder / "site" / "symptoms.html").read_text(encoding="utf-8")


def test_the_server_watches_what_pages_are_made_of(root: Path) -> None:
    watched = (root / "mkdocs.yml").read_text(encoding="utf-8").partition("\nwatch:\n")[2].split()
    assert {"cases", "scripts"} <= set(watched)
