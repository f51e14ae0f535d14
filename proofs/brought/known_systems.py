"""The systems outside the box that every claim about systems is tried on, and what single steps make of one of them.

    known_systems     those of the corpus, and systems of the families that the adversary attacks with, over a field
    steps             what single steps make of a system: a state, a fault, an output less, or a simpler entry

The corpus is the one of `verify`: named systems that were each made to break something, and random ones of every structure. The adversary's
families have a hidden state, an idle one, two faults that are one, a feedthrough of rank one, or every entry free; here their points are
small integers, drawn from a seed.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import islice, product

from ...exact.algebra.fields import QQ, Field, Rationals
from ...exact.algebra.matrices import Matrix
from ...exact.system.systems import ResidualSystem
from ..adversary.structure_families import free_family, hidden_family, idle_family, rank_deficient_family, rank_one_family, system_of
from ..evidence.attacks import Family
from ..evidence.families import adversarial, random_systems
from ..quantities.blocks import height
from ..quantities.registry import Subject

RANDOM, DRAWN, SEED = 180, 6, 1
CORPUS, ADVERSARY = "corpus", "adversary"


@dataclass(frozen=True)
class KnownSystem:
    """`origin` is the corpus or the adversary."""

    origin: str
    subject: Subject


@lru_cache(maxsize=4)
def known_systems(field: Field) -> tuple[KnownSystem, ...]:
    """Return them over a field, over GF(q) integers modulo q; each keeps what is found out about it."""
    corpus = [system for _, system in adversarial()] + list(islice(random_systems(QQ, RANDOM, seed=SEED), RANDOM))
    if field != QQ:
        corpus = [system for _, system in adversarial()] + list(islice(random_systems(field, RANDOM, seed=SEED), RANDOM))
    listed = [(CORPUS, one) for one in corpus] + [(ADVERSARY, one) for one in _drawn()]
    return tuple(KnownSystem(origin, Subject(over(field, one))) for origin, one in listed if _moves(field, one))


def _drawn() -> Iterator[ResidualSystem]:
    rng = random.Random(SEED)
    families: list[Family] = [rank_deficient_family(), rank_one_family(1, 2), rank_one_family(2, 2)]
    for n, p, m in product((1, 2, 3), (1, 2), (1, 2)):
        families += [free_family(n, p, m), free_family(n, p, m, feedthrough=False)]
        families += [hidden_family(n, p, m), idle_family(n, p, m)] if n > 1 else []
    for family in families:
        for _ in range(DRAWN):
            yield system_of(family.at([rng.randint(-2, 2) for _ in family.box]))


def _moves(field: Field, system: ResidualSystem) -> bool:
    """Return whether the system is one over the field, or has integer entries, which are one."""
    return system.field == field or all(
        Fraction(int(x.p), int(x.q)).denominator == 1 for name in "AFCG" for row in getattr(system, name).elements() for x in row
    )


def over(field: Field, system: ResidualSystem) -> ResidualSystem:
    """Return a system with integer entries over the field."""
    if system.field == field:
        return system
    parts = ([[int(x) for x in row] for row in getattr(system, name).elements()] for name in "AFCG")
    return ResidualSystem.of(*parts, field=field, n=system.n, m=system.m, p=system.p)


def steps(system: ResidualSystem) -> Iterator[ResidualSystem]:
    """Yield the systems with one state, fault or output less, then those with one entry 0, 1, -1 or nearer to 0."""
    for without, count in ((without_state, system.n), (without_fault, system.m), (without_output, system.p)):
        for k in range(count):
            yield without(system, k)
    for name in "AFCG":
        for matrix in simpler_matrices(getattr(system, name)):
            yield with_matrix(system, name, matrix)


def without_state(system: ResidualSystem, k: int) -> ResidualSystem:
    """Return the system without its state k."""
    rest = _others(system.n, k)
    return ResidualSystem(system.A.rows(rest).columns(rest), system.F.rows(rest), system.C.columns(rest), system.G)


def without_fault(system: ResidualSystem, k: int) -> ResidualSystem:
    """Return the system without its fault k."""
    rest = _others(system.m, k)
    return ResidualSystem(system.A, system.F.columns(rest), system.C, system.G.columns(rest))


def without_output(system: ResidualSystem, k: int) -> ResidualSystem:
    """Return the system without its output k."""
    rest = _others(system.p, k)
    return ResidualSystem(system.A, system.F, system.C.rows(rest), system.G.rows(rest))


def with_matrix(system: ResidualSystem, name: str, matrix: Matrix) -> ResidualSystem:
    """Return the system with another A, F, C or G of the same shape."""
    return ResidualSystem(**({other: getattr(system, other) for other in "AFCG"} | {name: matrix}))


def simpler_matrices(matrix: Matrix) -> Iterator[Matrix]:
    """Yield the matrices with one entry that is simpler."""
    table = matrix.elements()
    for i, j in product(range(matrix.nrows), range(matrix.ncols)):
        for value in _simpler(table[i][j], matrix.field):
            changed = [[value if (a, b) == (i, j) else x for b, x in enumerate(row)] for a, row in enumerate(table)]
            yield Matrix.from_elements(matrix.field, matrix.nrows, matrix.ncols, changed)


def _others(count: int, k: int) -> list[int]:
    return [i for i in range(count) if i != k]


def _simpler(x: object, field: Field) -> list[object]:
    """Return 0, 1, -1 and half of it, rounded to 0, as far as they are simpler than the entry."""
    if not isinstance(field, Rationals):
        return [] if x == 0 else [field.element(0)] if x == 1 else [field.element(0), field.element(1)]
    value = Fraction(int(x.p), int(x.q))  # type: ignore[attr-defined]
    weight = (height(value), value != 0, value < 0)
    candidates = [Fraction(0), Fraction(1), Fraction(-1), Fraction(int(value / 2))]
    return [field.element(one) for one in dict.fromkeys(candidates) if (height(one), one != 0, one < 0) < weight]
