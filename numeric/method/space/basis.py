"""This fits a whole kernel basis by maximum likelihood: the k = p - n_v polynomial rows N(q) that annihilate r up to noise, at once.

r = s + w with N(q) s = 0 whatever the faults are [W91], w of spectrum phi in every channel. Eliminating s leaves

    cost(N) = sum over frequencies of tr[(N N*)^-1 N r r* N*] / phi

which depends on the rows through the space they span alone, and for one row is |N r|^2 / (phi N N*). The colour phi is
estimated in turns with N, as an autoregression of the whitened row residual scaled to a mean logarithm of zero. Where the noise has
the power lam_c phi in channel c, N N* reads N diag(lam) N*: a channel measured without noise, as a known input, has lam_c = 0.

    degrees        eta_1 .. eta_k, the degree of each row
    within         for each row, the vectors that its coefficients may combine: P with P O_(eta+1) = 0
    shares         lam (p,), the power of the noise in each channel, relative to phi
    h              what is sought: the coefficients of every row in its `within`, one after the other
    gauge          changes of h that leave the span alone: adding q^a N_j to N_i for a <= eta_i - eta_j
    KernelBasis    the rows, their level, the noise colour, and the covariance of h off the gauge
    level          log noise power a sample and row that N leaves, in nats
    information    second derivatives of the cost; `scores` the variance of its slope: noise enters the slope with the
                   noisy window, not with the clean one, so that the covariance is H^-1 J H^-1 and not H^-1 [W82]
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from ....base.arrays import Array
from .tapered_moments import CrossMoments

ComplexArray = NDArray[np.complex128]

NOISE_ORDER = 10
ROUNDS = 12
# Nats a sample: a descent that gains less is at its end.
FLAT = 1e-6
# Nats of the whole record: a round of colours that gains less is the last one. A likelihood ratio of ten, where degrees are refused, does
# not move by more than a fiftieth then, however long the record.
SETTLED = 0.1
# And of a descent that is only compared with others, and goes on where it is the best.
ROUGH = 1e-3
STEPS = 80
# Least noise spectrum beside its geometric mean: below it a null of the noise would claim all the weight.
COLOUR_FLOOR = 1e-4
TINY = float(np.finfo(float).tiny)


@dataclass(frozen=True)
class KernelBasis:
    """The rows of a kernel basis, how much noise they leave, and how sure they are.

    `rows` are k arrays (eta_i + 1, p) of unit norm with N_i(q) = sum_j rows[i][j] q^j, `level` is in nats, `noise_colour` is the monic
    autoregression of the noise, `spectrum` (bands,) is the phi that follows from it, of mean logarithm zero, `within` is as it was given,
    and `covariance` is that of h, which is zero along the gauge; it is made when it is first asked for.
    """

    rows: tuple[Array, ...]
    level: float
    noise_colour: Array
    spectrum: Array
    within: tuple[Array, ...]
    made: Callable[[], Array] = field(repr=False, compare=False)

    @cached_property
    def covariance(self) -> Array:
        """Return the covariance of h."""
        return self.made()


def kernel_basis(
    moments: CrossMoments,
    within: Sequence[Array],
    starts: Sequence[Sequence[Array]] = (),
    *,
    rounds: int = ROUNDS,
    shares: Array | None = None,
    flat: float = FLAT,
) -> KernelBasis:
    """Find the likeliest basis; row i combines the orthonormal rows of within[i] (q_i, p (eta_i + 1)).

    `starts`: bases, each k arrays (eta_i + 1, p), tried beside the rows that the moments make least. `shares` (p,): the power of the noise
    in each channel, relative to the colour; equal ones where it is None. `flat`: nats that the last step of a descent gains.
    """
    problem = _problem(moments, within, shares)
    starting = [_coefficients(within, start) for start in starts]
    return _likeliest(moments, problem, within, starting + _plain(problem, within), rounds, flat)


def refined_basis(
    moments: CrossMoments,
    within: Sequence[Array],
    start: Sequence[Array],
    *,
    rounds: int = ROUNDS,
    shares: Array | None = None,
    flat: float = FLAT,
) -> KernelBasis:
    """Find the same from one start alone, k arrays (eta_i + 1, p): for moments, or shares, that differ little from those it was fitted
    to."""
    problem = _problem(moments, within, shares)
    return _likeliest(moments, problem, within, [_coefficients(within, start)], rounds, flat)


def _coefficients(within: Sequence[Array], rows: Sequence[Array]) -> Array:
    """Return the h of rows (eta_i + 1, p)."""
    return np.concatenate([basis @ row.ravel() for basis, row in zip(within, rows, strict=True)])


def _likeliest(
    moments: CrossMoments, problem: _Problem, within: Sequence[Array], guesses: list[Array], rounds: int, flat: float
) -> KernelBasis:
    """Return the best descent of all guesses with a white colour, then colour and rows in turns."""
    colour = np.ones(len(moments.angles))
    first = max(ROUGH, flat) if rounds else flat
    ends = [_descend(problem, colour, _normed(problem, h), first) for h in guesses]
    end = min(ends, key=lambda end: max(end.cost(colour), _rounding(problem, colour, end)))
    regression = np.ones(1)
    before = np.inf
    for _ in range(rounds):
        regression = _autoregression(end.power / problem.weights, moments.angles, problem.weights)
        colour = _colour(regression, moments.angles, problem.weights)
        end = _descend(problem, colour, end.h, flat)
        now = np.log(max(end.cost(colour), TINY))
        if abs(before - now) * moments.samples < SETTLED:
            break
        before = now
    h, power = end.h, max(end.cost(colour) / len(within), TINY)
    level = float(np.log(power) + np.log(problem.size))
    rows = tuple((part @ basis).reshape(-1, moments.channels) for part, basis in zip(np.split(h, problem.cuts), within, strict=True))
    return KernelBasis(rows, level, regression, colour, tuple(within), lambda: _covariance(problem, colour, h, power, moments.samples))


@dataclass(frozen=True)
class _Problem:
    """This holds the moments in units of their mean (bands, w, w), the powers of the angles (bands, degree + 1), the shares (p,), and the
    map `spread` (q, k, w) from h to rows padded to the same degree."""

    data: ComplexArray
    powers: ComplexArray
    shares: Array
    weights: Array
    spread: Array
    cuts: Array
    degrees: tuple[int, ...]
    channels: int
    size: float

    def rows(self, h: Array) -> Array:
        """Return the rows (k, w) that h stands for."""
        return np.asarray(np.tensordot(h, self.spread, axes=1))

    @cached_property
    def flat(self) -> Array:
        """The map `spread` as a matrix (q, k w)."""
        return self.spread.reshape(len(self.spread), -1)

    @cached_property
    def parts(self) -> Array:
        """The real parts of the moments and their imaginary parts, (2, bands, w, w): products with real rows need half the work."""
        return np.stack([self.data.real, self.data.imag])

    @cached_property
    def traces(self) -> Array:
        """The power (bands,) of the windows."""
        return np.asarray(np.einsum("bii->b", self.data).real)

    def noise(self, factors: ComplexArray | Array) -> ComplexArray:
        """Return the sum (.., w, w) over bands of factors (bands, ..) times the second moments of white noise, whose entries depend on the
        difference of their lags alone."""
        lags = len(self.powers[0])
        ahead = np.tensordot(factors, self.powers, axes=(0, 0))
        back = np.tensordot(factors, self.powers.conj(), axes=(0, 0))
        shifts = np.concatenate([back[..., :0:-1], ahead], axis=-1)
        steps = shifts[..., np.subtract.outer(np.arange(lags), np.arange(lags)) + lags - 1]
        width = lags * self.channels
        return np.asarray((steps[..., :, None, :, None] * np.diag(self.shares)[:, None, :]).reshape(*factors.shape[1:], width, width))


def _problem(moments: CrossMoments, within: Sequence[Array], shares: Array | None = None) -> _Problem:
    p, width = moments.channels, moments.channels * (moments.degree + 1)
    powers = np.exp(1j * np.outer(moments.angles, np.arange(moments.degree + 1)))
    size = float(np.trace(moments.moments.sum(axis=0)).real) / width or 1.0
    counts = [len(basis) for basis in within]
    spread = np.zeros((sum(counts), len(within), width))
    cuts = np.cumsum(counts)
    for i, basis in enumerate(within):
        spread[cuts[i] - counts[i] : cuts[i], i, : basis.shape[1]] = basis
    degrees = tuple(basis.shape[1] // p - 1 for basis in within)
    lam = np.ones(p) if shares is None else np.asarray(shares, dtype=np.float64)
    return _Problem(moments.moments / size, powers, lam, moments.weights, spread, cuts[:-1], degrees, p, size)


def _plain(problem: _Problem, within: Sequence[Array]) -> list[Array]:
    """Return the left singular vectors of least value of P R: two choices for one row, one for several."""
    power = problem.data.sum(axis=0).real
    taken: dict[int, int] = {}
    parts, seconds = [], []
    for basis, degree in zip(within, problem.degrees, strict=True):
        size = basis.shape[1]
        vectors = np.linalg.eigh(basis @ power[:size, :size] @ basis.T)[1]
        # A row of higher degree begins after the shifts of those of lower degree, which are as small.
        index = taken.setdefault(degree, sum(max(degree - other + 1, 0) for other in problem.degrees if other < degree))
        parts.append(vectors[:, min(index, vectors.shape[1] - 1)])
        seconds.append(vectors[:, min(index + 1, vectors.shape[1] - 1)])
        taken[degree] += 1
    return [np.concatenate(parts)] + ([np.concatenate(seconds)] if len(within) == 1 else [])


def _normed(problem: _Problem, h: Array) -> Array:
    """Return h with rows of unit norm, those of one degree orthonormal: the span stays the same."""
    parts = np.split(h, problem.cuts)
    for degree in set(problem.degrees):
        chosen = [i for i, other in enumerate(problem.degrees) if other == degree]
        block = np.linalg.qr(np.column_stack([parts[i] for i in chosen]))[0]
        for column, i in enumerate(chosen):
            parts[i] = block[:, column]
    return np.concatenate(parts)


@dataclass(frozen=True)
class _Point:
    """What the rows N of an h make of the moments S and of white noise Q: X = S N', Y = Q N' (bands, w, k), E = N X and
    W = (N Y)^-1 (bands, k, k), and tr[W E] a row in each band, `power` (bands,)."""

    h: Array
    X: ComplexArray | Array
    Y: ComplexArray
    E: ComplexArray | Array
    W: ComplexArray
    power: Array

    def cost(self, colour: Array) -> float:
        """Return the cost under this colour (bands,)."""
        return float(np.sum(self.power / colour) * self.E.shape[1])


def _point(problem: _Problem, h: Array) -> _Point:
    N = problem.rows(h)
    k, lags = len(N), len(problem.powers[0])
    bands, width = problem.data.shape[:2]
    # Of a single row N S N' is that of the real part of S, and the imaginary one is asked by the derivatives alone.
    parts = problem.parts if k > 1 else problem.parts[:1]
    products = (parts.reshape(-1, width) @ N.T).reshape(-1, width, k)
    X = _complex(products) if k > 1 else products
    gains = (problem.powers @ N.reshape(k, lags, -1).transpose(1, 0, 2).reshape(lags, -1)).reshape(bands, k, -1)
    weighted = gains.conj() * problem.shares
    Y = (problem.powers[:, :, None, None] * weighted.transpose(0, 2, 1)[:, None]).reshape(bands, width, k)
    E = N @ X
    W = np.linalg.inv(gains @ weighted.transpose(0, 2, 1) + 1e-12 * np.eye(k))
    power = np.maximum((W * E.transpose(0, 2, 1)).real.sum(axis=(1, 2)), 0.0) / k
    return _Point(h, X, Y, E, np.asarray(W, dtype=complex), power)


def _cost(problem: _Problem, colour: Array, h: Array) -> float:
    return _point(problem, h).cost(colour)


def _rounding(problem: _Problem, colour: Array, at: _Point) -> float:
    """Return how wrong rounding may make the cost: each N S N', a sum of w terms, by w eps |S| |N|^2, weighted as the cost is."""
    sizes = problem.traces * np.einsum("bii->b", at.W).real
    return float(problem.data.shape[1] * np.finfo(float).eps * np.sum(sizes / colour))


