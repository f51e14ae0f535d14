"""Make one triangular factor of a record's windows: an ARX model, an input spectrum and PI-MOESP need no more, whatever its length.

A window of lags + 1 samples that ends at k is the row [u(k), y(k-1), u(k-1), ..., y(k-lags), u(k-lags), y(k)]. Beside it stands a constant
among the regressors, first of all, so that what is left of the row is its distance from the mean of all windows. With R upper triangular
and R.T @ R = the sum of row.T @ row over these distances, the squared residuals of the ARX model of EVERY order h <= lags, its constant
fitted, stand in R: those of y(k) on the first n_u + h (p + n_u) columns are what R has in its last p columns from row n_u + h (p + n_u) on.
So the length of the record enters once, and an operating point of any size enters nowhere but in `means`. Factors of pieces, and of several
experiments, add up.

ArxWindows          the factor with its dimensions and means
arx_windows         of one experiment, given in consecutive pieces
joined_windows      of one experiment, out of parts of it that have one constant in common
merge_windows       of several experiments, each with a constant of its own
about_zero          the same windows with no constant fitted
longest_lag         how many lags experiments of given lengths carry
past_input_compression   the factor of [Uf; Up; Yf] that PI-MOESP asks for, out of the windows
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from math import isqrt

import numpy as np
from numpy.typing import NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ....base.tasks import in_order
from ...data.validation import PIECE
from .compression import EPS, Compression, scaled_condition, window_rows
from .sequential_qr import SequentialQR, triangular

RATE = 1.6
"""Lags over the cube root of the samples. In the limit coefficients are normal where lags^3 / N and sqrt(N) times the bias vanish [LR85]:
the cube root is the edge of that, so the factor is calibrated by `python benchmarks/at_the_bound.py --calibrate lags`: errors
are the same from 1.2 to 3.2, and larger at 0.8 where the noise has a spectral null."""
SHARE = 4
"""At least that many windows for every regressor of an equation: the covariance of the innovations then has three degrees of freedom of
four left, and its inverse is wrong by a factor of about 4/3 at most."""
WORK, LEAST = 1 << 35, 20
"""The factor costs the square of (lags + 1) (p + n_u) a sample: of long records so many lags are carried as WORK multiplications allow,
some seconds, and LEAST in any case. The bias of a truncated autoregression falls geometrically where the disturbance is
rational and its spectrum has no null."""


SECTION = 1 << 18
"""Windows of a section. A longer record is taken in sections, whoever works on them, so that no digit depends on who does."""
CONSTANT = 1e-13
"""A channel whose distances from its mean are below that share of the mean is taken as constant: it has no more than two digits left, which
are rounding."""


@dataclass(frozen=True, eq=False)
class ArxWindows:
    """`factor` (k, k), k = (lags + 1) (p + n_u), is that of windows of `lags` + 1 samples less their means.

    `windows` is their number and `constants` that of the constants fitted; `samples` counts all experiments, and `means` has the windows'
    mean (k,) of each.
    """

    factor: Array
    lags: int
    p: int
    n_u: int
    windows: int
    constants: int
    samples: int
    means: tuple[Array, ...]

    @property
    def rows(self) -> int:
        """Return the degrees of freedom that the constants leave: a regression on j columns leaves rows - j."""
        return self.windows - self.constants

    def regressors(self, order: int) -> int:
        """Return how many columns an ARX model of this order regresses on."""
        return self.n_u + order * (self.p + self.n_u)

    @cached_property
    def scales(self) -> tuple[Array, Array]:
        """Return the deviations (p,), (n_u,) of outputs and inputs at the windows' ends, 1 for a channel that is constant."""
        sizes = np.linalg.norm(self.factor, axis=0) / np.sqrt(max(self.rows, 1))
        sizes = np.where(sizes > 0, sizes, 1.0)
        return sizes[-self.p :], sizes[: self.n_u]

    @cached_property
    def scaled(self) -> Array:
        """Return the factor of the record in channels of unit deviation."""
        y, u = self.scales
        result: Array = self.factor / np.concatenate([u, np.tile(np.concatenate([y, u]), self.lags), y])
        return result

    @property
    def growth(self) -> float:
        """Return the logarithm of the outputs' growth over the record, were it that between the first and the last sample of a window.

        It is of order one where they do not grow, whatever their colour.
        """
        if self.lags == 0:
            return 0.0
        last, first = (np.linalg.norm(self.factor[:, self.outputs(lag)]) for lag in (0, self.lags))
        return float(np.log(last / first) * self.rows / self.lags) if last > 0 and first > 0 else 0.0

    def inputs(self, lag: int) -> NDArray[np.intp]:
        """Return the columns of u(k - lag)."""
        first = 0 if lag == 0 else self.n_u + (lag - 1) * (self.p + self.n_u) + self.p
        return np.arange(first, first + self.n_u)

    def outputs(self, lag: int) -> NDArray[np.intp]:
        """Return the columns of y(k - lag)."""
        first = len(self.factor) - self.p if lag == 0 else self.n_u + (lag - 1) * (self.p + self.n_u)
        return np.arange(first, first + self.p)


