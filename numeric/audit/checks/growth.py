"""Check how memory and time grow with the length of the record: in proportion, or with its square.

    checks              for every function that reads a record
    footprint, Held     peak memory beyond what was there, of this process and all that it started
    timed, Spent        their CPU seconds, taken without a look at the memory, which itself takes time
    exponent            log of the ratio of two costs over that of the lengths

The bound on the exponent is midway between linear and quadratic. What stays under a floor costs nobody anything and counts as no growth;
the smaller cost is taken to be at least the floor's share, because small amounts drown in what the process holds anyway. Time may leap
where data outgrow a cache: only a growth that goes on to twice the length is called one.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from math import log
from typing import Any

import numpy as np
import psutil

from ....base.arrays import Array
from ....base.processes import family, resident
from ...model.models import StateSpaceModel
from ..records import Check, Function, Measurement, Severity
from ..vectors.rationals import floats, signs
from ..vectors.shipped_vectors import FaultVector, IdentificationVector, shipped

LENGTHS = (3000, 12000)  # a square of 8-byte numbers is 1.2 GB at the longer, one of bytes 0.14
BOUND = 1.5  # of the exponent: half way, on its scale, between what is linear and what is a square
MEMORY_FLOOR = 32e6  # bytes
TIME_FLOOR = 0.1  # seconds
EVERY = 0.004  # seconds between two looks at the memory
SEED = 20250523


@dataclass
class Held:
    """The memory is in bytes, and is filled in when the work is done."""

    memory: float = 0.0


@dataclass
class Spent:
    """The time is in seconds, and is filled in when the work is done."""

    seconds: float = 0.0


@contextmanager
def footprint() -> Iterator[Held]:
    """Measure the memory that the body costs this process and its children, looked at every few milliseconds."""
    spent, done, before = Held(), threading.Event(), _held()
    peak = before

    def watch() -> None:
        nonlocal peak
        while not done.wait(EVERY):
            peak = max(peak, _held())

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield spent
    finally:
        last = _held()
        done.set()
        watcher.join()
        spent.memory = max(peak, last) - before


@contextmanager
def timed() -> Iterator[Spent]:
    """Measure the CPU seconds that the body costs this process and its children."""
    spent, whole = Spent(), psutil.Process()
    begun = _seconds(whole)
    try:
        yield spent
    finally:
        spent.seconds = max(_seconds(whole) - begun, 0.0)


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


def _grows(slug: str, name: str, effect: str) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        if slug.startswith("memory"):
            less, more = (_memory(function, question(name, length)) for length in LENGTHS)
            yield Measurement("exponent of memory", exponent((less, more), LENGTHS, MEMORY_FLOOR), BOUND)
            return
        small, large = (_time(function, question(name, length)) for length in LENGTHS)
        got = exponent((small, large), LENGTHS, TIME_FLOOR)
        if got > BOUND:
            lengths = LENGTHS[1], 2 * LENGTHS[1]
            further = _time(function, question(name, lengths[1]))
            got = min(got, exponent((large, further), lengths, TIME_FLOOR))
        yield Measurement("exponent of time", got, BOUND)

    return Check(slug, name, f"N{LENGTHS[0]}-N{LENGTHS[1]}", None, effect, Severity.NUISANCE, measure)


def _memory(function: Function, arguments: tuple[Any, ...]) -> float:
    with footprint() as spent:
        function(*arguments)
    return spent.memory


def _time(function: Function, arguments: tuple[Any, ...]) -> float:
    with timed() as spent:
        function(*arguments)
    return spent.seconds


def question(name: str, length: int) -> tuple[Any, ...]:
    """Return the function's arguments with a record of that length, driven by signs."""
    if name == "identify":
        model: IdentificationVector = next(one for one in shipped("identification") if (one.B.ncols, one.C.nrows) == (2, 2))
        u = _driven(length, model.B.ncols)
        return _response(u, model.A, model.B, model.C, model.D), u, model.order, model.block_rows
    fault: FaultVector = shipped("faults")[0]
    A, F, C, G = (floats(M) for M in (fault.system.A, fault.system.F, fault.system.C, fault.system.G))
    v = _driven(length, fault.system.m)
    r = _response(v, fault.system.A, fault.system.F, fault.system.C, fault.system.G)
    arguments: dict[str, tuple[Any, ...]] = {
        "residual": (r, v, A, F, C, G),
        "window_ranks": (r, len(A) + 2),
        "fault_dimension": (r,),
        "fault_space": (r, A, C, fault.n_v, len(A) + 1),
        "reconstruct": (r, A, F, C, G, np.zeros(len(A))),
    }
    return arguments[name]


def _driven(length: int, channels: int) -> Array:
    return np.ascontiguousarray(signs(SEED, length * channels).reshape(channels, length).T)


def _response(u: Array, *system: Any) -> Array:
    model = StateSpaceModel(*(floats(M) for M in system))
    return np.asarray(model.simulate(u, np.zeros(model.n)))
