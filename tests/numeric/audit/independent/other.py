"""An implementation, written from the pages of the audit alone, by other algorithms than octave.m and our own; see README.md beside it.

It identifies by difference equations: least squares where the data are free of noise, inputs of the past as instruments and
output-error steps where they are not, then the realisation of Ho and Kalman (1966). Ranks of windows are those of QR with exchanges;
elsewhere a row of the Hankel matrix is new or depends on those before it, as in the echelon form of Guidorzi (1975), and dependent rows
give a basis of the kernel as polynomials. Fault spaces come from dividing these by qI - A, fault signals from the backward recursion of
dynamic programming, zeros from Wonham's subspaces V* and R*.

    factor       the triangle of a QR factorisation without exchanges: entry j, j is the distance of row j from the rows before it
    new          a row of the Hankel matrix that lies off the span of those before it; the channels that are new in the long run are counted
    polynomial   a list of rows n_0, n_1, ...: n_0 r(k) + n_1 r(k+1) + ... = 0 for all k

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
CLEAR = 9.0  # the rules promise exact singular values ten times the norm of the noise, which takes one of the ten away
LONGEST = 20  # windows tried where no order is known


# Arguments


def _matrix(x: Any, name: str, shape: tuple[int | None, int | None] = (None, None)) -> Array:
    try:
        x = np.array(x, dtype=float)
    except TypeError as error:
        raise ValueError(f"{name} holds no numbers: {error}") from error
    if x.ndim != 2 or not np.all(np.isfinite(x)) or any(want not in (None, got) for want, got in zip(shape, x.shape, strict=True)):
        raise ValueError(f"{name} must be finite and of shape {shape}, got {x.shape}")
    return x


def _record(y: Array, u: Array) -> tuple[Array, Array]:
    y = _matrix(y, "y")
    return y, _matrix(u, "u", (len(y), None))


def _system(A: Array, B: Array, C: Array, D: Array) -> Four:
    D = _matrix(D, "D")
    p, m = D.shape
    A = _matrix(A, "A")
    n = len(A)
    return _matrix(A, "A", (n, n)), _matrix(B, "B", (n, m)), _matrix(C, "C", (p, n)), D


def _count(number: int, name: str) -> int:
    if number != int(number) or number < 0:
        raise ValueError(f"{name} must be 0, 1, 2, ..., got {number}")
    return int(number)


def _scaled(x: Array) -> tuple[Array, Array]:
    """Return the channels divided by their largest entries, and these."""
    size = np.abs(x).max(axis=0, initial=0.0)
    size[size == 0] = 1.0
    return x / size, size


# Rows that are new


def _triangle(rows: Array) -> Array:
    return np.linalg.qr(rows, mode="r")


def _stacked(x: Array, first: int, lags: int, length: int) -> Array:
    """Return the samples at first, first + 1, ... of `lags` successive times, a row for each of `length` starts."""
    return np.hstack([x[first + j : first + j + length] for j in range(lags)]) if lags else np.empty((length, 0))


def _hankel(x: Array, s: int) -> Array:
    return _stacked(x, 0, s, len(x) - s + 1)


def _floor(matrix: Array) -> float:
    return float(SAFETY * EPS * np.sqrt(max(matrix.shape[1], 1)) * np.linalg.norm(matrix))


def _split(matrix: Array, tolerance: float | None = None) -> tuple[Array, Array]:
    """Return orthonormal bases of the span of the rows and of the null space, by QR with exchanges."""
    height, width = matrix.shape
    if not height or not width:
        return np.empty((width, 0)), np.eye(width)
    Q, R, _ = linalg.qr(matrix.T, pivoting=True)
    k = int(np.sum(np.abs(np.diag(R)) > (_floor(matrix) if tolerance is None else tolerance)))
    return Q[:, :k], Q[:, k:]


def _rank(matrix: Array, tolerance: float | None = None) -> int:
    if not matrix.size:
        return 0
    R = linalg.qr(matrix, mode="r", pivoting=True)[0]
    return int(np.sum(np.abs(np.diag(R)) > (_floor(matrix) if tolerance is None else tolerance)))


def window_ranks(r: Array, windows: int) -> list[int]:
    r, _ = _scaled(_matrix(r, "r"))
    windows, (N, p) = _count(windows, "windows"), r.shape
    if N - windows + 1 < p * windows:
        raise ValueError(f"{N} samples have too few windows of {windows} for {p} outputs")
    return [_rank(_triangle(_hankel(r, s))) for s in range(1, windows + 1)]


def _echelon(triangle: Array, p: int, floor: float) -> tuple[list[int | None], list[tuple[Array, float]]]:
    """Return for each channel the first window in which it is not new (None: always new), and the polynomials of those that are not.

    Rows that depend on others are left out of what follows: the triangle is made again of those that are new. With each polynomial comes
    the factor by which rounding turns it more than it moves the rows.
    """
    degree: list[int | None] = [None] * p
    new: list[int] = []
    polynomials, before = [], [np.inf] * p
    Q = np.empty((len(triangle), 0))
    for j in range(triangle.shape[1]):
        window, channel = divmod(j, p)
        if degree[channel] is not None:
            continue
        column = triangle[:, j]
        rest = column - Q @ (Q.T @ column)
        rest = rest - Q @ (Q.T @ rest)
        distance = float(np.linalg.norm(rest))
        of_new = Q.T @ triangle[:, new]
        coefficients = linalg.solve_triangular(of_new, Q.T @ column) if new else np.empty(0)
        # A change of `floor` in all rows makes smaller distances vanish. Those of a new channel fade with the windows, but not at once.
        vanishes = distance <= floor * np.hypot(1.0, np.linalg.norm(coefficients)) and CLEAR * distance <= before[channel]
        before[channel] = distance
        if not vanishes:
            Q = np.hstack([Q, rest[:, None] / distance])
            new.append(j)
            continue
        degree[channel] = window
        row = np.zeros(j // p * p + p)
        row[j] = 1.0
        row[new] = -coefficients
        enlarged = 1.0 / float(np.linalg.svd(triangle[:, [*new, j]], compute_uv=False)[-2]) if new else 1.0
        polynomials.append((row.reshape(-1, p) / np.linalg.norm(row), max(1.0, enlarged * float(np.linalg.norm(triangle)))))
    return degree, polynomials


def _new_channels(x: Array, inputs: int) -> tuple[int, bool]:
    """Return how many channels of x behind the inputs are new in the long run, and whether noise was seen."""
    N, p = x.shape
    longest = min(LONGEST, (N + 1) // (p + 1))
    if longest < 4:
        raise ValueError(f"{N} samples of {p} channels are too few")
    triangle = _triangle(_hankel(_scaled(x)[0], longest))
    degree, _ = _echelon(triangle, p, _floor(triangle))
    found = [one for one in degree if one is not None]
    if found:
        if max(found) > longest - 3:
            raise ValueError("a channel is found dependent at the longest windows only: a longer record may show more")
        if any(one is not None for one in degree[:inputs]):
            raise ValueError("the input does not excite the windows")
        return p - inputs - len(found), False
    # Every channel is new, be it by noise. Distances of noise are alike; whether all are noise or none cannot be told.
    told = set()
    for last in np.abs(np.diag(triangle)).reshape(longest, p)[-3:, inputs:]:
        distances = np.sort(last)[::-1]
        ratios = distances[:-1] / distances[1:]
        k = int(np.argmax(ratios)) if len(ratios) else 0
        told.add(k + 1 if len(ratios) and ratios[k] > CLEAR > distances[k + 1] / distances[-1] else p - inputs)
    if len(told) > 1:
        raise ValueError("undecided")
    if told == {p - inputs} and longest < LONGEST:
        raise ValueError(f"every channel is new in all of {longest} windows, and the record allows no more")
    return told.pop(), True


def fault_dimension(r: Array) -> int:
    return _new_channels(_matrix(r, "r"), 0)[0]


# Identification


def _difference_equation(y: Array, u: Array, n: int, lags: int, instruments: bool) -> tuple[Array, float, float]:
    """Return the coefficients of y(k) by y(k-1), .. and u(k), .., what they leave, and what rounding may; as instruments, past inputs."""
    m = u.shape[1]
    past = 2 * lags + 1 if instruments else lags
    length = len(y) - past
    outputs = np.hstack([y[past - j : past - j + length] for j in range(1, lags + 1)])
    inputs = np.hstack([u[past - j : past - j + length] for j in range(lags + 1)])
    X, Y = np.hstack([outputs, inputs]), y[past:]
    k = n + m * (lags + 1)
    if length < k:
        raise ValueError(f"{len(y)} samples are too few for {lags} lags and order {n}")
    if _rank(_triangle(inputs)) < m * (lags + 1):
        raise ValueError("the input does not excite the window")
    if instruments:
        Z = np.hstack([u[past - j : past - j + length] for j in range(past + 1)])
        if Z.shape[1] < k:
            raise ValueError("the window holds too few inputs to stand for the states")
        Q = np.linalg.qr(Z)[0]
        X, Y = Q.T @ X, Q.T @ Y
    R = _triangle(np.hstack([X, Y]))
    U, sigma, V = np.linalg.svd(R[:, : (width := X.shape[1])], full_matrices=False)
    if k > width or (k and (len(sigma) < k or sigma[k - 1] <= _floor(R))):
        raise ValueError(f"the data do not show {n} states in {lags} lags")
    theta = V[:k].T @ (U[:, :k].T @ R[:, width:] / sigma[:k, None])
    left = float(np.linalg.norm(R[:, width:] - R[:, :width] @ theta))
    return theta, left, _floor(R) * max(1.0, float(np.linalg.norm(theta)))


def _impulse_response(theta: Array, p: int, m: int, lags: int, length: int) -> Array:
    by_outputs = theta[: p * lags].reshape(lags, p, p).transpose(0, 2, 1)
    by_inputs = theta[p * lags :].reshape(lags + 1, m, p).transpose(0, 2, 1)
    response = np.zeros((length, p, m))
    for k in range(length):
        response[k] = by_inputs[k] if k <= lags else 0.0
        for j in range(1, min(k, lags) + 1):
            response[k] += by_outputs[j - 1] @ response[k - j]
    return response


def _realised(response: Array, free: Array, n: int, s: int) -> Four:
    """Return A, B, C, D of order n from an impulse response and a free response (2 s samples each): Ho and Kalman's way."""
    p, m = response.shape[1:]
    columns = [response[1 + j : 1 + j + s].reshape(s * p, m) for j in range(s - 1)]
    columns += [free[j : j + s].reshape(s * p, -1) for j in range(s)]
    U, sigma, _ = np.linalg.svd(np.hstack(columns), full_matrices=False)
    if n and (len(sigma) < n or sigma[n - 1] <= EPS * sigma[0]):
        raise ValueError(f"the data do not show {n} states")
    gamma = U[:, :n]
    if n and np.linalg.svd(gamma[:-p], compute_uv=False)[-1] < 1e-2 * np.sqrt(EPS):
        raise ValueError(f"a window of {s} is too short for these {n} states")
    return np.linalg.lstsq(gamma[:-p], gamma[p:], rcond=None)[0], gamma.T @ response[1 : s + 1].reshape(s * p, m), gamma[:p], response[0]


