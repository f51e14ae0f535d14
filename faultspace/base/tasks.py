"""This does many tasks, each to its end, whatever becomes of the processes that work on them.

    as_they_come   the number and the result of each task, as soon as it is done
    ordered        the results in the order of the tasks, each of which must come to one
    in_order       the same of tasks that are many and large: by this process, or by the cluster of the Shared that is in force
    shared         the context in which a Shared is in force
    processes      how many processes a number of jobs stands for
    Once           an argument that many tasks have, which is sent to a cluster once
    Tasks          what has the arguments of each task by its number, and need not hold them all
    Died           the result of a task whose process ended each time that it was tried
    TRIES          so often is a task tried alone before it is given up

Where a process is killed, all that joblib has under way is lost, and nothing says which task was at fault. So the tasks that had been begun
are tried again one after another, which shows it, and then the others go on in new processes. A cluster of Dask does that by itself.
"""

from __future__ import annotations

import time
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import CancelledError
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, nullcontext, suppress
from contextvars import ContextVar
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Protocol, TypeVar

from . import workers
from .errors import InvalidData

Result = TypeVar("Result")
Task = tuple[Any, ...]

TRIES = 2
# Tasks that each thread of a cluster has before it, so that none of them waits for us.
AHEAD = 4
# Seconds of work that are one task of a cluster, whose messages cost more than a hundredth of one, and the most tasks of ours in it.
WORTH, MOST_TOGETHER = 0.5, 100
# What a client raises that has no scheduler any more; the last where somebody else answers at the address, as a gate to other networks
# does: eight of its letters, read as a length, are more bytes than there are.
GONE = (OSError, CancelledError, RuntimeError, AttributeError, MemoryError)
# Seconds between two looks at a cluster from which nothing comes.
LOOK = 1.0


class Tasks(Protocol):
    """The arguments of each task by its number, as a list has them; what makes them when they are asked for holds no more of them."""

    def __len__(self) -> int:
        """Return how many tasks there are."""

    def __getitem__(self, number: int, /) -> Task:
        """Return the arguments of the task with this number."""


@dataclass(frozen=True, eq=False)
class Once:
    """The task gets the `value` in the place of this."""

    value: Any


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
        return ((k, _called(function, tasks[k])) for k in range(len(tasks)))
    return _by_processes(function, tasks, count)


def ordered(function: Callable[..., Result], tasks: Tasks, *, count: int) -> Iterator[Result]:
    """Yield function(*task) for each task, in their order, by `count` processes or by the cluster of the Shared that is in force.

    Raises what `as_they_come` does, and InvalidData for a task whose process ended each time.
    """
    cluster = _SHARED.get()
    came: dict[int, Result] = {}
    following = 0
    for k, result in as_they_come(function, tasks, count=count, cluster=None if cluster is None else cluster.address):
        if isinstance(result, Died):
            raise InvalidData(
                f"task {k + 1} of {len(tasks)} came to no end: {result.reason}; try fewer processes at a time, or more memory"
            )
        came[k] = result
        while following in came:
            yield came.pop(following)
            following += 1


def processes(jobs: int) -> int:
    """Return how many processes `jobs` stands for: -1 for one each core."""
    if jobs != -1:
        return jobs
    from joblib import cpu_count

    return int(cpu_count())


def _called(function: Callable[..., Result], task: Task) -> Result:
    return function(*(one.value if isinstance(one, Once) else one for one in task))


@dataclass
class Shared:
    """The cluster of the Dask scheduler at `address` does what `in_order` is asked for, until it is lost: `lost` says then in words why."""

    address: str
    client: Any
    lost: str = ""


_SHARED: ContextVar[Shared | None] = ContextVar("shared", default=None)


@contextmanager
def shared(address: str | None) -> Iterator[Shared | None]:
    """Have `in_order` work on the cluster of the Dask scheduler at this address; None: in this process. Raises InvalidData for a cluster
    that cannot be used."""
    if address is None:
        yield None
        return
    with workers.client(address) as client:
        token = _SHARED.set(Shared(address, client))
        try:
            yield _SHARED.get()
        finally:
            _SHARED.reset(token)


def in_order(function: Callable[..., Result], tasks: Iterable[Task]) -> Iterator[Result]:
    """Yield function(*task) for each task, in their order; no more tasks are held than the workers have before them.

    What a cluster cannot do, since its workers were killed each time or its scheduler was lost, is done in this process.
    """
    cluster = _SHARED.get()
    if cluster is None:
        yield from (_called(function, task) for task in tasks)
        return
    waiting: deque[tuple[Any, Task]] = deque()
    room = AHEAD
    with suppress(*GONE):
        room *= max(1, sum(cluster.client.nthreads().values()))
    for task in tasks:
        waiting.append((_submitted(cluster, function, task), task))
        if len(waiting) >= room:
            yield _first(cluster, function, waiting)
    while waiting:
        yield _first(cluster, function, waiting)


