"""What the checker has accepted is kept for the rest of a run, and decided anew in the next: a run counts what it has decided itself.

once_a_run    makes a function keep what it returned last, within the run that asked for it
in_run        says which run the work of this thread belongs to from here on; the processes that do it outlive runs
"""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar
from functools import lru_cache, wraps
from typing import TypeVar, TypeVarTuple

Given = TypeVarTuple("Given")
Found = TypeVar("Found")
_RUN = ContextVar("run", default="")


def in_run(run: str) -> None:
    """Take the run of this name as the one that is under way."""
    _RUN.set(run)


def once_a_run(most: int) -> Callable[[Callable[[*Given], Found]], Callable[[*Given], Found]]:
    """Return what makes a function keep `most` results, those of other runs being none of this one."""

    def keeping(function: Callable[[*Given], Found]) -> Callable[[*Given], Found]:
        @lru_cache(maxsize=most)
        def of_run(run: str, *given: *Given) -> Found:
            return function(*given)

        @wraps(function)
        def found(*given: *Given) -> Found:
            return of_run(_RUN.get(), *given)

        return found

    return keeping