def identify(y: Array, u: Array, order: int, block_rows: int) -> Four:
    y, u = _record(y, u)
    n, s = _count(order, "order"), _count(block_rows, "block_rows")
    (N, p), m = y.shape, u.shape[1]
    lags = s - 1
    if lags < 1 or n > p * lags:
        raise ValueError(f"a window of {s} carries no order {n} with {p} outputs")
    if N - 2 * s + 1 < 2 * s * m + max(n, 1):
        raise ValueError(f"{N} samples are too few for {s} block rows of past and future")
    (y, of_y), (u, of_u) = _scaled(y), _scaled(u)
    theta, left, floor = _difference_equation(y, u, n, lags, instruments=False)
    if noisy := left > floor:
        theta, _, _ = _difference_equation(y, u, n, lags, instruments=True)
    response = _impulse_response(theta, p, m, lags, 2 * s)
    free = np.zeros((2 * s, p, 0))
    if not noisy:
        forced = np.array([sum((response[j] @ u[k - j] for j in range(k + 1)), np.zeros(p)) for k in range(2 * s)])
        free = (y[: 2 * s] - forced)[:, :, None]
    A, B, C, D = _realised(response, free, n, s)
    if noisy and n:
        A, B, C, D = _output_error(y, u, A, B, C, D)
    return A, B / of_u, of_y[:, None] * C, of_y[:, None] * D / of_u


