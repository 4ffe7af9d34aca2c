"""The site of the last build is used again if nothing that it was made from has changed, and only then."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from clinic.publish.kept_site import INPUTS, cached_or_new_site
from clinic.publish.site_files import Site
from clinic.record.checkout import cache_folder
from clinic.record.problem import Problem
from clinic.work.cache import Cache
from project import bytes_of, run

SITE = Site({"index.md": b"# Home\n", "cases/a/film.mp4": b"film"}, [{"Home": "index.md"}])
WRONG = Site({}, [], (Problem("f", 1, "", "a", "b", "c"),))
FILE = "cases/a/file.txt"
WATCH = """
import os, sys
from pathlib import Path
opened = set()
sys.addaudithook(lambda event, said: opened.add(said[0]) if event == "open" else None)
from clinic.work.cache import Cache
from clinic.publish.kept_site import INPUTS
from clinic.publish.site import make_site
root, kept = Path(sys.argv[1]), Path(sys.argv[2])
make_site(root, Cache(kept))
paths = {Path(os.fsdecode(path)).resolve() for path in opened if isinstance(path, str | bytes)}
known = [kept, Path(sys.prefix), *(root / name for name in (*INPUTS, "scripts/clinic", "node_modules", ".venv"))]
read = (path for path in paths if path.is_file() and path.is_relative_to(root))
print(*sorted(str(path) for path in read if not any(path.is_relative_to(other) for other in known)))
"""
IMPORTS = """
import sys
from mkdocs.__main__ import cli
try:
    cli(["build", "--strict", "--site-dir", sys.argv[1]])
finally:
    print(*sorted({"mujoco", "numpy", "pydantic", "clinic.publish.site"} & sys.modules.keys()))
"""


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    folder = tmp_path / "checkout"
    for name in INPUTS:
        path = folder / (name if "." in name else f"{name}/a/file.txt")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name, encoding="utf-8")
    return folder


@pytest.fixture
def build(checkout: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch) -> Callable[..., bool]:
    """Builds; whether the site was made, and not found."""

    def run_build(make: Callable[[Path, Cache], Site] = lambda root, cache: SITE) -> bool:
        made = []
        monkeypatch.setattr("clinic.publish.site.make_site", lambda *given: made.append(make(*given)) or made[0])
        assert cached_or_new_site(checkout, Cache(cache.folder)) == (made[0] if made else SITE)
        return bool(made)

    return run_build


def write(name: str, text: str = "other") -> Callable[[Path], object]:
    return lambda folder: (folder / name).write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    "change",
    [
        *(pytest.param(write(name if "." in name else f"{name}/a/file.txt"), id=name) for name in INPUTS),
        pytest.param(lambda folder: (folder / FILE).unlink(), id="a file less"),
        pytest.param(lambda folder: (folder / FILE).rename(folder / "cases/a/b.txt"), id="another name"),
        pytest.param(lambda folder: (folder / "cases/b").mkdir(), id="an empty folder"),
    ],
)
def test_a_changed_input_makes_the_site_anew(
    checkout: Path, build: Callable[..., bool], change: Callable[[Path], object]
) -> None:
    assert [build(), build()] == [True, False]
    change(checkout)
    assert build()


def test_another_package_or_another_node_makes_the_site_anew(
    build: Callable[..., bool], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build()
    (tmp_path / "numpy-99.0.dist-info").mkdir()
    monkeypatch.syspath_prepend(str(tmp_path))
    assert [build(), build()] == [True, False]
    monkeypatch.setattr("clinic.publish.kept_site.shutil.which", lambda name: __file__)
    assert build()


@pytest.mark.parametrize("spoil", ["problem", "incomplete", "changed meanwhile"])
def test_a_site_that_is_not_whole_is_not_kept(build: Callable[..., bool], spoil: str) -> None:
    def make(root: Path, cache: Cache) -> Site:
        cache.incomplete = spoil == "incomplete"
        if spoil == "changed meanwhile":
            write(FILE)(root)
        return WRONG if spoil == "problem" else SITE

    build(make)
    assert build()


@pytest.mark.xdist_group("site")
def test_a_build_reads_nothing_that_it_does_not_depend_on(root: Path) -> None:
    done = run(root, "-c", WATCH, str(root), str(cache_folder(root)))
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [], "a build reads it: add it to INPUTS in scripts/clinic/publish/kept_site.py"


@pytest.mark.xdist_group("site")
def test_an_unchanged_site_is_built_without_what_makes_it(root: Path, tmp_path: Path) -> None:
    cache = str(cache_folder(root))
    builds = [run(root, "-c", IMPORTS, str(tmp_path / str(k)), CLINIC_CACHE=cache) for k in range(2)]
    assert [done.returncode for done in builds] == [0, 0], builds[0].stderr
    assert builds[1].stdout.split() == []
    assert bytes_of(tmp_path / "0") == bytes_of(tmp_path / "1")
