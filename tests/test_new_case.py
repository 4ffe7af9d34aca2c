"""Cases dropped in by authors, or begun by `clinic new`: all that a case has follows, with nothing else edited."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from clinic.commands.judgement import Neighbours, judge_folder
from clinic.commands.scaffold import Kind, start
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
def begun(checkout: Path) -> dict[Kind, Path]:
    """The folder of a new case of each kind."""
    return {kind: start(checkout, f"begun-in-{kind}", f"It stands askew in {kind}", kind) for kind in Kind}


@pytest.mark.parametrize("kind", Kind)
def test_a_new_case_passes_every_law(root: Path, checkout: Path, begun: dict[Kind, Path], kind: Kind) -> None:
    judgement = judge_folder(begun[kind], Neighbours(checkout), Cache(cache_folder(root)))
    assert (judgement.problems, judgement.breaches) == ((), ())
    assert judgement.evidence is not None


def test_folders_dropped_in_become_cases(root: Path, checkout: Path, begun: dict[Kind, Path]) -> None:
    write_case(checkout, ("number: 1", "number: 9999"), slug="dropped-in", record=RECORD, model=MODEL)

    site = make_site(checkout, Cache(cache_folder(root)))

    assert site.problems == ()
    assert b"# 9999. A box falls through the floor" in site.files["cases/dropped-in/index.md"]
    assert {"evidence.json", "plot.svg", "model.xml", "case.yaml"} <= {
        Path(name).name for name in site.files if name.startswith("cases/dropped-in/")
    }
    for slug in ("dropped-in", *(folder.name for folder in begun.values())):
        assert f"cases/{slug}/index.md" in str(site.navigation)
        assert f"cases/{slug}/index.md".encode() in site.files["index.md"]
