"""These are the formulas of numeric/ in mpmath at DIGITS digits, plainly and for small cases: what floats are held against.

Matrices are numpy arrays of mpf, so that every product is one of mpmath's. Call inside `with precise():`.

precise, DIGITS             the working precision
lift                        floats, Fractions or exact matrices as arrays of mpf
triangle                    R with R' R = H' H, by Householder reflections of the rows of H
compression                 L of [Uf; Up; Yf]; `Factor` with its blocks
identify                    PI-MOESP: range, shift invariance, both regressions for B and D
residual                    y less the response, initial state fitted
hankel_values               singular values of R_1, R_2, ..
reconstruct                 x(0) and v of least norm with simulated residual r
markov, characteristic_polynomial, transfer      what does not depend on the basis
"""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np

DIGITS = 50
Array = Any  # arrays of mpf, of dtype object


def precise() -> AbstractContextManager[Any]:
    """Return the working precision."""
    return mpmath.workdps(DIGITS)  # type: ignore[no-any-return]


def lift(matrix: Any) -> Array:
    """Return an array of mpf from floats (exactly what they are), Fractions, or a matrix of the exact branch (correctly rounded)."""
    exact = hasattr(matrix, "to_sympy")
    entries = np.array(matrix.to_sympy().tolist(), dtype=object).reshape(matrix.shape) if exact else np.asarray(matrix)
    result = np.empty(entries.shape, dtype=object)
    for index, entry in np.ndenumerate(entries):
        if isinstance(entry, (float, np.floating)):
            result[index] = mpmath.mpf(float(entry))
        elif isinstance(entry, mpmath.mpf):
            result[index] = entry
        else:
            result[index] = mpmath.mpf(int(Fraction(str(entry)).numerator)) / int(Fraction(str(entry)).denominator)
    return result


def zeros(*shape: int) -> Array:
    return lift(np.zeros(shape))


def identity(n: int) -> Array:
    return lift(np.eye(n))


def norm(matrix: Array) -> Any:
    """Return the Frobenius norm."""
    return mpmath.sqrt(mpmath.fsum(entry * entry for entry in matrix.ravel()))


def _matrix(array: Array) -> Any:
    return mpmath.matrix(array.tolist())


def _array(matrix: Any) -> Array:
    return np.array(matrix.tolist(), dtype=object).reshape(matrix.rows, matrix.cols)


def reflected(H: Array, others: Array) -> tuple[Array, Array]:
    """Return R (k, k) upper triangular and Q' others, for H (m, k) with m >= k = its number of columns: H = Q [R; 0]."""
    work, side = H.copy(), others.copy()
    k = work.shape[1]
    for column in range(k):
        v = work[column:, column].copy()
        length = norm(v)
        if length == 0:
            continue
        v[0] = v[0] + (length if v[0] >= 0 else -length)
        scale = 2 / mpmath.fsum(entry * entry for entry in v)
        work[column:] = work[column:] - np.multiply.outer(v * scale, v @ work[column:])
        side[column:] = side[column:] - np.multiply.outer(v * scale, v @ side[column:])
    upper = zeros(k, k)
    for i in range(k):
        upper[i, i:] = work[i, i:]
    return upper, side


def triangle(H: Array) -> Array:
    """Return R (k, k) upper triangular with nonnegative diagonal and R' R = H' H, H (m, k) with m >= k."""
    upper = reflected(H, zeros(len(H), 1))[0]
    signs = np.array([-1 if upper[i, i] < 0 else 1 for i in range(len(upper))], dtype=object)
    return signs[:, np.newaxis] * upper


def back_substituted(upper: Array, right: Array) -> Array:
    """Return X with upper X = right."""
    solution = right.copy()
    for i in reversed(range(len(upper))):
        solution[i] = (right[i] - upper[i, i + 1 :] @ solution[i + 1 :]) / upper[i, i]
    return solution


def least_squares(matrix: Array, right: Array) -> Array:
    """Return the X (k, any) of least |matrix X - right|, full column rank."""
    k = matrix.shape[1]
    upper, turned = reflected(matrix, right)
    return back_substituted(upper, turned[:k])


def singular(matrix: Array) -> tuple[Array, Array]:
    """Return left singular vectors and singular values, descending."""
    # svd_r wants no more columns than rows to be quick; a triangle of the transpose has the same left side.
    square = triangle(matrix.T).T if matrix.shape[1] > matrix.shape[0] else matrix
    left, values, _ = mpmath.svd_r(_matrix(square))
    return _array(left), _array(values).ravel()


