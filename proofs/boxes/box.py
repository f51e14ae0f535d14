"""A box of small cases, gone through in order, one of each orbit where the claim allows it.

    Box           bounds on n, m, p and their sum, the entries, and the field: a box of systems, and what boxes of other cases share
    Stretch       cases of equal sizes and equal height, some of them, which follow each other in the order
    Share         how much of the cases of some sizes one process goes through
    in_order      the systems of a box of which expressions of the language are true, one after the other; of_sizes: of some sizes
    rows_where    which of many systems expressions are true of
    grouped       such systems, each with those that have something in common with it
    matrices_in_order    the matrices of a shape with the usual entries

The order is by n + m + p, then n, m, p, then the largest numerator or denominator of the entries, then by the entries of A, F, C, G, by
rows, -1 before 0 before 1. Over GF(q) the entries are the residues between -q/2 and q/2, in the order of the integers.

Renumbering states, outputs or faults, and changing their signs, takes the box to itself where the entries have their negatives among them
(else renumbering alone does), and leaves what an invariant claim says as it is. The first system of an orbit is then enough: a system that
fails is in the orbit of one that comes first and fails too. An orbit is found in two steps: A comes first among all that changes of the
state make of it, and (F, C, G) comes first among all that the changes which leave A as it is, and those of outputs and faults, make of it.
Since the order is that of numbers whose digits are the entries, and these changes move digits and turn signs, one scalar product with each
change says whether its image comes earlier.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import permutations, product
from math import factorial
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...exact.algebra.fields import QQ, Field, NumberField, PrimeField
from ...exact.algebra.matrices import Matrix
from ...exact.system.systems import ResidualSystem
from ..language.by_batches import Table, true_of
from ..language.grammar import read
from ..language.vocabularies import SYSTEM
from ..quantities.batches import Batch
from ..quantities.blocks import Number, Scalars, height
from ..quantities.elimination import Integers
from ..quantities.many import Chosen

AT_ONCE, MOST_CHANGES = 60_000, 50_000
Sizes = tuple[int, ...]
Portion = tuple[Any, Integers]  # cases that follow each other in the order, and how many each stands for
LARGEST_TABLE = 2 * 10**6  # rows of some fourteen numbers of eight bytes: a few hundred megabytes while they are sorted out


@dataclass(frozen=True)
class Box:
    """All systems with n, m, p in these ranges (first, last), n + m + p <= total, entries among these numbers, over Q, GF(prime) or a
    number field.

    `about` is what the cases of the box are, `noun` and `one` what they are called, `tables` the matrices with the entries of the box.
    """

    about: ClassVar[str] = SYSTEM
    noun: ClassVar[str] = "systems"
    one: ClassVar[str] = "system"
    tables: ClassVar[tuple[tuple[str, str], ...]] = tuple(("", name) for name in "AFCG")

    n: tuple[int, int] = (1, 3)
    m: tuple[int, int] = (1, 2)
    p: tuple[int, int] = (1, 3)
    total: int = 5
    entries: tuple[Any, ...] = (Fraction(-1), Fraction(0), Fraction(1))
    prime: int | None = None
    number_field: NumberField | None = None

    def __str__(self) -> str:
        ranges = ", ".join(f"{low} <= {name} <= {high}" for name, (low, high) in (("n", self.n), ("m", self.m), ("p", self.p)))
        listed = ", ".join(map(str, self.entries))
        over = f" over {self.number_field}" if self.number_field else "" if self.prime is None else f" modulo {self.prime}"
        return f"{ranges}, n + m + p <= {self.total}, entries in {{{listed}}}{over}"

    @property
    def field(self) -> Field:
        """The field of the entries."""
        return self.number_field or (QQ if self.prime is None else PrimeField(self.prime))

    def sizes(self) -> list[Sizes]:
        """Return the (n, m, p) of the box in order."""
        n, m, p = (range(low, high + 1) for low, high in (self.n, self.m, self.p))
        found = product(n, m, p)
        return sorted((one for one in found if sum(one) <= self.total), key=lambda one: (sum(one), *one))

    def count(self, *sizes: int) -> int:
        """Return how many systems there are of these sizes."""
        n, m, p = sizes
        found: int = len(self.entries) ** ((n + p) * (n + m))
        return found

    def stretches(self, sizes: Sizes, *, reduced: bool) -> Iterator[Stretch]:
        """Yield all cases of these sizes in order; where `reduced`, fewer that stand for all. Raises OverflowError for too many."""
        for level in sorted({height(x) for x in self.entries}):
            entries = [x for x in self.entries if height(x) <= level]
            lower = any(height(x) < level for x in entries)
            for cases, weights in self.portions(sizes, entries, reduced=reduced):
                if not lower:
                    yield Stretch(cases, weights)
                    continue
                matrices = [cases.matrix(*name) for name in self.tables]
                high = np.flatnonzero(Scalars.of(entries, self.number_field).high(matrices, level))  # the others came with a lower one
                if len(high):
                    yield Stretch(cases.part(high), weights[high])

    def portions(self, sizes: Sizes, entries: list[Number], *, reduced: bool) -> Iterator[Portion]:
        """Yield the cases of these sizes with these entries, in order. Raises OverflowError for too many."""
        return systems_in_order(self, sizes, entries, changes(self, sizes, reduced=reduced))

    @property
    def signed(self) -> bool:
        """Whether the negative of each entry is an entry."""
        return {-x for x in self.entries} == set(self.entries)


@dataclass(frozen=True)
class Stretch:
    """Some cases of a box, in order, and for each how many it stands for."""

    batch: Any
    weights: NDArray[np.int64]


def changes(box: Box, sizes: tuple[int, ...], *, reduced: bool) -> tuple[list[Integers], ...]:
    """Return what renumbers states, faults and outputs and changes their signs, or nothing but what leaves them as they are."""
    signed = box.signed and box.prime != 2
    return tuple(_changes(k, signed) if reduced else [np.eye(k, dtype=np.int64)] for k in sizes)


def systems_in_order(box: Box, sizes: Sizes, entries: list[Number], group: tuple[list[Integers], ...]) -> Iterator[tuple[Batch, Integers]]:
    """Yield the systems with these entries, in order; the first of each orbit of the group alone, with the size of the orbit.

    The group has the changes of states, of faults and of outputs. Raises OverflowError where there are more than 2 10^6 matrices A, or more
    triples (F, C, G), of these sizes: they do not fit a table.
    """
    n, m, p = sizes
    base = len(entries)
    lengths = n * n, n * m + p * n + p * m
    if base ** max(lengths) > LARGEST_TABLE:
        raise OverflowError
    scalars = Scalars.of(entries, box.number_field)
    states, faults, outputs = group
    both = all((one[-1] == -one[0]).all() for one in group)
    states = states[: len(states) // 2] if both and n else states  # what -T does, T does with the negatives of outputs and faults
    every_A, stabilizers = _first_states(digits_of(base, lengths[0]), states, n, base)
    rest = digits_of(base, lengths[1])
    triples: dict[bytes, tuple[Integers, Integers]] = {}

    def of(stabilizer: NDArray[np.bool_]) -> tuple[Integers, Integers]:
        name = stabilizer.tobytes()
        if name not in triples:
            kept = [change for change, keeps in zip(states, stabilizer, strict=True) if keeps]
            triples[name] = _first_rests(rest, kept, (outputs, faults), (n, m, p), base)
        return triples[name]

    whole_group = len(states) * len(outputs) * len(faults)
    for chosen in _neighbours(every_A, stabilizers, lambda one: len(of(one)[0])):
        digits, weights = [], []
        for i in chosen:
            found, fixed = of(stabilizers[i])
            digits.append(np.concatenate([np.broadcast_to(every_A[i], (len(found), lengths[0])), found], axis=1))
            weights.append(whole_group // fixed)
        parts = np.split(places_of(np.concatenate(digits), base), np.cumsum([n * n, n * m, p * n]), axis=1)
        A, F, C, G = (scalars.matrices(part, *shape) for part, shape in zip(parts, ((n, n), (n, m), (p, n), (p, m)), strict=True))
        yield Batch(A, F, C, G, box.prime, scalars.scale, box.number_field), np.concatenate(weights)


@dataclass
class Share:
    """How much of the systems of some sizes one process went through; `whole` where that is all of its share."""

    systems: int = 0
    looked_at: int = 0
    whole: bool = True

    def stretches(self, box: Box, sizes: Sizes, left: int, mine: int, of: int, *, reduced: bool) -> Iterator[tuple[int, Stretch]]:
        """Yield every `of`th stretch with its number, from number `mine` on, until `left` systems are counted."""
        try:
            for number, stretch in enumerate(box.stretches(sizes, reduced=reduced)):
                if number % of != mine:
                    continue
                if self.systems >= left:
                    self.whole = False
                    break
                self.systems += int(stretch.weights.sum())
                self.looked_at += len(stretch.batch)
                yield number, stretch
        except OverflowError:
            self.whole = False


def _neighbours(every: Integers, stabilizers: NDArray[np.bool_], size: Callable[[NDArray[np.bool_]], int]) -> Iterator[list[int]]:
    """Yield the numbers of neighbouring matrices A with together some AT_ONCE systems."""
    portion: list[int] = []
    held = 0
    for i in range(len(every)):
        portion.append(i)
        held += size(stabilizers[i])
        if held >= AT_ONCE:
            yield portion
            portion, held = [], 0
    if portion:
        yield portion


def digits_of(base: int, length: int) -> Integers:
    """Return all vectors of odd or even numbers from 1 - base to base - 1, which are twice the digits less their mean, in order."""
    numbers = np.arange(base**length, dtype=np.int64)
    columns = [2 * (numbers // base**k % base) - (base - 1) for k in reversed(range(length))]
    return np.stack(columns, axis=1) if columns else np.zeros((1, 0), dtype=np.int64)


def places_of(digits: Integers, base: int) -> Integers:
    """Return which number of the box each digit stands for."""
    return (digits + (base - 1)) // 2


def _powers(base: int, length: int) -> Integers:
    return np.array([base**k for k in reversed(range(length))], dtype=np.int64)


def _changes(size: int, signed: bool) -> list[Integers]:
    """Return the matrices that renumber and, where `signed`, change signs; the second half are the negatives of the first."""
    unit = np.eye(size, dtype=np.int64)
    if factorial(size) * 2**size > MOST_CHANGES:  # then every system is looked at, if they fit a table at all
        return [unit]
    orders = [unit[list(order)] for order in permutations(range(size))]
    if not signed or not size:
        return orders
    half = [one * np.array([1, *signs])[:, None] for signs in product((1, -1), repeat=size - 1) for one in orders]
    return [*half, *(-one for one in half)]


def _first_states(digits: Integers, changes: list[Integers], n: int, base: int) -> tuple[Integers, NDArray[np.bool_]]:
    """Return the matrices A that come first in their orbits, and which changes leave each as it is."""
    powers = _powers(base, n * n)
    earlier = [powers - (T.T @ powers.reshape(n, n) @ T).ravel() for T in changes]
    for one in earlier:
        digits = digits[digits @ one <= 0]
    return digits, np.stack([digits @ one == 0 for one in earlier], axis=1)


def _first_rests(
    digits: Integers, kept: list[Integers], sides: tuple[list[Integers], list[Integers]], sizes: tuple[int, int, int], base: int
) -> tuple[Integers, Integers]:
    """Return the (F, C, G) that come first, and the number of changes that leave each as it is."""
    n, m, p = sizes
    powers = _powers(base, digits.shape[1])
    F, C, G = (
        part.reshape(shape) for part, shape in zip(np.split(powers, np.cumsum([n * m, p * n])), ((n, m), (p, n), (p, m)), strict=True)
    )
    return first_of_orbits(
        digits,
        [
            powers - np.concatenate([(T.T @ F @ V).ravel(), (U.T @ C @ T).ravel(), (U.T @ G @ V).ravel()])
            for T, U, V in product(kept, *sides)
        ],
    )


def first_of_orbits(digits: Integers, earlier: list[Integers]) -> tuple[Integers, Integers]:
    """Return the rows of digits that come first in their orbits, and how many changes leave each as it is.

    The product of a row with an entry of `earlier` is its number less that of what a change makes of it.
    """
    for one in earlier:
        digits = digits[digits @ one <= 0]
    fixed = np.zeros(len(digits), dtype=np.int64)
    for one in earlier:
        fixed += digits @ one == 0
    return digits, fixed


def rows_where(texts: tuple[str, ...], batch: Batch) -> Chosen:
    """Return of which systems all these expressions of the language are true."""
    rows = np.arange(len(batch))
    for text in texts:
        rows = rows[true_of(expression(text), batch, rows, Table())]
    return rows


expression = cache(read)


def of_sizes(box: Box, sizes: Sizes, *texts: str, reduced: bool = False) -> Iterator[ResidualSystem]:
    """Yield the systems of these sizes of which these expressions are true, in order; where `reduced`, the first of each orbit alone.

    Renumbering and changes of sign of states, outputs and faults leave the expressions as they are.
    """
    for stretch in box.stretches(sizes, reduced=reduced):
        for index in rows_where(texts, stretch.batch):
            yield stretch.batch.system(int(index))


def in_order(box: Box, *texts: str, reduced: bool = False) -> Iterator[ResidualSystem]:
    """Yield such systems of all sizes of the box, in order."""
    for sizes in box.sizes():
        yield from of_sizes(box, sizes, *texts, reduced=reduced)


def grouped(box: Box, key: Callable[[ResidualSystem], object], *texts: str) -> Iterator[tuple[ResidualSystem, list[ResidualSystem]]]:
    """Yield the systems of which these expressions are true, in order, each with all of those of its sizes that have its key."""
    for sizes in box.sizes():
        systems = list(of_sizes(box, sizes, *texts))
        keys = [key(system) for system in systems]
        groups: dict[object, list[ResidualSystem]] = defaultdict(list)
        for system, name in zip(systems, keys, strict=True):
            groups[name].append(system)
        for system, name in zip(systems, keys, strict=True):
            yield system, groups[name]


def matrices_in_order(rows: int, columns: int) -> Iterator[Matrix]:
    """Yield every matrix over Q of this shape with entries -1, 0 and 1, by rows, -1 before 0 before 1."""
    for entries in product((-1, 0, 1), repeat=rows * columns):
        yield Matrix.of([list(entries[i * columns : (i + 1) * columns]) for i in range(rows)], shape=(rows, columns))
