"""Zeros that are given to a pair: polynomials of every degree up to zeta, each made the zero polynomial of a pair, and found there again.

every_polynomial_is_reached   whether each of `wanted` is the zero polynomial of a pair of this pencil
wanted                        the polynomials: random of every degree, with a zero constant term, with one repeated root, not monic
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random
from typing import Any

from ...base.errors import InvalidInput
from ...exact.algebra.fields import PrimeField
from ...exact.algebra.polynomials import Poly, monic, multiply, trimmed
from ...exact.pairs.assignment import assign_zeros
from ...exact.pairs.polynomial import Exceptional, polynomial_at
from ...exact.structure.pencil import invariant_zero_polynomial
from ..evidence.kept_kernels import kernel_once


def every_polynomial_is_reached(pencil: Exceptional) -> bool:
    """Return whether each has a P whose D(q; P) it is up to a unit; of the last the pair's own zeros are asked as well, by another route.

    A polynomial that `assign_zeros` refuses is not reached by any P: the unobservable modes are zeros of every pair.
    """
    last: tuple[Poly, Any] | None = None
    for polynomial in wanted(pencil):
        try:
            assignment = assign_zeros(pencil, [pencil.system.field.write(x) for x in polynomial])
        except InvalidInput:
            return False
        if monic(polynomial_at(pencil, assignment.P)) != monic(polynomial):
            return False
        last = polynomial, assignment.system
    if last is None:
        return True
    polynomial, pair = last
    return monic(invariant_zero_polynomial(kernel_once(pair), len(polynomial) - 1)) == monic(polynomial)


def wanted(pencil: Exceptional) -> Iterator[Poly]:
    """Yield the polynomials: a nonzero constant, a random one of each degree up to zeta, q^zeta, (q - c)^zeta and c q^zeta + ... + 1."""
    field, zeta, random = pencil.system.field, pencil.zeta, Random(str(pencil.system))
    size = min(field.p, 7) if isinstance(field, PrimeField) else 7

    def number(*, nonzero: bool = False) -> Any:
        return field.element(random.randint(1, size - 1) if nonzero else random.randint(0, size - 1) - (0 if size < 7 else 3))

    one, zero = field.element(1), field.element(0)
    for degree in range(zeta + 1):
        yield trimmed([*(number() for _ in range(degree)), number(nonzero=True)])
    if zeta:
        yield trimmed([zero] * zeta + [one])
        repeated = trimmed([one])
        root = number(nonzero=True)
        for _ in range(zeta):
            repeated = multiply(repeated, trimmed([-root, one]))
        yield trimmed([one, *[zero] * (zeta - 1), number(nonzero=True)])
        yield repeated
