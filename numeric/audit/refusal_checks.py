"""What must be refused: data and arguments for which every answer is wrong. To refuse is to raise or to return nothing.

checks      NaN, infinity, short data, unequal lengths, an order that cannot be, a window at the lag, shapes that do not fit
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from faultspace.exact.signals import simulate
from faultspace.exact.systems import ResidualSystem

from .records import Check, Function, Kind, Measurement, Severity
from .vectors import FaultVector, IdentificationVector, floats, matrix, shipped

Array = NDArray[np.float64]
MISSING = "a missing sample goes into the estimate unnoticed"


def checks() -> Iterator[Check]:
    """All of this module."""
    yield from _of_identify(next(v for v in shipped("identification") if v.C.nrows > 1 and v.B.ncols > 1))
    yield from _of_faults(next(v for v in shipped("faults") if v.slug == "two-faults"))


def _refuses(
    slug: str, function: str, vector: str, effect: str, arguments: Callable[[], tuple[Any, ...]], claim: str | None = None
) -> Check:
    def measure(called: Function) -> Iterator[Measurement]:
        called(*arguments())
        return iter(())

    return Check(slug, function, vector, claim, effect, Severity.SILENT, measure, Kind.MUST_REFUSE)


def _with(array: Array, value: float) -> Array:
    array[len(array) // 2, 0] = value
    return array


def _of_identify(vector: IdentificationVector) -> Iterator[Check]:
    n, s, slug = vector.order, vector.block_rows, vector.slug

    def y() -> Array:
        return floats(vector.y)

    def u() -> Array:
        return floats(vector.u)

    yield _refuses("refuses-nan-output", "identify", slug, MISSING, lambda: (_with(y(), np.nan), u(), n, s))
    yield _refuses("refuses-nan-input", "identify", slug, MISSING, lambda: (y(), _with(u(), np.nan), n, s))
    yield _refuses("refuses-infinity", "identify", slug, MISSING, lambda: (_with(y(), np.inf), u(), n, s))
    few = 2 * s + 1
    effect = "a model from fewer equations than unknowns"
    yield _refuses("refuses-short-data", "identify", slug, effect, lambda: (y()[:few], u()[:few], n, s))
    yield _refuses("refuses-unequal-lengths", "identify", slug, "inputs paired with the wrong outputs", lambda: (y(), u()[:-5], n, s))
    effect = "states that the window cannot carry: made-up poles"
    impossible = vector.C.nrows * (s - 1) + 1
    yield _refuses("refuses-impossible-order", "identify", slug, effect, lambda: (y(), u(), impossible, s), "sharp-windows")
    yield _refuses("refuses-silent-input", "identify", slug, "a model without a cause", lambda: (y(), 0 * u(), n, s))
    yield _window_at_the_lag()


def _window_at_the_lag() -> Check:
    """Two outputs that see the same: O_(s-1) has rank 2 < n = 3 at s = 3, although p (s - 1) = 4 >= n."""
    system = ResidualSystem.of(
        [["1/2", "1/4", "0"], ["-1/4", "1/2", "1/3"], ["0", "0", "1/5"]],
        [["1"], ["1/2"], ["1"]],
        [["1", "0", "0"], ["2", "0", "0"]],
        [["0"], ["0"]],
    )
    vector: FaultVector = shipped("faults")[0]
    u = matrix(vector.v.transposed().to_json()[:1], vector.v.nrows).transposed()
    y = simulate(system, matrix([[1], [2], [3]], 1), u).residuals
    effect = "A is not determined by so short a window: made-up poles"
    at_the_lag = floats(y), floats(u), 3, 3
    return _refuses("refuses-window-at-the-lag", "identify", "same-output-twice", effect, lambda: at_the_lag, "sharp-windows")


def _of_faults(vector: FaultVector) -> Iterator[Check]:
    system, slug = vector.system, vector.slug

    def r() -> Array:
        return floats(vector.r)

    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    yield _refuses("refuses-nan-residual", "window_ranks", slug, MISSING, lambda: (_with(r(), np.nan), 3))
    yield _refuses("refuses-nan-residual", "fault_dimension", slug, MISSING, lambda: (_with(r(), np.nan),))
    yield _refuses("refuses-nan-residual", "fault_space", slug, MISSING, lambda: (_with(r(), np.nan), A, C, vector.n_v))
    yield _refuses("refuses-nan-residual", "reconstruct", slug, MISSING, lambda: (_with(r(), np.nan), A, F, C, G, np.zeros(len(A))))
    short = "ranks of matrices with fewer columns than rows say nothing of the system"
    yield _refuses("refuses-short-residual", "fault_dimension", slug, short, lambda: (r()[:7],), "settle-2")
    yield _refuses("refuses-short-residual", "fault_space", slug, short, lambda: (r()[:7], A, C, vector.n_v), "sharp-windows")
    wrong = "matrices of another system are taken for those of the residual"
    yield _refuses("refuses-shapes", "fault_space", slug, wrong, lambda: (r(), A, C[:-1], vector.n_v))
    many = "more faults than outputs cannot be told apart"
    yield _refuses("refuses-too-many-faults", "fault_space", slug, many, lambda: (r(), A, C, system.p + 1), "proposition-3")
    yield _refuses("refuses-nan-model", "structure", slug, "zeros of no system", lambda: (A * np.nan, F, C, G))
