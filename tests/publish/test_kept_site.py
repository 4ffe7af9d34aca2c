"""A finished site is found again if nothing that it hangs on has changed, and only then."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from clinic.publish import kept_site as module
from clinic.publish.kept_site import INPUTS, Site, finished
from clinic.record.checkout import cache_folder
from clinic.record.problem import Problem
from clinic.work.cache import Cache
from project import bytes_of, run

FILES = {"index.md": b"# Home\n", "cases/a/index.md": b"# A\n", "cases/a/film.mp4": b"film"}
SITE = Site(FILES, [{"Home": "index.md"}])
WATCH = """
import os, sys
from pathlib import Path
opened = set()
sys.addaudithook(lambda event, said: opened.add(said[0]) if event == "open" else None)
from clinic.work.cache import Cache
from clinic.publish.kept_site import stamps
from clinic.publish.site import survey
root, kept = Path(sys.argv[1]), Path(sys.argv[2])
survey(root, Cache(kept))
known = {Path(root, name).resolve() for name, *_ in stamps(root)}
own = ("scripts/clinic", "node_modules", ".cache", ".venv")
apart = [kept, Path(sys.prefix), *(root / name for name in own)]
paths = {Path(os.fsdecode(path)).resolve() for path in opened if isinstance(path, str | bytes)}
files = (path for path in paths - known if path.is_file() and path.is_relative_to(root))
print(*sorted(str(path) for path in files if not any(path.is_relative_to(other) for other in apart)))
"""
FIRST = """
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
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "cache")


def fail(*_: object) -> Site:
    raise AssertionError("made, and not found")


def keep(checkout: Path, cache: Cache) -> None:
    assert finished(checkout, cache, lambda *_: SITE) == SITE
    assert finished(checkout, Cache(cache.folder), fail) == SITE


def is_made(checkout: Path, cache: Cache) -> bool:
    """Whether a site is made, and not found; nothing is kept."""
    other = Site({}, [], (Problem("f", 1, "", "a", "b", "c"),))
    return finished(checkout, Cache(cache.folder), lambda *_: other) is other


def test_an_unchanged_site_is_found_with_its_files_in_order(checkout: Path, cache: Cache) -> None:
    keep(checkout, cache)
    found = finished(checkout, cache, fail)
    assert list(found.files) == list(SITE.files)


def write(name: str, text: str = "other") -> Callable[[Path], object]:
    return lambda folder: (folder / name).write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    "change",
    [
        *(pytest.param(write(name if "." in name else f"{name}/a/file.txt"), id=name) for name in INPUTS),
        pytest.param(write("cases/a/more.txt"), id="a new file"),
        pytest.param(lambda folder: (folder / "cases/a/file.txt").unlink(), id="a file less"),
        pytest.param(lambda folder: (folder / "cases/a/file.txt").rename(folder / "cases/a/b.txt"), id="another name"),
        pytest.param(lambda folder: (folder / "cases/b").mkdir(), id="an empty folder"),
        pytest.param(lambda folder: (folder / "cases/b").symlink_to("a"), id="a link"),
        pytest.param(lambda folder: os.mkfifo(folder / "cases/a/pipe"), id="a pipe"),
        pytest.param(lambda folder: (folder / "CONTRIBUTING.md").unlink(), id="no CONTRIBUTING"),
        pytest.param(
            lambda folder: ((folder / "node_modules").mkdir(), write("node_modules/.package-lock.json")(folder)),
            id="Node's packages",
        ),
    ],
)
def test_a_changed_input_makes_the_site_anew(checkout: Path, cache: Cache, change: Callable[[Path], object]) -> None:
    keep(checkout, cache)
    change(checkout)
    assert is_made(checkout, cache)


def test_a_link_that_leads_elsewhere_makes_the_site_anew(checkout: Path, cache: Cache) -> None:
    link = checkout / "cases" / "b"
    link.symlink_to("a")
    keep(checkout, cache)
    link.unlink()
    link.symlink_to("c")
    assert is_made(checkout, cache)


def test_a_large_file_is_known_by_size_and_time(checkout: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "LARGE", 4)
    keep(checkout, cache)
    write("cases/a/file.txt", "sesac")(checkout)
    os.utime(checkout / "cases/a/file.txt", ns=(1, 1))
    assert is_made(checkout, cache)


def test_another_package_or_another_node_makes_the_site_anew(
    checkout: Path, cache: Cache, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    keep(checkout, cache)
    (tmp_path / "numpy-99.0.dist-info").mkdir()
    with monkeypatch.context() as changed:
        changed.syspath_prepend(str(tmp_path))
        assert is_made(checkout, cache)
    program = tmp_path / "node"
    program.write_text("#!/bin/sh\n", encoding="utf-8")
    monkeypatch.setattr(module.node, "found", lambda: [str(program)])
    assert is_made(checkout, cache)


@pytest.mark.parametrize("spoil", ["problem", "missed", "changed"])
def test_a_site_that_is_not_whole_is_not_kept(checkout: Path, cache: Cache, spoil: str) -> None:
    def make(root: Path, kept: Cache) -> Site:
        if spoil == "missed":
            kept.get("a film that cannot be made")
        if spoil == "changed":
            write("cases/a/file.txt")(root)
        return Site({}, [], (Problem("f", 1, "", "a", "b", "c"),)) if spoil == "problem" else SITE

    finished(checkout, cache, make)
    assert is_made(checkout, cache)


def test_a_site_with_a_damaged_part_is_made_again(checkout: Path, cache: Cache) -> None:
    keep(checkout, cache)
    for path in cache.folder.iterdir():
        if b"film" in (whole := path.read_bytes()):
            path.write_bytes(whole[:-1])
    assert is_made(checkout, cache)
    keep(checkout, cache)


def test_what_is_in_one_folder_is_kept_once(checkout: Path, cache: Cache) -> None:
    keep(checkout, cache)
    before = len(list(cache.folder.iterdir()))
    write("cases/a/file.txt")(checkout)
    finished(checkout, cache, lambda *_: Site({**SITE.files, "index.md": b"# Other\n"}, SITE.navigation))
    assert len(list(cache.folder.iterdir())) == before + 2  # the list, and the folder of the home page


@pytest.mark.xdist_group("site")
def test_a_build_reads_nothing_that_it_does_not_hang_on(root: Path, tmp_path: Path) -> None:
    done = run(root, "-c", WATCH, str(root), str(cache_folder(root)))
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [], "a build reads it: add it to INPUTS in scripts/clinic/finished.py"


@pytest.mark.xdist_group("site")
def test_an_unchanged_site_is_built_without_what_makes_it(root: Path, tmp_path: Path) -> None:
    cache = str(cache_folder(root))
    builds = [run(root, "-c", FIRST, str(tmp_path / str(k)), CLINIC_CACHE=cache) for k in range(2)]
    assert [done.returncode for done in builds] == [0, 0], builds[0].stderr
    assert builds[1].stdout.split() == []
    assert bytes_of(tmp_path / "0") == bytes_of(tmp_path / "1")
