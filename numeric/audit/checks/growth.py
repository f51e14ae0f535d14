"""Check how memory and time grow with the length of the record: in proportion, or with its square; and that the answers stay right.

    checks              for every function that reads a record
    footprint           peak memory beyond what was there, of this process and all that it started
    timed               their CPU seconds, taken without a look at the memory, which itself takes time
    exponent            log of the ratio of two costs over that of the lengths

The bound on the exponent is midway between linear and quadratic. What stays under a floor costs nobody anything and counts as no growth;
the smaller cost is taken to be at least the floor's share, because small amounts drown in what the process holds anyway. Time may leap
where data outgrow a cache: only a growth that goes on to twice the length is called one.

The records are those of the kinds of trouble with whole numbers, driven by signs: integers, exact at any length, and so is the truth. One
forgets everything in a few samples, so that every piece of its record looks like another; one forgets nothing.
Coefficients, Markov parameters, residuals and fault signals are whole numbers then, and right is what is nearer to them than to any other;
the fault space is held against the bound that its own record gives.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from math import inf, log
from typing import Any

import numpy as np
import psutil

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.record import analyze
from faultspace.exact.system.systems import ResidualSystem

from ....base.arrays import Array
from ....base.processes import family, resident
from ...method.model.models import StateSpaceModel
from ...method.space.by_ranks import noise_free_fault_space
from ..records import Broken, Check, Function, Measurement, Severity, inside
from ..vectors.exact_comparison import distances, markov, polynomial_from_the_top
from ..vectors.fault_vectors import FaultVector
from ..vectors.rationals import floats, signs
from ..vectors.shipped_vectors import shipped
from ..vectors.trouble import Trouble, default_troubles
from .faults import as_number, ranks_off, spaces_off
from .identification import matrices

LENGTHS = (3000, 12000)  # a square of 8-byte numbers is 1.2 GB at the longer, one of bytes 0.14
BOUND = 1.5  # of the exponent: half way, on its scale, between what is linear and what is a square
MEMORY_FLOOR = 32e6  # bytes
TIME_FLOOR = 0.1  # seconds
EVERY = 0.004  # seconds between two looks at the memory
SEED = 20250523
FORGETTING = "whole-numbers"
KINDS = {FORGETTING: "", "whole-numbers-that-add-up": "-that-add-up"}  # and what the name of the record ends in
LATE = 4  # a fault that begins late has the last quarter of the record
LOUD = 2.0**27 + 1  # whole numbers of three bits more than single precision has: rounded to it they are off by units
STEP, LASTS = 100, 700  # the size of the steps in a residual, and the samples that each lasts
FAINT = 2.0**16  # far above what rounding does to the singular values of so long a record
FAINT_SYSTEM = ResidualSystem.of([[0, 1], [0, 0]], [[1, 0], [1, 1]], [[1, 0], [0, 1], [1, 1]], [[1, 0], [0, 1], [1, -1]])
WINDOWS = 4
NEAREST = 0.5  # from a whole number: what is nearer is no other


def footprint(work: Callable[[], object]) -> float:
    """Return the bytes of memory that the work costs this process and its children, looked at every few milliseconds."""
    done, before = threading.Event(), _held()
    peak = before

    def watch() -> None:
        nonlocal peak
        while not done.wait(EVERY):
            peak = max(peak, _held())

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        work()
    finally:
        last = _held()
        done.set()
        watcher.join()
    return max(peak, last) - before


def timed(work: Callable[[], object]) -> float:
    """Return the CPU seconds that the work costs this process and its children."""
    whole = psutil.Process()
    begun = _seconds(whole)
    work()
    return max(_seconds(whole) - begun, 0.0)


def _held() -> float:
    return float(resident(family(os.getpid())))


def _seconds(process: psutil.Process) -> float:
    """Return the CPU seconds of the process and all below it; those of children that have ended are with their parents."""
    total = 0.0
    for one in family(process.pid):
        with suppress(psutil.Error):
            spent = one.cpu_times()
            total += spent.user + spent.system + spent.children_user + spent.children_system
    return total


def exponent(costs: tuple[float, float], lengths: tuple[int, int], floor: float) -> float:
    """Return the exponent of the growth, 0 where the larger cost is under the floor."""
    ratio = lengths[1] / lengths[0]
    small, large = max(costs[0], floor / ratio), costs[1]
    return max(log(large / small) / log(ratio), 0.0) if large > floor else 0.0


def checks() -> Iterator[Check]:
    """Yield all checks of the module."""
    for function in ("identify", "residual", "window_ranks", "fault_dimension", "fault_space", "reconstruct"):
        yield _grows("memory-grows-with-N", function, "memory runs out on records of ordinary length")
        yield _grows("time-grows-with-N", function, "no answer in bearable time on records of ordinary length")
        for kind, suffix in KINDS.items():
            yield _right(function, kind, suffix)
    yield from _faint()


def _grows(slug: str, name: str, effect: str) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        if slug.startswith("memory"):
            less, more = (_cost(_memory, name, length, function) for length in LENGTHS)
            yield Measurement("exponent of memory", exponent((less, more), LENGTHS, MEMORY_FLOOR), BOUND)
            return
        small, large = (_cost(_time, name, length, function) for length in LENGTHS)
        got = exponent((small, large), LENGTHS, TIME_FLOOR)
        if got > BOUND:
            lengths = LENGTHS[1], 2 * LENGTHS[1]
            further = _cost(_time, name, lengths[1], function)
            got = min(got, exponent((large, further), lengths, TIME_FLOOR))
        yield Measurement("exponent of time", got, BOUND)

    return Check(slug, name, f"N{LENGTHS[0]}-N{LENGTHS[1]}", None, effect, Severity.NUISANCE, measure, nearness=1.0)


def _right(name: str, kind: str, suffix: str) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        arguments = question(name, LENGTHS[1], kind)
        if name == "residual":
            y, u, *model = arguments
            arguments = LOUD * (y + stepping(y.shape)), LOUD * u, *model
        yield from _OFF[name](kind, arguments, function(*arguments))

    effect = "wrong answers on records of ordinary length"
    return Check("right-on-long-records", name, f"N{LENGTHS[1]}{suffix}", None, effect, Severity.SILENT, measure, nearness=1.0)


def _faint() -> Iterator[Check]:
    """One fault is FAINT times smaller than the other, however long the record: what grows with the length must not cover it."""

    def ranks(function: Function) -> Iterator[Measurement]:
        due = analyze(FAINT_SYSTEM).kernel
        yield from ranks_off(function(faint(LENGTHS[1]), WINDOWS), tuple(due.rank(s) for s in range(1, WINDOWS + 1)))

    def count(function: Function) -> Iterator[Measurement]:
        yield Measurement("n_v", abs(as_number(function(faint(LENGTHS[1]))) - FAINT_SYSTEM.m), 0.0)

    effect = "a faint fault is lost in records of ordinary length"
    for name, measure in (("window_ranks", ranks), ("fault_dimension", count)):
        yield Check("right-on-long-records", name, f"N{LENGTHS[1]}-faint", None, effect, Severity.SILENT, measure, nearness=1.0)


def faint(length: int) -> Array:
    """Return the residual of two faults of signs, the first of which is FAINT times as large."""
    system = FAINT_SYSTEM
    return _response(_driven(length, system.m) * [FAINT, 1.0], system.A, system.F, system.C, system.G)


def stepping(shape: tuple[int, int]) -> Array:
    """Return a fault in every output that comes and goes, and lasts when it comes: what is fitted to a piece of it fits no other piece."""
    return np.repeat(STEP * (np.arange(shape[0]) // LASTS % 2)[:, None], shape[1], axis=1).astype(float)


def model_off(kind: str, arguments: tuple[Any, ...], answer: Any) -> Iterator[Measurement]:
    model = _whole_numbers(kind).model
    assert model is not None
    n, n_u, p = model.order, model.B.ncols, model.C.nrows
    found, count = matrices(answer, n, n_u, p), 2 * n + 2
    off = distances(markov(*found, count), markov(model.A, model.B, model.C, model.D, count))
    yield Measurement("Markov parameters", float(np.max(off)), NEAREST)
    polynomials = [polynomial_from_the_top(one) for one in (found[0], model.A)]
    off = np.array([abs(float(x - y)) for x, y in zip(*polynomials, strict=True)])
    yield Measurement("characteristic polynomial", float(np.max(off)), NEAREST)


def _residual_off(kind: str, arguments: tuple[Any, ...], answer: Any) -> Iterator[Measurement]:
    """The input is the fault of the others, so that the steps are left, and a free response, which is C A^n x from sample n on: A^n is a
    projection."""
    y, _, A, _, C, _ = arguments
    n = len(A)
    off = (as_signal(answer, y.shape) - LOUD * stepping(y.shape))[n:]
    lasting = C @ np.linalg.matrix_power(A, n)
    free = lasting @ np.linalg.pinv(lasting) @ off.mean(axis=0)
    yield Measurement("r", float(np.max(np.abs(off - free))), NEAREST)


def _ranks_off(kind: str, arguments: tuple[Any, ...], answer: Any) -> Iterator[Measurement]:
    yield from ranks_off(answer, _fault(kind).ranks)


def _count_off(kind: str, arguments: tuple[Any, ...], answer: Any) -> Iterator[Measurement]:
    yield Measurement("n_v", abs(as_number(answer) - _fault(kind).n_v), 0.0)


def _space_off(kind: str, arguments: tuple[Any, ...], answer: Any) -> Iterator[Measurement]:
    r, A, C, n_v, block_rows = arguments
    bound = noise_free_fault_space(r, A, C, n_v=n_v, block_rows=block_rows).error_bound
    assert bound is not None
    yield from spaces_off(answer, _fault(kind).space, bound)


def _signal_off(kind: str, arguments: tuple[Any, ...], answer: Any) -> Iterator[Measurement]:
    due, late = faults("reconstruct", len(arguments[0]), kind), _fault(kind).v.nrows - _fault(kind).trusted
    got = as_signal(answer, due.shape)
    yield Measurement("v", float(np.max(np.abs(got - due)[: len(due) - late])), NEAREST)


def as_signal(answer: Any, shape: tuple[int, ...]) -> Array:
    """Return the answer as an array of that shape. Raises Broken for anything else."""
    try:
        return np.asarray(answer, dtype=float).reshape(shape)
    except (TypeError, ValueError):
        raise Broken(f"a signal of shape {shape} is due, and this is none") from None


_OFF: dict[str, Callable[[str, tuple[Any, ...], Any], Iterator[Measurement]]] = {
    "identify": model_off,
    "residual": _residual_off,
    "window_ranks": _ranks_off,
    "fault_dimension": _count_off,
    "fault_space": _space_off,
    "reconstruct": _signal_off,
}


def _whole_numbers(kind: str) -> Trouble:
    return next(one for one in default_troubles() if one.kind == kind)


def _fault(kind: str) -> FaultVector:
    vector = _whole_numbers(kind).faults
    assert vector is not None
    return vector


def _memory(arguments: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    yield Measurement("bytes", footprint(lambda: function(*arguments)), inf)


def _time(arguments: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    yield Measurement("seconds", timed(lambda: function(*arguments)), inf)


def _cost(measure: Callable[..., Iterator[Measurement]], name: str, length: int, function: Function) -> float:
    (found,) = inside(measure, question(name, length), function)
    return found.got


def question(name: str, length: int, kind: str = FORGETTING) -> tuple[Any, ...]:
    """Return the function's arguments with a record of that length, driven by signs."""
    if name == "identify":
        model = _whole_numbers(kind).model
        assert model is not None
        u = _driven(length, model.B.ncols)
        return _response(u, *driven_system(name, kind)), u, model.order, model.block_rows
    fault = _fault_of(name, kind)
    A, F, C, G = (floats(M) for M in driven_system(name, kind))
    v = faults(name, length, kind)
    r = _response(v, *driven_system(name, kind))
    arguments: dict[str, tuple[Any, ...]] = {
        "residual": (r, v, A, F, C, G),
        "window_ranks": (r, len(fault.ranks)),
        "fault_dimension": (r,),
        "fault_space": (r, A, C, fault.n_v, len(A) + 1),
        "reconstruct": (r, A, F, C, G, np.zeros(len(A))),
    }
    return arguments[name]


