"""The cases outside the box that every claim is tried on, and how one of them that fails is made smaller.

    known_systems   systems of the corpus, and of the families that the adversary attacks with, over a field
    known_cases     these, or pairs, choices and records made of them: whatever the claims of a box are about
    smaller         a case that still fails, with fewer states, faults, outputs and simpler entries, as far as single steps lead

The corpus is the one of `verify`: named systems that were each made to break something, and random ones of every structure. The adversary's
families have a hidden state, an idle one, two faults that are one, a feedthrough of rank one, or every entry free; here their points are
small integers, drawn from a seed. Pairs of the corpus are shift registers, which differ late, and small known systems and
their relatives: the same by feedback and another basis, changed in an entry, with a state more. Those of the adversary are its systems with
other faults (Fhat P, Ghat P) that explain n samples, and P small integers from a seed. Choices are those of small known systems with P that
are generic, sparse, of unit columns, rank-deficient, and, where there is one, a P by which the normal rank is lost. Records are
those of small known systems with their faults as inputs, short ones and such as are long enough to excite.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, islice, product

from ...exact.algebra.fields import Field, Rationals
from ...exact.algebra.matrices import Matrix
from ...exact.pairs.witnesses import BadPair, bad_pair
from ...exact.structure.fault_columns import fault_space, fault_space_dimension, with_pair
from ...exact.system.systems import FaultySystem, ResidualSystem
from ..adversary.structure_families import free_family, hidden_family, idle_family, rank_deficient_family, rank_one_family, system_of
from ..boxes.box import Box
from ..evidence.alternatives import relatives, small_columns
from ..evidence.attacks import Family
from ..evidence.families import adversarial, random_systems, shift_registers
from ..evidence.pairs_by_polynomial import pencil_of
from ..language.vocabularies import CHOICE, ONE_A_AND_C, RECORD, SYSTEM
from ..quantities.blocks import height
from ..quantities.cases import Case, Choice, ChoiceSubject, Known, Pair, PairSubject, Record, RecordSubject
from ..quantities.registry import Subject

LARGEST_STATES, REGISTERS, CHOICES, RANDOM, DRAWN, SEED = 3, 6, 2, 180, 6, 1
CORPUS, ADVERSARY = "corpus", "adversary"


@dataclass(frozen=True)
class KnownCase:
    """`origin` is the corpus or the adversary; `subject` keeps what is found out about the case."""

    origin: str
    case: Case
    subject: Known


def known_cases(box: Box) -> tuple[KnownCase, ...]:
    """Return them over the field of the box."""
    if box.about == SYSTEM:
        return tuple(KnownCase(one.origin, one.subject.system, one.subject) for one in known_systems(box.field))
    if box.about == CHOICE:
        return _choices(box.field)
    if box.about == RECORD:
        return _records(box.field)
    return _pairs(box.field, box.about == ONE_A_AND_C)


def smaller(case: Case, fails: Callable[[Case], bool]) -> Case:
    """Return a case that fails and that no single step makes smaller: one row and column less, or one entry 0, 1, -1 or nearer to 0."""
    while True:
        found = next((one for one in _smaller(case) if fails(one)), None)
        if found is None:
            return case
        case = found


def _smaller(case: Case) -> Iterator[Case]:
    if isinstance(case, ResidualSystem):
        return steps(case)
    if isinstance(case, Pair):
        return _pair_steps(case)
    return _choice_steps(case) if isinstance(case, Choice) else _record_steps(case)


@lru_cache(maxsize=4)
def _records(field: Field) -> tuple[KnownCase, ...]:
    """Return known systems with their faults as inputs, some under a signal that excites, some under one that does not."""
    found = []
    for known in known_systems(field):
        system = known.subject.system
        if system.n > LARGEST_STATES:
            continue
        rng = random.Random(str(system))
        without = system.with_faults(Matrix.zero(field, system.n, 0), Matrix.zero(field, system.p, 0))
        driven, subject = FaultySystem(without, system.F, system.G), Subject(without)
        for length in (rng.randint(1, 6), (system.m + 1) * (system.n + 2) + rng.randint(0, 3)):
            density = rng.choice((0.2, 0.6, 1.0))
            u = [[rng.randint(-2, 2) if rng.random() < density else 0 for _ in range(system.m)] for _ in range(length)]
            x0 = [[rng.choice((-1, 0, 1))] for _ in range(system.n)]
            record = Record(driven, Matrix.of(u, field, shape=(length, system.m)), Matrix.of(x0, field, shape=(system.n, 1)))
            found.append(KnownCase(known.origin, record, RecordSubject(subject, record)))
    return tuple(found)


def _record_steps(record: Record) -> Iterator[Record]:
    """Yield the records with a state, output, input, fault or sample less, or a simpler entry."""
    system, u, x0 = record.system, record.u, record.x0
    residual, B, D = system.residual, system.B, system.D
    for k in range(system.n):
        rest = _rest(system.n, k)
        yield Record(FaultySystem(without_state(residual, k), B.rows(rest), D), u, x0.rows(rest))
    for k in range(system.m):
        yield Record(FaultySystem(without_fault(residual, k), B, D), u, x0)
    for k in range(system.p):
        rest = _rest(system.p, k)
        yield Record(FaultySystem(without_output(residual, k), B, D.rows(rest)), u, x0)
    for k in range(system.nu):
        rest = _rest(system.nu, k)
        yield Record(FaultySystem(residual, B.columns(rest), D.columns(rest)), u.columns(rest), x0)
    for kept in (range(u.nrows - 1), range(1, u.nrows)) if u.nrows else ():
        yield Record(system, u.rows(kept), x0)
    for name in "AFCG":
        for matrix in simpler_matrices(getattr(residual, name)):
            yield Record(FaultySystem(with_matrix(residual, name, matrix), B, D), u, x0)
    yield from (Record(FaultySystem(residual, matrix, D), u, x0) for matrix in simpler_matrices(B))
    yield from (Record(FaultySystem(residual, B, matrix), u, x0) for matrix in simpler_matrices(D))
    yield from (Record(system, matrix, x0) for matrix in simpler_matrices(u))
    yield from (Record(system, u, matrix) for matrix in simpler_matrices(x0))


@lru_cache(maxsize=4)
def _choices(field: Field) -> tuple[KnownCase, ...]:
    found = []
    for known in known_systems(field):
        system = known.subject.system
        if system.n > LARGEST_STATES:
            continue
        rng = random.Random(str(system))
        pencil = pencil_of(system)
        listed = [P for k in sorted({system.m, pencil.columns}) for P in small_columns(pencil.n_z, k, rng)]
        bad = bad_pair(pencil)
        if isinstance(bad, BadPair):
            listed.append(bad.verdict.P)
        for P in dict.fromkeys(listed):
            P = Matrix.of(P.elements(), system.field, shape=P.shape)
            found.append(KnownCase(known.origin, Choice(system, P), ChoiceSubject(known.subject, P)))
    return tuple(found)


def _choice_steps(choice: Choice) -> Iterator[Choice]:
    """Yield the choices with a column of P less, a simpler entry of it, or a smaller system; where n_z is less then, a row less."""
    system, P = choice.system, choice.P
    for k in range(P.ncols):
        yield Choice(system, P.columns(j for j in range(P.ncols) if j != k))
    for other in steps(system):
        n_z = fault_space_dimension(other)
        if n_z <= P.nrows:
            for rows in combinations(range(P.nrows), n_z):
                yield Choice(other, P.rows(rows))
    for simpler in simpler_matrices(P):
        yield Choice(system, simpler)


@lru_cache(maxsize=8)
def _pairs(field: Field, one_A_and_C: bool) -> tuple[KnownCase, ...]:
    found = []
    for origin, first, second in _listed(field):
        if not one_A_and_C or (first.system.A, first.system.C) == (second.system.A, second.system.C):
            case = Pair(first.system, second.system, one_A_and_C)
            found.append(KnownCase(origin, case, PairSubject(first, second)))
    return tuple(found)


def _listed(field: Field) -> Iterator[tuple[str, Subject, Subject]]:
    for n in range(1, REGISTERS + 1):
        idle, driven = (Subject(over(field, one)) for one in shift_registers(n))
        yield CORPUS, idle, driven
        yield CORPUS, driven, idle
    for known in known_systems(field):
        system = known.subject.system
        if system.n > LARGEST_STATES:
            continue
        rng = random.Random(str(system))
        others = relatives(system, rng) if known.origin == CORPUS else _others(known.subject, rng)
        for other in others:
            yield known.origin, known.subject, Subject(other)


def _others(subject: Subject, rng: random.Random) -> Iterator[ResidualSystem]:
    """Yield the system with faults that explain n samples as its own do, a fault more or less among them."""
    system = subject.system
    space = fault_space(subject.kernel, system.n)
    for _ in range(CHOICES):
        columns = max(system.m + rng.choice((-1, 0, 0, 1)), 0)
        entries = [[rng.randint(-1, 1) for _ in range(columns)] for _ in range(space.dimension)]
        yield with_pair(space, Matrix.of(entries, system.field, shape=(space.dimension, columns)))


def _pair_steps(pair: Pair) -> Iterator[Pair]:
    """Yield the pairs with a state, a fault, an output or an entry less; of a common (A, C) in both systems at once."""
    one, other, shared = pair.first, pair.second, pair.one_A_and_C
    if shared:
        for k in range(one.n):
            yield Pair(without_state(one, k), without_state(other, k), True)
        for name in "AC":
            for matrix in simpler_matrices(getattr(one, name)):
                yield Pair(with_matrix(one, name, matrix), with_matrix(other, name, matrix), True)
    for k in range(one.p):
        yield Pair(without_output(one, k), without_output(other, k), shared)
    for first in steps(one):
        if first.p == one.p and (not shared or (first.A, first.C) == (one.A, one.C)):
            yield Pair(first, other, shared)
    for second in steps(other):
        if second.p == other.p and (not shared or (second.A, second.C) == (other.A, other.C)):
            yield Pair(one, second, shared)


@dataclass(frozen=True)
class KnownSystem:
    """`origin` is the corpus or the adversary."""

    origin: str
    subject: Subject


@lru_cache(maxsize=4)
def known_systems(field: Field) -> tuple[KnownSystem, ...]:
    """Return them over a field, over GF(q) integers modulo q; each keeps what is found out about it."""
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
    rest = _rest(system.n, k)
    return ResidualSystem(system.A.rows(rest).columns(rest), system.F.rows(rest), system.C.columns(rest), system.G)


def without_fault(system: ResidualSystem, k: int) -> ResidualSystem:
    """Return the system without its fault k."""
    rest = _rest(system.m, k)
    return ResidualSystem(system.A, system.F.columns(rest), system.C, system.G.columns(rest))


def without_output(system: ResidualSystem, k: int) -> ResidualSystem:
    """Return the system without its output k."""
    rest = _rest(system.p, k)
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


def _rest(count: int, k: int) -> list[int]:
    return [i for i in range(count) if i != k]


def _simpler(x: object, field: Field) -> list[object]:
    """Return 0, 1, -1 and half of it, rounded to 0, as far as they are simpler than the entry."""
    if not isinstance(field, Rationals):
        return [] if x == 0 else [field.element(0)] if x == 1 else [field.element(0), field.element(1)]
    value = Fraction(int(x.p), int(x.q))  # type: ignore[attr-defined]
    weight = (height(value), value != 0, value < 0)
    candidates = [Fraction(0), Fraction(1), Fraction(-1), Fraction(int(value / 2))]
    return [field.element(one) for one in dict.fromkeys(candidates) if (height(one), one != 0, one < 0) < weight]