def _derivatives(problem: _Problem, colour: Array, at: _Point) -> tuple[Array, Array, Array]:
    """Return half the gradient of the cost, half its second derivatives, and the part of these that the scores' variance is made of."""
    X, Y, E, W = at.X, at.Y, at.E, at.W
    if len(problem.degrees) == 1:
        row = problem.rows(at.h)[0]
        whole = _complex(np.concatenate([X[:, :, 0], (problem.parts[1].reshape(-1, len(row)) @ row).reshape(len(X), -1)]))
        return _derivatives_of_one(problem, colour, whole, Y[:, :, 0], E[:, 0, 0].real, W[:, 0, 0].real)
    bleach = 1 / colour[:, None, None]
    XW, YW = (X * bleach) @ W, Y @ W
    M = W @ (E * bleach) @ W
    YM, Yh = Y @ M, Y.conj().transpose(0, 2, 1)
    # -X W Y' - Y W X' + Y M Y' as two products: half of the last joins each of the first.
    half = (YM / 2 - XW) @ Yh
    # Indices (row, coefficient) of both factors of every product of two matrices, one (row, row), one (w, w).
    WB = W * bleach
    scores = np.tensordot(np.concatenate([WB.real, -WB.imag]), problem.parts.reshape(-1, *problem.data.shape[1:]), axes=(0, 0))
    scores = scores + np.tensordot(W, half + half.conj().transpose(0, 2, 1), axes=(0, 0)).real
    second = scores + np.tensordot(M, YW @ Yh, axes=(0, 0)).real - problem.noise(M).real
    scores, second = scores.transpose(1, 2, 0, 3), second.transpose(1, 2, 0, 3)
    # The others bind each row of one factor to the coefficients of the other.
    mixed = np.tensordot(YW, YM - XW, axes=(0, 0)).real
    second = second + mixed.transpose(3, 0, 1, 2) + mixed.transpose(1, 2, 3, 0)
    spread = problem.flat
    gradient = spread @ (XW - YM).sum(axis=0).real.T.ravel()
    width = spread.shape[1]
    second = spread @ second.reshape(width, width) @ spread.T
    return gradient, (second + second.T) / 2, spread @ scores.reshape(width, width) @ spread.T


