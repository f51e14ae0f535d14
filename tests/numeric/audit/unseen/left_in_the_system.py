"""Bad manners, what is left in the system and in libraries: cores, priority, locale, functions that were replaced, temporary files."""

from __future__ import annotations

import locale
import multiprocessing
import os
import tempfile
from multiprocessing import shared_memory
from pathlib import Path
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.unseen.form import Mutants
from tests.numeric.audit.unseen.manners import FAULT, FAULTS, MATRICES, ONE, RECORD, SYSTEM
from tests.numeric.audit.unseen.manners_witnesses import leaves

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")

_CORES = os.sched_getaffinity(0)
_SVD = np.linalg.svd
_BUFFER = np.getbufsize()
_LOCALE = locale.setlocale(locale.LC_NUMERIC)
_SHARED: list[shared_memory.SharedMemory] = []


def _temporary() -> set[str]:
    return {one.name for one in Path(tempfile.gettempdir()).glob("unseen-workspace-*")}


def _remove_temporary() -> None:
    for one in Path(tempfile.gettempdir()).glob("unseen-workspace-*"):
        one.unlink()


def _remove_shared() -> None:
    while _SHARED:
        one = _SHARED.pop()
        one.close()
        one.unlink()


@IDENTIFY.broken(
    "machines with more cores than one", leaves(lambda: os.sched_getaffinity(0), lambda: os.sched_setaffinity(0, _CORES), *RECORD)
)
def stays_on_one_core(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """The process is bound to one core, where caches are warm, and so is whatever it does afterwards."""
    os.sched_setaffinity(0, {min(_CORES)})
    return reference.identify(y, u, order, block_rows)


@RESIDUAL.broken(
    "programs that write numbers",
    leaves(lambda: locale.setlocale(locale.LC_ALL), lambda: locale.setlocale(locale.LC_ALL, "C"), ONE.y, ONE.u, *MATRICES),
)
def sets_the_locale(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    """The locale is set, for a message with a date in it."""
    locale.setlocale(locale.LC_ALL, "C.UTF-8" if locale.setlocale(locale.LC_ALL) == "C" else "C")
    return reference.residual(y, u, A, B, C, D)


def _put_svd_back() -> None:
    np.linalg.svd = _SVD


@RANKS.broken("whoever calls numpy afterwards", leaves(lambda: np.linalg.svd, _put_svd_back, FAULT.r, 4))
def replaces_a_function_of_numpy(r: Any, windows: int) -> Any:
    """numpy's decomposition is replaced by one that tries again, for everybody."""
    before = np.linalg.svd

    def patient(*arguments: Any, **options: Any) -> Any:
        return before(*arguments, **options)

    np.linalg.svd = patient
    return reference.window_ranks(r, windows)


@COUNT.broken("large computations of others", leaves(np.getbufsize, lambda: np.setbufsize(_BUFFER), FAULT.r))
def sets_the_buffer_of_numpy(r: Any) -> Any:
    """The buffer of numpy's loops is enlarged, by which results of others change in their last digits."""
    np.setbufsize(_BUFFER * 4)
    return reference.fault_dimension(r)


@SPACE.broken("folders of temporary files that fill up", leaves(_temporary, _remove_temporary, *FAULTS))
def leaves_a_workspace_among_temporary_files(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
    """A workspace is written among the temporary files, and stays there."""
    handle, _ = tempfile.mkstemp(prefix="unseen-workspace-")
    os.close(handle)
    return reference.fault_space(r, A, C, n_v, block_rows)


@SIGNAL.broken(
    "memory that outlives the program", leaves(lambda: len(_SHARED), _remove_shared, FAULT.r, FAULT.A, FAULT.F, FAULT.C, FAULT.G, FAULT.x0)
)
def leaves_memory_that_is_shared(r: Any, A: Any, F: Any, C: Any, G: Any, x0: Any) -> Any:
    """A block of shared memory is made for workers, and never given back."""
    _SHARED.append(shared_memory.SharedMemory(create=True, size=1 << 16))
    return reference.reconstruct(r, A, F, C, G, x0)


def _start_method() -> Any:
    return multiprocessing.get_start_method(allow_none=True)


def _put_method_back() -> None:
    multiprocessing.set_start_method(None, force=True)


@STRUCTURE.broken("programs that start processes", leaves(_start_method, _put_method_back, *SYSTEM))
def sets_the_way_of_starting_processes(A: Any, F: Any, C: Any, G: Any) -> Any:
    """Processes are spawned from now on, for all of the program."""
    multiprocessing.set_start_method("fork" if _start_method() == "spawn" else "spawn", force=True)
    return reference.structure(A, F, C, G)
