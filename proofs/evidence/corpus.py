"""The systems that claims are tried on, each with certificates that the checker has accepted: made once a run, read by every claim.

    Evidence     what accepted certificates answer to some questions about a system, with its origin and weight
    examine      one system: certificates made, checked, and read back
    by_question  material about systems, a kind for each question
    CORPUS       all systems of an effort, by question
    describe     how some of them were made, in words with counts

A claim reads evidence only, so that whatever it concludes rests on statements that the checker has accepted.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import Any, TypeVar

from ...exact.algebra.fields import QQ, Field, NumberField, PrimeField
from ...exact.algebra.matrices import rank
from ...exact.algebra.polynomials import Poly
from ...exact.structure.fault_columns import FaultSpace
from ...exact.structure.kernel_rows import KernelRepresentation
from ...exact.system.systems import ResidualSystem
from .exhaustive import orbits
from .families import adversarial, paper_example, random_systems
from .material import Material
from .orbits_by_stages import orbits_by_stages
from .questions import (
    DELAY_KNOWN_STATE,
    DELAY_UNKNOWN_STATE,
    FINITE_ZEROS,
    INFINITE_ZEROS,
    OBSERVABILITY,
    QUESTIONS,
    RANKS,
    REACHABILITY,
    RIGHT_INDICES,
    SPACE,
    WINDOW_SPACES,
    WINDOWS,
    Answer,
    Question,
    answered,
)

A = TypeVar("A")
Questions = Sequence[Question[Any]]
Source = tuple[str, ResidualSystem, int]
ByQuestion = Mapping[Question[Any], Material]


class Unasked(LookupError):
    """A reading wants to know of a system what it did not ask."""


@dataclass(frozen=True)
class Evidence:
    """What accepted certificates state of a system, as far as it was asked: each property is the answer to a question.

    `origin` says in words how the system was made, and `weight` how many systems it stands for (the size of an orbit, else 1).
    `window_ranks` are rank [O_s T_s] and `space_dimensions` the dimensions of problem (11) for s = 1, ..., n + 2, each from a certificate
    of its own, while those of `kernel` and `fault_space` follow from kernel rows. The other names are those of `Structure`. A property
    raises Unasked where its question was not asked.
    """

    origin: str
    system: ResidualSystem
    weight: int
    answers: Mapping[Question[Any], Answer[Any]]

    def answer(self, question: Question[A]) -> A:
        """Return what accepted certificates state. Raises Unasked for a question that was not asked."""
        if question not in self.answers:
            raise Unasked(f"{question} was not asked of {self.system}")
        value: A = self.answers[question].value
        return value

    def asked(self, questions: Questions) -> Evidence:
        """Return the evidence with the answers to these questions and no other; those that are not there yet are found now."""
        missing = [question for question in questions if question not in self.answers]
        found = {**self.answers, **{question: answered(question, self.system) for question in missing}}
        answers = {question: found[question] for question in questions}
        return Evidence(self.origin, self.system, self.weight, answers)

    @property
    def accepted(self) -> frozenset[str]:
        """The certificates that the answers rest on, all of them accepted, by their SHA-256."""
        return frozenset().union(*(answer.accepted for answer in self.answers.values()))

    @property
    def kernel(self) -> KernelRepresentation:
        """The kernel rows, as the certificate of all window ranks has them."""
        return self.answer(RANKS)

    @property
    def left_invertible(self) -> bool:
        """This tells whether the normal rank is m, on which two certificates agree."""
        return self.kernel.normal_rank == self.system.m

    @property
    def observable(self) -> bool:
        """This tells whether (A, C) is observable."""
        return self.answer(OBSERVABILITY) == self.system.n

    @property
    def controllable(self) -> bool:
        """This tells whether (A, F) is controllable."""
        return self.answer(REACHABILITY) == self.system.n

    @property
    def right_minimal_indices(self) -> tuple[int, ...]:
        """The left minimal indices of the transposed system."""
        return self.answer(RIGHT_INDICES)

    @property
    def delay_known_state(self) -> int | None:
        """The delay of left inversion with x(0) known, a number of samples, or None."""
        return self.answer(DELAY_KNOWN_STATE)

    @property
    def delay_unknown_state(self) -> int | None:
        """The delay of left inversion with x(0) unknown, a number of samples, or None."""
        return self.answer(DELAY_UNKNOWN_STATE)

    @property
    def invariant_zero_polynomial(self) -> Poly:
        """Its coefficients, ascending."""
        return self.answer(FINITE_ZEROS)

    @property
    def finite_zeros(self) -> int:
        """n_f, the number of finite invariant zeros with multiplicity."""
        return len(self.invariant_zero_polynomial) - 1

    @property
    def infinite_zero_orders(self) -> tuple[int, ...]:
        """The orders of the zeros at infinity, one for each of the normal rank."""
        return self.answer(INFINITE_ZEROS)

    @property
    def zeta(self) -> int:
        """zeta is the number of zeros of the pencil, finite and infinite together."""
        return self.finite_zeros + sum(self.infinite_zero_orders)

    @property
    def fault_space(self) -> FaultSpace:
        """The limit of problem (11)."""
        return self.answer(SPACE)

    @property
    def without_feedthrough(self) -> int:
        """The dimension of the members (f, g = 0) of the fault space."""
        return self.fault_space.dimension - rank(self.fault_space.G)

    @property
    def space_dimensions(self) -> tuple[int, ...]:
        """The dimensions of problem (11) for s = 1, ..., n + 2."""
        return self.answer(WINDOW_SPACES)

    @property
    def window_ranks(self) -> tuple[int, ...]:
        """The ranks of [O_s T_s], each matrix by itself, for s = 1, ..., n + 2."""
        return self.answer(WINDOWS)


def describe(evidence: Iterable[Evidence]) -> str:
    """Return how these systems were made, with counts."""
    counts: Counter[str] = Counter()
    orbit_counts: Counter[str] = Counter()
    for one in evidence:
        counts[one.origin] += one.weight
        orbit_counts[one.origin] += 1
    parts = []
    for origin, total in counts.items():
        here = orbit_counts[origin]
        parts.append(f"{origin} ({total} systems in {here} orbits)" if total != here else f"{here} {origin}")
    return "; ".join(parts)


def examine(origin: str, system: ResidualSystem, weight: int = 1, questions: Questions = QUESTIONS) -> Evidence:
    """Return what certificates answer to these questions about a system, accepted by the checker and read back.

    Raises checker.Rejected or checker.Malformed where the checker does not accept one, and ArithmeticError where two of them disagree.
    """
    return Evidence(origin, system, weight, {}).asked(questions)


def by_question(name: str, stage: str, sources: Callable[[Any], Iterable[Source]]) -> ByQuestion:
    """Return material about the systems of `sources(bench)`, a kind for each question: the evidence on each system, in order."""
    return {
        question: Material(f"{name} {question}", f"{stage}: {question}", sources, partial(_examined, question), 40)
        for question in QUESTIONS
    }


def together(parts: Sequence[Sequence[Evidence]], questions: Questions) -> tuple[Evidence, ...]:
    """Return the evidence on each system with the answers to all of these questions, of which `parts` has one each, in the same order."""
    found = []
    for ones in zip(*parts, strict=True):
        answers = {question: one.answers[question] for question, one in zip(questions, ones, strict=True)}
        found.append(Evidence(ones[0].origin, ones[0].system, ones[0].weight, answers))
    return tuple(found)


def _examined(question: Question[Any], item: Source) -> list[Evidence]:
    return [examine(*item, (question,))]


def _sources(bench: Any) -> Iterator[Source]:
    yield "the paper's example", paper_example().residual, 1
    for _, system in adversarial():
        yield "named adversarial systems", system, 1
    full = bench.full
    fields: list[tuple[Field, int]] = [
        (QQ, 3000 if full else 48),
        (NumberField(("-2", "0", "1")), 300 if full else 24),  # type: ignore[arg-type]
        (NumberField(("1", "-3", "-1", "4")), 300 if full else 12),  # type: ignore[arg-type]
        (PrimeField(5), 300 if full else 24),
    ]
    for field, count in fields:
        for system in islice(random_systems(field, count, seed=1), count):
            yield f"random systems of every structure over {field}", system, 1
    for q, n, p, m in _exhaustive_boxes(full):
        for orbit in orbits_by_stages(n, p, m) if full and q == 2 else orbits(q, n, p, m):
            yield f"all systems over GF({q}) in the box {_box(q, full)}", orbit.system, orbit.size
    for n, p in () if full else ((0, 2), (1, 2)):
        for orbit in orbits(2, n, p, 2):
            yield "all systems over GF(2) with n <= 1, p = 2, m = 2", orbit.system, orbit.size


def _exhaustive_boxes(full: bool) -> Iterator[tuple[int, int, int, int]]:
    for q in (2, 3):
        limits = _limits(q, full)
        for n in range(limits[0] + 1):
            for p in range(limits[1] + 1):
                for m in range(limits[2] + 1):
                    yield q, n, p, m


def _limits(q: int, full: bool) -> tuple[int, int, int]:
    """Return the largest n, p, m of the exhaustive box over GF(q)."""
    if q == 2:
        return (3, 3, 2) if full else (2, 2, 1)
    return (2, 2, 1) if full else (1, 2, 1)


def _box(q: int, full: bool) -> str:
    n, p, m = _limits(q, full)
    return f"n <= {n}, p <= {p}, m <= {m}"


CORPUS = by_question("corpus", "certifying the systems", _sources)
