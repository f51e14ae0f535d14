"""This computes what B and D converge to once A and C are given, exactly, by either regression.

    by_output_error   minimises the stationary E|y - G(q)u|^2 over B, D with G(q) = C (qI - A)^-1 B + D
    by_moesp          least squares in the Frobenius norm of Pi (Cov(Yf,Uf) Cov(Uf,Uf)^-1 - T_s(B, D)), Pi on the complement of O_s [V93]
    InputLimit        B (n x nu), D (p x nu)

Output error. With Q = A' Q A + C'C, the input's covariances r_ij(l) = E u_i(k+l) u_j(k) and M_ij = sum_(l>=1) r_ij(l) A^(l-1), the normal
equations have blocks, between the columns B_i and B_j,

    sum_(a,b) A'^a C'C A^b r_ij(b-a) = r_ij(0) Q + Q A M_ij + (A M_ji)' Q,

C M_ij between D_i and B_j, r_ij(0) I between D_i and D_j. The right side is sum_a A'^a C' E y(k) u_i(k-1-a) = X Cov(xi(k+1), u_i(k)) with
X = A' X Phi + C' H_y, a Stein equation again, and E y(k) u_i(k). So nothing larger than (n + p) nu is ever solved.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import fmpq

from ..algebra.fields import QQ
from ..algebra.matrices import Matrix, beside, column_basis, rank, row_profile, stacked
from ..algebra.stability import is_stable, rational_characteristic_polynomial
from .lyapunov import solve, stein
from .moments import Covariances, WindowCovariances


@dataclass(frozen=True)
class InputLimit:
    """B (n x nu) and D (p x nu) are in the basis of the A and C that were given."""

    B: Matrix
    D: Matrix


def by_output_error(known: Covariances, A: Matrix, C: Matrix) -> InputLimit | None:
    """Return the minimiser of E|y - G(q)u|^2 for these A (n x n, any order) and C (p x n), or None where A is unstable or it is not
    unique.
    """
    process = known.process
    if not is_stable(A):
        return None
    n, p, nu = A.nrows, C.nrows, process.u.H.nrows
    monic = _characteristic(A)
    Q = stein(A.transposed(), A.transposed(), C.transposed() @ C, monic)
    present = known.now(process.u, process.u)
    sums = powers_along_lags(known, A)
    through = [[Q @ (A @ sums[i][j]) for j in range(nu)] for i in range(nu)]
    rows = []
    for i in range(nu):
        states = [_scaled(Q, present[i, j]) + through[i][j] + through[j][i].transposed() for j in range(nu)]
        direct = [(C @ sums[j][i]).transposed() for j in range(nu)]
        rows.append(beside(*states, *direct))
    for i in range(nu):
        rows.append(beside(*(C @ sums[i][j] for j in range(nu)), *(_scaled(Matrix.identity(QQ, p), present[i, j]) for j in range(nu))))
    gram = stacked(*rows)
    X = _observed_through(known, A, C)
    reached = X @ known.with_next_state(process.u)
    now = known.now(process.y, process.u)
    right = stacked(*(reached.columns([i]) for i in range(nu)), *(now.columns([i]) for i in range(nu)))
    if rank(gram) < gram.nrows:
        return None
    theta = solve(gram, right)
    B = beside(*(theta.rows(range(i * n, i * n + n)) for i in range(nu)))
    first = nu * n
    return InputLimit(B, beside(*(theta.rows(range(first + i * p, first + i * p + p)) for i in range(nu))))


def by_moesp(blocks: WindowCovariances, observability: Matrix, p: int) -> InputLimit | None:
    """Return that of MOESP's regression for O_s (s p x n); it is None where B and D are not unique, as for s p <= n.

    Block column k of T_s(B, D) is S_k [D; B] with S_k of p + n columns: identity and nothing in block row k, nothing and O below.
    """
    n, s = observability.ncols, observability.nrows // p
    nu = blocks.uf_uf.nrows // s
    basis = column_basis(observability)
    onto = solve(basis.transposed() @ basis, basis.transposed())  # I - Pi = basis onto
    # Pi is blind to combinations of O_s: taking off the one that clears its pivot rows first leaves the shorter numbers to divide.
    pivots = row_profile(basis)
    shorter = blocks.yf_uf - basis @ solve(basis.rows(pivots), blocks.yf_uf.rows(pivots))
    response = solve(blocks.uf_uf, shorter.transposed()).transposed()
    gram = Matrix.zero(QQ, p + n, p + n)
    right = Matrix.zero(QQ, p + n, nu)
    for k in range(s):
        later = observability.rows(range((s - 1 - k) * p))
        own = beside(Matrix.identity(QQ, p), Matrix.zero(QQ, p, n))
        below = beside(Matrix.zero(QQ, later.nrows, p), later)
        regressor = stacked(Matrix.zero(QQ, k * p, p + n), own, below)
        outside = regressor - basis @ (onto @ regressor)  # Pi S_k
        gram = gram + regressor.transposed() @ outside
        right = right + outside.transposed() @ response.columns(range(k * nu, (k + 1) * nu))
    if rank(gram) < p + n:
        return None
    theta = solve(gram, right)
    return InputLimit(theta.rows(range(p, p + n)), theta.rows(range(p)))


def powers_along_lags(known: Covariances, A: Matrix) -> list[list[Matrix]]:
    """Return M_ij = sum_(l>=1) r_ij(l) A^(l-1), n x n.

    From l = 1 on, r(l) follows the recurrence of d, the polynomial that annihilates the state of u; so, with d of degree t, (sum_k d_k
    A^(t-k)) M = sum_k d_k A^(t-k) sum_(l=1..k) r(l) A^(l-1).
    """
    u, line = known.process.u, known.process.lines[0]
    nu, n = u.H.nrows, A.nrows
    recurrence = line.annihilator()
    lags = known.forward(u, u, line.length)
    identity = Matrix.identity(QQ, n)
    left = _scaled(identity, recurrence[0])
    table = [[Matrix.zero(QQ, n, n) for _ in range(nu)] for _ in range(nu)]
    partial = [[Matrix.zero(QQ, n, n) for _ in range(nu)] for _ in range(nu)]
    power = identity
    for k, d in enumerate(recurrence[1:], 1):
        left = A @ left + _scaled(identity, d)
        for i in range(nu):
            for j in range(nu):
                partial[i][j] = partial[i][j] + _scaled(power, lags[k][i, j])
                table[i][j] = A @ table[i][j] + _scaled(partial[i][j], d)
        power = power @ A
    solved = solve(left, beside(*(block for row in table for block in row)))
    return [[solved.columns(range((i * nu + j) * n, (i * nu + j + 1) * n)) for j in range(nu)] for i in range(nu)]


def _observed_through(known: Covariances, A: Matrix, C: Matrix) -> Matrix:
    """Return X (n x N) with X = A' X Phi + C' H_y, column blocks in the order x, lines."""
    process = known.process
    n_x, size = process.n, process.Phi.nrows
    head = range(n_x)
    turned = A.transposed()
    source = C.transposed() @ process.y.H
    system = process.Phi.rows(head).columns(head)
    pieces = [stein(turned, system.transposed(), source.columns(head), _characteristic(system))]
    after = turned @ pieces[0] @ process.Phi.rows(head)
    start = n_x
    for line in process.lines:
        part = range(start, start + line.size)
        step = process.Phi.rows(part).columns(part)
        pieces.append(stein(turned, step.transposed(), (after + source).columns(part), line.annihilator()))
        start += line.size
    assert start == size
    return beside(*pieces)


def _characteristic(A: Matrix) -> list[Any]:
    return [fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(A)]


def _scaled(matrix: Matrix, factor: Any) -> Matrix:
    return Matrix(QQ, *matrix.shape, matrix.flint * factor)
