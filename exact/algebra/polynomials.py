"""These are polynomials over any of the fields: what certificates about zeros are made of.

    Poly                tuple of field elements by ascending power, no trailing zeros; () is zero
    add, negative, multiply, divide, monic, gcd
    interpolate         the polynomial of degree below the number of points through them (Newton), over Q and GF(p)
    PolyMatrix          list of rows of Poly
    smith_diagonal      left M right = diagonal, with left, right and their inverses unimodular
    AlgebraicPoly       polynomials over Q(a)

A Poly is what records hold and files write. What computes is FLINT's polynomial over Q and over GF(p); python-flint has none over a number
field (its fq_default_poly is for finite ones), so that AlgebraicPoly does the same by the rules of school. Entries of multipliers grow
quickly: `smith_diagonal` is meant for pencils of a few states.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpq, fmpq_poly, nmod, nmod_poly

from .fields import Field

Poly = tuple[Any, ...]
PolyMatrix = list[list[Poly]]


@dataclass(frozen=True)
class AlgebraicPoly:
    """A polynomial over Q(a) with the operators that FLINT's polynomials have; `ascending` has no trailing zeros."""

    ascending: Poly

    def coeffs(self) -> Poly:
        """Return the coefficients by ascending power."""
        return self.ascending

    def degree(self) -> int:
        """The degree is -1 for zero."""
        return len(self.ascending) - 1

    def __bool__(self) -> bool:
        return bool(self.ascending)

    def __neg__(self) -> AlgebraicPoly:
        return AlgebraicPoly(tuple(-x for x in self.ascending))

    def __add__(self, other: AlgebraicPoly) -> AlgebraicPoly:
        longer, shorter = sorted((self.ascending, other.ascending), key=len, reverse=True)
        return AlgebraicPoly(trimmed([x + y for x, y in zip(longer, shorter, strict=False)] + list(longer[len(shorter) :])))

    def __mul__(self, other: AlgebraicPoly) -> AlgebraicPoly:
        if not self or not other:
            return AlgebraicPoly(())
        result = [self.ascending[0] * 0] * (self.degree() + other.degree() + 1)
        for i, x in enumerate(self.ascending):
            for j, y in enumerate(other.ascending):
                result[i + j] = result[i + j] + x * y
        return AlgebraicPoly(trimmed(result))

    def __divmod__(self, other: AlgebraicPoly) -> tuple[AlgebraicPoly, AlgebraicPoly]:
        divisor, rest = other.ascending, list(self.ascending)
        quotient: list[Any] = [divisor[-1] * 0] * max(0, len(rest) - len(divisor) + 1)
        for k in reversed(range(len(quotient))):
            quotient[k] = rest[k + len(divisor) - 1] / divisor[-1]
            for i, x in enumerate(divisor):
                rest[k + i] = rest[k + i] - quotient[k] * x
        return AlgebraicPoly(trimmed(quotient)), AlgebraicPoly(trimmed(rest))

    def gcd(self, other: AlgebraicPoly) -> AlgebraicPoly:
        """Return the monic greatest common divisor, by Euclid."""
        f, g = self, other
        while g:
            f, g = g, divmod(f, g)[1]
        return AlgebraicPoly(monic(f.ascending))


def _packed(f: Poly, one: Any) -> Any:
    """Return the polynomial that computes, over the field of the element `one`."""
    if isinstance(one, fmpq):
        return fmpq_poly(list(f))
    if isinstance(one, nmod):
        return nmod_poly([int(x) for x in f], one.modulus())
    return AlgebraicPoly(f)


def trimmed(coefficients: Iterable[Any]) -> Poly:
    """Return the polynomial with these ascending coefficients."""
    result = list(coefficients)
    while result and result[-1] == 0:
        result.pop()
    return tuple(result)


def add(f: Poly, g: Poly) -> Poly:
    """Return the sum f + g."""
    if not f or not g:
        return f or g
    return tuple((_packed(f, f[-1]) + _packed(g, f[-1])).coeffs())


def negative(f: Poly) -> Poly:
    """Return the polynomial -f."""
    return tuple(-x for x in f)


def multiply(f: Poly, g: Poly) -> Poly:
    """Return the product f g."""
    if not f or not g:
        return ()
    return tuple((_packed(f, f[-1]) * _packed(g, f[-1])).coeffs())


