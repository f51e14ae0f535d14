"""Questions at the edge of what may be asked: few windows, few samples, no fault, numbers that cannot be, a number of faults that is wrong.

checks            window-ranks-few-windows, window-ranks-shortest-record, fault-dimension-shortest-record, fault-signal-few-samples: what is
                  due although there is hardly more than nothing; window-ranks-no-fault, fault-signal-no-fault, refuses-no-fault: where no
                  fault acts; fault-space-wrong-number: more or fewer faults told than act; fault-space-as-many-as-outputs: where there is
                  no law; refuses-impossible-number: sizes below what any system has
of_silence        no-fault-told: `fault_dimension` of free responses; no-fault-of-record: `count_faults` of outputs that the input moves
first, shortest   a vector's first samples with the bound of so short a record, a residual with its ranks
free_response     a residual without a fault, its system and its first state
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.signals import hankel, simulate
from faultspace.exact.system.systems import ResidualSystem

from ...method.signal.reconstruction import reconstruct_fault
from ...study.residual_conditioning import fault_signal_error
from ..making.fault_records import signal_bound
from ..records import Check, Function, Measurement, Severity, Sides, or_refused
from ..vectors.exact_comparison import lifted
from ..vectors.fault_vectors import FaultVector, samples_that_settle
from ..vectors.rationals import floats, fractions, matrix
from ..vectors.shipped_vectors import shipped
from .faults import ROUNDED, compared_count, ranks_off, signal_off, spaces_off
from .laws import LOUD, nothing_acts, record
from .manners import copies
from .refusals import refuses

SAMPLES = 200
WINDOWS = 4
FEW = 2  # samples, fewer than states
BELOW = -1
TINY = float(np.finfo(float).tiny)  # of nothing nothing comes, and who divides by a bound may
# Outputs that see states, which die out, stay, or are zero; all have a fault that does not act: A, F, C, G and the first state.
FREE: dict[str, tuple[list[list[str]], ...]] = {
    "dying": ([["3/4", "1/4"], ["0", "-1/2"]], [["1/4"], ["1/4"]], [["1", "1"], ["2", "-1"]], [["1"], ["0"]], [["4"], ["-3"]]),
    "constant": ([["1", "0"], ["0", "1"]], [["1"], ["0"]], [["1", "1"], ["2", "-1"]], [["1"], ["1"]], [["2"], ["-3"]]),
    "nothing": ([["1/2", "0"], ["0", "1/4"]], [["1"], ["1"]], [["1", "1"], ["2", "-1"]], [["1"], ["0"]], [["0"], ["0"]]),
    "one-output": ([["3/4", "1/4"], ["0", "-1/2"]], [["1/4"], ["1/4"]], [["1", "1"]], [["1"]], [["4"], ["-3"]]),
}


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    vectors = {one.slug: one for one in shipped("faults")}
    for slug, windows in (("one-fault", 1), ("two-faults", 1), ("two-faults", 2)):
        effect = "wrong ranks where few windows are asked for"
        ranks = partial(_ranks, vectors[slug].r, vectors[slug].ranks[:windows])
        yield _must("window-ranks-few-windows", "window_ranks", f"{slug}-{windows}", "window-ranks", effect, ranks)
    for slug in ("one-fault", "two-faults"):
        yield from _shortest(vectors[slug])
    for slug in ("two-faults", "delayed"):
        yield _few_samples(vectors[slug])
    for name in FREE:
        yield from _no_fault(name)
    yield _wrong_number(vectors["two-faults"], 1)
    yield _wrong_number(vectors["one-fault"], 2)
    yield _as_many_as_outputs(vectors["two-faults"])
    yield from _impossible(vectors["two-faults"])


# -- little ------------------------------------------------------------------------------------------------------------------------------


def first(vector: FaultVector, samples: int) -> FaultVector:
    """Return the vector's first samples, with the bound on the signal that so short a record gives."""
    late = vector.v.nrows - vector.trusted
    short = replace(vector, v=vector.v.rows(range(samples)), views={}, trusted=samples - late, gaps=(), space_bounds={})
    return replace(short, bounds={"residual": None, "signal": signal_bound(short.r, short.system, short.x0)})


