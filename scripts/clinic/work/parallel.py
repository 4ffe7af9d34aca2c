"""Where work runs in parallel: in processes of this machine, or on the Dask cluster that CLINIC_DASK names.

A cluster gets functions by their names alone, so a worker runs its own copy of this package. Each must therefore have
what the results hang on as this process has it, and one thread, for MuJoCo's warnings are heard process by process.
"""

from __future__ import annotations

import os
import re
import socket
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar
from urllib.parse import urlsplit

from clinic.engine import node
from clinic.record.problem import listed
from clinic.work.cache import origin

ADDRESS, JOBS = "CLINIC_DASK", "CLINIC_JOBS"
PATIENCE = 5.0  # s
T = TypeVar("T")
Origin = dict[str, str | None]


class ClusterError(ConnectionError):
    """A cluster on which nothing can be run; the message says why and what to do."""


def parallel(work: Callable[..., T], tasks: Sequence[tuple[Any, ...]]) -> Iterator[T]:
    """What `work` gives for the arguments of every task, in the order in which they come to an end.

    Raises:
        ClusterError: If CLINIC_DASK names a cluster that is not there, is not fit, or breaks off.
    """
    if not tasks:
        return
    import joblib

    warnings.filterwarnings("ignore", "A worker stopped", UserWarning)  # one that has grown by 300 MB is replaced
    address = os.environ.get(ADDRESS)
    if not address:
        run = joblib.Parallel(n_jobs=min(jobs(), len(tasks)), return_as="generator_unordered")
        yield from run(joblib.delayed(work)(*task) for task in tasks)
        return
    with _cluster(address):
        run, wanted = joblib.Parallel(return_as="generator_unordered"), here()
        yield from run(joblib.delayed(_checked)(wanted, work, *task) for task in tasks)


def jobs() -> int:
    """How many processes of this machine to use: CLINIC_JOBS, or one a processor; -1 is all, -2 all but one.

    Raises:
        ClusterError: If CLINIC_JOBS is no such number.
    """
    if given := os.environ.get(JOBS):
        if not re.fullmatch(r"-?[1-9][0-9]{0,3}", given):
            raise ClusterError(f"{JOBS} is {given}: give how many processes to use, or nothing for one a processor")
        return int(given)
    import joblib

    return int(joblib.cpu_count())


def here() -> Origin:
    """What the results of this process hang on; with Node's part, where there is one."""
    javascript = {"node": node.release(), node.MUJOCO: node.version(node.MUJOCO)}
    return origin() | {name: version for name, version in javascript.items() if version}


def differences(wanted: Mapping[str, str | None], found: Mapping[str, str | None]) -> list[str]:
    """What differs: `mujoco 3.9.0 instead of 4.0.0`."""
    return [
        f"{name} {found.get(name) or 'none'} instead of {value or 'none'}"
        for name, value in wanted.items()
        if found.get(name) != value
    ]


@contextmanager
def _cluster(address: str) -> Iterator[None]:
    """Has joblib use the cluster, every worker of which is fit."""
    import joblib

    try:
        from distributed import Client
    except ImportError:
        raise ClusterError(f"{ADDRESS} is set, but Dask is missing: install dask[distributed]") from None
    try:
        place = urlsplit(address)
        socket.create_connection((place.hostname or "", place.port or 0), PATIENCE).close()
        client = Client(address, timeout=PATIENCE, set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as error:
        raise ClusterError(f"no Dask scheduler answers at {address} ({_first(error)}): correct {ADDRESS}") from None
    with client:
        _examine(client, address)
        try:
            with joblib.parallel_config(backend="dask", client=client):
                yield
        except ClusterError:
            raise
        except Exception as error:
            raise ClusterError(f"the cluster at {address} broke off: {type(error).__name__}: {_first(error)}") from None


def _examine(client: Any, address: str) -> None:
    """Refuses a cluster without workers, and one of whose workers the results would differ."""
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except TimeoutError:
        raise ClusterError(f"the scheduler at {address} has no workers: start `dask worker {address}`") from None
    threads = [f"{worker}: {count} threads" for worker, count in client.nthreads().items() if count != 1]
    if threads:
        raise ClusterError(f"a worker must have one thread; start it with --nthreads 1 ({listed(threads)})")
    wanted, unfit = here(), []
    for worker, found in client.run(here, on_error="return").items():
        differing = [_first(found)] if isinstance(found, Exception) else differences(wanted, found)
        if differing:
            unfit.append(f"{worker}: {listed(differing)}")
    if unfit:
        raise ClusterError(f"a worker must have the same checkout, packages and settings ({listed(unfit)})")


def _checked(wanted: Origin, work: Callable[..., T], *task: Any) -> T:
    """Does the work if this worker, which may have come later, is fit."""
    if differing := differences(wanted, here()):
        raise ClusterError(f"a worker must have the same checkout, packages and settings ({listed(differing)})")
    return work(*task)


def _first(error: BaseException) -> str:
    return (str(error).strip() or type(error).__name__).splitlines()[0]
