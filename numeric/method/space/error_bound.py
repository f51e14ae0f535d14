"""This bounds how far rounding may have turned a fault space found from exact ranks: a bound a posteriori, direction by direction.

With R = U S V' the scaled Hankel matrix, N = U_2' its null rows, M their conditions, W the solutions of M W = 0 and Q the
orthonormal basis of B W that is answered (B: back to the given coordinates), to first order

    dN = N E V_1 S_1^-1 U_1'         the null rows turn towards weak signals most [W72]
    dM W = dN T_s(W)                 but only what a solution sends there matters
    dQ = -(I - Q Q') B M^+ dM W R^-1 off the span of Q, B W = Q R

    E              error of R: as large as its smallest singular values show, and at least the rounding of a QR factorisation
    first          the largest dQ over all E of that size: the smaller of two norms
    rounding       what the floats of A, C, M and W add, with the matrices' sizes and not their condition numbers
    second order   the denominators change by a share eta at most; beyond a quarter the bound says nothing, which is 1

Wedin's bound with the least gap and the largest condition number instead is some 10^4 times as large.
"""

from __future__ import annotations

import numpy as np

from ....base.arrays import Array
from ..ranks.sample_windows import EPS, ObservedCoordinates
from .estimate import condition_maps, kernel_conditions

# Rounding errors of a product or a factorisation in units of EPS times its size.
ROUNDINGS = 10.0
# Operations up to which the sharper of the two norms is computed.
SHARP = 1e9


def fault_space_error_bound(coordinates: ObservedCoordinates, left: Array, values: Array, rank: int, floor: float, columns: Array) -> float:
    """Return the bound on the sine of the largest angle to the true space, at most 1, the ranks taken as right.

    `left` (p s, p s) and `values` (p s,) of R_s, `rank` its rank, `floor` the size of rounding in `values`, `columns`
    (n + p, n_z) the orthonormal solutions in the observed coordinates.
    """
    A, C = coordinates.A, coordinates.C
    n, p = A.shape[0], C.shape[0]
    s, n_z = len(left) // p, columns.shape[1]
    rows = left[:, rank:].T.reshape(-1, s, p)
    M = kernel_conditions(rows, A, C).reshape(-1, n + p)
    if n_z == 0:
        return 0.0
    _, strengths, right = np.linalg.svd(np.linalg.qr(M, mode="r"))
    kept = right[: n + p - n_z].T
    least = float(strengths[n + p - n_z - 1]) if n_z < n + p else np.inf
    inverse = (kept / strengths[: n + p - n_z] ** 2) @ (kept.T @ M.T)
    # In units of the answer's own size: those of the data may be of any size.
    answered = coordinates.back(columns)
    peak = float(np.max(np.abs(answered)))
    answered = answered / peak
    Q, R = np.linalg.qr(answered)
    unit = columns @ np.linalg.inv(R)
    moved = coordinates.back(inverse) / peak
    moved = moved - Q @ (Q.T @ moved)
    largest = float(np.linalg.norm(moved, 2))

    error = max(float(values[rank]), floor)
    turns = (left[:, :rank].T @ (condition_maps(A, C, s) @ unit)) / values[:rank, None]  # (s, rank, n_z)
    first = error * largest * float(np.linalg.norm(turns.reshape(-1, n_z), 2)) if rank else 0.0
    q = len(rows)
    tall, wide = (n + p) * n_z, q * rank
    if rank and tall * wide * min(tall, wide) <= SHARP:
        # Over all E of this Frobenius norm: a linear map of the (q, rank) entries of N E V_1.
        every = np.tensordot(moved.reshape(n + p, q, s), turns, axes=(2, 0)).transpose(0, 3, 1, 2)
        whole = max(float(np.linalg.norm(values[rank:])), floor * np.sqrt(min(q, rank)))
        matrix = every.reshape(tall, wide)
        square = matrix @ matrix.T if tall < wide else matrix.T @ matrix
        first = min(first, whole * float(np.sqrt(np.linalg.norm(square, 2))))

    size = float(np.linalg.norm(unit, 2))
    wrong = np.hypot(_recursion_error(rows, coordinates), ROUNDINGS * EPS * float(np.linalg.norm(M)))
    stretched = float(np.linalg.norm(answered)) * float(np.linalg.norm(np.linalg.inv(R), 2))
    rounding = largest * wrong * size + ROUNDINGS * EPS * (n + 1) * stretched
    turned = error / float(values[rank - 1]) if rank else 0.0
    eta = turned + (np.sqrt(s) * turned + wrong) / least
    return float(min((first + rounding) / (1 - 2 * eta) ** 2, 1.0)) if eta < 0.25 else 1.0


def _recursion_error(rows: Array, coordinates: ObservedCoordinates) -> float:
    """Return the bound in Frobenius norm on the rounding in the conditions of `rows` (q, s, p): that of A and C, given and transformed, and
    of every step of the recursion, carried on by the powers of A."""
    A, C, T = coordinates.A, coordinates.C, coordinates.T
    n = A.shape[0]
    if n == 0:
        return 0.0
    inverse = np.linalg.inv(T)
    of_A = ROUNDINGS * EPS * (np.abs(T) @ np.abs(inverse @ A @ T) @ np.abs(inverse) + np.abs(A))
    of_C = ROUNDINGS * EPS * (np.abs(C @ T) @ np.abs(inverse) + np.abs(C))
    s = rows.shape[1]
    states = kernel_conditions(rows, A, C)[:, :, :n]
    made = [float(np.linalg.norm(np.abs(states[:, k]) @ of_A + np.abs(rows[:, k]) @ of_C)) for k in range(s)]
    powers, power = [1.0], np.eye(n)
    for _ in range(s - 1):
        power = power @ A
        powers.append(float(np.linalg.norm(power, 2)))
    # Condition k holds X_(k+1), the sum of what was made at j > k and carried j - k - 1 steps.
    carried = [sum(made[j] * powers[j - k - 1] for j in range(k + 1, s)) for k in range(s)]
    return float(np.linalg.norm(carried))
