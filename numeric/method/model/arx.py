"""Fit the ARX model A(q) y(k) = B(q) u(k) + e(k) of high order to the windows alone: plant, spectra of disturbance and input.

With A(q) = I + A_1 q^-1 + .. + A_h q^-h and B(q) = B_0 + .. + B_h q^-h, the plant is G = A^-1 B and the disturbance has the spectrum
A^-1 S A^-*, S the covariance of the innovations e: whatever the colour of the disturbance (a fault and noise), both are consistent as h
grows slowly with the record [LW92]. Two choices by the criterion of [BT94], which is AIC with its bias in small samples taken off: h, and
the order of the autoregression that stands for the input.

S gets a floor: FLOOR relative to the outputs, as if they were known to half the digits of a float, and RANGE relative to S. Data without
noise then have a definite answer, and weights of 100 dB in range leave five digits to the normal equations that use them.

Arx         coefficients, covariance, order; `plant`, `weight`, `disturbance` at angles; `markov` of plant and noise model
fitted_arx  the model of the best order
input_spectrum   of u at angles, (M, n_u, n_u)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack, lstsq, solve_triangular

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from .arx_windows import ArxWindows
from .compression import EPS
from .sequential_qr import triangular

ComplexArray = NDArray[np.complex128]

FLOOR = EPS
RANGE = EPS ** (2 / 3)
HUGE = 1e150  # squares of larger numbers come near the end of what floats can hold
EXCITED = 1e-13  # as of PI-MOESP: what a direction of the inputs must exceed, relative to its length and times the rows


@dataclass(frozen=True, eq=False)
class Arx:
    """The model has coefficients outputs (h+1, p, p) with outputs[0] = I and inputs (h+1, p, n_u), and the covariance (p, p) of e.

    All are in the units of the data that they were fitted to. `rows` is the number of windows, and `freedom` is the number of degrees of
    freedom left in each equation.
    """

    outputs: Array
    inputs: Array
    covariance: Array
    rows: int
    freedom: int

    @property
    def order(self) -> int:
        """h, the number of lags."""
        return len(self.outputs) - 1

    def plant(self, angles: Array) -> ComplexArray:
        """Return G (M, p, n_u) at exp(i angle)."""
        return _quotient(polynomial(self.outputs, angles), polynomial(self.inputs, angles))

    def weight(self, angles: Array) -> ComplexArray:
        """Return the inverse A* S^-1 A (M, p, p) of the disturbance's spectrum, for which no matrix is inverted twice."""
        whitened = _quotient(np.linalg.cholesky(self.covariance), polynomial(self.outputs, angles))
        return adjoint(whitened) @ whitened

    def disturbance(self, angles: Array) -> ComplexArray:
        """Return the spectrum (M, p, p) of y - G u."""
        coloured = _quotient(polynomial(self.outputs, angles), np.linalg.cholesky(self.covariance))
        return coloured @ adjoint(coloured)

    def markov(self, count: int) -> tuple[Array, Array]:
        """Return the first `count` Markov parameters of the plant (count, p, n_u) and of the noise model A^-1 S^1/2 (count, p, p)."""
        p, n_u = self.inputs.shape[1:]
        joint = np.zeros((count, p, n_u + p))
        given = min(count, len(self.inputs))
        joint[:given, :, :n_u] = self.inputs[:given]
        joint[:1, :, n_u:] = np.linalg.cholesky(self.covariance)
        for k in range(1, count):
            for i in range(1, min(k, self.order) + 1):
                joint[k] -= self.outputs[i] @ joint[k - i]
        return joint[:, :, :n_u], joint[:, :, n_u:]

    def radius(self) -> float:
        """Return the largest modulus of a root of det A(q), 0 where A is constant."""
        if self.order == 0:
            return 0.0
        return float(np.max(np.abs(companion_roots(-np.hstack(list(self.outputs[1:]))))))

    def scaled(self, y: Array, u: Array) -> Arx:
        """Return the model of the record whose outputs are multiplied by `y` (p,) and whose inputs by `u` (n_u,)."""
        outputs = self.outputs * y[:, None] / y
        return Arx(outputs, self.inputs * y[:, None] / u, self.covariance * np.outer(y, y), self.rows, self.freedom)


def adjoint(matrices: ComplexArray) -> ComplexArray:
    """Return the conjugate transposes of stacked matrices."""
    return np.conj(np.swapaxes(matrices, -1, -2))


def _quotient(left: NDArray[Any], right: NDArray[Any]) -> ComplexArray:
    """Return left^-1 right."""
    return np.asarray(np.linalg.solve(left, right), dtype=np.complex128)


def polynomial(coefficients: Array, angles: Array) -> ComplexArray:
    """Return the values (M, a, b) of sum_k coefficients[k] z^-k at z = exp(i angle)."""
    powers = np.exp(-1j * np.outer(angles, np.arange(len(coefficients))))
    return np.tensordot(powers, coefficients, axes=1)


