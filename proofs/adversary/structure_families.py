"""These are families of systems, and the quantities on whose zero sets ranks drop.

Tables             A, F, C, G by rows, floats or Fractions
free_family        every entry free
hidden_family      the first state is seen by no output
idle_family        the first state is reached by no fault
rank_deficient_family   two faults that are one
rank_one_family    G of rank one: zeros at infinity
pencil, feedthrough, product, seen, reached   square parts of P(z), G, CF, O_n, [F AF ...]
determinant        by expansion, the same for floats and Fractions
system_of          the exact system
cut                tables cut off a list of numbers
hadamard           a determinant in floats against the product of the lengths of its rows
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from ...exact.system.systems import ResidualSystem
from ..evidence.attacks import Family, Floats, Point

ENTRY = (-2.0, 2.0)

Rows = list[list[Any]]


@dataclass(frozen=True)
class Tables:
    """A system is given by four tables of numbers."""

    A: Rows
    F: Rows
    C: Rows
    G: Rows


Square = Callable[[Tables], Rows]


def system_of(tables: Tables) -> ResidualSystem:
    """Return the exact system of these tables."""
    n, m, p = len(tables.A), len(tables.F[0]), len(tables.C)
    parts = ([[str(Fraction(x)) for x in row] for row in part] for part in (tables.A, tables.F, tables.C, tables.G))
    return ResidualSystem.of(*parts, n=n, m=m, p=p)


def free_family(n: int, p: int, m: int, *, feedthrough: bool = True) -> Family:
    """Return a family in which every entry of A, F, C is free, and of G, unless it is zero."""
    count = n * n + n * m + p * n + (p * m if feedthrough else 0)

    def at(point: Sequence[Any]) -> Tables:
        A, F, C, rest = cut(point, (n, n), (n, m), (p, n))
        return Tables(A, F, C, cut(rest, (p, m))[0] if feedthrough else [[0] * m for _ in range(p)])

    return Family(f"n = {n}, p = {p}, m = {m}, every entry free{'' if feedthrough else ', G = 0'}", (ENTRY,) * count, at)


def hidden_family(n: int, p: int, m: int) -> Family:
    """Return a family in which the first state moves alone and no output sees it: (A, C) is not observable."""
    free = free_family(n, p, m)

    def at(point: Sequence[Any]) -> Tables:
        tables = free.at(point)
        A = [[0 * x if i and not j else x for j, x in enumerate(row)] for i, row in enumerate(tables.A)]
        return Tables(A, tables.F, [[0 * row[0], *row[1:]] for row in tables.C], tables.G)

    return Family(f"{free.words}, but that the first state is not seen", free.box, at)


def idle_family(n: int, p: int, m: int) -> Family:
    """Return a family in which the first state is reached by no fault: (A, F) is not controllable."""
    free = free_family(n, p, m)

    def at(point: Sequence[Any]) -> Tables:
        tables = free.at(point)
        A = [[0 * x if j and not i else x for j, x in enumerate(row)] for i, row in enumerate(tables.A)]
        return Tables(A, [[0 * x for x in tables.F[0]], *tables.F[1:]], tables.C, tables.G)

    return Family(f"{free.words}, but that the first state is not reached", free.box, at)


def rank_one_family(n: int, size: int) -> Family:
    """Return a family with p = m = size and G = g h': it has zeros at infinity."""
    count = n * n + 2 * n * size + 2 * size

    def at(point: Sequence[Any]) -> Tables:
        A, F, C, rest = cut(point, (n, n), (n, size), (size, n))
        g, h = rest[:size], rest[size:]
        return Tables(A, F, C, [[x * y for y in h] for x in g])

    return Family(f"n = {n}, p = m = {size}, G of rank one, the rest free", (ENTRY,) * count, at)


def rank_deficient_family() -> Family:
    """Return a family with n = p = m = 2, in which the second fault is a multiple of the first: the output cannot tell them apart."""
    single = free_family(2, 2, 1)

    def at(point: Sequence[Any]) -> Tables:
        tables, weight = single.at(point[:-1]), point[-1]
        return Tables(tables.A, [[x, weight * x] for (x,) in tables.F], tables.C, [[x, weight * x] for (x,) in tables.G])

    return Family("n = p = m = 2, the second fault a multiple of the first", (*single.box, ENTRY), at)


def pencil(z: int) -> Square:
    """Return what takes the first n + m rows of [[z I - A, -F], [C, G]]."""

    def build(t: Tables) -> Rows:
        upper = [[*(z * int(i == j) - x for j, x in enumerate(a)), *(-x for x in f)] for i, (a, f) in enumerate(zip(t.A, t.F, strict=True))]
        return [*upper, *([*c, *g] for c, g in zip(t.C, t.G, strict=True))][: len(t.A) + len(t.F[0])]

    return build


def feedthrough(t: Tables) -> Rows:
    """Return the first m rows of G."""
    return t.G[: len(t.F[0])]


def product(t: Tables) -> Rows:
    """Return the first m rows of CF."""
    return _product(t.C, t.F)[: len(t.F[0])]


def seen(t: Tables) -> Rows:
    """Return the first n rows of O_n."""
    block: Rows = t.C
    rows: Rows = []
    while len(rows) < len(t.A):
        rows += block
        block = _product(block, t.A)
    return rows[: len(t.A)]


def reached(t: Tables) -> Rows:
    """Return the first n columns of [F AF ...], as rows."""
    block: Rows = t.F
    rows: Rows = []
    while len(rows) < len(t.A):
        rows += [list(column) for column in zip(*block, strict=True)]
        block = _product(t.A, block)
    return rows[: len(t.A)]


def determinant(rows: Rows) -> Any:
    """This expands a determinant along the first row: small matrices, floats or Fractions."""
    if len(rows) == 1:
        return rows[0][0]
    total = 0
    for j, x in enumerate(rows[0]):
        if x != 0:
            total = total + (-1) ** j * x * determinant([[*row[:j], *row[j + 1 :]] for row in rows[1:]])
    return total


def hadamard(family: Family, square: Square) -> Callable[[Floats], float]:
    """Return a function of a point in floats: the determinant against Hadamard's bound, or against 1 for a single number."""

    def value(point: Floats) -> float:
        matrix = np.array(square(family.at(point)), dtype=np.float64)
        lengths = float(np.prod(np.linalg.norm(matrix, axis=1))) if len(matrix) > 1 else 1.0
        return float(np.linalg.det(matrix)) / lengths if lengths > 0 else 0.0

    return value


def exact_value(family: Family, square: Square) -> Callable[[Point], Fraction]:
    """Return the same function in exact arithmetic, without the bound."""
    return lambda point: Fraction(determinant(square(family.at(point))))


def _product(left: Rows, right: Rows) -> Rows:
    return [[sum(x * right[k][j] for k, x in enumerate(row)) for j in range(len(right[0]))] for row in left]


def cut(point: Sequence[Any], *shapes: tuple[int, int]) -> list[Any]:
    """Return tables of these shapes, cut off a list of numbers; what is left comes last."""
    values, found = list(point), []
    for rows, cols in shapes:
        found.append([values[i * cols : (i + 1) * cols] for i in range(rows)])
        values = values[rows * cols :]
    return [*found, values]
