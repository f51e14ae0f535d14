"""This runs the tasks of a study over the cores of this machine or over a Dask cluster, and tells how many are done.

    done_by       yields each result as it comes, whoever worked on it
    worth         number of tasks that are worth the start of a process: fewer run in this one

The processes, and the cluster that may be in their place, are those of `base/workers.py`; `base/tasks.py` replaces those that are killed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

import joblib

from ...base.errors import InvalidData
from ...base.tasks import Died, Tasks, as_they_come
from ..data.validation import positive

Result = TypeVar("Result")


def done_by(
    function: Callable[..., Result],
    tasks: Tasks,
    *,
    worth: int,
    jobs: int | None = None,
    cluster: str | None = None,
) -> Iterator[tuple[int, Result | Died]]:
    """Yield the number of each task with function(*task), as it comes; `jobs` processes (None: all cores), or the workers of the Dask
    scheduler at the address `cluster`.

    Raises InvalidData for numbers below one, for a cluster and jobs at once, and for a cluster that cannot be used.
    """
    if cluster is not None and jobs is not None:
        raise InvalidData(f"jobs: got {jobs} together with a cluster, which decides for itself; leave one of them out")
    count = joblib.cpu_count() if jobs is None else positive(jobs, "jobs")
    return as_they_come(function, tasks, count=min(count, -(-len(tasks) // worth)), cluster=cluster)
