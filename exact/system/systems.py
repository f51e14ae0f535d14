"""These are the systems that statements are about: immutable, exact, written and read as JSON-ready dicts.

    ResidualSystem     x(k+1) = A x + F v,        r = C x + G v        n states, m faults, p outputs
    FaultySystem       x(k+1) = A x + B u + F v,  y = C x + D u + G v  the same with nu inputs; `.residual` forgets them
    System             either; called with matrices, it makes one of the two
    read_system        one of the two, from the dict of an exact file
    residual_of        the residual system of whatever kind of system is given
    from_float_exactly a float as the dyadic rational that it is (the only way in for floats)

In JSON the matrices are "A", "F", "C", "G" ("B", "D"), the field "field", and with a zero dimension "n", "m", "p" ("nu") are required.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from fractions import Fraction
from os import PathLike
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...base.sheets import Shown, counted
from ..algebra.entries import not_rows
from ..algebra.fields import QQ, Field, field_from_json
from ..algebra.matrices import Matrix
from ..algebra.notation import field_words, named_matrix
from ..algebra.validation import MAX_DIMENSION, natural


class System(Shown):
    """The exact system x(k+1) = A x + B u + F v, y = C x + D u + G v with n states, m faults v, p outputs, n_u inputs u.

    A is n x n, F n x m, C p x n, G p x m, B n x n_u, D p x n_u: nested lists of integers, strings such as "1/2" and Fractions, numpy arrays
    of integers, or sympy matrices. The system has them again, of type Matrix, as `.A`, `.F`, `.C`, `.G`, `.B` and `.D`. Floats are refused,
    because a measured float has no exact zeros; `faultspace.exact.from_float_exactly` takes one as it is. `field` is "Q", {"prime": 3},
    {"minimal_polynomial": ["-2", "0", "1"]} for Q(sqrt 2), or a field of `faultspace.exact`. The sizes n, m and p are needed where a
    dimension is zero. There are two kinds of System: the call gives a FaultySystem where B and D are given, else a ResidualSystem, whose B
    and D have no columns.

    Raises InvalidInput when shapes or fields do not agree, for entries that are not exact, and for one of B and D without the other.

    >>> import faultspace as fs
    >>> system = fs.System(A=[["1/2"]], F=[[1]], C=[[1]], G=[[0]])
    >>> isinstance(system, fs.System), type(system).__name__, system.sizes
    (True, 'ResidualSystem', '1 state, 1 fault, 1 output, over Q')
    >>> try:
    ...     fs.System(A=[[0.5]], F=[[1]], C=[[1]], G=[[0]])
    ... except fs.errors.InvalidInput as error:
    ...     print(error)
    A[0][0]: got 0.5, expected a rational string such as "-3/4" (floats are not exact; see from_float_exactly)
    """

    residual: ResidualSystem
    A: Matrix
    F: Matrix
    C: Matrix
    G: Matrix
    B: Matrix
    D: Matrix

    # Both kinds have a `__new__` and no `__init__`, as the paths of pathlib do: Python runs `__init__` again on what this one returns.
    def __new__(
        cls,
        A: object,
        F: object,
        C: object,
        G: object,
        *,
        B: object = None,
        D: object = None,
        field: Field | str | Mapping[str, Any] = QQ,
        n: int | None = None,
        m: int | None = None,
        p: int | None = None,
    ) -> System:
        if isinstance(field, (str, Mapping)):
            field = field_from_json(field)
        if (B is None) != (D is None):
            raise InvalidInput("got only one of B and D, expected both or neither")
        system = ResidualSystem.of(A, F, C, G, field=field, n=n, m=m, p=p)
        if B is None:
            return system
        _refuse_what_has_no_rows({"B": B, "D": D})
        return _with_inputs(system, B, D, _dimension("n_u", None, (B, 1), (D, 1)), "n_u")

    def __getnewargs__(self) -> tuple[Any, ...]:
        return tuple(getattr(self, one.name) for one in fields(self))  # type: ignore[arg-type]

    @property
    def field(self) -> Field:
        """The field of the entries."""
        return self.residual.A.field

    @property
    def n(self) -> int:
        """n is the number of states."""
        return self.residual.A.nrows

    @property
    def m(self) -> int:
        """m is the number of faults."""
        return self.residual.F.ncols

    @property
    def p(self) -> int:
        """p is the number of outputs."""
        return self.residual.C.nrows

    @property
    def nu(self) -> int:
        """n_u is the number of inputs."""
        return self.B.ncols

    @property
    def sizes(self) -> str:
        """This says how many states, faults and outputs there are, and over which field."""
        return f"{counted(self.n, 'state')}, {counted(self.m, 'fault')}, {counted(self.p, 'output')}, over {field_words(self.field)}"

    @property
    def title(self) -> str:
        """The same as `sizes`."""
        return self.sizes

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the matrices."""
        for name in "AFCG":
            yield from named_matrix(name, getattr(self.residual, name))

    def __str__(self) -> str:
        names = "AFCG" + ("BD" if self.nu else "")
        where = "" if self.field == QQ else f" over {self.field}"
        return ", ".join(f"{name}={getattr(self, name)}" for name in names) + where

    def to_json(self) -> dict[str, Any]:
        """Return the dict that exact files hold."""
        result: dict[str, Any] = {} if self.field == QQ else {"field": self.field.to_json()}
        if 0 in (self.n, self.m, self.p):
            result |= {"n": self.n, "m": self.m, "p": self.p}
        return result | {name: getattr(self.residual, name).to_json() for name in "AFCG"}


