"""Polynomials over any of the fields, small and plain: what certificates about zeros are made of.

    Poly                tuple of field elements by ascending power, no trailing zeros; () is zero
    add, subtract, multiply, divide, monic, gcd, evaluate
    interpolate         the polynomial of degree below the number of points through them (Newton)
    PolyMatrix          list of rows of Poly
    smith_diagonal      left M right = diagonal, with left, right and their inverses unimodular

Entries of multipliers grow quickly: meant for pencils of a few states.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from .fields import Field

Poly = tuple[Any, ...]
PolyMatrix = list[list[Poly]]


def trimmed(coefficients: Iterable[Any]) -> Poly:
    """The result is the polynomial with these ascending coefficients."""
    result = list(coefficients)
    while result and result[-1] == 0:
        result.pop()
    return tuple(result)


def add(f: Poly, g: Poly) -> Poly:
    """The result is the sum f + g."""
    if len(f) < len(g):
        f, g = g, f
    return trimmed([a + b for a, b in zip(f, g, strict=False)] + list(f[len(g) :]))


def negative(f: Poly) -> Poly:
    """The result is -f."""
    return tuple(-a for a in f)


def subtract(f: Poly, g: Poly) -> Poly:
    """The result is the difference f - g."""
    return add(f, negative(g))


def multiply(f: Poly, g: Poly) -> Poly:
    """The result is the product f g."""
    if not f or not g:
        return ()
    result = [f[0] * g[0] * 0] * (len(f) + len(g) - 1)
    for i, a in enumerate(f):
        for j, b in enumerate(g):
            result[i + j] = result[i + j] + a * b
    return trimmed(result)


def divide(f: Poly, g: Poly) -> tuple[Poly, Poly]:
    """The result is the quotient and the remainder of f by g. Raises ZeroDivisionError when g is zero."""
    if not g:
        raise ZeroDivisionError("division by the zero polynomial")
    remainder = list(f)
    quotient: list[Any] = [g[-1] * 0] * max(0, len(f) - len(g) + 1)
    for k in reversed(range(len(quotient))):
        factor = remainder[k + len(g) - 1] / g[-1]
        quotient[k] = factor
        for i, b in enumerate(g):
            remainder[k + i] = remainder[k + i] - factor * b
    return trimmed(quotient), trimmed(remainder)


def monic(f: Poly) -> Poly:
    """f divided by its leading coefficient; zero stays zero."""
    return tuple(a / f[-1] for a in f)


def gcd(f: Poly, g: Poly) -> Poly:
    """The result is the monic greatest common divisor."""
    while g:
        f, g = g, divide(f, g)[1]
    return monic(f)


def evaluate(f: Poly, point: Any) -> Any:
    """The result is f(point), which is 0 for the zero polynomial."""
    value: Any = point * 0
    for a in reversed(f):
        value = value * point + a
    return value


def interpolate(points: Sequence[Any], values: Sequence[Any]) -> Poly:
    """The result is the polynomial of degree below len(points) with these values, by divided differences."""
    differences = list(values)
    for width in range(1, len(points)):
        for i in reversed(range(width, len(points))):
            differences[i] = (differences[i] - differences[i - 1]) / (points[i] - points[i - width])
    result: Poly = ()
    for point, value in zip(reversed(points), reversed(differences), strict=True):
        shifted = (value * 0, *result)
        scaled = tuple(-point * a for a in result)
        result = add(add(trimmed(shifted), trimmed(scaled)), trimmed([value]))
    return result


def written(f: Poly, field: Field) -> list[object]:
    """These are the coefficients as the exact file formats write them."""
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
    """A diagonal form by unimodular operations (each entry need not divide the next), with multipliers and inverses."""
    work = [list(row) for row in matrix]
    left, left_inverse = _unit(nrows, one), _unit(nrows, one)
    right, right_inverse = _unit(ncols, one), _unit(ncols, one)
    for k in range(min(nrows, ncols)):
        while True:
            found = [(len(work[i][j]), i, j) for i in range(k, nrows) for j in range(k, ncols) if work[i][j]]
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
                factor, _ = divide(work[i][k], work[k][k])
                for table in (work, left):
                    _add_row(table, i, k, negative(factor))
                _add_column(left_inverse, k, i, factor)
            for j in range(k + 1, ncols):
                factor, _ = divide(work[k][j], work[k][k])
                for table in (work, right):
                    _add_column(table, j, k, negative(factor))
                _add_row(right_inverse, k, j, factor)
            if not any(work[i][k] for i in range(k + 1, nrows)) and not any(work[k][j] for j in range(k + 1, ncols)):
                break
    diagonal = tuple(work[k][k] for k in range(min(nrows, ncols)))
    return SmithDiagonal(diagonal, left, left_inverse, right, right_inverse)


def _unit(size: int, one: Any) -> PolyMatrix:
    return [[(one,) if i == j else () for j in range(size)] for i in range(size)]


def _swap_rows(m: PolyMatrix, i: int, j: int) -> None:
    m[i], m[j] = m[j], m[i]


def _swap_columns(m: PolyMatrix, i: int, j: int) -> None:
    for row in m:
        row[i], row[j] = row[j], row[i]


def _add_row(m: PolyMatrix, target: int, source: int, factor: Poly) -> None:
    if factor:
        m[target] = [add(a, multiply(factor, b)) for a, b in zip(m[target], m[source], strict=True)]


def _add_column(m: PolyMatrix, target: int, source: int, factor: Poly) -> None:
    if factor:
        for row in m:
            row[target] = add(row[target], multiply(row[source], factor))
