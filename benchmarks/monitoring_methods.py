"""The statistics that the monitor is held against: parity space, PCA and dynamic PCA, each learnt from the same healthy record.

Method        a name and its statistics (any, k) of a stream y (N, p), u (N, n_u); NaN before the first whole window
averaged      the same with the means of its statistics over a window
parity_space  T^2 of the parity vector W (Y_s - T_s U_s), W O_s = 0, of windows of n + 1 samples of the model [CW84]
principal     T^2 in the principal components of [y u] with `lags` samples before, and Q beside them [RCB00]; lags = 0 is PCA, else dynamic
              PCA [KSG95]; as many components as have more variance than those of as many random columns have on average (parallel analysis)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from faultspace.numeric.method.model.models import StateSpaceModel, observability_matrix

Array = NDArray[np.float64]

RANDOM = 20  # random tables of a parallel analysis


@dataclass(frozen=True)
class Method:
    """The statistics have these `names`; `of` gives them for a stream."""

    names: tuple[str, ...]
    of: Callable[[Array, Array], Array]


def averaged(method: Method, samples: int) -> Method:
    """Return the method with the means of its statistics over the last `samples` samples, fewer at the beginning of a stream."""

    def statistics(y: Array, u: Array) -> Array:
        plain = method.of(y, u)
        sums = np.cumsum(np.nan_to_num(plain), axis=0)
        counts = np.cumsum(np.isfinite(plain), axis=0)
        sums[samples:], counts[samples:] = sums[samples:] - sums[:-samples], counts[samples:] - counts[:-samples]
        return np.asarray(np.where(counts > 0, sums / np.maximum(counts, 1), np.nan))

    return Method(tuple(f"{name}, {samples}" for name in method.names), statistics)


def windows(values: Array, s: int) -> Array:
    """Return the windows (N - s + 1, s k) of values (N, k), the oldest sample first."""
    return np.hstack([values[i : len(values) - s + 1 + i] for i in range(s)])


def behind(statistics: Array, samples: int) -> Array:
    """Return the statistics with NaN for the samples before the first whole window."""
    return np.vstack([np.full((samples - len(statistics), statistics.shape[1]), np.nan), statistics])


def parity_space(model: StateSpaceModel, y: Array, u: Array) -> Method:
    """Learn the covariance of the parity vector from a healthy record."""
    s, p, n_u = model.n + 1, model.p, model.n_u
    left = np.linalg.svd(observability_matrix(model.A, model.C, s))[0][:, model.n :].T
    markov = model.markov(s)
    toeplitz = np.block([[markov[i - j] if i >= j else np.zeros((p, n_u)) for j in range(s)] for i in range(s)])

    def vector(y: Array, u: Array) -> Array:
        return np.asarray((windows(y, s) - windows(u, s) @ toeplitz.T) @ left.T)

    healthy = vector(y, u)
    mean, root = healthy.mean(axis=0), np.linalg.cholesky(np.cov(healthy.T))

    def statistics(y: Array, u: Array) -> Array:
        scaled = np.linalg.solve(root, (vector(y, u) - mean).T)
        return behind(np.sum(scaled**2, axis=0)[:, None], len(y))

    return Method(("parity",), statistics)


def components(correlation: Array, samples: int) -> int:
    """Return the number of principal components by parallel analysis."""
    draw, width = np.random.default_rng(1), len(correlation)
    random = [np.linalg.eigvalsh(np.corrcoef(draw.standard_normal((samples, width)).T))[::-1] for _ in range(RANDOM)]
    more = np.linalg.eigvalsh(correlation)[::-1] > np.mean(random, axis=0)
    return max(1, int(np.argmin(more)) if not np.all(more) else width - 1)


def principal(y: Array, u: Array, *, lags: int = 0) -> Method:
    """Learn the components from a healthy record."""

    def table(y: Array, u: Array) -> Array:
        return windows(np.hstack([y, u]), lags + 1)

    healthy = table(y, u)
    mean, size = healthy.mean(axis=0), healthy.std(axis=0)
    size = np.where(size > 0, size, 1.0)
    scaled = (healthy - mean) / size
    correlation = scaled.T @ scaled / len(scaled)
    values, vectors = np.linalg.eigh(correlation)
    kept = components(correlation, len(scaled))
    P, variances = vectors[:, -kept:], values[-kept:]

    def statistics(y: Array, u: Array) -> Array:
        scaled = (table(y, u) - mean) / size
        scores = scaled @ P
        rest = scaled - scores @ P.T
        return behind(np.column_stack([np.sum(scores**2 / variances, axis=1), np.sum(rest**2, axis=1)]), len(y))

    name = "DPCA" if lags else "PCA"
    return Method((f"{name} T2", f"{name} Q"), statistics)
