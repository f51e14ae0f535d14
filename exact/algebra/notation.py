"""This writes exact objects in the notation of the field, as plain text for tables.

entry              one field element; long ones are cut in the middle
polynomial         coefficients by ascending power as a polynomial in q
matrix_lines       a matrix as lines of aligned columns; large ones lose their middle
field_words        the name of a field
named_matrix       a matrix as lines of a sheet
several            a list of numbers on one line
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from .fields import QQ, Field, NumberField
from .matrices import Matrix
from .writing import sum_of_powers

LONGEST_ENTRY = 40
MOST_ROWS, MOST_COLUMNS, MOST_NUMBERS = 24, 12, 24


def entry(element: Any, field: Field) -> str:
    """Return a field element: p/q, or a polynomial in a over Q(a)."""
    if isinstance(field, NumberField):
        return _cut(sum_of_powers([str(c) for c in field.coordinates(element)], "a"))
    return _cut(str(field.write(element)))


def polynomial(coefficients: Sequence[Any], field: Field, unknown: str = "q") -> str:
    """Return the polynomial with these ascending coefficients, highest power first."""
    return sum_of_powers([entry(c, field) for c in coefficients], unknown)


def field_words(field: Field) -> str:
    """Return the field as people name it, a number field by the polynomial whose root it adjoins."""
    if isinstance(field, NumberField):
        return f"Q(a), where a is a root of {polynomial([QQ.element(c) for c in field.minimal_polynomial], QQ, 'a')}"
    return str(field)


def matrix_lines(matrix: Matrix) -> list[str]:
    """Each line of the result is a row of the matrix; there is none for a matrix without entries."""
    if 0 in matrix.shape:
        return []
    across = _chosen(matrix.ncols, MOST_COLUMNS)
    down = _chosen(matrix.nrows, MOST_ROWS)
    table = [["..." if None in (i, j) else entry(matrix[i, j], matrix.field) for j in across] for i in down]  # type: ignore[index]
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    return ["[ " + "  ".join(x.rjust(w) for x, w in zip(row, widths, strict=True)) + " ]" for row in table]


def named_matrix(name: str, matrix: Matrix) -> Iterator[tuple[str, str]]:
    """The matrix makes lines of a sheet, the first of which has the name."""
    lines = matrix_lines(matrix) or [f"empty, {matrix.nrows} x {matrix.ncols}"]
    yield from ((name if i == 0 else "", line) for i, line in enumerate(lines))


def several(numbers: Sequence[int], *, none: str = "none") -> str:
    """The result has the numbers with spaces between them, and of many numbers only the first."""
    if not numbers:
        return none
    text = " ".join(map(str, numbers[:MOST_NUMBERS]))
    return text if len(numbers) <= MOST_NUMBERS else f"{text} ... ({len(numbers)} in all)"


def _cut(text: str) -> str:
    if len(text) <= LONGEST_ENTRY:
        return text
    half = LONGEST_ENTRY // 2 - 8
    return f"{text[:half]}..({len(text)} long)..{text[-half:]}"


def _chosen(size: int, most: int) -> list[int | None]:
    """The indices to show; None stands for those left out."""
    if size <= most:
        return list(range(size))
    return [*range(most - 2), None, size - 1]
