"""This finds coefficients of the kernel rows, once their shape is known: one exact linear solve.

    leads                      (mu, output) for every output that depends on earlier ones from sample mu on
    integer_relations          over Q and Q(a), in coprime integer coordinates, by flint's solver over the integers
    coefficients_of            the same as field elements
    relations_over_prime_field over GF(p), by elimination
    basis rows                 the rows (k, i) of [O_s T_s] that depend on no row above them: k < mu_i, all k where i is no lead

A relation writes row (mu, output) through the basis rows above it. Columns are thinned to a square modulo one prime; what is thinned
away is checked by the caller's Horner run, never assumed.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import gcd
from typing import Any

from flint import fmpq, fmpq_mat, fmpz, fmpz_mat

from ..algebra.fields import NumberField
from ..algebra.matrices import Matrix, solve_left
from ..system.systems import ResidualSystem
from ..system.windows import window_matrix
from .window_columns import null_vectors, window_columns

Lead = tuple[int, int]


def basis_rows(leads: Sequence[Lead], p: int, windows: int) -> list[tuple[int, int]]:
    """Return (k, i) of the rows of [O_s T_s], s = windows, that are independent of the rows above them."""
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


def integer_relations(system: ResidualSystem, leads: Sequence[Lead], prime: int) -> list[list[list[fmpz]]] | None:
    """For each lead the result has the mu + 1 coefficients of its row, each the p d coordinates, all coprime integers; it is None where the
    shape or the prime proves wrong.
    """
    if not leads:
        return []
    d, p = system.field.degree, system.p
    windows = max(mu for mu, _ in leads) + 1
    (A, F), scale = _numerators(system.A, system.F)
    (C, G), _ = _numerators(system.C, system.G)
    columns = window_columns(A, F, C, G, windows)  # of sample k: those of the system times scale^k, and v(j) over scale^j
    basis = basis_rows(leads, p, windows)
    places = [(k * p + i) * d + c for k, i in basis for c in range(d)]
    above = [[column[place] for place in places] for column in columns]
    chosen = _independent(above, len(places), prime)
    if len(chosen) < len(places):
        return None
    numerators, bottom = list[list[fmpz]](), fmpz(1)
    if chosen:
        target = fmpz_mat([[columns[j][(mu * p + output) * d] for mu, output in leads] for j in chosen])
        solution: Any = fmpz_mat([above[j] for j in chosen]).solve(target)
        top, bottom = solution.numer_denom()
        numerators = top.tolist()
    relations = []
    for a, (mu, output) in enumerate(leads):
        rows = [[fmpz(0)] * (p * d) for _ in range(mu + 1)]
        for b, (k, i) in enumerate(basis):
            values = [numerators[b * d + c][a] for c in range(d)]
            if (k, i) < (mu, output):
                rows[k][i * d : i * d + d] = [-value * scale**k for value in values]
            elif any(values):
                return None
        rows[mu][output * d] = bottom * scale**mu
        content = gcd(*(int(x) for row in rows for x in row))
        relations.append([[x // content for x in row] for row in rows])
    return relations


def coefficients_of(relation: list[list[fmpz]], system: ResidualSystem) -> Matrix:
    """The result has the field elements with the coordinates of a relation, (mu + 1) x p."""
    field, d = system.field, system.field.degree
    if isinstance(field, NumberField):
        parts = [[row[j : j + d] for j in range(0, len(row), d)] for row in relation]
        rows = [[field.from_coordinates([fmpq(x) for x in part]) for part in row] for row in parts]
        return Matrix.from_elements(field, len(rows), system.p, rows)
    return Matrix(field, len(relation), system.p, fmpq_mat(fmpz_mat(len(relation), system.p, [x for row in relation for x in row])))


def _numerators(*parts: Matrix) -> tuple[list[fmpz_mat], fmpz]:
    """The result has the blocks times their common denominator, and that denominator."""
    split = [part.flint.numer_denom() for part in parts]
    common = fmpz(1)
    for _, bottom in split:
        common = common.lcm(bottom)
    return [top * (common // bottom) for top, bottom in split], common


def _independent(table: list[list[fmpz]], width: int, prime: int) -> list[int]:
    """The result has the indices of the rows of the table that are independent, modulo the prime, of those above them."""
    if not table or not width:
        return []
    turned = [[row[j] for row in table] for j in range(width)]
    dependent = {max(i for i, x in enumerate(vector) if x) for vector in null_vectors(turned, len(table), prime)}
    return [i for i in range(len(table)) if i not in dependent]
