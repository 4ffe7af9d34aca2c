"""Fixtures that several test modules share."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from clinic.cache import Cache
from clinic.case import Case, load_case
from clinic.checkout import cache_folder
from clinic.evidence import Evidence
from clinic.exhibit import evidence_of, exhibits
from project import SILENT, run, write_project

if "PYTEST_XDIST_WORKER" in os.environ:
    os.environ.setdefault("CLINIC_JOBS", "1")  # the tests' own processes are as many as there are processors
ROOT = Path(__file__).parent.parent
SLUGS = sorted(path.name for path in (ROOT / "cases").iterdir() if path.is_dir())

Proven = Callable[[str], tuple[Case, Evidence]]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Runs a test that asks for `slug` once for every folder of cases/; a case's tests share a worker."""
    if "slug" in metafunc.fixturenames:
        marked = [pytest.param(slug, id=slug, marks=pytest.mark.xdist_group(slug)) for slug in SLUGS]
        metafunc.parametrize("slug", marked)


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The cache of the small project without a film, built once: tests that begin with it build what they change."""
    folder = write_project(tmp_path_factory.mktemp("kept"), SILENT)
    done = run(folder, "-m", "mkdocs", "build", "--strict")
    assert done.returncode == 0, done.stderr
    return folder / "cache"


@pytest.fixture(scope="session")
def proven() -> Proven:
    """A case and its evidence by slug, made once."""
    made: dict[str, tuple[Case, Evidence]] = {}

    def get(slug: str) -> tuple[Case, Evidence]:
        if slug not in made:
            case = load_case(ROOT / "cases" / slug)
            made[slug] = case, evidence_of(exhibits(case, Cache(cache_folder(ROOT))))
        return made[slug]

    return get
