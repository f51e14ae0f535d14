"""These are the systems of the ladder benchmark: integer A, F, C, G of every size, of the same numbers in every run.

    Family       a kind of system and a shape: "wide" (more outputs than needed, short lags) or "tight" (p = m + 1, long lags)
    Specimen     a system as plain nested lists, and what was planted in it
    dense        every entry random: windows of nearly full rank, no zeros
    planted      V*, the largest output-nulling subspace, has dimension n/2: n/2 zeros, every large window lacks n/2 of its columns
    invisible    the same, and one fault moves inside V* only: no output ever shows it, the normal rank is m - 1

A plant is hidden twice: by small feedback, A - F K and C - G K for K with entries -1, 0, 1, and by a unimodular similarity of n random
transvections. Neither changes the rank of a window. Standard library only.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass

Rows = list[list[int]]


@dataclass(frozen=True)
class Specimen:
    """This is a system with integer entries. Planted ones name V*: `subspace` (n x k) spans it, `feedback` K (m x n) keeps it.

    That is, (A + F K) V is in V and (C + G K) V = 0.
    """

    A: Rows
    F: Rows
    C: Rows
    G: Rows
    subspace: Rows | None = None
    feedback: Rows | None = None

    def to_json(self) -> dict[str, Rows]:
        """This is the dict of an exact file."""
        return {"A": self.A, "F": self.F, "C": self.C, "G": self.G}


@dataclass(frozen=True)
class Family:
    """`kind` names one of KINDS, `shape` one of "wide" and "tight"."""

    kind: str
    shape: str

    def __str__(self) -> str:
        return f"{self.kind} {self.shape}"

    def sizes(self, n: int) -> tuple[int, int]:
        """The pair is (p, m)."""
        if self.shape == "tight":
            return (4, 3) if n >= 20 else (3, 2)
        return (8, 3) if n >= 20 else (4, 2)

    def specimen(self, n: int) -> Specimen:
        """The system of this family with n states; the same on every call."""
        return KINDS[self.kind](random.Random(f"{self} {n}"), n, *self.sizes(n))


def dense(rng: random.Random, n: int, p: int, m: int) -> Specimen:
    """The entries are drawn from -3..3."""
    return Specimen(_entries(rng, n, n), _entries(rng, n, m), _entries(rng, p, n), _entries(rng, p, m))


def planted(rng: random.Random, n: int, p: int, m: int) -> Specimen:
    """The system has dim V* = n // 2 and normal rank m."""
    return _hidden(rng, n, p, m, invisible=0)


def invisible(rng: random.Random, n: int, p: int, m: int) -> Specimen:
    """The system has dim V* = n // 2 and normal rank m - 1."""
    return _hidden(rng, n, p, m, invisible=1)


KINDS: dict[str, Callable[[random.Random, int, int, int], Specimen]] = {"dense": dense, "planted": planted, "invisible": invisible}
FAMILIES = (
    Family("dense", "wide"),
    Family("dense", "tight"),
    Family("planted", "wide"),
    Family("planted", "tight"),
    Family("invisible", "wide"),
    Family("invisible", "tight"),
)


def product(left: Rows, right: Rows) -> Rows:
    """This is the matrix product."""
    columns = list(zip(*right, strict=True))
    return [[sum(a * b for a, b in zip(row, column, strict=True)) for column in columns] for row in left]


def combined(left: Rows, right: Rows, factor: int) -> Rows:
    """This is left + factor right."""
    return [[a + factor * b for a, b in zip(row, other, strict=True)] for row, other in zip(left, right, strict=True)]


def _hidden(rng: random.Random, n: int, p: int, m: int, *, invisible: int) -> Specimen:
    """The first n // 2 coordinates are output-nulling, the first faults act on them alone; then everything is mixed."""
    k = n // 2
    a, f, c, g = _entries(rng, n, n), _entries(rng, n, m), _entries(rng, p, n), _entries(rng, p, m)
    for row in [*a[k:], *c]:
        row[:k] = [0] * k
    for row in [*f[k:], *g]:
        row[:invisible] = [0] * invisible
    mixing, _ = _unimodular(rng, m)
    f, g = product(f, mixing), product(g, mixing)
    feedback = _entries(rng, m, n, largest=1)
    forward, backward = _unimodular(rng, n)
    return Specimen(
        A=product(product(forward, combined(a, product(f, feedback), -1)), backward),
        F=product(forward, f),
        C=product(combined(c, product(g, feedback), -1), backward),
        G=g,
        subspace=[row[:k] for row in forward],
        feedback=product(feedback, backward),
    )


def _entries(rng: random.Random, nrows: int, ncols: int, largest: int = 3) -> Rows:
    return [[rng.randint(-largest, largest) for _ in range(ncols)] for _ in range(nrows)]


def _unimodular(rng: random.Random, size: int) -> tuple[Rows, Rows]:
    """Return a product of `size` random transvections and its inverse."""
    forward = [[int(i == j) for j in range(size)] for i in range(size)]
    backward = [row[:] for row in forward]
    for _ in range(size):
        i, j = rng.sample(range(size), 2)
        sign = rng.choice((-1, 1))
        forward[i] = [a + sign * b for a, b in zip(forward[i], forward[j], strict=True)]
        for row in backward:
            row[j] -= sign * row[i]
    return forward, backward
