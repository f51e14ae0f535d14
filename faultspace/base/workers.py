"""This opens the processes of this machine, or the workers of a Dask cluster, for tasks of joblib.

The cluster is Dask's, through joblib; `distributed` is needed for it alone. Its workers must have this package installed, in the same
version. Joblib is loaded when the first of them are opened: that takes a tenth of a second, and most commands open none.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import cache, partial
from importlib import import_module
from typing import Any

from .errors import InvalidData
from .processes import end_with_parent

# Seconds until a scheduler answers, and until it has a worker.
PATIENCE = 20


def pool(count: int, cluster: str | None) -> AbstractContextManager[Any]:
    """Return so many processes of this machine, or the workers of the Dask scheduler at the address `cluster`, for as long as it is open.
    Results come in the order of the tasks.

    Raises InvalidData, when it is opened, for a cluster that cannot be used.
    """
    return _processes(return_as="generator", n_jobs=count) if cluster is None else _cluster(cluster)


def unordered(count: int) -> AbstractContextManager[Any]:
    """Return so many processes of this machine, which take tasks one by one; a result comes as soon as it is there."""
    return _processes(return_as="generator_unordered", n_jobs=count, batch_size=1)


@contextmanager
def _processes(**settings: Any) -> Iterator[Any]:
    import joblib

    # One BLAS thread a worker: the matrices are small and the cores are taken.
    with joblib.parallel_config(backend="loky", inner_max_num_threads=1, initializer=_ending_with(os.getpid())):
        yield joblib.Parallel(**settings)


@cache
def _ending_with(parent: int) -> Callable[[], None]:
    """Return what each of our processes calls first: one object, since joblib keeps its processes as long as they are started alike."""
    return partial(end_with_parent, parent)


@contextmanager
def _cluster(address: str) -> Iterator[Any]:
    import joblib

    with client(address), joblib.parallel_config(backend="dask"):
        yield joblib.Parallel(n_jobs=-1, return_as="generator")


@contextmanager
def client(address: str) -> Iterator[Any]:
    """Return a `distributed.Client` of the scheduler at this address, which has one worker or more. Raises InvalidData."""
    with _client(address) as opened:
        try:
            opened.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            raise InvalidData(
                f"cluster: the scheduler at {address} has no worker after {PATIENCE} s; start: dask worker {address}"
            ) from None
        yield opened


def _client(address: str) -> AbstractContextManager[Any]:
    try:
        distributed: Any = import_module("distributed")
    except ImportError:
        raise InvalidData("cluster: the package distributed is missing; pip install 'faultspace[cluster]'") from None
    # It would print the tracebacks of what its caller says in a line.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    try:
        opened: AbstractContextManager[Any] = distributed.Client(address, timeout=PATIENCE)
    except (OSError, ValueError, TypeError, AssertionError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InvalidData(f"cluster: no Dask scheduler answers at {address!r} ({reason}); an address is like tcp://HOST:8786") from None
    return opened