def _derivatives_of_one(
    problem: _Problem, colour: Array, X: ComplexArray, Y: ComplexArray, E: Array, W: Array
) -> tuple[Array, Array, Array]:
    """Return the same of a single row, whose W and E are numbers: sums over bands are products of matrices, with no band held by itself."""
    weight = W / colour
    left = (Y.T * (W**2 * E / colour / 2) - X.T * weight) * W
    crossed = _real_product(left, Y.conj())
    scores = np.tensordot(weight, problem.parts[0], axes=1) + crossed + crossed.T
    power = W**2 * E / colour
    change = Y.T * power - X.T * weight
    mixed = _real_product(Y.T * W, change.T)
    second = scores + _real_product(Y.T * (power * W), Y.conj()) - problem.noise(power).real
    second = second + mixed + mixed.T
    spread = problem.spread[:, 0]
    gradient = -spread @ change.sum(axis=1).real
    second = spread @ second @ spread.T
    return gradient, (second + second.T) / 2, spread @ scores @ spread.T


def _complex(parts: Array) -> ComplexArray:
    """Return complex numbers of which the first half of the rows are the real parts and the second the imaginary ones."""
    real, imaginary = np.split(parts, 2)
    found = np.empty(real.shape, dtype=np.complex128)
    found.real, found.imag = real, imaginary
    return found


