"""A Dask cluster gives the same bytes as this machine, however many workers it has; one that is not fit is refused."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from clinic.work.parallel import ClusterError, compare, jobs, parallel, versions
from helpers import SWEEP, changed
from project import run, settings, write_project

pytestmark = pytest.mark.xdist_group("cluster")
CLUSTER = """
import sys
from distributed import LocalCluster
with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as made:
    print(made.scheduler_address, flush=True)
    sys.stdin.read()
"""
MANY_POINTS = changed(SWEEP, ("values: [1, 2, 4, 8]", "start: 1, stop: 8, count: 100"))
RUN = """
import hashlib, sys
from pathlib import Path
from clinic.work.cache import Cache
from clinic.record.case import load_cases
from clinic.pages.case_files import files_of_cases
for slug, files in files_of_cases(load_cases(Path("cases")), Cache(Path(sys.argv[1])))[0].items():
    for name, content in files.items():
        print(slug, name, hashlib.sha256(content).hexdigest())
"""


@contextmanager
def cluster(folder: Path, **environment: str) -> Iterator[str]:
    """A cluster of two workers on this machine, by its scheduler's address."""
    surroundings = settings(folder) | environment
    surroundings.pop("PYOPENGL_PLATFORM", None)  # which this process has from importing MuJoCo
    with subprocess.Popen(
        [sys.executable, "-c", CLUSTER],
        cwd=folder,
        env=surroundings,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as made:
        assert made.stdin is not None
        assert made.stdout is not None
        yield made.stdout.readline().strip()
        made.stdin.close()


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The small project, with a sweep of more than one task."""
    return write_project(tmp_path_factory.mktemp("project"), ("no_sweep: The masks are not a number.\n", MANY_POINTS))


def test_a_cluster_of_two_gives_the_bytes_of_one_process(project: Path) -> None:
    alone = run(project, "-c", RUN, "one", CLINIC_JOBS="1")
    assert alone.returncode == 0, alone.stderr
    with cluster(project) as address:
        done = run(project, "-c", RUN, "cluster", CLINIC_DASK=address)
    assert done.returncode == 0, done.stderr
    assert done.stdout == alone.stdout
    assert "falling-box film.mp4" in done.stdout


def test_a_worker_with_another_checkout_is_refused(project: Path, tmp_path: Path) -> None:
    shutil.copytree(project / "scripts" / "clinic", tmp_path / "clinic")
    with open(tmp_path / "clinic/record/case.py", "a", encoding="utf-8") as file:
        file.write("# another\n")
    with cluster(project, PYTHONPATH=str(tmp_path)) as address:
        done = run(project, "-c", RUN, str(tmp_path / "cache"), CLINIC_DASK=address)
    last = done.stderr.splitlines()[-1]
    assert last.startswith("clinic.work.parallel.ClusterError: the worker tcp://")
    assert " has clinic " in last
    assert not (tmp_path / "cache").exists()


@pytest.mark.parametrize(("name", "value"), [("threads", 2), ("mujoco", "3.9.0"), ("MUJOCO_GL", "osmesa")])
def test_a_worker_that_would_give_other_results_is_refused(name: str, value: object) -> None:
    fit = {**versions(), "threads": 1}
    compare({"tcp://one": fit, "tcp://two": fit})
    with pytest.raises(ClusterError, match=f"^the worker tcp://two has {name} {value} instead of"):
        compare({"tcp://one": fit, "tcp://two": {**fit, name: value}})


@pytest.mark.parametrize("command", [("clinic", "check"), ("mkdocs", "build")])
def test_a_scheduler_that_does_not_answer_is_one_message(
    project: Path, tmp_path: Path, command: tuple[str, ...]
) -> None:
    address = "tcp://127.0.0.1:9"
    done = run(project, "-m", *command, CLINIC_DASK=address, CLINIC_CACHE=str(tmp_path))
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert f"nothing can be run on CLINIC_DASK, {address} (" in " ".join(done.stderr.split())


def test_nothing_to_run_asks_no_cluster(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CLINIC_DASK", "tcp://127.0.0.1:9")
    assert list(parallel(abs, [])) == []


@pytest.mark.parametrize("setting", ["1", "7"])
def test_jobs_can_be_set(monkeypatch: pytest.MonkeyPatch, setting: str) -> None:
    monkeypatch.setenv("CLINIC_JOBS", setting)
    assert jobs() == int(setting)