def shortest(vector: FaultVector) -> tuple[Matrix, tuple[int, ...]]:
    """Return the record in which the last of WINDOWS windows is square, and their ranks."""
    short = vector.r.rows(range((vector.system.p + 1) * WINDOWS - 1))
    return short, _ranks_of(short)


def _ranks_of(r: Matrix) -> tuple[int, ...]:
    return tuple(rank(hankel(r, s)) for s in range(1, WINDOWS + 1))


def _must(slug: str, function: str, vector: str, claim: str, effect: str, measure: Callable[[Function], Iterable[Measurement]]) -> Check:
    return Check(slug, function, vector, claim, effect, Severity.SILENT, measure)


def _ranks(r: Matrix, due: tuple[int, ...], function: Function) -> Iterator[Measurement]:
    yield from ranks_off(function(np.ascontiguousarray(floats(r)), len(due)), due)


def _shortest(vector: FaultVector) -> Iterator[Check]:
    slug, effect = "window-ranks-shortest-record", "no ranks, or wrong ones, of a record that has just samples enough"
    yield _must(slug, "window_ranks", vector.slug, "window-ranks", effect, lambda called: _ranks(*shortest(vector), called))
    slug, effect = "fault-dimension-shortest-record", "no number of faults, or a wrong one, from a record that has just samples enough"
    enough = range(samples_that_settle(vector.system.p, vector.lag))
    count = partial(_counted, lambda: (floats(vector.r.rows(enough)),), vector.n_v)
    yield _must(slug, "fault_dimension", vector.slug, "proposition-3", effect, count)


def _few_samples(vector: FaultVector) -> Check:
    slug, effect = "fault-signal-few-samples", "no fault signal, or a wrong one, in a record that is shorter than the order"
    return _must(slug, "reconstruct", vector.slug, "trajectory-recovered", effect, lambda called: signal_off(first(vector, FEW), called))


# -- nothing -----------------------------------------------------------------------------------------------------------------------------


@cache
def free_response(name: str) -> tuple[Matrix, ResidualSystem, Matrix]:
    """Return the exact residual (SAMPLES, p), the system and its first state."""
    A, F, C, G, start = FREE[name]
    system, x0 = ResidualSystem.of(A, F, C, G), matrix(start, 1)
    return simulate(system, x0, matrix([[0]] * SAMPLES, 1)).residuals, system, x0


def _no_fault(name: str) -> Iterator[Check]:
    """The ranks are what they are. The signal is zero, and to find nothing to restore is as right; a space of faults there is not."""
    r, system, x0 = free_response(name)
    effect = "a free response is taken for a fault"
    yield _must("window-ranks-no-fault", "window_ranks", name, "window-ranks", effect, lambda called: _ranks(r, _ranks_of(r), called))
    parts = tuple(floats(M) for M in (system.A, system.F, system.C, system.G))
    arguments = np.ascontiguousarray(floats(r)), *parts, floats(x0).ravel()
    zero = or_refused(partial(_silent, arguments))
    yield _must("fault-signal-no-fault", "reconstruct", name, "trajectory-recovered", effect, zero)
    if system.p > 1:
        space = arguments[0], parts[0], parts[2], 1, WINDOWS
        effect = "fault matrices of a record without a fault"
        yield refuses("refuses-no-fault", "fault_space", name, effect, partial(copies, space), "problem-11")


def _silent(arguments: tuple[Any, ...], function: Function) -> Iterator[Measurement]:
    """Compare with zeros, within what rounding of the free response may leave."""
    r, A, F, C, G, x0 = arguments
    bound = fault_signal_error(r, A, F, C, G, reconstruct_fault(r, A, F, C, G, x0=x0), x0=x0) if r.any() else TINY
    answer = lifted(function(*(one.copy() for one in arguments)), "v", (SAMPLES, 1))
    sides = Sides("signal", fractions(answer), [[0]] * SAMPLES, bound)
    yield Measurement("v", float(np.linalg.norm(floats(answer))), bound, sides)


