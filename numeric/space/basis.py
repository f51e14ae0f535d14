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

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from ...base.arrays import Array
from .tapered_moments import CrossMoments

ComplexArray = NDArray[np.complex128]

NOISE_ORDER = 10
ROUNDS = 12
# Nats a sample: a descent that gains less is at its end; a round of colours that gains less is the last one.
FLAT, SETTLED = 1e-6, 1e-4
STEPS = 80
# Least noise spectrum beside its geometric mean: below it a null of the noise would claim all the weight.
COLOUR_FLOOR = 1e-4
TINY = float(np.finfo(float).tiny)


@dataclass(frozen=True)
class KernelBasis:
    """These are the rows of a kernel basis, how much noise they leave, and how sure they are.

    `rows` are k arrays (eta_i + 1, p) of unit norm with N_i(q) = sum_j rows[i][j] q^j, `level` is in nats, `noise_colour` is the monic
    autoregression of the noise, `spectrum` (bands,) is the phi that follows from it, of mean logarithm zero, `within` is as it was given,
    and `covariance` is that of h, which is zero along the gauge.
    """

    rows: tuple[Array, ...]
    level: float
    noise_colour: Array
    spectrum: Array
    within: tuple[Array, ...]
    covariance: Array


def kernel_basis(
    moments: CrossMoments,
    within: Sequence[Array],
    starts: Sequence[Sequence[Array]] = (),
    *,
    noise_order: int = NOISE_ORDER,
    rounds: int = ROUNDS,
    shares: Array | None = None,
) -> KernelBasis:
    """Find the likeliest basis; row i combines the orthonormal rows of within[i] (q_i, p (eta_i + 1)).

    `starts`: bases, each k arrays (eta_i + 1, p), tried beside the rows that the moments make least. `shares` (p,): the power of the noise
    in each channel, relative to the colour; equal ones where it is None.
    """
    problem = _problem(moments, within, shares)
    starting = [_coefficients(within, start) for start in starts]
    return _likeliest(moments, problem, within, starting + _plain(problem, within), noise_order, rounds)


def refined_basis(
    moments: CrossMoments,
    within: Sequence[Array],
    start: Sequence[Array],
    *,
    noise_order: int = NOISE_ORDER,
    rounds: int = ROUNDS,
    shares: Array | None = None,
) -> KernelBasis:
    """Find the same from one start alone, k arrays (eta_i + 1, p): for moments, or shares, that differ little from those it was fitted
    to."""
    problem = _problem(moments, within, shares)
    return _likeliest(moments, problem, within, [_coefficients(within, start)], noise_order, rounds)


def _coefficients(within: Sequence[Array], rows: Sequence[Array]) -> Array:
    """Return the h of rows (eta_i + 1, p)."""
    return np.concatenate([basis @ row.ravel() for basis, row in zip(within, rows, strict=True)])


def _likeliest(
    moments: CrossMoments, problem: _Problem, within: Sequence[Array], guesses: list[Array], noise_order: int, rounds: int
) -> KernelBasis:
    """Return the best descent of all guesses with a white colour, then colour and rows in turns."""
    colour = np.ones(len(moments.angles))
    fits = [_descend(problem, colour, _normed(problem, h)) for h in guesses]
    h, cost = min(fits, key=lambda fit: max(fit[1], _rounding(problem, colour, fit[0])))
    regression = np.ones(1)
    before = np.inf
    for _ in range(rounds if noise_order else 0):
        spectrum = _whitened_power(problem, h) / problem.weights
        regression = _autoregression(spectrum, moments.angles, problem.weights, noise_order)
        colour = _colour(regression, moments.angles, problem.weights)
        h, cost = _descend(problem, colour, h)
        if abs(before - np.log(max(cost, TINY))) < SETTLED:
            break
        before = np.log(max(cost, TINY))
    k = len(within)
    level = float(np.log(max(cost / k, TINY)) + np.log(problem.size))
    rows = tuple((part @ basis).reshape(-1, moments.channels) for part, basis in zip(np.split(h, problem.cuts), within, strict=True))
    covariance = _covariance(problem, colour, h, max(cost / k, TINY), moments.samples)
    return KernelBasis(rows, level, regression, colour, tuple(within), covariance)


@dataclass(frozen=True)
class _Problem:
    """This holds the moments in units of their mean (bands, w, w), the gains of white noise alike, and the map `spread` (q, k, w) from h to
    rows padded to the same degree."""

    data: ComplexArray
    gains: ComplexArray
    weights: Array
    spread: Array
    cuts: Array
    degrees: tuple[int, ...]
    channels: int
    size: float

    def rows(self, h: Array) -> Array:
        """Return the rows (k, w) that h stands for."""
        return np.asarray(np.tensordot(h, self.spread, axes=1))


