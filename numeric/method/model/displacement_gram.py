"""This is the Gram matrix of a block Hankel matrix from its first block row: neighbours along a block diagonal differ by two end terms.

With H[(l, c), j] = w(j + l)[c], j = 0..N'-1, the blocks of G = H H^T are G[i, j] = sum_k w(k+i) w(k+j)^T, so that

    G[i+1, j+1] = G[i, j] + w(N'+i) w(N'+j)^T - w(i) w(j)^T.

Only the correlations G[0, d] cost time. They are summed block by block, by the fast Fourier transform of n samples at a time: it gives the
circular correlations of a block, and what they join wrongly, the end of a block to its own beginning in place of what follows it, is
mended by products of these few samples. All channels are transformed apart, so that units do not mix; the rounding is that of the sums
themselves, some eps times the root mean squares of both channels.

DisplacementGram    takes a signal in pieces, gives G
factor_from_gram    the triangular factor of [inputs; outputs] with the input block alone factored, and what may be lost by it
"""

from typing import NamedTuple

import numpy as np
from scipy.fft import irfft, rfft
from scipy.linalg import LinAlgError, cholesky, eigh, solve_triangular

from ....base.arrays import Array
from .sequential_qr import triangular

BLOCK, LAGS_IN_BLOCK = 128, 8  # samples of a block at least, and in lags: few of them need mending
ENTRIES = 1 << 17  # entries of the samples transformed at once: they and their transforms stay in the cache
SPARE = 1 << 19  # entries of an array, 4 MB, that is freed untouched


