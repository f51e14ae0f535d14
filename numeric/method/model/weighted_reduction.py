"""Find a model of given order nearest to a plant on the unit circle, under a weight: minimise over A, B, C, D

    N / M  sum over M angles of  tr( W (G_h - G) P (G_h - G)* ),     G = C (z I - A)^-1 B + D,

W the inverse spectrum of what disturbs the outputs, P the spectrum of the input. With G_h and W from an ARX model of high order this is
the likelihood but for a constant, so its minimum is as good as the data allow, asymptotically [W89].

With the half transfers L, X of `invariants` the error changes by L dT X, so the normal equations are sums of Kronecker products,
H = N / M sum Re( (L* W L) kron (X P X*) ): one product of matrices (n + p)^2 x M and M x (n + n_u)^2, whatever the number of channels. They
are solved across the gauge, damped [M63] on their own diagonal; a step that makes A unstable or the sum larger is taken back.

W has a range of 40 to 60 dB between fault and noise: descents crawl along curved valleys of the cost, and for two of twelve systems of the
study all starts end in a higher one. So the range is let in by and by: a ladder of weights (Phi + e I)^-1, e falling by RUNG from the
mean power of the spectrum Phi of the disturbance to below its least eigenvalue, and then W. Each rung starts where the last one ended.

Reduction            what is minimised: angles, plant, weight, input spectrum, N; `cost`, `normal_equations`, `input_matrices`,
                     `output_matrices`
circle               M angles between 0 and pi
ladder               the reductions from the flat weight to the true one
descend              the damped Gauss-Newton method
arrived              so many of its descents that nothing is gained
balanced             the same model in internally balanced coordinates
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from ....base.arrays import Array
from .arx import adjoint
from .invariants import half_transfers, off_gauge, transfer

ComplexArray = NDArray[np.complex128]

RUNG = 100.0
"""Factor between the weights of neighbouring rungs. `python benchmarks/at_the_bound.py --calibrate ladder` compares 10, 100 and no ladder:
the first two give the same errors; without a ladder one system of the study in ten is far off."""
DAMPING = 1e-3  # of the first step, and its bounds: steps find their own
LEAST_DAMPING, MOST_DAMPING = 1e-9, 1e10  # between those of a step of Newton and of no step at all, to rounding
# Most steps of one of the descents to a minimum, and the relative gain of the last one; and most descents, a budget of time.
END, DESCENTS = (100, 1e-8), 30
REFUSED, ACCEPTED = 6.0, 8.0  # factors by which damping rises after a refused step and falls after an accepted one


def circle(count: int) -> Array:
    """Return the midpoints (count,) of equal parts of (0, pi): sums over them integrate what is smooth and even on the circle."""
    return (np.arange(count) + 0.5) * np.pi / count


@dataclass(frozen=True, eq=False)
class Reduction:
    """What is minimised has angles (M,), plant (M, p, n_u), weight (M, p, p), spectrum (M, n_u, n_u) of the input, and N samples."""

    angles: Array
    plant: ComplexArray
    weight: ComplexArray
    spectrum: ComplexArray
    samples: float

    @property
    def _share(self) -> float:
        return self.samples / len(self.angles)

    def cost(self, matrix: Array, n: int) -> float:
        """Return the sum at T = `matrix`."""
        return self._cost(self.plant - transfer(matrix, n, self.angles))

    def _cost(self, error: ComplexArray) -> float:
        return float(self._share * np.sum((self.weight @ error @ self.spectrum * error.conj()).real))

    def normal_equations(self, matrix: Array, n: int) -> tuple[Array, Array, float]:
        """Return half the Hessian (K, K) of the linearised sum, half its falling gradient (K,), and the sum, at T = `matrix`."""
        response, left, right = half_transfers(matrix, n, self.angles)
        weighted, driven = adjoint(left) @ self.weight, self.spectrum @ adjoint(right)
        error = self.plant - response
        slope = np.sum((weighted @ error @ driven).real, axis=0)
        return self._share * _kronecker_sum(weighted @ left, right @ driven), self._share * slope.ravel(), self._cost(error)

    def information(self, matrix: Array, n: int) -> Array:
        """Return the normal equations' matrix alone: the Fisher information of T where W and P are the true spectra."""
        _, left, right = half_transfers(matrix, n, self.angles)
        return self._share * _kronecker_sum(adjoint(left) @ self.weight @ left, right @ self.spectrum @ adjoint(right))

    def input_matrices(self, A: Array, C: Array) -> Array:
        """Return T with these A, C and the best B and D, which solve a linear problem."""
        n, p, n_u = len(A), len(C), self.plant.shape[2]
        matrix = np.zeros((n + p, n + n_u))
        matrix[:n, :n], matrix[n:, :n] = A, C
        _, left, _ = half_transfers(matrix, n, self.angles)
        weighted = adjoint(left) @ self.weight
        slope = np.sum((weighted @ self.plant @ self.spectrum).real, axis=0)
        solution = scipy.linalg.lstsq(_kronecker_sum(weighted @ left, self.spectrum), slope.ravel(), check_finite=False)[0]
        matrix[:, n:] = solution.reshape(n + p, n_u)
        return matrix

    def output_matrices(self, A: Array, B: Array) -> Array:
        """Return T with these A, B and the best C and D, which solve a linear problem."""
        n, p, n_u = len(A), self.plant.shape[1], B.shape[1]
        matrix = np.zeros((n + p, n + n_u))
        matrix[:n] = np.hstack([A, B])
        _, _, right = half_transfers(matrix, n, self.angles)
        driven = self.spectrum @ adjoint(right)
        slope = np.sum((self.weight @ self.plant @ driven).real, axis=0)
        solution = scipy.linalg.lstsq(_kronecker_sum(self.weight, right @ driven), slope.ravel(), check_finite=False)[0]
        matrix[n:] = solution.reshape(p, n + n_u)
        return matrix

    def scaled(self, y: Array, u: Array, samples: float) -> Reduction:
        """Return the same for outputs and inputs times these factors (p,) and (n_u,), and for so many samples."""
        weight, spectrum = self.weight / np.outer(y, y), self.spectrum * np.outer(u, u)
        return Reduction(self.angles, self.plant * y[:, None] / u, weight, spectrum, samples)


