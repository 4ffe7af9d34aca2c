"""Cases dropped in by authors, or begun by `clinic new`: all that a case has follows, with nothing else edited."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from clinic.commands import scaffold
from clinic.commands.check import check_cases
from clinic.publish.site import make_site
from clinic.record.checkout import cache_folder
from clinic.work.cache import Cache
from helpers import MODEL, RECORD, write_case, write_folder

pytestmark = pytest.mark.xdist_group("site")
PARTS = ("cases", "docs", "pyproject.toml", "package.json", "package-lock.json")


@pytest.fixture(scope="module")
def checkout(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the checkout."""
    made = tmp_path_factory.mktemp("checkout")
    for name in PARTS:
        copy = shutil.copytree if (root / name).is_dir() else shutil.copy
        copy(root / name, made / name)
    return made


@pytest.fixture(scope="module")
def begun(checkout: Path) -> list[str]:
    """A new case of each kind, by its slug."""
    kinds = scaffold.SOURCES
    return [
        scaffold.write_case(checkout, f"begun-in-{kind}", f"It is askew in {kind}", kind, "drifts").name
        for kind in kinds
    ]


def test_a_new_case_passes_every_law(root: Path, checkout: Path, begun: list[str]) -> None:
    for report in check_cases(checkout, begun, Cache(cache_folder(root))):
        assert (report.problems, report.breaches) == ((), ())
        assert report.evidence is not None


DROPPED = """\
title: A crate sinks through the ground
model: model.xml
symptom: A crate is let go above the ground and falls on, out of sight.
diagnosis: Print `data.ncon` while it falls. There are {{ broken.contacts.max }} contacts at most.
cause: The masks of the two share no bit.
fix: Let them share one.
lesson: Look at the masks before the solver.
tags: [contact]
phrases: [crate sinks through the ground in mujoco]
run: {duration: 0.4}
signals:
  contacts: {path: ncon}
checks:
  broken: [{signal: contacts, take: max, equals: 0}]
  fixed: [{signal: contacts, take: max, equals: 4}]
fixes:
  - id: share-a-bit
    title: Remove the masks
    edits: [{find: ' contype="2" conaffinity="2"', replace: ''}]
"""
"""The smallest record: the fields of prose, what is measured, what well means, one repair."""


def test_the_smallest_record_has_a_page_a_card_a_search_entry_and_passes(root: Path, tmp_path: Path) -> None:
    for name in set(PARTS) - {"cases"}:
        (shutil.copytree if (root / name).is_dir() else shutil.copy)(root / name, tmp_path / name)
    write_case(tmp_path)
    folder = write_folder(tmp_path, "crate-sinks", {"case.yaml": DROPPED, "model.xml": MODEL})
    cache = Cache(cache_folder(root))

    (report,) = check_cases(tmp_path, [folder.name], cache)
    site = make_site(tmp_path, cache)

    assert (report.problems, report.breaches, report.grade) == ((), (), "B")
    assert [problem for problem in site.problems if problem.file.startswith("cases/")] == []  # docs name cases of ours
    page, home = site.files["cases/crate-sinks/index.md"].decode(), site.files["index.md"].decode()
    assert "\n# A crate sinks through the ground\n" in page
    assert "Grade B: the record does not say " in page
    assert "crate sinks through the ground in mujoco" in page
    assert {"film.mp4", "broken.webp", "plot.svg"} <= {
        Path(name).name for name in site.files if name.startswith("cases/crate-sinks/")
    }
    assert home.rindex("cases/crate-sinks/index.html") > home.rindex("cases/falling-box/index.html")
    assert "A crate sinks through the ground" in str(site.navigation)


def test_folders_dropped_in_become_cases(root: Path, checkout: Path, begun: list[str]) -> None:
    write_case(checkout, ("number: 1", "number: 9999"), slug="dropped-in", record=RECORD, model=MODEL)

    site = make_site(checkout, Cache(cache_folder(root)))

    assert site.problems == ()
    assert b"# 9999. A box falls through the floor" in site.files["cases/dropped-in/index.md"]
    assert {"evidence.json", "plot.svg", "model.xml", "case.yaml"} <= {
        Path(name).name for name in site.files if name.startswith("cases/dropped-in/")
    }
    for slug in ("dropped-in", *begun):
        assert f"cases/{slug}/index.md" in str(site.navigation)
        assert f"cases/{slug}/index.html".encode() in site.files["index.md"]
