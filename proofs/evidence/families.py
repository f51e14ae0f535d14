"""These are systems to try a claim on: the paper's own, adversarial families with a name, and random ones of every structure.

    paper_example         the example of [G25] section V over its cubic number field
    shift_registers       length n, F = 0 against F = e_n: equal on n samples, different on n + 1
    adversarial           named families of small systems, each made to break something
    random_systems        of every structure: planted output-nulling parts, unobservable, uncontrollable, not left-invertible,
                          sparse, zero dimensions

Everything is generated from a seed; the same seed gives the same systems.
"""

from __future__ import annotations

import random
from collections.abc import Iterator

from ...exact.algebra.fields import QQ, Field, NumberField
from ...exact.algebra.matrices import Matrix
from ...exact.system.systems import FaultySystem, ResidualSystem, read_system


def paper_example() -> FaultySystem:
    """Return the example of the paper as published: A, B, C, D, G rational, F an eigenvector (1, a, a^2) of A, 4a^3 - a^2 - 3a + 1 = 0."""
    system = read_system(
        {
            "field": {"minimal_polynomial": ["1", "-3", "-1", "4"]},
            "A": [["0", "1", "0"], ["0", "0", "1"], ["-1/4", "3/4", "1/4"]],
            "B": [["0"], ["0"], ["1"]],
            "F": [["1"], [["0", "1", "0"]], [["0", "0", "1"]]],
            "C": [["1", "0", "0"], ["0", "1", "0"]],
            "D": [["0"], ["0"]],
            "G": [["0"], ["0"]],
        }
    )
    if not isinstance(system, FaultySystem):
        raise TypeError("the example has inputs")
    return system


def shift_registers(n: int) -> tuple[ResidualSystem, ResidualSystem]:
    """Two systems with n states, p = 2, m = 1 and the same A, C, G whose behaviours agree on n samples and not on n + 1."""
    A = [[int(j == i + 1) for j in range(n)] for i in range(n)]
    C = [[int(j == 0) for j in range(n)], [0] * n]
    G = [[0], [1]]
    idle = ResidualSystem.of(A, [[0]] * n, C, G)
    return idle, ResidualSystem.of(A, [[int(i == n - 1)] for i in range(n)], C, G)


def adversarial() -> Iterator[tuple[str, ResidualSystem]]:
    """(name, system): each family is named after what it is made to break."""
    for n in range(1, 7):
        for which, system in zip(("idle", "driven"), shift_registers(n), strict=True):
            yield f"shift register, {which}, n={n}", system
    for n in range(1, 5):
        nilpotent = [[int(j == i + 1) for j in range(n)] for i in range(n)]
        last = [[int(i == n - 1)] for i in range(n)]
        first = [[int(j == 0) for j in range(n)]]
        yield f"integrator chain, relative degree {n}", ResidualSystem.of(nilpotent, last, first, [[0]])
        yield f"integrator chain with idle output, n={n}", ResidualSystem.of(nilpotent, last, [*first, [0] * n], [[0], [0]])
        yield f"unobservable but driven, n={n}", ResidualSystem.of(nilpotent, last, [[0] * n], [[1]])
        yield (
            f"uncontrollable modes, n={n}",
            ResidualSystem.of([[(i + 1) * int(i == j) for j in range(n)] for i in range(n)], [[0]] * n, [[1] * n, [0] * n], [[0], [1]]),
        )
        yield (
            f"repeated fault columns, n={n}",
            ResidualSystem.of(nilpotent, [[x[0], x[0]] for x in last], [*first, [1] * n], [[0, 0], [1, 1]]),
        )
    yield "static gain, all zeros of the transfer function cancel", ResidualSystem.of([[0]], [[0]], [[1]], [[1]])
    yield "delay, one infinite zero", ResidualSystem.of([[0]], [[1]], [[1]], [[0]])
    yield "gap two at n - 1", ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [1]])
    yield "a zero of the fault at an unobservable mode", ResidualSystem.of([[0, 0], [0, 1]], [[0], [1]], [[0, 1]], [[1]])
    yield (
        "two finite zeros, one unobservable mode of the same value",
        ResidualSystem.of([[0, 0, 0], [0, 0, 0], [0, 1, 0]], [[0], [0], [1]], [[0, 0, 1]], [[0]]),
    )
    yield "wrong columns at s = n", ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]])
    yield "full column rank is not enough", ResidualSystem.of([[0]], [[1, 0]], [[1], [0]], [[0, 0], [0, 1]])
    yield "unobservable, bad P with one fault", ResidualSystem.of([[1]], [[1]], [[0]], [[1]])
    yield "all zero, W differs from V*+S*", ResidualSystem.of([[0]], [[0]], [[0]], [[0]])
    yield "square and invertible at once", ResidualSystem.of([[1, 2], [3, 4]], [[1, 0], [0, 1]], [[1, 1], [0, 1]], [[1, 0], [0, 1]])
    yield "more faults than outputs", ResidualSystem.of([[0, 1], [1, 0]], [[1, 0, 2], [0, 1, 1]], [[1, 1]], [[1, 0, 0]])
    yield "two faults, one output", ResidualSystem.of([[0]], [[1, 1]], [[1]], [[0, 1]])
    yield "no faults", ResidualSystem.of([[0, 1], [-1, 0]], [], [[1, 0]], [], n=2, m=0, p=1)
    yield "no outputs", ResidualSystem.of([[0, 1], [-1, 0]], [[1], [0]], [], [], n=2, m=1, p=0)
    yield "no states", ResidualSystem.of([], [], [], [[1, 0], [2, 0]], n=0, m=2, p=2)
    yield "nothing at all", ResidualSystem.of([], [], [], [], n=0, m=0, p=0)
    yield (
        "non-minimum phase and infinite zero",
        ResidualSystem.of([[0, 1, 0], [0, 0, 1], ["1/2", 0, "1/3"]], [[0], [0], [1]], [[-2, 1, 0]], [[0]]),
    )


