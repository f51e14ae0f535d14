"""Ranks of the block Hankel matrices R_1, R_2, .. of one signal, when only rounding stands between it and exactness.

R_s has the windows [r(k); ..; r(k+s-1)] as columns. All windows are taken over the same columns, so that one orthogonal
triangle serves every s: R_s' is the leading part of R_(s_max)', and so are their triangles. The matrix itself is never held.

    triangle        upper triangular T with T'T = R_s R_s', built by QR of chunks, never from that product
    values          singular values of R_s, descending
    threshold       tau_s: a singular value at or below it may be rounding alone
    floor           level a sample that the least singular value speaks for, in units of the (scaled) channels
    margin          least factor, in powers of ten, by which a singular value clears the threshold on either side

Threshold. With R the exact and R + E the given Hankel matrix every singular value moves by at most |E|_2 (Weyl; [GVL13], corollary 8.6.2),
and |E|_2 <= |E|_F. Samples of unit mean square, each wrong by at most `ROUNDINGS` units in the last place, give
|E|_F <= ROUNDINGS eps |R_s|_F; the QR adds a small multiple of the same. Where cancellation (r = y - simulated) left larger
but still rounding-like errors, they show as a cluster of least singular values: those of a matrix of
independent errors of deviation d lie between d (sqrt(columns) -+ sqrt(rows)), about [DS01], so the least of R gives d. `SPREAD` covers
unequal channels, and that a Hankel matrix has each error many times, which can spread its singular values farther.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy.linalg

from ....base.arrays import Array
from .sample_windows import stacked_triangle

ROUNDINGS = 64.0
SPREAD = 30.0
FLOOR_LIMIT = 2.0**-32
"""A floor above this is not rounding (it is 2^20 units in the last place of a double): the data are noisy."""


@dataclass(frozen=True)
class HankelRanks:
    """The ranks of R_1 .. R_S, S = len(ranks), where `values[i]`, `thresholds[i]` and `margins[i]` belong to window i + 1."""

    values: tuple[Array, ...]
    ranks: tuple[int, ...]
    thresholds: tuple[float, ...]
    margins: tuple[float, ...]
    columns: int
    deficient: bool
    """Whether the longest window has singular values at the rounding level: else noise fills every direction."""

    @property
    def gaps(self) -> tuple[int, ...]:
        """Return the rank R_(s+1) - rank R_s for s = 1 .. S - 1."""
        return tuple(b - a for a, b in pairwise(self.ranks))


def hankel_triangle(r: Array, windows: int, *, chunk: int = 4096) -> Array:
    """Return the triangle T (windows p, windows p) of the Hankel matrix of r (N, p); memory independent of N."""
    samples, p = r.shape
    width = windows * p
    columns = samples - windows + 1
    step = max(chunk, width)
    pieces = ((start, min(start + step, columns)) for start in range(0, columns, step))
    return stacked_triangle(width, (np.hstack([r[start + j : stop + j] for j in range(windows)]) for start, stop in pieces))


def hankel_values(r: Array, windows: int) -> tuple[Array, ...]:
    """Return singular values of R_1 .. R_windows, all over the N - windows + 1 columns of the longest."""
    p = r.shape[1]
    triangle = hankel_triangle(r, windows)
    return tuple(scipy.linalg.svdvals(triangle[: s * p, : s * p], check_finite=False) for s in range(1, windows + 1))


def ranks_at(values: tuple[Array, ...], thresholds: tuple[float, ...], columns: int, *, deficient: bool) -> HankelRanks:
    """Count the singular values above their thresholds, with margins."""
    ranks, margins = [], []
    for sigma, tau in zip(values, thresholds, strict=True):
        rank = int(np.sum(sigma > tau))
        kept = sigma[rank - 1] / tau if rank else np.inf
        dropped = tau / sigma[rank] if rank < len(sigma) and sigma[rank] > 0.0 else np.inf
        ranks.append(rank)
        margins.append(float(np.log10(min(kept, dropped))))
    return HankelRanks(values, tuple(ranks), thresholds, tuple(margins), columns, deficient)


def rounding_ranks(r: Array, windows: int, *, unit: float) -> HankelRanks:
    """Return ranks of R_1 .. R_windows by the rounding threshold; r (N, p) scaled to unit mean square a channel.

    `unit` is the rounding unit of the numbers that were given (2^-52 for float64, 2^-23 for float32).
    """
    values = hankel_values(r, windows)
    columns = r.shape[0] - windows + 1
    rows = values[-1].size
    spread = float(np.sqrt(columns) - np.sqrt(rows))
    floor = float(values[-1][-1]) / spread if spread > 0.25 * np.sqrt(columns) else 0.0
    limit = FLOOR_LIMIT * unit / np.finfo(float).eps
    if floor > limit:
        floor = 0.0
    thresholds = tuple(
        max(ROUNDINGS * unit * float(np.linalg.norm(sigma)), SPREAD * floor * float(np.sqrt(columns) + np.sqrt(sigma.size)))
        for sigma in values
    )
    deficient = bool(values[-1][-1] <= thresholds[-1])
    return ranks_at(values, thresholds, columns, deficient=deficient)
