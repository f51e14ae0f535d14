"""Pairs (Fhat P, Ghat P): what the polynomial D(q; P) says of each beforehand, and what accepted certificates say of it afterwards.

PairByPolynomial         a system, a P, D(q; P) by its determinant; normal rank, zeros and equivalence of the pair by certificates
PAIRS_BY_POLYNOMIAL      for each system a good P, a bad P of full column rank where there is one, a P for given zeros, random P
examine_by_polynomial    the record of one P, with its certificates made and accepted
pencil_of                the pencil [P | q b - a] of a system, found once
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import Any

from ...exact.algebra.fields import QQ, PrimeField
from ...exact.algebra.matrices import Matrix, rank
from ...exact.algebra.polynomials import monic, multiply, written
from ...exact.pairs.assignment import assign_zeros
from ...exact.pairs.polynomial import Exceptional, exceptional, polynomial_at
from ...exact.pairs.witnesses import BadPair, bad_pair, good_columns
from ...exact.structure.fault_columns import with_pair
from ...exact.system.systems import ResidualSystem
from ..trust import structure_certificates as make
from ..trust.structure_certificates import accept
from .alternatives import compared, fault_space_basis, ranked
from .exhaustive import orbits
from .families import adversarial, random_systems
from .material import Material
from .once_a_run import once_a_run
from .subjects import kernel_once

MOST_STATES = 3


@dataclass(frozen=True)
class PairByPolynomial:
    """A pair (Fhat P, Ghat P), by its polynomial and by accepted certificates.

    `polynomial` is D(q; P), monic, ascending, as written, and () for a bad P. The rest is what accepted certificates say.

    `purpose` says how P was chosen: good, bad, given zeros, random. `zeta` is n less the left minimal indices of the system.
    """

    origin: str
    purpose: str
    system: ResidualSystem
    pair: ResidualSystem
    weight: int
    polynomial: tuple[object, ...]
    wanted: tuple[object, ...] | None
    full_column_rank: bool
    observable: bool
    normal_rank: int
    zeta: int
    pair_normal_rank: int
    zero_polynomial: tuple[object, ...]
    infinite_zeros: int
    equal: bool
    accepted: frozenset[str]


@lru_cache(maxsize=1 << 16)
def pencil_of(system: ResidualSystem) -> Exceptional:
    """Return the pencil [P | q b - a] of the system's fault space."""
    return exceptional(kernel_once(system))


@dataclass(frozen=True)
class CertifiedZeros:
    """The invariant zero polynomial, as it is written, and the number of infinite zeros, as accepted certificates state them."""

    polynomial: tuple[object, ...]
    infinite: int
    accepted: frozenset[str]


@once_a_run(1 << 13)
def certified_zeros(system: ResidualSystem) -> CertifiedZeros:
    """Return the certified zeros of a system, found once: several P of a small system give the same pair."""
    certificates = [make.finite_zeros(system), make.infinite_zeros(system)]
    decided = frozenset(map(accept, certificates))
    finite, infinite = (certificate["statement"] for certificate in certificates)
    return CertifiedZeros(_hashable(finite["invariant_zero_polynomial"]), sum(infinite["infinite_zero_orders"]), decided)


def examine_by_polynomial(origin: str, purpose: str, system: ResidualSystem, P: Matrix, wanted: object, weight: int) -> PairByPolynomial:
    """Return the record of a P (n_z x r): D(q; P), and the certified zeros, normal rank and equivalence of its pair, with the system's own
    zeros.

    Raises checker.Rejected or checker.Malformed where the checker does not accept a certificate.
    """
    pencil = pencil_of(system)
    field = system.field
    pair = with_pair(pencil.space, P)
    own, other = ranked(system), ranked(pair)
    basis = fault_space_basis(system)  # certified too, for the pair is made of it
    found = polynomial_at(pencil, P)
    comparison, zeros = compared(system, pair), certified_zeros(pair)
    return PairByPolynomial(
        origin=origin,
        purpose=purpose,
        system=system,
        pair=pair,
        weight=weight,
        polynomial=_hashable(written(monic(found), field)) if found else (),
        wanted=None if wanted is None else _hashable(written(monic(wanted), field)),  # type: ignore[arg-type]
        full_column_rank=rank(P) == P.ncols,
        observable=pencil.observable,
        normal_rank=own.normal_rank,
        zeta=system.n - sum(own.left_minimal_indices),
        pair_normal_rank=other.normal_rank,
        zero_polynomial=zeros.polynomial,
        infinite_zeros=zeros.infinite,
        equal=comparison.first_difference is None,
        accepted=zeros.accepted | {comparison.accepted, basis.accepted, own.accepted, other.accepted},
    )


def _examined(item: tuple[str, ResidualSystem, int]) -> list[PairByPolynomial]:
    origin, system, weight = item
    return [examine_by_polynomial(origin, purpose, system, P, wanted, weight) for purpose, P, wanted in _choices(system)]


def _choices(system: ResidualSystem) -> Iterator[tuple[str, Matrix, object]]:
    """Yield triples of a purpose, a P, and the polynomial wanted or None."""
    pencil, rng = pencil_of(system), random.Random(str(system))
    field, shape = system.field, (pencil.n_z, pencil.columns)
    yield "good", good_columns(pencil).verdict.P, None
    bad = bad_pair(pencil)
    if isinstance(bad, BadPair):
        yield "bad", bad.verdict.P, None
    for degree in sorted({0, rng.randint(0, pencil.zeta), pencil.zeta}):
        # a multiple of the unobservable modes, which no P moves, of this degree or of the least there is
        free = (*(field.element(rng.randint(-2, 2)) for _ in range(degree - len(pencil.fixed) + 1)), field.element(1))
        if pencil.columns or len(free) == 1:
            wanted = multiply(free, pencil.fixed)
            yield "given zeros", assign_zeros(pencil, [field.write(x) for x in wanted]).P, wanted
    for _ in range(2):
        yield "random", Matrix.of([[rng.randint(-2, 2) for _ in range(shape[1])] for _ in range(shape[0])], field, shape=shape), None


def _systems(bench: Any) -> Iterator[tuple[str, ResidualSystem, int]]:
    full = bench.full
    for _, system in adversarial():
        if system.n <= MOST_STATES:
            yield "named systems", system, 1
    for system in random_systems(QQ, 400 if full else 10, seed=7, largest=MOST_STATES):
        yield "random systems over Q", system, 1
    for system in random_systems(PrimeField(5), 100 if full else 4, seed=8, largest=MOST_STATES):
        yield "random systems over GF(5)", system, 1
    boxes = product(range(3), range(3), range(3 if full else 2)) if full else [(1, 1, 1), (1, 2, 1), (1, 1, 2), (1, 2, 2)]
    for n, p, m in boxes:
        for orbit in orbits(2, n, p, m):
            yield "systems over GF(2) of small dimensions", orbit.system, orbit.size


def _hashable(coefficients: object) -> tuple[object, ...]:
    """Return written coefficients as a tuple; entries of Q(a), which are lists, become tuples."""
    return tuple(tuple(c) if isinstance(c, list) else c for c in coefficients)  # type: ignore[attr-defined]


PAIRS_BY_POLYNOMIAL = Material("pairs by polynomial", "pairs and their polynomials", _systems, _examined, 20)
