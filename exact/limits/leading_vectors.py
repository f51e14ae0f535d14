"""Do the leading left singular vectors of a limit span the range of O_s? Decided exactly, no singular value being computed.

    leading_vectors_span   of L Gamma^(-1/2), as many of them as O_s has rank; Gamma is the covariance of the projected instruments

The estimate takes its columns from the first left singular vectors of Yf Pi Z' (Z Pi Z')^(-1/2), the block L32 of the RQ factorisation
[V93], whose limit is L Gamma^(-1/2); the rows of Yf are taken as they are, and other weights of the outputs make other singular vectors.
With W = L Gamma^- L' they span the range of O_s iff that is invariant under W and every eigenvalue of W on it exceeds every one on its
complement. Both are roots of rational polynomials, and two roots are equal only where they are roots of the same irreducible one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from flint import arb, ctx, fmpz_poly

from ..algebra.matrices import Matrix, column_basis, left_null_space, rank, row_profile
from ..system.modular import LARGEST_PRIME, reduce_matrix
from .lyapunov import solve

MOST_BITS = 1 << 16


def leading_vectors_span(L: Matrix, Gamma: Matrix, observability: Matrix) -> bool:
    """This tells whether the first rank(O_s) left singular vectors of L Gamma^(-1/2) are determined and span the column space of O_s.

    L is s p x z, `Gamma` z x z and positive semidefinite with the rows of L among its row space, `observability` s p x n, all over Q. Where
    the rank of L is below that of O_s they do not. Raises ArithmeticError if MOST_BITS bits do not tell two eigenvalues apart.
    """
    inside, outside = column_basis(observability), left_null_space(observability).transposed()
    if inside.ncols == 0:
        return True
    if _certainly_not_invariant(L, Gamma, inside, outside):
        return False
    kept = row_profile(Gamma)  # the other instruments are combinations of these
    weight, seen = Gamma.rows(kept).columns(kept), L.columns(kept)
    weighted = solve(weight, seen.transposed())  # W = seen weighted
    if not (outside.transposed() @ (seen @ (weighted @ inside))).is_zero():
        return False
    below = [fmpz_poly([0, 1])]  # the vectors have to be seen at all
    below += _eigenvalue_polynomials(outside, seen @ weighted)
    return _smallest_exceeds_largest(_eigenvalue_polynomials(inside, seen @ weighted), below)


def _certainly_not_invariant(L: Matrix, Gamma: Matrix, inside: Matrix, outside: Matrix) -> bool:
    """A first look modulo a prime settles most cases: it tells whether outside' L Gamma^-1 L' inside is not zero there, Gamma being
    regular.
    """
    limit, gamma, within, beyond = (reduce_matrix(matrix, LARGEST_PRIME, None) for matrix in (L, Gamma, inside, outside))
    if limit is None or gamma is None or within is None or beyond is None or rank(gamma) < gamma.nrows:
        return False
    weighted = Matrix(gamma.field, gamma.nrows, within.ncols, gamma.flint.solve((limit.transposed() @ within).flint))
    return not (beyond.transposed() @ (limit @ weighted)).is_zero()


def _eigenvalue_polynomials(basis: Matrix, W: Matrix) -> list[fmpz_poly]:
    """Return the irreducible polynomials whose roots are the eigenvalues of W, symmetric, on the span of `basis`, which is invariant."""
    if basis.ncols == 0:
        return []
    turned = basis.transposed()
    operator = solve(turned @ basis, turned @ W @ basis)
    return [factor for factor, _ in operator.flint.charpoly().numer().factor()[1]]


def _smallest_exceeds_largest(above: list[fmpz_poly], below: list[fmpz_poly]) -> bool:
    """This tells whether every root of `above` exceeds every root of `below`. All are real; equal ones have the same irreducible
    polynomial.
    """
    if any(one == other for one in above for other in below):
        return False
    bits = ctx.prec
    try:
        while ctx.prec <= MOST_BITS:
            least, most = _extreme(above, arb.min), _extreme(below, arb.max)
            if least > most:
                return True
            if least < most:
                return False
            ctx.prec *= 2
    finally:
        ctx.prec = bits
    raise ArithmeticError(f"two eigenvalues agree to {MOST_BITS} bits")


def _extreme(polynomials: list[fmpz_poly], choose: Callable[[arb, arb], arb]) -> arb:
    """Return a ball around the least or the largest of all roots."""
    found: list[Any] = [pair for polynomial in polynomials for pair in polynomial.complex_roots()]
    roots = [root.real for root, _ in found]
    extreme: arb = roots[0]
    for root in roots[1:]:
        extreme = choose(extreme, root)
    return extreme
