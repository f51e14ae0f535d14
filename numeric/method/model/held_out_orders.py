"""Choose the order of a PI-MOESP model by samples held back, where neither singular values nor an ARX model can tell it.

held_out_fits    the fit of the model of each order, made of the first part, to the part held back
order_left_open  the order of the best fit and those that fit nearly as well; None where no order fits better than a constant

A fit is 1 - |y - simulated y| / |y - mean of y| in channels of equal size, the initial state fitted. Simulating is what a model without a
disturbance's spectrum can be held to. The error of a fit to M numbers is that of a deviation, about 1 / sqrt(2 M) of |y - simulated y|:
orders whose misfit is within FAR such errors of the best are left open, and where the best is not as much better than a constant, beside
what n numbers of an initial state explain of noise, there is none. That describes what was tried, and is no test of a level.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....base.arrays import Array
from ....base.errors import InvalidData
from .past_inputs import pi_moesp
from .residuals import residual

KEPT_BACK = 3  # one part in so many is held back
MOST = 12  # orders tried
HELD = 1 << 14  # samples looked at, the last of the record
FAR = 2.0


@dataclass(frozen=True)
class OpenOrder:
    """The model of order `best` fits the samples held back best, those of orders `least` to `most` nearly as well; `fits` has the fit of
    each order tried, from 1 on, NaN where there is none."""

    best: int
    least: int
    most: int
    fits: tuple[float, ...]


def held_out_fits(y: Array, u: Array, block_rows: int) -> list[float]:
    """Return the fits of orders 1, 2, .. for y (N, p) and u (N, n_u); NaN where an order has no model."""
    y, u = y[-HELD:], u[-HELD:]
    cut = len(y) - len(y) // KEPT_BACK
    about = y[cut:] - y[cut:].mean(axis=0)
    spread = np.sqrt(np.mean(about**2, axis=0))
    scale = np.where(spread > 0, spread, 1.0)
    fits = []
    for n in range(1, MOST + 1):
        try:
            model = pi_moesp(y[:cut], u[:cut], order=n, block_rows=block_rows)
            rest = residual(y[cut:], u[cut:], model).r
        except (InvalidData, np.linalg.LinAlgError):
            fits.append(float("nan"))
            continue
        with np.errstate(over="ignore", invalid="ignore"):
            fits.append(float(1 - np.linalg.norm(rest / scale) / np.linalg.norm(about / scale)))
    return fits


def order_left_open(y: Array, u: Array, block_rows: int) -> OpenOrder | None:
    """Return the order that fits held-back samples best, with those nearly as good; None where none is better than the mean."""
    fits = np.array(held_out_fits(y, u, block_rows))
    held = max(min(len(y), HELD) // KEPT_BACK * y.shape[1], 1)
    orders = np.minimum(np.arange(1, MOST + 1), held)
    if not np.any(1 - fits < (1 - FAR / np.sqrt(2 * held)) * np.sqrt(1 - orders / held)):
        return None
    best = int(np.nanargmax(fits))
    near = np.flatnonzero(1 - fits <= (1 - fits[best]) * (1 + FAR / np.sqrt(2 * held)))
    return OpenOrder(best + 1, int(near[0]) + 1, int(near[-1]) + 1, tuple(fits.tolist()))
