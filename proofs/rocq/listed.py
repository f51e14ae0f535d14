"""Systems as the theory of the checks lists them: integers over one common denominator, signals as rows.

    Listed        a system over Q: its term, its words modulo a prime, the conditions of its kernel rows, the hints that Rocq asks of them
    NotCovered    raised where the checks in Rocq do not speak of a kind or a field
    independent   rows reduced modulo a prime: pivots, and the combinations that lead there
    unit, times, added   a row of the identity, a row times a matrix, a sum modulo a prime
    Integers      a list of rows of integers

What is computed here is believed by nobody: Rocq sees whether it serves.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Any

from flint import nmod_mat

from ..trust import checker
from .terms import natural, naturals, sequence, table, vector, whole

Json = Any
Integers = list[list[int]]


class NotCovered(Exception):
    """Raised where the checks in Rocq do not speak of this kind or this field."""


class Listed:
    """A SYSTEM over Q is listed with matrices transposed and multiplied by their common denominator."""

    def __init__(self, data: Json) -> None:
        system = checker.SUBJECTS["system"](data)
        if system.field.key != "Q":
            raise NotCovered("the checks in Rocq are over the rational numbers only")
        self.sizes = self.n, self.m, self.p = system.n, system.m, system.p
        blocks = (system.A, system.F, system.C, system.G)
        self.den = checker.common_denominator(block.den for block in blocks)
        self.A, self.F, self.C, self.G = (
            [[row[j] * (self.den // block.den) for row in block.rows] for j in range(block.nc)] for block in blocks
        )

    def bounded(self, samples: int) -> None:
        """Charges for simulating all states and faults on so many samples, and for eliminating in the windows that they make."""
        height, width = self.n + self.m * samples, self.p * samples
        checker.charge((self.n + self.m) * samples * (self.n + self.p + 1) * (self.n + self.m + 1) * 60)
        checker.charge(height * (width + height) * (100 + 2 * min(height, width)), 100 * height * (width + height))

    @cached_property
    def term(self) -> str:
        """As a term of type listed."""
        return f"Listed {whole(self.den)} {' '.join(map(table, (self.A, self.F, self.C, self.G)))}"

    def named(self, name: str) -> str:
        """Return the system in the theory that the list of that name means."""
        return f"(meant {natural(self.n)} {natural(self.m)} {natural(self.p)} {name})"

    def response(self, state: list[int], fault: list[int], samples: int, prime: int) -> list[int]:
        """Return the outputs modulo the prime, one after the other, of a state and a fault at time 0."""
        found = list[int]()
        for _ in range(samples):
            found += added(times(state, self.C, self.p), times(fault, self.G, self.p), prime)
            state, fault = added(times(state, self.A, self.n), times(fault, self.F, self.n), prime), [0] * self.m
        return found

    def trajectory(self, state: list[int], faults: Integers, prime: int) -> tuple[Integers, Integers, Integers]:
        """Return states, faults and outputs of the integer system modulo the prime, fault k times the k-th power of the denominator."""
        states, weighted, outputs = [state], Integers(), Integers()
        for k, fault in enumerate(faults):
            weighted.append([self.den**k * x for x in fault])
            outputs.append(added(times(states[-1], self.C, self.p), times(weighted[-1], self.G, self.p), prime))
            states.append(added(times(states[-1], self.A, self.n), times(weighted[-1], self.F, self.n), prime))
        return states, weighted, outputs

    def words(self, samples: int, prime: int) -> str:
        """Return a basis of the words modulo the prime, reduced: initial state, faults, sample and output of the leading one."""
        n, m, p = self.n, self.m, self.p
        self.bounded(samples)
        rows = [self.response(unit(n, i), [0] * m, samples, prime) for i in range(n)]
        for i in range(m):
            from_rest = self.response([0] * n, unit(m, i), samples, prime)
            rows += [[0] * (p * j) + from_rest[: p * (samples - j)] for j in range(samples)]
        found = []
        for pivot, u in independent(rows, samples * p, prime):
            faults = [[u[n + i * samples + j] for i in range(m)] for j in range(samples)]
            found.append(f"(({vector(u[:n])}, {table(faults)}), ({pivot // p}%N, {pivot % p}%N))")
        return sequence(found)

    def demands(self, row: Integers, prime: int = 0) -> Integers:
        """Return the condition rows [X_(k+1), c_k] of a kernel row, times powers of the denominator; modulo a prime where there is one."""
        state, found, weight = [0] * self.n, Integers(), 1
        for c in reversed(row):
            scaled = _reduced([weight * x for x in c], prime)
            found.append(state + scaled)
            state = [sum(a * x for a, x in zip(rc + ra, scaled + state, strict=True)) for rc, ra in zip(self.C, self.A, strict=True)]
            state, weight = _reduced(state, prime), weight * self.den
        return found[::-1]

    def minor(self, point: int | None, prime: int) -> tuple[list[int], list[int], int]:
        """Return rows, columns and value modulo the prime of a largest minor that is not zero, of the pencil at a point, times the
        denominator, as the theory has the pencil, [q - A, C; - F, G]; or of G, where the point is infinity, None.
        """
        n, m, p = self.sizes
        height, width = (m, p) if point is None else (n + m, n + p)
        checker.charge(height * width * (100 + 4 * min(height, width)), 100 * height * width)
        if point is None:
            table = [[x % prime for x in row] for row in self.G]
        else:
            above = [[self.den * point * (i == j) - x for j, x in enumerate(row)] + self.C[i] for i, row in enumerate(self.A)]
            table = [[x % prime for x in row] for row in above + [[-x for x in f] + g for f, g in zip(self.F, self.G, strict=True)]]
        columns = _pivots(table, width, prime)
        rows = _pivots([[row[j] for row in table] for j in columns], height, prime)
        return rows, columns, determinant([[table[i][j] for j in columns] for i in rows], prime)

    def pencil_minor(self, given: Json, prime: int) -> tuple[str, str]:
        """Return the point of a witness, or none for infinity, and that minor there, as terms in the scope of integers."""
        point = None if given == "infinity" else checker.index(given, "point", prime - 1)
        rows, columns, value = self.minor(point, prime)
        return "None" if point is None else f"(Some {whole(point)})", f"{naturals(rows)} {naturals(columns)} {whole(value)}"

    def hints(self, rows: Sequence[tuple[int, Integers]], given: Json, prime: int) -> str:
        """Return hints that prove kernel rows minimal where they are, as a term: a minor of the pencil at a point, that of the leading
        coefficients at the pivots, and as many columns as the rows have states, with their minor there, 0 where there are too few.
        """
        width, terms = self.n + self.p, sum(len(row) for _, row in rows)
        point, minor = self.pencil_minor(given, prime)
        checker.charge(terms * (width * (300 + 100 * (self.n + len(rows))) + self.n * (100 + 4 * min(self.n, terms))), 100 * terms * width)
        states = [demand[: self.n] for _, row in rows for demand in self.demands(row, prime)[:-1]]
        columns = _pivots(states, self.n, prime)
        of_states = determinant([[x[j] for j in columns] for x in states], prime) if len(columns) == len(states) else 0
        leading = determinant([[row[-1][pivot] % prime for pivot, _ in rows] for _, row in rows], prime)
        return f"Hints {point} {minor} {whole(leading)} {naturals(columns)} {whole(of_states)}"


def determinant(table: Integers, prime: int) -> int:
    """Return the determinant of a square table of residues modulo the prime."""
    size = len(table)
    checker.charge(size**2 * (100 + 4 * size), 100 * size**2)
    return int(nmod_mat(size, size, [x for row in table for x in row], prime).det()) if size else 1


def independent(rows: Integers, width: int, prime: int) -> list[tuple[int, list[int]]]:
    """Reduce rows modulo a prime, in their first `width` columns; returns pivots, and the combinations that lead there."""
    if not rows or not width:
        return []
    height = len(rows)
    augmented = nmod_mat(height, width + height, [x % prime for i, row in enumerate(rows) for x in row + unit(height, i)], prime)
    form, _ = augmented.rref()
    found = []
    for i in range(height):
        line = [int(form[i, j]) for j in range(width + height)]
        pivot = next((j for j in range(width) if line[j]), None)
        if pivot is not None:
            found.append((pivot, line[width:]))
    return found


def _reduced(u: list[int], prime: int) -> list[int]:
    return [x % prime for x in u] if prime else u


def _pivots(rows: Integers, width: int, prime: int) -> list[int]:
    """Return the pivots of rows of residues."""
    return [pivot for pivot, _ in checker.echelon(rows, prime)] if width else []


def unit(size: int, i: int) -> list[int]:
    """Return a row of the identity."""
    return [int(i == j) for j in range(size)]


def times(x: list[int], M: Integers, width: int) -> list[int]:
    """Return a row times a matrix."""
    return [sum(a * row[j] for a, row in zip(x, M, strict=True)) for j in range(width)]


def added(u: Iterable[int], v: Iterable[int], prime: int) -> list[int]:
    """Return the sum modulo the prime."""
    return [(a + b) % prime for a, b in zip(u, v, strict=True)]