def _real_product(A: ComplexArray, B: ComplexArray) -> Array:
    """Return the real part of A B."""
    return np.asarray(A.real @ B.real - A.imag @ B.imag)


def _gauge(problem: _Problem, h: Array) -> Array:
    """Return the changes (gauge, q) of h that leave the span as it is."""
    N = problem.rows(h)
    p = problem.channels
    shifts = []
    for i, degree in enumerate(problem.degrees):
        for j, other in enumerate(problem.degrees):
            for a in range(degree - other + 1):
                shifted = np.zeros_like(N)
                shifted[i, a * p :] = N[j, : N.shape[1] - a * p]
                shifts.append(shifted.ravel())
    return np.asarray(np.array(shifts) @ problem.flat.T)


def _descend(problem: _Problem, colour: Array, h: Array, flat: float) -> _Point:
    """Descend by Levenberg and Marquardt off the gauge, along which the curvature is made as large as it is on average, until a step gains
    less than `flat` nats. The cost never rises, and what is left of it at the level of rounding, as without noise, is not descended: steps
    would follow rounding there and turn h by its root."""
    at = _point(problem, h)
    damping, cost = 1e-3, at.cost(colour)
    for _ in range(STEPS):
        if cost <= _rounding(problem, colour, at):
            break
        gradient, second, scores = _derivatives(problem, colour, at)
        ridge = np.maximum(np.diag(scores), TINY)
        gauge = _gauge(problem, at.h)
        if len(gauge) >= len(at.h):
            break
        fixed = float(ridge.mean()) * gauge.T @ gauge
        second, scores = second + fixed, scores + fixed
        new = np.inf
        while damping < 1e10:
            # An indefinite matrix would climb; that of the scores, whose part of the curvature is never negative, leads past saddles.
            factor, failed = scipy.linalg.lapack.dpotrf(second + damping * np.diag(ridge), lower=1)
            if failed:
                factor, failed = scipy.linalg.lapack.dpotrf(scores + damping * np.diag(ridge), lower=1)
            if not failed:
                step = scipy.linalg.lapack.dpotrs(factor, gradient, lower=1)[0]
                try:
                    trial = _point(problem, _normed(problem, at.h - step))
                    new = trial.cost(colour)
                except np.linalg.LinAlgError:
                    new = np.inf
            if new < cost:
                break
            damping *= 8.0
        if not new < cost:
            break
        drop = np.log(cost / max(new, TINY))
        at, cost, damping = trial, new, max(damping / 8.0, 1e-12)
        if drop < flat:
            break
    return at


