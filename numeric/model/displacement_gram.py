"""This is the Gram matrix of a block Hankel matrix from its first block row: neighbours along a block diagonal differ by two end terms.

With H[(l, c), j] = w(j + l)[c], j = 0..N'-1, the blocks of G = H H^T are G[i, j] = sum_k w(k+i) w(k+j)^T, so that

    G[i+1, j+1] = G[i, j] + w(N'+i) w(N'+j)^T - w(i) w(j)^T.

Only the correlations G[0, d] cost time. They are summed by matrix products without a shifted copy: samples stand in groups of b, a group
times a later group gives every product of samples up to their distance, and the diagonals of those products are the correlations.

DisplacementGram    takes a signal in pieces, gives G
factor_from_gram    the triangular factor of [inputs; outputs] with the input block alone factored, and what may be lost by it
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import LinAlgError, cholesky, eigh, solve_triangular

from ...base.arrays import Array
from ..model.sequential_qr import triangular

GROUP_WIDTH = 64  # entries of a group of samples, about: wide enough for fast products, short enough for few wasted lags


class DisplacementGram:
    """The object sums the correlations of a signal with `channels` channels at lags 0..lags-1, for the Gram matrix of its Hankel matrix
    with `lags` block rows.

    `append` takes the next samples of ONE experiment; memory does not depend on how many there are.
    """

    def __init__(self, channels: int, lags: int) -> None:
        self._channels, self._lags = channels, lags
        # A group is paired with itself and `later` groups, b later >= lags - 1: at least two, since one would waste half the products.
        later = max(1, min(lags - 1, max(2, -(-(lags - 1) * channels // GROUP_WIDTH))))
        self._group = max(1, -(-(lags - 1) // later))
        self._reach = 1 + later
        width = self._group * channels
        self._products = np.zeros((self._reach, width, width))
        self._kept = np.empty((0, channels))
        self._head = np.empty((0, channels))
        self.samples = 0

    @property
    def columns(self) -> int:
        """Return columns of the Hankel matrix so far."""
        return max(self.samples - self._lags + 1, 0)

    def append(self, piece: Array) -> None:
        """Take the next samples (T, channels)."""
        self.samples += len(piece)
        if len(self._head) < self._lags:
            self._head = np.concatenate([self._head, piece[: self._lags - len(self._head)]])
        joint = np.concatenate([self._kept, piece])
        groups = len(joint) // self._group
        first_groups = groups - self._reach + 1
        if first_groups < 1:
            self._kept = joint
            return
        grouped = joint[: groups * self._group].reshape(groups, -1)
        for distance in range(self._reach):
            self._products[distance] += grouped[:first_groups].T @ grouped[distance : distance + first_groups]
        self._kept = joint[first_groups * self._group :].copy()

    def _first_row(self) -> Array:
        """Return G[0, d], d = 0..lags-1, as an array (lags, channels, channels)."""
        lags, group, channels = self._lags, self._group, self._channels
        blocks = self._products.reshape(self._reach, group, channels, group, channels)
        row = np.zeros((lags, channels, channels))
        rest = len(self._kept) - lags + 1
        for lag in range(lags):
            for position in range(group):
                ahead, other = divmod(position + lag, group)
                row[lag] += blocks[ahead, position, :, other, :]
            # What the last groups could not pair yet.
            row[lag] += self._kept[:rest].T @ self._kept[lag : lag + rest]
        return row

    def gram(self) -> Array:
        """Return G (lags * channels, lags * channels), rows ordered by lag, then channel. At least `lags` samples must have come."""
        lags, channels = self._lags, self._channels
        head, tail = self._head[: lags - 1], self._kept[len(self._kept) - lags + 1 :]
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
