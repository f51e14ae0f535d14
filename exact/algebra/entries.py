"""Entries of a matrix as people pass them in: nested lists, numpy's arrays, sympy's matrices, as rows of entries that are not read yet.

rows_of     the rows, checked for ragged ones, and the shape
integers    all entries, where they are plain integers
not_rows    the message that something is no list of rows
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import chain
from typing import TYPE_CHECKING, Any

from ...base.errors import InvalidInput, shorten
from ...base.sheets import counted
from .fields import Field, NumberField
from .sympy_values import is_domain_matrix, is_matrix
from .validation import MAX_BITS

if TYPE_CHECKING:
    from sympy.polys.domains import AlgebraicField
    from sympy.polys.matrices import DomainMatrix


def rows_of(entries: object, field: Field, shape: tuple[int, int] | None, where: str) -> tuple[list[list[object]], tuple[int, int]]:
    """Nested lists of the entries and the shape they have, checked for ragged rows and against `shape`."""
    if is_domain_matrix(entries):
        found = (int(entries.shape[0]), int(entries.shape[1]))
        rows = _of_domain_matrix(entries, field, where)
    elif is_matrix(entries):
        found = (int(entries.rows), int(entries.cols))
        rows = [list(entries.row(i)) for i in range(entries.rows)]
    elif isinstance(entries := _listed(entries, where), (list, tuple)):
        rows = []
        for i, row in enumerate(entries):
            if not isinstance(row, (list, tuple)):
                raise InvalidInput(f"{where}[{i}]: got {shorten(row)}, expected a row: a list of entries")
            rows.append(list(row))
        found = (len(rows), len(rows[0]) if rows else 0)
        for i, row in enumerate(rows):
            if len(row) != found[1]:
                raise InvalidInput(f"{where}[{i}]: got {counted(len(row), 'entry', 'entries')}, expected {found[1]} as in the first row")
        if shape is not None and 0 in shape and found in ((0, 0), (shape[0], 0)):
            found = shape  # [] and the right number of empty rows stand for every empty matrix
    else:
        raise InvalidInput(not_rows(entries, where))
    if shape is not None and found != shape:
        raise InvalidInput(f"{where}: got shape {found[0]} x {found[1]}, expected {shape[0]} x {shape[1]}")
    return rows if found[1] else [[] for _ in range(found[0])], found


def integers(rows: Sequence[Sequence[object]]) -> list[int] | None:
    """Return the entries where all are plain integers of a size that is supported: most matrices are, and are read ten times faster."""
    numbers: list[Any] = [*chain.from_iterable(rows)]
    if not {*map(type, numbers)} <= {int}:
        return None
    return numbers if max(map(int.bit_length, {*numbers}), default=0) <= MAX_BITS else None


def not_rows(entries: object, where: str) -> str:
    """The message that this is no list of rows, with what to try where that is known."""
    said = f"{where}: got {shorten(entries)}, expected a list of rows"
    if isinstance(entries, (int, Fraction, str)) and not isinstance(entries, bool):
        return f"{said}, try [[{shorten(entries)}]]"
    if hasattr(entries, "residual"):
        return f"{said} or a Matrix, one of the system's: try .A, .F, .C or .G"
    return said


def _listed(entries: Any, where: str) -> Any:
    """A numpy array of integers, or of objects, as the nested lists that it holds; anything else as it is. numpy is not loaded for it."""
    kind = getattr(getattr(entries, "dtype", None), "kind", None)
    if kind is None or not hasattr(entries, "tolist") or getattr(entries, "ndim", None) != 2:
        return entries
    if kind == "f":
        raise InvalidInput(f"{where}: got {shorten(entries)}, expected a list of rows (floats are not exact; see from_float_exactly)")
    return entries.tolist() if kind in "iuO" and entries.shape[1] else entries


def _of_domain_matrix(entries: DomainMatrix, field: Field, where: str) -> list[list[object]]:
    from sympy.polys.domains import AlgebraicField  # loaded before, for there is a DomainMatrix

    if not isinstance(entries.domain, AlgebraicField):
        table = entries.to_Matrix()
        return [list(table.row(i)) for i in range(table.rows)]
    if not isinstance(field, NumberField) or field != NumberField(_ascending(entries.domain.mod)):
        raise InvalidInput(f"{where}: got entries over {entries.domain}, expected {field}")
    return [[_coordinates(x, entries.domain) for x in row] for row in entries.to_list()]


def _coordinates(element: Any, domain: AlgebraicField) -> list[Fraction]:
    """Return the rational coordinates, ascending, of an element of sympy's QQ<a>."""
    descending = [Fraction(int(c.numerator), int(c.denominator)) for c in element.to_list()]
    size = int(domain.mod.degree())
    return descending[::-1] + [Fraction(0)] * (size - len(descending))


def _ascending(poly: Any) -> tuple[Fraction, ...]:
    return tuple(Fraction(int(c.numerator), int(c.denominator)) for c in reversed(poly.to_list()))
