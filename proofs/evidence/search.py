"""The smallest counterexample in a box, found by going through every system of the box in order.

    Box                bounds on n, p, m, their sum, and the entries
    systems_in_order   by n + m + p, then n, m, p, then the largest numerator or denominator, then lexicographically (A, F, C, G by rows)
    chunks             the same systems in batches, as Facts
    first_of_orbits    the first of those that differ by renumbering and signs alone, in batches
    Facts              window ranks, rank of T_s, observability, controllability of many systems at once, by definition
    smallest           the first system that a vectorised test on Facts lets through and an exact test confirms

Ranks of many small systems at once come from division-free elimination of the built matrices modulo 2^31 - 1. No minor of theirs
reaches that prime (Hadamard's bound, checked for each box), so these ranks are the true ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import permutations, product
from math import isqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exact.system.systems import ResidualSystem

Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]
Known = dict[tuple[str, int], NDArray[np.int8]]
FIRST = ("first of its orbit", 0)  # under it Known has the entries of these systems
PRIME = 2**31 - 1
CHUNK = 20000


@dataclass(frozen=True)
class Box:
    """These are all systems with least <= n, p, m, n <= largest_n, ..., n + m + p <= total and entries in {-1, 0, 1}."""

    total: int
    largest_n: int
    largest_m: int
    largest_p: int
    least_m: int = 1

    def __str__(self) -> str:
        return (
            f"1 <= n <= {self.largest_n}, {self.least_m} <= m <= {self.largest_m}, 1 <= p <= {self.largest_p}, "
            f"n+m+p <= {self.total}, entries in {{-1, 0, 1}}"
        )

    def dimensions(self) -> list[tuple[int, int, int]]:
        """Return the (n, m, p) of the box in the order of the search."""
        ranges = (range(1, self.largest_n + 1), range(self.least_m, self.largest_m + 1), range(1, self.largest_p + 1))
        found = [(n, m, p) for n, m, p in product(*ranges) if n + m + p <= self.total]
        return sorted(found, key=lambda d: (sum(d), *d))


@dataclass(frozen=True)
class Facts:
    """These are systems of the same dimensions, one a row: A (N, n, n), F (N, n, m), C (N, p, n), G (N, p, m), integer entries.

    `known` keeps what was found out about them, in bytes, since several conditions ask for the same.
    """

    A: Integers
    F: Integers
    C: Integers
    G: Integers
    known: Known = field(default_factory=dict)

    @property
    def n(self) -> int:
        """The number of states."""
        return int(self.A.shape[1])

    @property
    def m(self) -> int:
        """This is the number of faults."""
        return int(self.F.shape[2])

    def system(self, index: int) -> ResidualSystem:
        """Return one of the systems, as an exact one."""
        return ResidualSystem.of(*(part[index].tolist() for part in (self.A, self.F, self.C, self.G)))

    def window(self, s: int) -> Integers:
        """Return the matrix [O_s T_s] of every system."""
        count, p = len(self.A), self.C.shape[1]
        built = np.zeros((count, p * s, self.n + self.m * s), dtype=np.int64)
        row, markov = self.C, [self.G]
        for i in range(s):
            built[:, i * p : (i + 1) * p, : self.n] = row
            for j in range(i + 1):
                built[:, i * p : (i + 1) * p, self.n + j * self.m : self.n + (j + 1) * self.m] = markov[i - j]
            markov.append(row @ self.F)
            row = row @ self.A
        return built

    def rank(self, s: int) -> Integers:
        """Return the rank of [O_s T_s] of every system."""
        return self._kept("rank", s, lambda: ranks(self.window(s)))

    def rank_from_rest(self, s: int) -> Integers:
        """Return the rank of T_s of every system."""
        return self._kept("rank from rest", s, lambda: ranks(self.window(s)[:, :, self.n :]))

    def gap(self, s: int) -> Integers:
        """Return the difference rank [O_(s+1) T_(s+1)] - rank [O_s T_s] of every system."""
        return self.rank(s + 1) - self.rank(s)

    @cached_property
    def observable(self) -> Flags:
        """Whether (A, C) is observable, for every system."""
        return np.asarray(self._kept("observability", self.n, lambda: ranks(self.window(self.n)[:, :, : self.n])) == self.n)

    @cached_property
    def controllable(self) -> Flags:
        """Whether (A, F) is controllable, for every system."""

        def reached() -> Integers:
            blocks, column = [], self.F
            for _ in range(self.n):
                blocks.append(column)
                column = self.A @ column
            return ranks(np.concatenate(blocks, axis=2))

        return np.asarray(self._kept("reachability", self.n, reached) == self.n)

    @cached_property
    def left_invertible(self) -> Flags:
        """This says whether rank T_(n+1) - rank T_n = m, for every system."""
        return np.asarray(self.rank_from_rest(self.n + 1) - self.rank_from_rest(self.n) == self.m)

    @cached_property
    def delay_known_state(self) -> Integers:
        """This is the least l with rank T_(l+1) - rank T_l = m for every system; n + 1 where there is none."""
        return self._least(lambda s: np.asarray(self.rank_from_rest(s + 1) - self.rank_from_rest(s) == self.m))

    @cached_property
    def delay_unknown_state(self) -> Integers:
        """This is the least l with rank [O_(l+1) T_(l+1)] = m + the rank without the columns of v(0); n + 1 where there is none."""

        def determined(s: int) -> Flags:
            built = self.window(s + 1)
            rest = np.concatenate([built[:, :, : self.n], built[:, :, self.n + self.m :]], axis=2)
            return np.asarray(ranks(built) == ranks(rest) + self.m)

        return self._least(determined)

    def _kept(self, what: str, window: int, find: Callable[[], Integers]) -> Integers:
        """Return the ranks that `find` finds the first time; there are fewer than 128 rows."""
        if (what, window) not in self.known:
            self.known[what, window] = find().astype(np.int8)
        return self.known[what, window].astype(np.int64)

    def _least(self, test: Callable[[int], Flags]) -> Integers:
        found = np.full(len(self.A), self.n + 1, dtype=np.int64)
        for delay in reversed(range(self.n + 1)):
            found = np.where(test(delay), delay, found)
        return found


def ranks(matrices: Integers) -> Integers:
    """The ranks of many small integer matrices (N, rows, cols). Raises ArithmeticError when a minor could reach the prime."""
    if matrices.size and max(-int(matrices.min()), int(matrices.max())) >= 2**20:
        raise ArithmeticError("entries beyond 2^20")
    lengths = np.sort((matrices * matrices).sum(axis=2).max(axis=0)) if matrices.size else np.zeros(0)  # below 2^63: no row is that long
    bound = 1
    for length in lengths[::-1][: matrices.shape[2]]:
        bound *= isqrt(int(length)) + 1
    if bound >= PRIME:
        raise ArithmeticError(f"a minor could be as large as {bound}")
    work = _residues(np.ascontiguousarray(np.moveaxis(matrices, 0, -1)))  # the systems last: numpy's inner loops are long then
    nrows, ncols, count = work.shape
    rank = np.zeros(count, dtype=np.int64)
    every, rows = np.arange(count), np.arange(nrows)[:, None]
    for _ in range(ncols):  # what is left to do has one column less each time
        lead = work[:, 0]
        candidates = (lead != 0) & (rows >= rank)
        found = candidates.any(axis=0)
        if not found.any():
            work = work[:, 1:]
            continue
        chosen, here = np.argmax(candidates, axis=0), np.minimum(rank, nrows - 1)
        at = np.where(found, chosen, here)
        pivot_row, other = work[at, :, every].T.copy(), work[here, :, every].T
        work[at, :, every], work[here, :, every] = other.T, pivot_row.T
        below = (rows > here) & found
        scale, times = np.where(below, pivot_row[0], 1), np.where(below, lead, 0)
        work = _residues(work[:, 1:] * scale[:, None] - times[:, None] * pivot_row[None, 1:])
        rank += found
    return rank


def _residues(numbers: NDArray[Any]) -> Integers:
    """Return the numbers modulo the prime; numpy divides by one number several times faster than it takes the remainder."""
    residues: Integers = numbers - numbers // PRIME * PRIME
    return residues


def chunks(box: Box) -> Iterator[Facts]:
    """Yield the systems of a box in order, in batches of the same dimensions."""
    for n, m, p, start, stop in _batches(box, CHUNK):
        yield _facts(n, m, p, _digits(n, m, p, start, stop))


def first_of_orbits(box: Box, known: dict[tuple[int, ...], Known] | None = None) -> Iterator[Facts]:
    """Yield, in order, the first system of each orbit under renumbering and changes of sign of states, outputs and faults.

    These keep the box as it is. So the first system of the box that fails a statement which they leave as it is, is one of these. `known`,
    where it is given, keeps these systems and what is found out about them for the next search, which may be through another box.
    """
    known = {} if known is None else known
    for n, m, p, start, stop in _batches(box, 16 * CHUNK):
        here = known.setdefault((n, m, p, start), {})
        if FIRST not in here:
            digits = _digits(n, m, p, start, stop)
            for earlier in _precedences(n, m, p):
                digits = digits[digits @ earlier <= 0]
            here[FIRST] = digits.astype(np.int8)
        if len(here[FIRST]):
            yield _facts(n, m, p, here[FIRST].astype(np.int64), here)


def _batches(box: Box, length: int) -> Iterator[tuple[int, int, int, int, int]]:
    """Yield n, m, p and the numbers of the first system and of the one after the last, at most so many systems at once."""
    for n, m, p in box.dimensions():
        total: int = 3 ** ((n + p) * (n + m))
        for start in range(0, total, length):
            yield n, m, p, start, min(start + length, total)


def _digits(n: int, m: int, p: int, start: int, stop: int) -> Integers:
    """Return the entries of the systems with these numbers, one a row, A, F, C, G by rows."""
    numbers = np.arange(start, stop, dtype=np.int64)
    return np.stack([numbers // 3**k % 3 for k in reversed(range((n + p) * (n + m)))], axis=1) - 1


def _facts(n: int, m: int, p: int, digits: Integers, known: Known | None = None) -> Facts:
    A, F, C, G = np.split(digits, np.cumsum([n * n, n * m, p * n]), axis=1)
    shaped = A.reshape(-1, n, n), F.reshape(-1, n, m), C.reshape(-1, p, n), G.reshape(-1, p, m)
    return Facts(*shaped, {} if known is None else known)


@cache
def _precedences(n: int, m: int, p: int) -> tuple[Integers, ...]:
    """Return a vector for each renumbering with signs: its product with the entries of a system is positive iff the image comes earlier.

    The number of a system in the order is the product of its entries with powers of 3, and a constant; that of its image has the same
    powers, moved and with signs.
    """
    cuts = np.cumsum([n * n, n * m, p * n])
    powers = 3 ** np.arange((n + p) * (n + m), dtype=np.int64)[::-1]
    A, F, C, G = (part.reshape(shape) for part, shape in zip(np.split(powers, cuts), ((n, n), (n, m), (p, n), (p, m)), strict=True))
    found = []
    for T, U, V in product(_signed_permutations(n), _signed_permutations(p), _signed_permutations(m)):
        moved = T.T @ A @ T, T.T @ F @ V, U.T @ C @ T, U.T @ G @ V
        found.append(powers - np.concatenate([part.ravel() for part in moved]))
    return tuple(found)


def _signed_permutations(size: int) -> list[Integers]:
    unit = np.eye(size, dtype=np.int64)
    return [unit[list(order)] * np.array(signs)[:, None] for order in permutations(range(size)) for signs in product((1, -1), repeat=size)]


def systems_in_order(box: Box, test: Callable[[Facts], Flags]) -> Iterator[ResidualSystem]:
    """Yield the systems of the box that pass the vectorised test, in order."""
    for facts in chunks(box):
        for index in np.flatnonzero(test(facts)):
            yield facts.system(int(index))


def smallest(box: Box, test: Callable[[Facts], Flags], confirm: Callable[[ResidualSystem], bool]) -> ResidualSystem | None:
    """Return the first system of the box that passes the vectorised test and the exact one; None where there is none.

    Renumbering and changes of sign of states, outputs and faults leave both tests as they are.
    """
    for facts in first_of_orbits(box):
        for index in np.flatnonzero(test(facts)):
            system = facts.system(int(index))
            if confirm(system):
                return system
    return None
