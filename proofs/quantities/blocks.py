"""Tables of matrices whose entries are few numbers of a field: over Q(a) each number is the integer block by which it multiplies.

    Scalars          the numbers of a box, as integers over one denominator, as residues, or, over Q(a), as d x d blocks
    exactly          one matrix of a table as an exact one
    lifted           matrices of integers as matrices of blocks
    height           the largest numerator or denominator of a number, of its coordinates over Q(a)

A number field costs no algorithm of its own (`exact/algebra/fields.py`): a matrix of blocks over Q has d times the rank of the one over
Q(a), and sums, products and stacks of blocks are those of the numbers. Transposing is the one thing that has to be done block by block.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exact.algebra.fields import QQ, AlgebraicNumber, NumberField, PrimeField
from ...exact.algebra.matrices import Matrix
from .elimination import Integers

Number = Fraction | AlgebraicNumber


@dataclass(frozen=True)
class Scalars:
    """`values` (count, d, d) are the numbers, times `scale`; `heights` how large each is."""

    values: Integers
    scale: int
    heights: tuple[int, ...]

    @staticmethod
    def of(entries: Sequence[Number], field: NumberField | None) -> Scalars:
        """Return those of these numbers, in their order; `field` is None but over Q(a)."""
        if field is None:
            blocks = [[[Fraction(x)]] for x in entries if isinstance(x, Fraction)]
        else:
            blocks = [[[Fraction(int(c.p), int(c.q)) for c in row] for row in field.block(field.element(x))] for x in entries]
        scale = lcm(*(c.denominator for block in blocks for row in block for c in row))
        table = [[[int(c * scale) for c in row] for row in block] for block in blocks]
        d = 1 if field is None else field.degree
        return Scalars(np.array(table, dtype=np.int64).reshape(len(table), d, d), scale, tuple(map(height, entries)))

    @property
    def degree(self) -> int:
        """d, the degree of the field."""
        return int(self.values.shape[1])

    def matrices(self, places: Integers, rows: int, columns: int) -> Integers:
        """Return the matrices (N, rows d, columns d) whose entries are the numbers at these places (N, rows columns)."""
        count, d = len(places), self.degree
        blocks = self.values[places].reshape(count, rows, columns, d, d)
        return np.swapaxes(blocks, 2, 3).reshape(count, rows * d, columns * d)

    def high(self, matrices: Sequence[Integers], level: int) -> NDArray[np.bool_]:
        """Return in which rows of these tables some entry is a number of this height."""
        count, d = len(matrices[0]), self.degree
        found = np.zeros(count, dtype=bool)
        wanted = [one[0] for one, at in zip(self.values, self.heights, strict=True) if at == level]
        for table in matrices:
            rows, columns = table.shape[1] // d, table.shape[2] // d
            entries = table.reshape(count, rows, d, columns, d)[:, :, 0].reshape(count, rows * columns, d)
            for one in wanted:
                found |= (entries == one).all(axis=2).any(axis=1)
        return found


def exactly(table: Integers, denominator: int, field: NumberField | None, prime: int | None) -> Matrix:
    """Return one matrix of a table, of integers over the denominator, as an exact one."""
    d = 1 if field is None else field.degree
    rows, columns = table.shape[0] // d, table.shape[1] // d
    if prime is not None:
        return Matrix.of(table.tolist(), PrimeField(prime), shape=(rows, columns))
    fractions = table.tolist() if denominator == 1 else [[Fraction(x, denominator) for x in row] for row in table.tolist()]
    if field is None:
        return Matrix.of(fractions, QQ, shape=(rows, columns))
    tops = fractions[::d]  # the first row of a block has the coordinates of its number
    entries: list[list[Any]] = [[row[j * d : (j + 1) * d] for j in range(columns)] for row in tops]
    return Matrix.of(entries, field, shape=(rows, columns))


def lifted(table: Integers, degree: int) -> Integers:
    """Return the matrices of integers with each as a block, a multiple of the identity."""
    count, height, width = table.shape
    blocks = table[:, :, None, :, None] * np.eye(degree, dtype=np.int64)[:, None, :]
    return blocks.reshape(count, height * degree, width * degree)


def transposed(table: Integers, degree: int) -> Integers:
    """Return the transposed matrices, each block as it was."""
    count, height, width = table.shape
    blocks = table.reshape(count, height // degree, degree, width // degree, degree)
    return blocks.transpose(0, 3, 2, 1, 4).reshape(count, width, height)


def height(x: Number) -> int:
    """Return the larger of numerator and denominator, without sign, of a number or of its coordinates."""
    if isinstance(x, AlgebraicNumber):
        return max(height(Fraction(int(c.p), int(c.q))) for c in x.field.coordinates(x))
    return max(abs(x.numerator), x.denominator)
