"""Fixtures that several test modules share."""

from __future__ import annotations

import fcntl
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import hosted
import pytest
from clinic.proof.evidence import Evidence
from clinic.proof.experiments import ALL, measure_case
from clinic.record.case import Case, load_case
from clinic.record.checkout import cache_folder
from clinic.work.cache import Cache
from playwright.sync_api import Browser, Page, sync_playwright
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


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    """An empty one."""
    return Cache(tmp_path / "cache")


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
            made[slug] = case, measure_case(case, Cache(cache_folder(ROOT)), ALL)
        return made[slug]

    return get


@pytest.fixture(scope="session")
def site(root: Path, tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    """The strict build, made once for all workers of a session."""
    base = tmp_path_factory.getbasetemp()
    out = (base if worker_id == "master" else base.parent) / "built"
    out.mkdir(exist_ok=True)
    with open(out / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (out / "site").exists():
            cache = str(cache_folder(root))
            done = run(root, "-m", "mkdocs", "build", "--strict", "--site-dir", str(out / "new"), CLINIC_CACHE=cache)
            assert done.returncode == 0, done.stderr
            (out / "new").rename(out / "site")
    return out / "site"


@pytest.fixture(scope="module")
def served(site: Path) -> Iterator[str]:
    """The address of the built site."""
    with hosted.served(site) as address:
        yield address


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium; of a module, since other modules' loops of events do not run beside it."""
    path = shutil.which("chromium") or shutil.which("google-chrome")
    assert path, "no Chromium on this system: run `make setup`, or install the package chromium"
    with sync_playwright() as playwright:
        made = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-gpu"])
        yield made
        made.close()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """A page without a past, and without the policy, which forbids what Playwright waits with: see `test_policy.py`."""
    context = browser.new_context(bypass_csp=True)
    yield context.new_page()
    context.close()
