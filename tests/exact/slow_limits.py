"""Population limits the slow obvious way: impulse responses, sums of products, normal equations written out. No Lyapunov equation.

Responses             impulse responses of u, v, w, y to every noise, each a list over lag of Fraction matrices (lists of rows)
responses             run the recursions for so many lags; exact for FIR filters, the whole story where A is nilpotent as well
dense_covariance      P = Phi P Phi' + Gamma Gamma' as one linear system in all entries of P, by sympy
covariance            Cov(a(k+lag), b(k)) = sum_j a_(j+lag) b_j'
window                the block matrix over two ranges
slow_limit            Cov(Yf,Z) - Cov(Yf,Uf) Cov(Uf)^-1 Cov(Uf,Z) by sympy
slow_output_error     B, D from the responses of every entry of B and D
slow_moesp            B, D from the vectorised regression with Pi built in full
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy

from faultspace.exact.limits.experiments import Experiment
from faultspace.exact.limits.filters import Filter
from faultspace.exact.limits.process import JointProcess

Table = sympy.Matrix


@dataclass(frozen=True)
class Responses:
    """This has lists over lag of matrices: rows of the signal, columns of all noise, w's last."""

    u: list[Any]
    v: list[Any]
    y: list[Any]


def responses(experiment: Experiment, lags: int) -> Responses:
    """These are the first `lags` terms of each impulse response."""
    system, residual = experiment.system, experiment.system.residual
    noise = experiment.u_filter.noise
    own = experiment.w_filter.noise if experiment.w_filter is not None else 0
    u = [block.row_join(sympy.zeros(block.rows, own)) for block in _filtered(experiment.u_filter, lags)]
    v = [sympy.zeros(0, noise + own)] * lags
    if residual.m:
        v = [block.row_join(sympy.zeros(block.rows, own)) for block in _filtered(experiment.v_filter, lags)]
    w = [sympy.zeros(residual.p, noise + own)] * lags
    if experiment.w_filter is not None:
        w = [sympy.zeros(residual.p, noise).row_join(block) for block in _filtered(experiment.w_filter, lags)]
    A, B, C, D = (M.to_sympy() for M in (residual.A, system.B, residual.C, system.D))
    F, G = residual.F.to_sympy(), residual.G.to_sympy()
    state, y = sympy.zeros(residual.n, noise + own), []
    for k in range(lags):
        y.append(C * state + D * u[k] + G * v[k] + w[k])
        state = A * state + B * u[k] + F * v[k]
    return Responses(u, v, y)


def _filtered(one: Filter, lags: int) -> list[Any]:
    """This is long division: h_k = U_k - d_1 h_(k-1) - d_2 h_(k-2) - ..."""
    result: list[Any] = []
    for k in range(lags):
        block = one.numerator[k].to_sympy() if k < len(one.numerator) else sympy.zeros(one.channels, one.noise)
        for j, d in enumerate(one.denominator[1:], 1):
            if j <= k:
                block = block - sympy.Rational(int(d.p), int(d.q)) * result[k - j]
        result.append(sympy.Matrix(block))
    return result


def dense_covariance(process: JointProcess) -> Any:
    """The result is vec P = (I - Phi kron Phi)^-1 vec(Gamma Gamma')."""
    Phi, Gamma = process.Phi.to_sympy(), process.Gamma.to_sympy()
    size = Phi.rows
    right = (Gamma * Gamma.T).reshape(size * size, 1)
    big = sympy.eye(size * size) - sympy.kronecker_product(Phi, Phi)
    solved = big.to_DM().to_field().lu_solve(right.to_DM().to_field()).to_Matrix()
    return sympy.ImmutableMatrix(solved.reshape(size, size))


def covariance(a: list[Any], b: list[Any], lag: int) -> Any:
    """The result is the sum of the responses' products over all lags at hand."""
    total = sympy.zeros(a[0].rows, b[0].rows)
    for j in range(len(b)):
        if 0 <= j + lag < len(a):
            total += a[j + lag] * b[j].T
    return total