# -- what cannot be ----------------------------------------------------------------------------------------------------------------------


def _wrong_number(vector: FaultVector, told: int) -> Check:
    """To refuse is right, and so are the columns of the faults that act, from who counts them himself."""
    system, s = vector.system, vector.system.n + 1
    effect = "fault matrices that do not explain the data: as many columns as were told"
    compare = partial(_spaces, (vector.r, system.A, system.C), (told, s), vector.space, vector.space_bounds[s])
    return _must("fault-space-wrong-number", "fault_space", f"{vector.slug}-{told}-told", "problem-11", effect, or_refused(compare))


def _as_many_as_outputs(vector: FaultVector) -> Check:
    """Where every output is faulty there is no law, and every column explains the residual: all of them, or a refusal."""
    system, m = vector.system, vector.n_v
    everything = Matrix.identity(QQ, system.n + m)
    given = vector.r.columns(range(m)), system.A, system.C.rows(range(m))
    compare = partial(_spaces, given, (m, system.n + 1), everything, ROUNDED)
    slug, effect = "fault-space-as-many-as-outputs", "true columns left out where the record excludes none"
    return _must(slug, "fault_space", f"{vector.slug}-two-outputs", "problem-11", effect, or_refused(compare))


def _spaces(given: tuple[Matrix, ...], rest: tuple[int, ...], truth: Matrix, bound: float, function: Function) -> Iterator[Measurement]:
    yield from spaces_off(function(*map(floats, given), *rest), truth, bound)


def _impossible(vector: FaultVector) -> Iterator[Check]:
    """An order or a number of faults below zero, and windows of no block row."""
    model = next(one for one in shipped("identification") if one.C.nrows > 1 and one.B.ncols > 1)
    y, u, n, s = floats(model.y), floats(model.u), model.order, model.block_rows
    r, A, C = (floats(M) for M in (vector.r, vector.system.A, vector.system.C))
    noisy = shipped("noisy")[0]
    of_record = record(noisy, LOUD)
    effect = "an answer to a question that cannot be meant"
    for function, name, arguments in (
        ("identify", "order-below-0", (y, u, BELOW, s)),
        ("identify", "no-block-rows", (y, u, n, 0)),
        ("identify", "block-rows-below-0", (y, u, n, BELOW)),
        ("fault_space", "faults-below-0", (r, A, C, BELOW, len(A) + 1)),
        ("count_faults", "order-below-0", (*of_record, BELOW)),
        ("identified_fault_space", "order-below-0", (*of_record, BELOW, noisy.system.m)),
        ("identified_fault_space", "faults-below-0", (*of_record, noisy.system.n, BELOW)),
    ):
        yield refuses("refuses-impossible-number", function, name, effect, partial(copies, arguments))


# -- silence ---------------------------------------------------------------------------------------------------------------------------


def of_silence() -> Iterator[Check]:
    """Yield the checks of records in which no fault acts: what they do not show must not be told.

    The answer 0 is right, and so is none, since a fault that does not excite looks the same; a number above 0 is made up.
    """
    for name in FREE:
        yield _none("no-fault-told", "fault_dimension", name, partial(_free_response, name))
    for vector in shipped("noisy")[:1]:
        for name, noise in (("exact", 0.0), ("noisy", LOUD)):
            yield _none("no-fault-of-record", "count_faults", f"{vector.slug}-{name}", partial(nothing_acts, vector, noise))


def _free_response(name: str) -> tuple[Any, ...]:
    return (np.ascontiguousarray(floats(free_response(name)[0])),)


def _none(slug: str, function: str, vector: str, arguments: Callable[[], tuple[Any, ...]]) -> Check:
    effect, measure = "a fault is reported where none acts", or_refused(partial(_counted, arguments, 0))
    return Check(slug, function, vector, "proposition-3", effect, Severity.SILENT, measure)


def _counted(arguments: Callable[[], tuple[Any, ...]], due: int, function: Function) -> Iterator[Measurement]:
    yield compared_count("n_v", function(*arguments()), due)
