"""This is D(q; P) in the Pluecker coordinates of P, by Cauchy-Binet on the pencil itself: never expanded in P.

    PlueckerForms        h_J(q) for every r-subset J of the basis columns of Z: D(q; P) = sum over J of det(P_J) h_J(q)
    forms_of_determinant from the minors of q b - a (Laplace expansion), zeta x zeta
    value                the sum at a P
    coefficient_forms    the bad set as linear equations in the Pluecker coordinates: zeta + 1 rows, one a power of q

Source: [G25] Theorem 3.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations
from math import comb
from typing import Any

from ...base.errors import InvalidInput
from ..algebra import polynomials
from ..algebra.matrices import Matrix
from ..algebra.polynomials import Poly, written
from .linear_determinants import determinant, linear_determinant
from .polynomial import Exceptional, pair_matrix

MAX_FORMS = 20_000

Subset = tuple[int, ...]


@dataclass(frozen=True)
class PlueckerForms:
    """`minors` maps J, ascending 0-based rows of P, to h_J(q) as ascending coefficients; subsets with h_J = 0 are left out."""

    exceptional: Exceptional
    minors: Mapping[Subset, Poly]

    def to_json(self) -> dict[str, Any]:
        """Return the list of pairs (J, coefficients of h_J)."""
        field = self.exceptional.system.field
        return {"minors": [[list(J), written(h, field)] for J, h in sorted(self.minors.items())]}


def forms_of_determinant(pencil: Exceptional) -> PlueckerForms:
    """h_J is +- the minor of q b - a without the rows J: D itself, not up to a constant. Raises InvalidInput beyond MAX_FORMS subsets."""
    _affordable(pencil)
    minors: dict[Subset, Poly] = {}
    for J in combinations(range(pencil.n_z), pencil.columns):
        others = [i for i in range(pencil.n_z) if i not in J]
        h = linear_determinant(-pencil.a.rows(others), pencil.b.rows(others))
        if h:
            inversions = sum(row - place for place, row in enumerate(J))
            minors[J] = polynomials.negative(h) if inversions % 2 else h
    return PlueckerForms(pencil, minors)


def value(forms: PlueckerForms, P: object) -> Poly:
    """Return the sum over J of det(P_J) h_J(q) for P, n_z x r. Raises InvalidInput for another shape."""
    matrix = pair_matrix(forms.exceptional, P)
    total: Poly = ()
    for J, h in forms.minors.items():
        weight = determinant(matrix.rows(J))
        total = polynomials.add(total, polynomials.trimmed(weight * c for c in h))
    return total


def coefficient_forms(forms: PlueckerForms) -> tuple[tuple[Subset, ...], Matrix]:
    """Return (subsets, M): P is bad iff M times the column of det(P_J), J in that order, is 0.

    M has zeta + 1 rows, and row k has the coefficients of q^k. Its rank is zeta + 1 - deg fixed: all rows are independent where (A, C) is
    observable.
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
