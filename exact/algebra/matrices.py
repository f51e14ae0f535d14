"""These are immutable exact matrices over any of the three fields, and the linear algebra that everything else is written in.

    Matrix                  nrows x ncols over `field`; zero dimensions are ordinary
    beside, stacked         [X Y], [X; Y]
    rank, row_echelon       the reduced row echelon form with its pivot columns (RowEchelon)
    column_basis            a basis of the column space: n x rank
    right_null_space        columns spanning {x : M x = 0}
    left_null_space         rows spanning {y : y M = 0}
    row_profile             indices of the rows that do not depend on the rows above them
    solve_left              X with X M = R, or None

Inside, a matrix is the flint matrix of the blocks of its entries (`fields`), so that one code serves Q, GF(p) and Q(a).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from flint import fmpq_mat, fmpz, fmpz_mat, nmod_mat

from ...base.errors import InvalidInput
from .entries import integers, rows_of
from .fields import QQ, Field, NumberField, PrimeField, Rationals, base_matrix, base_zero
from .validation import fits, natural

if TYPE_CHECKING:
    import sympy

PRIME = 2**61 - 1


@dataclass(frozen=True, eq=False, init=False)
class Matrix:
    """An immutable matrix of shape nrows x ncols over one of the three kinds of field; a dimension may be zero.

    `Matrix.of` makes one from nested lists, sympy matrices and so on, `Matrix.zero` and `Matrix.identity` make those two. `+`, `-` and `@`
    stay within one field, `matrix[i, j]` is a field element, `rows` and `columns` choose, `to_json` and `to_sympy` write. Two matrices are
    equal where field, shape and entries are.

    Raises InvalidInput, in `Matrix.of`, for ragged rows, a shape that does not agree and entries outside the field, for sizes that are no
    integers >= 0, and where matrices over different fields or of shapes that do not fit are combined.

    >>> from faultspace.exact import Matrix
    >>> M = Matrix.of([["1/2", 1], [0, 2]])
    >>> M @ M
    [[1/4, 5/2], [0, 4]]
    >>> M.shape, M[0, 0], M.to_json()
    ((2, 2), 1/2, [['1/2', '1'], ['0', '2']])
    """

    field: Field
    nrows: int
    ncols: int
    flint: Any

    def __init__(self, field: Field, nrows: int, ncols: int, flint: Any) -> None:
        # What a dataclass makes of this for a frozen record takes three times as long, and it is called more often than all else here.
        entries = self.__dict__
        entries["field"], entries["nrows"], entries["ncols"], entries["flint"] = field, nrows, ncols, flint

    @staticmethod
    def of(entries: object, field: Field = QQ, *, shape: tuple[int, int] | None = None, where: str = "matrix") -> Matrix:
        """A matrix from nested sequences, a numpy array of integers, a sympy Matrix or DomainMatrix; `shape` is needed for empty ones.

        Entries are what `field.element` takes: integers, rational strings, Fractions, sympy Rationals; never floats.
        Raises InvalidInput for ragged rows, a shape that does not agree, entries outside the field.
        """
        if isinstance(entries, Matrix):
            if entries.field != field:
                raise InvalidInput(f"{where}: got entries over {entries.field}, expected {field}")
            if shape is not None and entries.shape != shape:
                raise InvalidInput(f"{where}: got shape {entries.nrows} x {entries.ncols}, expected {shape[0]} x {shape[1]}")
            return entries
        rows, shape = rows_of(entries, field, shape, where)
        nrows, ncols = shape
        if isinstance(field, Rationals) and (numbers := integers(rows)) is not None:
            return Matrix(field, nrows, ncols, fmpq_mat(fmpz_mat(nrows, ncols, numbers)))
        try:
            elements = [[field.element(x) for x in row] for row in rows]
        except InvalidInput:  # once more, now with the place in words
            elements = [[field.element(x, f"{where}[{i}][{j}]") for j, x in enumerate(row)] for i, row in enumerate(rows)]
        return Matrix.from_elements(field, nrows, ncols, elements)

    @staticmethod
    def from_elements(field: Field, nrows: int, ncols: int, rows: Sequence[Sequence[Any]]) -> Matrix:
        """Return a matrix from rows of field elements, unchecked."""
        d = field.degree
        if d == 1 and not isinstance(field, NumberField):
            return Matrix(field, nrows, ncols, base_matrix(field, nrows, ncols, [x for row in rows for x in row]))
        scalars: list[Any] = []
        for row in rows:
            blocks = [field.block(x) for x in row]
            for i in range(d):
                for block in blocks:
                    scalars.extend(block[i])
        return Matrix(field, nrows, ncols, base_matrix(field, nrows * d, ncols * d, scalars))

    @staticmethod
    def zero(field: Field, nrows: int, ncols: int) -> Matrix:
        """Return the zero matrix. Raises InvalidInput for sizes that are no integers >= 0, or too large for any memory."""
        fits(natural(nrows, "nrows"), natural(ncols, "ncols"), "matrix")
        d = field.degree
        return Matrix(field, nrows, ncols, base_zero(field, nrows * d, ncols * d))

    @staticmethod
    def identity(field: Field, size: int) -> Matrix:
        """Return the identity matrix. Raises InvalidInput for a size that is no integer >= 0, or too large for any memory."""
        fits(natural(size, "size"), size, "matrix")
        k = size * field.degree
        unit = base_zero(field, k, k)
        for i in range(k):
            unit[i, i] = 1
        return Matrix(field, size, size, unit)

    @property
    def shape(self) -> tuple[int, int]:
        """The shape is (nrows, ncols)."""
        return (self.nrows, self.ncols)

    def __getitem__(self, index: tuple[int, int]) -> Any:
        """Return the field element in row i, column j (non-negative indices)."""
        i, j = index
        d = self.field.degree
        if not isinstance(self.field, NumberField):
            return self.flint[i, j]
        return self.field.from_coordinates([self.flint[i * d, j * d + c] for c in range(d)])

    def elements(self) -> list[list[Any]]:
        """The result has all entries as rows of field elements."""
        if not isinstance(self.field, NumberField):
            table: list[list[Any]] = self.flint.tolist()
            return table
        d = self.field.degree
        table = self.flint.tolist()
        take = self.field.from_coordinates
        return [[take(table[i * d][j * d : j * d + d]) for j in range(self.ncols)] for i in range(self.nrows)]

    def to_json(self) -> list[list[object]]:
        """The result has the rows of entries as the exact file formats write them."""
        if isinstance(self.field, Rationals):
            numerators, denominator = self.flint.numer_denom()
            if denominator == 1:
                numbers = [*map(int, numerators.entries())]
                written = [*map({x: str(x) for x in {*numbers}}.__getitem__, numbers)]
                return [[*written[i * self.ncols : (i + 1) * self.ncols]] for i in range(self.nrows)]
        return [[self.field.write(x) for x in row] for row in self.elements()]

    def to_sympy(self) -> sympy.ImmutableMatrix:
        """Return the sympy matrix: Rational entries over Q, integers over GF(p), polynomials in the symbol a over Q(a)."""
        import sympy  # here, where it is needed

        a = sympy.Symbol("a")

        def one(x: Any) -> sympy.Expr:
            if isinstance(self.field, PrimeField):
                return sympy.Integer(int(x))
            coordinates = self.field.coordinates(x) if isinstance(self.field, NumberField) else [x]
            return sympy.Add(*(sympy.Rational(int(c.p), int(c.q)) * a**k for k, c in enumerate(coordinates)))

        return sympy.ImmutableMatrix(self.nrows, self.ncols, [one(x) for row in self.elements() for x in row])

    def is_zero(self) -> bool:
        """This tells whether every entry is zero."""
        return not self.flint

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Matrix):
            return NotImplemented
        return self.field == other.field and self.shape == other.shape and bool(self.flint == other.flint)

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        if isinstance(self.field, PrimeField):
            return hash((self.field, self.shape, tuple(map(int, self.flint.entries()))))
        numerators, denominator = self.flint.numer_denom()
        return hash((self.field, self.shape, tuple(map(int, numerators.entries())), int(denominator)))

    def __reduce__(self) -> tuple[Any, ...]:
        return Matrix, (self.field, self.nrows, self.ncols, self.flint)

    def __str__(self) -> str:
        rows = ["[" + ", ".join(str(x) for x in row) + "]" for row in self.elements()]
        return "[" + ", ".join(rows) + "]" if rows else f"[{self.nrows} x {self.ncols}]"

    __repr__ = __str__

    def __matmul__(self, other: Matrix) -> Matrix:
        other = self._mixes_with(other)
        if self.ncols != other.nrows:
            raise InvalidInput(f"@: got {_size(self)} and {_size(other)}, expected as many columns on the left as rows on the right")
        return Matrix(self.field, self.nrows, other.ncols, self.flint * other.flint)

    def __add__(self, other: Matrix) -> Matrix:
        other = self._of_equal_shape(other, "+")
        return Matrix(self.field, self.nrows, self.ncols, self.flint + other.flint)

    def _mixes_with(self, other: object) -> Matrix:
        """Return the other operand as a Matrix over the same field; nested lists become one."""
        other = as_matrix(other, "the other matrix", self.field)
        if self.field is not other.field and self.field != other.field:
            raise InvalidInput(
                f"matrices over {self.field} and over {other.field} do not mix, expected one field: build both over the same one"
            )
        return other

    def _of_equal_shape(self, other: object, sign: str) -> Matrix:
        other = self._mixes_with(other)
        if self.shape != other.shape:
            raise InvalidInput(f"{sign}: got {_size(self)} and {_size(other)}, expected equal shapes")
        return other

    def __sub__(self, other: Matrix) -> Matrix:
        other = self._of_equal_shape(other, "-")
        return Matrix(self.field, self.nrows, self.ncols, self.flint - other.flint)

    def __neg__(self) -> Matrix:
        return Matrix(self.field, self.nrows, self.ncols, -self.flint)

    def transposed(self) -> Matrix:
        """Return the transpose, entry by entry (for number fields not the transpose of the block matrix)."""
        if not isinstance(self.field, NumberField):
            return Matrix(self.field, self.ncols, self.nrows, self.flint.transpose())
        rows = self.elements()
        return Matrix.from_elements(self.field, self.ncols, self.nrows, [[row[j] for row in rows] for j in range(self.ncols)])

    def rows(self, indices: Iterable[int]) -> Matrix:
        """Return the matrix of these rows, in this order."""
        d = self.field.degree
        chosen, width = [i * d + c for i in indices for c in range(d)], self.ncols * d
        scalars = [self.flint[i, j] for i in chosen for j in range(width)]  # not the whole table, which may be long
        return Matrix(self.field, len(chosen) // d, self.ncols, base_matrix(self.field, len(chosen), width, scalars))

    def columns(self, indices: Iterable[int]) -> Matrix:
        """Return the matrix of these columns, in this order."""
        d = self.field.degree
        wanted = [j * d + c for j in indices for c in range(d)]
        scalars = [self.flint[i, j] for i in range(self.nrows * d) for j in wanted]
        return Matrix(self.field, self.nrows, len(wanted) // d, base_matrix(self.field, self.nrows * d, len(wanted), scalars))


@dataclass(frozen=True)
class RowEchelon:
    """The nonzero rows of a reduced row echelon form, and the column of the leading 1 of each."""

    matrix: Matrix
    pivots: tuple[int, ...]


def as_matrix(given: object, where: str = "matrix", field: Field = QQ) -> Matrix:
    """Return the Matrix that is given, over whatever field it is, or what `Matrix.of` makes of nested lists. Raises InvalidInput."""
    return given if isinstance(given, Matrix) else Matrix.of(given, field, where=where)


def beside(*parts: Matrix) -> Matrix:
    """Return [X Y ...]: matrices with the same number of rows, side by side."""
    first = parts[0]
    ncols = sum(part.ncols for part in parts)
    tables = [part.flint.tolist() for part in parts]
    scalars = [x for rows in zip(*tables, strict=True) for row in rows for x in row]
    d = first.field.degree
    return Matrix(first.field, first.nrows, ncols, base_matrix(first.field, first.nrows * d, ncols * d, scalars))


def stacked(*parts: Matrix) -> Matrix:
    """Return [X; Y; ...]: matrices with the same number of columns, one above the other."""
    first = parts[0]
    nrows = sum(part.nrows for part in parts)
    scalars = [x for part in parts for x in part.flint.entries()]
    d = first.field.degree
    return Matrix(first.field, nrows, first.ncols, base_matrix(first.field, nrows * d, first.ncols * d, scalars))


def rank(matrix: Matrix) -> int:
    """Return the rank of an nrows x ncols matrix over its field; that of an empty one is 0.

    Parameters
    ----------
    matrix : Matrix, shape (nrows, ncols)
        Nested lists are taken over Q.

    Returns
    -------
    int

    Raises
    ------
    InvalidInput
        For what is no matrix; nothing for a Matrix of any shape.

    Examples
    --------
    >>> from faultspace.exact import Matrix, PrimeField, rank
    >>> rank(Matrix.of([[1, 2], [2, 4]])), rank(Matrix.of([[1, 2], [2, 1]])), rank(Matrix.of([[1, 2], [2, 1]], PrimeField(3)))
    (1, 2, 1)
    """
    matrix = as_matrix(matrix)
    if _is_large(matrix):
        reduced = _modulo(matrix.flint)
        if reduced.rank() == min(reduced.nrows(), reduced.ncols()):  # a minor that is not zero modulo a prime is not zero
            return min(matrix.nrows, matrix.ncols)
        return len(row_echelon(matrix).pivots)
    return int(matrix.flint.rank()) // matrix.field.degree


def row_echelon(matrix: Matrix) -> RowEchelon:
    """Return the reduced row echelon form of a matrix, without its zero rows, and its pivots.

    Two matrices have the same row space iff their forms are equal. Over Q a large form comes from p-adic lifting [D82] and is checked
    exactly; over Q(a) it is the form of the block matrix, read in blocks.

    Parameters
    ----------
    matrix : Matrix, shape (nrows, ncols)
        Nested lists are taken over Q.

    Returns
    -------
    RowEchelon
        `matrix` is the form, rank x ncols, and `pivots` its leading columns.

    Raises
    ------
    InvalidInput
        For what is no matrix; nothing for a Matrix of any shape.

    Examples
    --------
    >>> from faultspace.exact import Matrix, row_echelon
    >>> form = row_echelon(Matrix.of([[0, 2, 4], [1, 1, 1], [1, 3, 5]]))
    >>> form.matrix, form.pivots
    ([[1, 0, -1], [0, 1, 2]], (0, 1))
    """
    matrix = as_matrix(matrix)
    d = matrix.field.degree
    echelon = _lifted_echelon(matrix.flint) if _is_large(matrix) else None
    if echelon is None:
        echelon, size = matrix.flint.rref()
        if size < echelon.nrows():
            echelon = base_matrix(matrix.field, size, matrix.ncols * d, echelon.entries()[: size * matrix.ncols * d])
    pivots = tuple(j // d for j in pivot_columns(echelon)[::d])
    return RowEchelon(Matrix(matrix.field, len(pivots), matrix.ncols, echelon), pivots)


def pivot_columns(echelon: Any) -> list[int]:
    """Return the column of the leading entry of every row of a row echelon form, which may end in zero rows."""
    pivots: list[int] = []
    start = 0
    for row in echelon.tolist():
        while start < len(row) and not row[start]:
            start += 1
        if start < len(row):
            pivots.append(start)
    return pivots


def _is_large(matrix: Matrix) -> bool:
    """This tells whether a rational matrix is worth the detour over a prime."""
    return not isinstance(matrix.field, PrimeField) and matrix.flint.nrows() * matrix.flint.ncols() > 150


def _modulo(rational: Any) -> Any:
    """Return the matrix modulo a prime after clearing denominators row by row: its rank is a lower bound."""
    rows: list[int] = []
    for row in rational.tolist():
        bottom = fmpz(1)
        for x in row:
            bottom = bottom.lcm(x.q)
        rows.extend(int((x * bottom).p % PRIME) for x in row)
    return nmod_mat(rational.nrows(), rational.ncols(), rows, PRIME)


def _lifted_echelon(rational: Any) -> Any:
    """Return the reduced row echelon form, by p-adic lifting on the shape found modulo a prime; None where that prime misleads.

    The rows and columns of a nonzero minor of greatest size modulo the prime make a square B; the form is B^-1 times those rows, if the
    other rows are combinations of them: checked exactly.
    """
    reduced = _modulo(rational)
    columns = pivot_columns(reduced.rref()[0])
    rows = pivot_columns(reduced.transpose().rref()[0])
    table = rational.tolist()
    size, width = len(rows), rational.ncols()
    if size == 0:
        return fmpq_mat(0, width) if all(x == 0 for row in table for x in row) else None
    chosen = fmpq_mat(size, width, [x for i in rows for x in table[i]])
    square = fmpq_mat(size, size, [table[i][j] for i in rows for j in columns])
    echelon = square.solve(chosen, "dixon")
    others = [table[i] for i in range(len(table)) if i not in set(rows)]
    rest = fmpq_mat(len(others), width, [x for row in others for x in row])
    through = fmpq_mat(len(others), size, [row[j] for row in others for j in columns])
    return echelon if rest == through * echelon else None


def right_null_space(matrix: Matrix) -> Matrix:
    """Return a basis of {x : M x = 0} for an nrows x ncols matrix M.

    Parameters
    ----------
    matrix : Matrix, shape (nrows, ncols)
        M; nested lists are taken over Q.

    Returns
    -------
    Matrix, shape (ncols, nullity)
        Each column has a 1 in the place of its free variable and zeros in the places of the others.

    Raises
    ------
    InvalidInput
        For what is no matrix; nothing for a Matrix of any shape.

    Examples
    --------
    >>> from faultspace.exact import Matrix, right_null_space
    >>> right_null_space(Matrix.of([[1, 0, 2], [0, 1, 3]]))
    [[-2], [-3], [1]]
    """
    matrix = as_matrix(matrix)
    echelon = row_echelon(matrix)
    field, d = matrix.field, matrix.field.degree
    pivots = set(echelon.pivots)
    free = [j for j in range(matrix.ncols) if j not in pivots]
    negated = (-echelon.matrix).columns(free).flint.tolist()
    width = len(free) * d
    position = {j: i for i, j in enumerate(echelon.pivots)}
    order = {j: i for i, j in enumerate(free)}
    scalars: list[Any] = []
    for j in range(matrix.ncols):
        for c in range(d):
            if j in pivots:
                scalars.extend(negated[position[j] * d + c])
            else:
                unit = [0] * width
                unit[order[j] * d + c] = 1
                scalars.extend(unit)
    return Matrix(field, matrix.ncols, len(free), base_matrix(field, matrix.ncols * d, width, scalars))


def left_null_space(matrix: Matrix) -> Matrix:
    """Return a basis of {y : y M = 0} for an nrows x ncols matrix M.

    Of the matrix [O_s T_s] of a window these are the relations that the outputs satisfy on s samples.

    Parameters
    ----------
    matrix : Matrix, shape (nrows, ncols)
        M; nested lists are taken over Q.

    Returns
    -------
    Matrix, shape (nullity, nrows)
        The basis as rows.

    Raises
    ------
    InvalidInput
        For what is no matrix; nothing for a Matrix of any shape.

    Examples
    --------
    >>> from faultspace.exact import Matrix, left_null_space
    >>> left_null_space(Matrix.of([[1, 2], [2, 4], [0, 1]]))
    [[-2, 1, 0]]
    """
    return right_null_space(as_matrix(matrix).transposed()).transposed()


def column_basis(matrix: Matrix) -> Matrix:
    """Return a basis of the column space as columns, in reduced column echelon form: equal spaces give equal matrices."""
    return row_echelon(matrix.transposed()).matrix.transposed()


def row_profile(matrix: Matrix) -> tuple[int, ...]:
    """Return the rows that are not combinations of the rows above them (the row rank profile)."""
    return row_echelon(matrix.transposed()).pivots


def solve_left(matrix: Matrix, right_side: Matrix) -> Matrix | None:
    """Return the X with X M = R that has zeros at the rows of M that depend on those above; None where R has a row outside the row
    space of M.
    """
    height = matrix.nrows
    form = row_echelon(stacked(matrix, right_side).transposed())
    profile = tuple(pivot for pivot in form.pivots if pivot < height)
    if len(profile) < len(form.pivots):
        return None
    coefficients = form.matrix.columns(range(height, height + right_side.nrows)).transposed()
    if len(profile) == height:
        return coefficients
    return coefficients @ Matrix.identity(matrix.field, height).rows(profile)


def _size(matrix: Matrix) -> str:
    return f"{matrix.nrows} x {matrix.ncols}"
