"""These systems lack one hypothesis about a system and have all the others: those of the corpus lack some of them only now and then.

    aimed_systems     as many for each of the four hypotheses: observable, controllable, left-invertible, A stable
    other_columns     one of them with other fault columns of its Z
    AIMED             the same with accepted certificates, by question, and HIDDEN_ZEROS, made once a run
    HIDDEN_ZEROS      two systems all of whose finite zeros are unobservable modes, the zeros being more than the modes

Most are without feedthrough and with more outputs than faults, so that they have zeros, at infinity and rarely finite ones: that is where
the claims about zeros and about the bad P have something to say.
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from ...exact.algebra.matrices import Matrix, beside
from ...exact.structure.fault_columns import with_pair
from ...exact.system.systems import ResidualSystem
from ..evidence.corpus import Source, by_question
from ..evidence.kept_kernels import space_once
from ..verdict.workbench import Workbench
from .facets import of_system


def _itself(system: ResidualSystem) -> ResidualSystem:
    return system


HYPOTHESES = of_system(_itself)
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
