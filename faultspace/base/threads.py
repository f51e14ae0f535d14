"""This holds the threads of the linear algebra: what the package computes has one, whatever the environment says. Nor does it matter
what a caller has told numpy to do where numbers grow too large or too small (`numpy.seterr`): inside, numpy does what it does by itself.

The matrices here are small, or long products that wait for memory: several threads lose more time by waiting for each other than they
save. They also split sums at other places, and results are to be the same bytes on every machine that has the same libraries.

With most libraries the number of threads belongs to the process. It is set when the first of any number of threads of Python enters, and
given back when the last has left, so that those inside never see another number; what others compute meanwhile has one thread as well.
Under OpenMP it belongs to each thread, which gives it back by itself. Entries within entries do nothing. A BLAS that threadpoolctl does not
know (Apple's Accelerate) keeps its threads.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from threading import Lock, local
from typing import Any


class _Entries(local):
    """How many entries the present thread is in."""

    depth = 0


_here = _Entries()
_lock = Lock()
_inside = 0  # threads of Python that are in some entry
_original: list[int] = []  # threads of each library before the first of them


@cache
def _libraries() -> list[Any]:
    """Return threadpoolctl's controllers; looking for libraries takes milliseconds, and both that are used here are loaded before."""
    import scipy.linalg  # noqa: F401
    from threadpoolctl import ThreadpoolController

    return list(ThreadpoolController().select(user_api="blas").lib_controllers)


def _set(library: Any, threads: int) -> None:
    """Set the number of threads, whichever thread of Python has set it before: threadpoolctl 3.8 lets a second one do it only if the first
    has cleared itself."""
    clear = getattr(library, "clear_controlling_thread", None)
    if clear is not None:
        clear(force=True)
    library.set_num_threads(threads)
    if clear is not None:
        clear(force=True)


def _enter() -> list[int]:
    """Return the threads that the libraries have as this thread sees it, and set them to one."""
    global _inside, _original
    libraries = _libraries()
    with _lock:
        before = [library.get_num_threads() for library in libraries]
        if not _inside:
            _original = before
        _inside += 1
        for library in libraries:
            _set(library, 1)
    return before


def _leave(before: list[int]) -> None:
    global _inside
    with _lock:
        _inside -= 1
        for library, own, original in zip(_libraries(), before, _original, strict=True):
            if getattr(library, "threading_layer", None) == "openmp":
                _set(library, own)
            elif not _inside:
                _set(library, original)


@contextmanager
def one_thread() -> Iterator[None]:
    """Compute with one BLAS thread: `with one_thread():` around a body, or `@one_thread()` above a function."""
    if _here.depth:
        yield
        return
    import numpy as np

    before = _enter()
    _here.depth += 1
    try:
        with np.errstate(divide="warn", over="warn", under="ignore", invalid="warn"):
            yield
    finally:
        _here.depth -= 1
        _leave(before)
