"""What limits the recovery of v from r: zeros, delays and missing left-invertibility, in floats.

    FaultZeros            finite zeros, both delays, left-invertibility of x+ = A x + F v, r = C x + G v
    fault_zeros           computed by singular values with a stated tolerance
    finite_zeros          the roots of the invariant polynomials of the pencil [[qI - A, -F], [C, G]], left-invertible or
                          not. Where F = G = 0, and where there is no fault, they are the eigenvalues of A that C does
                          not show, though the transfer function, which is zero, has no zeros
    in_equal_units        F, C, G with faults and outputs in units in which they are of one size
    output_nulling        V*, the states from which some v keeps the residual zero for ever; where the system is
                          left-invertible its dimension counts the finite zeros
    delay, state known    least l such that r(0..l) determines v(0) when x(0) is known [SM69]
    delay, state unknown  least l <= n such that r(0..l) determines v(0) whatever x(0) is; None where there is none
                          [HP98], [MZ10]

Ranks in floats are opinions: a tall system that almost has a zero is reported without it. The exact branch decides
such questions for rational matrices.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....base.arrays import Array
from ..model.models import StateSpaceModel, lower_toeplitz, observability_matrix

TOLERANCE = 1e-9  # of the largest singular value, a million roundings: below it a rank is lost, an opinion as the head says


@dataclass(frozen=True)
class FaultZeros:
    """The record holds the finite zeros (complex), both delays (None where there is none), and whether the system is left-invertible."""

    zeros: NDArray[np.complex128]
    left_invertible: bool
    delay_known_state: int | None
    delay_unknown_state: int | None


def fault_zeros(A: Array, F: Array, C: Array, G: Array) -> FaultZeros:
    """Find the zeros and delays of A (n, n), F (n, m), C (p, n), G (p, m), in any units of faults and outputs.

    The states should be of comparable size.
    """
    F, C, G = in_equal_units(F, C, G)
    zeros = finite_zeros(A, F, C, G)
    known = _delay(A, F, C, G, state_known=True)
    if known is None:
        return FaultZeros(zeros, False, None, None)
    return FaultZeros(zeros, True, known, _delay(A, F, C, G, state_known=False))


def in_equal_units(F: Array, C: Array, G: Array) -> tuple[Array, Array, Array]:
    """Return F (n, m), C (p, n), G (p, m) with each fault's column of [F; G], then each output's row of [C G], divided by the power of two
    next to its size, so that nothing is rounded. No zero, delay or rank changes with the units; floats tell ranks of what is of one size.
    """
    faults = _units(np.vstack([F, G]))
    F, G = F / faults, G / faults
    outputs = _units(np.hstack([C, G]).T)[:, None]
    return F, C / outputs, G / outputs


def _units(columns: Array) -> Array:
    """Return for each column the power of two next to its size; 1 for a column that is zero."""
    sizes = np.linalg.norm(columns, axis=0)
    return np.asarray(np.exp2(np.round(np.log2(np.where(sizes > 0, sizes, 1.0)))))


def finite_zeros(A: Array, F: Array, C: Array, G: Array) -> NDArray[np.complex128]:
    """Return the finite zeros of the pencil, with their multiplicities, by ascending modulus: the motion on V* under zero output,
    modulo the states of V* that faults without an effect on the output reach from rest [TSH01] ch. 7.
    """
    W = output_nulling(A, F, C, G)
    k = W.shape[1]
    # A W + F K = W L and C W + G K = 0: L acts on V*, and is unique but for the silent faults W l = F v, G v = 0.
    left = np.block([[W, -F], [np.zeros((C.shape[0], k)), -G]])
    L = np.linalg.lstsq(left, np.vstack([A @ W, C @ W]), rcond=None)[0][:k]
    rest = _complement_of_reached(L, _null_space(left)[:k])
    zeros = np.array([_polished(zero, A, F, C, G) for zero in np.linalg.eigvals(rest.T @ L @ rest)], dtype=complex)
    return np.asarray(zeros[np.argsort(np.abs(zeros))])


def _polished(zero: complex, A: Array, F: Array, C: Array, G: Array) -> complex:
    """Return the zero after a step of Newton's method on the least singular value of the pencil, where that makes it smaller.

    The steps to V* lose digits where the entries of the pencil are of unlike size; the pencil itself has them all. At a multiple zero the
    slope is lost, and the step with it.
    """
    n, m = F.shape
    if len(C) < m:  # the pencil has no full column rank to lose
        return zero
    pencil = np.block([[zero * np.eye(n) - A, -F], [C, G]])
    left, values, right = np.linalg.svd(pencil)
    slope = np.vdot(left[:n, n + m - 1], right[n + m - 1, :n].conj())
    if abs(slope) <= TOLERANCE:
        return zero
    better = zero - values[n + m - 1] / slope
    pencil[:n, :n] += (better - zero) * np.eye(n)
    return better if np.linalg.svd(pencil, compute_uv=False)[n + m - 1] < values[n + m - 1] else zero


def _complement_of_reached(L: Array, B: Array) -> Array:
    """Return orthonormal columns orthogonal to im [B, L B, L^2 B, ...]: the largest subspace that L' keeps and B' annihilates."""
    rest = _null_space(B.T)
    while True:
        smaller = rest @ _null_space((L.T @ rest) - rest @ (rest.T @ L.T @ rest))
        if smaller.shape == rest.shape:
            return rest
        rest = smaller


def _null_space(matrix: Array) -> Array:
    """Return orthonormal columns that span the null space."""
    if 0 in matrix.shape:
        return np.eye(matrix.shape[1])
    _, values, right = np.linalg.svd(matrix)
    return np.asarray(right[int(np.sum(values > TOLERANCE * max(1.0, _largest(values)))) :].T)


def output_nulling(A: Array, F: Array, C: Array, G: Array) -> Array:
    """Return V* as orthonormal columns (n, k): the limit of V_0 = R^n, V_(j+1) = {x : some v has C x + G v = 0 and A x + F
    v in V_j}.
    """
    n = A.shape[0]
    normals = np.zeros((0, n))
    while True:
        left, values, _ = np.linalg.svd(np.vstack([normals @ F, G]))
        free = left[:, int(np.sum(values > TOLERANCE * max(1.0, _largest(values)))) :]
        constraints = np.vstack([normals @ A, C])
        _, strengths, right = np.linalg.svd(free.T @ constraints)
        # What cancels in the projection leaves rounding of the size of what was projected.
        rank = int(np.sum(strengths > TOLERANCE * max(1.0, float(np.linalg.norm(constraints)))))
        if rank == normals.shape[0]:
            return np.asarray(right[rank:].T)
        normals = right[:rank]


def _delay(A: Array, F: Array, C: Array, G: Array, *, state_known: bool) -> int | None:
    n, m = F.shape
    p, markov = len(C), StateSpaceModel(A, F, C, G).markov(n + 1)
    for delay in range(n + 1):
        toeplitz = lower_toeplitz(markov[: delay + 1])
        others = toeplitz[:, m:] if state_known else np.hstack([observability_matrix(A, C, delay + 1), toeplitz[:, m:]])
        # v(0) is determined iff its columns stay independent of each other and of all the rest.
        basis, values, _ = np.linalg.svd(others, full_matrices=False)
        basis = basis[:, values > TOLERANCE * max(1.0, _largest(values))]
        rest = toeplitz[:, :m] - basis @ (basis.T @ toeplitz[:, :m])
        floor = TOLERANCE * max(1.0, float(np.linalg.norm(toeplitz[:, :m])))
        if m == 0 or (p > 0 and int(np.sum(np.linalg.svd(rest, compute_uv=False) > floor)) == m):
            return delay
    return None


def _largest(values: Array) -> float:
    return float(values[0]) if values.size else 0.0