def _covariance(problem: _Problem, colour: Array, h: Array, power: float, samples: float) -> Array:
    """Return the covariance of h off the gauge, H^-1 J H^-1 with J = power / samples times the scores, these weighted by the noise that the
    bands hold in fact: what the autoregression misses widens the answer."""
    free = scipy.linalg.null_space(_gauge(problem, h), rcond=1e-10)
    if free.shape[1] == 0:
        return np.zeros((len(h), len(h)))
    at = _point(problem, h)
    second = _derivatives(problem, colour, at)[1]
    # The scores are proportional to 1 / colour, band by band.
    found = np.maximum(at.power / (power * problem.weights * colour), COLOUR_FLOOR)
    scores = _derivatives(problem, colour / found, at)[2]
    second, scores = free.T @ second @ free, free.T @ scores @ free
    inverse = np.asarray(scipy.linalg.pinvh(second))
    return np.asarray(free @ inverse @ scores @ inverse @ free.T) * power / samples


def colour_of(spectrum: Array, angles: Array, weights: Array) -> Array:
    """Return the spectrum (bands,), of mean logarithm zero, of the autoregression that fits a spectrum (bands,) best."""
    return _colour(_autoregression(spectrum, angles, weights), angles, weights)


def _autoregression(spectrum: Array, angles: Array, weights: Array) -> Array:
    """Return the monic Yule-Walker autoregression of a spectrum sampled at the angles."""
    lags = np.cos(np.outer(np.arange(NOISE_ORDER + 1), angles)) @ (spectrum * weights)
    if not lags[0] > 0.0:
        return np.asarray(np.eye(1, NOISE_ORDER + 1)[0], dtype=np.float64)
    column = lags[:-1] + 1e-9 * lags[0] * (np.arange(NOISE_ORDER) == 0)
    return np.concatenate([[1.0], -scipy.linalg.solve_toeplitz(column, lags[1:])])


def _colour(regression: Array, angles: Array, weights: Array) -> Array:
    """Return the spectrum of the autoregression, of mean logarithm zero and not below the floor."""
    colour = 1.0 / np.abs(np.exp(-1j * np.outer(angles, np.arange(len(regression)))) @ regression) ** 2
    colour /= np.exp(np.log(colour) @ weights)
    colour = np.maximum(colour, COLOUR_FLOOR)
    return np.asarray(colour / np.exp(np.log(colour) @ weights))
