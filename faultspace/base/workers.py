"""This opens the processes of this machine, or the workers of a Dask cluster, for tasks of joblib.

    pool     the one or the other

The cluster is Dask's, through joblib; `distributed` is needed for it alone. Its workers must have this package installed, in the same
version.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

import joblib

from .errors import InvalidData

# Seconds until a scheduler answers, and until it has a worker.
PATIENCE = 20


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
