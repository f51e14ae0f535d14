"""These are the zeros of the pencil P(q) = [[qI - A, -F], [C, G]], and what depends on where they lie. Source: [K80] 6.3, [VD79], [TSH01].

A zero is a q at which P(q) has less than its normal rank, or infinity. The rank is n + rank [F; G] at a q where no fault and no state are
lost, and never more, so that P(q) has that rank for every q of a set iff the normal rank of C (qI - A)^-1 F + G is rank [F; G] and no zero
lies in the set; for the whole plane this says that V* = 0 ([TSH01] 7.5). Whether zeros lie inside the unit circle is decided on the
coefficients of their polynomial ([S17]), over Q and over a number field with a chosen root.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

from flint import fmpq, fmpq_poly

from ...exact.algebra.embeddings import inside_the_circle, stable_there
from ...exact.algebra.matrices import rank, stacked
from ...exact.algebra.polynomials import interpolate
from ...exact.algebra.stability import is_schur
from ..evidence import certified
from ..evidence import questions as ask
from ..evidence.subjects import Subject
from .ranks import CHARACTERISTIC, MINORS, Ranks
from .registry import Kind, Quantity, Told


def zero_polynomial(ranks: Ranks) -> tuple[Fraction, ...]:
    """Return the gcd of the largest minors of P(q) that are not all zero; their values at q = 0, ..., n tell them, of degree n at most."""
    values = ranks.table(MINORS)
    width = ranks.n + 1
    found = fmpq_poly([0])
    for start in range(0, len(values), width):
        points = [fmpq(q) for q in range(width)]
        minor = interpolate(points, [fmpq(x) for x in values[start : start + width]])
        found = found.gcd(fmpq_poly(list(minor)))
    return tuple(Fraction(int(c.p), int(c.q)) for c in found.coeffs())


def choices(n: int, m: int, p: int, r: int) -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
    """Return the rows and columns of the minors of size n + r of the pencil."""
    return [(rows, columns) for rows in combinations(range(n + p), n + r) for columns in combinations(range(n + m), n + r)]


def _inside(subject: Subject) -> bool:
    return inside_the_circle(subject.zero_polynomial, subject.system.field)


def _full(subject: Subject) -> bool:
    return subject.kernel.normal_rank == rank(stacked(subject.system.F, subject.system.G))


def _full_by_ranks(ranks: Ranks) -> bool:
    """rank [F; G] is m less the number of right minimal indices that are zero: their columns of P(q) are constant combinations."""
    return ranks.normal_rank == ranks.m - ranks.right_minimal_indices.count(0)


QUANTITIES = (
    Quantity(
        "finite_zeros",
        Kind.INTEGER,
        "the number of finite zeros of P(q), with multiplicity",
        lambda x: x.finite_zeros,
        lambda r: r.finite_zeros,
        certified.finite,
        told=Told((ask.FINITE_ZEROS,), lambda e: e.finite_zeros),
    ),
    Quantity(
        "infinite_zero_orders",
        Kind.LIST,
        "the orders of the zeros at infinity, ascending, one a unit of normal rank, zeros included",
        lambda x: x.infinite_zero_orders,
        lambda r: r.infinite_zero_orders,
        certified.infinite,
        told=Told((ask.INFINITE_ZEROS,), lambda e: e.infinite_zero_orders),
        balance=("normal_rank", ""),
    ),
    Quantity(
        "infinite_zeros",
        Kind.INTEGER,
        "the sum of infinite_zero_orders",
        lambda x: sum(x.infinite_zero_orders),
        lambda r: sum(r.infinite_zero_orders),
        certified.infinite,
        told=Told((ask.INFINITE_ZEROS,), lambda e: sum(e.infinite_zero_orders)),
    ),
    Quantity(
        "zeta",
        Kind.INTEGER,
        "finite_zeros + infinite_zeros",
        lambda x: x.finite_zeros + sum(x.infinite_zero_orders),
        lambda r: r.finite_zeros + sum(r.infinite_zero_orders),
        certified.zeros,
        told=Told(ask.ZEROS, lambda e: e.zeta),
        parts=("finite_zeros", "infinite_zeros"),
    ),
    Quantity(
        "minimum_phase",
        Kind.WORD,
        "every finite zero lies inside the unit circle",
        lambda x: _inside(x),
        lambda r: r.finite_zeros == 0 or is_schur(zero_polynomial(r)),
        None,
        circle=True,
    ),
    Quantity(
        "strongly_detectable",
        Kind.WORD,
        "rank P(z) = n + rank [F; G] for every z with |z| >= 1",
        lambda x: _full(x) and _inside(x),
        lambda r: _full_by_ranks(r) and (r.finite_zeros == 0 or is_schur(zero_polynomial(r))),
        None,
        circle=True,
    ),
    Quantity(
        "strongly_observable",
        Kind.WORD,
        "V* = 0: rank P(z) = n + rank [F; G] for every z",
        lambda x: x.weakly_unobservable.ncols == 0,
        lambda r: _full_by_ranks(r) and r.finite_zeros == 0,
        certified.settled,
        balance=("weakly_unobservable_dimension", ""),
    ),
    Quantity(
        "stable",
        Kind.WORD,
        "every eigenvalue of A lies inside the unit circle",
        lambda x: stable_there(x.system.A),
        lambda r: is_schur(r.table(CHARACTERISTIC)),
        certified.stable,
        circle=True,
    ),
)
