"""A Dask cluster: the same bytes as this machine gives, however many workers it has; and clusters that are not fit."""

from __future__ import annotations

import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from clinic.work.cache import source_digest
from clinic.work.parallel import ADDRESS, ClusterError, _checked, _examine, here, jobs, parallel
from helpers import SWEEP, changed
from project import run, settings, write_project

pytestmark = pytest.mark.xdist_group("cluster")
CLUSTER = """
import sys
from distributed import LocalCluster
workers, threads = map(int, sys.argv[1:])
with LocalCluster(n_workers=workers, threads_per_worker=threads, dashboard_address=None) as made:
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
def cluster(folder: Path, workers: int, threads: int = 1, **environment: str) -> Iterator[str]:
    """A cluster of this machine, by its scheduler's address."""
    command = [sys.executable, "-c", CLUSTER, str(workers), str(threads)]
    surroundings = settings(folder) | environment
    surroundings.pop("PYOPENGL_PLATFORM", None)  # which this process has from importing MuJoCo
    with subprocess.Popen(
        command, cwd=folder, env=surroundings, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as made:
        assert made.stdin is not None
        assert made.stdout is not None
        yield made.stdout.readline().strip()
        made.stdin.close()


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The small project, with a sweep of more than one task."""
    return write_project(tmp_path_factory.mktemp("project"), ("no_sweep: The masks are not a number.\n", MANY_POINTS))


@pytest.fixture(scope="module")
def by_one_process(project: Path) -> str:
    """The digests of the evidence, the films and the plots that one process makes."""
    done = run(project, "-c", RUN, "one", CLINIC_JOBS="1")
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_cluster_of_two_gives_the_bytes_of_one_process(project: Path, by_one_process: str) -> None:
    with cluster(project, 2) as address:
        done = run(project, "-c", RUN, "cluster", **{ADDRESS: address, "CLINIC_JOBS": "not here"})
    assert done.returncode == 0, done.stderr
    assert done.stdout == by_one_process
    assert "falling-box film.mp4" in done.stdout


def test_a_worker_with_another_checkout_is_refused(project: Path, tmp_path: Path) -> None:
    shutil.copytree(project / "scripts" / "clinic", tmp_path / "clinic")
    (tmp_path / "clinic" / "palette.py").write_text("", encoding="utf-8")
    with cluster(project, 1, PYTHONPATH=str(tmp_path)) as address:
        done = run(project, "-c", RUN, str(tmp_path / "cache"), **{ADDRESS: address})
    last = done.stderr.splitlines()[-1]
    assert last.startswith("clinic.work.parallel.ClusterError: a worker must have the same checkout")
    assert source_digest(tmp_path / "clinic") in last
    assert not (tmp_path / "cache").exists()


class Told:
    """A client whose workers say this."""

    def __init__(self, threads: int | None = 1, **changes: str | None) -> None:
        self.threads, self.said = threads, here() | changes

    def wait_for_workers(self, n_workers: int, timeout: float) -> None:
        if self.threads is None:
            raise TimeoutError

    def nthreads(self) -> dict[str, int | None]:
        return {"tcp://fit": 1, "tcp://other": self.threads}

    def run(self, work: object, on_error: str) -> dict[str, object]:
        wrong = ModuleNotFoundError("No module named 'clinic'\nmore")
        return {
            "tcp://fit": here(),
            "tcp://other": wrong if "clinic" in self.said and not self.said["clinic"] else self.said,
        }


@pytest.mark.parametrize(
    ("client", "said"),
    [
        pytest.param(Told(None), "has no workers: start `dask worker tcp://x`", id="no-workers"),
        pytest.param(Told(2), "start it with --nthreads 1 (tcp://other: 2 threads)", id="threads"),
        pytest.param(Told(mujoco="3.9.0"), "(tcp://other: mujoco 3.9.0 instead of 4.0.0)", id="another-engine"),
        pytest.param(Told(MUJOCO_GL="osmesa"), "(tcp://other: MUJOCO_GL osmesa instead of", id="another-renderer"),
        pytest.param(Told(clinic=None), "(tcp://other: No module named 'clinic')", id="no-package"),
    ],
)
def test_a_cluster_that_is_not_fit_is_refused(client: Told, said: str) -> None:
    with pytest.raises(ClusterError) as caught:
        _examine(client, "tcp://x")
    assert said in str(caught.value)


def test_a_cluster_that_is_fit_is_taken() -> None:
    _examine(Told(), "tcp://x")


def test_a_worker_that_came_later_is_asked_again() -> None:
    with pytest.raises(ClusterError, match=r"mujoco 4.* instead of 9"):
        _checked({"mujoco": "9"}, print)
    assert _checked(here(), abs, -1) == 1


@pytest.mark.parametrize(
    ("address", "command"),
    [
        pytest.param("tcp://127.0.0.1:9", ("clinic", "check"), id="nobody-listens"),
        pytest.param("nonsense", ("mkdocs", "build"), id="no-address"),
    ],
)
def test_a_scheduler_that_does_not_answer_is_one_message(
    project: Path, tmp_path: Path, address: str, command: tuple[str, ...]
) -> None:
    done = run(project, "-m", *command, **{ADDRESS: address, "CLINIC_CACHE": str(tmp_path)})
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert f"no Dask scheduler answers at {address} (" in " ".join(done.stderr.split())
    assert len(done.stderr.splitlines()) < 6


def test_a_program_that_is_no_scheduler_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        monkeypatch.setenv(ADDRESS, f"nonsense://127.0.0.1:{other.getsockname()[1]}")
        with pytest.raises(ClusterError, match="no Dask scheduler answers"):
            list(parallel(abs, [(1,)]))


def test_nothing_to_run_asks_no_cluster(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(ADDRESS, "tcp://127.0.0.1:9")
    assert list(parallel(abs, [])) == []


@pytest.mark.parametrize(("setting", "number"), [("1", 1), ("7", 7), ("-1", -1)])
def test_jobs_can_be_set(monkeypatch: pytest.MonkeyPatch, setting: str, number: int) -> None:
    monkeypatch.setenv("CLINIC_JOBS", setting)
    assert jobs() == number


@pytest.mark.parametrize("setting", ["abc", "0", "1.5", "--1"])
def test_jobs_that_are_no_number_are_told(monkeypatch: pytest.MonkeyPatch, setting: str) -> None:
    monkeypatch.setenv("CLINIC_JOBS", setting)
    with pytest.raises(ClusterError, match=f"^CLINIC_JOBS is {setting}: give how many"):
        list(parallel(abs, [(1,)]))
