"""What the claims ask of a single system: each question has certificates of its own, and what they state is read back as the answer.

    Question       its name, the certificates that answer it, and how the answer is read off them
    Answer         what accepted certificates state, and which they are
    answered       the certificates of a question made, accepted by the checker, and read
    RANKS, ...     the questions; QUESTIONS has all of them, in order
    MINIMAL, ZEROS what tells whether a system is minimal and left-invertible, and what tells all of its zeros

A claim names the questions that it asks, so that no certificate is made that its verdict does not rest on, and each that is counted
bears on it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

from ...exact.algebra.matrices import Matrix
from ...exact.algebra.polynomials import Poly
from ...exact.structure.fault_columns import FaultSpace
from ...exact.structure.kernel_rows import KernelRepresentation, KernelRow
from ...exact.system.systems import ResidualSystem
from ..trust.structure_certificates import Certificate, accept
from . import certified
from .certified import Certifier
from .subjects import Subject

A = TypeVar("A")


@dataclass(frozen=True)
class Question(Generic[A]):
    """A question about a system.

    The certificates of `makers` answer it, and `read(subject, certificates)` is the answer that they state. All are functions of a module,
    as questions go to other processes.
    """

    name: str
    makers: tuple[Certifier, ...]
    read: Callable[[Subject, Sequence[Certificate]], A]

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Answer(Generic[A]):
    """What accepted certificates state, and their SHA-256."""

    value: A
    accepted: frozenset[str]


def answered(question: Question[A], system: ResidualSystem) -> Answer[A]:
    """Return the answer to a question, read off certificates that the checker has accepted.

    Raises checker.Rejected or checker.Malformed where the checker does not accept one, and ArithmeticError where two of them disagree.
    """
    subject = Subject(system)
    made = [certificate for maker in question.makers for certificate in maker(subject)]
    decided = frozenset(map(accept, made))
    return Answer(question.read(subject, made), decided)


def _kernel(subject: Subject, made: Sequence[Certificate]) -> KernelRepresentation:
    ranks, inversion = made
    rows = tuple(KernelRow(row["pivot"], Matrix.of(row["coefficients"], subject.system.field)) for row in ranks["witness"]["kernel"])
    found = replace(subject.kernel, rows=rows)
    if (found.normal_rank == subject.system.m) != (inversion["kind"] == "left-invertible"):
        raise ArithmeticError(f"two accepted certificates disagree on whether {subject.system} is left-invertible")
    return found


def _rank(subject: Subject, made: Sequence[Certificate]) -> int:
    return int(made[0]["statement"]["rank"])


def _left_indices(subject: Subject, made: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(made[0]["statement"]["left_minimal_indices"])


def _delay(subject: Subject, made: Sequence[Certificate]) -> int | None:
    delay: int | None = made[0]["statement"]["delay"]
    return delay


def _polynomial(subject: Subject, made: Sequence[Certificate]) -> Poly:
    return tuple(subject.system.field.element(c) for c in made[0]["statement"]["invariant_zero_polynomial"])


def _orders(subject: Subject, made: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(made[0]["statement"]["infinite_zero_orders"])


def _space(subject: Subject, made: Sequence[Certificate]) -> FaultSpace:
    system, basis = subject.system, made[0]["statement"]["basis"]
    return FaultSpace(system, None, subject.kernel.lag + 1, Matrix.of(basis, system.field, shape=(len(basis), system.n + system.p)))


def _dimensions(subject: Subject, made: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(len(certificate["statement"]["basis"]) for certificate in made)


def _ranks(subject: Subject, made: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(certificate["statement"]["rank"] for certificate in made)


RANKS = Question("ranks", (certified.windows, certified.invertible), _kernel)
OBSERVABILITY = Question("observability", (certified.observed,), _rank)
REACHABILITY = Question("reachability", (certified.reached,), _rank)
RIGHT_INDICES = Question("right indices", (certified.dual_windows,), _left_indices)
DELAY_KNOWN_STATE = Question("delay from a known state", (certified.delay_known,), _delay)
DELAY_UNKNOWN_STATE = Question("delay from an unknown state", (certified.delay_unknown,), _delay)
FINITE_ZEROS = Question("finite zeros", (certified.finite,), _polynomial)
INFINITE_ZEROS = Question("infinite zeros", (certified.infinite,), _orders)
SPACE = Question("fault space", (certified.solutions,), _space)
WINDOW_SPACES = Question("fault spaces of windows", (certified.solutions_by_window,), _dimensions)
WINDOWS = Question("windows one by one", (certified.window_by_window,), _ranks)
MINIMAL: tuple[Question[Any], ...] = (RANKS, OBSERVABILITY, REACHABILITY)
ZEROS: tuple[Question[Any], ...] = (FINITE_ZEROS, INFINITE_ZEROS)
QUESTIONS: tuple[Question[Any], ...] = (
    RANKS, OBSERVABILITY, REACHABILITY, RIGHT_INDICES, DELAY_KNOWN_STATE, DELAY_UNKNOWN_STATE, FINITE_ZEROS, INFINITE_ZEROS, SPACE,
    WINDOW_SPACES, WINDOWS,
)  # fmt: skip
