"""This is the triangular factor of a block Hankel matrix, appended to block by block: exact to rounding whatever the condition of the data.

A row of the Hankel matrix H is a pair (lag, channel): H[(l, c), j] = w(j + l)[c] for the joint signal w = [u, y]. The factor R is upper
triangular with R.T @ R = H @ H.T; only a factor and one block of columns are held. R.T is the R of [VV07]'s RQ
factorisation, the L of an LQ one.

Neighbouring windows share most of their samples. So TOGETHER windows are taken as one longer one: the factor of the longer ones has
little more columns and an eighth of the rows, each window is a choice of its columns, and the factor of these choices is R.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from ....base.arrays import Array

PANEL = 16  # reflections applied together
TOGETHER = 8  # windows taken as one
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
    """The running factor of the Hankel matrix whose rows are `rows`, an integer array (k, 2) of (lag, channel).

    `append` takes the next samples of ONE experiment (T, channels); memory is the square of k and a little more plus one block of columns
    plus one piece.
    """

    def __init__(self, rows: NDArray[np.intp], channels: int) -> None:
        self._rows = rows
        self._lags = int(rows[:, 0].max()) + 1
        later = np.stack([rows + np.array((shift, 0)) for shift in range(TOGETHER)])
        self._longer, places = np.unique(later.reshape(-1, 2), axis=0, return_inverse=True)
        self._places = places.reshape(TOGETHER, len(rows))
        width = len(self._longer)
        self._factor = np.zeros((width, width), order="F")
        self._block = np.empty((max(width // 2, ENTRIES // width, 1), width), order="F")
        self._kept = np.empty((channels, 0))
        self._samples = 0

    @property
    def columns(self) -> int:
        """Return columns of the Hankel matrix so far."""
        return max(self._samples - self._lags + 1, 0)

    def append(self, piece: Array) -> None:
        """Take the next samples (T, channels); columns across the edge of two pieces are seen."""
        self._samples += len(piece)
        # Channel-major: each row of the block is then one slice.
        joint = np.concatenate([self._kept, piece.T], axis=1)
        groups = max(joint.shape[1] - self._lags + 1, 0) // TOGETHER
        for first in range(0, groups, len(self._block)):
            count = min(len(self._block), groups - first)
            for number, (lag, channel) in enumerate(self._longer):
                begin = first * TOGETHER + lag
                self._block[:count, number] = joint[channel, begin : begin + count * TOGETHER : TOGETHER]
            # tpqrt overwrites a full block in place; the shorter last one is copied on the way.
            self._factor = append_rows(self._factor, self._block if count == len(self._block) else np.array(self._block[:count], order="F"))
        self._kept = joint[:, groups * TOGETHER :].copy()

    def factor(self) -> Array:
        """Return R (k, k) so far; fewer columns than rows leave zero rows."""
        # Rows of zeros are those that columns which repeat others, as constants do, have left out; the others may stand behind them.
        longer = np.triu(self._factor)
        longer = longer[np.any(longer, axis=1)]
        rest = max(self._kept.shape[1] - self._lags + 1, 0)
        last = np.array([self._kept[channel, lag : lag + rest] for lag, channel in self._rows]).T
        return triangular(*(longer[:, places] for places in self._places), last)
