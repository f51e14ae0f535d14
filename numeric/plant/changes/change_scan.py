"""A scan of a residual for the sample at which it changes: one stationary process, or one before and another one after.

Both are autoregressive with their own mean, coefficients and covariance of the innovations, so that a change of the mean, of the powers, of
how outputs go together or of the colour is seen, and a mean that moves is not taken for a slow colour. With n_1 samples before and n_2
after, the likelihood ratio of two processes against one is

    L(k) = n log|S| - n_1 log|S_1| - n_2 log|S_2|,

S the covariances of the innovations [CG00, chapter 3]. Of Gaussian data without a change its mean is known: n_1 S_1 is a Wishart matrix,
and E log|W| is a sum of digamma functions. The ratio is scaled by it, so that short parts are not preferred.

The chance that such a largest ratio comes about without a change is counted on records without one: one autoregression, driven by the
innovations of M parts of equal length in another order. Slow colours, whose means wander within a part, do so there too; the innovations
may have any law, and depend on each other within a part. They are those about the means of both sides of the best split, but for the
samples whose regressors lie beyond it: a step would else be one large innovation of a slow process. Besag and Clifford's rule ends the
count when the answer is clear [BC91].

The interval. Where both densities are known, log likelihood ratios beside the true sample are sums whose exponentials have the mean one,
and a supremum above c on one side has a chance of at most e^-c (Ville's inequality, [S88]). Both sides are independent: the samples whose L
is less than 2 c below the largest hold the true one with a probability of at least (1 - e^-c)^2. As many samples as there are lags are
added in front: behind the true sample these have regressors from before it, which fit neither process.

The sample behind a step has regressors from before it, and is an outlier of either process, which may hide the step. So, where there are
lags, processes that have none are compared as well, on the same records without a change; both chances are then doubled.

Scan             a stretch, cut into parts, and what it tells
scan             makes it
changed_outputs  the chance of the change in each output alone
choose_lags      the order of the autoregression, by the criterion of Schwarz
located          the sample, and the interval that holds it
Reader           gives rows first .. last - 1 of the residual, in units of its own deviations
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.special import digamma

from ....base.arrays import Array
from ...data.validation import PIECE
from ...method.model.arx import companion_roots
from ...method.model.models import StateSpaceModel, lower_toeplitz, observability_matrix

Reader = Callable[[int, int], Array]
Numbers = NDArray[np.intp]

PARTS = 64  # of equal length, at most
SHORTEST = 4  # samples of a part
HELD_OF_PART = 256  # samples of a longer part that are looked at to tell whether there is a change: its first ones
MOST_LAGS = 12
SAMPLES_A_NUMBER = 12  # samples for each number of a row, from which lags are tried
FLOOR = 1e-6  # of each output's deviation: as if white noise of this size were added, so that parts without any noise are compared, too
DRAWS = 399  # orders of the parts that are tried
LEAST = 1 / (DRAWS + 1)  # the least chance that can be told
CLEAR = 10  # larger ratios after which no more are tried
SEED = 20251122
NUMBERS = 1 << 20  # of the records that are made at a time
NUMBERS_OF_ROWS = 1 << 18  # of their rows, with all lags, that are multiplied at a time
STRETCH = 32  # samples of them that are made by one product of matrices
FINE = 256  # samples at which the ratio is looked at in each step of closing in


@dataclass(frozen=True, eq=False)
class Scan:
    """What a stretch of a residual says of a change. Part i has the samples `edges[i]` to `edges[i + 1]` - 1, the first of
    which `rows[i]` (L, q), [1, r(k-1), .., r(k-lags), r(k)] each, of which the columns `kept` are looked at; `open` are the
    numbers of the edges at which a change is looked for, `ratios` the scaled ratios there, and `p_value` the chance of a
    largest one as large without a change."""

    edges: Numbers
    rows: Array
    p: int
    kept: tuple[int, ...]
    open: Numbers
    ratios: Array
    p_value: float

    @property
    def lags(self) -> int:
        """Return the lags of the processes before and after."""
        return (len(self.kept) - 1) // self.p - 1

    @property
    def best(self) -> int:
        """Return the number of the edge with the largest ratio."""
        return int(self.open[np.argmax(self.ratios)])


def rows_of(values: Array, lags: int) -> Array:
    """Return the rows [1, r(k-1), .., r(k-lags), r(k)] of values (N, p) for k = lags .. N - 1."""
    N = len(values)
    return np.hstack([np.ones((N - lags, 1)), *(values[lags - i : N - i] for i in range(1, lags + 1)), values[lags:]])


def least_samples(q: int) -> int:
    """Return the samples that each side of a change must have: twice the numbers in a row."""
    return 2 * q


def choose_lags(read: Reader, first: int, last: int, p: int) -> int:
    """Return the lags of the autoregression that Schwarz's criterion chooses for samples first .. last - 1 [S78]."""
    n = last - first
    most = min(MOST_LAGS, n // (SAMPLES_A_NUMBER * p) - 1)
    if most <= 0:
        return 0
    total = _sums(read, most, [first + most, last])[0]
    q = len(total)
    criteria = []
    for lags in range(most + 1):
        kept = [*range(1 + p * lags), *range(q - p, q)]
        spread = _log_spread(total[np.ix_(kept, kept)], np.asarray(n - most), p)
        criteria.append((n - most) * float(spread) + p * p * lags * np.log(n - most))
    return int(np.argmin(criteria))


def scan(read: Reader, first: int, last: int, p: int, lags: int, earliest: int) -> Scan | None:
    """Return what samples first .. last - 1 of a residual of p outputs say of a change at `earliest` or later; None where they are too few.
    The first samples, as many as there are lags, are regressors alone."""
    n, q = last - first - lags, 1 + p * (lags + 1)
    if n < 2 * least_samples(q) + SHORTEST:
        return None
    length = max(SHORTEST, -(-n // PARTS))
    edges = np.arange(last % length, last + 1, length)
    edges = edges[edges >= first + lags]
    inner = np.arange(1, len(edges) - 1)
    places = edges[inner]
    at = inner[(places - edges[0] >= least_samples(q)) & (last - places >= least_samples(q)) & (places >= earliest)]
    if not len(at):
        return None
    held = min(length, HELD_OF_PART)
    rows = np.array([rows_of(read(a - lags, a + held), lags) for a in edges[:-1].tolist()])
    found = _counted(edges, rows, p, at, tuple(range(q)))
    if lags == 0:
        return found
    if found.p_value > LEAST:
        plain = _counted(edges, rows, p, at, (0, *range(q - p, q)))
        found = plain if plain.p_value < found.p_value else found
    return replace(found, p_value=min(2 * found.p_value, 1.0))


def _counted(edges: Numbers, rows: Array, p: int, at: Numbers, kept: tuple[int, ...]) -> Scan:
    """Return the ratios of the columns `kept` of the rows, and the chance of the largest of them."""
    M, held, _ = rows.shape
    scale = _usual(held * np.concatenate([at, M - at, [M]]), len(kept), p)

    def scaled(sums: Array) -> Array:
        return np.asarray(_ratios(_of_columns(sums, kept), held, p, at) / scale)

    ratios = scaled(_squares(rows))
    exceeded = np.zeros(0, dtype=np.intp)
    for sums in _without_change(rows, p, int(at[np.argmax(ratios)])):
        reached = exceeded[-1] if len(exceeded) else 0
        exceeded = np.append(exceeded, reached + np.cumsum(scaled(sums).max(axis=-1) >= ratios.max()))
        if exceeded[-1] >= CLEAR:
            return Scan(edges, rows, p, kept, at, ratios, CLEAR / (int(np.argmax(exceeded == CLEAR)) + 1))
    return Scan(edges, rows, p, kept, at, ratios, float(exceeded[-1] + 1) / (DRAWS + 1))


def changed_outputs(found: Scan) -> Array:
    """Return for each output alone the chance (p,) of so large a ratio at the best edge without a change."""
    p, held = found.p, found.rows.shape[1]
    at = np.array([found.best])
    own = [tuple(c for c in found.kept if c == 0 or (c - 1) % p == j) for j in range(p)]

    def alone(sums: Array) -> Array:
        return np.concatenate([_ratios(_of_columns(sums, kept), held, 1, at) for kept in own], axis=-1)

    seen = alone(_squares(found.rows))
    exceeded = sum(((alone(sums) >= seen).sum(axis=0) for sums in _without_change(found.rows, p, found.best)), np.zeros(p))
    return np.asarray((exceeded + 1) / (DRAWS + 1))


def located(read: Reader, found: Scan, earliest: int, confidence: float) -> tuple[int, tuple[int, int]]:
    """Return the first sample after the change, and (first, last) of the samples that it may be with this confidence."""
    p, q, lags = found.p, len(found.kept), found.lags
    begin, last = int(found.edges[0]), int(found.edges[-1])
    reach = -2 * np.log(1 - np.sqrt(confidence))
    lowest, highest = max(begin + least_samples(q), earliest), last - least_samples(q)
    # The step is that of the edges at first; each round looks FINE times closer at what is left.
    places, gap = found.edges[found.open], int(found.edges[1] - found.edges[0])
    while True:
        ends = [begin, *places.tolist(), last]
        ratios = _ratios(_sums(read, lags, ends), np.diff(ends), p, np.arange(1, len(ends) - 1))
        kept = places[ratios >= ratios.max() - reach]
        if gap == 1 or -(-(kept[-1] - kept[0] + 4 * gap) // FINE) >= gap:
            break
        # The largest may lie between two places, and beyond a neighbour where one side falls off at once.
        low, high = max(int(kept[0]) - 2 * gap, lowest), min(int(kept[-1]) + 2 * gap, highest)
        gap = -(-(high - low + 1) // FINE)
        places = np.append(np.arange(low, high, gap), high)
    best = int(places[np.argmax(ratios)])
    return best, (max(int(kept[0]) - gap + 1 - lags, lowest), min(int(kept[-1]) + gap - 1, highest))


def _squares(rows: Array) -> Array:
    """Return the sums of z z' (..., q, q) over the rows z (..., L, q) of each part."""
    return np.asarray(np.swapaxes(rows, -1, -2) @ rows)


def _of_columns(sums: Array, kept: Sequence[int]) -> Array:
    """Return the sums (..., q, q) of these columns of the rows alone."""
    return np.asarray(sums[..., np.array(kept)[:, None], np.array(kept)])


def _without_change(rows: Array, p: int, edge: int) -> Iterator[Array]:
    """Yield the sums (any, M, q, q) of DRAWS records like the rows (M, L, q) that have no change, some at a time: one autoregression,
    driven by the innovations of both sides of the edge, the parts of which are put in another order."""
    M, L, q = rows.shape
    lags = (q - 1) // p - 1
    slopes, innovations = _innovations(rows, p, edge)
    process = _autoregression(slopes, p)
    from_errors, from_past = lower_toeplitz(process.markov(STRETCH)), observability_matrix(process.A, process.C, STRETCH)
    draw = np.random.default_rng(SEED)
    batch, few = max(NUMBERS // (M * L * p), 1), max(NUMBERS_OF_ROWS // (M * L * q), 1)
    done = 0
    while done < DRAWS:
        # A few at first, which are enough where nothing has changed.
        count = min(batch, DRAWS - done, max(2 * CLEAR, done))
        done += count
        orders = np.array([draw.permutation(M) for _ in range(count)])
        driven = innovations[orders].reshape(count, M * L, p)
        record = np.zeros((count, lags + M * L, p))
        for k in range(0, M * L, STRETCH):
            errors = driven[:, k : k + STRETCH].reshape(count, -1)
            past = record[:, k : k + lags][:, ::-1].reshape(count, lags * p)
            size = errors.shape[1]
            forced = errors @ from_errors[:size, :size].T + past @ from_past[:size].T
            record[:, lags + k : lags + k + STRETCH] = forced.reshape(count, -1, p)
        for some in np.split(record, range(few, count, few)):
            lagged = (some[:, lags - i : lags - i + M * L] for i in range(1, lags + 1))
            z = np.concatenate([np.ones((len(some), M * L, 1)), *lagged, some[:, lags:]], axis=2)
            yield _squares(z.reshape(len(some), M, L, q))


def _autoregression(slopes: Array, p: int) -> StateSpaceModel:
    """Return the process from innovations to outputs, whose state has the last outputs, the latest first, and begins with zero."""
    lags = len(slopes) // p
    A, B = np.eye(lags * p, k=-p), np.eye(lags * p, p)
    A[:p] = slopes.T[: len(A)]
    return StateSpaceModel(A, B, slopes.T, np.eye(p))


def _innovations(rows: Array, p: int, edge: int) -> tuple[Array, Array]:
    """Return coefficients (p lags, p) that both sides of the best split near the edge share, and the innovations (M, L, p) about the means
    of their side. There are none (zero) where regressors reach over the split."""
    M, L, q = rows.shape
    flat, split = rows.reshape(M * L, q), _best_split(rows, p, edge)
    m, lags = q - 1 - p, (q - 1) // p - 1
    places = [np.arange(split), np.arange(min(split + lags, M * L - least_samples(q)), M * L)]
    sides = [flat[place, 1:] - flat[place, 1:].mean(axis=0) for place in places]
    squares = sides[0].T @ sides[0] + sides[1].T @ sides[1]
    slopes = np.linalg.solve(squares[:m, :m] + FLOOR**2 * M * L * np.eye(m), squares[:m, m:])
    slopes *= _tamed(slopes, p, M * L)
    found = np.zeros((M * L, p))
    for place, side in zip(places, sides, strict=True):
        found[place] = side[:, m:] - side[:, :m] @ slopes
    return slopes, found.reshape(M, L, p)


def _best_split(rows: Array, p: int, edge: int) -> int:
    """Return the number of the row at which the ratio is largest, out of those of the parts beside the edge."""
    M, L, q = rows.shape
    flat, squares = rows.reshape(M * L, q), _squares(rows)
    low, high = max((edge - 1) * L, least_samples(q)), min((edge + 1) * L, M * L - least_samples(q))
    inner = flat[low:high, :, None] * flat[low:high, None, :]
    before = flat[:low].T @ flat[:low]
    sums = np.concatenate([before[None], inner, (squares.sum(axis=0) - before - inner.sum(axis=0))[None]])
    counts = np.array([low, *[1] * (high - low), M * L - high])
    return int(low + np.argmax(_ratios(sums, counts, p, np.arange(1, len(sums)))))


def _tamed(slopes: Array, p: int, samples: int) -> Array:
    """Return factors (p lags, 1) of the coefficients (p lags, p) that bring a root on or beyond the unit circle within it."""
    lags = len(slopes) // p
    if not lags:
        return np.ones((0, 1))
    radius = float(np.max(np.abs(companion_roots(slopes.T))))
    most = 1 - 1 / samples
    return np.repeat((most / max(radius, most)) ** np.arange(1, lags + 1), p)[:, None]


def _of_sides(parts: Array) -> Array:
    """Return whole - before - after for numbers of the parts before, those after and the whole."""
    half = len(parts) // 2
    return np.asarray(parts[-1] - parts[:half] - parts[half:-1])


def _usual(counts: Numbers, q: int, p: int) -> Array:
    """Return what L is divided by: its mean for Gaussian data without a change over the degrees of freedom."""
    freedom = counts[:, None] - (q - p) - np.arange(p)
    usual = digamma(freedom / 2).sum(axis=-1) + p * np.log(2) - p * np.log(counts)
    return _of_sides(counts * usual) / (p * (q - p) + p * (p + 1) / 2)


def _lifted(sums: Array, counts: Numbers) -> Array:
    """Return sums of z z' (..., q, q) of so many samples with the floor added to all but the constant."""
    lift = np.full(sums.shape[-1], FLOOR**2)
    lift[0] = 0.0
    return np.asarray(sums + np.asarray(counts)[..., None, None] * np.diag(lift))


def _log_spread(sums: Array, counts: Numbers, p: int) -> Array:
    """Return log|S| of the innovations for sums of z z' (..., q, q) of so many samples each."""
    sizes = np.diagonal(np.linalg.cholesky(_lifted(sums, counts)), axis1=-2, axis2=-1)[..., sums.shape[-1] - p :]
    return np.asarray(2 * np.log(sizes).sum(axis=-1) - p * np.log(counts))


def _ratios(sums: Array, count: int | Numbers, p: int, at: Numbers) -> Array:
    """Return L (..., len(at)) at the edges `at` for the sums (..., M, q, q) of parts of so many samples, one number or (M,)."""
    M = sums.shape[-3]
    counts = np.broadcast_to(count, M)
    # Both from their own end: what is small on one side is not the difference of what is large.
    before = np.cumsum(sums, axis=-3)[..., at - 1, :, :]
    after = np.cumsum(sums[..., ::-1, :, :], axis=-3)[..., M - at - 1, :, :]
    n, n_1 = int(counts.sum()), np.cumsum(counts)[at - 1]
    whole = _log_spread(sums.sum(axis=-3), np.asarray(n), p)[..., None]
    return np.asarray(n * whole - n_1 * _log_spread(before, n_1, p) - (n - n_1) * _log_spread(after, n - n_1, p))


def _sums(read: Reader, lags: int, edges: Sequence[int] | Numbers) -> Array:
    """Return the sums (len(edges) - 1, q, q) of z z' between the edges, reading PIECE samples at a time."""

    def pieces(start: int, stop: int) -> Iterator[Array]:
        for a in range(start, stop, PIECE):
            z = rows_of(read(a - lags, min(a + PIECE, stop)), lags)
            yield z.T @ z

    begin, end = int(edges[0]), int(edges[-1])
    if end - begin > PIECE:
        # The ends are long where what lies between is looked at closely.
        inner = _sums(read, lags, edges[1:-1]) if len(edges) > 3 and int(edges[-2]) - int(edges[1]) <= PIECE else None
        if inner is not None:
            return np.concatenate([[sum(pieces(begin, int(edges[1])))], inner, [sum(pieces(int(edges[-2]), end))]])
        return np.array([sum(pieces(int(a), int(b))) for a, b in pairwise(edges)])
    z = rows_of(read(begin - lags, end), lags)
    places = np.asarray(edges) - begin
    return np.array([z[a:b].T @ z[a:b] for a, b in pairwise(places)])