def _kronecker_sum(left: ComplexArray, right: ComplexArray) -> Array:
    """Return the real part of sum_m left[m] (a, a) kron right[m]^T (b, b), as (a b, a b)."""
    a, b = left.shape[1], right.shape[1]
    rows, columns = left.reshape(len(left), -1).T, np.swapaxes(right, 1, 2).reshape(len(right), -1)
    product = rows.real @ columns.real - rows.imag @ columns.imag
    return np.ascontiguousarray(product.reshape(a, a, b, b).transpose(0, 2, 1, 3)).reshape(a * b, a * b)


def ladder(true: Reduction, disturbance: ComplexArray) -> Iterator[Reduction]:
    """Yield reductions from a weight whose floor is about the mean power of the disturbance's spectrum (M, p, p) to the true one."""
    size = float(np.trace(disturbance.mean(axis=0)).real) / disturbance.shape[1]
    least = float(np.linalg.eigvalsh(disturbance).min())
    floor = size / np.sqrt(RUNG)
    while floor > max(least, size * np.finfo(np.float64).eps):
        yield replace(true, weight=np.linalg.inv(disturbance + floor * np.eye(disturbance.shape[1])))
        floor /= RUNG
    yield true


def descend(problem: Reduction, matrix: Array, n: int, steps: int, tolerance: float) -> tuple[Array, float]:
    """Return T (n + p, n + n_u) with a stable A, and its cost, after `steps` steps or when one gains less than `tolerance` of it."""
    current = balanced(matrix, n)
    hessian, slope, cost = problem.normal_equations(current, n)
    damping = DAMPING
    for _ in range(steps):
        across = off_gauge(current, n)
        curvature, gradient = across.T @ hessian @ across, across.T @ slope
        scale = across.T @ ((np.diag(hessian) + np.finfo(np.float64).eps * np.trace(hessian))[:, None] * across)
        accepted = False
        while not accepted and damping < MOST_DAMPING:
            step = _solved(curvature + damping * scale, gradient)
            trial = current + (across @ step).reshape(current.shape)
            accepted = bool(np.any(step)) and spectral_radius(trial[:n, :n]) < 1 and problem.cost(trial, n) < cost
            damping = max(damping / ACCEPTED, LEAST_DAMPING) if accepted else damping * REFUSED
        if not accepted:
            break
        before, current = cost, trial
        hessian, slope, cost = problem.normal_equations(current, n)
        if before - cost <= tolerance * before:
            break
    return current, cost


def arrived(problem: Reduction, matrix: Array, n: int) -> tuple[Array, float]:
    """Return the minimum T (n + p, n + n_u) to which descents lead, and its cost: each begins where the last one has ended, in balanced
    coordinates and with little damping, until one gains less than the last part END[1] of the cost, or DESCENTS are made.

    The floor between two valleys is curved, and a descent that has taken to small steps may stop there: of one that ended 4 units above
    its minimum the next went on.
    """
    end, cost = descend(problem, matrix, n, *END)
    for _ in range(DESCENTS - 1):
        before = cost
        end, cost = descend(problem, end, n, *END)
        if before - cost <= END[1] * before:
            break
    return end, cost


def _solved(matrix: Array, right: Array) -> Array:
    """Solve for a step, which is zero where the matrix is singular: more damping follows."""
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        return np.zeros_like(right)


def spectral_radius(A: Array) -> float:
    """Return the largest modulus of an eigenvalue, 0 without states."""
    return float(np.max(np.abs(np.linalg.eigvals(A)), initial=0.0))


def balanced(matrix: Array, n: int) -> Array:
    """Return a stable system matrix in internally balanced coordinates [M81], or as it is where they cannot be computed."""
    if n == 0:
        return matrix
    B, C = matrix[:n, n:], matrix[n:, :n]
    # Gramians of poles nearer to the circle than that could not be computed, and coordinates need not be balanced to the last digit.
    A = matrix[:n, :n] * min(1.0, (1 - np.sqrt(np.finfo(np.float64).eps)) / max(spectral_radius(matrix[:n, :n]), 1e-300))
    try:
        reach, observe = (_root(scipy.linalg.solve_discrete_lyapunov(*pair)) for pair in ((A, B @ B.T), (A.T, C.T @ C)))
        left, values, right = np.linalg.svd(observe.T @ reach)
    except (np.linalg.LinAlgError, ValueError):
        return matrix
    if values[-1] <= np.sqrt(np.finfo(np.float64).eps) * values[0]:
        return matrix
    into, back = (observe @ left / np.sqrt(values)).T, reach @ right.T / np.sqrt(values)
    result: Array = (
        scipy.linalg.block_diag(into, np.eye(len(matrix) - n)) @ matrix @ scipy.linalg.block_diag(back, np.eye(matrix.shape[1] - n))
    )
    return result


def _root(gramian: Array) -> Array:
    values, vectors = np.linalg.eigh((gramian + gramian.T) / 2)
    root: Array = vectors * np.sqrt(np.maximum(values, 0.0))
    return root
