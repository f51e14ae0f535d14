"""Try orders 0, 1, 2, .. on one record, with the evidence for each.

The first part of every experiment makes models that are then tried on the part held back; the windows of both parts together, which share
`lags` samples at the cut, are those of the whole record, on which the choice rests. Orders are tried until some in a row have not bettered
the criterion by which one is chosen; the models of the first part start from those of the whole.

order_tried     the evidence, and the model of the best order
held_out_fits   of PI-MOESP models, where neither singular values nor an ARX model tell the order: each order's fit to the part held back
order_left_open the order of the best fit and those that fit nearly as well; None where no order fits better than a constant

A fit is 1 - |y - simulated y| / |y - mean of y| in channels of equal size, the initial state fitted. Simulating is what a model without a
disturbance's spectrum can be held to. The error of a fit to M numbers is that of a deviation, about 1 / sqrt(2 M) of |y - simulated y|:
orders whose misfit is within FAR such errors of the best are left open, and where the best is not as much better than a constant, beside
what n numbers of an initial state explain of noise, there is none. That describes what was tried, and is no test of a level.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from .arx import Arx, fitted_arx
from .arx_windows import ArxWindows, about_zero, arx_windows, joined_windows, merge_windows
from .compression import Pieces
from .order_evidence import OrderEvidence, OrderRow, weighed
from .past_inputs import pi_moesp
from .reduced_model import ReducedModel, described, judged, reduction_problems, weight_inflation
from .reduction_search import Found, minima
from .reduction_starts import hankel_factors
from .residuals import residual
from .weighted_reduction import arrived, descend

HELD_BACK = 60, 1e-7  # most steps, and relative gain of the last one, of models that are only held against samples kept back
KEPT_BACK = 3  # one part in so many is held back
MOST, HELD, FAR = 12, 1 << 14, 2.0  # of PI-MOESP models: orders tried, samples looked at (the last of the record), errors
MOST_HELD = 1 << 15  # samples of an experiment that are held back at most: they stand in memory


def order_tried(sources: Sequence[Pieces], lengths: Sequence[int], lags: int, offset: bool) -> tuple[OrderEvidence, ReducedModel]:
    """Return the evidence over orders and the model of the best, from experiments of these lengths. InvalidData as `arx_reduction`."""
    cuts = [max(length - length // KEPT_BACK, length - MOST_HELD) for length in lengths]
    first = [arx_windows(_part(source, 0, cut), lags) for source, cut in zip(sources, cuts, strict=True)]
    rest = [arx_windows(_part(source, max(cut - lags, 0), None), lags) for source, cut in zip(sources, cuts, strict=True)]
    both = [joined_windows(*parts) for parts in zip(first, rest, strict=True)]
    training, whole = (merge_windows(parts if offset else [about_zero(part) for part in parts]) for parts in (first, both))
    held = [_joined(_part(source, cut, None)) if part.windows else None for source, cut, part in zip(sources, cuts, first, strict=True)]
    arx = fitted_arx(whole, min(lags, 1))
    problem, coarse = reduction_problems(whole, arx)
    a_state = whole.p + whole.n_u
    inflation = weight_inflation(arx)
    found = minima(whole, arx, problem, coarse, 2.0 * a_state * inflation)
    if not found:
        raise InvalidData("no model can be begun for any order: the data show no dynamics; record with an input that varies more")
    fits, gaps = _fits(training, whole, held, found), _gaps(arx, max(lags, 1))
    rows = []
    for n, (one, (one_step, free_run)) in enumerate(zip(found, fits, strict=True)):
        gap = float(gaps[n - 1]) if 0 < n <= len(gaps) else float("nan")
        poles = _poles(one.matrix[:n, :n])
        rows.append(OrderRow(n, one.cost / inflation, n * a_state + whole.p * whole.n_u, 0.0, one_step, free_run, gap, poles))
    evidence = weighed(rows)
    best = evidence.best
    ended = Found(*arrived(problem, found[best].matrix, best))
    # Orders too low may look like an unstable plant: only the choice is judged.
    return evidence, judged(described(whole, arx, problem, ended, best), whole)


def _part(source: Pieces, first: int, last: int | None) -> Iterator[tuple[Array, Array]]:
    """Yield samples first .. last - 1 of an experiment."""
    at = 0
    for y, u in source:
        chosen = slice(max(first - at, 0), None if last is None else max(last - at, 0))
        at += len(y)
        yield y[chosen], u[chosen]


def _joined(data: Iterator[tuple[Array, Array]]) -> tuple[Array, Array]:
    y, u = (np.concatenate(parts) for parts in zip(*data, strict=True))
    return y, u


def _poles(A: Array) -> tuple[complex, ...]:
    """Return the eigenvalues of A by falling modulus, the one above the real axis first of a pair."""
    values = np.linalg.eigvals(A)
    return tuple(complex(value) for value in values[np.lexsort((-values.imag, -values.real, -np.abs(values)))])


def _gaps(arx: Arx, rows: int) -> Array:
    """Return the ratios of neighbouring singular values of the Hankel matrix, but for those among its last block of columns or rows, where
    the least values of any matrix are far apart, whatever is in it."""
    values = hankel_factors(arx, rows, weighted=True)[2]
    values = values[: max(len(values) - min(arx.inputs.shape[1:]), 0)]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios: Array = values[:-1] / values[1:]
    return ratios


def _fits(
    training: ArxWindows, whole: ArxWindows, held: Sequence[tuple[Array, Array] | None], found: Sequence[Found]
) -> list[tuple[float, float]]:
    """Return for each order the one-step and free-run fit, on the samples held back, of the model of the first part; NaN where it is too
    short."""
    none = [(float("nan"), float("nan"))] * len(found)
    try:
        arx = fitted_arx(training, min(training.lags, 1))
    except InvalidData:
        return none
    _, problem = reduction_problems(training, arx)
    scales = zip(whole.scales, training.scales, strict=True)
    y, u = (of_whole / of_part for of_whole, of_part in scales)
    fits = []
    for n, one in enumerate(found):
        moved = one.matrix * np.concatenate([np.ones(n), y])[:, None] / np.concatenate([np.ones(n), u])
        model = described(training, arx, problem, Found(*descend(problem, moved, n, *HELD_BACK)), n)
        try:
            fits.append(_fit(model, training, held))
        except InvalidData:
            fits.append(none[n])
    return fits


def _fit(found: ReducedModel, training: ArxWindows, held: Sequence[tuple[Array, Array] | None]) -> tuple[float, float]:
    scale, h = training.scales[0], found.arx.order
    about = [(one[0] - mean, one[1]) for one, mean in zip(held, found.offsets, strict=True) if one is not None]
    free = [residual(y, u, found.model).r for y, u in about]
    power = sum(float(np.sum((y[h:] / scale) ** 2)) for y, _ in about)
    errors = [sum(r[h - i : len(r) - i] @ found.arx.outputs[i].T for i in range(h + 1)) for r in free]
    sizes = [np.sqrt(sum(float(np.sum((part / scale) ** 2)) for part in parts) / power) for parts in (errors, [r[h:] for r in free])]
    return float(1 - sizes[0]), float(1 - sizes[1])


@dataclass(frozen=True)
class OpenOrder:
    """The model of order `best` fits the samples held back best, those of orders `least` to `most` nearly as well; `fits` has the fit of
    each order tried, from 1 on, NaN where there is none."""

    best: int
    least: int
    most: int
    fits: tuple[float, ...]


def held_out_fits(y: Array, u: Array, block_rows: int) -> list[float]:
    """Return the fits of orders 1, 2, .. for y (N, p) and u (N, n_u); NaN where an order has no model."""
    y, u = y[-HELD:], u[-HELD:]
    cut = len(y) - len(y) // KEPT_BACK
    about = y[cut:] - y[cut:].mean(axis=0)
    spread = np.sqrt(np.mean(about**2, axis=0))
    scale = np.where(spread > 0, spread, 1.0)
    fits = []
    for n in range(1, MOST + 1):
        try:
            model = pi_moesp(y[:cut], u[:cut], order=n, block_rows=block_rows)
            rest = residual(y[cut:], u[cut:], model).r
        except (InvalidData, np.linalg.LinAlgError):
            fits.append(float("nan"))
            continue
        with np.errstate(over="ignore", invalid="ignore"):
            fits.append(float(1 - np.linalg.norm(rest / scale) / np.linalg.norm(about / scale)))
    return fits


def order_left_open(y: Array, u: Array, block_rows: int) -> OpenOrder | None:
    """Return the order that fits held-back samples best, with those nearly as good; None where none is better than the mean."""
    fits = np.array(held_out_fits(y, u, block_rows))
    held = max(min(len(y), HELD) // KEPT_BACK * y.shape[1], 1)
    orders = np.minimum(np.arange(1, MOST + 1), held)
    if not np.any(1 - fits < (1 - FAR / np.sqrt(2 * held)) * np.sqrt(1 - orders / held)):
        return None
    best = int(np.nanargmax(fits))
    near = np.flatnonzero(1 - fits <= (1 - fits[best]) * (1 + FAR / np.sqrt(2 * held)))
    return OpenOrder(best + 1, int(near[0]) + 1, int(near[-1]) + 1, tuple(fits.tolist()))
