"""This decides whether all eigenvalues lie inside the unit circle: by Leibniz, the map q = (1 + w) / (1 - w), and Hurwitz.

determinant(field, rows)       of polynomials, by Leibniz
characteristic_polynomial(s)   det(qI - A) over K
norm(field, f)                 the product of the conjugates of f in K[q], a polynomial over Q: how K[q] multiplies by f, as a determinant
inside_circle(f)               whether all roots of a rational polynomial that is not zero have modulus below 1
is_stable(system)              over Q(a) for every root a of the minimal polynomial
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, permutations

from . import polynomials
from .fields import Element, Field, NumberField, PrimeField, Rationals
from .polynomials import Polynomial
from .systems import System


def determinant(field: Field, rows: list[list[Polynomial]]) -> Polynomial:
    """The result is the sum over all permutations, which is 1 for no rows."""
    total: Polynomial = []
    for order in permutations(range(len(rows))):
        inversions = sum(1 for i, j in combinations(range(len(order)), 2) if order[i] > order[j])
        term: Polynomial = [field.integer((-1) ** inversions)]
        for row, j in zip(rows, order, strict=True):
            term = polynomials.multiply(term, row[j])
        total = polynomials.add(total, term)
    return total


def characteristic_polynomial(system: System) -> Polynomial:
    """The result is det(qI - A), monic of degree n."""
    field = system.field
    rows = [[polynomials.trimmed([-x, field.integer(int(i == j))]) for j, x in enumerate(row)] for i, row in enumerate(system.A.rows)]
    return determinant(field, rows)


def norm(field: NumberField, f: Polynomial) -> Polynomial:
    """The result is the determinant of multiplication by f on the basis 1, a, ..., a^(d-1) of Q(a)[q] over Q[q]."""
    d = len(field.modulus) - 1
    power: Element = field.one
    rows = []
    for _ in range(d):
        images = [list((power * c).coefficients) for c in f]
        rows.append([polynomials.trimmed([x[j] if j < len(x) else Fraction(0) for x in images]) for j in range(d)])
        power = power * field.generator
    return determinant(Rationals(), rows)


def inside_circle(f: Polynomial) -> bool:
    """This tells whether (1 - w)^d f((1 + w) / (1 - w)) has degree d and all its roots in the open left half plane, by Hurwitz.

    The map takes the unit disc to the half plane and -1 to infinity. The leading minors of Hurwitz's matrix are positive iff elimination
    without exchange of rows finds positive pivots.
    """
    d = polynomials.degree(f)
    mapped: Polynomial = []
    for k, c in enumerate(f):
        term: Polynomial = polynomials.trimmed([c])
        for factor in [[Fraction(1), Fraction(1)]] * k + [[Fraction(1), Fraction(-1)]] * (d - k):
            term = polynomials.multiply(term, factor)
        mapped = polynomials.add(mapped, term)
    if polynomials.degree(mapped) < d:
        return False
    descending = [c / mapped[-1] for c in reversed(mapped)]
    rows = [[descending[2 * j - i] if 0 <= 2 * j - i <= d else Fraction(0) for j in range(1, d + 1)] for i in range(1, d + 1)]
    for i in range(d):
        if rows[i][i] <= 0:
            return False
        for k in range(i + 1, d):
            ratio = rows[k][i] / rows[i][i]
            rows[k] = [x - ratio * y for x, y in zip(rows[k], rows[i], strict=True)]
    return True


def is_stable(system: System) -> bool:
    """This tells whether A is Schur stable for every embedding. Raises ValueError over a prime field."""
    if isinstance(system.field, PrimeField):
        raise ValueError("a prime field has no unit circle")
    f = characteristic_polynomial(system)
    return inside_circle(norm(system.field, f) if isinstance(system.field, NumberField) else f)
