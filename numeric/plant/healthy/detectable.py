"""The least fault that a count against a healthy record would have found: a white signal at one output, found with a stated chance.

The count finds the fault where the largest root of the record's covariance against the healthy one exceeds its threshold at one centre
at least. For a white signal of variance s^2 at output i the whitened covariance at centre f is I + g h h*, h a unit vector and g(f) =
s^2 |Phi^(-1/2) a_i|^2, a_i column i of the filter from r to the innovations. The chance that the root exceeds a threshold depends on g,
the dimension, and the two degrees of freedom alone: it is simulated, by DRAWS / p draws of the two covariances with one seed, for g on
a grid. The count divides by the covariance of the forecast, I + X X* between T tapers; a fault enters the regressors X too, as the
vector b(f) per unit of signal, and in its own direction that divides 1 + g by 1 + T s^2 |b|^2. The healthy covariances of neighbouring
centres share samples; of centres as far apart as do not, the chances of missing multiply, and the others are left out, which makes s
larger and the chance stated one that is reached at least. s is found by bisection. The Phi are estimates, taken as exact but for the
mean of their inverse, which is put right. Where no size is found, because the healthy record is too short to tell what its noise
remembers, the answer is infinite.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy  # its folders are loaded when they are first used
from numpy.typing import NDArray

from ....base.arrays import Array
from .against_healthy import FaultsAgainstHealthy
from .healthy_model import HealthyReference

DRAWS = 4000
"""It is divided by the number of outputs, which makes each of them dearer."""
GAINS = np.concatenate([[0.0], np.geomspace(0.1, 1000.0, 40)])
_SEED = 1935


def visible_white_faults(healthy: HealthyReference, count: FaultsAgainstHealthy, power: float) -> Array:
    """Return the standard deviation (p,) of a white signal at each output alone that the count would find with chance `power` in (0, 1).

    `count` is that of a record against `healthy`: its length and thresholds are those that are asked about.
    """
    # The last centre may share frequencies with the one before; left out, the chance stated is one that is reached at least.
    frequencies, thresholds = count.frequencies[:-1], count.thresholds[:-1, 0]
    missed = _chance_of_missing(healthy.p, healthy.tapers, healthy.freedom, thresholds)
    filters = healthy.response(frequencies)
    precisions = np.linalg.inv(healthy.covariances[healthy.nearest(frequencies)])
    unbiased = max(healthy.freedom - healthy.p, 1) / healthy.freedom
    gains = np.real(np.einsum("fij,fik,fkj->fj", filters.conj(), precisions, filters)) * unbiased
    forecast = healthy.tapers * np.sum(np.abs(healthy.remembered(frequencies)) ** 2, axis=1)
    apart = int(np.ceil(healthy.freedom / healthy.tapers) * np.ceil(len(frequencies) / len(healthy.centres)))
    return np.array([_least_size(gains[:, i], forecast[:, i], missed, apart, power) for i in range(healthy.p)])


def _least_size(gain: Array, forecast: Array, missed: Array, apart: int, power: float) -> float:
    """Return the size at which the chances of missing at centres so far apart multiply to 1 - power, for the best choice of the first."""

    def excess(logarithm: float) -> float:
        square = np.exp(2.0 * logarithm)
        gains = np.maximum((1.0 + square * gain) / (1.0 + square * forecast) - 1.0, 0.0)
        chances = np.array([np.interp(g, GAINS, row) for g, row in zip(gains, missed, strict=True)])
        return max(1.0 - float(np.prod(chances[first::apart])) for first in range(apart)) - power

    low = -0.5 * float(np.log(gain.max())) - 6.0
    steps = np.arange(low, low + 14.0, 0.25)
    above = next((step for step in steps if excess(step) >= 0.0), None)
    return np.inf if above is None else float(np.exp(scipy.optimize.brentq(excess, above - 0.25, above, xtol=1e-3)))


def _chance_of_missing(p: int, over: int, under: int, thresholds: Array) -> Array:
    """Return the chance (centres, GAINS) that the largest root stays below each threshold."""
    return np.stack([np.searchsorted(roots, thresholds) / len(roots) for roots in _largest_roots(p, over, under)], axis=1)


@lru_cache(maxsize=8)
def _largest_roots(p: int, over: int, under: int) -> Array:
    """Return the largest roots (GAINS, draws) in rising order, for each gain."""
    random = np.random.default_rng(_SEED)
    count = max(DRAWS // p, 200)

    def draws(freedom: int) -> NDArray[np.complex128]:
        x = random.standard_normal((count, p, 2 * freedom)).view(np.complex128)
        return np.asarray(x / np.sqrt(2.0))

    backs = np.linalg.inv(np.linalg.cholesky(_covariance(draws(under))))
    own = _covariance(draws(over))
    roots = np.empty((len(GAINS), count))
    for k, gain in enumerate(GAINS):
        factors = backs.copy()
        factors[:, :, 0] *= np.sqrt(1.0 + gain)  # the first channel of the record is louder
        roots[k] = np.sort(np.linalg.eigvalsh(factors @ own @ factors.conj().transpose(0, 2, 1))[:, -1])
    return roots


def _covariance(x: NDArray[np.complex128]) -> NDArray[np.complex128]:
    return np.asarray(x @ x.conj().transpose(0, 2, 1) / x.shape[2])
