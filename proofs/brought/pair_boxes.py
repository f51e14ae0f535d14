"""A box of pairs of small systems, gone through in order, by fewer pairs that stand for all where the claim allows it.

    PairBox       bounds on n, m, p of both systems; whether they have the same (A, C)

Both systems have as many outputs. The order is by the number of all states, faults and outputs of both, then n, m, p of the first, then of
the second, then the largest numerator or denominator of an entry, then by the entries of A, F, C, G of the first and then of the second, by
rows. What renumbers the states and faults of each and the outputs of both, or changes their signs, leaves an invariant claim as it is, so
that of the pairs that fail the first one in the order has a first system that comes first in its orbit, and a second one that comes first
among those that changes of its states and faults alone make of it. Where (A, C) is the same, changes of the faults alone are left for it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ..language.vocabularies import ONE_A_AND_C, PAIR
from ..quantities.batches import Batch
from ..quantities.blocks import Number, Scalars, height
from ..quantities.elimination import Integers
from ..quantities.pairs import Pairs
from .boxes import AT_ONCE, LARGEST_TABLE, Box, Sizes, Stretch, changes, digits_of, first_of_orbits, places_of, systems_in_order


@dataclass(frozen=True)
class PairBox(Box):
    """All pairs whose systems are both in the box, with as many outputs each; `one_A_and_C` where A and C of both are the same."""

    one_A_and_C: bool = False

    @property
    def about(self) -> str:
        """What the cases of the box are."""
        return ONE_A_AND_C if self.one_A_and_C else PAIR

    @property
    def noun(self) -> str:
        """What they are called."""
        return "pairs of systems"

    @property
    def one(self) -> str:
        """What one of them is called."""
        return "pair of systems"

    def __str__(self) -> str:
        return f"{super().__str__()} in both{', the same A and C' if self.one_A_and_C else ''}"

    def sizes(self) -> list[Sizes]:
        """Return (n, m, p) of the first and of the second in order."""
        found = [(*one, *other) for one, other in product(super().sizes(), repeat=2)]
        alike = [one for one in found if one[2] == one[5] and (not self.one_A_and_C or one[0] == one[3])]
        return sorted(alike, key=lambda one: (sum(one), *one))

    def count(self, *sizes: int) -> int:
        """Return how many pairs there are of these sizes."""
        n, m, p = sizes[3:]
        own: int = len(self.entries) ** ((n + p) * m) if self.one_A_and_C else super().count(n, m, p)
        return super().count(*sizes[:3]) * own

    def stretches(self, sizes: Sizes, *, reduced: bool) -> Iterator[Stretch]:
        """Yield all pairs of these sizes in order; where `reduced`, fewer that stand for all. Raises OverflowError for too many."""
        for level in sorted({height(x) for x in self.entries}):
            yield from self._level(sizes, level, reduced)

    def _level(self, sizes: Sizes, level: int, reduced: bool) -> Iterator[Stretch]:
        entries = [x for x in self.entries if height(x) <= level]
        every = np.ones(len(entries), dtype=bool)
        seconds = None if self.one_A_and_C else _seconds(self, sizes[3:], entries, reduced)
        for stretch in systems_in_order(self, sizes[:3], entries, every, changes(self, sizes[:3], reduced=reduced)):
            order = np.argsort(stretch.places, kind="stable")
            first = stretch.batch.part(order)
            for pairs, weights in self._pairs(first, stretch.weights[order], sizes, entries, seconds, reduced):
                keep = _high(pairs, entries, level)
                if keep.any():
                    kept = pairs if keep.all() else pairs.part(np.flatnonzero(keep))
                    yield Stretch(kept, np.arange(len(kept)), weights[keep])

    def _pairs(
        self,
        first: Batch,
        weights: Integers,
        sizes: Sizes,
        entries: list[Number],
        seconds: tuple[Batch, Integers] | None,
        reduced: bool,
    ) -> Iterator[tuple[Pairs, Integers]]:
        """Yield pairs of each of the first systems with every second one, with the numbers of those that they stand for."""
        columns = fault_columns(self, sizes[3:], entries, reduced) if seconds is None else None
        times = seconds[1] if seconds else columns.times if columns else np.zeros(0, dtype=np.int64)
        per = len(times)
        for start in range(0, len(first) * per, AT_ONCE):
            places = np.arange(start, min(start + AT_ONCE, len(first) * per))
            firsts, which = places // per, places % per
            if seconds:
                yield Pairs(first, seconds[0], firsts, which), weights[firsts] * times[which]
            if columns:
                A, C = first.A[firsts], first.C[firsts]
                second = Batch(A, columns.F[which], C, columns.G[which], first.prime, first.denominator, first.number_field)
                yield Pairs(first, second, firsts, np.arange(len(places)), True), weights[firsts] * times[which]


def _seconds(box: PairBox, sizes: Sizes, entries: list[Number], reduced: bool) -> tuple[Batch, Integers]:
    """Return the second systems in order, with the number of those that each stands for. Raises OverflowError where they fit no table."""
    states, faults, outputs = changes(box, sizes, reduced=reduced)
    group = states, faults, outputs[:1]
    parts, weights, held = [], [], 0
    for stretch in systems_in_order(box, sizes, entries, np.ones(len(entries), dtype=bool), group):
        order = np.argsort(stretch.places, kind="stable")
        parts.append(stretch.batch.part(order))
        weights.append(stretch.weights[order])
        held += len(order)
        if held > LARGEST_TABLE:
            raise OverflowError
    A, F, C, G = (np.concatenate([part.matrix("", name) for part in parts]) for name in "AFCG")
    return Batch(A, F, C, G, box.prime, parts[0].denominator, box.number_field), np.concatenate(weights)


@dataclass(frozen=True)
class FaultColumns:
    """All F (count, n, m) and G (count, p, m) of some sizes, in order, with the number of those that each stands for."""

    F: Integers
    G: Integers
    times: Integers


def fault_columns(box: Box, sizes: Sizes, entries: list[Number], reduced: bool) -> FaultColumns:
    """Return the F and G with these entries; where `reduced`, one of those that differ by order and signs of faults."""
    n, m, p = sizes
    base, length = len(entries), (n + p) * m
    if base**length > LARGEST_TABLE:
        raise OverflowError
    powers = np.array([base**k for k in reversed(range(length))], dtype=np.int64)
    F, G = powers[: n * m].reshape(n, m), powers[n * m :].reshape(p, m)
    group = changes(box, sizes, reduced=reduced)[1]
    found, _, fixed = first_of_orbits(digits_of(base, length), [powers - np.concatenate([(F @ V).ravel(), (G @ V).ravel()]) for V in group])
    scalars, places = Scalars.of(entries, box.number_field), places_of(found, base)
    return FaultColumns(scalars.matrices(places[:, : n * m], n, m), scalars.matrices(places[:, n * m :], p, m), len(group) // fixed)


def _high(pairs: Pairs, entries: list[Number], level: int) -> NDArray[np.bool_]:
    """Return which pairs have an entry of this height; the others came with a lower one."""
    if all(height(x) == level for x in entries):
        return np.ones(len(pairs), dtype=bool)
    scalars = Scalars.of(entries, pairs.number_field)
    return scalars.high([pairs.matrix(subject, name) for subject in ("first", "second") for name in "AFCG"], level)
