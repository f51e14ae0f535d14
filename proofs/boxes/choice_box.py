"""A box of small systems with the choices P of their fault columns, gone through in order.

    ChoiceBox     bounds on n, m, p of the system and on k, the number of columns of P; the entries of P are those of the box, too
    choices_of    the choices of some systems with some P

The order is by n + m + p, then k, then n, m, p, then the largest numerator or denominator of an entry, then by the entries of A, F, C, G
and P, by rows. P is n_z x k, with the n_z of the system. Another order or sign of the states or outputs moves the reduced basis of the
fault space, by which P is written; of the faults it does not, and neither does one of the columns of P: of these one is looked at.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from math import lcm
from typing import ClassVar

import numpy as np

from ...exact.algebra.fields import PrimeField
from ...exact.structure.fault_columns import FaultSpace, fault_space
from ...exact.structure.kernel_rows import kernel_representation
from ..language.vocabularies import CHOICE
from ..quantities.batches import Batch
from ..quantities.blocks import Number, Scalars
from ..quantities.choices import Choices
from ..quantities.elimination import Integers
from .box import AT_ONCE, LARGEST_TABLE, Box, Portion, Sizes, changes, digits_of, first_of_orbits, places_of, systems_in_order

SYSTEMS_AT_ONCE = 2000


@dataclass(frozen=True)
class ChoiceBox(Box):
    """All choices whose system is in the box and whose P has k columns, `k` being the first and the last number of them."""

    about: ClassVar[str] = CHOICE
    noun: ClassVar[str] = "choices"
    one: ClassVar[str] = "choice"
    tables: ClassVar[tuple[tuple[str, str], ...]] = (("", "P"), *Box.tables)

    k: tuple[int, int] = (1, 2)

    def __str__(self) -> str:
        return f"{super().__str__()}, {self.k[0]} <= k <= {self.k[1]}"

    def sizes(self) -> list[Sizes]:
        """Return the (n, m, p, k) of the box in order."""
        found = product(super().sizes(), range(self.k[0], self.k[1] + 1))
        return [(*one, k) for one, k in sorted(found, key=lambda one: (sum(one[0]), one[1], one[0]))]

    def count(self, *sizes: int) -> int:
        """Return how many choices of these sizes there can be: as many as if all columns solved problem (11)."""
        n, m, p, k = sizes
        found: int = super().count(n, m, p) * len(self.entries) ** ((n + p) * k)
        return found

    def portions(self, sizes: Sizes, entries: list[Number], *, reduced: bool) -> Iterator[Portion]:
        """Yield the choices of each system with every P. Raises OverflowError for too many."""
        n, m, p, k = sizes
        states, faults, outputs = changes(self, (n, m, p), reduced=reduced)
        columns = changes(self, (k,), reduced=reduced)[0]
        tables: dict[int, tuple[Integers, Integers]] = {}
        for batch, weights in systems_in_order(self, (n, m, p), entries, (states[:1], faults, outputs[:1])):
            for some in np.array_split(np.arange(len(batch)), 1 + len(batch) // SYSTEMS_AT_ONCE):
                first = batch.part(some)
                spaces = [fault_space(kernel_representation(first.system(i))) for i in range(len(first))]
                for one in {space.dimension for space in spaces} - set(tables):
                    tables[one] = _tables(self, entries, one, k, columns)
                for chosen, times in _portions(first, spaces, tables):
                    yield chosen, weights[some][chosen.firsts] * times


def _tables(box: ChoiceBox, entries: list[Number], n_z: int, k: int, columns: list[Integers]) -> tuple[Integers, Integers]:
    """Return all P (n_z x k) in order, times the common denominator of the entries, with the number of those that each stands for."""
    base, length = len(entries), n_z * k
    if base**length > LARGEST_TABLE:
        raise OverflowError
    powers = np.array([base**i for i in reversed(range(length))], dtype=np.int64).reshape(n_z, k)
    found, fixed = first_of_orbits(digits_of(base, length), [(powers - powers @ V).ravel() for V in columns])
    return Scalars.of(entries, box.number_field).matrices(places_of(found, base), n_z, k), len(columns) // fixed


def _portions(first: Batch, spaces: list[FaultSpace], tables: dict[int, tuple[Integers, Integers]]) -> Iterator[tuple[Choices, Integers]]:
    """Yield the choices of neighbouring systems, with the numbers of those that each P stands for."""
    portion: list[int] = []
    held = 0
    for i, space in enumerate(spaces):
        portion.append(i)
        held += len(tables[space.dimension][1])
        if held >= AT_ONCE or i + 1 == len(spaces):
            yield choices_of(first, spaces, tables, portion)
            portion, held = [], 0


def choices_of(
    first: Batch, spaces: list[FaultSpace], tables: dict[int, tuple[Integers, Integers]], portion: Iterable[int]
) -> tuple[Choices, Integers]:
    """Return the choices of these systems of `first`, with every P of the table for their n_z, and the numbers beside those P."""
    n, width = first.A.shape[1], first.A.shape[1] + first.C.shape[1]
    firsts, P, scales, F, G, times = [], [], [], [], [], []
    for i in portion:
        listed, weights = tables[spaces[i].dimension]
        basis, scale = _integers(spaces[i])
        columns = basis @ listed
        if first.prime is not None:
            columns %= first.prime
        firsts.append(np.full(len(listed), i))
        P.append(np.pad(listed, ((0, 0), (0, width - listed.shape[1]), (0, 0))))
        scales.append(np.full(len(listed), scale))
        F.append(columns[:, :n])
        G.append(columns[:, n:])
        times.append(weights)
    which = np.concatenate(firsts)
    second = first.with_faults(which, np.concatenate(F), np.concatenate(G))
    heights = np.array([space.dimension for space in spaces])[which]
    return Choices(first, which, second, np.concatenate(P), heights, np.concatenate(scales)), np.concatenate(times)


def _integers(space: FaultSpace) -> tuple[Integers, int]:
    """Return the reduced basis as columns, times their common denominator, and that; over Q(a) in blocks."""
    table = space.basis.transposed().flint  # a Matrix over Q(a) is that of its blocks
    shape, numbers = (table.nrows(), table.ncols()), table.entries()
    if isinstance(space.system.field, PrimeField):
        return np.array([int(x) for x in numbers], dtype=np.int64).reshape(shape), 1
    scale = lcm(*(int(x.q) for x in numbers))
    return np.array([int(x * scale) for x in numbers], dtype=np.int64).reshape(shape), scale
