"""A box of small systems with inputs and short records of them, gone through in order, by fewer where a claim allows it.

    RecordBox     bounds on n, m, p, on nu, the number of inputs, and N, that of samples; entries of u and x0 are those of the box, too

The order is by n + m + p, then nu, then N, then n, m, p, then the largest numerator or denominator of an entry, then by the entries of A,
F, C, G, B, D, u and x0, by rows. What renumbers states, faults, outputs or inputs or changes their signs leaves an invariant claim as it
is: of the records that fail the first one has an (A, F, C, G) that comes first in its orbit, and (B, D) that comes first under changes of
the inputs alone, which move u with them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import ClassVar

import numpy as np

from ..language.vocabularies import RECORD
from ..quantities.blocks import Number, Scalars
from ..quantities.elimination import Integers
from ..quantities.records import Records
from .box import AT_ONCE, LARGEST_TABLE, Box, Portion, Sizes, changes, digits_of, places_of, systems_in_order
from .pair_box import fault_columns

LARGEST_NUMBER = 2**62


@dataclass(frozen=True)
class RecordBox(Box):
    """All records whose system is in the box, with nu inputs and N samples: the first and the last number of them."""

    about: ClassVar[str] = RECORD
    noun: ClassVar[str] = "records"
    one: ClassVar[str] = "record"
    tables: ClassVar[tuple[tuple[str, str], ...]] = (*Box.tables, *(("", name) for name in ("B", "D", "u", "x0")))

    nu: tuple[int, int] = (1, 1)
    N: tuple[int, int] = (1, 5)

    def __str__(self) -> str:
        return f"{super().__str__()}, {self.nu[0]} <= nu <= {self.nu[1]}, {self.N[0]} <= N <= {self.N[1]}"

    def sizes(self) -> list[Sizes]:
        """Return the (n, m, p, nu, N) of the box in order."""
        found = product(super().sizes(), range(self.nu[0], self.nu[1] + 1), range(self.N[0], self.N[1] + 1))
        return [(*one, nu, N) for one, nu, N in sorted(found, key=lambda one: (sum(one[0]), one[1], one[2], one[0]))]

    def count(self, *sizes: int) -> int:
        """Return how many records there are of these sizes."""
        n, m, p, nu, N = sizes
        found: int = super().count(n, m, p) * len(self.entries) ** ((n + p) * nu + N * nu + n)
        return found

    def portions(self, sizes: Sizes, entries: list[Number], *, reduced: bool) -> Iterator[Portion]:
        """Yield the records of each system with every B, D, u and x0. Raises OverflowError for too many."""
        n, m, p, nu, N = sizes
        driven = fault_columns(self, (n, nu, p), entries, reduced)
        signals, starts = self._values(entries, N, nu), self._values(entries, n, 1)
        for first, weights in systems_in_order(self, (n, m, p), entries, changes(self, (n, m, p), reduced=reduced)):
            shape = len(first), len(driven.times), len(signals), len(starts)
            total = len(first) * len(driven.times) * len(signals) * len(starts)
            if total >= LARGEST_NUMBER:
                raise OverflowError
            for start in range(0, total, AT_ONCE):
                i, j, a, b = np.unravel_index(np.arange(start, min(start + AT_ONCE, total)), shape)
                pair, seconds = np.unique(i * len(driven.times) + j, return_inverse=True)
                own, given = pair // len(driven.times), pair % len(driven.times)
                inputs = first.with_faults(own, driven.F[given], driven.G[given])
                yield Records(first, i, inputs, seconds, signals[a], starts[b]), weights[i] * driven.times[j]

    def _values(self, entries: list[Number], rows: int, columns: int) -> Integers:
        """Return all matrices of that shape of these entries, times their common denominator, in order."""
        base = len(entries)
        if base ** (rows * columns) > LARGEST_TABLE:
            raise OverflowError
        return Scalars.of(entries, self.number_field).matrices(places_of(digits_of(base, rows * columns), base), rows, columns)
