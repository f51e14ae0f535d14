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

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

from ...exact.algebra.matrices import Matrix
from ...exact.algebra.polynomials import Poly
from ...exact.structure.fault_columns import FaultSpace, fault_space
from ...exact.structure.kernel_rows import KernelRepresentation, KernelRow
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, accept
from .kept_kernels import kernel_once

A = TypeVar("A")


@dataclass(frozen=True)
class Question(Generic[A]):
    """This is a question about a system, given by its kernel representation.

    `certificates(kernel)` answer it, and `read(kernel, certificates)` is the answer that they state. Both are functions of a module, as
    questions go to other processes.
    """

    name: str
    certificates: Callable[[KernelRepresentation], Iterator[Certificate]]
    read: Callable[[KernelRepresentation, Sequence[Certificate]], A]

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Answer(Generic[A]):
    """This is what accepted certificates state, and their SHA-256."""

    value: A
    accepted: frozenset[str]


def answered(question: Question[A], kernel: KernelRepresentation) -> Answer[A]:
    """Return the answer to a question, read off certificates that the checker has accepted.

    Raises checker.Rejected or checker.Malformed where the checker does not accept one, and ArithmeticError where two of them disagree.
    """
    certificates = tuple(question.certificates(kernel))
    decided = frozenset(map(accept, certificates))
    return Answer(question.read(kernel, certificates), decided)


# -- the ranks of all windows by kernel rows -------------------------------------------------------------------------------


def _ranks(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.window_ranks(kernel)
    yield make.left_invertible(kernel)


def _kernel(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> KernelRepresentation:
    ranks, inversion = certificates
    rows = tuple(KernelRow(row["pivot"], Matrix.of(row["coefficients"], kernel.system.field)) for row in ranks["witness"]["kernel"])
    found = replace(kernel, rows=rows)
    if (found.normal_rank == kernel.system.m) != (inversion["kind"] == "left-invertible"):
        raise ArithmeticError(f"two accepted certificates disagree on whether {kernel.system} is left-invertible")
    return found


# -- one certificate a question --------------------------------------------------------------------------------------------


def _observability(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.matrix_rank("observability", kernel.system)


def _reachability(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.matrix_rank("reachability", kernel.system)


def _rank(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> int:
    return int(certificates[0]["statement"]["rank"])


def _dual_ranks(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.window_ranks(kernel_once(kernel.system.transposed()))


def _left_indices(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(certificates[0]["statement"]["left_minimal_indices"])


def _from_known_state(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.inversion_delay(kernel, known_state=True)


def _from_unknown_state(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.inversion_delay(kernel, known_state=False)


def _delay(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> int | None:
    delay: int | None = certificates[0]["statement"]["delay"]
    return delay


def _finite_zeros(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.finite_zeros(kernel.system)


def _polynomial(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> Poly:
    return tuple(kernel.system.field.element(c) for c in certificates[0]["statement"]["invariant_zero_polynomial"])


def _infinite_zeros(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.infinite_zeros(kernel.system)


def _orders(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(certificates[0]["statement"]["infinite_zero_orders"])


def _limit(kernel: KernelRepresentation) -> Iterator[Certificate]:
    yield make.fault_space(kernel, fault_space(kernel))


def _space(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> FaultSpace:
    system, basis = kernel.system, certificates[0]["statement"]["basis"]
    return FaultSpace(system, None, kernel.lag + 1, Matrix.of(basis, system.field, shape=(len(basis), system.n + system.p)))


# -- a certificate for each of the windows s = 1, ..., n + 2 ---------------------------------------------------------------


def _window_spaces(kernel: KernelRepresentation) -> Iterator[Certificate]:
    for s in range(1, kernel.system.n + 3):
        yield make.fault_space(kernel, fault_space(kernel, s))


def _dimensions(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(len(certificate["statement"]["basis"]) for certificate in certificates)


def _windows(kernel: KernelRepresentation) -> Iterator[Certificate]:
    for s in range(1, kernel.system.n + 3):
        yield make.matrix_rank("window", kernel.system, window=s)


def _window_ranks(kernel: KernelRepresentation, certificates: Sequence[Certificate]) -> tuple[int, ...]:
    return tuple(certificate["statement"]["rank"] for certificate in certificates)


RANKS = Question("ranks", _ranks, _kernel)
OBSERVABILITY = Question("observability", _observability, _rank)
REACHABILITY = Question("reachability", _reachability, _rank)
RIGHT_INDICES = Question("right indices", _dual_ranks, _left_indices)
DELAY_KNOWN_STATE = Question("delay from a known state", _from_known_state, _delay)
DELAY_UNKNOWN_STATE = Question("delay from an unknown state", _from_unknown_state, _delay)
FINITE_ZEROS = Question("finite zeros", _finite_zeros, _polynomial)
INFINITE_ZEROS = Question("infinite zeros", _infinite_zeros, _orders)
SPACE = Question("fault space", _limit, _space)
WINDOW_SPACES = Question("fault spaces of windows", _window_spaces, _dimensions)
WINDOWS = Question("windows one by one", _windows, _window_ranks)
MINIMAL: tuple[Question[Any], ...] = (RANKS, OBSERVABILITY, REACHABILITY)
ZEROS: tuple[Question[Any], ...] = (FINITE_ZEROS, INFINITE_ZEROS)
QUESTIONS: tuple[Question[Any], ...] = (
    RANKS, OBSERVABILITY, REACHABILITY, RIGHT_INDICES, DELAY_KNOWN_STATE, DELAY_UNKNOWN_STATE, FINITE_ZEROS, INFINITE_ZEROS, SPACE,
    WINDOW_SPACES, WINDOWS,
)  # fmt: skip
