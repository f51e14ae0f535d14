"""Compute what a model is whatever its state basis, and how it changes with A, B, C, D: Markov parameters, transfer function, poles.

All four matrices stand in one, T = [[A, B], [C, D]] (n + p, n + n_u), and derivatives are products with the model's two half responses,

    dG(z) = L(z) dT X(z),    L(z) = [C (z I - A)^-1, I],    X(z) = [(z I - A)^-1 B; I],
    dM(k) = sum_(i+j=k) L(i) dT X(j),    L(0) = [0, I], L(i) = [C A^(i-1), 0],    X(0) = [0; I], X(j) = [A^(j-1) B; 0],

as follows from the resolvent's derivative (z I - A)^-1 dA (z I - A)^-1. A change of the state basis changes none of them: its n^2 tangents
[[A W - W A, -W B], [C W, 0]] are the gauge. [MHR04] has the parametrisation that leaves the gauge out; here what is asked is invariant.

system_matrix, state_space       T of a model, and back
transfer                         G at angles
half_transfers, half_responses   L and X at angles, or over time
markov_jacobian, transfer_jacobian, pole_jacobian    derivatives by the entries of T in row order, (any, (n + p) (n + n_u))
off_gauge                        orthonormal directions (K, K - n^2) across the gauge
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ....base.arrays import Array
from .models import StateSpaceModel

ComplexArray = NDArray[np.complex128]


def system_matrix(model: StateSpaceModel) -> Array:
    """Return [[A, B], [C, D]]."""
    return np.block([[model.A, model.B], [model.C, model.D]])


def state_space(matrix: Array, n: int) -> StateSpaceModel:
    """Return the model of a system matrix with n states."""
    return StateSpaceModel(matrix[:n, :n], matrix[:n, n:], matrix[n:, :n], matrix[n:, n:])


def transfer(matrix: Array, n: int, angles: Array) -> ComplexArray:
    """Return G (M, p, n_u) at z = exp(i angle), which takes half the time of `half_transfers`."""
    A, B, C, D = matrix[:n, :n], matrix[:n, n:], matrix[n:, :n], matrix[n:, n:]
    states = np.linalg.solve(np.exp(1j * angles)[:, None, None] * np.eye(n) - A, B)
    return np.asarray(C @ states + D, dtype=np.complex128)


def half_transfers(matrix: Array, n: int, angles: Array) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return G (M, p, n_u), L (M, p, n + p) and X (M, n + n_u, n_u) at z = exp(i angle)."""
    A, B, C, D = matrix[:n, :n], matrix[:n, n:], matrix[n:, :n], matrix[n:, n:]
    p, n_u = D.shape
    resolvent = np.linalg.inv(np.exp(1j * angles)[:, None, None] * np.eye(n) - A)
    left = np.zeros((len(angles), p, n + p), dtype=np.complex128)
    left[:, :, :n], left[:, :, n:] = C @ resolvent, np.eye(p)
    right = np.zeros((len(angles), n + n_u, n_u), dtype=np.complex128)
    right[:, :n], right[:, n:] = resolvent @ B, np.eye(n_u)
    return np.asarray(C @ right[:, :n] + D, dtype=np.complex128), left, right


def half_responses(matrix: Array, n: int, count: int) -> tuple[Array, Array]:
    """Return L (count, p, n + p) and X (count, n + n_u, n_u) over time."""
    p, n_u = len(matrix) - n, matrix.shape[1] - n
    left, right = np.zeros((count, p, n + p)), np.zeros((count, n + n_u, n_u))
    left[:1, :, n:], right[:1, n:] = np.eye(p), np.eye(n_u)
    row, column = matrix[n:, :n], matrix[:n, n:]
    for k in range(1, count):
        left[k, :, :n], right[k, :n] = row, column
        row, column = row @ matrix[:n, :n], matrix[:n, :n] @ column
    return left, right


def transfer_jacobian(matrix: Array, n: int, angles: Array) -> ComplexArray:
    """Return the Jacobian (M p n_u, K) of G at each angle, with rows by angle, output, input."""
    _, left, right = half_transfers(matrix, n, angles)
    return np.asarray(np.einsum("mar,mcb->mabrc", left, right).reshape(left.shape[0] * left.shape[1] * right.shape[2], -1))


def markov_jacobian(matrix: Array, n: int, count: int) -> Array:
    """Return the Jacobian (count p n_u, K) of the first Markov parameters D, CB, CAB, .., with rows by parameter, output, input."""
    left, right = half_responses(matrix, n, count)
    jacobian = np.zeros((count, left.shape[1], right.shape[2], left.shape[2], right.shape[1]))
    for k in range(count):
        jacobian[k] = np.einsum("iar,icb->abrc", left[: k + 1], right[k::-1])
    return jacobian.reshape(-1, matrix.size)


def pole_jacobian(matrix: Array, n: int) -> tuple[ComplexArray, ComplexArray]:
    """Return the poles (n,), by falling modulus as `StateSpaceModel.poles`, and their derivatives (n, K).

    These are y* dA x / y* x with eigenvectors y, x on the left and right, and infinite where a pole is multiple and has no derivative.
    """
    values, vectors = np.linalg.eig(matrix[:n, :n])
    values = values.astype(np.complex128)
    order = np.lexsort((-values.imag, -values.real, -np.abs(values)))
    jacobian = np.zeros((n, *matrix.shape), dtype=np.complex128)
    try:
        duals = np.linalg.inv(vectors)
        jacobian[:, :n, :n] = np.einsum("ir,ci->irc", duals, vectors)
    except np.linalg.LinAlgError:
        jacobian[:, :n, :n] = np.inf
    return values[order], jacobian[order].reshape(n, matrix.size)


def off_gauge(matrix: Array, n: int) -> Array:
    """Return orthonormal columns (K, K - n^2) orthogonal to all changes of T by a change of the state basis, for a minimal model."""
    if n == 0:
        return np.eye(matrix.size)
    # tangents[i, j] is that of W with a one at (i, j): A W puts column i of [A; C] into column j, W [A, B] puts row j into row i.
    tangents, states = np.zeros((n, n, *matrix.shape)), np.arange(n)
    tangents[:, states, :, states] += matrix[:, :n].T
    tangents[states, :, states, :] -= matrix[:n]
    basis: Array = np.linalg.qr(tangents.reshape(n * n, -1).T, mode="complete")[0][:, n * n :]
    return basis
