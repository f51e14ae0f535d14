"""Float answers read as the rationals that they are, so that a difference from the truth is theirs and not the comparison's."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import inf
from typing import Any

import numpy as np
import scipy  # its folders are loaded when they are first used
from flint import fmpq, fmpq_poly

from faultspace.exact.algebra import stability
from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.limits.lyapunov import solve
from faultspace.exact.limits.moesp import markov_parameters
from faultspace.exact.system.systems import from_float_exactly

from ....base.arrays import Array
from ..records import Broken


def lifted(values: Any, name: str, shape: tuple[int, int]) -> Matrix:
    """Return a float matrix over Q. Raises Broken for another shape and for entries that are not finite numbers."""
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise Broken(f"{name} is no matrix of real numbers") from None
    if array.ndim < 2 and array.size == shape[0] * shape[1]:
        array = array.reshape(shape)
    if array.shape != shape:
        raise Broken(f"{name} has shape {array.shape} where {shape} is due")
    if not np.all(np.isfinite(array)):
        raise Broken(f"{name} has entries that are NaN or infinite")
    return Matrix.of([[from_float_exactly(float(x)) for x in row] for row in array], shape=shape)


def markov(A: Matrix, B: Matrix, C: Matrix, D: Matrix, count: int) -> list[Matrix]:
    """These are the first `count` of D, CB, CAB, ...."""
    return markov_parameters(A, B, C, D, count)


def polynomial_from_the_top(A: Matrix) -> list[Fraction]:
    """These are the coefficients of det(zI - A), from that of z^n, which is 1, down."""
    return list(reversed(stability.rational_characteristic_polynomial(A)))


def transfer(A: Matrix, B: Matrix, C: Matrix, D: Matrix, z: int) -> Matrix:
    """Return D + C (zI - A)^-1 B. Raises Broken where z is a pole."""
    unit = Matrix.identity(QQ, A.nrows)
    try:
        return D + C @ solve(Matrix(QQ, A.nrows, A.nrows, unit.flint * fmpq(z)) - A, B)
    except ZeroDivisionError:
        raise Broken(f"the model has a pole at {z}") from None


def roots(ascending: Sequence[Any]) -> tuple[complex, ...]:
    """Return all roots with multiplicity, each the midpoint of a certified enclosure, by modulus and then argument."""
    polynomial = fmpq_poly([fmpq(c.numerator, c.denominator) if isinstance(c, Fraction) else c for c in ascending])
    enclosed: Any = polynomial.numer().complex_roots()
    found = [complex(root) for root, times in enclosed for _ in range(times)]
    return tuple(sorted(found, key=lambda z: (abs(z), z.imag, z.real)))


def poles(A: Matrix) -> tuple[complex, ...]:
    """The poles are the eigenvalues of A."""
    return roots(stability.rational_characteristic_polynomial(A)) if A.nrows else ()


def distances(got: Sequence[Matrix], exact: Sequence[Matrix]) -> Array:
    """Return |got - exact| for equally long lists of matrices, (count, rows, columns)."""
    return np.array(
        [[[_size(x) for x in row] for row in (one - other).elements()] for one, other in zip(got, exact, strict=True)], dtype=float
    )


def matched(got: Sequence[complex], exact: Sequence[complex]) -> tuple[list[int], Array]:
    """Return, for each exact number, in order, the index of the one that it is paired with, and their distance."""
    gaps = np.array([[abs(theirs - mine) for mine in got] for theirs in exact], dtype=float).reshape(len(exact), len(got))
    rows, columns = scipy.optimize.linear_sum_assignment(gaps)
    return [int(j) for j in columns], np.asarray(gaps[rows, columns])


def _size(x: Any) -> float:
    try:
        return abs(int(x.p) / int(x.q))
    except OverflowError:
        return inf