@dataclass(frozen=True, init=False, repr=False)
class ResidualSystem(System):
    """The system x(k+1) = A x(k) + F v(k), r(k) = C x(k) + G v(k) without inputs, exact over one field.

    A is n x n, F n x m, C p x n, G p x m, of type Matrix over the same field; `ResidualSystem.of` takes nested lists, sympy matrices and
    so on. Two systems are equal where their matrices are, and they can be pickled and used as keys.

    Raises InvalidInput when shapes or fields do not agree, or n + m + p > 512.

    >>> from faultspace.exact import Matrix, ResidualSystem
    >>> half, one = Matrix.of([["1/2"]]), Matrix.of([[1]])
    >>> system = ResidualSystem(A=half, F=one, C=one, G=Matrix.of([[0]]))
    >>> print(system)
    A=[[1/2]], F=[[1]], C=[[1]], G=[[0]]
    >>> system == ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])
    True
    """

    A: Matrix
    F: Matrix
    C: Matrix
    G: Matrix

    def __new__(cls, A: Matrix, F: Matrix, C: Matrix, G: Matrix) -> ResidualSystem:
        n, m, p = A.nrows, F.ncols, C.nrows
        self = object.__new__(cls)
        for name, matrix, shape in (("A", A, (n, n)), ("F", F, (n, m)), ("C", C, (p, n)), ("G", G, (p, m))):
            _agree(name, matrix, shape, A.field)
            object.__setattr__(self, name, matrix)
        _supported("n + m + p", n + m + p)
        return self

    @staticmethod
    def of(
        A: object,
        F: object,
        C: object,
        G: object,
        *,
        field: Field = QQ,
        n: int | None = None,
        m: int | None = None,
        p: int | None = None,
    ) -> ResidualSystem:
        """This makes the system with these matrices (nested lists of integers, rational strings, Fractions; sympy matrices).

        n, m, p are needed where a dimension is zero. Raises InvalidInput.
        """
        given = {"A": A, "F": F, "C": C, "G": G}
        _refuse_what_has_no_rows(given)
        n = _dimension("n", n, (A, 0), (A, 1), (F, 0), (C, 1))
        m = _dimension("m", m, (F, 1), (G, 1))
        p = _dimension("p", p, (C, 0), (G, 0))
        _supported("n + m + p", n + m + p)
        shapes = {"A": (n, n), "F": (n, m), "C": (p, n), "G": (p, m)}
        return ResidualSystem(**{k: Matrix.of(given[k], field, shape=shapes[k], where=k) for k in shapes})

    @property
    def residual(self) -> ResidualSystem:  # type: ignore[override]
        """The system itself: what FaultySystem.residual is for a system with inputs."""
        return self

    def transposed(self) -> ResidualSystem:
        """Return (A', C', F', G'): its pencil is the transpose, and its left minimal indices are the right ones of this system."""
        return ResidualSystem(self.A.transposed(), self.C.transposed(), self.F.transposed(), self.G.transposed())

    def with_faults(self, F: Matrix, G: Matrix) -> ResidualSystem:
        """The result has the same A, C and other fault matrices (n x m', p x m')."""
        return ResidualSystem(self.A, F, self.C, G)

    @property
    def B(self) -> Matrix:  # type: ignore[override]
        """B is n x 0: there are no inputs."""
        return Matrix.zero(self.field, self.n, 0)

    @property
    def D(self) -> Matrix:  # type: ignore[override]
        """D is p x 0: there are no inputs."""
        return Matrix.zero(self.field, self.p, 0)


