"""A number field with one of its real roots: what is inside the unit circle is then a question with one answer.

    RealField            Q(a), a being the one root of its polynomial between two rationals
    sign                 the sign of an element there, exactly
    one_modulus          whether every embedding of a field has the same moduli, so that none has to be chosen
    inside_the_circle    whether every complex root of a polynomial over a field lies inside the unit circle, at the chosen embedding
    stable_there         whether every eigenvalue of a matrix does

An element that is not zero gets its sign from intervals: the root is enclosed ever closer, by bisection, until the interval of the element
does not hold zero. The recursion of Schur and Cohn ([S17]) needs no more than such signs. An imaginary quadratic field needs no choice: its
two embeddings are conjugate, and a polynomial times its conjugate is rational, with the same moduli of roots.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq, fmpq_poly

from ...base.errors import InvalidInput
from .fields import AlgebraicNumber, Field, NumberField, PrimeField
from .matrices import Matrix
from .stability import is_schur, is_stable


@dataclass(frozen=True, eq=False)
class RealField(NumberField):
    """Q(a) as NumberField, a being the one real root of the polynomial between the rationals `lower` and `upper`.

    Two of them are equal where polynomial and bounds are, and none equals the field without a root. Files hold the polynomial alone.

    Raises InvalidInput unless the polynomial is irreducible and has exactly one root between the two.
    """

    lower: Fraction
    upper: Fraction

    def __post_init__(self) -> None:
        super().__post_init__()
        count = self.roots_between(self.lower, self.upper)
        if count != 1:
            told = f"{count} roots of {str(self.without_root).removeprefix('Q(a) with ')} between {self.lower} and {self.upper}"
            raise InvalidInput(f"field: got {told}, expected exactly one")

    @property
    def without_root(self) -> NumberField:
        """The field in which no root is chosen."""
        return NumberField(self.minimal_polynomial)

    def roots_between(self, lower: Fraction, upper: Fraction) -> int:
        """Return the number of real roots between the two, counted by Sturm's chain."""
        if lower >= upper:
            return 0
        at_ends = sum(not self.modulus(fmpq(x.numerator, x.denominator)) for x in (lower, upper))  # of degree 1 alone: else there are none
        return _real_roots(self, lower, upper) - at_ends

    def __eq__(self, other: object) -> bool:
        """The same polynomial, or a multiple, and the same bounds."""
        return isinstance(other, RealField) and self._monic == other._monic and (self.lower, self.upper) == (other.lower, other.upper)

    def __hash__(self) -> int:
        return hash((self._monic, self.lower, self.upper))

    def __str__(self) -> str:
        return f"{super().__str__()} and {self.lower} < a < {self.upper}"


def _real_roots(field: NumberField, *ends: Fraction) -> int:
    """Return the number of real roots of the polynomial, ends included where there are some."""
    from sympy import Poly, Rational, Symbol  # it takes long to load, and few claims need it

    def rational(x: Fraction) -> Any:
        return Rational(x.numerator, x.denominator)

    polynomial = Poly([rational(c) for c in reversed(field.minimal_polynomial)], Symbol("a"))
    return int(polynomial.count_roots(*map(rational, ends)))


def sign(x: AlgebraicNumber) -> int:
    """Return -1, 0 or 1, the sign of an element of a RealField. Raises TypeError for another field."""
    field = x.field
    if not isinstance(field, RealField):
        raise TypeError(f"got an element of {field}, expected one of a field with a real root")
    if not x.poly:
        return 0
    lower, upper = (fmpq(end.numerator, end.denominator) for end in (field.lower, field.upper))
    rising = field.modulus(upper) > 0  # the root is simple, and alone in the interval
    while True:
        low, high = _between(x.poly, lower, upper)
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
        middle = (lower + upper) / 2
        value = field.modulus(middle)
        if value == 0:  # of degree 1: the root is rational
            lower = upper = middle
        elif (value > 0) == rising:
            upper = middle
        else:
            lower = middle