class DisplacementGram:
    """The object sums the correlations of a signal with `channels` channels at lags 0..lags-1, for the Gram matrix of its Hankel matrix
    with `lags` block rows.

    `append` takes the next samples of ONE experiment; memory does not depend on how many there are.
    """

    def __init__(self, channels: int, lags: int) -> None:
        self._channels, self._lags = channels, lags
        # The C library of Linux returns freed memory to the system, and gets it back page by page, wiped: as much time as all sums here. It
        # keeps twice the largest array that it has seen freed, so one is freed that nobody has written to.
        np.empty(SPARE)
        self._block = 1 << (max(BLOCK, LAGS_IN_BLOCK * lags) - 1).bit_length()
        # Products of the real and imaginary parts of the channels at each frequency, and of the ends of blocks with what they lack.
        self._spectra = np.zeros((self._block // 2 + 1, 2 * channels, 2 * channels))
        self._edges = np.zeros(((lags - 1) * channels,) * 2)
        # Samples lie along the last axis: a channel is then read and transformed in one go.
        self._kept = np.empty((channels, 0))
        self._head = np.empty((channels, 0))
        self.samples = 0

    @property
    def columns(self) -> int:
        """Return columns of the Hankel matrix so far."""
        return max(self.samples - self._lags + 1, 0)

    def append(self, *signals: Array) -> None:
        """Take the next samples: signals (T, any) whose channels come in this order."""
        length = len(signals[0])
        parts = -(-length // max(4 * self._block, ENTRIES // self._channels))
        for part in range(parts):
            self._take([signal[part * length // parts : (part + 1) * length // parts].T for signal in signals])

    def _take(self, signals: list[Array]) -> None:
        kept, new = self._kept.shape[1], signals[0].shape[1]
        joint = np.empty((self._channels, kept + new))
        joint[:, :kept] = self._kept
        first = 0
        for signal in signals:
            joint[first : first + len(signal), kept:] = signal
            first += len(signal)
        self.samples += new
        if self._head.shape[1] < self._lags:
            self._head = np.concatenate([self._head, joint[:, kept : kept + self._lags - self._head.shape[1]]], axis=1)
        self._transform(joint)

    def _transform(self, joint: Array) -> None:
        """Take what whole blocks there are of the samples (channels, T) that no block holds yet, and keep the rest."""
        channels, reach = self._channels, self._lags - 1
        count = (joint.shape[1] - reach) // self._block
        if count < 1:
            self._kept = joint
            return
        whole = count * self._block
        blocks = joint[:, :whole].reshape(channels, count, self._block)
        # A frequency's numbers side by side, all blocks at once: the product of a few would take as long. The copy has numpy call dgemm,
        # which is faster than dsyrk for matrices as small as these.
        parts = rfft(blocks.transpose(2, 1, 0), axis=0).view(np.float64)
        self._spectra += parts.transpose(0, 2, 1) @ parts.copy()
        following = np.concatenate([blocks[:, 1:, :reach], joint[:, np.newaxis, whole : whole + reach]], axis=1)
        lacking = (following - blocks[:, :, :reach]).swapaxes(0, 1).reshape(count, -1)
        ends = blocks[:, :, self._block - reach :].swapaxes(0, 1).reshape(count, -1)
        self._edges += ends.T @ lacking
        self._kept = joint[:, whole:].copy()

    def _first_row(self) -> Array:
        """Return G[0, d], d = 0..lags-1, as an array (lags, channels, channels)."""
        lags, reach = self._lags, self._lags - 1
        real, imaginary = self._spectra[:, 0::2], self._spectra[:, 1::2]
        crossed = real[:, :, 0::2] + imaginary[:, :, 1::2] + 1j * (real[:, :, 1::2] - imaginary[:, :, 0::2])
        row: Array = irfft(crossed, self._block, axis=0)[:lags]
        edges = self._edges.reshape(self._channels, reach, self._channels, reach)
        rest = self._kept.shape[1] - reach
        for lag in range(lags):
            row[lag] += np.einsum("akbk->ab", edges[:, reach - lag :, :, :lag])
            # What no block holds yet.
            row[lag] += self._kept[:, :rest] @ self._kept[:, lag : lag + rest].T
        return row

    def gram(self) -> Array:
        """Return G (lags * channels, lags * channels), rows ordered by lag, then channel. At least `lags` samples must have come."""
        lags, channels = self._lags, self._channels
        head, tail = self._head[:, : lags - 1].T, self._kept[:, self._kept.shape[1] - lags + 1 :].T
        blocks = np.empty((lags, channels, lags, channels))
        for lag, correlation in enumerate(self._first_row()):
            count = lags - lag
            diagonal = np.empty((count, channels, channels))
            diagonal[0] = correlation
            diagonal[1:] = np.einsum("ka,kb->kab", tail[: count - 1], tail[lag : lag + count - 1])
            diagonal[1:] -= np.einsum("ka,kb->kab", head[: count - 1], head[lag : lag + count - 1])
            np.cumsum(diagonal, axis=0, out=diagonal)
            for first in range(count):
                blocks[first, :, first + lag, :] = diagonal[first]
                blocks[first + lag, :, first, :] = diagonal[first].T
        return blocks.reshape(lags * channels, lags * channels)

    def cancellation(self, gram: Array) -> float:
        """Return how much larger a channel's greatest diagonal entry of G is than its least: what the end terms may have cancelled."""
        energies = np.diag(gram).reshape(self._lags, self._channels)
        least, greatest = energies.min(axis=0), energies.max(axis=0)
        if np.any((least <= 0) & (greatest > 0)):
            return float("inf")
        return float(np.max(greatest[greatest > 0] / least[greatest > 0], initial=1.0))


class GramFactor(NamedTuple):
    """The `factor` (k, k) is None where the input block is not positive definite in floats; `condition` is that of the scaled input
    block."""

    factor: Array | None
    condition: float


def factor_from_gram(gram: Array, inputs: int) -> GramFactor:
    """Return the upper triangular R with R.T @ R = gram, whose first `inputs` rows belong to [Uf; Up].

    Only the input block is factored; the rest follows by triangular solves, since outputs without noise make the whole matrix singular.
    The last diagonal block is the root of a difference and good to sqrt(eps) only, the others to eps times the square of `condition`.
    The condition is that of the input rows scaled to equal length, so units do not matter.
    """
    if not np.all(np.isfinite(gram)):
        return GramFactor(None, float("inf"))
    lengths = np.sqrt(np.maximum(np.diag(gram)[:inputs], 0.0))
    if np.any(lengths == 0):
        return GramFactor(None, float("inf"))
    scaled = gram[:inputs, :inputs] / np.outer(lengths, lengths)
    try:
        upper = cholesky(scaled, check_finite=False)
    except LinAlgError:
        return GramFactor(None, float("inf"))
    condition = float(np.linalg.cond(upper))
    cross = solve_triangular(upper, gram[:inputs, inputs:] / lengths[:, np.newaxis], trans="T", check_finite=False)
    rest = gram[inputs:, inputs:] - cross.T @ cross
    # Outputs too are scaled to equal length before the root is taken.
    sizes = np.sqrt(np.maximum(np.diag(gram)[inputs:], 0.0))
    sizes[sizes == 0] = 1.0
    energies, directions = eigh((rest + rest.T) / 2 / np.outer(sizes, sizes), check_finite=False)
    factor = np.zeros_like(gram)
    factor[:inputs, :inputs] = upper * lengths
    factor[:inputs, inputs:] = cross
    factor[inputs:, inputs:] = triangular((directions * np.sqrt(np.maximum(energies, 0.0))).T) * sizes
    return GramFactor(factor, condition)