def faults(name: str, length: int, kind: str = FORGETTING) -> Array:
    """Return the signal behind a residual; where it has to be found again, it is LOUD, and that of the kind that adds up begins late."""
    v = _driven(length, _fault_of(name, kind).system.m)
    if kind != FORGETTING and name != "residual":
        v[: length - length // LATE] = 0.0
    return v * (LOUD if name == "reconstruct" else 1.0)


def driven_system(name: str, kind: str = FORGETTING) -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """Return the system (A, B, C, D), or (A, F, C, G), that the signs drive in the records of a function."""
    if name == "identify":
        model = _whole_numbers(kind).model
        assert model is not None
        return model.A, model.B, model.C, model.D
    system = _fault_of(name, kind).system
    return system.A, system.F, system.C, system.G


def _fault_of(name: str, kind: str) -> FaultVector:
    # The count is asked of the first vector, too: its record has no whole numbers, and one fault as well.
    first: FaultVector = shipped("faults")[0]
    return first if (name, kind) == ("fault_dimension", FORGETTING) else _fault(kind)


def _driven(length: int, channels: int) -> Array:
    return np.ascontiguousarray(signs(SEED, length * channels).reshape(channels, length).T)


def _response(u: Array, *system: Any) -> Array:
    model = StateSpaceModel(*(floats(M) for M in system))
    return np.asarray(model.simulate(u, np.zeros(model.n)))
