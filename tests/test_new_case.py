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
from helpers import MODEL, RECORD, write_case

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
    return [scaffold.write_case(checkout, f"begun-in-{kind}", f"It is askew in {kind}", kind).name for kind in kinds]


def test_a_new_case_passes_every_law(root: Path, checkout: Path, begun: list[str]) -> None:
    for report in check_cases(checkout, begun, Cache(cache_folder(root))):
        assert (report.problems, report.breaches) == ((), ())
        assert report.evidence is not None


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
        assert f"cases/{slug}/index.md".encode() in site.files["index.md"]
