"""This does many tasks, each to its end, whatever becomes of the processes that work on them.

    as_they_come   the number and the result of each task, as soon as it is done
    Tasks          what has the arguments of each task by its number, and need not hold them all
    Died           the result of a task whose process ended each time that it was tried
    TRIES          so often is a task tried alone before it is given up

Where a process is killed, all that joblib has under way is lost, and nothing says which task was at fault. So the tasks that had been begun
are tried again one after another, which shows it, and then the others go on in new processes. A cluster of Dask does that by itself.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from itertools import islice
from typing import Any, Protocol, TypeVar

import joblib

from . import workers
from .errors import InvalidData

Result = TypeVar("Result")
Task = tuple[Any, ...]

TRIES = 2
# Tasks that each thread of a cluster has before it, so that none of them waits for us.
AHEAD = 4
# Seconds between two looks at a cluster from which nothing comes.
LOOK = 1.0


class Tasks(Protocol):
    """The arguments of each task by its number, as a list has them; what makes them when they are asked for holds no more of them."""

    def __len__(self) -> int:
        """Return how many tasks there are."""

    def __getitem__(self, number: int, /) -> Task:
        """Return the arguments of the task with this number."""


@dataclass(frozen=True)
class Died:
    """No result: `reason` says on one line what became of the processes that worked on the task."""

    reason: str


def as_they_come(function: Callable[..., Result], tasks: Tasks, *, count: int, cluster: str | None) -> Iterator[tuple[int, Result | Died]]:
    """Yield (k, function(*tasks[k])) for every k, in the order in which they are done, by `count` processes (one: by this process), or by
    the workers of the Dask scheduler at the address `cluster`.

    Where the iterator is closed before its end, the processes are ended. Raises what `function` raises, and InvalidData for a cluster that
    cannot be used, whose scheduler is lost, or which has no workers any more.
    """
    if cluster is not None:
        return _by_cluster(function, tasks, cluster)
    if count <= 1:
        return ((k, function(*tasks[k])) for k in range(len(tasks)))
    return _by_processes(function, tasks, count)


def _by_processes(function: Callable[..., Result], tasks: Tasks, count: int) -> Iterator[tuple[int, Result | Died]]:
    waiting = deque(range(len(tasks)))
    while waiting:
        begun = set[int]()
        try:
            yield from _as_long_as_they_live(function, tasks, waiting, begun, count)
        except BrokenProcessPool:
            for k in sorted(begun):
                yield from _alone(function, tasks, k, count)


def _alone(function: Callable[..., Result], tasks: Tasks, k: int, count: int) -> Iterator[tuple[int, Result | Died]]:
    for _ in range(TRIES):
        with suppress(BrokenProcessPool):
            yield from _as_long_as_they_live(function, tasks, deque([k]), set(), count)
            return
    yield k, Died(f"the process that worked on it ended, {TRIES} times with nothing else under way: killed, out of memory, or crashed")


def _as_long_as_they_live(
    function: Callable[..., Result], tasks: Tasks, waiting: deque[int], begun: set[int], count: int
) -> Iterator[tuple[int, Result]]:
    """Take numbers of tasks from `waiting` and yield results; `begun` holds those that are under way. Raises BrokenProcessPool."""

    def feed() -> Iterator[Any]:
        while waiting:
            k = waiting.popleft()
            begun.add(k)
            yield joblib.delayed(_numbered)(function, k, tasks[k])

    # Two processes or more: joblib would do with one what is asked for in this process, which has to live on.
    with workers.unordered(max(count, 2)) as parallel:
        for k, result in parallel(feed()):
            begun.discard(k)
            yield k, result


def _numbered(function: Callable[..., Result], k: int, task: Task) -> tuple[int, Result]:
    return k, function(*task)


def _by_cluster(function: Callable[..., Result], tasks: Tasks, address: str) -> Iterator[tuple[int, Result | Died]]:
    with workers.client(address) as client:
        distributed: Any = import_module("distributed")
        waiting = iter(range(len(tasks)))
        numbers: dict[Any, int] = {}
        room = AHEAD * max(1, sum(client.nthreads().values()))
        while True:
            for k in islice(waiting, room - len(numbers)):
                numbers[client.submit(function, *tasks[k], pure=False)] = k
            if not numbers:
                return
            for future in _done(client, list(numbers), address):
                k = numbers.pop(future)
                try:
                    yield k, future.result()
                except distributed.KilledWorker as error:
                    yield k, Died(" ".join(str(error).split()))
                except (OSError, CancelledError):
                    if future.status == "error":  # the function's own
                        raise
                    raise _lost(address) from None


def _done(client: Any, futures: list[Any], address: str) -> list[Any]:
    """Wait until some are done, and return them. Raises InvalidData where nothing can come any more."""
    wait: Any = import_module("distributed").wait
    idle = 0.0
    while idle < workers.PATIENCE:
        with suppress(TimeoutError, OSError, CancelledError):
            wait(futures, timeout=LOOK, return_when="FIRST_COMPLETED")
        statuses = [future.status for future in futures]
        if client.status != "running" or "cancelled" in statuses:
            raise _lost(address)
        if done := [future for future, status in zip(futures, statuses, strict=True) if status not in ("pending", "lost")]:
            return done
        # What is lost, with the worker that had it, is done again where there is one.
        idle = 0.0 if "pending" in statuses and client.nthreads() else idle + LOOK
    raise InvalidData(f"cluster: the scheduler at {address} has done nothing for {workers.PATIENCE} s; start: dask worker {address}")


def _lost(address: str) -> InvalidData:
    return InvalidData(f"cluster: the scheduler at {address} was lost; start it again, and its workers")
