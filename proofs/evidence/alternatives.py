"""These are pairs of systems whose behaviours are compared, each with certificates that the checker has accepted.

PairEvidence              two systems: equal, or the first window on which they differ; their lags and normal ranks
AlternativeEvidence       a system and other fault matrices for the same (A, C): equal or not, inside the fault space or not
PAIRS                     all pairs over GF(2) at small dimensions, shift registers, perturbed and equivalent systems over Q
ALTERNATIVES              every (F', G') over GF(2) at small dimensions; pairs (Fhat P, Ghat P) for good and bad P over Q
examine_pair, examine_alternative    the evidence on one of each
comparison_certificate    the certificate of equality or of the first difference, whichever is so
relatives                 systems made of one, with the same outputs or nearly
small_columns             matrices P of several kinds
ranked, fault_space_basis    what is asked of one system of a pair alone, kept because a system stands in many of them
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

from ...exact.algebra.fields import QQ, PrimeField
from ...exact.algebra.matrices import Matrix, beside, rank, solve_left, stacked
from ...exact.structure.behavior import compare
from ...exact.structure.fault_columns import fault_space, with_pair
from ...exact.structure.kernel_rows import KernelRepresentation
from ...exact.system.systems import ResidualSystem
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, accept
from .exhaustive import all_systems, orbits
from .families import adversarial, random_systems, shift_registers
from .material import Material
from .once_a_run import once_a_run
from .subjects import kernel_once, space_once


@dataclass(frozen=True)
class PairEvidence:
    """What accepted certificates say of two systems; `first_difference` is None where the behaviours are equal."""

    origin: str
    first: ResidualSystem
    second: ResidualSystem
    weight: int
    first_difference: int | None
    lags: tuple[int, int]
    normal_ranks: tuple[int, int]
    accepted: frozenset[str]


@dataclass(frozen=True)
class AlternativeEvidence:
    """A system, other fault matrices for its (A, C), and how they compare; `in_space` says that every column solves problem (11)."""

    origin: str
    system: ResidualSystem
    alternative: ResidualSystem
    weight: int
    equal: bool
    in_space: bool
    alternative_normal_rank: int
    full_column_rank: bool
    left_invertible: bool
    accepted: frozenset[str]


@dataclass(frozen=True)
class Ranked:
    """A system by its kernel representation, with what the certificate of its window ranks states, accepted under this SHA-256."""

    kernel: KernelRepresentation
    left_minimal_indices: tuple[int, ...]
    normal_rank: int
    accepted: str

    @property
    def lag(self) -> int:
        """The lag is the largest of the left minimal indices."""
        return max(self.left_minimal_indices, default=0)


@once_a_run(1 << 13)
def ranked(system: ResidualSystem) -> Ranked:
    """Return the kernel representation of a system, its window ranks certified."""
    kernel = kernel_once(system)
    certificate = make.window_ranks(kernel)
    decided, statement = accept(certificate), certificate["statement"]
    return Ranked(kernel, tuple(statement["left_minimal_indices"]), statement["normal_rank"], decided)


@dataclass(frozen=True)
class Basis:
    """The rows of a basis of a fault space, as a certificate states them, accepted under this SHA-256."""

    rows: Matrix
    accepted: str


@once_a_run(1 << 13)
def fault_space_basis(system: ResidualSystem) -> Basis:
    """Return the rows of a basis of the fault space, as an accepted certificate states them."""
    kernel = ranked(system).kernel
    certificate = make.fault_space(kernel, fault_space(kernel))
    decided, basis = accept(certificate), certificate["statement"]["basis"]
    return Basis(Matrix.of(basis, system.field, shape=(len(basis), system.n + system.p)), decided)


def comparison_certificate(first: KernelRepresentation, second: KernelRepresentation) -> Certificate:
    """The certificate of equality, or of the difference on the shortest window, whichever is so."""
    found = compare(first, second)
    if found.first_difference is None:
        return make.behaviour_equality(first, second)
    word = found.first_not_in_second
    if word is not None and word.window == found.first_difference:
        return make.behaviour_difference(first.system, second)
    return make.behaviour_difference(second.system, first)


@dataclass(frozen=True)
class Comparison:
    """The least number of samples on which two behaviours differ, None where they are equal, by a certificate accepted under this
    SHA-256."""

    first_difference: int | None
    accepted: str


@once_a_run(1 << 13)
def compared(first: ResidualSystem, second: ResidualSystem) -> Comparison:
    """Return on how many samples the behaviours differ, as an accepted certificate states it.

    It is found once: different (F', G'), and different P, come to the same second system.
    """
    certificate = comparison_certificate(kernel_once(first), kernel_once(second))
    decided = accept(certificate)
    return Comparison(certificate["statement"].get("window"), decided)


def examine_pair(origin: str, first: ResidualSystem, second: ResidualSystem, weight: int = 1) -> PairEvidence:
    """Return the evidence on two systems: equality or the first difference, and their lags, each certified."""
    one, other = ranked(first), ranked(second)
    comparison = compared(first, second)
    window = comparison.first_difference
    earlier = 0 if window is None else window - 1  # no samples are the same ones, whatever the systems are
    decided = frozenset({comparison.accepted, one.accepted, other.accepted})
    if earlier:
        decided |= {accept(make.window_equality(one.kernel, other.kernel, earlier))}
    lags, ranks = (one.lag, other.lag), (one.normal_rank, other.normal_rank)
    return PairEvidence(origin, first, second, weight, window, lags, ranks, decided)


def examine_alternative(origin: str, system: ResidualSystem, alternative: ResidualSystem, weight: int = 1) -> AlternativeEvidence:
    """Return the evidence on other fault matrices: whether they make the same outputs, and whether they lie in the fault space."""
    one, other, basis = ranked(system), ranked(alternative), fault_space_basis(system)
    comparison = compared(system, alternative)
    columns = stacked(alternative.F, alternative.G)
    return AlternativeEvidence(
        origin=origin,
        system=system,
        alternative=alternative,
        weight=weight,
        equal=comparison.first_difference is None,
        in_space=rank(stacked(basis.rows, columns.transposed())) == basis.rows.nrows,
        alternative_normal_rank=other.normal_rank,
        full_column_rank=rank(columns) == alternative.m,
        left_invertible=one.normal_rank == system.m,
        accepted=frozenset({comparison.accepted, basis.accepted, one.accepted, other.accepted}),
    )


def _examined_pair(item: tuple[str, ResidualSystem, ResidualSystem, int]) -> PairEvidence:
    return examine_pair(*item)


def _examined_alternative(item: tuple[str, ResidualSystem, ResidualSystem, int]) -> AlternativeEvidence:
    return examine_alternative(*item)


def _pairs(bench: Any) -> Iterator[tuple[str, ResidualSystem, ResidualSystem, int]]:
    full = bench.full
    for n in range(1, 13 if full else 9):
        idle, driven = shift_registers(n)
        yield "shift registers", idle, driven, 1
    named = [system for _, system in adversarial() if system.n <= 3]
    for system in [*named, *random_systems(QQ, 600 if full else 12, seed=2)]:
        for other in relatives(system, random.Random(str(system))):
            yield "named and random systems over Q against equivalent and perturbed ones", system, other, 1
    largest = 2 if full else 1
    for p in range(3):
        others = [s for n in range(2) for m in range(largest + 1) for s in all_systems(2, n, p, m)]
        for n, m in product(range(2), range(2)):
            for orbit in orbits(2, n, p, m):
                for other in others:
                    yield (
                        f"all pairs over GF(2) in the box n <= 1, p <= 2, m <= 1 (second: m <= {largest})",
                        orbit.system,
                        other,
                        orbit.size,
                    )


def relatives(system: ResidualSystem, rng: random.Random) -> Iterator[ResidualSystem]:
    """Yield systems made of one: by feedback of the state into the fault and by another basis (with the same outputs), by a changed entry,
    by a state more.
    """
    field = system.field
    K = Matrix.of([[rng.choice([-1, 0, 1]) for _ in range(system.n)] for _ in range(system.m)], field, shape=(system.m, system.n))
    yield ResidualSystem(system.A + system.F @ K, system.F, system.C + system.G @ K, system.G)
    if system.n:
        # 2 on the diagonal (1 over GF(2)), ones in the first row: upper triangular, so invertible
        two = 2 if field.element(2) != 0 else 1
        T = Matrix.of(
            [[two if i == j else int(i == 0) for j in range(system.n)] for i in range(system.n)], field, shape=(system.n, system.n)
        )
        moved = solve_left(T, stacked(T @ system.A, system.C))
        if moved is not None:
            A, C = moved.rows(range(system.n)), moved.rows(range(system.n, system.n + system.p))
            yield ResidualSystem(A, T @ system.F, C, system.G)
    if system.n and system.m:
        table = system.F.elements()
        table[rng.randrange(system.n)][rng.randrange(system.m)] = field.element(rng.choice([-2, 0, 1, 3]))
        yield system.with_faults(Matrix.from_elements(field, system.n, system.m, table), system.G)
    edge = Matrix.of([[rng.choice([0, 1])] for _ in range(system.p)], field, shape=(system.p, 1))
    A = stacked(beside(system.A, Matrix.zero(field, system.n, 1)), Matrix.of([[0] * system.n + [rng.choice([0, 2])]], field))
    yield ResidualSystem(A, stacked(system.F, Matrix.zero(field, 1, system.m)), beside(system.C, edge), system.G)


def _alternatives(bench: Any) -> Iterator[tuple[str, ResidualSystem, ResidualSystem, int]]:
    full = bench.full
    named = [system for _, system in adversarial() if system.n <= 4]
    for system in [*named, *random_systems(QQ, 600 if full else 12, seed=3)]:
        space = space_once(system)
        rng = random.Random(str(system))
        for P in small_columns(space.dimension, system.m, rng):
            yield "pairs (Fhat P, Ghat P) over Q, P generic, sparse and rank-deficient", system, with_pair(space, P), 1
    for n, p, m in product(range(3 if full else 2), range(3), range(1, 3 if full else 2)):
        columns = list(product(range(2), repeat=(n + p) * m))
        for orbit in orbits(2, n, p, m):
            for entries in columns:
                table = [list(entries[i * m : (i + 1) * m]) for i in range(n + p)]
                F, G = (Matrix.of(part, PrimeField(2), shape=(k, m)) for part, k in ((table[:n], n), (table[n:], p)))
                yield (
                    f"every (F', G') against every system over GF(2) with n <= {2 if full else 1}, p <= 2, m <= {2 if full else 1}",
                    orbit.system,
                    orbit.system.with_faults(F, G),
                    orbit.size,
                )


def small_columns(rows: int, cols: int, rng: random.Random) -> Iterator[Matrix]:
    """Yield P of several kinds: generic, sparse, of unit columns and rank-deficient."""
    for density in (1.0, 0.5, 0.3):
        yield Matrix.of(
            [[rng.randint(-3, 3) if rng.random() < density else 0 for _ in range(cols)] for _ in range(rows)], shape=(rows, cols)
        )
    order = rng.sample(range(rows), rows)
    yield Matrix.of([[int(order.index(i) == j) for j in range(cols)] for i in range(rows)], shape=(rows, cols))


PAIRS = Material("pairs", "comparing pairs", _pairs, _examined_pair, 60)
ALTERNATIVES = Material("alternatives", "trying other fault matrices", _alternatives, _examined_alternative, 60)