@dataclass(frozen=True, init=False, repr=False)
class FaultySystem(System):
    """The system x(k+1) = A x + B u + F v, y = C x + D u + G v: a ResidualSystem `residual` with n_u inputs u.

    B is n x n_u and D p x n_u, of type Matrix over the field of the residual system; `System` takes nested lists. The inputs are known, so
    that everything about faults is a matter of `residual`, and all functions that take a system take either kind.

    Raises InvalidInput when shapes or fields do not agree.

    >>> from faultspace.exact import FaultySystem, Matrix, ResidualSystem
    >>> one = Matrix.of([[1]])
    >>> system = FaultySystem(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]), B=one, D=one)
    >>> system.sizes
    '1 state, 1 fault, 1 output, 1 input, over Q'
    >>> system.to_json()["B"], system.nu
    ([['1']], 1)
    """

    residual: ResidualSystem
    B: Matrix
    D: Matrix

    def __new__(cls, residual: ResidualSystem, B: Matrix, D: Matrix) -> FaultySystem:
        _agree("B", B, (residual.n, B.ncols), residual.field)
        _agree("D", D, (residual.p, B.ncols), residual.field)
        self = object.__new__(cls)
        for name, part in (("residual", residual), ("B", B), ("D", D)):
            object.__setattr__(self, name, part)
        return self

    @property
    def A(self) -> Matrix:  # type: ignore[override]
        """A is n x n, that of `residual`."""
        return self.residual.A

    @property
    def F(self) -> Matrix:  # type: ignore[override]
        """F is n x m, that of `residual`."""
        return self.residual.F

    @property
    def C(self) -> Matrix:  # type: ignore[override]
        """C is p x n, that of `residual`."""
        return self.residual.C

    @property
    def G(self) -> Matrix:  # type: ignore[override]
        """G is p x m, that of `residual`."""
        return self.residual.G

    @property
    def sizes(self) -> str:
        """This says how many states, faults, outputs and inputs there are, and over which field."""
        one, _, over = super().sizes.rpartition(", over ")
        return f"{one}, {counted(self.nu, 'input')}, over {over}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the matrices, those of the inputs last."""
        yield from super().sheet()
        yield from named_matrix("B", self.B)
        yield from named_matrix("D", self.D)

    def to_json(self) -> dict[str, Any]:
        """Return the dict that exact files hold."""
        result = super().to_json()
        if self.nu == 0 or "n" in result:
            result |= {"n": self.n, "m": self.m, "p": self.p, "nu": self.nu}
        return result | {"B": self.B.to_json(), "D": self.D.to_json()}


def residual_of(given: object, where: str = "system") -> ResidualSystem:
    """Return the residual system of a System of either kind. Raises InvalidInput for anything else, and says what to try."""
    if isinstance(given, System):
        return given.residual
    hint = ""
    if isinstance(given, (str, PathLike)):
        hint = "; the system in a file is faultspace.exact.read_system(json.load(open(path)))"
    elif isinstance(given, Mapping):
        hint = "; faultspace.exact.read_system takes the dict of a file"
    raise InvalidInput(f"{where}: got {shorten(given)}, expected a ResidualSystem or a FaultySystem, as fs.System makes them{hint}")


def read_system(data: object, *, where: str = "system") -> System:
    """Return the System that the dict of an exact file holds.

    Parameters
    ----------
    data : dict
        "A" (n x n), "F" (n x m), "C" (p x n), "G" (p x m), each a list of rows; it may have "B" and "D" together, "field", and the
        sizes "n", "m", "p" and "nu", which are required where one of them is zero. Entries are integers and rational strings, over Q(a)
        also lists of such. n + m + p is at most 512.
    where : str
        How messages call it.

    Returns
    -------
    System

    Raises
    ------
    InvalidInput
        With one line that names the place and says what was got and what is needed.

    Examples
    --------
    >>> from faultspace.exact import read_system
    >>> print(read_system({"A": [["1/2"]], "F": [[1]], "C": [[1]], "G": [[0]]}))
    A=[[1/2]], F=[[1]], C=[[1]], G=[[0]]
    >>> read_system({"A": [["1/2"]], "F": [[1]], "C": [[1]]})
    Traceback (most recent call last):
    faultspace.base.errors.InvalidInput: system: key "G" is missing, expected A, F, C and G
    """
    if not isinstance(data, Mapping):
        raise InvalidInput(f"{where}: got {shorten(data)}, expected an object with A, F, C, G")
    unknown = sorted(set(map(str, data)) - {"A", "F", "C", "G", "B", "D", "field", "n", "m", "p", "nu"})
    if unknown:
        raise InvalidInput(f"{where}: unknown key {shorten(unknown[0])}, expected A, F, C, G, B, D, field, n, m, p, nu")
    missing = [key for key in "AFCG" if key not in data]
    if missing:
        raise InvalidInput(f'{where}: key "{missing[0]}" is missing, expected A, F, C and G')
    if ("B" in data) != ("D" in data):
        raise InvalidInput(f"{where}: got only one of B and D, expected both or neither")
    if "nu" in data and "B" not in data:
        raise InvalidInput(f"{where}: got nu without B and D, expected all three or none")
    field = field_from_json(data.get("field", "Q"))
    try:
        system = _read_residual(data, field)
        if "B" not in data:
            return system
        return _with_inputs(system, data["B"], data["D"], _dimension("nu", data.get("nu"), (data["B"], 1), (data["D"], 1)), "nu")
    except InvalidInput as error:
        raise InvalidInput(f"{where}.{error}") from None


