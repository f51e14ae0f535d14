"""D(q; P) in the Pluecker coordinates of P, by Cauchy-Binet on the pencil itself: never expanded in P.

    PlueckerForms        h_J(q) for every r-subset J of the basis columns of Z: D(q; P) = sum over J of det(P_J) h_J(q)
    pluecker_forms       from the pencils of (A, Fhat_J, C, Ghat_J): shares nothing with det [P | q b - a], whose oracle it is
    forms_of_determinant the same from the minors of q b - a (Laplace expansion), zeta x zeta: the fast way
    value                the sum at a P
    coefficient_forms    the bad set as linear equations in the Pluecker coordinates: zeta + 1 rows, one a power of q

A maximal minor of the pencil of (A, Fhat P, C, Ghat P) on rows I is c_I(q) D(q; P) with c_I free of P; so one row set I with nonzero
minors gives every h_J times c_I, and c_I is found as what they all have in common besides `fixed`. Source: [G25] Theorem 3.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations
from math import comb
from typing import Any

from ...base.errors import InvalidInput
from ..algebra import polynomials
from ..algebra.matrices import Matrix, beside, rank, stacked
from ..algebra.polynomials import Poly, written
from ..structure.fault_columns import with_pair
from ..system.systems import ResidualSystem
from .linear_determinants import determinant, linear_determinant
from .polynomial import Exceptional, pair_matrix

MAX_FORMS = 20_000

Subset = tuple[int, ...]


@dataclass(frozen=True)
class PlueckerForms:
    """`minors` maps J, ascending 0-based rows of P, to h_J(q) as ascending coefficients; subsets with h_J = 0 are left out.

    `rows` is the row set I of the pencil that `pluecker_forms` took its minors on; () for `forms_of_determinant`.
    """

    exceptional: Exceptional
    rows: Subset
    minors: Mapping[Subset, Poly]

    def to_json(self) -> dict[str, Any]:
        """The row set and the list of pairs (J, coefficients of h_J)."""
        field = self.exceptional.system.field
        return {"rows": list(self.rows), "minors": [[list(J), written(h, field)] for J, h in sorted(self.minors.items())]}


def pluecker_forms(pencil: Exceptional) -> PlueckerForms:
    """h_J by minors of size n + r of the pencils themselves; equal to those of the determinant up to one common constant.

    Raises InvalidInput where there are more than MAX_FORMS subsets.
    """
    _affordable(pencil)
    field, r = pencil.system.field, pencil.columns
    subsets = list(combinations(range(pencil.n_z), r))
    unit = Matrix.identity(field, pencil.n_z)
    pencils = {J: _constant_and_slope(with_pair(pencil.space, unit.columns(J))) for J in subsets}
    rows = next(found for X, Y in pencils.values() if (found := _independent_rows(X, Y)) is not None)
    size = range(len(rows))
    minors = {J: linear_determinant(X.rows(rows).columns(size), Y.rows(rows).columns(size)) for J, (X, Y) in pencils.items()}
    common: Poly = ()
    for minor in minors.values():
        common = polynomials.gcd(common, minor)
    factor, rest = polynomials.divide(common, pencil.fixed)
    if rest:
        raise ArithmeticError("the unobservable modes are not zeros of every pair")
    return PlueckerForms(pencil, rows, {J: polynomials.divide(h, factor)[0] for J, h in minors.items() if h})


def forms_of_determinant(pencil: Exceptional) -> PlueckerForms:
    """h_J = +- the minor of q b - a without the rows J: D itself, not up to a constant. Raises InvalidInput beyond MAX_FORMS subsets."""
    _affordable(pencil)
    minors: dict[Subset, Poly] = {}
    for J in combinations(range(pencil.n_z), pencil.columns):
        others = [i for i in range(pencil.n_z) if i not in J]
        h = linear_determinant(-pencil.a.rows(others), pencil.b.rows(others))
        if h:
            inversions = sum(row - place for place, row in enumerate(J))
            minors[J] = polynomials.negative(h) if inversions % 2 else h
    return PlueckerForms(pencil, (), minors)


def value(forms: PlueckerForms, P: object) -> Poly:
    """sum over J of det(P_J) h_J(q) for P, n_z x r. Raises InvalidInput for another shape."""
    matrix = pair_matrix(forms.exceptional, P)
    total: Poly = ()
    for J, h in forms.minors.items():
        weight = determinant(matrix.rows(J))
        total = polynomials.add(total, polynomials.trimmed(weight * c for c in h))
    return total


def coefficient_forms(forms: PlueckerForms) -> tuple[tuple[Subset, ...], Matrix]:
    """(subsets, M): P is bad iff M times the column of det(P_J), J in that order, is 0. M has zeta + 1 rows, row k the coefficient of q^k.

    The rank of M is zeta + 1 - deg fixed: all rows are independent where (A, C) is observable.
    """
    pencil = forms.exceptional
    field = pencil.system.field
    subsets = tuple(sorted(forms.minors))
    zero = field.element(0)
    rows = [[_coefficient(forms.minors[J], k, zero) for J in subsets] for k in range(pencil.zeta + 1)]
    return subsets, Matrix.from_elements(field, pencil.zeta + 1, len(subsets), rows)


def _coefficient(polynomial: Poly, power: int, zero: Any) -> Any:
    return polynomial[power] if power < len(polynomial) else zero


def _affordable(pencil: Exceptional) -> None:
    count = comb(pencil.n_z, pencil.columns)
    if count > MAX_FORMS:
        raise InvalidInput(
            f"Pluecker coordinates: {pencil.columns} of {pencil.n_z} rows can be chosen in {count} ways, at most {MAX_FORMS} are written "
            f"out; judge(exceptional, P) decides one P without them"
        )


def _constant_and_slope(system: ResidualSystem) -> tuple[Matrix, Matrix]:
    """The pencil [[qI - A, -F], [C, G]] as X + q Y."""
    top = beside(Matrix.identity(system.field, system.n), Matrix.zero(system.field, system.n, system.m))
    slope = stacked(top, Matrix.zero(system.field, system.p, system.n + system.m))
    return stacked(beside(-system.A, -system.F), beside(system.C, system.G)), slope


def _independent_rows(constant: Matrix, slope: Matrix) -> Subset | None:
    """Rows of a nonzero maximal minor of X + q Y, or None where all are zero: greedy, by ranks over the field of rational functions."""
    if not _has_full_rank(constant, slope):
        return None
    rows: list[int] = []
    for i in range(constant.nrows):
        if len(rows) < constant.ncols and _has_full_rank(constant.rows([*rows, i]).transposed(), slope.rows([*rows, i]).transposed()):
            rows.append(i)
    return tuple(rows)


def _has_full_rank(constant: Matrix, slope: Matrix) -> bool:
    """Whether X + q Y has full column rank over K(q): no polynomial vector of degree up to its width is a null vector."""
    width = constant.ncols
    nothing = Matrix.zero(constant.field, constant.nrows, width)
    samples = width + 1
    lines = []
    for k in range(samples + 1):
        blocks = [constant if j == k else slope if j == k - 1 else nothing for j in range(samples)]
        lines.append(beside(*blocks))
    return rank(stacked(*lines)) == width * samples
