"""What is asked of one system alone, exactly and found once; and systems that lack one of these hypotheses and have all the others.

Facets           observable, controllable, left-invertible, stable, normal rank, lag; facets: those of a system
degenerate       why a system would be a poor witness; "" where it would not
POOR             an expression that says so of systems with states, outputs and faults
of_system        the hypotheses about one system, of subjects that have one
MODEL            the hypotheses about one system as expressions of the language of claims, for integer systems
expressions      those of some hypotheses
aimed_systems    as many for each of the four hypotheses: observable, controllable, left-invertible, A stable
other_columns    one of them with other fault columns of its Z
AIMED            the same with accepted certificates, by question, and HIDDEN_ZEROS, made once a run
HIDDEN_ZEROS     two systems all of whose finite zeros are unobservable modes, the zeros being more than the modes

Systems of the corpus lack some of the hypotheses only now and then. Most aimed ones are without feedthrough and with more outputs than
faults, so that they have zeros, at infinity and rarely finite ones: that is where the claims about zeros and about the bad P have something
to say.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from functools import lru_cache
from random import Random
from typing import TypeVar

from ...exact.algebra.fields import PrimeField
from ...exact.algebra.matrices import Matrix, beside, rank, stacked
from ...exact.algebra.stability import is_stable
from ...exact.structure.fault_columns import with_pair
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix, reachability_matrix
from ..evidence.corpus import Source, by_question
from ..evidence.subjects import kernel_once, space_once
from ..verdict.workbench import Workbench

S = TypeVar("S")


@dataclass(frozen=True)
class Facets:
    """A finite field has no unit circle: over one, every A counts as stable."""

    observable: bool
    controllable: bool
    left_invertible: bool
    stable: bool
    normal_rank: int
    lag: int


@lru_cache(maxsize=1 << 18)
def facets(system: ResidualSystem) -> Facets:
    """Return what the hypotheses ask of a system, found once."""
    kernel = kernel_once(system)
    return Facets(
        observable=rank(observability_matrix(system, system.n)) == system.n,
        controllable=rank(reachability_matrix(system)) == system.n,
        left_invertible=kernel.normal_rank == system.m,
        stable=isinstance(system.field, PrimeField) or is_stable(system.A),
        normal_rank=kernel.normal_rank,
        lag=kernel.lag,
    )


@lru_cache(maxsize=1 << 18)
def degenerate(system: ResidualSystem) -> str:
    """Why a counterexample made of this system says little: it fails for want of a state, an output or a fault that does something."""
    reasons = {
        "there is no state": system.n == 0,
        "there is no output": system.p == 0,
        "there is no fault": system.m == 0,
        "C = 0": system.C.is_zero(),
        "F = 0": system.F.is_zero(),
        "the columns of [F; G] are dependent": rank(stacked(system.F, system.G)) < system.m,
    }
    return ", ".join(reason for reason, so in reasons.items() if so)


def of_system(system: Callable[[S], ResidualSystem]) -> dict[str, Callable[[S], bool]]:
    """The hypotheses about one system, of subjects that have one: the names are those of `flags`."""
    return {
        "observable": lambda subject: facets(system(subject)).observable,
        "controllable": lambda subject: facets(system(subject)).controllable,
        "left-invertible": lambda subject: facets(system(subject)).left_invertible,
        "A stable": lambda subject: facets(system(subject)).stable,
    }


# An integer matrix is Schur stable iff it is nilpotent: its characteristic polynomial is monic with integer coefficients.
MODEL = {"observable": "observable", "controllable": "controllable", "left-invertible": "left_invertible", "A stable": "nilpotent(A)"}
POOR = "is_zero(C) or is_zero(F) or rank(vstack(F, G)) < m"


def expressions(kept: Collection[str], prefix: str = "") -> tuple[str, ...]:
    """Return the expressions of those of the hypotheses that are about one system: their names are the keys of MODEL after a prefix."""
    return tuple(text for name, text in MODEL.items() if prefix + name in kept)


HYPOTHESES = of_system(lambda system: system)
HIDDEN_ZEROS = (
    ResidualSystem.of([[0, 0], [0, 1]], [[0], [1]], [[0, 1]], [[1]]),
    ResidualSystem.of([[0, 0, 0], [0, 0, 0], [0, 1, 0]], [[0], [0], [1]], [[0, 0, 1]], [[0]]),
)
Table = list[list[str]]


def _sources(bench: Workbench) -> Iterator[Source]:
    for system in (*HIDDEN_ZEROS, *aimed_systems(400 if bench.full else 16)):
        yield "aimed", system, 1


AIMED = by_question("aimed systems", "certifying the aimed systems", _sources)


def aimed_systems(count: int) -> Iterator[ResidualSystem]:
    """Yield `count` systems over Q for each hypothesis; they lack it and no other."""
    for lacked in HYPOTHESES:
        random, found = Random(lacked), 0
        while found < count:
            system = _drawn(random, lacked)
            if [name for name, meets in HYPOTHESES.items() if not meets(system)] == [lacked]:
                found += 1
                yield system


def _drawn(random: Random, lacked: str) -> ResidualSystem:
    n, m = random.randint(1, 3), random.choice((1, 2, 2))
    p = random.randint(m, 3)
    A, F, C = (_entries(random, *shape) for shape in ((n, n), (n, m), (p, n)))
    G = _entries(random, p, m) if random.random() < 0.25 else [["0"] * m for _ in range(p)]
    if lacked != "A stable":
        A = [[f"{x}/4" for x in row] for row in A]
    if lacked == "controllable":
        A[-1][:-1], F[-1] = ["0"] * (n - 1), ["0"] * m
    if lacked == "observable":
        for row in (*A[:-1], *C):
            row[-1] = "0"
    system = ResidualSystem.of(A, F, C, G, n=n, m=m, p=p)
    return _with_a_column_more(random, system) if lacked == "left-invertible" else system


def other_columns(system: ResidualSystem) -> ResidualSystem:
    """Return the system (A, Fhat P, C, Ghat P) with a random P of m columns."""
    random, space = Random(str(system)), space_once(system)
    rows = [[random.choice((-2, -1, 0, 0, 1, 2)) for _ in range(system.m)] for _ in range(space.dimension)]
    return with_pair(space, Matrix.of(rows, shape=(space.dimension, system.m)))


def _with_a_column_more(random: Random, system: ResidualSystem) -> ResidualSystem:
    """The system with a member of Z as one more fault: the outputs are the same, and they do not determine the faults."""
    basis = space_once(system).basis
    weights = Matrix.of([[random.choice((-1, 0, 1, 2)) for _ in range(basis.nrows)]], shape=(1, basis.nrows))
    column = (weights @ basis).transposed()
    n, p = system.n, system.p
    return system.with_faults(beside(system.F, column.rows(range(n))), beside(system.G, column.rows(range(n, n + p))))


def _entries(random: Random, nrows: int, ncols: int) -> Table:
    return [[str(random.choice((-2, -1, 0, 1, 1, 2, 3))) for _ in range(ncols)] for _ in range(nrows)]
