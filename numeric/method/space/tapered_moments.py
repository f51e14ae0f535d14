"""These are cross-spectral moments of the windows of r, tapered so that a spectral null of the noise stays one.

    psi             psi(k) = [r(k); ..; r(k+eta)], so that N(q) r (k) = N psi(k) for coefficients N = [N_0 .. N_eta]
    CrossMoments    Hermitian second moments of psi in frequency bands: all that a kernel basis asks of the data
    tapered_moments from r, in memory independent of its length; pooled_moments: from several records of one system
    real_parts      what a single row asks of them
    taper           cosine edges, the middle flat [T67]: an untapered record leaks about 1/N of its power to every
                    frequency, more than noise through a low-pass leaves near its null, where the weights are largest
    samples         independent samples that the tapered ones are worth

Segments overlap by an edge, so that little is lost on long records. Of a record about its means each entry of psi gets a constant of its
own: the means are those of all samples, those of shifted windows are others by the ends of the record over N, and after such a row of large
signals that would be far above little noise at frequency zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ..ranks.one_row import WindowMoments

ComplexArray = NDArray[np.complex128]

BANDS = 64
SEGMENT = 8192
# Share of a segment in its two edges together.
EDGES = 0.1
HALF_THE_DIGITS = float(np.sqrt(np.finfo(np.float64).eps))


@dataclass(frozen=True)
class CrossMoments:
    """Cross-spectral moments of the window psi.

    `moments` (bands, p (degree+1), p (degree+1)) are those of psi psi*, whose sum over bands has the mean square of psi as real part;
    `weights` (bands,) are the shares of the bands and sum to one; `angles` (bands,) are their centres in radians a sample.
    """

    moments: ComplexArray
    weights: Array
    angles: Array
    channels: int
    degree: int
    samples: float

    def of_degree(self, degree: int) -> CrossMoments:
        """Return the moments of the shorter window: the same samples, so that levels of different degrees are comparable."""
        size = self.channels * (degree + 1)
        moments = self.moments[:, :size, :size]
        return CrossMoments(moments, self.weights, self.angles, self.channels, degree, self.samples)

    def mixed(self, mix: Array) -> CrossMoments:
        """Return the moments of r @ mix, mix (p, k)."""
        repeated = np.kron(np.eye(self.degree + 1), mix)
        moments = repeated.T @ self.moments @ repeated
        return CrossMoments(moments, self.weights, self.angles, mix.shape[1], self.degree, self.samples)

    def real_parts(self) -> WindowMoments:
        """Return what a single row asks of them."""
        count = round(self.samples)
        return WindowMoments(self.moments.real * count, self.weights * count, self.angles, self.channels, self.degree, count)


def cosine_taper(length: int, edges: float) -> Array:
    """Return the taper of Tukey with cosines over the share 0 < `edges` < 1 of its length, half at either end; 0 at both, 1 between.

    It is that of `scipy.signal.windows.tukey`, whose folder takes longer to load than most records to be identified.
    """
    places, width = np.arange(length, dtype=np.float64), int(edges * (length - 1) / 2)
    rising, falling = places[: width + 1], places[length - width - 1 :]
    taper = np.ones(length)
    taper[: width + 1] = 0.5 * (1 + np.cos(np.pi * (-1 + 2 * rising / edges / (length - 1))))
    taper[length - width - 1 :] = 0.5 * (1 + np.cos(np.pi * (-2 / edges + 1 + 2 * falling / edges / (length - 1))))
    return taper


def tapered_moments(r: Array, degree: int) -> CrossMoments:
    """Return the moments of r (N, p) in BANDS bands, or fewer where the record is short.

    Raises InvalidData where the windows are fewer than twice their own size.
    """
    return pooled_moments([r], degree)


def pooled_moments(experiments: Sequence[Array], degree: int, most: int = BANDS, *, constants: Sequence[bool] = ()) -> CrossMoments:
    """Return the moments of several records (N_i, p) of one system, weighted by their lengths, in bands that all of them fill together;
    `constants` tells of which the windows may have one.

    Raises InvalidData where the windows of one of them are fewer than twice their own size.
    """
    windows = np.array([len(r) - degree for r in experiments])
    # Each has two frequencies of the longest, of which a constant may take one: a band that no record reaches says nothing.
    bands = max(4, min(most, int(windows.sum()) // 8, int(windows.max()) // 4))
    with_constant = list(constants) or [False] * len(experiments)
    parts = [_moments(r, degree, bands, one) for r, one in zip(experiments, with_constant, strict=True)]
    share = windows / windows.sum()
    moments = np.tensordot(share, np.array([part.moments for part in parts]), 1)
    weights = np.tensordot(share, np.array([part.weights for part in parts]), 1)
    return replace(parts[0], moments=moments, weights=weights, samples=sum(part.samples for part in parts))


def about_means(r: Array) -> bool:
    """Say whether the means have been taken off r (N, p): what is left of them is rounding beside what chance leaves, a deviation over the
    root of N, of which it has no half of the digits."""
    return bool(np.all(np.abs(r.mean(axis=0)) * np.sqrt(len(r)) <= HALF_THE_DIGITS * r.std(axis=0)))


def _moments(r: Array, degree: int, bands: int, constant: bool) -> CrossMoments:
    """Return the moments of one record (N, p), of windows about a `constant` or as they are; a short one leaves some of so many bands
    empty."""
    N, p = r.shape
    windows, size = N - degree, p * (degree + 1)
    if windows < 2 * size:
        raise InvalidData(
            f"r has {counted(N, 'sample')} of {counted(p, 'channel')}: kernel rows of degree {degree} need at least {2 * size + degree}; "
            "record more, or take a model of lower order"
        )
    length = min(windows, SEGMENT)
    pieces = 1 + int(np.ceil((windows - length) / (length * (1 - EDGES / 2))))
    starts = np.linspace(0, windows - length, pieces).astype(int).tolist()
    taper = cosine_taper(length, EDGES)
    frequencies = length // 2 + 1
    # Both halves of the spectrum, told by one: twice, but for the frequencies that are their own mirror image.
    doubled = np.full(frequencies, 2.0)
    doubled[0] = 1.0
    doubled[-1] = 2.0 - (length % 2 == 0)
    band = np.minimum(np.arange(frequencies) * 2 * bands // length, bands - 1)
    edges = np.searchsorted(band, np.arange(bands + 1))
    moments = np.zeros((bands, size, size), dtype=np.complex128)
    centre = np.zeros(size)
    if constant:
        # Fitted at frequency zero, of which one number in so many pieces is gone with it.
        sums = [np.concatenate([taper @ r[start + j : start + j + length] for j in range(degree + 1)]) for start in starts]
        centre = np.mean(sums, axis=0) / taper.sum()
    for start in starts:
        psi = (np.hstack([r[start + j : start + j + length] for j in range(degree + 1)]) - centre) * taper[:, None]
        spectrum = np.fft.rfft(psi, axis=0) * np.sqrt(doubled)[:, None]
        for b in range(bands):
            part = spectrum[edges[b] : edges[b + 1]]
            moments[b] += part.T @ part.conj()
    moments /= pieces * length * float(np.sum(taper**2))
    if constant:
        doubled[0] -= 1 / pieces
    weights = np.bincount(band, weights=doubled, minlength=bands) / doubled.sum()
    coverage = np.zeros(windows)
    for start in starts:
        coverage[start : start + length] += taper**2
    worth = float(coverage.sum() ** 2 / np.sum(coverage**2))
    return CrossMoments(moments, weights, (np.arange(bands) + 0.5) * np.pi / bands, p, degree, worth)