def window(a: list[Any], b: list[Any], rows: range, columns: range) -> Any:
    """The result is the blocks Cov(a(k+i), b(k+j))."""
    return sympy.Matrix(sympy.BlockMatrix([[covariance(a, b, i - j) for j in columns] for i in rows]).as_explicit())


def slow_limit(found: Responses, s: int, past: int, *, outputs: bool) -> Any:
    """The result is the limit for past inputs, and past outputs where asked for."""
    future, before = range(s), range(-past, 0)
    yz, uz = window(found.y, found.u, future, before), window(found.u, found.u, future, before)
    if outputs:
        yz = yz.row_join(window(found.y, found.y, future, before))
        uz = uz.row_join(window(found.u, found.y, future, before))
    uf = window(found.u, found.u, future, future)
    return yz - window(found.y, found.u, future, future) * uf.LUsolve(uz)


def slow_output_error(experiment: Experiment, found: Responses) -> tuple[Any, Any]:
    """Every entry of B and D makes an output of its own; their Gram matrix is summed over lags."""
    residual, nu = experiment.system.residual, experiment.system.nu
    A, C = residual.A.to_sympy(), residual.C.to_sympy()
    n, p, lags = residual.n, residual.p, len(found.y)
    made: list[list[Any]] = []
    for i in range(n):
        for j in range(nu):
            state, outputs = sympy.zeros(n, found.u[0].cols), []
            unit = sympy.zeros(n, nu)
            unit[i, j] = 1
            for k in range(lags):
                outputs.append(C * state)
                state = A * state + unit * found.u[k]
            made.append(outputs)
    for i in range(p):
        for j in range(nu):
            unit = sympy.zeros(p, nu)
            unit[i, j] = 1
            made.append([unit * block for block in found.u])
    gram = sympy.Matrix(len(made), len(made), lambda i, j: covariance(made[i], made[j], 0).trace())
    right = sympy.Matrix(len(made), 1, lambda i, _: covariance(made[i], found.y, 0).trace())
    theta = gram.LUsolve(right)
    return theta[: n * nu, :].reshape(n, nu), theta[n * nu :, :].reshape(p, nu)


def slow_moesp(experiment: Experiment, found: Responses) -> tuple[Any, Any]:
    """These are least squares over vec(B), vec(D) of Pi (K - T_s(B, D)), T_s built for every unit."""
    residual, nu, s = experiment.system.residual, experiment.system.nu, experiment.s
    A, C = residual.A.to_sympy(), residual.C.to_sympy()
    n, p = residual.n, residual.p
    observability = sympy.Matrix.vstack(*(C * A**k for k in range(s)))
    projector = sympy.eye(s * p) - observability * (observability.T * observability).inv() * observability.T
    future = range(s)
    K = window(found.y, found.u, future, future) * window(found.u, found.u, future, future).inv()
    columns: list[Any] = []
    for rows in (n, p):
        for i in range(rows):
            for j in range(nu):
                unit = sympy.zeros(rows, nu)
                unit[i, j] = 1
                # First the entries of B, then those of D.
                B, D = (unit, sympy.zeros(p, nu)) if len(columns) < n * nu else (sympy.zeros(n, nu), unit)
                markov = [D, *(C * A**k * B for k in range(s - 1))]
                zero = sympy.zeros(p, nu)
                T = sympy.Matrix(sympy.BlockMatrix([[markov[a - b] if a >= b else zero for b in range(s)] for a in range(s)]).as_explicit())
                columns.append((projector * T).reshape(s * p * s * nu, 1))
    regressor = sympy.Matrix.hstack(*columns)
    target = (projector * K).reshape(s * p * s * nu, 1)
    theta = (regressor.T * regressor).LUsolve(regressor.T * target)
    return theta[: n * nu, :].reshape(n, nu), theta[n * nu :, :].reshape(p, nu)
