"""The hypotheses of the claims about all P at once: size of the bad set, bad P of full column rank, zero assignment; and about one P.

Chosen              a pair (Fhat P, Ghat P) with a chosen P, as a subject
codimension         the bad P have codimension at least two
bad_of_full_rank    some P of full column rank is bad
placement           every polynomial of degree at most zeta is the zero polynomial of a pair
determinant         D(q; P) is the zero polynomial of the pair
zeros_of_pair       a pair has as many zeros as its system

wanted              polynomials of every degree up to zeta: random, with a zero constant term, with one repeated root, not monic

The size of the bad set is counted from the degrees of L(q) by exact/pairs, which certificates of lines confirm in the claim itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from random import Random
from typing import Any

from ...base.errors import InvalidInput
from ...exact.algebra.fields import PrimeField
from ...exact.algebra.matrices import Matrix, rank
from ...exact.algebra.polynomials import Poly, monic, multiply, trimmed
from ...exact.pairs.assignment import assign_zeros
from ...exact.pairs.bad_variety import bad_set
from ...exact.pairs.polynomial import Exceptional, polynomial_at
from ...exact.pairs.witnesses import BadPair, bad_pair
from ...exact.structure.fault_columns import with_pair
from ...exact.structure.pencil import infinite_zero_orders, invariant_zero_polynomial
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order, matrices_in_order
from ..claims.pairs import agrees
from ..claims.pairs import show as show_pair
from ..evidence.alternatives import comparison_certificate
from ..evidence.material import Material
from ..evidence.pairs_by_polynomial import PAIRS_BY_POLYNOMIAL, PairByPolynomial, examine_by_polynomial, pencil_of
from ..evidence.subjects import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.ablation import Ablation, Found, Proof, first_found
from ..verdict.workbench import Workbench, size
from .facets import aimed_systems, degenerate, expressions, of_system
from .systems import MODEL
from .windowed import NO_WINDOW, Condition, Windowed, says, windowed

BOX = Box(n=(1, 1), m=(1, 2), p=(1, 2), total=5)
WIDER = Box(n=(1, 1), m=(1, 2), p=(1, 3), total=6)
LONGER = Box(n=(1, 2), m=(1, 1), p=(1, 1), total=4)


ZETA = "n - sum(left_minimal_indices)"  # of a pencil, left-invertible or not
TWO_FAULTS = says("normal_rank >= 2")
SOME_ZERO = Condition((), lambda w: pencil_of(w.evidence.system).zeta >= 1, f"{ZETA} >= 1")
SIZES = {**MODEL, "r >= 2": TWO_FAULTS, "zeta >= 1": SOME_ZERO}


def codimension() -> Ablation[Windowed]:
    """Return the ablation of bad-set's claim that the codimension is at least two.

    Why r, controllability and left-invertibility play no part: a hypersurface of bad P is f(P) = 0 with f irreducible, and f divides every
    coefficient of D(q; P). The bad set is invariant under P -> P V, det V = 1, so that f is a polynomial in the r x r minors of P (the
    first fundamental theorem); the coefficients are linear in these, so each is a number times f and D(q; P) = f(P) d(q), whose zeros no P
    moves. But with (A, C) observable and zeta >= 1 every polynomial of degree at most zeta is reached. Rocq proves, in another way, that a
    plane of P then meets the bad ones in 0 alone, over every extension of the field; that a cone which does so over an algebraically closed
    field has codimension at least two is the projective dimension theorem.
    """

    def at_least_two(subject: Windowed) -> bool:
        size = bad_set(pencil_of(subject.evidence.system)).codimension
        return size is None or size >= 2

    conclusion = Condition((), at_least_two, f"observable and {ZETA} >= 1")
    proof = Proof(("bad_set_plane",), frozenset({"observable", "zeta >= 1"}))
    words = "over every extension of the field a plane meets the bad P in 0 alone (and so, as is known, they have codimension at least 2)"
    return _of_pencils("codimension", words, conclusion, proof)


def bad_of_full_rank() -> Ablation[Windowed]:
    """Return the ablation of the claim, in bad-set, that some P of full column rank is bad."""

    def exists(subject: Windowed) -> bool:
        return isinstance(bad_pair(pencil_of(subject.evidence.system)), BadPair)

    conclusion = Condition((), exists, f"normal_rank >= 2 and {ZETA} >= 1")
    proof = Proof(("bad_set_full_rank",), frozenset({"r >= 2", "zeta >= 1"}))
    return _of_pencils("bad-of-full-rank", "some P of full column rank is bad", conclusion, proof)


def placement() -> Ablation[Windowed]:
    """The ablation of zero-assignment: polynomials of every degree up to zeta are each assigned and looked for in the pair."""

    def reached(subject: Windowed) -> bool:
        return every_polynomial_is_reached(pencil_of(subject.evidence.system))

    words = "where r >= 1, every nonzero polynomial of degree at most zeta is the zero polynomial of some pair"
    conclusion = Condition((), reached, f"observable or {ZETA} == 0")
    some_column = says("normal_rank >= 1")
    proof = Proof(("zero_assignment_observable",), frozenset({"observable"}))
    made = ("placement", "zero-assignment", words, MODEL, conclusion, _show, some_column, lambda n: NO_WINDOW, LONGER)
    return windowed(*made, proof=proof)


def _of_pencils(name: str, words: str, conclusion: Condition, proof: Proof | None) -> Ablation[Windowed]:
    return windowed(name, "bad-set", words, SIZES, conclusion, _show, windows=lambda n: NO_WINDOW, box=WIDER, proof=proof)


def _show(system: ResidualSystem) -> Iterator[Certificate]:
    """Yield certificates of Z, of the indices, and of a bad P of full column rank where there is one."""
    pencil = pencil_of(system)
    yield make.fault_space(pencil.kernel, pencil.space)
    yield make.window_ranks(pencil.kernel)
    yield make.matrix_rank("observability", system)
    bad = bad_pair(pencil)
    if isinstance(bad, BadPair):
        pair = kernel_once(with_pair(pencil.space, bad.verdict.P))
        yield comparison_certificate(pencil.kernel, pair)
        yield make.window_ranks(pair)


@dataclass(frozen=True)
class Chosen:
    """A pair (Fhat P, Ghat P), with a P that was chosen, is here a subject."""

    record: PairByPolynomial

    @property
    def size(self) -> tuple[int, ...]:
        """The numbers n + m + p, then n, m, p."""
        return size(self.record.system)

    @property
    def weight(self) -> int:
        """The number of systems in the orbit."""
        return self.record.weight

    @property
    def field(self) -> str:
        """The field in words, as it is printed."""
        return str(self.record.system.field)

    @property
    def accepted(self) -> frozenset[str]:
        """The accepted certificates, by their SHA-256."""
        return self.record.accepted

    @property
    def degenerate(self) -> str:
        """Why it would be a poor witness: the system is one, or P is not of full column rank."""
        return degenerate(self.record.system) or ("" if self.record.full_column_rank else "P is not of full column rank")

    def __str__(self) -> str:
        return f"{self.record.system} with F' = {self.record.pair.F}, G' = {self.record.pair.G}"


OF_SYSTEM: dict[str, Callable[[Chosen], bool]] = of_system(lambda pair: pair.record.system)
GOOD = "P good: normal rank r"


def _subjects(bench: Workbench) -> Iterator[Chosen]:
    bench.need(PAIRS_BY_POLYNOMIAL, AIMED_PAIRS)
    for record in (*bench.pairs_by_polynomial, *bench.material(AIMED_PAIRS)):
        yield Chosen(record)


def _aimed(bench: Workbench) -> Iterator[ResidualSystem]:
    return aimed_systems(60 if bench.full else 6)


def _examined(system: ResidualSystem) -> list[PairByPolynomial]:
    """Return pairs of two random P for a system."""
    found = []
    pencil, rng = pencil_of(system), Random(str(system))
    for _ in range(2):
        rows = [[rng.choice((-2, -1, 0, 0, 1, 2)) for _ in range(pencil.columns)] for _ in range(pencil.n_z)]
        P = Matrix.of(rows, shape=(pencil.n_z, pencil.columns))
        found.append(examine_by_polynomial("aimed", "random", system, P, None, 1))
    return found


AIMED_PAIRS = Material("aimed pairs", "aimed pairs and their polynomials", _aimed, _examined, 20)


def determinant() -> Ablation[Chosen]:
    """The ablation of one-determinant; there is nothing to search for where D(q; P) and the certificates agree on every pair tried."""
    return Ablation(
        name="determinant",
        claim="one-determinant",
        conclusion="D(q; P) is the zero polynomial of the pair, and 0 iff P is bad",
        hypotheses=OF_SYSTEM,
        holds=lambda subject: agrees(subject.record),
        subjects=_subjects,
        over_q=lambda bench, dropped: Found(None, "the pairs judged"),
        show=lambda subject: show_pair(subject.record),
        proof=Proof(("one_determinant", "one_determinant_exists", "theorem_3_criterion")),
    )


def zeros_of_pair() -> Ablation[Chosen]:
    """The ablation of zeros-of-pairs: a pair has as many zeros as the system."""
    hypotheses: dict[str, Callable[[Chosen], bool]] = {
        **OF_SYSTEM,
        GOOD: lambda pair: pair.record.pair_normal_rank == pair.record.normal_rank,
    }
    return Ablation(
        name="zeros-of-pair",
        claim="zeros-of-pairs",
        conclusion="the pair has zeta zeros, finite and infinite",
        hypotheses=hypotheses,
        holds=_as_many,
        subjects=_subjects,
        over_q=partial(_smallest_pair, hypotheses),
        show=lambda subject: show_pair(subject.record),
        proof=Proof(("zeros_of_pairs", "theorem_3_criterion", "left_invertible_transfer", "zeros_exist"), frozenset({GOOD})),
    )


def _as_many(subject: Chosen) -> bool:
    d = subject.record
    return len(d.zero_polynomial) - 1 + d.infinite_zeros == d.zeta


def _smallest_pair(hypotheses: Mapping[str, Callable[[Chosen], bool]], bench: Workbench, dropped: Sequence[str]) -> Found[Chosen]:
    """Return the first system and P, in this order, that meets what is kept and has another number of zeros."""
    kept = [test for name, test in hypotheses.items() if name not in dropped]

    def counterexamples(poor: bool) -> Iterator[Chosen]:
        for system in in_order(BOX, *expressions(set(hypotheses) - set(dropped))):
            if degenerate(system) and not poor:
                continue
            pencil = pencil_of(system)
            for P in matrices_in_order(pencil.n_z, pencil.columns):
                if rank(P) < pencil.columns and not poor:
                    continue
                pair = kernel_once(with_pair(pencil.space, P))
                count = len(polynomial_at(pencil, P)) - 1 + sum(infinite_zero_orders(pair))
                if pair.normal_rank < pencil.columns or count != pencil.zeta:
                    subject = Chosen(examine_by_polynomial("search", "search", system, P, None, 1))
                    if bool(subject.degenerate) == poor and all(test(subject) for test in kept) and not _as_many(subject):
                        yield subject

    return first_found(counterexamples, f"{BOX}, entries of P in {{-1, 0, 1}}")


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
