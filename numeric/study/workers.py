"""This runs one task after another, over the cores of this machine or over a Dask cluster, and tells how many are done.

    in_order      the results of the tasks, in their order, whoever worked on them
    worth         number of tasks that are worth the start of a process: fewer run in this one

The processes, and the cluster that may be in their place, are those of `base/workers.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import joblib

from ...base.errors import InvalidData
from ...base.progress import Progress, silent
from ...base.workers import pool
from ..data.validation import positive

Result = TypeVar("Result")


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