def random_systems(field: Field, count: int, seed: int, largest: int = 4) -> Iterator[ResidualSystem]:
    """Yield `count` systems with n <= largest, p <= 3, m <= 3 over a field, structures drawn in turn."""
    rng = random.Random(f"{field} {seed}")
    makers = (_sparse, _planted, _unobservable, _uncontrollable, _dependent_faults, _feedback_scrambled)
    for i in range(count):
        n, p, m = rng.choice([0, *range(1, largest + 1), largest]), rng.choice([0, 1, 2, 2, 3, 3]), rng.choice([0, 1, 1, 2, 2, 3])
        yield makers[i % len(makers)](rng, field, n, p, m)


Table = list[list[object]]


def _entries(rng: random.Random, field: Field, rows: int, cols: int, density: float) -> Table:
    def one() -> object:
        if rng.random() > density:
            return 0
        if isinstance(field, NumberField) and rng.random() < 0.4:
            return [rng.choice([0, 0, 1, -1, "1/2"]) for _ in range(field.degree)]
        if field == QQ and rng.random() < 0.2:
            return f"{rng.choice([-3, -1, 1, 2, 5])}/{rng.choice([2, 3])}"
        return rng.choice([1, 1, -1, 2, -2, 3])

    return [[one() for _ in range(cols)] for _ in range(rows)]


def _of(field: Field, A: Table, F: Table, C: Table, G: Table, n: int, p: int, m: int) -> ResidualSystem:
    return ResidualSystem.of(A, F, C, G, field=field, n=n, m=m, p=p)


def _sparse(rng: random.Random, field: Field, n: int, p: int, m: int) -> ResidualSystem:
    density = rng.choice([0.3, 0.6, 1.0])
    A, F = _entries(rng, field, n, n, density), _entries(rng, field, n, m, density)
    return _of(field, A, F, _entries(rng, field, p, n, density), _entries(rng, field, p, m, density / 2), n, p, m)


def _planted(rng: random.Random, field: Field, n: int, p: int, m: int) -> ResidualSystem:
    """The first half of the states never reaches the output directly, and G is mostly zero: zeros at infinity and finite ones."""
    C = _entries(rng, field, p, n, 0.8)
    for row in C:
        row[: n // 2] = [0] * (n // 2)
    return _of(field, _entries(rng, field, n, n, 0.6), _entries(rng, field, n, m, 0.6), C, _entries(rng, field, p, m, 0.15), n, p, m)


def _unobservable(rng: random.Random, field: Field, n: int, p: int, m: int) -> ResidualSystem:
    hidden = n // 2
    A, C = _entries(rng, field, n, n, 0.7), _entries(rng, field, p, n, 0.8)
    for i in range(hidden, n):
        A[i][:hidden] = [0] * hidden
    for row in C:
        row[:hidden] = [0] * hidden
    return _of(field, A, _entries(rng, field, n, m, 0.7), C, _entries(rng, field, p, m, 0.4), n, p, m)


def _uncontrollable(rng: random.Random, field: Field, n: int, p: int, m: int) -> ResidualSystem:
    free = n // 2
    A, F = _entries(rng, field, n, n, 0.7), _entries(rng, field, n, m, 0.8)
    for i in range(free):
        A[i][free:] = [0] * (n - free)
        F[i] = [0] * m
    return _of(field, A, F, _entries(rng, field, p, n, 0.8), _entries(rng, field, p, m, 0.4), n, p, m)


def _dependent_faults(rng: random.Random, field: Field, n: int, p: int, m: int) -> ResidualSystem:
    F, G = _entries(rng, field, n, m, 0.7), _entries(rng, field, p, m, 0.5)
    if m > 1:
        for row in F + G:
            row[-1] = row[0]
    return _of(field, _entries(rng, field, n, n, 0.6), F, _entries(rng, field, p, n, 0.6), G, n, p, m)


def _feedback_scrambled(rng: random.Random, field: Field, n: int, p: int, m: int) -> ResidualSystem:
    """Return a nilpotent chain behind a feedback and an output injection: many zeros, long lags."""
    base = _of(
        field,
        [[int(j == i + 1) for j in range(n)] for i in range(n)],
        [[int(i == n - 1 - j) for j in range(m)] for i in range(n)],
        [[int(j == i) for j in range(n)] for i in range(p)],
        [[0] * m for _ in range(p)],
        n,
        p,
        m,
    )
    K = Matrix.of(_entries(rng, field, m, n, 0.5), field, shape=(m, n))
    return ResidualSystem(base.A + base.F @ K, base.F, base.C + base.G @ K, base.G)
