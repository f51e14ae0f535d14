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

import numpy as np
from numpy.typing import NDArray

from ..language.vocabularies import RECORD
from ..quantities.batches import Batch
from ..quantities.blocks import Number, Scalars, height
from ..quantities.elimination import Integers
from ..quantities.records import Records
from .boxes import AT_ONCE, LARGEST_TABLE, Box, Sizes, Stretch, changes, digits_of, places_of, systems_in_order
from .pair_boxes import fault_columns

LARGEST_NUMBER = 2**62


@dataclass(frozen=True)
class RecordBox(Box):
    """All records whose system is in the box, with nu inputs and N samples: the first and the last number of them."""

    nu: tuple[int, int] = (1, 1)
    N: tuple[int, int] = (1, 5)

    @property
    def about(self) -> str:
        """What the cases of the box are."""
        return RECORD

    @property
    def noun(self) -> str:
        """What they are called."""
        return "records"

    @property
    def one(self) -> str:
        """What one of them is called."""
        return "record"

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

    def stretches(self, sizes: Sizes, *, reduced: bool) -> Iterator[Stretch]:
        """Yield all records of these sizes in order; where `reduced`, fewer that stand for all. Raises OverflowError for too many."""
        for level in sorted({height(x) for x in self.entries}):
            yield from self._level(sizes, level, reduced)

    def _level(self, sizes: Sizes, level: int, reduced: bool) -> Iterator[Stretch]:
        entries = [x for x in self.entries if height(x) <= level]
        n, m, p, nu, N = sizes
        driven = fault_columns(self, (n, nu, p), entries, reduced)
        signals, starts = self._values(entries, N, nu), self._values(entries, n, 1)
        for stretch in systems_in_order(
            self, (n, m, p), entries, np.ones(len(entries), dtype=bool), changes(self, (n, m, p), reduced=reduced)
        ):
            order = np.argsort(stretch.places, kind="stable")
            first, weights = stretch.batch.part(order), stretch.weights[order]
            shape = len(first), len(driven.times), len(signals), len(starts)
            total = len(first) * len(driven.times) * len(signals) * len(starts)
            if total >= LARGEST_NUMBER:
                raise OverflowError
            for start in range(0, total, AT_ONCE):
                i, j, a, b = np.unravel_index(np.arange(start, min(start + AT_ONCE, total)), shape)
                pair, seconds = np.unique(i * len(driven.times) + j, return_inverse=True)
                own, given = pair // len(driven.times), pair % len(driven.times)
                B, D = driven.F[given], driven.G[given]
                inputs = Batch(first.A[own], B, first.C[own], D, first.prime, first.denominator, first.number_field)
                records = Records(first, i, inputs, seconds, signals[a], starts[b])
                keep = _high(records, entries, level)
                if keep.any():
                    kept = records if keep.all() else records.part(np.flatnonzero(keep))
                    yield Stretch(kept, np.arange(len(kept)), (weights[i] * driven.times[j])[keep])

    def _values(self, entries: list[Number], rows: int, columns: int) -> Integers:
        """Return all matrices of that shape of these entries, times their common denominator, in order."""
        base = len(entries)
        if base ** (rows * columns) > LARGEST_TABLE:
            raise OverflowError
        return Scalars.of(entries, self.number_field).matrices(places_of(digits_of(base, rows * columns), base), rows, columns)


def _high(records: Records, entries: list[Number], level: int) -> NDArray[np.bool_]:
    """Return which records have an entry of this height; the others came with a lower one."""
    if all(height(x) == level for x in entries):
        return np.ones(len(records), dtype=bool)
    scalars = Scalars.of(entries, records.number_field)
    return scalars.high([records.matrix("", name) for name in ("A", "F", "C", "G", "B", "D", "u", "x0")], level)
