"""All systems of given dimensions over a small prime field, one of each orbit under changes of basis.

    Orbit            a representative, and how many systems it stands for
    orbits           of GL_n x GL_p x GL_m acting by (T A T^-1, T F V, U C T^-1, U G V)
    all_systems      every system, unreduced

Every statement that is checked on orbits (ranks, indices, zeros, delays, dimensions) is invariant under these changes of basis. A
system is the number whose base-q digits are its entries; generators of the groups permute these numbers, and orbits are connected
components.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...exact.algebra.fields import PrimeField
from ...exact.system.systems import ResidualSystem

Digits = NDArray[np.int64]


@dataclass(frozen=True)
class Orbit:
    """A system of least number in its orbit, and the size of the orbit."""

    system: ResidualSystem
    size: int


def all_systems(q: int, n: int, p: int, m: int) -> Iterator[ResidualSystem]:
    """Yield all q^((n+p)(n+m)) systems over GF(q), one after the other."""
    digits = _all_digits(q, (n + p) * (n + m))
    for row in digits:
        yield _system(row, q, n, p, m)


@lru_cache(maxsize=64)  # several kinds of material are about the same small boxes
def orbits(q: int, n: int, p: int, m: int) -> tuple[Orbit, ...]:
    """One system of every orbit over GF(q), with the number of systems it stands for."""
    from scipy.sparse import coo_matrix  # here, where it is needed: the processes that check do without scipy
    from scipy.sparse.csgraph import connected_components

    digits = _all_digits(q, (n + p) * (n + m))
    count = len(digits)
    numbers = np.arange(count)
    sources, targets = [numbers], [numbers]
    for moved in _moves(digits, q, n, p, m):
        sources.append(numbers)
        targets.append(_numbers(moved, q))
    rows, cols = np.concatenate(sources), np.concatenate(targets)
    graph = coo_matrix((np.ones(len(rows), dtype=np.int8), (rows, cols)), shape=(count, count))
    _, labels = connected_components(graph, directed=False)
    _, first, sizes = np.unique(labels, return_index=True, return_counts=True)
    return tuple(Orbit(_system(digits[i], q, n, p, m), int(size)) for i, size in sorted(zip(first, sizes, strict=True)))


def _all_digits(q: int, length: int) -> Digits:
    numbers = np.arange(q**length, dtype=np.int64)
    return np.stack([numbers // q**k % q for k in reversed(range(length))], axis=1) if length else np.zeros((1, 0), dtype=np.int64)


def _numbers(digits: Digits, q: int) -> Digits:
    value = np.zeros(len(digits), dtype=np.int64)
    for k in range(digits.shape[1]):
        value = value * q + digits[:, k]
    return value


def _moves(digits: Digits, q: int, n: int, p: int, m: int) -> Iterator[Digits]:
    """The digits of every system after each generator: elementary matrices and scalings on states, outputs and faults."""
    # one (n + p) x (n + m) table [[A, F], [C, G]] a system: states act on rows and columns, outputs on rows, faults on columns
    tables = digits.reshape(len(digits), n + p, n + m)
    for generator, inverse in _generators(n, q):
        yield _act(tables, _embedded(generator, p), _embedded(inverse, m), q)
    for generator, _ in _generators(p, q):
        yield _act(tables, _embedded(generator, n, after=True), np.eye(n + m, dtype=np.int64), q)
    for generator, _ in _generators(m, q):
        yield _act(tables, np.eye(n + p, dtype=np.int64), _embedded(generator, n, after=True), q)


def _act(tables: Digits, left: Digits, right: Digits, q: int) -> Digits:
    return np.asarray((left @ tables @ right) % q).reshape(len(tables), -1)


def _embedded(matrix: Digits, rest: int, *, after: bool = False) -> Digits:
    size = len(matrix)
    whole = np.eye(size + rest, dtype=np.int64)
    if after:
        whole[rest:, rest:] = matrix
    else:
        whole[:size, :size] = matrix
    return whole


def _generators(size: int, q: int) -> Iterator[tuple[Digits, Digits]]:
    """Yield generators of GL_size(q) and their inverses: all elementary additions, and a diagonal entry running over a generating set."""
    for i in range(size):
        for j in range(size):
            if i != j:
                add, subtract = np.eye(size, dtype=np.int64), np.eye(size, dtype=np.int64)
                add[i, j], subtract[i, j] = 1, q - 1
                yield add, subtract
    for unit in range(2, q) if size else ():
        scale, back = np.eye(size, dtype=np.int64), np.eye(size, dtype=np.int64)
        scale[0, 0], back[0, 0] = unit, pow(unit, -1, q)
        yield scale, back


def _system(row: Digits, q: int, n: int, p: int, m: int) -> ResidualSystem:
    table = [[int(x) for x in line] for line in row.reshape(n + p, n + m)]
    A, F = [line[:n] for line in table[:n]], [line[n:] for line in table[:n]]
    C, G = [line[:n] for line in table[n:]], [line[n:] for line in table[n:]]
    return ResidualSystem.of(A, F, C, G, field=PrimeField(q), n=n, m=m, p=p)
