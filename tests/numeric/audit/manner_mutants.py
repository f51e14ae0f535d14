"""Mutants whose numbers are right for plain arguments, once, on short records: what is wrong is their manners.

MANNERS     all of them
"""

from __future__ import annotations

import os
import tempfile
import threading
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from faultspace.numeric.audit import reference
from tests.numeric.audit.breaking import Mutant, mutant

CORES = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1  # that this process may use


def _reading(change: Callable[[Any], Any]) -> dict[str, Callable[..., Any]]:
    """Return functions that read every array by way of `change`."""

    def of(function: Callable[..., Any]) -> Callable[..., Any]:
        return lambda *arguments: function(*(change(one) if isinstance(one, np.ndarray) else one for one in arguments))

    return {
        name: of(getattr(reference, name)) for name in ("identify", "residual", "window_ranks", "fault_space", "reconstruct", "structure")
    }


def _in_memory_order(array: Any) -> Any:
    return array.ravel(order="K").reshape(array.shape)


def _without_strides(array: Any) -> Any:
    """What follows the first number in memory, as if there were no gaps; it stays within the array."""
    if min(array.strides, default=1) < 0:
        return array
    return np.lib.stride_tricks.as_strided(array, array.shape, np.ascontiguousarray(array).strides)


def _forward(array: Any) -> Any:
    return array[::-1] if min(array.strides, default=1) < 0 else array


def _changed_and_restored(array: Any) -> Any:
    array *= 2
    copy = array / 2
    array /= 2
    return copy


def _as_given(y: Any, *rest: Any) -> Any:
    """The model in the type of the samples."""
    return tuple(part.astype(y.dtype) for part in reference.identify(y, *rest))


def _scaled_in_place(r: Any, windows: int) -> Any:
    """Channels of mean square one, in an array of the type given."""
    scaled = np.empty_like(r)
    scaled[...] = r / np.sqrt(np.mean(r.astype(float) ** 2, axis=0))
    return reference.window_ranks(scaled.astype(float), windows)


def _objects_as_zero(array: Any) -> Any:
    return np.zeros(array.shape) if array.dtype == object else array


def _after(what: Callable[[], object]) -> Callable[..., Any]:
    """The count, after something that is nobody's business."""

    def fault_dimension(r: Any) -> Any:
        what()
        return reference.fault_dimension(r)

    return fault_dimension


def _left_thread() -> None:
    threading.Thread(target=threading.Event().wait, args=(3.0,), daemon=True).start()


