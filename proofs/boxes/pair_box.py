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
from typing import ClassVar

import numpy as np

from ..language.vocabularies import ONE_A_AND_C, PAIR
from ..quantities.batches import Batch
from ..quantities.blocks import Number, Scalars
from ..quantities.elimination import Integers
from ..quantities.pairs import Pairs
from .box import AT_ONCE, LARGEST_TABLE, Box, Portion, Sizes, changes, digits_of, first_of_orbits, places_of, systems_in_order


@dataclass(frozen=True)
class PairBox(Box):
    """All pairs whose systems are both in the box, with as many outputs each; `one_A_and_C` where A and C of both are the same."""

    noun: ClassVar[str] = "pairs of systems"
    one: ClassVar[str] = "pair of systems"
    tables: ClassVar[tuple[tuple[str, str], ...]] = tuple((subject, name) for subject in ("first", "second") for name in "AFCG")

    one_A_and_C: bool = False

    @property
    def about(self) -> str:  # type: ignore[override]
        """What the cases of the box are."""
        return ONE_A_AND_C if self.one_A_and_C else PAIR

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

    def portions(self, sizes: Sizes, entries: list[Number], *, reduced: bool) -> Iterator[Portion]:
        """Yield pairs of each of the first systems with every second one. Raises OverflowError for too many."""
        seconds = None if self.one_A_and_C else _seconds(self, sizes[3:], entries, reduced)
        columns = fault_columns(self, sizes[3:], entries, reduced) if seconds is None else None
        times = seconds[1] if seconds else columns.times if columns else np.zeros(0, dtype=np.int64)
        per = len(times)
        for first, weights in systems_in_order(self, sizes[:3], entries, changes(self, sizes[:3], reduced=reduced)):
            for start in range(0, len(first) * per, AT_ONCE):
                places = np.arange(start, min(start + AT_ONCE, len(first) * per))
                firsts, which = places // per, places % per
                if seconds:
                    yield Pairs(first, firsts, seconds[0], which), weights[firsts] * times[which]
                if columns:
                    second = first.with_faults(firsts, columns.F[which], columns.G[which])
                    yield Pairs(first, firsts, second, np.arange(len(places)), True), weights[firsts] * times[which]


def _seconds(box: PairBox, sizes: Sizes, entries: list[Number], reduced: bool) -> tuple[Batch, Integers]:
    """Return the second systems in order, with the number of those that each stands for. Raises OverflowError where they fit no table."""
    states, faults, outputs = changes(box, sizes, reduced=reduced)
    parts, weights, held = [], [], 0
    for batch, times in systems_in_order(box, sizes, entries, (states, faults, outputs[:1])):
        parts.append(batch)
        weights.append(times)
        held += len(batch)
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
    found, fixed = first_of_orbits(digits_of(base, length), [powers - np.concatenate([(F @ V).ravel(), (G @ V).ravel()]) for V in group])
    scalars, places = Scalars.of(entries, box.number_field), places_of(found, base)
    return FaultColumns(scalars.matrices(places[:, : n * m], n, m), scalars.matrices(places[:, n * m :], p, m), len(group) // fixed)
