"""Work in parallel: in processes of this machine, or on the Dask cluster that CLINIC_DASK names.

A worker of a cluster gets functions by their names and runs its own copy of this package. So each must have what the
results depend on as this process has it, and one thread, for MuJoCo's warnings are heard process by process.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from clinic.engine import node
from clinic.work.cache import dependencies

PATIENCE = 5.0  # s
T = TypeVar("T")


class ClusterError(ConnectionError):
    """Work that cannot be run in parallel as the environment asks; the message says why and what to do."""


def parallel(work: Callable[..., T], tasks: Sequence[tuple[Any, ...]]) -> Iterator[T]:
    """What `work` gives for the arguments of every task, in the order in which they come to an end.

    Raises:
        ClusterError: If CLINIC_DASK names a cluster that is not there, is not fit, or breaks off.
    """
    if not tasks:
        return
    import joblib

    warnings.filterwarnings("ignore", "A worker stopped", UserWarning)  # one that has grown by 300 MB is replaced
    address, here = os.environ.get("CLINIC_DASK"), joblib.parallel_config(n_jobs=min(jobs(), len(tasks)))
    with _cluster(address) if address else here:
        yield from joblib.Parallel(return_as="generator_unordered")(joblib.delayed(work)(*task) for task in tasks)


def jobs() -> int:
    """How many processes of this machine to use: CLINIC_JOBS, or one a processor."""
    import joblib

    return int(os.environ.get("CLINIC_JOBS") or joblib.cpu_count())


def versions() -> dict[str, str | None]:
    """What the results of this process depend on."""
    return {**dependencies(), "node": node.release(), node.MUJOCO: node.version(node.MUJOCO)}


@contextmanager
def _cluster(address: str) -> Iterator[None]:
    """Has joblib use the cluster, if all its workers would give this process's results."""
    import joblib

    try:
        from distributed import Client

        with Client(address, timeout=PATIENCE, set_as_default=False) as client:  # type: ignore[no-untyped-call]
            client.wait_for_workers(1, timeout=PATIENCE)
            threads = client.nthreads()
            compare({name: {**found, "threads": threads[name]} for name, found in client.run(versions).items()})
            with joblib.parallel_config(backend="dask", client=client):
                yield
    except Exception as error:
        found = f"{type(error).__name__}: {error}".splitlines()[0]
        raise ClusterError(f"nothing can be run on CLINIC_DASK, {address} ({found})") from None


def compare(workers: dict[str, dict[str, object]]) -> None:
    """Refuses a cluster, given the `versions` and threads of each worker, if one of them would give other results.

    Raises:
        ClusterError: For the first difference.
    """
    wanted = {**versions(), "threads": 1}
    for worker, found in workers.items():
        for name, value in wanted.items():
            if found.get(name) != value:
                raise ClusterError(f"the worker {worker} has {name} {found.get(name)} instead of {value}")