@dataclass(frozen=True, eq=False)
class Factor:
    """The factor is L of [Uf; Up; Yf] for s future and q past rows."""

    lower: Array
    s: int
    q: int
    n_u: int
    p: int
    columns: int

    def part(self, row: str, column: str) -> Array:
        """Return a block by the letters f, p, y."""
        a, b = self.s * self.n_u, (self.s + self.q) * self.n_u
        spans = {"f": slice(0, a), "p": slice(a, b), "y": slice(b, None)}
        return self.lower[spans[row], spans[column]]


def hankel(signal: Array, first: int, rows: int, columns: int) -> Array:
    """Return block rows first .. first + rows - 1 of the Hankel matrix of a time-major signal."""
    return np.vstack([signal[i : i + columns].T for i in range(first, first + rows)])


def data_matrix(y: Array, u: Array, s: int, q: int) -> Array:
    """Return [Uf; Up; Yf]."""
    columns = len(y) - s - q + 1
    return np.vstack([hankel(u, q, s, columns), hankel(u, 0, q, columns), hankel(y, q, s, columns)])


def compression(y: Array, u: Array, s: int, q: int) -> Factor:
    """Return L by Householder reflections of the whole matrix."""
    return Factor(triangle(data_matrix(y, u, s, q).T).T, s, q, u.shape[1], y.shape[1], len(y) - s - q + 1)


@dataclass(frozen=True, eq=False)
class Model:
    """The model holds A, B, C, D, all mpf; `x0` stands where the data were read."""

    A: Array
    B: Array
    C: Array
    D: Array
    x0: Array | None = None


def observability(A: Array, C: Array, s: int) -> Array:
    """Return the observability matrix O_s."""
    blocks = [C]
    for _ in range(s - 1):
        blocks.append(blocks[-1] @ A)
    return np.vstack(blocks)


def identify(factor: Factor, n: int, scale: Any = None) -> tuple[Array, Array, Array]:
    """Return A, C of order n and the singular values, from L32 with outputs divided by `scale` (their root mean square where None)."""
    s, p = factor.s, factor.p
    outputs = factor.lower[-s * p :]
    if scale is None:
        energy = [mpmath.fsum(e * e for e in outputs[channel::p].ravel()) for channel in range(p)]
        scale = np.array([mpmath.sqrt(value / (s * factor.columns)) for value in energy], dtype=object)
    else:
        scale = lift(scale)
    tiled = np.tile(scale, s)[:, np.newaxis]
    left, values = singular(factor.part("y", "p") / tiled)
    basis = left[:, :n]
    A = least_squares(basis[:-p], basis[p:])
    return A, basis[:p] * scale[:, np.newaxis], values / mpmath.sqrt(factor.columns)


def by_moesp(factor: Factor, A: Array, C: Array) -> Model:
    """Return B and D of least Frobenius norm of Pi (L31 L11^-1 - T_s(B, D)), outputs in their own units."""
    s, p, n = factor.s, factor.p, len(A)
    free = observability(A, C, s)
    Z = back_substituted_lower(factor.part("f", "f"), factor.part("y", "f"))
    # Pi = I - O O^+ instead of a complement's basis: another way to the same minimum.
    projector = identity(s * p) - free @ least_squares(free, identity(s * p))
    rows, right = [], []
    for k in range(s):
        reach = zeros(s * p, p + n)
        reach[k * p : (k + 1) * p, :p] = identity(p)
        reach[(k + 1) * p :, p:] = free[: (s - 1 - k) * p]
        rows.append(projector @ reach)
        right.append(projector @ Z[:, k * factor.n_u : (k + 1) * factor.n_u])
    theta = least_squares(np.vstack(rows), np.vstack(right))
    return Model(A, theta[p:], C, theta[:p])


def back_substituted_lower(lower: Array, right: Array) -> Array:
    """Return right lower^-1 for a lower triangular matrix."""
    upper = lower.T  # X lower = right  <=>  upper X' = right'
    return back_substituted(upper, right.T).T


def regressor(A: Array, C: Array, u: Array) -> Array:
    """Return Phi with y = Phi [x0; B by columns; D by rows], (N p, n + n n_u + p n_u)."""
    n, p, n_u = len(A), len(C), u.shape[1]
    rows = zeros(len(u), p, n + n * n_u + p * n_u)
    state = zeros(n, n + n * n_u)
    state[:, :n] = identity(n)
    for k in range(len(u)):
        rows[k, :, : n + n * n_u] = C @ state
        state = A @ state
        for channel in range(n_u):
            first = n + channel * n
            state[:, first : first + n] = state[:, first : first + n] + u[k, channel] * identity(n)
        for output in range(p):
            first = n + n * n_u + output * n_u
            rows[k, output, first : first + n_u] = u[k]
    return rows.reshape(len(u) * p, -1)


