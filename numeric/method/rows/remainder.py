"""Compute what kernel rows leave of [y; u], band by band: if they are laws of the system, it is noise alone, and of one shape.

With N w = N_y w the remainder of k rows has in every band the cross spectrum phi N_y diag(lam) N_y*. Hence the noise shares lam of the
channels can be estimated, and whether the remainder has that shape can be tested without knowing phi.

    Remainder     E (bands, k, k), the cross spectrum of N [y; u]; N_y (bands, k, p) at the middle of each band
    noise_shares  lam of maximum likelihood given the rows, by minorisation and maximisation, mean logarithm zero
    whitened      W^1/2 E W^(1/2)*, W = (N_y diag(lam) N_y*)^-1: phi I of a law
    unrelated     probability that nothing relates the signals of a remainder
    sphericity    likelihood ratio of "one colour, k equal rows" against "any cross spectrum" [M82], smooth over each band
    Sphericity    its value, degrees of freedom and level

This is the law of the ratio. In a band n_b complex normal samples of k equal rows have log det(W) - k log(tr(W)/k) with the moments of a
ratio of gamma functions, because the trace is independent of the shape: its mean is sum psi(n_b - j) - k psi(n_b k) + k log k and its
variance sum psi'(n_b - j) - k^2 psi'(n_b k), j = 0 .. k - 1. Over the bands -2 n_b times their sum is chi-squared in the limit, with
B (k^2 - 1) degrees of freedom; here it is a multiple of a chi-squared variable with the exact mean and variance, so that short records need
no limit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.special import digamma, polygamma

from ....base.arrays import Array
from ....base.chi_squared import chi_squared_tail
from ..space.basis import KernelBasis
from ..space.tapered_moments import CrossMoments
from .joint import JointMoments

ComplexArray = NDArray[np.complex128]

# Bands of the test: wide enough for the matrices to be estimated, narrow beside what the colour of a fault changes over.
TEST_BANDS = 16
# Complex samples of a band of the test for each row: with fewer the shape is hardly estimated.
SAMPLES = 4
SWEEPS = 40
# A channel's noise beside that of the loudest: below it the likelihood of few bands would call a channel exact.
LEAST_SHARE = 1e-4
TINY = float(np.finfo(float).tiny)


@dataclass(frozen=True, eq=False)
class Remainder:
    """`powers` (bands, k, k) are those per sample, `gains` (bands, k, p); `weights`, `angles` (bands,) and `samples` are of the moments."""

    powers: ComplexArray
    gains: ComplexArray
    weights: Array
    angles: Array
    samples: float


def as_signals(powers: ComplexArray, moments: CrossMoments) -> Remainder:
    """Return p signals of these spectra (bands, p, p) as what p rows leave, each of one output."""
    p = powers.shape[1]
    gains = np.broadcast_to(np.eye(p, dtype=complex), (len(powers), p, p))
    return Remainder(powers, gains, moments.weights, moments.angles, moments.samples)


def remainder(data: JointMoments, fit: KernelBasis) -> Remainder:
    """Compute what these rows leave."""
    channels, degree = data.moments.channels, max(map(len, fit.rows)) - 1
    moments = data.moments.of_degree(degree)
    N = np.array([np.pad(row, ((0, degree + 1 - len(row)), (0, 0))) for row in fit.rows])
    powers = np.exp(1j * np.outer(moments.angles, np.arange(degree + 1)))
    gains = np.einsum("bj,kjc->bkc", powers, N)[:, :, : data.p]
    flat = N.reshape(len(N), (degree + 1) * channels)
    E = flat @ moments.moments @ flat.T / moments.weights[:, None, None]
    return Remainder(np.asarray(E), np.asarray(gains, dtype=complex), moments.weights, moments.angles, moments.samples)


def loose_samples(rest: Remainder, data: JointMoments, fit: KernelBasis, shares: Array) -> float:
    """Return how many complex samples stand at frequencies where the faults leave more directions to the noise than there are rows: where
    they add less than the noise itself to the least power of the disturbance but that of the rows. `rest` is that of p signals."""
    count = len(fit.rows)
    if count >= len(shares):
        return 0.0
    powers = np.linalg.eigvalsh(rest.powers / np.sqrt(shares[:, None] * shares))
    noise = np.exp(fit.level) * np.interp(rest.angles, data.moments.angles, fit.spectrum)
    return float(rest.weights @ (powers[:, count] < 2 * noise)) * data.samples / 2


def noise_shares(rest: Remainder, start: Array) -> Array:
    """Estimate lam (p,), from `start`, for noise of any spectrum that changes little over a band of the test.

    A sweep multiplies lam_c by the root of seen over expected power, which never lowers the likelihood.
    """
    lam = start.copy()
    for _ in range(SWEEPS):
        shape = (rest.gains * lam) @ rest.gains.conj().transpose(0, 2, 1)
        inverse = np.linalg.pinv(shape, rcond=1e-10, hermitian=True)
        power = np.maximum(np.einsum("bij,bji->b", inverse, rest.powers).real, TINY)
        weighted = rest.gains.conj().transpose(0, 2, 1) @ inverse
        seen = np.einsum("bik,bkl,bil->bi", weighted, rest.powers, weighted.conj(), optimize=True).real
        expected = np.einsum("bik,bki->bi", weighted, rest.gains).real
        over, under = np.zeros(len(lam)), np.zeros(len(lam))
        for group in groups(rest):
            spectrum = rest.weights[group] @ power[group] / (rest.weights[group].sum() * shape.shape[1])
            over += rest.weights[group] @ seen[group] / spectrum
            under += rest.weights[group] @ expected[group]
        lam = lam * np.sqrt(np.maximum(over, TINY) / np.maximum(under, TINY))
        lam = np.maximum(lam, LEAST_SHARE * lam.max())
        lam = lam / np.exp(np.mean(np.log(lam)))
    return np.asarray(lam)


def groups(rest: Remainder, bands: int = TEST_BANDS) -> list[NDArray[np.int_]]:
    """Return the bands of the moments that each of so many `bands`, or fewer, joins: enough for SAMPLES samples a row."""
    most = int(rest.samples / (2 * SAMPLES * rest.powers.shape[1]))
    return np.array_split(np.arange(len(rest.weights)), max(1, min(bands, len(rest.weights), most)))


def whitened(rest: Remainder, shares: Array) -> ComplexArray:
    """Return the whitened remainder (bands, k, k), which is phi I where the rows are laws."""
    shape = (rest.gains * shares) @ rest.gains.conj().transpose(0, 2, 1)
    values, vectors = np.linalg.eigh(shape)
    root = vectors / np.sqrt(np.maximum(values, 1e-12 * values[:, -1:] + TINY))[:, None, :]
    return np.asarray(root.conj().transpose(0, 2, 1) @ rest.powers @ root)


def unrelated(rest: Remainder) -> float:
    """Return the probability of a likelihood ratio of "diagonal cross spectra" against "any" as large as that of these p >= 2 signals, if
    nothing relates them, whatever their colours.

    In one band n_b complex normal samples have log det(W) - sum log W_cc with the moments of a ratio of gamma functions: its mean is
    sum psi(n_b - j) - p psi(n_b), its variance sum psi'(n_b - j) - p psi'(n_b), j = 0 .. p - 1 [M82].
    """
    p = rest.powers.shape[1]
    mean, variance, ratio, j = 0.0, 0.0, 0.0, np.arange(p)
    for group in groups(rest):
        share = float(rest.weights[group].sum())
        count = max(rest.samples * share / 2, p + 1.0)
        # The colours may change within the band: each signal is whitened first.
        sizes = np.sqrt(np.maximum(np.einsum("bii->bi", rest.powers[group]).real, TINY))
        pooled = np.tensordot(rest.weights[group] / share, rest.powers[group] / (sizes[:, :, None] * sizes[:, None]), 1)
        ratio -= 2 * count * float(np.linalg.slogdet(pooled)[1] - np.log(np.diag(pooled).real).sum())
        mean += 2 * count * float(p * digamma(count) - np.sum(digamma(count - j)))
        variance += 4 * count**2 * float(np.sum(polygamma(1, count - j)) - p * polygamma(1, count))
    return chi_squared_tail(ratio / (variance / (2 * mean)), 2 * mean**2 / variance)


@dataclass(frozen=True)
class Sphericity:
    """The remainder is less spherical than it could be by `nats` for each row and sample, where a law has `expected` in the mean.

    `ratio` is the likelihood ratio, and `level` is the probability of a larger one under a law.
    """

    nats: float
    expected: float
    ratio: float
    level: float


def sphericity(rest: Remainder, shares: Array, misfit: float = 1.0) -> Sphericity:
    """Test the shape of what two rows or more leave; the law of the ratio is multiplied by `misfit`."""
    E = whitened(rest, shares)
    k = E.shape[1]
    mean, variance, ratio = 0.0, 0.0, 0.0
    j = np.arange(k)
    for group in groups(rest):
        share = float(rest.weights[group].sum())
        count = max(rest.samples * share / 2, k + 1.0)
        pooled = np.tensordot(rest.weights[group] / share, E[group], 1)
        eigenvalues = np.maximum(scipy.linalg.eigvalsh(pooled), TINY)
        ratio += 2 * count * k * float(np.log(eigenvalues.mean()) - np.log(eigenvalues).mean())
        mean += 2 * count * float(k * digamma(count * k) - k * np.log(k) - np.sum(digamma(count - j)))
        variance += 4 * count**2 * float(np.sum(polygamma(1, count - j)) - k**2 * polygamma(1, count * k))
    scale, freedom = misfit * variance / (2 * mean), 2 * mean**2 / variance
    level = chi_squared_tail(ratio / scale, freedom)
    norm = rest.samples * k
    return Sphericity(ratio / norm, mean / norm, ratio, level)
