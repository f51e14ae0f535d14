"""Systems as the theory of the checks lists them: integers over one common denominator, signals as rows.

    Listed        a system over Q: its term, its words modulo a prime, the conditions of its kernel rows
    NotCovered    raised where the checks in Rocq do not speak of a kind or a field
    independent   rows reduced modulo a prime: pivots, and the combinations that lead there
    triangular    kernel rows combined until their leading coefficients are triangular by their pivots
    unit, times, added   a row of the identity, a row times a matrix, a sum modulo a prime
    Integers      a list of rows of integers

What is computed here is believed by nobody: Rocq sees whether it serves.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from math import gcd
from typing import Any

from flint import nmod_mat

from ..trust import checker
from .text import natural, sequence, table, vector, whole

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
        """Returns the system in the theory that the list of that name means."""
        return f"(meant {natural(self.n)} {natural(self.m)} {natural(self.p)} {name})"

    def response(self, state: list[int], fault: list[int], samples: int, prime: int) -> list[int]:
        """Returns the outputs modulo the prime, one after the other, of a state and a fault at time 0."""
        found = list[int]()
        for _ in range(samples):
            found += added(times(state, self.C, self.p), times(fault, self.G, self.p), prime)
            state, fault = added(times(state, self.A, self.n), times(fault, self.F, self.n), prime), [0] * self.m
        return found

    def trajectory(self, state: list[int], faults: Integers, prime: int) -> tuple[Integers, Integers, Integers]:
        """Returns states, faults and outputs of the integer system modulo the prime, fault k times the k-th power of the denominator."""
        states, weighted, outputs = [state], Integers(), Integers()
        for k, fault in enumerate(faults):
            weighted.append([self.den**k * x for x in fault])
            outputs.append(added(times(states[-1], self.C, self.p), times(weighted[-1], self.G, self.p), prime))
            states.append(added(times(states[-1], self.A, self.n), times(weighted[-1], self.F, self.n), prime))
        return states, weighted, outputs

    def words(self, samples: int, prime: int) -> str:
        """Returns a basis of the words modulo the prime, reduced: initial state, faults, sample and output of the leading one."""
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

    def demands(self, row: Integers) -> Integers:
        """Returns the condition rows [X_(k+1), c_k] of a kernel row, times powers of the denominator."""
        state, found, weight = [0] * self.n, Integers(), 1
        for c in reversed(row):
            scaled = [weight * x for x in c]
            found.append(state + scaled)
            state = [sum(a * x for a, x in zip(rc + ra, scaled + state, strict=True)) for rc, ra in zip(self.C, self.A, strict=True)]
            weight *= self.den
        return found[::-1]


def independent(rows: Integers, width: int, prime: int) -> list[tuple[int, list[int]]]:
    """Reduces rows modulo a prime, in their first `width` columns; returns pivots, and the combinations that lead there."""
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


def triangular(rows: Iterable[tuple[int, Integers]]) -> list[tuple[int, Integers]]:
    """Returns rows with the same combinations and degrees, ascending: from each the earlier ones are taken, times powers of q."""
    found = list[tuple[int, Integers]]()
    for pivot, row in rows:
        given = row
        for place, earlier in found:
            bits = sum(abs(x).bit_length() for part in (*row, *earlier) for x in part)
            checker.charge(1000 + 200 * sum(map(len, row)) + bits * max(map(int.bit_length, (row[-1][place], earlier[-1][place]))) // 500)
            if (c := row[-1][place]) and len(earlier) <= len(row):
                shifted = [[0] * len(row[-1])] * (len(row) - len(earlier)) + earlier
                row = [[x * earlier[-1][place] - c * y for x, y in zip(a, b, strict=True)] for a, b in zip(row, shifted, strict=True)]
                content = gcd(*(x for part in row for x in part)) or 1
                row = [[x // content for x in part] for part in row]
        if row is not given or not row[-1][pivot]:
            pivot = next((j for j, x in enumerate(row[-1]) if x), pivot)
        found.append((pivot, row))
    return found


def unit(size: int, i: int) -> list[int]:
    """Returns a row of the identity."""
    return [int(i == j) for j in range(size)]


def times(x: list[int], M: Integers, width: int) -> list[int]:
    """Returns a row times a matrix."""
    return [sum(a * row[j] for a, row in zip(x, M, strict=True)) for j in range(width)]


def added(u: Iterable[int], v: Iterable[int], prime: int) -> list[int]:
    """Returns the sum modulo the prime."""
    return [(a + b) % prime for a, b in zip(u, v, strict=True)]
