"""Many cases of the same sizes, one a row, and what is found out about all of them together.

Many         systems (`Batch`), pairs (`Pairs`): what the language asks of them when it decides many at once
Both         cases that have two systems each
Column       the numbers of a family for some of the cases, found once
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from ...exact.algebra.fields import NumberField
from .cases import Case
from .elimination import Integers, Overflow, times

Chosen = NDArray[np.intp]


@dataclass
class Column:
    """The numbers of a family, and for which cases they have been found."""

    done: NDArray[np.bool_]
    values: Integers


class Many(ABC):
    """Cases over Q (`prime` None), GF(prime) or a number field, of integers over one `denominator`; `own` are the quantities of
    the whole. Over a number field of degree d each entry of a matrix is a block d x d (`blocks.py`).
    """

    prime: int | None
    number_field: NumberField | None
    denominator: int
    own: Mapping[str, Any]
    _columns: dict[object, Column]

    @abstractmethod
    def __len__(self) -> int:
        """The number of cases."""

    @property
    @abstractmethod
    def sizes(self) -> Mapping[str, tuple[int, int, int]]:
        """(n, m, p) of each system of a case, which all cases share."""

    @property
    def degree(self) -> int:
        """The number of rows of a block: 1 but over a number field."""
        return 1 if self.number_field is None else self.number_field.degree

    @property
    def samples(self) -> int:
        """The number of samples of each case, where it has some."""
        return 0

    @abstractmethod
    def case(self, index: int) -> Case:
        """Return one of the cases, as an exact one."""

    @abstractmethod
    def matrix(self, subject: str, name: str) -> Integers:
        """Return a matrix of every case (N, rows, columns)."""

    @abstractmethod
    def part(self, rows: Chosen) -> Self:
        """Return the cases of these rows alone."""

    @abstractmethod
    def column(self, key: Any, rows: Chosen, find: Callable[[Any], Integers] | None = None) -> Integers:
        """Return the numbers (len(rows), width) of a family, or of what `find` finds, for the cases of these rows. Raises Overflow."""

    def product(self, left: Integers, right: Integers) -> Integers:
        """Return the products of matrices, reduced over GF(prime). Raises Overflow."""
        found = times(left, right)
        return found if self.prime is None else found % self.prime

    def kept(self, key: object, rows: Chosen, find: Callable[[Self], Integers]) -> Integers:
        """Return what `find` finds for these rows, which is found once; narrower rows are filled up with zeros. Raises Overflow."""
        if self.denominator != 1:
            raise Overflow("numbers over a denominator")
        if key not in self._columns:
            self._columns[key] = Column(np.zeros(len(self), dtype=bool), np.zeros((len(self), 0), dtype=np.int64))
        column = self._columns[key]
        missing = rows[~column.done[rows]]
        if len(missing):
            found = find(self.part(missing))
            if column.values.shape[1] < found.shape[1]:
                wider = np.zeros((len(self), found.shape[1]), dtype=np.int64)
                wider[:, : column.values.shape[1]] = column.values
                column.values = wider
            column.values[missing, : found.shape[1]] = found
            column.done[missing] = True
        return column.values[rows]


class Both(Many):
    """Case i has the system `firsts[i]` of `first` and the system `seconds[i]` of `second`; `called` are the names of the two."""

    called: ClassVar[tuple[str, str]]
    first: Any
    firsts: Chosen
    second: Any
    seconds: Chosen

    def __len__(self) -> int:
        return len(self.firsts)

    @property
    def prime(self) -> int | None:  # type: ignore[override]
        """That of the systems."""
        found: int | None = self.first.prime
        return found

    @property
    def number_field(self) -> NumberField | None:  # type: ignore[override]
        """That of the systems."""
        found: NumberField | None = self.first.number_field
        return found

    @property
    def denominator(self) -> int:  # type: ignore[override]
        """That of all entries."""
        return int(self.first.denominator)

    @property
    def sizes(self) -> Mapping[str, tuple[int, int, int]]:
        """n, m, p of both systems."""
        return {name: (one.n, one.m, one.p) for name, one in zip(self.called, (self.first, self.second), strict=True)}

    def systems(self, subject: str) -> tuple[Any, Chosen]:
        """Return the systems with this name, those of all cases together, and which of them each case has."""
        return (self.second, self.seconds) if subject == self.called[1] else (self.first, self.firsts)

    def of_system(self, key: Any, rows: Chosen) -> Integers:
        """Return the numbers of a family of one of the two systems, of the first where the key names none. Raises Overflow."""
        subject, family = key if isinstance(key, tuple) else (self.called[0], key)
        batch, places = self.systems(subject)
        distinct, which = np.unique(places[rows], return_inverse=True)
        found: Integers = batch.column(family, distinct)[which]
        return found
