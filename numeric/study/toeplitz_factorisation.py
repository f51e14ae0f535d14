"""This is the published way to the fault space: make the range of R_s into that of a Toeplitz matrix of the model.

    toeplitz_factorisation   n_z columns [f; g] for a given rank of R_s
    U                        the left singular vectors of R_s that belong to the rank: block rows U_1 .. U_s of p rows each
    Q_j                      coefficients of block column j: U Q_j is block column j of T_s(f, g)
    conditions               U_i Q_j = 0 above the diagonal, U_i Q_j = U_(i+1) Q_(j+1) along it, U_s Q_j = C A^(s-1-j) f in the last row

The least singular vectors of these conditions give f and, through g = U_s Q_s, the column. Without noise this is problem (11), that is
N_s T_s(z) = 0. With noise it differs from the null rows' answer wherever there are more conditions than unknowns, because it is the length
of the coefficients Q that is fixed and not that of [f; g]. It grows with (p s^2)^3 and knows no noise: the library's own estimators are in
`noisy_fault_space`; this one is kept to be compared with. Source: [G25] sections IV, V.
"""

from __future__ import annotations

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidData
from ..method.model.models import observability_matrix
from ..method.ranks.sample_windows import hankel_factor
from ..method.space.estimate import orthonormal


def toeplitz_factorisation(r: Array, A: Array, C: Array, *, block_rows: int, rank: int, n_z: int) -> Array:
    """Return orthonormal columns (n + p, n_z) for the residual r (N, p), `rank` the rank that R_s is taken to have, s = `block_rows` >= 2.

    Where the rank leaves no null row, every column is a solution: all of R^(n+p), whatever n_z. Raises InvalidData for a rank or an n_z
    that cannot be, and for fewer samples than block rows.
    """
    (p, n), s = C.shape, block_rows
    if s < 2 or not 0 < rank <= p * s:
        raise InvalidData(f"block_rows, rank: got {s}, {rank}; 2 block rows or more and a rank from 1 to p block_rows are needed")
    if not 0 < n_z <= n + p:
        raise InvalidData(f"n_z: got {n_z}; from 1 to n + p = {n + p} columns can be asked for")
    if len(r) < s:
        raise InvalidData(f"r: got {len(r)} samples; {s} block rows need {s} or more")
    if rank == p * s:
        return np.eye(n + p)
    U = np.linalg.svd(hankel_factor(r, s))[0][:, :rank]
    conditions = _conditions(U.reshape(s, p, rank), A, C)
    if conditions.shape[0] > conditions.shape[1]:
        conditions = np.asarray(np.linalg.qr(conditions, mode="r"))
    solutions = np.linalg.svd(conditions)[2][-n_z:].T
    return orthonormal(np.vstack([solutions[-n:], U[-p:] @ solutions[-n - rank : -n]]))


def _conditions(U: Array, A: Array, C: Array) -> Array:
    """Return the conditions as a matrix that multiplies the column of Q_1, .., Q_s and f; U is (s, p, rank)."""
    s, p, rank = U.shape
    n = A.shape[0]
    inner = np.zeros((s - 1, s, p, s + 1, rank))  # block row i, block column j, outputs, coefficient Q_j
    last = np.zeros((s - 1, p, s * rank + n))
    for j in range(s):
        inner[:, j, :, j] = U[:-1]
        inner[j:, j, :, j + 1] = -U[j + 1 :]
    for j in range(s - 1):
        last[j, :, j * rank : (j + 1) * rank] = -U[-1]
    last[:, :, -n:] = observability_matrix(A, C, s - 1).reshape(s - 1, p, n)[::-1]
    shifted = inner[:, :, :, :s].reshape((s - 1) * s * p, s * rank)
    return np.vstack([np.hstack([shifted, np.zeros((len(shifted), n))]), last.reshape(-1, s * rank + n)])