def _problem(moments: CrossMoments, within: Sequence[Array], shares: Array | None = None) -> _Problem:
    p, width = moments.channels, moments.channels * (moments.degree + 1)
    powers = np.exp(1j * np.outer(moments.angles, np.arange(moments.degree + 1)))
    gains = np.einsum("bi,bj,kl->bikjl", powers, powers.conj(), np.eye(p) if shares is None else np.diag(shares), optimize=True)
    size = float(np.trace(moments.moments.sum(axis=0)).real) / width or 1.0
    counts = [len(basis) for basis in within]
    spread = np.zeros((sum(counts), len(within), width))
    cuts = np.cumsum(counts)
    for i, basis in enumerate(within):
        spread[cuts[i] - counts[i] : cuts[i], i, : basis.shape[1]] = basis
    degrees = tuple(basis.shape[1] // p - 1 for basis in within)
    return _Problem(
        moments.moments / size,
        gains.reshape(len(powers), width, width),
        moments.weights,
        spread,
        cuts[:-1],
        degrees,
        p,
        size,
    )


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


def _parts(problem: _Problem, h: Array) -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
    """Return X = S N', Y = Q N' (bands, w, k), E = N X and W = (N Y)^-1 (bands, k, k) for the rows N."""
    N = problem.rows(h)
    X, Y = problem.data @ N.T, problem.gains @ N.T
    return X, Y, N @ X, np.asarray(np.linalg.inv(N @ Y + 1e-12 * np.eye(len(N))), dtype=complex)


def _whitened_power(problem: _Problem, h: Array) -> Array:
    """Return tr[(N N*)^-1 N r r* N*] a row, in each band: (bands,)."""
    _, _, E, W = _parts(problem, h)
    return np.asarray(np.maximum(np.einsum("bij,bji->b", W, E).real, 0.0) / len(problem.degrees))


def _cost(problem: _Problem, colour: Array, h: Array) -> float:
    return float(np.sum(_whitened_power(problem, h) / colour)) * len(problem.degrees)


def _rounding(problem: _Problem, colour: Array, h: Array) -> float:
    """Return how wrong rounding may make the cost: each N S N', a sum of w terms, by w eps |S| |N|^2, weighted as the cost is."""
    W = _parts(problem, h)[3]
    sizes = np.einsum("bii->b", problem.data).real * np.einsum("bii->b", W).real
    return float(problem.data.shape[1] * np.finfo(float).eps * np.sum(sizes / colour))


def _derivatives(problem: _Problem, colour: Array, h: Array) -> tuple[Array, Array, Array]:
    """Return half the gradient of the cost, half its second derivatives, and the part of these that the scores' variance is made of."""
    X, Y, E, W = _parts(problem, h)
    if len(problem.degrees) == 1:
        return _derivatives_of_one(problem, colour, X[:, :, 0], Y[:, :, 0], E[:, 0, 0].real, W[:, 0, 0].real)
    bleach = 1 / colour[:, None, None]
    XW, YW = (X * bleach) @ W, Y @ W
    M = W @ (E * bleach) @ W
    YM, Yh = Y @ M, Y.conj().transpose(0, 2, 1)
    crossed = XW @ Yh
    left = problem.data * bleach - crossed - crossed.conj().transpose(0, 2, 1) + YM @ Yh
    # Indices (row, coefficient) of both factors of every product of two matrices, one (row, row), one (w, w).
    scores = np.tensordot(W, left, axes=(0, 0)).real.transpose(1, 2, 0, 3)
    second = scores + np.tensordot(M, YW @ Yh - problem.gains, axes=(0, 0)).real.transpose(1, 2, 0, 3)
    # The others bind each row of one factor to the coefficients of the other.
    mixed = np.tensordot(YW, YM - XW, axes=(0, 0)).real
    second = second + mixed.transpose(3, 0, 1, 2) + mixed.transpose(1, 2, 3, 0)
    spread = problem.spread.reshape(len(h), -1)
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
    scores = np.tensordot(weight, problem.data.real, axes=1) + crossed + crossed.T
    power = W**2 * E / colour
    change = Y.T * power - X.T * weight
    mixed = _real_product(Y.T * W, change.T)
    second = scores + _real_product(Y.T * (power * W), Y.conj()) - np.tensordot(power, problem.gains.real, axes=1) + mixed + mixed.T
    spread = problem.spread[:, 0]
    gradient = -spread @ change.sum(axis=1).real
    second = spread @ second @ spread.T
    return gradient, (second + second.T) / 2, spread @ scores @ spread.T


def _real_product(A: ComplexArray, B: ComplexArray) -> Array:
    """Return the real part of A B."""
    return np.asarray(A.real @ B.real - A.imag @ B.imag)


def _free(problem: _Problem, h: Array) -> Array:
    """Return orthonormal columns (q, q - gauge): the changes of h that change the span."""
    N = problem.rows(h)
    p = problem.channels
    shifts = []
    for i, degree in enumerate(problem.degrees):
        for j, other in enumerate(problem.degrees):
            for a in range(degree - other + 1):
                shifted = np.zeros_like(N)
                shifted[i, a * p :] = N[j, : N.shape[1] - a * p]
                shifts.append(problem.spread.reshape(len(h), -1) @ shifted.ravel())
    return np.asarray(scipy.linalg.null_space(np.array(shifts), rcond=1e-10))


def _descend(problem: _Problem, colour: Array, h: Array) -> tuple[Array, float]:
    """Descend by Levenberg and Marquardt off the gauge. The cost never rises, and what is left of it at the level of rounding, as without
    noise, is not descended: steps would follow rounding there and turn h by its root."""
    damping, cost = 1e-3, _cost(problem, colour, h)
    for _ in range(STEPS):
        if cost <= _rounding(problem, colour, h):
            break
        gradient, second, scores = _derivatives(problem, colour, h)
        free = _free(problem, h)
        if free.shape[1] == 0:
            break
        gradient, second = free.T @ gradient, free.T @ second @ free
        ridge = np.maximum(np.einsum("ij,ji->i", free.T @ scores, free), TINY)
        new = np.inf
        while damping < 1e10:
            try:
                # An indefinite matrix would climb: more damping until it has a Cholesky factor.
                factor = scipy.linalg.cho_factor(second + damping * np.diag(ridge))
                trial = _normed(problem, h - free @ scipy.linalg.cho_solve(factor, gradient))
                new = _cost(problem, colour, trial)
            except np.linalg.LinAlgError:
                new = np.inf
            if new < cost:
                break
            damping *= 8.0
        if not new < cost:
            break
        drop = np.log(cost / max(new, TINY))
        h, cost, damping = trial, new, max(damping / 8.0, 1e-12)
        if drop < FLAT:
            break
    return h, cost


def _covariance(problem: _Problem, colour: Array, h: Array, power: float, samples: float) -> Array:
    """Return the covariance of h off the gauge, H^-1 J H^-1 with J = power / samples times the scores, these weighted by the noise that the
    bands hold in fact: what the autoregression misses widens the answer."""
    free = _free(problem, h)
    if free.shape[1] == 0:
        return np.zeros((len(h), len(h)))
    second = _derivatives(problem, colour, h)[1]
    # The scores are proportional to 1 / colour, band by band.
    found = np.maximum(_whitened_power(problem, h) / (power * problem.weights * colour), COLOUR_FLOOR)
    scores = _derivatives(problem, colour / found, h)[2]
    second, scores = free.T @ second @ free, free.T @ scores @ free
    inverse = np.asarray(scipy.linalg.pinvh(second))
    return np.asarray(free @ inverse @ scores @ inverse @ free.T) * power / samples


def colour_of(spectrum: Array, angles: Array, weights: Array, order: int = NOISE_ORDER) -> Array:
    """Return the spectrum (bands,), of mean logarithm zero, of the autoregression that fits a spectrum (bands,) best."""
    return _colour(_autoregression(spectrum, angles, weights, order), angles, weights)


def _autoregression(spectrum: Array, angles: Array, weights: Array, order: int) -> Array:
    """Return the monic Yule-Walker autoregression of a spectrum sampled at the angles."""
    lags = np.cos(np.outer(np.arange(order + 1), angles)) @ (spectrum * weights)
    if not lags[0] > 0.0:
        return np.asarray(np.eye(1, order + 1)[0], dtype=np.float64)
    column = lags[:-1] + 1e-9 * lags[0] * (np.arange(order) == 0)
    return np.concatenate([[1.0], -scipy.linalg.solve_toeplitz(column, lags[1:])])


def _colour(regression: Array, angles: Array, weights: Array) -> Array:
    """Return the spectrum of the autoregression, of mean logarithm zero and not below the floor."""
    colour = 1.0 / np.abs(np.exp(-1j * np.outer(angles, np.arange(len(regression)))) @ regression) ** 2
    colour /= np.exp(np.log(colour) @ weights)
    colour = np.maximum(colour, COLOUR_FLOOR)
    return np.asarray(colour / np.exp(np.log(colour) @ weights))
