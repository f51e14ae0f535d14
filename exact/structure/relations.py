"""This finds coefficients of the kernel rows, once their shape is known: one exact linear solve.

    leads                      (mu, output) for every output that depends on earlier ones from sample mu on
    integer_relations          over Q and Q(a); flint's p-adic lifting, which stops as soon as the answer is recognised
    relations_over_prime_field over GF(p), by elimination
    basis rows                 the rows (k, i) of [O_s T_s] that depend on no row above them: k < mu_i, all k where i is no lead

A relation writes row (mu, output) through the basis rows above it. Columns are thinned to a square modulo one prime; what is thinned
away is checked by the caller's Horner run, never assumed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import flint
from flint import fmpq, fmpz, nmod_mat

from ..algebra.fields import Rationals
from ..algebra.matrices import Matrix, pivot_columns, solve_left
from ..system.systems import ResidualSystem
from ..system.windows import window_matrix

Lead = tuple[int, int]


def basis_rows(leads: Sequence[Lead], p: int, windows: int) -> list[tuple[int, int]]:
    """The result is (k, i) of the rows of [O_s T_s], s = windows, that are independent of the rows above them."""
    starts = {output: mu for mu, output in leads}
    return [(k, i) for k in range(windows) for i in range(p) if k < starts.get(i, windows)]


def relations_over_prime_field(system: ResidualSystem, leads: Sequence[Lead]) -> list[list[list[Any]]]:
    """For each lead the result has the (mu + 1) x p coefficients of its row, over a prime field."""
    relations = []
    for mu, output in leads:
        earlier = [(k, i) for k, i in basis_rows(leads, system.p, mu + 1) if (k, i) < (mu, output)]
        window = window_matrix(system, mu + 1)
        solution = solve_left(window.rows(k * system.p + i for k, i in earlier), window.rows([mu * system.p + output]))
        if solution is None:
            raise ArithmeticError("the recursion and the built matrix disagree")
        zero, one = system.field.element(0), system.field.element(1)
        coefficients = [[zero] * system.p for _ in range(mu + 1)]
        for column, (k, i) in enumerate(earlier):
            coefficients[k][i] = -solution[0, column]
        coefficients[mu][output] = one
        relations.append(coefficients)
    return relations


def integer_relations(system: ResidualSystem, leads: Sequence[Lead], prime: int) -> list[list[list[list[fmpq]]]] | None:
    """For each lead the result has the (mu + 1) x p x d rational coordinates of its row; it is None where the shape or the prime proves
    wrong.
    """
    if not leads:
        return []
    d, p = system.field.degree, system.p
    rational = _over_the_rationals(system)
    windows = max(mu for mu, _ in leads) + 1
    built, state_scale = _integer_window(rational, windows)
    basis = basis_rows(leads, p, windows)
    above = built.rows([k * p * d + i * d + c for k, i in basis for c in range(d)])
    below = built.rows([mu * p * d + output * d for mu, output in leads])
    pivots = _pivots_modulo(above, prime)
    if len(pivots) < above.nrows:
        return None
    square, target = above.columns(pivots), below.columns(pivots)
    solution = _solve(square, target)
    relations = []
    for a, (mu, output) in enumerate(leads):
        rows = [[[fmpq(0)] * d for _ in range(p)] for _ in range(mu + 1)]
        for b, (k, i) in enumerate(basis):
            values = [solution[b * d + c, a] for c in range(d)]
            if (k, i) < (mu, output):
                rows[k][i] = [-value * state_scale**k for value in values]
            elif any(value != 0 for value in values):
                return None
        rows[mu][output][0] = fmpq(state_scale**mu)
        relations.append(rows)
    return relations


def _over_the_rationals(system: ResidualSystem) -> ResidualSystem:
    """The result is the system of the blocks: n d states, m d faults, p d outputs over Q."""
    d = system.field.degree
    rational = Rationals()
    parts = [getattr(system, name) for name in "AFCG"]
    return ResidualSystem(*(Matrix(rational, part.nrows * d, part.ncols * d, part.flint) for part in parts))


def _integer_window(system: ResidualSystem, windows: int) -> tuple[Matrix, fmpz]:
    """The result is [O_s T_s] of (dA, dF, cC, cG), which is integral, and d.

    Its row of sample k is c d^k times that of the system, with v(j) rescaled: kernel coefficients come back as N_k d^k.
    """
    d, e = _common_denominator(system.A, system.F), _common_denominator(system.C, system.G)
    scaled = ResidualSystem(*(_times(part, factor) for part, factor in ((system.A, d), (system.F, d), (system.C, e), (system.G, e))))
    return window_matrix(scaled, windows), d


def _common_denominator(*parts: Matrix) -> fmpz:
    result = fmpz(1)
    for part in parts:
        result = result.lcm(part.flint.numer_denom()[1])
    return result


def _times(part: Matrix, factor: fmpz) -> Matrix:
    return Matrix(part.field, part.nrows, part.ncols, part.flint * factor)


def _pivots_modulo(matrix: Matrix, prime: int) -> list[int]:
    """These columns make a square invertible matrix of an integer one of full row rank; they are found modulo the prime."""
    numerators = matrix.flint.numer_denom()[0]
    return pivot_columns(nmod_mat(numerators, prime).rref()[0])


def _solve(square: Matrix, target: Matrix) -> Any:
    """The result is the transposed solution of X square = target, by Dixon's p-adic lifting [D82]."""
    if square.nrows == 0:
        return flint.fmpq_mat(0, target.nrows)
    return square.flint.transpose().solve(target.flint.transpose(), "dixon")
