"""Stein and discrete Lyapunov equations over Q are solved exactly without ever forming an n^2 x n^2 system.

    stein              X = S X T' + R, given a polynomial that annihilates T
    state_covariance   P = Phi P Phi' + Gamma Gamma' of a joint process, block by block, checked by substitution
    solve              M^-1 R for a square rational M, by p-adic lifting [D82]

Let c_0 + c_1 q + ... + c_d q^d annihilate T. From X = S X T' + R follows S^k X T'^k = X - W_k with W_k = sum_(j<k) S^j R T'^j, and
sum_k c_k S^(d-k) S^k X T'^k = S^d X c(T)' = 0. Hence

    (sum_k c_k S^(d-k)) X = sum_k c_k S^(d-k) W_k,

one linear system of the size of S. It is nonsingular when the roots of c and the eigenvalues of S lie inside the unit circle: its
eigenvalues are products of numbers 1 - (root)(eigenvalue). For a delay line c = q^d, the matrix is the identity and X the finite sum W_d.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import fmpq

from ..algebra.fields import QQ
from ..algebra.matrices import Matrix, beside, stacked
from ..algebra.stability import rational_characteristic_polynomial
from .process import DelayLine, JointProcess


def solve(matrix: Matrix, right_side: Matrix) -> Matrix:
    """Return X with M X = R for M square and nonsingular over Q. Raises ZeroDivisionError where M is singular."""
    if 0 in (matrix.nrows, right_side.ncols):
        return Matrix.zero(QQ, matrix.nrows, right_side.ncols)
    return Matrix(QQ, matrix.nrows, right_side.ncols, matrix.flint.solve(right_side.flint, "dixon"))


def stein(S: Matrix, T: Matrix, R: Matrix, annihilator: Sequence[Any]) -> Matrix:
    """Return X (a x b) with X = S X T' + R; S a x a and T b x b Schur-stable, `annihilator` ascending with c(T) = 0 and stable
    roots.
    """
    turned = T.transposed()
    size = S.nrows
    left = Matrix(QQ, size, size, Matrix.identity(QQ, size).flint * annihilator[0])
    right = Matrix.zero(QQ, *R.shape)
    partial = Matrix.zero(QQ, *R.shape)
    unit = Matrix.identity(QQ, size).flint
    for c in annihilator[1:]:  # Horner in S; `partial` runs through W_1, W_2, ...
        partial = S @ partial @ turned + R
        left, right = S @ left, S @ right
        if c:
            left = left + Matrix(QQ, size, size, unit * c)
            right = right + Matrix(QQ, *R.shape, partial.flint * c)
    return solve(left, right)


def state_covariance(process: JointProcess) -> Matrix:
    """Return the only P = P' with P = Phi P Phi' + Gamma Gamma', N x N. Raises ArithmeticError if substitution fails."""
    n, lines = process.n, process.lines
    size = process.Phi.nrows
    head, tail = range(n), range(n, size)
    Phi_x, Phi_z = process.Phi.rows(head), process.Phi.rows(tail)
    Gamma_x, Gamma_z = process.Gamma.rows(head), process.Gamma.rows(tail)
    A, M, N = Phi_x.columns(head), Phi_x.columns(tail), Phi_z.columns(tail)
    blocks = [[_between(one, other) for other in lines] for one in lines]
    P_zz = stacked(Matrix.zero(QQ, 0, size - n), *(beside(*row) for row in blocks))
    pieces = [Matrix.zero(QQ, n, 0)]
    source = M @ P_zz @ N.transposed() + Gamma_x @ Gamma_z.transposed()
    start = 0
    for line in lines:
        part = range(start, start + line.size)
        step = N.rows(part).columns(part)
        pieces.append(stein(A, step, source.columns(part), line.annihilator()))
        start += line.size
    P_xz = beside(*pieces)
    crossed = A @ P_xz @ M.transposed()
    inner = crossed + crossed.transposed() + M @ P_zz @ M.transposed() + Gamma_x @ Gamma_x.transposed()
    monic = [fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(A)]
    P_xx = stein(A, A, inner, monic)
    P = stacked(beside(P_xx, P_xz), beside(P_xz.transposed(), P_zz))
    moved = process.Phi @ P @ process.Phi.transposed() + process.Gamma @ process.Gamma.transposed()
    if not ((moved - P).is_zero() and (P - P.transposed()).is_zero()):
        raise ArithmeticError("the state covariance does not satisfy its Lyapunov equation")
    return P


def _between(one: DelayLine, other: DelayLine) -> Matrix:
    """Return the covariance of two lines: one channel of it, Kronecker an identity; zero where their noises are independent."""
    if one.noise_start != other.noise_start:
        return Matrix.zero(QQ, one.size, other.size)
    table = [[fmpq(int(i == 0 and j == 0)) for j in range(other.length)] for i in range(one.length)]
    drive = Matrix.from_elements(QQ, one.length, other.length, table)
    channel = stein(one.companion(), other.companion(), drive, other.annihilator()).elements()
    rows = [[fmpq(0)] * other.size for _ in range(one.size)]
    for i in range(one.length):
        for j in range(other.length):
            for c in range(one.width):
                rows[i * one.width + c][j * other.width + c] = channel[i][j]
    return Matrix.from_elements(QQ, one.size, other.size, rows)
