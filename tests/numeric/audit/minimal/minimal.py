"""A least implementation with numpy alone, as somebody would write who has the page of the checks and nothing of ours: MOESP without noise.

identify, residual, window_ranks, fault_dimension    as the page describes them
"""

from __future__ import annotations

from typing import Any

import numpy as np

TINY = 1e-11  # of the largest singular value, channels in unit mean square


def _finite(*arrays: Any) -> None:
    if not all(np.all(np.isfinite(one)) for one in arrays):
        raise ValueError("entries that are not finite")


def _hankel(signal: Any, rows: int) -> Any:
    if len(signal) < rows * (signal.shape[1] + 1) - 1:
        raise ValueError("too few samples")
    return np.vstack([signal[k : len(signal) - rows + 1 + k].T for k in range(rows)])


def _sizes(signal: Any) -> Any:
    size = np.sqrt(np.mean(signal**2, axis=0))
    return np.where(size > 0, size, 1.0)


def _rank(M: Any) -> int:
    values = np.linalg.svd(M, compute_uv=False)
    return int(np.sum(values > TINY * values[0]))


def window_ranks(r: Any, windows: int) -> list[int]:
    _finite(r)
    return [_rank(_hankel(r / _sizes(r), s)) for s in range(1, windows + 1)]


def fault_dimension(r: Any) -> int:
    ranks = window_ranks(r, 9)
    return ranks[8] - ranks[7]


def residual(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    _finite(y, u, A, B, C, D)
    if y.shape[1] != len(C):
        raise ValueError("more or fewer outputs than C has rows")
    x, left = np.zeros(len(A)), np.zeros(y.shape)
    for k in range(len(u) if len(u) == len(y) else -1):
        left[k] = y[k] - C @ x - D @ u[k]
        x = A @ x + B @ u[k]
    if len(u) != len(y):
        raise ValueError("unequal lengths")
    return left


def identify(y: Any, u: Any, order: int, block_rows: int) -> Any:
    _finite(y, u)
    p, n_u, s = y.shape[1], u.shape[1], block_rows
    if len(y) != len(u):
        raise ValueError("unequal lengths")
    units, inputs = _sizes(y), _sizes(u)
    Y, U = _hankel(y / units, s), _hankel(u / inputs, s)
    if Y.shape[1] < len(Y) + len(U) or _rank(U) < len(U) or _rank(np.vstack([U, Y])) != len(U) + order:
        raise ValueError("the record does not determine a model of that order")
    left, values, _ = np.linalg.svd(Y - Y @ np.linalg.pinv(U) @ U)
    observability = left[:, :order] * np.sqrt(values[:order])
    if _rank(observability[:-p]) < order:
        raise ValueError("the window does not determine A")
    A = np.linalg.lstsq(observability[:-p], observability[p:], rcond=None)[0]
    C = observability[:p]
    states, rows = np.hstack([np.eye(order), np.zeros((order, order * n_u))]), []
    for w in u / inputs:
        rows.append(np.hstack([C @ states, np.kron(w, np.eye(p))]))
        states = A @ states
        states[:, order:] += np.kron(w, np.eye(order))
    found = np.linalg.lstsq(np.vstack(rows), (y / units).ravel(), rcond=None)[0][order:]
    B, D = found[: order * n_u].reshape(n_u, order).T, found[order * n_u :].reshape(n_u, p).T
    return A, B / inputs, C * units[:, None], D * units[:, None] / inputs