def longest_lag(lengths: Sequence[int], p: int, n_u: int) -> int:
    """Return RATE times the cube root of all samples of experiments of these lengths, or what leaves SHARE windows for each regressor, or
    what WORK allows.

    It is -1 where not even u(k) alone leaves that many.
    """
    samples = sum(lengths)
    allowed = isqrt(WORK // max(samples, 1)) // (p + n_u) - 1
    lags = min(int(RATE * np.cbrt(samples)), max(allowed, LEAST))
    while lags >= 0 and sum(max(length - lags, 0) for length in lengths) < SHARE * (n_u + lags * (p + n_u)):
        lags -= 1
    return lags


def arx_windows(data: Iterable[tuple[Array, Array]], lags: int) -> ArxWindows:
    """Return the windows of one experiment in float64 pieces (y, u). Raises InvalidData for no pieces or unequal channels.

    A long record is cut into sections, which the workers of a cluster may do (`base/tasks.py`); a section begins with the `lags` samples
    that the one before ends with, so that each window is in one of them.
    """
    return reduce(joined_windows, in_order(_of_section, _sections(data, lags)))


def _sections(data: Iterable[tuple[Array, Array]], lags: int) -> Iterator[tuple[Array, Array, int]]:
    """Yield outputs and inputs of the sections, and the lags."""
    kept: list[tuple[Array, Array]] = []
    held = 0
    first: tuple[int, int] | None = None
    for y, u in data:
        first = first or (y.shape[1], u.shape[1])
        if (y.shape[1], u.shape[1]) != first:
            raise InvalidData(
                f"a piece has {counted(u.shape[1], 'input')} and {counted(y.shape[1], 'output')} "
                f"where the first has {first[1]} and {first[0]}: all need the same"
            )
        for start in range(0, max(len(y), 1), PIECE):  # so that no more than a section is copied at once
            kept.append((y[start : start + PIECE], u[start : start + PIECE]))
            held += len(kept[-1][0])
            while held > SECTION + lags:  # one sample more, so that no section is empty
                whole_y, whole_u = (np.concatenate(parts) for parts in zip(*kept, strict=True))
                yield whole_y[: SECTION + lags], whole_u[: SECTION + lags], lags
                kept = [(whole_y[SECTION:].copy(), whole_u[SECTION:].copy())]
                held -= SECTION
    if not kept:
        raise InvalidData("got no data, since the iterable of pieces (y, u) is empty: give at least one piece")
    y, u = (np.concatenate(parts) for parts in zip(*kept, strict=True))
    yield y, u, lags


def _of_section(y: Array, u: Array, lags: int) -> ArxWindows:
    """Return the windows of outputs (N, p) and inputs (N, n_u)."""
    p, n_u = y.shape[1], u.shape[1]
    running = SequentialQR(_rows(p, n_u, lags), n_u + p + 1)
    for start in range(0, max(len(y), 1), PIECE):
        piece = slice(start, start + PIECE)
        running.append(np.concatenate([u[piece], y[piece], np.ones((len(y[piece]), 1))], axis=1))
    whole, windows = running.factor(), running.columns
    means = whole[0, 1:] / np.sqrt(max(windows, 1))
    return ArxWindows(_without_rounding(whole[1:, 1:], means, windows), lags, p, n_u, windows, min(windows, 1), len(y), (means,))


def _without_rounding(factor: Array, mean: Array, windows: int) -> Array:
    """Return the factor with zeros for a channel that is constant, whose distances from its mean are rounding."""
    sizes = np.abs(factor).max(axis=0)
    rounding = sizes <= CONSTANT * np.maximum(sizes, np.sqrt(windows) * np.abs(mean))
    return np.where(rounding, 0.0, factor)


def joined_windows(first: ArxWindows, second: ArxWindows) -> ArxWindows:
    """Return the windows of one experiment out of two parts of it, which share `lags` samples; one constant is fitted to both.

    The squares about the common mean are those about the two means, and those of the means' distance [CGL83].
    """
    one, two = first.windows, second.windows
    both = max(one + two, 1)
    (mean,), (other,) = first.means, second.means
    apart = np.sqrt(one * two / both) * (mean - other)
    together = (one * mean + two * other) / both
    factor = triangular(first.factor, second.factor, apart[None])
    return replace(
        first,
        factor=_without_rounding(factor, together, both),
        windows=one + two,
        constants=min(one + two, 1),
        samples=first.lags + one + two,
        means=(together,),
    )


def merge_windows(parts: Sequence[ArxWindows]) -> ArxWindows:
    """Return the windows of all experiments together, each with a constant of its own: their operating points may differ.

    Raises InvalidData without parts or where lags or channels differ.
    """
    if not parts:
        raise InvalidData("nothing to merge: give the windows of at least one experiment")
    first = parts[0]
    for other in parts:
        for name in ("lags", "p", "n_u"):
            if getattr(other, name) != getattr(first, name):
                raise InvalidData(
                    f"windows with {name} = {getattr(first, name)} and {getattr(other, name)} cannot be merged: give them equal settings"
                )
    if len(parts) == 1:
        return first
    return replace(
        first,
        factor=triangular(*(part.factor for part in parts)),
        windows=sum(part.windows for part in parts),
        constants=sum(part.constants for part in parts),
        samples=sum(part.samples for part in parts),
        means=tuple(mean for part in parts for mean in part.means),
    )


def about_zero(windows: ArxWindows) -> ArxWindows:
    """Return the windows of one experiment where zero is known to be zero: no constant is fitted, and the means excite."""
    (mean,) = windows.means
    factor = triangular(windows.factor, np.sqrt(windows.windows) * mean[None])
    return replace(windows, factor=factor, constants=0, means=(np.zeros_like(mean),))


def past_input_compression(windows: ArxWindows, block_rows: int, past_rows: int) -> Compression:
    """Return the factor of [Uf; Up; Yf] over the same windows, in channels of unit size, for block_rows + past_rows <= lags + 1."""
    span = past_rows + block_rows
    chosen = [
        (windows.inputs if channel < windows.n_u else windows.outputs)(span - 1 - lag)[channel - (channel >= windows.n_u) * windows.n_u]
        for lag, channel in window_rows(windows.n_u, windows.p, past_rows, block_rows)
    ]
    factor = triangular(windows.scaled[:, chosen])
    inputs = span * windows.n_u
    condition = scaled_condition(factor[:inputs, :inputs])
    return Compression(block_rows, past_rows, windows.p, windows.n_u, windows.samples, windows.rows, factor, "qr", condition, EPS)


def _rows(p: int, n_u: int, lags: int) -> NDArray[np.intp]:
    """Return (lag, channel) of the joint signal [u, y, 1] for each column, where lags count from the window's first sample."""
    inputs, outputs, one = range(n_u), range(n_u, n_u + p), n_u + p
    past = [(lags - back, channel) for back in range(1, lags + 1) for part in (outputs, inputs) for channel in part]
    return np.array([(0, one)] + [(lags, c) for c in inputs] + past + [(lags, c) for c in outputs], dtype=np.intp)
