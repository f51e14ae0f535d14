"""Boxes are gone through to the end: every system of given dimensions over GF(2) or GF(3), beyond the boxes of the corpus.

    Sweep      a target, a box, its cases and the decision on one
    Swept      how far it came: whether to the end, and what it found
    sweeps     all of them
    sweep      one of them, for at most so many seconds of the process

One system of each orbit under changes of basis stands for the orbit: see `proofs.exhaustive`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import Any

from ...exact.algebra.matrices import Matrix
from ...exact.parametric.cofactors import generic_exceptional
from ...exact.structure.behavior import compare
from ...exact.structure.kernel_rows import kernel_representation
from ..claims.common import delays, zeros
from ..evidence.exhaustive import Orbit, orbits
from ..trust import structure_certificates as make
from ..trust.structure_certificates import accept
from .structure_attacks import Decide, irrecoverable, misplaced, unlike, wrong_delay, wrong_signal, zeros_as_a_set
from .witnesses import Found

BOXES = ((2, 3, 1, 1), (3, 2, 1, 2))

PARTNERS = ((2, 2, 2, 1), (2, 1, 3, 2), (2, 2, 3, 1), (3, 2, 2, 1))

Case = tuple[Any, int]


@dataclass(frozen=True)
class Sweep:
    """`cases` yields (case, how many subjects it stands for); `decide` gives words and certificates of a counterexample, or None."""

    target: str
    name: str
    words: str
    cases: Callable[[], Iterable[Case]]
    decide: Callable[[Any], Found | None]

    @property
    def id(self) -> str:
        """This is the name of the sweep in the file of results."""
        return f"{self.target} by {self.name}"


@dataclass(frozen=True)
class Swept:
    """`cases` and `subjects` were decided, all of the box where it is `complete`."""

    sweep: Sweep
    cases: int
    subjects: int
    complete: bool
    seconds: float
    found: Found | None


def sweeps() -> Iterator[Sweep]:
    """Yields the sweeps in the order of the ledger."""
    deciders: tuple[tuple[str, Decide], ...] = (
        ("trajectory-recovered.state-known", unlike(wrong_delay, delays)),
        ("trajectory-recovered.no-finite-zeros-as-a-set", unlike(zeros_as_a_set, lambda system: [*zeros(system), *delays(system)])),
        ("trajectory-recovered.zero-feedthrough-signal", unlike(wrong_signal, zeros)),
        ("zero-assignment.unobservable", misplaced),
        ("zero-assignment.recoverable", irrecoverable),
    )
    for target, decide in deciders:
        for q, n, p, m in BOXES:
            words = f"all systems over GF({q}) with n = {n}, p = {p}, m = {m}"
            yield Sweep(target, words, words, partial(_systems, q, n, p, m), decide)
    for q, n, p, m in PARTNERS:
        words = f"all systems over GF({q}) with n = {n}, p = {p}, m = {m}, each with all fault matrices"
        yield Sweep("sharp-windows.equality-as-many-faults", words, words, partial(_systems, q, n, p, m), _without_partner)
    words = "all dimensions n, m <= 2, p <= 3, every entry free"
    yield Sweep("one-determinant.parametric", "common factors in the parameters", words, _dimensions, _common_factor)


def sweep(one: Sweep, *, seconds: float) -> Swept:
    """Goes through the box until a counterexample, the end of the box, or the end of the time."""
    started = time.process_time()
    cases = subjects = 0
    found = None
    complete = True
    for case, weight in one.cases():
        if time.process_time() > started + seconds:
            complete = False
            break
        cases, subjects = cases + 1, subjects + weight
        found = one.decide(case)
        if found is not None:
            for certificate in found[1]:
                accept(certificate)
            break
    return Swept(one, cases, subjects, complete and found is None, time.process_time() - started, found)


def _systems(q: int, n: int, p: int, m: int) -> Iterator[Case]:
    found: tuple[Orbit, ...] = orbits(q, n, p, m)
    for orbit in found:
        yield orbit.system, orbit.size


def _without_partner(system: Any) -> Found | None:
    """Finds a left-invertible system with m >= 1 and lag >= 1 for which no left-invertible (F', G') of as many columns agrees on lag
    samples and no more."""
    kernel = kernel_representation(system)
    if kernel.normal_rank < system.m or not system.m or not kernel.lag:
        return None
    n, p, m = system.n, system.p, system.m
    for entries in product(range(system.field.p), repeat=(n + p) * m):
        rows = [list(entries[i * m : (i + 1) * m]) for i in range(n + p)]
        F, G = (Matrix.of(part, system.field, shape=(size, m)) for part, size in ((rows[:n], n), (rows[n:], p)))
        other = kernel_representation(system.with_faults(F, G))
        if other.normal_rank == m and compare(kernel, other).first_difference == kernel.lag + 1:
            return None
    return f"{system}: none of its partners over the field differs first at lag + 1", [make.window_ranks(kernel)]


def _dimensions() -> Iterator[Case]:
    for n, p, m in product((0, 1, 2), (1, 2, 3), (1, 2)):
        yield (n, p, m), 1


def _common_factor(case: Any) -> Found | None:
    """Finds a factor that all cofactors share in Q[entries, q]; the check of the reading decides over Q(entries) alone."""
    n, p, m = case
    found = generic_exceptional(n, p, m)
    common = found.cofactors[0].cofactor
    for one in found.cofactors[1:]:
        common = common.gcd(one.cofactor)
    return None if common.is_ground else (f"(n, p, m) = ({n}, {p}, {m}): every cofactor is a multiple of {common}", [])
