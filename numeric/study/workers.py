"""This runs one task after another, over the cores of this machine or over a Dask cluster, and tells how many are done.

    in_order      the results of the tasks, in their order, whoever worked on them
    pool          the processes, or the workers, that run them
    worth         number of tasks that are worth the start of a process: fewer run in this one

The cluster is Dask's, through joblib; `distributed` is needed for it alone. Its workers must have this package installed, in the same
version.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import Any, TypeVar

import joblib

from ...base.errors import InvalidData
from ...base.progress import Progress, silent
from ..data.validation import positive

Result = TypeVar("Result")

# Seconds until a scheduler answers, and until it has a worker.
PATIENCE = 20


def in_order(
    function: Callable[..., Result],
    tasks: Sequence[tuple[Any, ...]],
    *,
    worth: int,
    jobs: int | None = None,
    cluster: str | None = None,
    stage: str = "tasks",
    progress: Progress = silent,
) -> list[Result]:
    """Call function(*task) for every task and return the results in order; `jobs` processes (None: all cores), or the workers of the Dask
    scheduler at the address `cluster`.

    Raises InvalidData for numbers below one, for a cluster and jobs at once, and for a cluster that cannot be used.
    """
    if cluster is not None and jobs is not None:
        raise InvalidData(f"jobs: got {jobs} together with a cluster, which decides for itself; leave one of them out")
    workers = joblib.cpu_count() if jobs is None else positive(jobs, "jobs")
    results = []
    progress(stage, 0, len(tasks))
    with pool(min(workers, -(-len(tasks) // worth)), cluster) as parallel:
        for result in parallel(joblib.delayed(function)(*task) for task in tasks):
            results.append(result)
            progress(stage, len(results), len(tasks))
    return results


def pool(count: int, cluster: str | None) -> AbstractContextManager[joblib.Parallel]:
    """Return so many processes of this machine, or the workers of the Dask scheduler at the address `cluster`, for as long as it is open.

    Raises InvalidData, when it is opened, for a cluster that cannot be used.
    """
    return _processes(count) if cluster is None else _cluster(cluster)


@contextmanager
def _processes(count: int) -> Iterator[joblib.Parallel]:
    # One BLAS thread a worker: the matrices are small and the cores are taken.
    with joblib.parallel_config(backend="loky", inner_max_num_threads=1):
        yield joblib.Parallel(n_jobs=count, return_as="generator")


@contextmanager
def _cluster(address: str) -> Iterator[joblib.Parallel]:
    with _client(address) as client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            raise InvalidData(
                f"cluster: the scheduler at {address} has no worker after {PATIENCE} s; start: dask worker {address}"
            ) from None
        with joblib.parallel_config(backend="dask"):
            yield joblib.Parallel(n_jobs=-1, return_as="generator")


def _client(address: str) -> AbstractContextManager[Any]:
    try:
        from distributed import Client
    except ImportError:
        raise InvalidData("cluster: the package distributed is missing; pip install 'faultspace[cluster]'") from None
    try:
        client: AbstractContextManager[Any] = Client(address, timeout=PATIENCE)
    except (OSError, ValueError, TypeError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InvalidData(f"cluster: no Dask scheduler answers at {address!r} ({reason}); an address is like tcp://HOST:8786") from None
    return client
