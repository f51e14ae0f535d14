"""This is the Hankel matrix R_s of a residual, compressed once to a triangular factor, and the coordinates in which its ranks
are decided.

    stacked_triangle     R with R' R = X' X, X blocks one below the other: memory does not grow with their number
    hankel_factor        L, (p s, p s) with L L' = R_s R_s', by sequential QR: the only place where N enters
    leading_factor       the factor of fewer block rows from that of more
    ObservedCoordinates  channels of unit size and the state basis in which O_s has orthonormal columns
    observed_coordinates from r, A, C: what makes every answer independent of units and of the state basis
    channel_sizes        root mean square of each channel
    gap_rank             a rank by the largest drop among the admissible ones, with the drop

Ranks come from the singular values of the triangular factor, never from R_s R_s', whose rounding would hide whatever
is below the square root of the machine's precision.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain

import numpy as np

from ....base.arrays import Array

EPS = float(np.finfo(float).eps)
# Numbers held at a time while the Hankel matrix passes by.
CHUNK = 1 << 18


def hankel_factor(r: Array, s: int) -> Array:
    """Return L with L L' = R_s R_s' for r (N, p) with N >= s: lower triangular, (p s, p s), computed in time (p s)^2 N and
    memory without N.
    """
    N, p = r.shape
    width = p * s
    windows = np.lib.stride_tricks.sliding_window_view(r, s, axis=0)  # (N - s + 1, p, s)
    step = max(CHUNK // max(width, 1), 2 * width, 1)
    blocks = (windows[start : start + step].transpose(0, 2, 1).reshape(-1, width) for start in range(0, N - s + 1, step))
    square = np.zeros((width, width))  # so that the factor is square for however few windows
    return np.ascontiguousarray(stacked_triangle(width, chain([square], blocks)).T)


def leading_factor(factor: Array, rows: int) -> Array:
    """Return the factor of the first `rows` rows of the matrix that `factor` stands for (its last windows are left out)."""
    return factor[:rows, :rows]


def channel_sizes(r: Array) -> Array:
    """Return the root mean square (p,) of each channel of r (N, p), one for a channel that is zero; safe from overflow."""
    peaks = np.max(np.abs(r), axis=0)
    peaks[peaks == 0] = 1.0
    sizes = peaks * np.sqrt(np.mean((r / peaks) ** 2, axis=0))
    return np.where(sizes > 0, sizes, 1.0)


@dataclass(frozen=True)
class ObservedCoordinates:
    """In these coordinates r / scale = C x' and x' = T x, and the matrix O_s of `windows` samples has orthonormal columns, as far as (A, C)
    is observable.

    In them the column z = [f; g] has the size of the residual that a unit pulse of its fault makes, in units of `scale`.
    """

    A: Array
    C: Array
    scale: Array
    T: Array
    observed: int

    @property
    def condition(self) -> float:
        """Return the condition number of the change of coordinates of [f; g]: by how much it can stretch one angle against
        another.
        """
        sizes = np.concatenate([np.linalg.svd(self.T, compute_uv=False), 1 / self.scale])
        return float(sizes.max() / sizes.min())

    def back(self, columns: Array) -> Array:
        """Return [f; g] (n + p, k) of the given coordinates, in the original ones."""
        n = self.A.shape[0]
        return np.vstack([np.linalg.solve(self.T, columns[:n]), self.scale[:, None] * columns[n:]])


def observed_coordinates(r: Array, A: Array, C: Array, s: int) -> ObservedCoordinates:
    """Return coordinates for r (N, p), A (n, n), C (p, n) on windows of s samples. A channel that is zero throughout keeps
    its unit.
    """
    scale = channel_sizes(r)
    C = C / scale[:, None]
    n = A.shape[0]
    if n == 0:
        return ObservedCoordinates(A, C, scale, np.zeros((0, 0)), 0)
    blocks = [C]
    for _ in range(max(s, n) - 1):
        blocks.append(blocks[-1] @ A)
    _, values, right = np.linalg.svd(np.vstack(blocks), full_matrices=False)
    seen = values > max(blocks[0].shape[0] * len(blocks), n) * EPS * max(float(values[0]), np.finfo(float).tiny)
    # An unobserved direction has no size of its own: it gets that of the best observed one.
    sizes = np.where(seen, values, values[0] if values[0] > 0 else 1.0)
    T = sizes[:, None] * right
    inverse = right.T / sizes
    return ObservedCoordinates(T @ A @ inverse, C @ inverse, scale, T, int(seen.sum()))


def gap_rank(values: Array, candidates: Iterable[int], floor: float) -> tuple[int, float]:
    """Return the rank among `candidates` with the largest ratio values[rank - 1] / values[rank], and that ratio.

    `values` descend; anything below `floor` counts as `floor`. Rank 0 compares with 1, the scale of the problem;
    full rank with the floor.
    """
    padded = np.concatenate([[max(1.0, values[0] if values.size else 1.0)], np.maximum(values, floor), [floor]])
    ratios = [(float(padded[k] / padded[k + 1]), k) for k in candidates]
    drop, rank = max(ratios)
    return rank, drop


def stacked_triangle(width: int, blocks: Iterable[Array]) -> Array:
    """Return the triangle R of the QR factorisation of these blocks of `width` columns: as many rows as columns, or as there are rows."""
    triangle = np.zeros((0, width))
    for block in blocks:
        triangle = np.asarray(np.linalg.qr(np.vstack([triangle, block]), mode="r"))
    return triangle