def by_output_error(y: Array, u: Array, A: Array, C: Array, scale: Any) -> Model:
    """Return x0, B, D of least sum of squares of (y - simulated) / scale."""
    n, p, n_u = len(A), len(C), u.shape[1]
    scale = lift(scale)
    theta = least_squares(regressor(A, C / scale[:, np.newaxis], u), (y / scale).reshape(-1, 1)).ravel()
    B = theta[n : n + n * n_u].reshape(n_u, n).T
    return Model(A, B, C, theta[n + n * n_u :].reshape(p, n_u) * scale[:, np.newaxis], theta[:n])


def simulate(model: Model, u: Array, x0: Array) -> Array:
    """Return y (N, p)."""
    x, y = x0, []
    for sample in u:
        y.append(model.C @ x + model.D @ sample)
        x = model.A @ x + model.B @ sample
    return np.vstack(y)


def residual(y: Array, u: Array, model: Model) -> Array:
    """Return y less the model's response to u, the initial state fitted by least squares."""
    N, p = y.shape
    error = y - simulate(model, u, zeros(len(model.A)))
    Phi = observability(model.A, model.C, N)
    theta = least_squares(Phi, error.reshape(-1, 1))
    return error - (Phi @ theta).reshape(N, p)


def hankel_values(r: Array, windows: int) -> list[Array]:
    """Return singular values of R_1 .. R_windows over the columns of the longest."""
    columns = len(r) - windows + 1
    return [singular(hankel(r, 0, s, columns))[1] for s in range(1, windows + 1)]


def reconstruct(r: Array, A: Array, F: Array, C: Array, G: Array, regularisation: float, refinements: int) -> tuple[Array, Array]:
    """Return x(0) (n,) and v (N, m): min |r - C x - G v|^2 + regularisation^2 |v|^2, solved again for what it leaves over."""
    N, n, m = len(r), len(A), F.shape[1]
    free = observability(A, C, N)
    T = zeros(len(r) * len(C), N * m)
    p = len(C)
    pulse = np.vstack([G, *(free[k * p : (k + 1) * p] @ F for k in range(N - 1))])
    for k in range(N):
        T[k * p :, k * m : (k + 1) * m] = pulse[: (N - k) * p]
    penalty = np.hstack([zeros(N * m, n), identity(N * m) * mpmath.mpf(regularisation)])
    matrix = np.hstack([free, T])
    upper, turned = reflected(np.vstack([matrix, penalty]), np.vstack([identity(N * p), zeros(N * m, N * p)]))
    solver = back_substituted(upper, turned[: n + N * m])
    left = r.reshape(-1)
    solution = zeros(n + N * m)
    for _ in range(refinements):
        step = solver @ left
        solution, left = solution + step, left - matrix @ step
    return solution[:n], solution[n:].reshape(N, m)


def markov(model: Any, count: int) -> Array:
    """Return D, CB, CAB, .. (count, p, n_u) of a model of mpf."""
    values, state = [model.D], model.B
    for _ in range(count - 1):
        values.append(model.C @ state)
        state = model.A @ state
    return np.array(values)


def characteristic_polynomial(A: Array) -> Array:
    """Return coefficients of z^(n-1), .., 1 in det(zI - A)."""
    n, adjugate, coefficients = len(A), identity(len(A)), []
    for k in range(n):
        product = A @ adjugate
        coefficients.append(-sum(product[i, i] for i in range(n)) / (k + 1))
        adjugate = product + coefficients[-1] * identity(n)
    return np.array(coefficients, dtype=object)


def poles(A: Array) -> list[Any]:
    """Return the poles, the eigenvalues of A."""
    # mpmath.eig has another form of answer for one by one.
    return [A[0, 0]] if len(A) == 1 else list(mpmath.eig(_matrix(A), left=False, right=False))


def transfer(model: Any, z: complex) -> Array:
    """Return D + C (zI - A)^-1 B at a complex z, (p, n_u) of mpc."""
    n = len(model.A)
    point = mpmath.mpc(z)
    pencil = _matrix(identity(n) * point - model.A)
    states = [_array(mpmath.lu_solve(pencil, _matrix(model.B[:, [j]]))) for j in range(model.B.shape[1])]
    return model.D + model.C @ np.hstack(states)
