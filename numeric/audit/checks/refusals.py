"""This is what may be refused, and mostly must be. To refuse is to raise or to return nothing.

checks             NaN, infinity, short data, unequal lengths, an order that cannot be, a window at the lag, shapes that do not fit, faults
                   that no residual tells apart; where a right answer is possible all the same, it may be given instead
refuses            a check of that kind
same_output_twice  the vector whose lag is longer than the number of its outputs shows
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache, partial
from typing import Any

import numpy as np

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.signals import hankel

from ....base.arrays import Array
from ..making.model_bounds import bounded
from ..records import Check, Demand, Function, Measurement, Severity, or_refused
from ..vectors.fault_vectors import FaultVector
from ..vectors.rationals import floats, matrix, signs
from ..vectors.shipped_vectors import IdentificationVector, shipped
from .faults import ROUNDED, free_count, ranks_off, space_off, spaces_off
from .identification import as_it_is

SEED = 20250601
LAG = 3
SAME_OUTPUT_TWICE = "same-output-twice"
MISSING = "a missing sample goes into the estimate unnoticed"


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    yield from _of_identify(next(v for v in shipped("identification") if v.C.nrows > 1 and v.B.ncols > 1))
    yield from _of_faults(next(v for v in shipped("faults") if v.slug == "two-faults"))
    for vector in shipped("faults"):
        yield from _below_the_lag(vector)


def refuses(
    slug: str, function: str, vector: str, effect: str, arguments: Callable[[], tuple[Any, ...]], claim: str | None = None
) -> Check:
    """Return the check that a question with these arguments, made anew, is refused."""

    def measure(called: Function) -> Iterator[Measurement]:
        called(*arguments())
        return iter(())

    return Check(slug, function, vector, claim, effect, Severity.SILENT, measure, Demand.MUST_REFUSE)


def _with(array: Array, value: float) -> Array:
    array[len(array) // 2, 0] = value
    return array


def _of_identify(vector: IdentificationVector) -> Iterator[Check]:
    n, s, slug = vector.order, vector.block_rows, vector.slug
    y, u = partial(floats, vector.y), partial(floats, vector.u)
    # The other samples determine the model: whoever leaves the missing one out and finds it is right.
    yield _model("refuses-nan-output", vector, MISSING, lambda: (_with(y(), np.nan), u(), n, s))
    yield _model("refuses-nan-input", vector, MISSING, lambda: (y(), _with(u(), np.nan), n, s))
    yield _model("refuses-infinity", vector, MISSING, lambda: (_with(y(), np.inf), u(), n, s))
    # Fewer equations than unknowns: any of them is one of many models. The unknowns: a canonical form of A and C, B, D and x(0).
    few = (n * vector.C.nrows + (n + vector.C.nrows) * vector.B.ncols + n - 1) // vector.C.nrows
    effect = "a model from fewer equations than unknowns"
    yield refuses("refuses-short-data", "identify", slug, effect, lambda: (y()[:few], u()[:few], n, s))
    yield refuses("refuses-unequal-lengths", "identify", slug, "inputs paired with the wrong outputs", lambda: (y(), u()[:-5], n, s))
    effect = "states that the window cannot carry: made-up poles"
    impossible = vector.C.nrows * (s - 1) + 1
    # A model of so many states may have the responses of the true one, and then nothing made up is seen.
    yield _model("refuses-impossible-order", vector, effect, lambda: (y(), u(), impossible, s), "sharp-windows", impossible)
    yield refuses("refuses-silent-input", "identify", slug, "a model without a cause", lambda: (y(), 0 * u(), n, s))
    yield _window_at_the_lag()


def _model(
    slug: str,
    vector: IdentificationVector,
    effect: str,
    arguments: Callable[[], tuple[Any, ...]],
    claim: str | None = None,
    order: int | None = None,
) -> Check:
    def compare(called: Function) -> Iterator[Measurement]:
        yield from as_it_is(called(*arguments()), vector, order)

    return Check(slug, "identify", vector.slug, claim, effect, Severity.SILENT, or_refused(compare))


def _window_at_the_lag() -> Check:
    """A window of `LAG` block rows does not determine A; the record does, and whoever reads it otherwise may find the model."""

    def compare(called: Function) -> Iterator[Measurement]:
        vector = same_output_twice()
        yield from as_it_is(called(floats(vector.y), floats(vector.u), vector.order, LAG), vector)

    effect = "A is not determined by so short a window: made-up poles"
    slug, claim = "refuses-window-at-the-lag", "sharp-windows"
    return Check(slug, "identify", SAME_OUTPUT_TWICE, claim, effect, Severity.SILENT, or_refused(compare))


@cache
def same_output_twice() -> IdentificationVector:
    """Return a vector whose two outputs see the same: O_(s-1) has rank 2 < n = 3 at s = LAG, although p (s - 1) = 4 >= n.

    Its bounds are those of the shortest window that determines A.
    """
    A = matrix([["1/2", "1/4", "0"], ["-1/4", "1/2", "1/3"], ["0", "0", "1/5"]], 3)
    B, C, D = matrix([["1"], ["1/2"], ["1"]], 1), matrix([["1", "0", "0"], ["2", "0", "0"]], 3), matrix([["0"], ["0"]], 1)
    v: Matrix = shipped("faults")[0].v
    u = v.columns([0])
    return bounded(IdentificationVector(SAME_OUTPUT_TWICE, A, B, C, D, matrix([[1], [2], [3]], 1), u, LAG + 1, {}))


def _of_faults(vector: FaultVector) -> Iterator[Check]:
    system, slug, s = vector.system, vector.slug, vector.system.n + 1
    r = partial(floats, vector.r)
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    x0, n_v = np.zeros(len(A)), vector.n_v
    others: dict[str, tuple[Any, ...]] = {
        "window_ranks": (3,),
        "fault_dimension": (),
        "fault_space": (A, C, n_v, s),
        "reconstruct": (A, F, C, G, x0),
    }
    for function, rest in others.items():
        for name, value in (("nan", np.nan), ("infinite", np.inf)):
            yield refuses(f"refuses-{name}-residual", function, slug, MISSING, partial(_broken, vector, value, rest))
    short = "ranks of matrices with fewer columns than rows say nothing of the system"
    yield refuses("refuses-short-residual", "window_ranks", slug, "ranks of windows longer than the record", lambda: (r()[:5], 8))
    yield refuses("refuses-short-residual", "fault_dimension", slug, short, lambda: (r()[:7],), "settle-2")
    yield refuses("refuses-short-residual", "fault_space", slug, short, lambda: (r()[:7], A, C, n_v, s), "sharp-windows")
    yield _too_short(vector)
    wrong = "matrices of another system are taken for those of the residual"
    yield refuses("refuses-shapes", "fault_space", slug, wrong, lambda: (r(), A, C[:-1], n_v, s))
    yield refuses("refuses-shapes", "reconstruct", slug, wrong, lambda: (r(), A, F, C[:-1], G[:-1], x0))
    yield refuses("refuses-shapes", "residual", slug, wrong, lambda: (r(), r()[:, : system.m], A, F, C[:-1], G[:-1]))
    yield refuses("refuses-shapes", "structure", slug, wrong, lambda: (A, F[:-1], C, G))
    many = "more faults than outputs cannot be told apart"
    told, due = system.p + 1, (vector.space, vector.space_bounds[s])
    yield _space("refuses-too-many-faults", vector, many, lambda: (r(), A, C, told, s), "proposition-3", *due)
    nothing = "fault matrices of what is no fault: the ranks show as many sources as outputs"
    noise = signs(SEED, len(r()) * system.p).reshape(-1, system.p)
    everything = Matrix.identity(QQ, system.n + system.p)  # where there is no law, every column explains the record
    yield _space("refuses-pure-noise", vector, nothing, lambda: (noise.copy(), A, C, n_v, s), "problem-11", everything, ROUNDED)
    twice = "one of many fault signals that fit, without a word"
    F2, G2 = F[:, [0, 0]], G[:, [0, 0]]
    yield refuses("refuses-same-fault-twice", "reconstruct", slug, twice, lambda: (r(), A, F2, C, G2, x0), "trajectory-recovered")
    wide = "one of many fault signals that fit, without a word"
    first = r()[:, :1], A, F, C[:1], G[:1], x0
    yield refuses("refuses-more-faults-than-outputs", "reconstruct", slug, wide, lambda: first, "trajectory-recovered")
    none = "answers about no system"
    yield refuses("refuses-nan-model", "residual", slug, none, lambda: (r(), r()[:, : system.m], A * np.nan, F, C, G))
    yield refuses("refuses-nan-model", "fault_space", slug, none, lambda: (r(), A * np.nan, C, n_v, s))
    yield refuses("refuses-nan-model", "reconstruct", slug, none, lambda: (r(), A * np.nan, F, C, G, x0))
    yield refuses("refuses-nan-model", "structure", slug, none, lambda: (A * np.nan, F, C, G))
    u = floats(vector.v)
    yield refuses("refuses-nan-output", "residual", slug, MISSING, lambda: (_with(r(), np.nan), u, A, F, C, G))
    yield refuses("refuses-nan-input", "residual", slug, MISSING, lambda: (r(), _with(u.copy(), np.nan), A, F, C, G))
    unequal = "inputs paired with the wrong outputs"
    yield refuses("refuses-unequal-lengths", "residual", slug, unequal, lambda: (r(), u[:-5], A, F, C, G))


def _too_short(vector: FaultVector) -> Check:
    """Ask for windows that are higher than wide: their ranks say nothing of the system, and yet they have ranks."""
    p, windows = vector.system.p, 6
    few = (p + 1) * windows - 4
    due = tuple(rank(hankel(vector.r.rows(range(few)), s)) for s in range(1, windows + 1))
    effect = "ranks of windows that the record does not fill, and not theirs"

    def compare(called: Function) -> Iterator[Measurement]:
        yield from ranks_off(called(floats(vector.r)[:few], windows), due)

    slug = "window-ranks-too-short"
    return Check(slug, "window_ranks", vector.slug, None, effect, Severity.SILENT, or_refused(compare))


def _broken(vector: FaultVector, value: float, rest: tuple[Any, ...]) -> tuple[Any, ...]:
    return _with(floats(vector.r), value), *rest


def _space(
    slug: str, vector: FaultVector, effect: str, arguments: Callable[[], tuple[Any, ...]], claim: str, truth: Matrix, bound: float
) -> Check:
    def compare(called: Function) -> Iterator[Measurement]:
        yield from spaces_off(called(*arguments()), truth, bound)

    return Check(slug, "fault_space", vector.slug, claim, effect, Severity.SILENT, or_refused(compare))


def _below_the_lag(vector: FaultVector) -> Iterator[Check]:
    """What a window no longer than the lag shows is not the answer: it may be refused, or be found in some other way."""
    effect = "wrong columns are accepted: fault matrices of no such system"
    compare = partial(space_off, vector, block_rows=vector.lag)
    slug, claim = "fault-space-at-the-lag", "sharp-windows"
    yield Check(slug, "fault_space", vector.slug, claim, effect, Severity.SILENT, or_refused(compare))
    few = (vector.system.p + 1) * (vector.lag + 1) - 2  # one sample less, and R_(lag + 1) has fewer columns than rows
    slug, effect = "fault-dimension-below-the-lag", "the gap of windows below the lag is taken for the number of faults"
    # The data are those of more faults and a shorter lag as well.
    yield free_count(slug, vector.slug, effect, "n_v", vector.r.rows(range(few)), vector.n_v, "sharp-windows")