def _output_error(y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Four:
    """Return the model whose simulated output is nearest to y, from this one, by Gauss-Newton steps of least norm (bases move freely)."""
    (N, p), m, n = y.shape, u.shape[1], len(A)
    best, x0 = None, np.zeros(n)
    for _ in range(30):
        X = _driven(A, u @ B.T, x0)
        size = np.linalg.norm(E := y - X @ C.T - u @ D.T)
        if not np.isfinite(size) or (best is not None and size >= best[0] * (1 - 1e-9)):
            break
        best = size, (A, B, C, D)
        inputs = np.hstack([X, u])
        # A change of entry i, j of [A B] enters the states along the unit vector i with signal j; one of [C D] enters the outputs directly.
        by_state = np.array([_driven(A, signal[:, None] * unit, np.zeros(n)) @ C.T for unit in np.eye(n) for signal in inputs.T])
        by_output = np.array([signal[:, None] * unit for unit in np.eye(p) for signal in inputs.T])
        by_start = np.array([_driven(A, np.zeros((N, n)), unit) @ C.T for unit in np.eye(n)])
        J = np.concatenate([by_state, by_output, by_start]).reshape(-1, N * p).T
        step = np.linalg.lstsq(J, E.ravel(), rcond=1e-9)[0]
        AB, CD = step[: n * (n + m)].reshape(n, n + m), step[n * (n + m) : (n + p) * (n + m)].reshape(p, n + m)
        A, B, C, D, x0 = A + AB[:, :n], B + AB[:, n:], C + CD[:, :n], D + CD[:, n:], x0 + step[-n:]
    return best[1] if best else (A, B, C, D)


def _driven(A: Array, driven: Array, x0: Array) -> Array:
    """Return the states x(k+1) = A x(k) + driven(k), by sums over 1, 2, 4, ... samples in place of a recursion."""
    x = np.vstack([np.reshape(x0, (1, -1)), driven[:-1]])
    power, d = A.T, 1
    while d < len(x) and power.any():
        x = np.vstack([x[:d], x[d:] + x[:-d] @ power])
        power, d = power @ power, 2 * d
    return x


def residual(y: Array, u: Array, A: Array, B: Array, C: Array, D: Array) -> Array:
    y, u = _record(y, u)
    A, B, C, D = _system(A, B, C, D)
    if y.shape[1] != len(C) or u.shape[1] != B.shape[1]:
        raise ValueError("the record has other channels than the model")
    return y - u @ D.T - _driven(A, u @ B.T, np.zeros(len(A))) @ C.T


# The fault space


def _divided(polynomial: Array, A: Array, C: Array) -> Array:
    """Return the rows [M_i n_i] and [R A^i 0] of n(q) C = M(q) (qI - A) + R: [f; g] explains r where all of them vanish on it.

    R is zero where the data show every free response; where they do not, what f starts must be hidden from it, too.
    """
    M, rows = np.zeros(len(A)), []
    for row in polynomial[::-1]:
        rows.append(np.concatenate([M, row]))
        M = row @ C + M @ A
    for _ in range(len(A)):
        rows.append(np.concatenate([M, np.zeros(len(C))]))
        M = M @ A
    return np.array(rows)


def fault_space(r: Array, A: Array, C: Array, n_v: int, block_rows: int) -> Array:
    r = _matrix(r, "r")
    C = _matrix(C, "C", (r.shape[1], None))
    p, n = C.shape
    A = _matrix(A, "A", (n, n))
    n_v, s = _count(n_v, "n_v"), _count(block_rows, "block_rows")
    if n_v > p:
        raise ValueError(f"{n_v} faults in {p} outputs have no fault space")
    if s < 1 or len(r) - s + 1 < p * s:
        raise ValueError(f"{len(r)} samples have too few windows of {s} for {p} outputs")
    r, of_r = _scaled(r)
    triangle = _triangle(_hankel(r, s))
    degree, polynomials = _echelon(triangle, p, _floor(triangle))
    if degree.count(None) != n_v:
        raise ValueError(f"{n_v} faults were told, but {degree.count(None)} outputs are free of the others in {s} block rows")
    if n == 0:
        of_x = np.ones(0)
    else:
        A, T = linalg.matrix_balance(A, permute=False)
        of_x = np.diag(T)
        C = C / of_r[:, None] * of_x
        size = max(np.abs(C).max(), np.finfo(float).tiny)
        C, of_x = C / size, of_x / size
    rows = [_divided(polynomial, A, C) for polynomial, _ in polynomials]
    if not rows:
        return np.eye(n + p)
    turned = max(enlarged for _, enlarged in polynomials) * EPS * SAFETY
    M = np.vstack(rows)
    powers = [np.linalg.matrix_power(A, i) for i in range(s + n)]
    carried = np.linalg.norm(np.vstack([np.eye(p, n), *(C @ one for one in powers[:s])]))
    cancelled = np.linalg.norm(np.abs(M[:, :n]) @ np.abs(A)) * sum(np.linalg.norm(one) for one in powers)
    basis = _split(M, turned * (1 + carried) + EPS * SAFETY * cancelled)[1]
    return np.vstack([of_x[:, None] * basis[:n], of_r[:, None] * basis[n:]])


# The fault signal


def reconstruct(r: Array, A: Array, F: Array, C: Array, G: Array, x0: Array) -> Array:
    A, F, C, G = _system(A, F, C, G)
    p, m, n = len(C), F.shape[1], len(A)
    r = _matrix(r, "r", (None, p))
    x = _matrix(np.reshape(x0, (1, -1)), "x0", (1, n))[0]
    of_v = _scaled(np.vstack([F, G]))[1]
    of_r = _scaled(np.hstack([C, G]).T)[1]
    r, C, F, G = r / of_r, C / of_r[:, None], F / of_v, G / of_r[:, None] / of_v
    # The least cost of what is still to come is |S x - z|^2; S settles as one goes back in time, z does not.
    S, z = np.zeros((n, n)), np.zeros(n)
    gains: list[Any] = [None] * len(r)
    rule: Any = None
    settled = False
    for k in range(len(r) - 1, -1, -1):
        if not settled:
            rule, S_before = _last_step(A, F, C, G, S), S
            S = rule[2]
            settled = bool(np.linalg.norm(S - S_before) <= 4 * EPS * np.linalg.norm(S))
        by_target, by_state, _, target, determined = rule
        seen = np.concatenate([r[k], z])
        gains[k] = by_target @ seen, by_state
        z = target @ seen
    if m and not (len(r) and determined):
        raise ValueError("the system is not left-invertible, or the record is shorter than its delay: the signal is not determined")
    v = np.empty((len(r), m))
    for k, (constant, by_state) in enumerate(gains):
        v[k] = constant - by_state @ x
        x = A @ x + F @ v[k]
    return v / of_v


def _last_step(A: Array, F: Array, C: Array, G: Array, S: Array) -> tuple[Array, Array, Array, Array, bool]:
    """Return how the best v and the cost before it follow from the cost |S x - z|^2 after it.

    These are P and L of v = P [r; z] - L x, then S, the map from [r; z] to z, and whether v is determined.
    """
    n, m = len(A), F.shape[1]
    of_v, of_x = np.vstack([G, S @ F]), np.vstack([C, S @ A])
    U, sigma, V = np.linalg.svd(of_v)
    k = int(np.sum(sigma > _floor(np.vstack([G, np.abs(S) @ np.abs(F)])))) if m else 0
    inverse = V[:k].T @ (U[:, :k].T / sigma[:k, None])
    rest = U[:, k:].T
    Q, R = np.linalg.qr(rest @ of_x)
    S, target = np.zeros((n, n)), np.zeros((n, rest.shape[1]))
    sign = np.where(np.diag(R) < 0, -1.0, 1.0)
    S[: len(R)], target[: len(R)] = R * sign[:, None], (Q * sign).T @ rest
    return inverse, inverse @ of_x, S, target, k == m


# Zeros


def _output_nulling(A: Array, F: Array, C: Array, G: Array, tolerance: float) -> tuple[Array, float]:
    """Return V*, and the tolerance: what should vanish grows with each step by the size over the least singular value kept."""
    off, size = np.empty((0, len(A))), float(np.linalg.norm(np.block([[A, F], [C, G]])))
    while True:
        by_signal = np.vstack([off @ F, G])
        seen, free = _split(by_signal.T, tolerance)
        of_states = free.T @ np.vstack([off @ A, C])
        span, V = _split(of_states, tolerance)
        kept = [np.linalg.svd(one, compute_uv=False).min(initial=np.inf) for one in (seen.T @ by_signal, of_states @ span) if one.size]
        kept = [least for least in kept if least > tolerance]
        if span.shape[1] == len(off):
            return V, tolerance
        tolerance = min(tolerance * max(1.0, size / min(kept, default=np.inf)), max(tolerance, np.sqrt(EPS) * size))
        off = span.T


def _reached(A: Array, F: Array, C: Array, G: Array, tolerance: float) -> list[Array]:
    """Return S_1, S_2, ... up to the last: the states reached in 1, 2, ... steps while the output is zero."""
    S, chain = np.empty((len(A), 0)), list[Array]()
    while True:
        quiet = _split(np.hstack([C @ S, G]), tolerance)[1]
        more = _split((np.hstack([A @ S, F]) @ quiet).T, tolerance)[0]
        if more.shape[1] == S.shape[1]:
            return chain or [more]
        S = more
        chain.append(S)


def _nearer(A: Array, F: Array, C: Array, G: Array, zero: complex) -> complex:
    """Return what a step of Newton's method makes of a simple zero; where it is not simple, it stays."""
    n = len(A)
    U, sigma, V = np.linalg.svd(np.block([[zero * np.eye(n) - A, -F], [C, G]]))
    change = U[:n, len(V) - 1].conj() @ V[-1, :n].conj()
    step = sigma[-1] / change if abs(change) > np.sqrt(EPS) else 0.0
    return complex(zero - step) if abs(step) <= 1e-3 * max(1.0, abs(zero)) else zero


def structure(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    A, F, C, G = _system(A, F, C, G)
    (p, m), n = G.shape, len(A)
    for _ in range(4):
        for i in range(n):
            out, into = np.linalg.norm(np.append(np.delete(A[:, i], i), C[:, i])), np.linalg.norm(np.append(np.delete(A[i], i), F[i]))
            unit = np.exp2(np.round(np.log2(into / out) / 2)) if into and out else 1.0
            A[:, i], C[:, i] = A[:, i] * unit, C[:, i] * unit
            A[i], F[i] = A[i] / unit, F[i] / unit
        of_v = _scaled(np.vstack([F, G]))[1]
        F, G = F / of_v, G / of_v
        of_r = _scaled(np.hstack([C, G]).T)[1]
        C, G = C / of_r[:, None], G / of_r[:, None]
    tolerance = _floor(np.block([[A, F], [C, G]])) * (n + 1)
    chain = _reached(A, F, C, G, tolerance)
    V, tolerance = _output_nulling(A, F, C, G, tolerance)
    dimensions = [_rank(np.hstack([V, S]), tolerance) for S in [np.empty((n, 0)), *chain]]
    at_least = np.diff(dimensions)  # infinite zeros of order 1 and more, 2 and more, ...
    # The inputs that keep V* within itself and the output at zero, less those that reach R*, are lost to the output; all others are seen.
    lost = _split(np.vstack([_split(V.T)[1].T @ F, G]), tolerance)[1].shape[1]
    normal_rank = m - lost
    orders = [order for order, number in enumerate(-np.diff([normal_rank, *at_least, 0])) for _ in range(number)]
    both = _split(np.hstack([V, -chain[-1]]), tolerance)[1]
    controlled = _split((V @ both[: V.shape[1]]).T, tolerance)[0]
    basis = np.hstack([controlled, V @ _split(controlled.T @ V, tolerance)[1]])
    d, c = basis.shape[1], controlled.shape[1]
    left = np.block([[basis, -F], [np.zeros((p, d)), -G]])
    X = np.linalg.lstsq(left, np.vstack([A @ basis, C @ basis]), rcond=tolerance)[0][:d] if d else np.empty((0, 0))
    zeros = [complex(z) for z in np.linalg.eigvals(X[c:, c:])]
    if normal_rank == m:
        zeros = [_nearer(A, F, C, G, _nearer(A, F, C, G, z)) for z in zeros]
    return {
        "normal_rank": normal_rank,
        "finite_zeros": zeros,
        "infinite_zero_orders": orders,
        "left_invertible": normal_rank == m,
    }


# From outputs and inputs


def count_faults(y: Array, u: Array, order: int) -> int:
    y, u = _record(y, u)
    n, (N, p), m = _count(order, "order"), y.shape, u.shape[1]
    if (p + m + 1) * (n + 3) > N:
        raise ValueError(f"{N} samples are too few for order {n}")
    n_v, noisy = _new_channels(np.hstack([u, y]), m)
    if noisy and n_v == p:
        raise ValueError("undecided")
    return n_v