def fitted_arx(windows: ArxWindows, least: int = 0) -> Arx:
    """Fit the ARX model in channels of unit deviation whose order, `least` or more, has the least criterion.

    Raises InvalidData where u does not excite all windows of lags + 1 samples, or the windows are too few.
    """
    check_excitation(windows)
    p, n_u = windows.p, windows.n_u
    sizes = [windows.regressors(order) for order in range(min(least, windows.lags), windows.lags + 1)]
    columns, covariance, coefficients = _best(windows.scaled, sizes, p, windows.rows)
    order = (columns - n_u) // (p + n_u)
    blocks = coefficients[:, n_u:].reshape(p, order, p + n_u).transpose(1, 0, 2)
    outputs = np.concatenate([np.eye(p)[None], -blocks[:, :, :p]])
    inputs = np.concatenate([coefficients[None, :, :n_u], blocks[:, :, p:]])
    return Arx(outputs, inputs, covariance, windows.rows, windows.rows - columns)


def input_spectrum(windows: ArxWindows, angles: Array) -> ComplexArray:
    """Return the spectrum (M, n_u, n_u) of u in channels of unit deviation, by the autoregression of the best order."""
    lags, n_u = windows.lags, windows.n_u
    chosen = np.concatenate([windows.inputs(lag) for lag in [*range(1, lags + 1), 0]])
    factor = triangular(windows.scaled[:, chosen])
    sizes = [order * n_u for order in range(lags + 1)]
    columns, covariance, coefficients = _best(factor, sizes, n_u, windows.rows)
    blocks = coefficients.reshape(n_u, columns // n_u, n_u).transpose(1, 0, 2)
    coloured = _quotient(polynomial(np.concatenate([np.eye(n_u)[None], -blocks]), angles), np.linalg.cholesky(covariance))
    return coloured @ adjoint(coloured)


def check_excitation(windows: ArxWindows) -> None:
    """Raise InvalidData where the inputs' windows, less their means, do not have full rank, or squares overflow."""
    largest = float(max(np.max(np.abs(windows.factor)), *(np.max(np.abs(mean)) for mean in windows.means)))
    if not largest < HUGE:
        raise InvalidData(f"the signals are so large (about {largest:.1g}) that their squares overflow: choose other units")
    columns = np.concatenate([windows.inputs(lag) for lag in range(windows.lags + 1)])
    inputs = windows.factor[:, columns]
    lengths = np.linalg.norm(inputs, axis=0)
    # Rounding is relative to the signals as they are, which may stand far from zero.
    whole = np.sqrt(lengths**2 + windows.windows * np.max([mean[columns] ** 2 for mean in windows.means], axis=0))
    seen = 0
    if np.all(lengths > 0):
        seen = int(np.linalg.matrix_rank(inputs / lengths, tol=len(columns) * EXCITED * float(np.max(whole / lengths, initial=1.0))))
    if seen < len(columns):
        raise InvalidData(
            f"u does not excite enough: its windows of {windows.lags + 1} samples span {seen or 'fewer than all'} of {len(columns)} "
            "directions (a constant, equal inputs, or a sum of few sines?); use a richer input, "
            "fewer lags, or leave out inputs that never change"
        )


def _best(factor: Array, sizes: Sequence[int], targets: int, rows: int) -> tuple[int, Array, Array]:
    """Return, of the regressions of the last `targets` columns on the first k, k in `sizes`, that of the least criterion.

    What is returned are k, the covariance of its errors with its floor, and its coefficients (targets, k).
    """
    last = len(factor) - targets
    best, chosen, covariance = np.inf, -1, np.zeros((targets, targets))
    for k in sizes:
        if rows <= k + targets + 1:
            break
        tail = factor[k:, last:]
        errors = tail.T @ tail / rows
        parameters = k * targets + targets * (targets + 1) / 2
        fit = rows * np.linalg.slogdet(errors + _floor(errors))[1]
        criterion = fit + 2 * parameters * rows / (rows - k - targets - 1)
        if criterion < best:
            best, chosen, covariance = criterion, k, errors * rows / (rows - k)
    if chosen < 0:
        raise InvalidData(
            f"{counted(rows, 'window')} {'is' if rows == 1 else 'are'} too few for an autoregression of "
            f"{counted(targets, 'channel')} on {counted(sizes[0], 'regressor')}: record more"
        )
    return chosen, covariance + _floor(covariance), _solved(factor[:chosen, :chosen], factor[:chosen, last:]).T


def _floor(covariance: Array) -> Array:
    size = len(covariance)
    result: Array = (FLOOR + RANGE * np.trace(covariance) / size) * np.eye(size)
    return result


def _solved(upper: Array, right: Array) -> Array:
    """Return upper^-1 right, or the shortest least-squares solution where the triangle is singular to rounding, as without noise."""
    if not len(upper):
        return np.zeros((0, right.shape[1]))
    level = len(upper) * EPS
    reciprocal, _ = lapack.dtrcon(upper)
    if reciprocal > level:
        return np.asarray(solve_triangular(upper, right, check_finite=False))
    return np.asarray(lstsq(upper, right, cond=level, check_finite=False)[0])


def companion_roots(blocks: Array) -> NDArray[np.complex128]:
    """Return the modes (h p,) of x(k) = sum_j A_j x(k-j), for [A_1 .. A_h] (p, h p)."""
    p, width = blocks.shape
    companion = np.eye(width, k=-p)
    companion[:p] = blocks
    return np.asarray(np.linalg.eigvals(companion), dtype=np.complex128)
