"""All systems of larger dimensions over GF(2), one of each orbit under every change of basis, without a list of all systems.

    orbits_by_stages    A up to similarity, then F up to what leaves A as it is, then the rows [C G] up to what leaves both

Changes of basis of the outputs leave of [C G] its row space, one of a few thousand subspaces of K^(n+m). So 4 * 10^12 systems with n = 4,
p = 3, m = 2 come down to those subspaces under the stabilisers of some hundred pairs (A, F). The orbits are those of `exhaustive`, with
other representatives: the least number is not sought.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import combinations, product
from math import prod

import numpy as np
from numpy.typing import NDArray

from ...exact.algebra.fields import PrimeField
from ...exact.system.systems import ResidualSystem
from .exhaustive import Orbit, orbits

Bits = NDArray[np.int64]
Masks = NDArray[np.uint64]
LARGEST = 6  # the vectors of K^(n+m) are the bits of a 64-bit number


@dataclass(frozen=True)
class Pair:
    """A pair (A, F), the size of its class, and its stabiliser as it acts on rows [c g], by images of the unit vectors."""

    A: Bits
    F: Bits
    size: int
    stabiliser: Bits


def orbits_by_stages(n: int, p: int, m: int) -> Iterator[Orbit]:
    """Yield a system of every orbit over GF(2), with the number of systems it stands for. Raises ValueError for n + m above LARGEST."""
    if n + m > LARGEST:
        raise ValueError(f"n + m: got {n + m}, expected at most {LARGEST}")
    for pair in _pairs(n, m):
        yield from _orbits_over(pair, p)


def _orbits_over(pair: Pair, p: int) -> Iterator[Orbit]:
    """Yield the orbits with p outputs in which this pair (A, F) stands."""
    n, m = pair.F.shape
    spaces = _subspaces(n + m, min(p, n + m))
    open_still = np.ones(len(spaces.bases), dtype=np.bool_)
    for place, basis in enumerate(spaces.bases):
        if open_still[place]:
            images = np.unique(spaces.places(_images(basis, pair.stabiliser)))
            open_still[images] = False
            tables = prod(2**p - 2**i for i in range(len(basis)))  # of p rows with this row space
            rows = [[vector >> (n + m - 1 - j) & 1 for j in range(n + m)] for vector in basis]
            rows += [[0] * (n + m)] * (p - len(basis))
            C, G = [row[:n] for row in rows], [row[n:] for row in rows]
            system = ResidualSystem.of(pair.A.tolist(), pair.F.tolist(), C, G, field=PrimeField(2), n=n, m=m, p=p)
            yield Orbit(system, pair.size * len(images) * tables)


class _Subspaces:
    """The subspaces of K^length of dimension at most `largest`: bases in reduced row echelon form, vectors as numbers."""

    def __init__(self, length: int, largest: int) -> None:
        self.bases = [basis for k in range(largest + 1) for basis in _echelon(length, k)]
        masks = np.array([int(_masks(np.array([basis], dtype=np.int64).reshape(1, -1))[0]) for basis in self.bases], dtype=np.uint64)
        self._order = np.argsort(masks)
        self._sorted = masks[self._order]

    def places(self, masks: Masks) -> Bits:
        """Return the places in `bases` of subspaces by the bits of their vectors."""
        return np.asarray(self._order[np.searchsorted(self._sorted, masks)])


@cache
def _subspaces(length: int, largest: int) -> _Subspaces:
    return _Subspaces(length, largest)


def _echelon(length: int, k: int) -> Iterator[tuple[int, ...]]:
    for pivots in combinations(range(length), k):
        free = [(i, j) for i in range(k) for j in range(pivots[i] + 1, length) if j not in pivots]
        for chosen in product((0, 1), repeat=len(free)):
            rows = [1 << (length - 1 - pivot) for pivot in pivots]
            for (i, j), bit in zip(free, chosen, strict=True):
                rows[i] |= bit << (length - 1 - j)
            yield tuple(rows)


def _masks(bases: Bits) -> Masks:
    """Return, for each row of vectors, the number whose bits are the vectors that they span."""
    spanned = np.zeros((len(bases), 1), dtype=np.int64)
    for k in range(bases.shape[1]):
        spanned = np.concatenate([spanned, spanned ^ bases[:, k : k + 1]], axis=1)
    return np.asarray(np.bitwise_or.reduce(np.uint64(1) << spanned.astype(np.uint64), axis=1))


def _images(basis: tuple[int, ...], group: Bits) -> Masks:
    """Return the subspace after each element of a group, which is given by the images of the unit vectors, one element a row."""
    length = group.shape[1]
    moved = np.zeros((len(group), len(basis)), dtype=np.int64)
    for k, vector in enumerate(basis):
        for j in range(length):
            if vector >> (length - 1 - j) & 1:
                moved[:, k] ^= group[:, j]
    return _masks(moved)


@cache
def _pairs(n: int, m: int) -> list[Pair]:
    """Return one pair (A, F) of every class."""
    found = []
    states, faults = _general_linear(n), _general_linear(m)
    inverses = np.array([_inverse(T) for T in states], dtype=np.int64).reshape(len(states), n, n)
    places = 2 ** np.arange(n * m, dtype=np.int64)[::-1]
    for one in orbits(2, n, 0, 0):
        A = np.array(one.system.A.to_json(), dtype=np.int64).reshape(n, n)
        commute = ~((states @ A - A @ states) % 2).any(axis=(1, 2))
        T, back = states[commute], inverses[commute]
        seen: set[int] = set()
        for entries in product((0, 1), repeat=n * m):
            F = np.array(entries, dtype=np.int64).reshape(n, m)
            number = int(F.ravel() @ places)
            if number in seen:
                continue
            moved = ((T @ F % 2)[:, None] @ faults[None] % 2).reshape(len(T), len(faults), n * m) @ places
            images = np.unique(moved)
            seen.update(images.tolist())
            at, by = np.nonzero(moved == number)
            stabiliser = np.concatenate([_numbers(back[at], 0, n + m), _numbers(faults[by], n, n + m)], axis=1)
            found.append(Pair(A, F, one.size * len(images), stabiliser))
    return found


def _numbers(matrices: Bits, start: int, length: int) -> Bits:
    """Return the rows of many matrices as numbers, their columns standing from `start` on among `length`."""
    width = matrices.shape[2]
    return np.asarray(matrices @ (2 ** (length - 1 - start - np.arange(width, dtype=np.int64))))


@cache
def _general_linear(size: int) -> Bits:
    """Return all invertible matrices of a size, built row by row from vectors outside the span of those before."""
    found: list[tuple[tuple[int, ...], frozenset[int]]] = [((), frozenset({0}))]
    for _ in range(size):
        found = [((*rows, v), span | {v ^ w for w in span}) for rows, span in found for v in range(2**size) if v not in span]
    table = np.array([rows for rows, _ in found], dtype=np.int64).reshape(len(found), size)
    return np.asarray(table[:, :, None] >> np.arange(size, dtype=np.int64)[::-1] & 1)


def _inverse(matrix: Bits) -> Bits:
    """Return the inverse over GF(2) of an invertible matrix: by Gauss and Jordan beside the unit matrix."""
    size = len(matrix)
    work = np.concatenate([matrix % 2, np.eye(size, dtype=np.int64)], axis=1)
    for k in range(size):
        pivot = k + int(np.argmax(work[k:, k]))
        work[[k, pivot]] = work[[pivot, k]]
        others = work[:, k].copy()
        others[k] = 0
        work ^= others[:, None] * work[k]
    return work[:, size:]
