"""This is the image of an exact system modulo a prime: where structure is read off fast and lower bounds on ranks come from.

Image           the system over GF(l), the prime l, and over Q(a) the simple root of f that a goes to
image           the image at the first good prime at or below a given one
good_primes     the primes that serve, descending from the largest below 2^27: sums of up to 1023 products of residues fit into 64 bits
rank lower bound: a minor that is not zero modulo l is not zero; ranks modulo l never exceed the true ones
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from flint import fmpz, nmod_mat, nmod_poly

from ..algebra.fields import NumberField, PrimeField, Rationals
from ..algebra.matrices import Matrix
from .systems import ResidualSystem

LARGEST_PRIME = 2**27 - 39


@dataclass(frozen=True)
class Image:
    """A system over GF(prime); `root` is where a went over a number field, else None. Over a prime field: the system itself."""

    system: ResidualSystem
    prime: int
    root: int | None


def primes_below(start: int) -> Iterator[int]:
    """Yield primes at or below `start`, descending."""
    candidate = start
    while candidate > 1:
        if fmpz(candidate).is_prime():
            yield candidate
        candidate -= 1


def image(system: ResidualSystem, *, largest: int = LARGEST_PRIME) -> Image:
    """Return the image at the largest good prime up to `largest`: no denominator vanishes, and f has a simple root."""
    if isinstance(system.field, PrimeField):
        return Image(system, system.field.p, None)
    for prime in primes_below(largest):
        root = simple_root(system.field, prime) if isinstance(system.field, NumberField) else None
        if isinstance(system.field, NumberField) and root is None:
            continue
        parts = [reduce_matrix(getattr(system, name), prime, root) for name in "AFCG"]
        if all(part is not None for part in parts):
            return Image(ResidualSystem(*parts), prime, root)  # type: ignore[arg-type]
    raise ArithmeticError("every prime up to the bound divides a denominator")


def simple_root(field: NumberField, prime: int) -> int | None:
    """Return a simple root of the minimal polynomial modulo the prime, or None where it has none."""
    coefficients = [int(c) for c in field.integer_polynomial.coeffs()]
    if coefficients[-1] % prime == 0 or any(c.denominator % prime == 0 for c in field.minimal_polynomial):
        return None
    _, factors = nmod_poly(coefficients, prime).factor()
    roots = [int(-g[0]) for g, multiplicity in factors if g.degree() == 1 and multiplicity == 1]
    return min(roots) if roots else None


def reduce_matrix(matrix: Matrix, prime: int, root: int | None) -> Matrix | None:
    """Return the matrix modulo the prime, a going to the root; None when a denominator vanishes. Over GF(p) it is the matrix."""
    if isinstance(matrix.field, PrimeField):
        return matrix
    target = PrimeField(prime)
    if isinstance(matrix.field, Rationals):
        numerators, denominator = matrix.flint.numer_denom()
        if denominator % prime == 0:
            return None
        return Matrix(target, matrix.nrows, matrix.ncols, nmod_mat(numerators, prime) * pow(int(denominator), -1, prime))
    rows: list[list[Any]] = []
    for row in matrix.elements():
        reduced = []
        for x in row:
            value = reduce_element(x, matrix.field, prime, root)
            if value is None:
                return None
            reduced.append(value)
        rows.append(reduced)
    return Matrix.from_elements(target, matrix.nrows, matrix.ncols, rows)


def reduce_element(x: Any, field: Any, prime: int, root: int | None) -> int | None:
    """Return one element modulo the prime as an integer in 0..prime-1; None when a denominator vanishes."""
    coordinates = field.coordinates(x) if isinstance(field, NumberField) else [x]
    value = 0
    for c in reversed(coordinates):
        denominator = int(c.q) % prime
        if denominator == 0:
            return None
        value = (value * (root or 0) + int(c.p) * pow(denominator, -1, prime)) % prime
    return value