def _between(f: fmpq_poly, lower: fmpq, upper: fmpq) -> tuple[fmpq, fmpq]:
    """Return bounds of f on an interval, by Horner's scheme in intervals."""
    low = high = fmpq(0)
    for c in reversed(f.coeffs()):
        ends = low * lower, low * upper, high * lower, high * upper
        low, high = min(ends) + c, max(ends) + c
    return low, high


def one_modulus(field: Field) -> bool:
    """Return whether "inside the unit circle" has one meaning for an element.

    It has over Q, with a chosen root, in degree 1, and where the roots are conjugate.
    """
    if isinstance(field, PrimeField):
        return False
    if isinstance(field, RealField) or field.degree == 1:
        return True
    return field.degree == 2 and isinstance(field, NumberField) and _real_roots(field) == 0


def inside_the_circle(coefficients: Sequence[Any], field: Field) -> bool:
    """Return whether all complex roots of sum coefficients[k] q^k, elements of the field, have modulus below 1, at the chosen embedding.

    Raises InvalidInput for the zero polynomial, and where no embedding is chosen and they differ.
    """
    if not one_modulus(field):
        raise InvalidInput(f"got {field}, expected Q, or a number field with its real root, as in {field} and 1 < a < 2")
    if not isinstance(field, NumberField):
        return is_schur([Fraction(int(c.p), int(c.q)) for c in map(fmpq, coefficients)])
    values = [field.element(c) for c in coefficients]
    if not isinstance(field, RealField):
        return is_schur(_times_conjugate(values, field))
    while values and values[-1] == 0:
        values.pop()
    if not values:
        raise InvalidInput("got the zero polynomial, expected one that is not zero: every number is a root of it")
    while len(values) > 1:
        first, last = values[0], values[-1]
        if sign(last * last - first * first) <= 0:
            return False
        reversed_values = list(reversed(values))
        values = [last * x - first * y for x, y in zip(values[1:], reversed_values[1:], strict=True)]
    return True


def _times_conjugate(values: list[AlgebraicNumber], field: NumberField) -> list[Fraction]:
    """Return the polynomial times its conjugate over an imaginary quadratic field, or itself in degree 1; it is rational."""
    if field.degree == 1:
        return [Fraction(int(x.poly[0].p), int(x.poly[0].q)) for x in values]
    c0, c1, c2 = (field.modulus[k] for k in range(3))
    total, product = -c1 / c2, c0 / c2  # of a and its conjugate

    def rational(x: AlgebraicNumber, y: AlgebraicNumber) -> fmpq:
        """x times the conjugate of y, and y times that of x, half of both together."""
        (p, q), (r, s) = field.coordinates(x), field.coordinates(y)
        return p * r + (p * s + q * r) * total / 2 + q * s * product

    found = [fmpq(0)] * max(2 * len(values) - 1, 0)
    for i, x in enumerate(values):
        for j, y in enumerate(values):
            found[i + j] += rational(x, y)
    return [Fraction(int(c.p), int(c.q)) for c in found]


def stable_there(A: Matrix) -> bool:
    """Return whether all eigenvalues of A (n x n, over Q or Q(a)) lie inside the unit circle at the chosen embedding.

    Raises InvalidInput where none is chosen and they differ, over GF(p), and for what is no square matrix.
    """
    if not isinstance(A.field, NumberField):
        return is_stable(A)
    if A.nrows != A.ncols:
        raise InvalidInput(f"got a matrix {A.nrows} x {A.ncols}, expected a square one")
    n, field = A.nrows, A.field
    found, product = [field.element(1)], Matrix.identity(field, n)
    for k in range(1, n + 1):  # Faddeev and LeVerrier: the coefficients of det(qI - A) from the highest down
        image = A @ product
        trace = sum((image[i, i] for i in range(1, n)), image[0, 0])
        found.append(trace / field.element(-k))
        shift = [[found[-1] if i == j else field.element(0) for j in range(n)] for i in range(n)]
        product = image + Matrix.from_elements(field, n, n, shift)
    return inside_the_circle(found[::-1], field)