def _read_residual(data: Mapping[str, Any], field: Field) -> ResidualSystem:
    for key in ("A", "F", "C", "G", "B", "D"):
        if key in data and (not isinstance(data[key], list) or not all(isinstance(row, list) for row in data[key])):
            raise InvalidInput(f"{key}: got {shorten(data[key])}, expected a list of rows")
    sizes = ("n", "m", "p") + (("nu",) if "B" in data else ())
    for name in sizes:
        if name in data and (type(data[name]) is not int or data[name] < 0):
            raise InvalidInput(f"{name}: got {shorten(data[name])}, expected an integer >= 0")
    empty = [key for key in ("A", "F", "C", "G", "B", "D") if key in data and (not data[key] or not data[key][0])]
    missing = [name for name in sizes if name not in data]
    if empty and missing:
        raise InvalidInput(f"{empty[0]}: is empty; with a zero dimension {', '.join(sizes)} are required, got no {missing[0]}")
    return ResidualSystem.of(*(data[key] for key in "AFCG"), field=field, **{name: data.get(name) for name in ("n", "m", "p")})


def from_float_exactly(value: float, *, where: str = "entry") -> Fraction:
    """Return the dyadic rational that a finite float is, of type Fraction: the only way in for floats.

    A float that was measured or rounded has no exact zeros, so that an answer about the result is one about those digits.

    Parameters
    ----------
    value : float
    where : str
        How messages call the number.

    Returns
    -------
    Fraction

    Raises
    ------
    InvalidInput
        For NaN, infinities and anything that is no number.

    Examples
    --------
    >>> from faultspace.exact import from_float_exactly
    >>> from_float_exactly(0.5), from_float_exactly(0.1)
    (Fraction(1, 2), Fraction(3602879701896397, 36028797018963968))
    """
    if not isinstance(value, (int, float)) or isinstance(value, bool) or value != value or value in (float("inf"), float("-inf")):
        raise InvalidInput(f"{where}: got {shorten(value)}, expected a finite float")
    return Fraction(value)


def _with_inputs(system: ResidualSystem, B: object, D: object, nu: int, name: str) -> FaultySystem:
    _supported(name, nu)
    B = Matrix.of(B, system.field, shape=(system.n, nu), where="B")
    return FaultySystem(system, B, Matrix.of(D, system.field, shape=(system.p, nu), where="D"))


def _refuse_what_has_no_rows(given: Mapping[str, object]) -> None:
    """Raise InvalidInput for what is no matrix at all, before its dimensions are asked for."""
    for name, entries in given.items():
        if not isinstance(entries, (list, tuple)) and len(getattr(entries, "shape", ())) != 2:
            raise InvalidInput(not_rows(entries, name))


def _supported(name: str, size: int) -> None:
    if size > MAX_DIMENSION:
        raise InvalidInput(f"{name}: got {size}, at most {MAX_DIMENSION} is supported")


def _agree(name: str, matrix: Matrix, shape: tuple[int, int], field: Field) -> None:
    if matrix.shape != shape:
        raise InvalidInput(f"{name}: got shape {matrix.nrows} x {matrix.ncols}, expected {shape[0]} x {shape[1]}")
    if matrix.field != field:
        raise InvalidInput(f"{name}: got entries over {matrix.field}, expected {field} as for A")


def _dimension(name: str, given: object, *places: tuple[object, int]) -> int:
    """Return the stated dimension, or the one that the first matrix with entries shows."""
    if given is not None:
        return natural(given, name)
    for entries, axis in places:
        size = _extent(entries, axis)
        if size is not None:
            return size
    raise InvalidInput(f"{name}: every matrix that shows this dimension is empty; say {name}=...")


def _extent(entries: object, axis: int) -> int | None:
    """Return the number of rows (axis 0) or columns (axis 1) of nested lists or a matrix; it is None where an empty list does not
    tell.
    """
    if isinstance(entries, (Matrix,)):
        return entries.shape[axis]
    if hasattr(entries, "shape") and len(entries.shape) == 2:
        return int(entries.shape[axis])
    if isinstance(entries, (list, tuple)) and entries:
        if axis == 0:
            return len(entries)
        return len(entries[0]) if isinstance(entries[0], (list, tuple)) else None
    return None
