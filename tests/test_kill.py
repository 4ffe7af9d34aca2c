"""A build killed at any moment leaves a cache from which the next build makes the same bytes."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from clinic.work.cache import Cache
from project import SILENT, bytes_of, run, settings, write_project

BUILD = """
import os, signal, sys
from pathlib import Path
from clinic.work.cache import Cache
from clinic.record.case import load_cases
from clinic.record.checkout import cache_folder
from clinic.pages.case_files import files_of_cases

last, half, made, replace = int(sys.argv[1]), sys.argv[2] == "half", 0, os.replace

def counted(part, path):
    global made
    made += 1
    if made == last:
        if half:
            os.truncate(part, os.path.getsize(part) // 2)
        else:
            replace(part, path)
        os.killpg(0, signal.SIGKILL)
    replace(part, path)

os.replace = counted
for slug, files in files_of_cases(load_cases(Path("cases")), Cache(cache_folder(Path())))[0].items():
    Path("out", slug).mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        Path("out", slug, name).write_bytes(content)
"""
ENTRIES = 7
pytestmark = pytest.mark.xdist_group("kill")


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built without disturbance."""
    folder = write_project(tmp_path_factory.mktemp("project"), SILENT)
    done = run(folder, "-c", BUILD, "0", "whole")
    assert done.returncode == 0, done.stderr
    return folder


def test_every_result_is_kept_as_soon_as_it_is_made(project: Path) -> None:
    assert len(list((project / "cache").iterdir())) == ENTRIES


def test_a_build_killed_again_and_again_ends_with_the_same_bytes(project: Path, tmp_path: Path) -> None:
    folder = write_project(tmp_path, SILENT)
    kept = 0
    for how in ("whole", "half", "whole"):
        done = run(folder, "-c", BUILD, "1", how, CLINIC_JOBS="2")
        assert done.returncode == -signal.SIGKILL, done.stderr
        kept += how == "whole"
        assert len(list((folder / "cache").glob("*.bin"))) == kept
    assert len(list((folder / "cache").glob("*.part"))) == 1

    done = run(folder, "-c", BUILD, "0", "whole")

    assert done.returncode == 0, done.stderr
    assert bytes_of(folder / "out") == bytes_of(project / "out")
    assert {path.name for path in (folder / "cache").glob("*.bin")} == {p.name for p in (project / "cache").iterdir()}


def test_builds_at_the_same_time_share_a_cache(project: Path, tmp_path: Path) -> None:
    folders = [write_project(tmp_path / name, SILENT) for name in ("one", "other")]
    shared = {"CLINIC_CACHE": str(tmp_path / "cache")}
    command = [sys.executable, "-c", BUILD, "0", "whole"]
    running = [subprocess.Popen(command, cwd=folder, env=settings(folder) | shared) for folder in folders]
    assert [process.wait() for process in running] == [0, 0]
    for folder in folders:
        assert bytes_of(folder / "out") == bytes_of(project / "out")
    assert len(list((tmp_path / "cache").iterdir())) == ENTRIES


def test_damaged_entries_are_made_again(project: Path, tmp_path: Path) -> None:
    folder = write_project(tmp_path, SILENT)
    (folder / "cache").mkdir()
    damages = (bytes, lambda b: b[: len(b) // 2], lambda b: b[:-1] + bytes([b[-1] ^ 1]), lambda b: b"garbage" * 99)
    for k, path in enumerate(sorted((project / "cache").iterdir())):
        (folder / "cache" / path.name).write_bytes(damages[k % len(damages)](path.read_bytes()))
    whole = [path for path in (folder / "cache").iterdir() if Cache(folder / "cache").get(path.stem) is not None]
    assert 0 < len(whole) < ENTRIES

    done = run(folder, "-c", BUILD, "0", "whole")

    assert done.returncode == 0, done.stderr
    assert bytes_of(folder / "out") == bytes_of(project / "out")


def test_a_build_without_a_cache_says_so_once_and_makes_the_same_bytes(project: Path, tmp_path: Path) -> None:
    folder = write_project(tmp_path, SILENT)
    (folder / "file").write_text("", encoding="utf-8")

    done = run(folder, "-c", BUILD, "0", "whole", CLINIC_CACHE=str(folder / "file" / "cache"))

    assert done.returncode == 0, done.stderr
    assert done.stderr.count("takes no files") == 1
    assert bytes_of(folder / "out") == bytes_of(project / "out")
