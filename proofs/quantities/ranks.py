"""These are the ranks of built matrices of one system, which quantities are made of when many systems are looked at together.

    Ranks       rank O_s, T_s, [O_s T_s], ... of one system; numbers that are not there yet are asked for by raising Wanted
    Numbers     what is known of a case: the ranks of each of its systems, and what is asked of it as a whole
    Wanted      what is to be found first, for all systems that need it
    FAMILIES    the names: the matrices are described in `batches`

Every family but SILENT is a list for s = 0, ..., n + 1. From s = n on these ranks grow by the same amount at each step, so that a rank at a
larger s is known: the increments of rank [O_s T_s] are p less the number of left minimal indices up to s, those of rank T_s count the
infinite zeros of order up to s, and no index and no order exceeds n ([F75], [VD79]); rank O_s stays as it is from n on (Cayley-Hamilton).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

OBSERVED, DRIVEN, WINDOW, REACHED, DUAL, LATER, SILENT = "O", "T", "OT", "R", "dual OT", "OT without v(0)", "[R; T]"
CHARACTERISTIC, MINORS = "det(qI - A)", "minors of P(q)"
FAMILIES = (OBSERVED, DRIVEN, WINDOW, REACHED, DUAL, LATER, SILENT, CHARACTERISTIC, MINORS)


class Wanted(Exception):
    """What is named by `key` has to be found before the question can be answered."""

    def __init__(self, key: object) -> None:
        super().__init__(key)
        self.key = key


@dataclass(frozen=True)
class Ranks:
    """The ranks of one system with n states, m faults, p outputs, as far as they are `known`: family -> numbers.

    Where the system is one of several, what is known of it has the key (`subject`, family).
    """

    n: int
    m: int
    p: int
    known: Mapping[object, tuple[int, ...]]
    subject: str = ""

    def table(self, family: str) -> tuple[int, ...]:
        """Return the numbers of a family. Raises Wanted."""
        key = (self.subject, family) if self.subject else family
        if key not in self.known:
            raise Wanted(key)
        return self.known[key]

    def at(self, family: str, s: int) -> int:
        """Return the rank at s >= 0, any s."""
        table = self.table(family)
        last = len(table) - 1
        return table[s] if s <= last else table[last] + (s - last) * (table[last] - table[last - 1])

    def step(self, family: str, k: int) -> int:
        """Return the rank at k + 1 less that at k."""
        return self.at(family, k + 1) - self.at(family, k)

    @property
    def normal_rank(self) -> int:
        """The last increment of rank T_s."""
        return self.step(DRIVEN, self.n)

    def indices(self, family: str, outputs: int) -> tuple[int, ...]:
        """Return the minimal indices of which `outputs` less the increment at k counts those up to k, ascending."""
        found: list[int] = []
        for k in range(self.n + 1):
            found += [k] * (outputs - self.step(family, k) - len(found))
        return tuple(found)

    @property
    def left_minimal_indices(self) -> tuple[int, ...]:
        """The left minimal indices, ascending."""
        return self.indices(WINDOW, self.p)

    @property
    def right_minimal_indices(self) -> tuple[int, ...]:
        """The left ones of the transposed system, ascending."""
        return self.indices(DUAL, self.m)

    @property
    def infinite_zero_orders(self) -> tuple[int, ...]:
        """The increment of rank T at k counts the orders up to k; ascending."""
        found: list[int] = []
        for k in range(self.n + 1):
            found += [k] * (self.step(DRIVEN, k) - len(found))
        return tuple(found)

    @property
    def finite_zeros(self) -> int:
        """The states that neither indices nor infinite zeros take."""
        return self.n - sum(self.left_minimal_indices) - sum(self.right_minimal_indices) - sum(self.infinite_zero_orders)

    def settled(self, family: str) -> int:
        """Return the least s from which on the rank stays as it is at n."""
        return next(s for s in range(self.n + 1) if self.at(family, s) == self.at(family, self.n))


@dataclass(frozen=True)
class Numbers:
    """The numbers of one case, as far as they are `known`; `sizes` are (n, m, p) of each of its systems, `samples` those of a record."""

    sizes: Mapping[str, tuple[int, int, int]]
    known: Mapping[object, tuple[int, ...]]
    samples: int = 0

    def of(self, subject: str) -> Ranks:
        """Return the ranks of one of the systems."""
        return Ranks(*self.sizes[subject], self.known, subject)

    def table(self, key: object) -> tuple[int, ...]:
        """Return the numbers of a family of the whole. Raises Wanted."""
        if key not in self.known:
            raise Wanted(key)
        return self.known[key]