def divide(f: Poly, g: Poly) -> tuple[Poly, Poly]:
    """Return the quotient and the remainder of f by g. Raises ZeroDivisionError when g is zero."""
    if not g:
        raise ZeroDivisionError("division by the zero polynomial")
    quotient, remainder = divmod(_packed(f, g[-1]), _packed(g, g[-1]))
    return tuple(quotient.coeffs()), tuple(remainder.coeffs())


def monic(f: Poly) -> Poly:
    """f is divided by its leading coefficient; zero stays zero."""
    return tuple(x / f[-1] for x in f)


def gcd(f: Poly, g: Poly) -> Poly:
    """Return the monic greatest common divisor."""
    if not f or not g:
        return monic(f or g)
    return tuple(_packed(f, f[-1]).gcd(_packed(g, f[-1])).coeffs())


def interpolate(points: Sequence[Any], values: Sequence[Any]) -> Poly:
    """Return the polynomial of degree below len(points) with these values, by divided differences."""
    if not points:
        return ()
    differences = list(values)
    for width in range(1, len(points)):
        for i in reversed(range(width, len(points))):
            differences[i] = (differences[i] - differences[i - 1]) / (points[i] - points[i - width])
    one = points[0] * 0 + 1
    result = _packed((), one)
    for point, value in zip(reversed(points), reversed(differences), strict=True):
        result = result * _packed((-point, one), one) + _packed((value,), one)
    return tuple(result.coeffs())


def written(f: Poly, field: Field) -> list[object]:
    """Return the coefficients as the exact file formats write them."""
    return [field.write(a) for a in f]


@dataclass(frozen=True)
class SmithDiagonal:
    """left M right is the matrix with `diagonal` and zeros elsewhere; left left_inverse and right right_inverse are identities."""

    diagonal: tuple[Poly, ...]
    left: PolyMatrix
    left_inverse: PolyMatrix
    right: PolyMatrix
    right_inverse: PolyMatrix


def smith_diagonal(matrix: PolyMatrix, nrows: int, ncols: int, one: Any) -> SmithDiagonal:
    """A diagonal form is reached by unimodular operations (each entry need not divide the next), with multipliers and inverses."""
    work = [[_packed(f, one) for f in row] for row in matrix]
    left, left_inverse = _unit(nrows, one), _unit(nrows, one)
    right, right_inverse = _unit(ncols, one), _unit(ncols, one)
    for k in range(min(nrows, ncols)):
        while True:
            found = [(work[i][j].degree(), i, j) for i in range(k, nrows) for j in range(k, ncols) if work[i][j]]
            if not found:
                break
            _, i, j = min(found)
            for table in (work, left):
                _swap_rows(table, k, i)
            for table in (work, right):
                _swap_columns(table, k, j)
            _swap_columns(left_inverse, k, i)
            _swap_rows(right_inverse, k, j)
            for i in range(k + 1, nrows):
                factor, _ = divmod(work[i][k], work[k][k])
                for table in (work, left):
                    _add_row(table, i, k, -factor)
                _add_column(left_inverse, k, i, factor)
            for j in range(k + 1, ncols):
                factor, _ = divmod(work[k][j], work[k][k])
                for table in (work, right):
                    _add_column(table, j, k, -factor)
                _add_row(right_inverse, k, j, factor)
            if not any(work[i][k] for i in range(k + 1, nrows)) and not any(work[k][j] for j in range(k + 1, ncols)):
                break
    diagonal = tuple(tuple(work[k][k].coeffs()) for k in range(min(nrows, ncols)))
    return SmithDiagonal(diagonal, *(_unpacked(table) for table in (left, left_inverse, right, right_inverse)))


Table = list[list[Any]]


def _unpacked(table: Table) -> PolyMatrix:
    return [[tuple(f.coeffs()) for f in row] for row in table]


def _unit(size: int, one: Any) -> Table:
    return [[_packed((one,) if i == j else (), one) for j in range(size)] for i in range(size)]


def _swap_rows(m: Table, i: int, j: int) -> None:
    m[i], m[j] = m[j], m[i]


def _swap_columns(m: Table, i: int, j: int) -> None:
    for row in m:
        row[i], row[j] = row[j], row[i]


def _add_row(m: Table, target: int, source: int, factor: Any) -> None:
    if factor:
        m[target] = [x + factor * y for x, y in zip(m[target], m[source], strict=True)]


def _add_column(m: Table, target: int, source: int, factor: Any) -> None:
    if factor:
        for row in m:
            row[target] = row[target] + row[source] * factor
