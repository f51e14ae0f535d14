"""This computes det(X + q Y) of square matrices over any field, as a polynomial in q: the one determinant behind the exceptional set.

    linear_determinant   the polynomial: by values at integer points over Q, by deflation over the other fields
    by_values            as many determinants as the degree may have coefficients, then interpolation; needs that many points
    by_deflation         columns without q are eliminated until Y is invertible, then a characteristic polynomial; any field
    determinant          of a constant matrix, any field

The two routes share nothing but the matrix product, so each is the other's oracle. Source: [VD79] for the deflation.
"""

from __future__ import annotations

from typing import Any

from flint import fmpq, fmpz_mat

from ...base.errors import InvalidInput
from ..algebra import polynomials
from ..algebra.fields import NumberField, PrimeField, Rationals
from ..algebra.matrices import Matrix, rank, right_null_space, row_echelon, row_profile, solve_left
from ..algebra.polynomials import Poly
from ..structure.pencil import characteristic_polynomial


def determinant(matrix: Matrix) -> Any:
    """det M, a field element; M is square (InvalidInput otherwise). The empty determinant is 1."""
    _square(matrix)
    if matrix.nrows == 0:
        return matrix.field.element(1)
    if isinstance(matrix.field, NumberField):
        value = characteristic_polynomial(matrix)[0]
        return -value if matrix.nrows % 2 else value
    return matrix.flint.det()


def linear_determinant(constant: Matrix, slope: Matrix) -> Poly:
    """Return det(constant + q slope), exactly and not up to a unit. Raises InvalidInput unless both are square of one size."""
    if isinstance(constant.field, Rationals):
        return by_values(constant, slope)
    return by_deflation(constant, slope)


def by_values(constant: Matrix, slope: Matrix) -> Poly:
    """Return det(constant + q slope) from its values at q = 0..rank(slope).

    Raises InvalidInput over number fields and over prime fields without that many elements.
    """
    _square(constant, slope)
    field, degree = constant.field, rank(slope)
    if isinstance(field, PrimeField):
        if field.p <= degree:
            raise InvalidInput(f"field: {field} has fewer than the {degree + 1} points that are needed; use by_deflation")
        points = [field.element(k) for k in range(degree + 1)]
        return polynomials.interpolate(points, [determinant(_at(constant, slope, point)) for point in points])
    if isinstance(field, NumberField):
        raise InvalidInput(f"field: got {field}, expected Q or a prime field; use by_deflation")
    (top, bottom), (slope_top, slope_bottom) = constant.flint.numer_denom(), slope.flint.numer_denom()
    a, b = fmpz_mat(top * slope_bottom), fmpz_mat(slope_top * bottom)
    scale = fmpq(bottom * slope_bottom) ** constant.nrows
    values = [fmpq((a + b * k).det()) / scale for k in range(degree + 1)]
    return polynomials.interpolate([fmpq(k) for k in range(degree + 1)], values)


def by_deflation(constant: Matrix, slope: Matrix) -> Poly:
    """Return det(constant + q slope): combinations of columns that have no q are eliminated, which leaves a smaller such
    determinant.
    """
    _square(constant, slope)
    factor = constant.field.element(1)
    while True:
        size = constant.nrows
        kept = row_echelon(slope).pivots
        if len(kept) == size:
            monic = characteristic_polynomial(-_divided_from_the_left(constant, slope))
            factor = factor * determinant(slope)
            return polynomials.trimmed(factor * c for c in monic)
        # the change of columns is unit triangular but for the order: null vectors have their unit at the columns not kept
        null = right_null_space(slope)
        still = constant @ null
        rows = row_profile(still)
        if len(rows) < null.ncols:
            return ()
        others = [i for i in range(size) if i not in rows]
        pivot_block = still.rows(rows)
        factor = factor * determinant(pivot_block)
        if (_inversions(kept, size) + _inversions(others, size)) % 2:
            factor = -factor
        multipliers = solve_left(pivot_block, still.rows(others))
        if multipliers is None:
            raise ArithmeticError("an invertible block has no inverse")
        constant, slope = (part.columns(kept).rows(others) - multipliers @ part.columns(kept).rows(rows) for part in (constant, slope))


def _divided_from_the_left(constant: Matrix, slope: Matrix) -> Matrix:
    """Return slope^-1 constant."""
    quotient = solve_left(slope.transposed(), constant.transposed())
    if quotient is None:
        raise ArithmeticError("an invertible matrix has no inverse")
    return quotient.transposed()


def _inversions(chosen: Any, size: int) -> int:
    """This says how many pairs are out of order when the chosen indices are moved to the front."""
    return sum(index - place for place, index in enumerate(chosen))


def _at(constant: Matrix, slope: Matrix, point: Any) -> Matrix:
    size = constant.nrows
    return constant + Matrix.from_elements(constant.field, size, size, [[point * x for x in row] for row in slope.elements()])


def _square(*matrices: Matrix) -> None:
    first = matrices[0]
    for matrix in matrices:
        if matrix.shape != (first.nrows, first.nrows):
            raise InvalidInput(f"determinant: got {matrix.nrows} x {matrix.ncols}, expected {first.nrows} x {first.nrows}")
        if matrix.field != first.field:
            raise InvalidInput(f"determinant: got entries over {matrix.field}, expected {first.field}")