def _submitted(cluster: Shared, function: Callable[..., Result], task: Task) -> Any:
    """Return the future of a task, None where the cluster is lost."""
    if not cluster.lost:
        # The warning says that arguments are large, which they are meant to be.
        with suppress(*GONE), warnings.catch_warnings(action="ignore", category=UserWarning):
            return cluster.client.submit(function, *task, pure=False)
    return None


def _first(cluster: Shared, function: Callable[..., Result], waiting: deque[tuple[Any, Task]]) -> Result:
    future, task = waiting.popleft()
    distributed: Any = import_module("distributed")
    if future is not None and not cluster.lost:
        try:
            _done(cluster.client, [future], cluster.address)
            result: Result = future.result()
            return result
        except InvalidData as error:
            if future.status == "error":  # the function's own
                raise
            cluster.lost = str(error)
        except distributed.KilledWorker:
            pass
        except GONE:
            if future.status == "error":
                raise
            cluster.lost = str(_lost(cluster.address))
    return function(*task)


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
    from joblib import delayed

    def feed() -> Iterator[Any]:
        while waiting:
            k = waiting.popleft()
            begun.add(k)
            yield delayed(_numbered)(function, k, tasks[k])

    # Two processes or more: joblib would do with one what is asked for in this process, which has to live on.
    with workers.unordered(max(count, 2)) as parallel:
        for k, result in parallel(feed()):
            begun.discard(k)
            yield k, result


def _numbered(function: Callable[..., Result], k: int, task: Task) -> tuple[int, Result]:
    return k, _called(function, task)


def _itself(value: Any) -> Any:
    return value


def _several(function: Callable[..., Result], tasks: Sequence[Task]) -> tuple[list[Result], float]:
    """Return the results, and the seconds that each of them took."""
    begun = time.perf_counter()
    return [function(*task) for task in tasks], (time.perf_counter() - begun) / len(tasks)


def _by_cluster(function: Callable[..., Result], tasks: Tasks, address: str) -> Iterator[tuple[int, Result | Died]]:
    there = _SHARED.get()
    with workers.client(address) if there is None or there.address != address else nullcontext(there.client) as client:
        distributed: Any = import_module("distributed")
        under_way: dict[Any, list[int]] = {}
        alone = deque[int]()  # of what was under way where a worker was killed, nobody knows which was at fault: one after another shows it
        sent: dict[int, Any] = {}  # results of a task, which are made again where the worker that has them is lost
        following, together, single = 0, 1, False

        def submitted(numbers: list[int]) -> Any:
            given = []
            for task in map(tasks.__getitem__, numbers):
                for one in task:
                    if isinstance(one, Once) and id(one) not in sent:
                        sent[id(one)] = one, client.submit(_itself, one.value, pure=False)
                given.append([sent[id(one)][1] if isinstance(one, Once) else one for one in task])
            return client.submit(_several, function, given, pure=False)

        while True:
            try:
                room = AHEAD * max(1, sum(client.nthreads().values()))
                # Where a worker is gone, more are under way than the others have room for.
                while not alone and len(under_way) < room and following < len(tasks):
                    numbers = [*range(following, following + min(together, -(-(len(tasks) - following) // room)))]
                    following = numbers[-1] + 1
                    under_way[submitted(numbers)] = numbers
                single = bool(alone) and not under_way
                if single:
                    numbers = [alone.popleft()]
                    under_way[submitted(numbers)] = numbers
            except GONE:
                raise _lost(address) from None
            if not under_way:
                return
            for future in _done(client, list(under_way), address):
                numbers = under_way.pop(future)
                try:
                    results, seconds = future.result()
                except distributed.KilledWorker as error:
                    if single:
                        yield numbers[0], Died(" ".join(str(error).split()))
                    else:
                        alone.extend(numbers)
                    continue
                except GONE:
                    if future.status == "error":  # the function's own
                        raise
                    raise _lost(address) from None
                together = max(1, min(MOST_TOGETHER, int(WORTH / max(seconds, 1e-9))))
                yield from zip(numbers, results, strict=True)


def _done(client: Any, futures: list[Any], address: str) -> list[Any]:
    """Wait until some are done, and return them. Raises InvalidData where nothing can come any more."""
    wait: Any = import_module("distributed").wait
    idle = 0.0
    while idle < workers.PATIENCE:
        with suppress(*GONE):
            wait(futures, timeout=LOOK, return_when="FIRST_COMPLETED")
        statuses = [future.status for future in futures]
        if client.status != "running" or "cancelled" in statuses:
            raise _lost(address)
        if done := [future for future, status in zip(futures, statuses, strict=True) if status not in ("pending", "lost")]:
            return done
        # What is lost, with the worker that had it, is done again where there is one.
        try:
            idle = 0.0 if "pending" in statuses and client.nthreads() else idle + LOOK
        except GONE:
            raise _lost(address) from None
    raise InvalidData(f"cluster: the scheduler at {address} has done nothing for {workers.PATIENCE} s; start: dask worker {address}")


def _lost(address: str) -> InvalidData:
    return InvalidData(f"cluster: the scheduler at {address} was lost; start it again, and its workers")
