"""This is the published way to the fault space for many residuals at once: `toeplitz_factorisation` for a stack.

    toeplitz_factorisations   orthonormal columns for each residual
    conditions_of             the conditions of `toeplitz_factorisation`, for a stack
    least_directions          the right singular vectors that belong to the least singular values of a matrix

The answers are those of `toeplitz_factorisation` to the rounding error. The time of that goes into all singular vectors of conditions of
some 70 columns, of which the last few are needed. These few are found in two steps. M'M has eigenvalues that are squared, so that its least
eigenvectors mix among themselves; but together they span the least directions of M to the rounding error, as long as a few more are taken
than asked for and the next eigenvalue is not small. M restricted to that span has a few columns, and its singular vectors have nothing
squared: that is the Rayleigh-Ritz step [GVL13]. Where the next eigenvalue is small, the singular vectors of M itself are computed.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import lapack

from ...base.arrays import Array

# Directions beyond those asked for, and the part of the largest eigenvalue by which the next one lies above them: the span is then known to
# 1/DISTANCE times the rounding error, 2e-13.
MORE, DISTANCE = 4, 1e-3


def toeplitz_factorisations(r: Array, A: Array, C: Array, *, block_rows: int, rank: int, n_z: int) -> Array:
    """Return orthonormal columns (k, n + p, n_z) for residuals r (k, p, N), A (k, n, n) and C (k, p, n), N large enough for a matrix of
    `block_rows` to have more columns than rows."""
    (k, p, n), s = C.shape, block_rows
    if rank == p * s:
        return np.broadcast_to(np.eye(n + p), (k, n + p, n + p))
    windows = r.shape[2] - s + 1
    hankel = np.empty((k, s, p, windows))
    for i in range(s):
        hankel[:, i] = r[:, :, i : i + windows]
    factors = np.linalg.qr(hankel.reshape(k, s * p, windows).swapaxes(1, 2), mode="r")
    U = np.linalg.svd(factors)[2][:, :rank].swapaxes(1, 2)
    solutions = least_directions(conditions_of(U.reshape(k, s, p, rank), A, C), n_z)
    g = U[:, -p:] @ solutions[:, -n - rank : -n]
    return np.asarray(np.linalg.qr(np.concatenate([solutions[:, -n:], g], axis=1))[0])


def conditions_of(U: Array, A: Array, C: Array) -> Array:
    """Return the conditions (k, (s - 1)(s + 1) p, s rank + n) for U (k, s, p, rank), A (k, n, n), C (k, p, n)."""
    k, s, p, rank = U.shape
    n = A.shape[1]
    found = np.zeros((k, (s - 1) * (s + 1), p, s * rank + n))
    shifted, last = found[:, : (s - 1) * s].reshape(k, s - 1, s, p, -1), found[:, (s - 1) * s :]
    for j in range(s):
        shifted[:, :, j, :, j * rank : (j + 1) * rank] = U[:, :-1]
    for j in range(1, s):
        shifted[:, j - 1 :, j - 1, :, j * rank : (j + 1) * rank] = -U[:, j:]
    block = C
    for j in reversed(range(s - 1)):
        last[:, j, :, j * rank : (j + 1) * rank] = -U[:, -1]
        last[:, j, :, s * rank :] = block
        block = block @ A
    return found.reshape(k, -1, s * rank + n)


def least_directions(matrices: Array, count: int) -> Array:
    """Return orthonormal columns (k, n, count): the right singular vectors of `matrices` (k, m, n) that belong to the `count` least of n
    singular values, those that are missing where m < n being zero. The largest comes first."""
    k, _, n = matrices.shape
    taken = count + MORE
    if taken >= n:
        return np.asarray(np.linalg.svd(matrices)[2][:, -count:].swapaxes(1, 2))
    spans, apart = np.empty((k, n, taken)), np.empty(k, dtype=bool)
    for i, gram in enumerate(matrices.swapaxes(1, 2) @ matrices):
        values, spans[i] = _least_eigenvectors(gram, taken)
        # No eigenvalue is larger than a sum of the sizes in a row.
        apart[i] = values[taken] - values[count - 1] > DISTANCE * np.abs(gram).sum(axis=1).max()
    found = spans @ np.linalg.svd(matrices @ spans, full_matrices=False)[2][:, -count:].swapaxes(1, 2)
    for i in np.flatnonzero(~apart).tolist():
        found[i] = np.linalg.svd(matrices[i])[2][-count:].T
    return np.asarray(found)


def _least_eigenvectors(gram: Array, count: int) -> tuple[Array, Array]:
    """Return the `count` + 1 least eigenvalues, ascending, of a symmetric matrix and orthonormal eigenvectors of the first `count`.

    By LAPACK's own functions: those of scipy and numpy compute all vectors, or the few by bisection, in twice the time and more.
    """
    n = len(gram)
    reflectors, diagonal, beside, scales, info = lapack.dsytrd(gram, lower=1)
    assert info == 0, info
    found, values, vectors, info = lapack.dstemr(diagonal, np.append(beside, 0.0), 2, 0.0, 0.0, 1, count + 1)
    assert info == 0 and found == count + 1, info
    columns = np.asfortranarray(vectors[:, :count])
    columns[1:], _, info = lapack.dormqr("L", "N", reflectors[1:, :-1], scales, columns[1:], n * 32)
    assert info == 0, info
    return values[: count + 1], columns
