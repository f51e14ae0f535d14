"""This is the triangular factor of a block Hankel matrix, appended to block by block: exact to rounding whatever the condition of the data.

A row of the Hankel matrix H is a pair (lag, channel): H[(l, c), j] = w(j + l)[c] for the joint signal w = [u, y]. The factor R is upper
triangular with R.T @ R = H @ H.T; only R and one block of columns are held. [VV07] calls R.T the L of the LQ (RQ) factorisation.

append_rows         a triangular factor after more rows
SequentialQR        takes a signal in pieces of any length, gives R
triangular          the upper triangular factor of stacked rows, with a nonnegative diagonal
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from ...base.arrays import Array

PANEL = 16  # reflections applied together
ENTRIES = 1 << 17  # entries of a block of columns: one that stays in the cache is several times faster


def _nonnegative(factor: Array) -> Array:
    """Return the factor with rows turned so that its diagonal is nonnegative: R is then unique where H has full row rank."""
    upper = np.triu(factor)
    turned: Array = np.where(np.diag(upper) < 0, -1.0, 1.0)[:, np.newaxis] * upper
    return turned


def append_rows(factor: Array, block: Array) -> Array:
    """Return the factor of [factor; block], block of any number of rows; both may be overwritten. LAPACK's tpqrt knows that `factor` is
    triangular.
    """
    width = factor.shape[1]
    updated, _, _, info = lapack.dtpqrt(0, min(PANEL, width), factor, block, overwrite_a=1, overwrite_b=1)
    assert info == 0, info
    result: Array = updated
    return result


def triangular(*stacked: Array) -> Array:
    """Return R (k, k), upper triangular with nonnegative diagonal, with R.T @ R = the sum of S.T @ S over the given S (any, k)."""
    factor = np.zeros((stacked[0].shape[1],) * 2, order="F")
    for block in stacked:
        factor = append_rows(factor, np.array(block, dtype=np.float64, order="F"))
    return _nonnegative(factor)


class SequentialQR:
    """This is the running factor of the Hankel matrix whose rows are `rows`, an integer array (k, 2) of (lag, channel).

    `append` takes the next samples of ONE experiment (T, channels); memory is k^2 plus one block of columns plus one piece.
    """

    def __init__(self, rows: NDArray[np.intp], channels: int) -> None:
        self._rows = rows
        self._lags = int(rows[:, 0].max()) + 1
        width = len(rows)
        self._factor = np.zeros((width, width), order="F")
        self._block = np.empty((max(width // 2, ENTRIES // width, 1), width), order="F")
        self._kept = np.empty((channels, 0))
        self.columns = 0

    def append(self, piece: Array) -> None:
        """Take the next samples (T, channels); columns across the edge of two pieces are seen."""
        # Channel-major: each row of the block is then one contiguous copy.
        joint = np.concatenate([self._kept, piece.T], axis=1)
        columns = max(joint.shape[1] - self._lags + 1, 0)
        for first in range(0, columns, len(self._block)):
            count = min(len(self._block), columns - first)
            for number, (lag, channel) in enumerate(self._rows):
                self._block[:count, number] = joint[channel, first + lag : first + lag + count]
            # tpqrt overwrites a full block in place; the shorter last one is copied on the way.
            self._factor = append_rows(self._factor, self._block if count == len(self._block) else np.array(self._block[:count], order="F"))
        self.columns += columns
        self._kept = joint[:, columns:].copy()

    def factor(self) -> Array:
        """Return R (k, k) so far; fewer columns than rows leave zero rows."""
        return _nonnegative(self._factor)
