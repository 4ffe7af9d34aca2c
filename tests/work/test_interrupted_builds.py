"""A build killed at any moment leaves a cache from which the next build makes the same bytes."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from project import SILENT, bytes_of, run, settings, write_project

BUILD = """
import os, signal, sys
from pathlib import Path
from clinic.work.cache import Cache
from clinic.record.case import load_cases
from clinic.record.checkout import cache_folder
from clinic.pages.exhibits import all_exhibits

how, replace = sys.argv[1], os.replace

def killed(part, path):
    if how == "half":
        os.truncate(part, os.path.getsize(part) // 2)
    else:
        replace(part, path)
    os.killpg(0, signal.SIGKILL)

if how != "undisturbed":
    os.replace = killed
for slug, files in all_exhibits(load_cases(Path("cases")), Cache(cache_folder(Path()))).items():
    Path("out", slug).mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        Path("out", slug, name).write_bytes(content)
"""
pytestmark = pytest.mark.xdist_group("kill")


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built without disturbance."""
    folder = write_project(tmp_path_factory.mktemp("project"), SILENT)
    done = run(folder, "-c", BUILD, "undisturbed")
    assert done.returncode == 0, done.stderr
    return folder


def test_a_build_killed_again_and_again_ends_with_the_same_bytes(project: Path, tmp_path: Path) -> None:
    folder = write_project(tmp_path, SILENT)
    kept = 0
    for how in ("whole", "half", "whole"):
        done = run(folder, "-c", BUILD, how, CLINIC_JOBS="2")
        assert done.returncode == -signal.SIGKILL, done.stderr
        kept += how == "whole"
        assert len(list((folder / "cache").glob("*.zip"))) == kept
    assert len(list((folder / "cache").glob("*.part"))) == 1

    done = run(folder, "-c", BUILD, "undisturbed")

    assert done.returncode == 0, done.stderr
    assert bytes_of(folder / "out") == bytes_of(project / "out")
    assert {path.name for path in (folder / "cache").glob("*.zip")} == {p.name for p in (project / "cache").iterdir()}


def test_builds_at_the_same_time_share_a_cache(project: Path, tmp_path: Path) -> None:
    folders = [write_project(tmp_path / name, SILENT) for name in ("one", "other")]
    shared = {"CLINIC_CACHE": str(tmp_path / "cache")}
    command = [sys.executable, "-c", BUILD, "undisturbed"]
    running = [subprocess.Popen(command, cwd=folder, env=settings(folder) | shared) for folder in folders]
    assert [process.wait() for process in running] == [0, 0]
    for folder in folders:
        assert bytes_of(folder / "out") == bytes_of(project / "out")
    assert len(list((tmp_path / "cache").iterdir())) == len(list((project / "cache").iterdir()))
