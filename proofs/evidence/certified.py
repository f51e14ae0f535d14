"""These make the certificates that bear the value of a quantity, of the kinds that the checker has.

    Certifier        takes a subject (and a number of samples, where the quantity is windowed) and returns certificates
    windows          the left minimal indices, and with them rank [O_s T_s] for every s
    dual_windows     the same of the transposed system: right minimal indices
    silent_windows   the same of (A, C) alone: rank O_s for every s; reached_windows: that of (A', F')
    settled          ranks of T_n and [O_n T_n], whose difference is n less dim V*; of the transposed system it is dim S*

Certificates about the transposed system, or about (A, C) alone, state that system; that it is the one that is meant is seen by reading.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...exact.structure.fault_columns import fault_space
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from .subjects import Subject

Certifier = Callable[..., list[Certificate]]


def read(subject: Subject, *_: Any) -> list[Certificate]:
    """Return none: a number such as n is read off the system."""
    return []


def windows(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of the left minimal indices, the normal rank and every rank [O_s T_s]."""
    return [make.window_ranks(subject.kernel)]


def dual_windows(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of the left minimal indices of the transposed system."""
    return [make.window_ranks(subject.dual)]


def silent_windows(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of every rank of O_s, as that of the system without faults."""
    return [make.window_ranks(subject.silent)]


def reached_windows(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of every rank [F, ..., A^(s-1) F], as that of the transposed system without faults."""
    return [make.window_ranks(subject.reached)]


def driven(subject: Subject, s: int) -> list[Certificate]:
    """Return the certificate of rank T_s."""
    return [make.matrix_rank("toeplitz", subject.system, window=s)]


def infinite(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of the orders of the infinite zeros."""
    return [make.infinite_zeros(subject.system)]


def finite(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of the invariant zero polynomial."""
    return [make.finite_zeros(subject.system)]


def zeros(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificates of the finite and of the infinite zeros."""
    return [*finite(subject), *infinite(subject)]


def invertible(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate that the system is left-invertible, or that it is not."""
    return [make.left_invertible(subject.kernel)]


def dual_invertible(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate that the transposed system is left-invertible, or that it is not."""
    return [make.left_invertible(subject.dual)]


def delay_known(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of the delay with a known initial state, or that there is none."""
    return [make.inversion_delay(subject.kernel, known_state=True)]


def delay_unknown(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of the delay with an unknown initial state, or that there is none."""
    return [make.inversion_delay(subject.kernel, known_state=False)]


def observed(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of rank O_n."""
    return [make.matrix_rank("observability", subject.system)]


def reached(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate of rank [F, ..., A^(n-1) F]."""
    return [make.matrix_rank("reachability", subject.system)]


def both(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificates of these two ranks."""
    return [*observed(subject), *reached(subject)]


def settled(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificates of rank T_n and rank [O_n T_n]."""
    system = subject.system
    return [make.matrix_rank(name, system, window=system.n) for name in ("toeplitz", "window")]


def dual_settled(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificates of the same ranks of the transposed system."""
    system = subject.transposed
    return [make.matrix_rank(name, system, window=system.n) for name in ("toeplitz", "window")]


def solutions(subject: Subject, s: int | None = None) -> list[Certificate]:
    """Return the certificate of the solutions of problem (11) on s samples, or of their limit."""
    return [make.fault_space(subject.kernel, fault_space(subject.kernel, s))]


def stable(subject: Subject, *_: Any) -> list[Certificate]:
    """Return the certificate that A is Schur. Raises Unprovable where it is not: no kind says so."""
    return [make.schur_stable(subject.system)]


def window_by_window(subject: Subject) -> list[Certificate]:
    """Return the certificate of rank [O_s T_s], each matrix by itself, for s = 1, ..., n + 2."""
    return [make.matrix_rank("window", subject.system, window=s) for s in range(1, subject.system.n + 3)]


def solutions_by_window(subject: Subject) -> list[Certificate]:
    """Return the certificates of the solutions of problem (11) for s = 1, ..., n + 2."""
    return [one for s in range(1, subject.system.n + 3) for one in solutions(subject, s)]
