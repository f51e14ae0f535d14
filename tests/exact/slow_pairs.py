"""These are slow and obvious routes to what `exact/pairs` finds fast: they share nothing with it but the linear algebra below both.

members_by_formula   im F + U + A (U inter ker C) with U = V* + S*: the members that `zero_feedthrough` reads off the fault space
pluecker_forms       h_J(q) from the pencils of (A, Fhat_J, C, Ghat_J): those of det [P | q b - a] up to one common constant
dimension_of         the dimension of the zeros of some polynomials over Q, by a Groebner basis: what `bad_set` counts

A maximal minor of the pencil of (A, Fhat P, C, Ghat P) on rows I is c_I(q) D(q; P) with c_I free of P; so one row set I with nonzero
minors gives every h_J times c_I, and c_I is found as what they all have in common besides `fixed`. Source: [G25] Theorem 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

import sympy

from faultspace.exact.algebra import polynomials
from faultspace.exact.algebra.matrices import Matrix, beside, column_basis, rank, right_null_space, stacked
from faultspace.exact.algebra.polynomials import Poly
from faultspace.exact.pairs.linear_determinants import linear_determinant
from faultspace.exact.pairs.polynomial import Exceptional
from faultspace.exact.structure.fault_columns import with_pair
from faultspace.exact.structure.inversion import largest_output_nulling
from faultspace.exact.structure.pencil import pencil_parts
from faultspace.exact.structure.zero_output import chain_from_rest
from faultspace.exact.system.systems import ResidualSystem

Subset = tuple[int, ...]


def members_by_formula(system: ResidualSystem) -> Matrix:
    """For G = 0 the result is im F + U + A (U inter ker C) with U = V* + S*, as a reduced column basis."""
    U = column_basis(beside(largest_output_nulling(system), chain_from_rest(system).last_subspace))
    silent = U @ right_null_space(system.C @ U)
    return column_basis(beside(system.F, U, system.A @ silent))


def pluecker_forms(pencil: Exceptional) -> dict[Subset, Poly]:
    """The h_J come from minors of size n + r of the pencils themselves; they equal those of the determinant up to one common constant."""
    field, r = pencil.system.field, pencil.columns
    subsets = list(combinations(range(pencil.n_z), r))
    unit = Matrix.identity(field, pencil.n_z)
    pencils = {J: pencil_parts(with_pair(pencil.space, unit.columns(J))) for J in subsets}
    rows = next(found for one in pencils.values() if (found := _independent_rows(one.constant, one.slope)) is not None)
    size = range(len(rows))
    minors = {
        J: linear_determinant(one.constant.rows(rows).columns(size), one.slope.rows(rows).columns(size)) for J, one in pencils.items()
    }
    common: Poly = ()
    for minor in minors.values():
        common = polynomials.gcd(common, minor)
    factor, rest = polynomials.divide(common, pencil.fixed)
    if rest:
        raise ArithmeticError("the unobservable modes are not zeros of every pair")
    return {J: polynomials.divide(h, factor)[0] for J, h in minors.items() if h}


def dimension_of(equations: Sequence[Any], unknowns: Sequence[Any]) -> int:
    """The result is the dimension over the closure of Q of the common zeros, -1 if there are none: that of the leading monomials.

    Doubly exponential: meant for a handful of equations of degree up to 3 in up to ten unknowns.
    """
    nonzero = [f for f in equations if f != 0]
    if not nonzero:
        return len(unknowns)
    basis = sympy.groebner(nonzero, *unknowns, order="grevlex")
    leading = [sympy.Poly(sympy.LM(f, *unknowns, order="grevlex"), *unknowns).monoms()[0] for f in basis.exprs]
    supports = [frozenset(i for i, e in enumerate(exponents) if e) for exponents in leading]
    if frozenset() in supports:
        return -1
    for size in range(len(unknowns), -1, -1):
        for free in combinations(range(len(unknowns)), size):
            if not any(support <= set(free) for support in supports):
                return size
    raise ArithmeticError("the empty set of unknowns is always free")


def _independent_rows(constant: Matrix, slope: Matrix) -> Subset | None:
    """These are rows of a nonzero maximal minor of X + q Y, or None where all are zero: greedy, by ranks over the field of rational
    functions.
    """
    if not _has_full_rank(constant, slope):
        return None
    rows: list[int] = []
    for i in range(constant.nrows):
        if len(rows) < constant.ncols and _has_full_rank(constant.rows([*rows, i]).transposed(), slope.rows([*rows, i]).transposed()):
            rows.append(i)
    return tuple(rows)


def _has_full_rank(constant: Matrix, slope: Matrix) -> bool:
    """This tells whether X + q Y has full column rank over K(q): no polynomial vector of degree up to its width is a null vector."""
    width = constant.ncols
    nothing = Matrix.zero(constant.field, constant.nrows, width)
    samples = width + 1
    lines = []
    for k in range(samples + 1):
        blocks = [constant if j == k else slope if j == k - 1 else nothing for j in range(samples)]
        lines.append(beside(*blocks))
    return rank(stacked(*lines)) == width * samples
