"""Schur stability decided exactly: are all eigenvalues inside the unit circle? No eigenvalue is computed.

    rational_characteristic_polynomial   det(qI - A) over Q, over Q(a) its norm down to Q; coefficients ascending, as Fractions
    is_schur                             all roots of a rational polynomial inside the unit circle, by the recursion of Schur and Cohn
    is_stable                            the same for the eigenvalues of A; over Q(a) for every embedding of the field

A polynomial f of degree d has all its roots inside the unit circle iff |f_d| > |f_0| and (f_d f - f_0 f*) / q has, f* being f with its
coefficients reversed ([S17]; Schur and Cohn). The recursion runs on integers, content removed at each step.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm

from ...base.errors import InvalidInput
from .fields import PrimeField
from .matrices import Matrix, as_matrix


def rational_characteristic_polynomial(A: Matrix) -> tuple[Fraction, ...]:
    """Return det(qI - A), ascending and monic, for A n x n over Q; over Q(a) its norm, of degree n d. Raises InvalidInput over
    GF(p).
    """
    if isinstance(A.field, PrimeField):
        raise InvalidInput(f"got a matrix over {A.field}, expected one over Q or a number field: a finite field has no unit circle")
    if A.nrows != A.ncols:
        raise InvalidInput(f"got a matrix {A.nrows} x {A.ncols}, expected a square one")
    return tuple(Fraction(int(c.p), int(c.q)) for c in A.flint.charpoly().coeffs())  # a Matrix over Q(a) is that of its blocks over Q


def is_schur(coefficients: Sequence[Fraction | int]) -> bool:
    """This tells whether every complex root of sum coefficients[k] q^k has modulus below 1; a constant has none. Raises InvalidInput for
    zero.
    """
    values = [Fraction(c) for c in coefficients]
    while values and values[-1] == 0:
        values.pop()
    if not values:
        raise InvalidInput("got the zero polynomial, expected one that is not zero: every number is a root of it")
    common = lcm(*(c.denominator for c in values))
    f = [int(c * common) for c in values]
    while len(f) > 1:
        if abs(f[-1]) <= abs(f[0]):
            return False
        f = [f[-1] * x - f[0] * y for x, y in zip(f[1:], reversed(f[:-1]), strict=True)]
        content = gcd(*f)
        f = [c // content for c in f]
    return True


def is_stable(A: Matrix) -> bool:
    """Tell whether all eigenvalues of a square matrix lie inside the unit circle.

    No eigenvalue is computed: the recursion of Schur and Cohn [S17] decides it on the coefficients of det(qI - A).

    Parameters
    ----------
    A : Matrix, shape (n, n)
        Over Q, as nested lists are taken to be, or Q(a), where it is asked for every embedding of the field in C.

    Returns
    -------
    bool

    Raises
    ------
    InvalidInput
        Over GF(p), where there is no unit circle, and for what is no square matrix.

    Examples
    --------
    >>> from faultspace.exact import Matrix, is_stable
    >>> is_stable(Matrix.of([["1/2", 100], [0, "-1/2"]])), is_stable(Matrix.of([[0, 1], [-1, 0]]))
    (True, False)
    """
    return is_schur(rational_characteristic_polynomial(as_matrix(A, "A")))
