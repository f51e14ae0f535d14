"""An implementation written from the pages of the audit alone, by the standard algorithms of textbooks; see README.md beside it.

It identifies by PI-MOESP (Verhaegen 1994): inputs of the past are the instruments, B and D follow by least squares over the simulated
record. Ranks are those of singular values, fault spaces are null spaces, zeros come from the staircase of Emami-Naeini and Van Dooren
(1982) and QZ.

    windows      a block Hankel matrix, transposed: a row holds s samples that follow each other
    factor       the triangular factor of such a matrix: small, with the same singular values and right singular vectors
    rounding     what the rounding of data and of Householder's reflections may make of singular values that are zero

It imports nothing of ours.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import linalg

Array = Any  # of float64; what numpy and scipy return has no narrower type in common
Four = tuple[Array, Array, Array, Array]

EPS = np.finfo(float).eps
SAFETY = 16.0  # over the few units of rounding that a product of reflections costs in practice (Higham 2002, 19.3)
CLEAR = 9.0  # a gap under noise: the rules promise exact singular values ten times the norm of the noise, which takes one of the ten away
LONGEST = 20  # windows tried where no order is known


# Arguments


def _signal(x: Any, name: str) -> Array:
    try:
        x = np.array(x, dtype=float)
    except TypeError as error:
        raise ValueError(f"{name} is no array of numbers: {error}") from error
    if x.ndim != 2 or not np.isfinite(x).all():
        raise ValueError(f"{name} must be a matrix of finite numbers, got shape {x.shape}")
    return x


def _record(y: Array, u: Array) -> tuple[Array, Array]:
    y, u = _signal(y, "y"), _signal(u, "u")
    if len(y) != len(u):
        raise ValueError(f"y has {len(y)} samples and u has {len(u)}")
    return y, u


def _quadruple(A: Array, B: Array, C: Array, D: Array) -> Four:
    A, B, C, D = _signal(A, "A"), _signal(B, "B"), _signal(C, "C"), _signal(D, "D")
    n, m, p = len(A), B.shape[1], len(C)
    if A.shape != (n, n) or B.shape != (n, m) or C.shape != (p, n) or D.shape != (p, m):
        raise ValueError(f"the shapes {A.shape}, {B.shape}, {C.shape}, {D.shape} are those of no system")
    return A, B, C, D


def _natural(number: int, name: str) -> int:
    if int(number) != number or number < 0:
        raise ValueError(f"{name} must be a whole number, got {number}")
    return int(number)


# Windows and ranks


def _sizes(x: Array) -> Array:
    top = np.abs(x).max(axis=0, initial=0)
    size = np.sqrt(np.mean((x / np.maximum(top, np.finfo(float).tiny)) ** 2, axis=0)) * top
    return np.where(size > 0, size, 1.0)


def _windows(x: Array, s: int) -> Array:
    return np.lib.stride_tricks.sliding_window_view(x, s, axis=0).transpose(0, 2, 1).reshape(len(x) - s + 1, -1)


def _factor(rows: Array) -> Array:
    return np.linalg.qr(rows, mode="r")


def _rounding(matrix: Array) -> float:
    return float(SAFETY * EPS * np.sqrt(max(matrix.shape[1], 1)) * np.linalg.norm(matrix))


def _rank(matrix: Array, tolerance: float | None = None) -> int:
    sigma = np.linalg.svd(matrix, compute_uv=False)
    return int(np.sum(sigma > (_rounding(matrix) if tolerance is None else tolerance)))


def window_ranks(r: Array, windows: int) -> list[int]:
    r, windows = _signal(r, "r"), _natural(windows, "windows")
    if len(r) - windows + 1 < r.shape[1] * windows:
        raise ValueError(f"{len(r)} samples cannot show full rank in {windows} block rows of {r.shape[1]} outputs")
    r = r / _sizes(r)
    return [_rank(_factor(_windows(r, s))) for s in range(1, windows + 1)]


def _gap(sigma: Array, floor: float) -> tuple[int, float]:
    """Return where the singular values drop most, and by what factor; what is below `floor` counts as the floor."""
    sigma = np.maximum(sigma, floor)
    ratios = sigma[:-1] / sigma[1:]
    k = int(np.argmax(ratios))
    return k + 1, float(ratios[k])


def _growth(x: Array, offset: int = 0) -> tuple[int, bool]:
    """Return by how many the rank grows with each window in the long run, and whether a floor of noise was seen."""
    N, p = x.shape
    longest = min(LONGEST, (N + 1) // (p + 1))
    if longest < 4:
        raise ValueError(f"{N} samples of {p} channels are too few")
    triangle = _factor(_windows(x / _sizes(x), longest))
    exact, clear = list[int](), list[int]()
    for s in range(1, longest + 1):
        part = triangle[: s * p, : s * p]
        sigma, floor = np.linalg.svd(part, compute_uv=False), _rounding(part)
        exact.append(int(np.sum(sigma > floor)))
        k, ratio = _gap(sigma, floor) if s * p > 1 else (1, 1.0)
        clear.append(k if ratio > CLEAR and sigma[k] < CLEAR * sigma[-1] else -(s**2))  # noise is flat below its gap; no step is like -s^2
    if exact[-1] < longest * p:
        steps = np.diff(exact)
        if len(set(steps[-3:])) > 1:
            raise ValueError("the rank has not settled within the windows that the record allows")
        return int(steps[-1]), False
    for last in range(longest, 3, -1):
        of_gap = clear[last - 4 : last]
        step = of_gap[-1] - of_gap[-2]
        if np.all(np.diff(of_gap) == step) and offset <= step < p:
            return step, True
    if longest < LONGEST:
        raise ValueError(f"all of {longest} windows have full rank: as many faults as outputs, or a longer lag")
    return p, True


def fault_dimension(r: Array) -> int:
    r = _signal(r, "r")
    return _growth(r)[0]


# Identification


def _observability(A: Array, C: Array, s: int) -> Array:
    blocks = [C]
    for _ in range(s - 1):
        blocks.append(blocks[-1] @ A)
    return np.vstack(blocks)


def identify(y: Array, u: Array, order: int, block_rows: int) -> Four:
    y, u = _record(y, u)
    n, s = _natural(order, "order"), _natural(block_rows, "block_rows")
    (N, p), m = y.shape, u.shape[1]
    columns = N - 2 * s + 1
    if n > p * (s - 1):
        raise ValueError(f"a window of {s} carries no order {n} with {p} outputs")
    if columns < 2 * s * m + max(n, 1):
        raise ValueError(f"{N} samples are too few for {s} block rows of past and future")
    of_y, of_u = _sizes(y), _sizes(u)
    y, u = y / of_y, u / of_u
    of_input = _windows(u, 2 * s)
    rows = np.hstack([of_input[:, s * m :], of_input[:, : s * m], _windows(y[s:], s)])
    L = _factor(rows).T
    known = 2 * s * m
    inputs = L[:known, :known]
    if m and np.linalg.svd(inputs, compute_uv=False)[-1] <= _rounding(inputs):
        raise ValueError("the input does not excite the window")
    left = L[known:, s * m :]
    noise_free = _rank(left, _rounding(L)) <= n
    left = left if noise_free else L[known:, s * m : known]
    U, sigma, _ = np.linalg.svd(left, full_matrices=False)
    if n and (len(sigma) < n or sigma[n - 1] <= _rounding(L)):
        raise ValueError(f"the data do not show {n} states")
    gamma = U[:, :n]
    if n and np.linalg.svd(gamma[:-p], compute_uv=False)[-1] < np.sqrt(EPS) * 1e-2:
        raise ValueError(f"a window of {s} is too short for these {n} states")
    A = np.linalg.lstsq(gamma[:-p], gamma[p:], rcond=None)[0]
    C = gamma[:p]
    B, D = _inputs_of_model(y, u, A, C)
    return A, B / of_u, of_y[:, None] * C, of_y[:, None] * D / of_u


def _inputs_of_model(y: Array, u: Array, A: Array, C: Array) -> tuple[Array, Array]:
    """Return B and D that fit the whole record best, by least squares, the initial state being free."""
    (N, p), m, n = y.shape, u.shape[1], len(A)
    regressors = np.zeros((N, p, n + n * m + p * m))
    state = np.hstack([np.eye(n), np.zeros((n, n * m))])
    each = np.eye(n)
    for k in range(N):
        regressors[k, :, : n + n * m] = C @ state
        regressors[k, :, n + n * m :] = np.kron(u[k], np.eye(p))
        state = A @ state
        state[:, n:] += np.kron(u[k], each)
    X = regressors.reshape(N * p, -1)
    size = np.linalg.norm(X, axis=0)
    size[size == 0] = 1.0
    if not np.isfinite(size).all():
        raise ValueError("the model found is too unstable to be simulated over this record")
    theta = np.linalg.lstsq(X / size, y.ravel(), rcond=None)[0] / size
    return theta[n : n + n * m].reshape(m, n).T, theta[n + n * m :].reshape(m, p).T


def residual(y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Array:
    y, u = _record(y, u)
    A, B, C, D = _quadruple(A, B, C, D)
    if y.shape[1] != len(C) or u.shape[1] != B.shape[1]:
        raise ValueError("the record has other channels than the model")
    driven, x, r = u @ B.T, np.zeros(len(A)), y - u @ D.T
    states = np.empty((len(y), len(A)))
    for k in range(len(y)):
        states[k] = x
        x = A @ x + driven[k]
    return r - states @ C.T


# The fault space


def _kernel(r: Array, s: int) -> tuple[Array, int, float]:
    """Return the left null space of the Hankel matrix of s block rows, a row a vector, the rank, and how far rounding may turn it."""
    factor = _factor(_windows(r, s))
    _, sigma, V = np.linalg.svd(factor)
    floor = _rounding(factor)
    rank = int(np.sum(sigma > floor))
    return V[rank:], rank, floor / sigma[rank - 1] if rank else EPS


def _equations(kernel: Array, A: Array, C: Array, s: int) -> Array:
    """Return the equations that each column [f; g] meets: every shift of its response is orthogonal to the kernel."""
    p, n = C.shape
    response = np.vstack([np.hstack([np.zeros((p, n)), np.eye(p)]), np.hstack([_observability(A, C, s), np.zeros((s * p, p))])])
    return np.vstack([kernel[:, j * p :] @ response[: (s - j) * p] for j in range(s)])


def fault_space(r: Array, A: Array, C: Array, n_v: int, block_rows: int) -> Array:
    r, A, C = _signal(r, "r"), _signal(A, "A"), _signal(C, "C")
    n_v, s = _natural(n_v, "n_v"), _natural(block_rows, "block_rows")
    p, n = C.shape
    if A.shape != (n, n) or r.shape[1] != p:
        raise ValueError(f"the shapes {r.shape}, {A.shape}, {C.shape} do not fit")
    if n_v > p:
        raise ValueError(f"{n_v} faults in {p} outputs have no fault space")
    if s < 1 or len(r) - s + 1 < p * s:
        raise ValueError(f"{len(r)} samples are too few for {s} block rows of {p} outputs")
    of_r = _sizes(r)
    r, C = r / of_r, C / of_r[:, None]
    _, T = linalg.matrix_balance(A, permute=False)
    of_x = np.diag(T) / max(np.linalg.norm(C @ T, 2), np.finfo(float).tiny)
    A, C = A / of_x[:, None] * of_x, C * of_x
    kernel, rank, turned = _kernel(r, s)
    growth = rank - (_kernel(r, s - 1)[1] if s > 1 else 0)
    if growth != n_v:
        raise ValueError(f"{n_v} faults do not show in these data: the rank grows by {growth} at {s} block rows")
    M = _equations(kernel, A, C, s)
    _, sigma, V = np.linalg.svd(np.vstack([M, np.zeros((n + p, n + p))]))
    response = _observability(A, C, s)
    cancelled = np.linalg.norm(np.abs(response) @ np.abs(A)) * sum(np.linalg.norm(np.linalg.matrix_power(A, k)) for k in range(s))
    span = int(np.sum(sigma > max(turned, EPS * SAFETY) * (1 + np.linalg.norm(response)) + EPS * SAFETY * cancelled))
    basis = V[span:].T
    return np.vstack([of_x[:, None] * basis[:n], of_r[:, None] * basis[n:]])


# The fault signal


def _toeplitz(A: Array, F: Array, C: Array, G: Array, s: int) -> Array:
    p, m = G.shape
    column = np.vstack([G, _observability(A, C, s - 1) @ F]) if s > 1 else G
    T = np.zeros((s * p, s * m))
    for j in range(s):
        T[j * p :, j * m : (j + 1) * m] = column[: (s - j) * p]
    return T


def reconstruct(r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Array:
    r = _signal(r, "r")
    A, F, C, G = _quadruple(A, F, C, G)
    x = _signal(np.reshape(x0, (-1, 1)), "x0").ravel()
    (N, p), n, m = r.shape, len(A), F.shape[1]
    if p != len(C) or len(x) != n:
        raise ValueError("r, the model and x0 do not fit")
    of_r, of_v = _sizes(np.hstack([C, G]).T), _sizes(np.vstack([F, G]))
    r, C, G, F = r / of_r, C / of_r[:, None], G / of_r[:, None] / of_v, F / of_v
    s = min(16 * (n + 1), N)  # short windows leave the state to a recursion that may grow
    T = _toeplitz(A, F, C, G, s)
    if m and _rank(T) - _rank(T[p:, m:]) < m:
        raise ValueError("the system is not left-invertible, or the record is shorter than its delay: the signal is not determined")
    gamma = _observability(A, C, s)
    inverse = np.linalg.pinv(T, rcond=SAFETY * EPS * np.sqrt(T.size))
    first = inverse[:m]
    seen, v, back = _windows(r, s) @ first.T, np.empty((N, m)), first @ gamma
    for k in range(N - s):
        v[k] = seen[k] - back @ x
        x = A @ x + F @ v[k]
    v[N - s :] = (inverse @ (r[N - s :].ravel() - gamma @ x)).reshape(s, m)
    return v / of_v


# Zeros


def _compressed(D: Array, tolerance: float) -> tuple[Array, int, float]:
    """Return an orthogonal U, the number of first rows of U.T D that are independent (others vanish), and their least singular value."""
    U, sigma, _ = np.linalg.svd(D)
    kept = sigma[sigma > tolerance]
    return U, len(kept), float(kept.min(initial=np.inf))


def _staircase(A: Array, B: Array, C: Array, D: Array, tolerance: float) -> tuple[Array, Array, Array, Array, list[int]]:
    """Return a system with the same finite zeros, D of full row rank, and the ranks of D on the way (Silverman's structure algorithm).

    What vanishes in exact arithmetic grows with each compression by the size of the system over the least singular value kept.
    """
    ranks, size = [], float(np.linalg.norm(np.block([[A, B], [C, D]])))
    while True:
        U, rank, least = _compressed(D, tolerance)
        ranks.append(rank)
        C, D = U.T @ C, U.T @ D
        V, constrained, of_states = _compressed(C[rank:].T, tolerance)
        tolerance = min(tolerance * max(1.0, size / min(least, of_states)), max(tolerance, np.sqrt(EPS) * size))
        if constrained == 0:
            return A, B, C[:rank], D[:rank], ranks
        V = np.hstack([V[:, constrained:], V[:, :constrained]])
        free = len(A) - constrained
        A, B, C = V.T @ A @ V, V.T @ B, C @ V
        C = np.vstack([C[:rank, :free], A[free:, :free]])
        D = np.vstack([D[:rank], B[free:]])
        A, B = A[:free, :free], B[:free]


def structure(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    A, F, C, G = _quadruple(A, F, C, G)
    m = F.shape[1]
    for _ in range(4):  # units of states, outputs and faults: a few rounds suffice where they are unlike
        for i in range(len(A)):
            out, into = np.linalg.norm(np.append(np.delete(A[:, i], i), C[:, i])), np.linalg.norm(np.append(np.delete(A[i], i), F[i]))
            unit = np.exp2(np.round(np.log2(into / out) / 2)) if into and out else 1.0
            A[:, i], C[:, i] = A[:, i] * unit, C[:, i] * unit
            A[i], F[i] = A[i] / unit, F[i] / unit
        of_v = _sizes(np.vstack([F, G]))
        F, G = F / of_v, G / of_v
        of_r = _sizes(np.hstack([C, G]).T)
        C, G = C / of_r[:, None], G / of_r[:, None]
    tolerance = _rounding(np.block([[A, F], [C, G]])) * max(len(A), 1)
    A, F, C, G, ranks = _staircase(A, F, C, G, tolerance)
    normal_rank = ranks[-1]
    orders = [order for order, more in enumerate(np.diff([0, *ranks])) for _ in range(more)]
    A, C, F, G, _ = _staircase(A.T, C.T, F.T, G.T, tolerance)
    A, C, F, G = A.T, C.T, F.T, G.T
    n = len(A)
    _, _, V = np.linalg.svd(np.hstack([C, G]))
    null = V[len(C) :].T if len(C) else np.eye(n)
    zeros = linalg.eigvals(np.hstack([A, F]) @ null, null[:n]) if n else np.empty(0)
    return {
        "normal_rank": normal_rank,
        "finite_zeros": [complex(z) for z in zeros],
        "infinite_zero_orders": orders,
        "left_invertible": normal_rank == m,
    }


# From outputs and inputs


def count_faults(y: Array, u: Array, order: int) -> int:
    y, u = _record(y, u)
    n, (N, p), m = _natural(order, "order"), y.shape, u.shape[1]
    if (p + m + 1) * (n + 3) > N:
        raise ValueError(f"{N} samples are too few for order {n}")
    together, noisy = _growth(np.hstack([y, u]), m)
    if together < m or (noisy and together == m + p):
        raise ValueError("undecided")
    return int(together - m)


def identified_fault_space(y: Array, u: Array, order: int, n_v: int) -> tuple[Array, Array, Array]:
    y, u = _record(y, u)
    n, n_v, (N, p), m = _natural(order, "order"), _natural(n_v, "n_v"), y.shape, u.shape[1]
    s = n + 2
    if n_v > p or 4 * (p + m) * s > N:
        raise ValueError(f"{N} samples of {p} outputs are too few for order {n} and {n_v} faults")
    A, _, C, _ = identify(y, u, n, s)
    of_y, of_u = _sizes(y), _sizes(u)
    factor = _factor(_windows(np.hstack([u / of_u, y / of_y]), s))
    _, sigma, V = np.linalg.svd(factor)
    rank = s * (m + n_v) + n
    if n_v < p and sigma[rank - 1] < CLEAR * sigma[rank]:
        raise ValueError("undecided")
    kernel = V[rank:].reshape(-1, s, m + p)[:, :, m:].reshape(-1, s * p)
    C = C / of_y[:, None]
    _, sigma, V = np.linalg.svd(np.vstack([_equations(kernel, A, C, s), np.zeros((n + p, n + p))]))
    k, ratio = _gap(sigma, max(sigma[0], 1) * SAFETY * EPS)
    if n_v == p:
        k, ratio = 0, CLEAR
    if ratio < CLEAR:
        raise ValueError("undecided")
    basis = V[k:].T
    return A, of_y[:, None] * C, np.vstack([basis[:n], of_y[:, None] * basis[n:]])
