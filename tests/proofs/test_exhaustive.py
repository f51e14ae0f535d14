"""Orbits over small prime fields: every system in exactly one, invariants constant on each, counts by Burnside's lemma."""

from __future__ import annotations

from collections import Counter
from itertools import product

import pytest

from faultspace.exact.structure.record import analyze
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.evidence.exhaustive import all_systems, orbits

Table = list[list[int]]


def invertible(q: int, size: int) -> list[tuple[Table, Table]]:
    """Return GL_size(q) with inverses, by trying every pair of matrices."""
    tables = [[list(e[i * size : (i + 1) * size]) for i in range(size)] for e in product(range(q), repeat=size * size)]
    one = [[int(i == j) for j in range(size)] for i in range(size)]
    return [(a, b) for a in tables for b in tables if times(a, b, q, size) == one]


def times(a: Table, b: Table, q: int, cols: int) -> Table:
    return [[sum(x * row[j] for x, row in zip(line, b, strict=True)) % q for j in range(cols)] for line in a]


def naive_orbits(q: int, n: int, p: int, m: int) -> Counter[int]:
    """Sizes of the orbits, by applying the whole group to one system after the other."""
    groups = [invertible(q, size) for size in (n, p, m)]
    left = {tuple(map(str, (s.A, s.F, s.C, s.G))): s for s in all_systems(q, n, p, m)}
    sizes: Counter[int] = Counter()
    while left:
        _, system = next(iter(left.items()))
        A, F, C, G = ([[int(x) for x in row] for row in part.elements()] for part in (system.A, system.F, system.C, system.G))
        orbit = set()
        for (T, S), (U, _), (V, _) in product(*groups):
            moved = (
                times(times(T, A, q, n), S, q, n),
                times(times(T, F, q, m), V, q, m),
                times(times(U, C, q, n), S, q, n),
                times(times(U, G, q, m), V, q, m),
            )
            orbit.add(tuple(str(part).replace("'", "") for part in moved))
        for key in orbit:
            del left[key]
        sizes[len(orbit)] += 1
    return sizes


@pytest.mark.parametrize("q, n, p, m", [(2, 1, 1, 1), (2, 1, 2, 1), (2, 2, 1, 1), (3, 1, 1, 1), (3, 1, 2, 1), (2, 1, 2, 2)])
def test_orbits_are_those_of_the_group(q: int, n: int, p: int, m: int) -> None:
    found = orbits(q, n, p, m)
    assert sum(orbit.size for orbit in found) == q ** ((n + p) * (n + m))
    assert Counter(orbit.size for orbit in found) == naive_orbits(q, n, p, m)


@pytest.mark.parametrize("q, n, p, m", [(2, 0, 1, 1), (2, 1, 0, 1), (2, 1, 1, 0), (3, 0, 0, 0)])
def test_zero_dimensions(q: int, n: int, p: int, m: int) -> None:
    assert sum(orbit.size for orbit in orbits(q, n, p, m)) == q ** ((n + p) * (n + m))


def invariants(system: ResidualSystem) -> tuple[object, ...]:
    report = analyze(system).to_json()
    return tuple(str(report[key]) for key in report if key not in ("fault_space", "field"))


def test_invariants_of_all_systems_are_those_of_their_orbits() -> None:
    every = Counter(invariants(system) for system in all_systems(2, 1, 2, 1))
    weighted: Counter[tuple[object, ...]] = Counter()
    for orbit in orbits(2, 1, 2, 1):
        weighted[invariants(orbit.system)] += orbit.size
    assert every == weighted
