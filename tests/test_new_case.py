"""A case dropped in by an author: its page, card, navigation and evidence follow, with nothing else edited."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from clinic.cache import Cache
from clinic.site import build, cache_folder, navigation
from helpers import MODEL, RECORD, write_case

pytestmark = pytest.mark.xdist_group("site")
PARTS = ("cases", "docs", "CONTRIBUTING.md", "pyproject.toml", "package.json", "package-lock.json")


def test_a_dropped_folder_becomes_a_case(root: Path, tmp_path: Path) -> None:
    for name in PARTS:
        copy = shutil.copytree if (root / name).is_dir() else shutil.copy
        copy(root / name, tmp_path / name)
    write_case(tmp_path, ("number: 1", "number: 9999"), slug="dropped-in", record=RECORD, model=MODEL)

    made = build(tmp_path, Cache(cache_folder(root)))

    assert b"# 9999. A box falls through the floor" in made["cases/dropped-in/index.md"]
    assert {"evidence.json", "plot-light.svg", "model.xml", "case.yaml"} <= {
        Path(name).name for name in made if name.startswith("cases/dropped-in/")
    }
    assert b"cases/dropped-in/index.md" in made["index.md"]
    assert "cases/dropped-in/index.md" in str(navigation(tmp_path))