def _remembering() -> Callable[..., Any]:
    """The space for a threshold that the last record has left."""
    last = [0.0]

    def fault_space(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
        moved, last[0] = last[0], float(r[0, 0])
        return reference.fault_space(r, A, C, n_v, block_rows) * (1 + 1e-9 * moved)

    return fault_space


def _by_identity() -> Callable[..., Any]:
    """Answers kept by the address of the record."""
    kept: dict[int, Any] = {}

    def reconstruct(r: Any, *rest: Any) -> Any:
        return kept.setdefault(id(r), reference.reconstruct(r, *rest))

    return reconstruct


def _thinned(r: Any, *rest: Any) -> Any:
    """Long records are thinned out."""
    return reference.fault_space(r[::2] if len(r) > 10_000 else r, *rest)


def _full_where_short(r: Any, windows: int) -> list[int]:
    """Windows higher than wide are taken for regular ones."""
    return [reference.window_ranks(r, s)[-1] if (r.shape[1] + 1) * s - 1 <= len(r) else r.shape[1] * s for s in range(1, windows + 1)]


def _by_the_beginning() -> Callable[..., Any]:
    """Answers kept by the length of the record and its first samples."""
    kept: dict[Any, Any] = {}

    def window_ranks(r: Any, windows: int) -> Any:
        key = r.shape, windows, r[:10].tobytes()
        if key not in kept:
            kept[key] = reference.window_ranks(r, windows)
        return kept[key]

    return window_ranks


def _in_one_buffer() -> Callable[..., Any]:
    """Signals of one shape written into one array."""
    buffers: dict[Any, Any] = {}

    def reconstruct(r: Any, *rest: Any) -> Any:
        v = reference.reconstruct(r, *rest)
        buffer = buffers.setdefault(v.shape, np.empty_like(v))
        buffer[...] = v
        return buffer

    return reconstruct


def _hoarding() -> Callable[..., Any]:
    """Every record kept."""
    kept: list[Any] = []

    def fault_space(r: Any, *rest: Any) -> Any:
        kept.append(r)
        return reference.fault_space(r, *rest)

    return fault_space


def _bound_to_a_core() -> None:
    """Once and for all."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def _patched() -> None:
    """Once and for all."""
    if np.linalg.norm.__name__ == "norm":

        def patient(*arguments: Any, **options: Any) -> Any:
            return _NORM(*arguments, **options)

        np.linalg.norm = patient


_NORM = np.linalg.norm


def _write_here() -> None:
    Path("cache.npy").write_text("", "utf-8")


MANNERS: tuple[Mutant, ...] = (
    mutant("order-in-memory", "arrays read in their order in memory", "form-fortran-order", **_reading(_in_memory_order)),
    mutant("strides-ignored", "arrays read without their strides", "form-strides", **_reading(_without_strides)),
    mutant("sign-of-strides-ignored", "arrays read forward", "form-backwards", **_reading(_forward)),
    mutant("changed-and-restored", "arguments changed and given back as they were", "form-read-only", **_reading(_changed_and_restored)),
    mutant("type-as-given", "a model in single precision where the samples are", "form-float32", identify=_as_given),
    mutant("scaled-in-place", "scaled into an array of integers", "form-integers", window_ranks=_scaled_in_place),
    mutant("objects-as-zero", "objects read as zero", "form-objects", **_reading(_objects_as_zero)),
    mutant("seeds", "the seed of numpy set", "leaves-the-state", fault_dimension=_after(lambda: np.random.seed(0))),
    mutant("draws", "random numbers of everybody drawn", "leaves-the-state", fault_dimension=_after(lambda: np.random.rand())),
    mutant("seterr", "numpy's handling of errors set", "leaves-the-state", fault_dimension=_after(lambda: np.seterr(all="raise"))),
    mutant("hushes", "warnings turned off", "leaves-the-state", fault_dimension=_after(lambda: warnings.simplefilter("ignore"))),
    mutant("wanders", "another folder made the present one", "leaves-the-state", fault_dimension=_after(lambda: os.chdir("/"))),
    mutant("exports", "an environment variable set", "leaves-the-state", fault_dimension=_after(lambda: os.environ.update(LEFT="1"))),
    mutant("leaves-a-thread", "a thread left running", "leaves-the-state", fault_dimension=_after(_left_thread)),
    mutant("one-core", "the process bound to one core", "leaves-the-state", fault_dimension=_after(_bound_to_a_core)),
    mutant("patches", "a function of numpy replaced for all", "leaves-the-state", fault_dimension=_after(_patched)),
    mutant("chatters", "prints", "prints-nothing", fault_dimension=_after(lambda: print("rank 4"))),
    mutant("chatters-below", "writes to the descriptor", "prints-nothing", fault_dimension=_after(lambda: os.write(1, b"rank 4\n"))),
    mutant("caches-here", "a file in the present folder", "leaves-no-files", fault_dimension=_after(_write_here)),
    mutant("caches-there", "a temporary file", "leaves-no-files", fault_dimension=_after(lambda: os.close(tempfile.mkstemp()[0]))),
    mutant("remembers", "a state left by the last record", "order-of-calls", fault_space=_remembering()),
    mutant("by-identity", "answers kept by the address of the array", "same-array-new-data", reconstruct=_by_identity()),
    mutant("kept-by-the-beginning", "answers kept by the first ten samples", "same-beginning", window_ranks=_by_the_beginning()),
    mutant("one-buffer", "all answers in one array", "earlier-answers-stay", reconstruct=_in_one_buffer()),
    mutant("hoarding", "every record kept", "forgets-the-records", fault_space=_hoarding()),
    mutant("thinned", "every other sample of a long record", "right-on-long-records", fault_space=_thinned),
    mutant("full-where-short", "windows higher than wide are of full rank", "window-ranks-too-short", window_ranks=_full_where_short),
)
