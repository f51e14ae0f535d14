"""These are matrices over a field and textbook Gaussian elimination.

Matrix(field, height, width, rows)   the shape is always explicit, so that 0 x k and k x 0 are matrices like others
zeros, identity, unit_vector, column_of
beside(a, b, ...), above(a, b, ...)  [a b ...] and the same downwards
a @ b, a + b, a.T, a.column(j), a.entries()
rref(a)             reduced row echelon form without its zero rows, and the columns of its pivots
rank(a)
null_space(a)       k x width, its rows a basis of { x : a x = 0 }
left_null_space(a)  k x height, its rows a basis of { y : y a = 0 }
solve(a, b)         some x with a x = b, or None
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from .fields import Element, Field


@dataclass(frozen=True)
class Matrix:
    """A height x width matrix over `field`, its rows tuples of elements; raises ValueError when they are not."""

    field: Field
    height: int
    width: int
    rows: tuple[tuple[Element, ...], ...]

    def __post_init__(self) -> None:
        if len(self.rows) != self.height or any(len(row) != self.width for row in self.rows):
            raise ValueError(f"the rows do not make a {self.height} x {self.width} matrix")

    def __add__(self, other: Matrix) -> Matrix:
        if (self.height, self.width) != (other.height, other.width):
            raise ValueError("matrices of different shapes are added")
        rows = ([x + y for x, y in zip(a, b, strict=True)] for a, b in zip(self.rows, other.rows, strict=True))
        return matrix(self.field, self.height, self.width, rows)

    def __matmul__(self, other: Matrix) -> Matrix:
        if self.width != other.height:
            raise ValueError("matrices are multiplied whose inner dimensions differ")
        columns = other.T.rows
        rows = ([_dot(row, column, self.field.zero) for column in columns] for row in self.rows)
        return matrix(self.field, self.height, other.width, rows)

    @property
    def T(self) -> Matrix:
        """This is the transpose."""
        rows = ([row[j] for row in self.rows] for j in range(self.width))
        return matrix(self.field, self.width, self.height, rows)

    def column(self, j: int) -> Matrix:
        """The result is column j, height x 1."""
        return matrix(self.field, self.height, 1, ([row[j]] for row in self.rows))

    def columns(self, start: int, stop: int) -> Matrix:
        """The result has the columns start..stop-1."""
        return matrix(self.field, self.height, stop - start, (row[start:stop] for row in self.rows))

    def entries(self) -> tuple[Element, ...]:
        """These are all entries, row by row."""
        return tuple(x for row in self.rows for x in row)

    def is_zero(self) -> bool:
        return not any(self.entries())


def matrix(field: Field, height: int, width: int, rows: Iterable[Sequence[Element]]) -> Matrix:
    """A Matrix from any rows; raises ValueError when they are not height x width."""
    return Matrix(field, height, width, tuple(tuple(row) for row in rows))


def zeros(field: Field, height: int, width: int) -> Matrix:
    """The result is the height x width matrix of zeros."""
    return matrix(field, height, width, [[field.zero] * width for _ in range(height)])


def identity(field: Field, n: int) -> Matrix:
    """The result is the n x n identity."""
    return matrix(field, n, n, [[field.one if i == j else field.zero for j in range(n)] for i in range(n)])


def column_of(field: Field, entries: Sequence[Element]) -> Matrix:
    """These are the entries as one column."""
    return matrix(field, len(entries), 1, [[x] for x in entries])


def unit_vector(field: Field, n: int, i: int) -> Matrix:
    """The result is the i-th unit vector, n x 1."""
    return identity(field, n).column(i)


def above(first: Matrix, *others: Matrix) -> Matrix:
    """The result has the matrices one above the other."""
    rows = [row for a in (first, *others) for row in a.rows]
    return matrix(first.field, len(rows), first.width, rows)


def beside(first: Matrix, *others: Matrix) -> Matrix:
    """The result has the matrices side by side."""
    return above(first.T, *(a.T for a in others)).T


def rref(a: Matrix) -> tuple[Matrix, list[int]]:
    """The result is the reduced row echelon form (rank x width, no zero rows) and its pivot columns."""
    rows = [list(row) for row in a.rows]
    pivots: list[int] = []
    for j in range(a.width):
        done = len(pivots)
        found = next((i for i in range(done, a.height) if rows[i][j]), None)
        if found is None:
            continue
        rows[done], rows[found] = rows[found], rows[done]
        pivot = rows[done][j]
        rows[done] = [x / pivot if x else x for x in rows[done]]
        for i in range(a.height):
            factor = rows[i][j]
            if i != done and factor:
                rows[i] = [x - factor * y if y else x for x, y in zip(rows[i], rows[done], strict=True)]
        pivots.append(j)
    return matrix(a.field, len(pivots), a.width, rows[: len(pivots)]), pivots


def rank(a: Matrix) -> int:
    """The rank is the number of rows of the echelon form."""
    return len(rref(a)[1])


def null_space(a: Matrix) -> Matrix:
    """The result is a basis of { x : a x = 0 }, its vectors as the rows of a k x width matrix."""
    reduced, pivots = rref(a)
    basis = []
    for free in (j for j in range(a.width) if j not in pivots):
        vector = [a.field.zero] * a.width
        vector[free] = a.field.one
        for row, pivot in zip(reduced.rows, pivots, strict=True):
            vector[pivot] = -row[free]
        basis.append(vector)
    return matrix(a.field, len(basis), a.width, basis)


def left_null_space(a: Matrix) -> Matrix:
    """The result is a basis of { y : y a = 0 }, its vectors as the rows of a k x height matrix."""
    return null_space(a.T)


def solve(a: Matrix, b: Matrix) -> Matrix | None:
    """The result is some x with a x = b, or None when there is none."""
    reduced, pivots = rref(beside(a, b))
    if any(pivot >= a.width for pivot in pivots):
        return None
    x = [[a.field.zero] * b.width for _ in range(a.width)]
    for row, pivot in zip(reduced.rows, pivots, strict=True):
        x[pivot] = list(row[a.width :])
    return matrix(a.field, a.width, b.width, x)


def _dot(a: Sequence[Element], b: Sequence[Element], zero: Element) -> Element:
    total = zero
    for x, y in zip(a, b, strict=True):
        if x and y:
            total = total + x * y
    return total
