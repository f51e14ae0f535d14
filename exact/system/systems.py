"""The systems that statements are about: immutable, exact, written and read as JSON-ready dicts.

    ResidualSystem     x(k+1) = A x + F v,        r = C x + G v        n states, m faults, p outputs
    FaultySystem       x(k+1) = A x + B u + F v,  y = C x + D u + G v  the same with nu inputs; `.residual` forgets them
    System             either, from matrices
    read_system        either, from the dict of an exact file
    from_float_exactly a float as the dyadic rational that it is (the only way in for floats)

In JSON the matrices are "A", "F", "C", "G" ("B", "D"), the field "field", and with a zero dimension "n", "m", "p" ("nu") are required.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...base.errors import InvalidInput, shorten
from ..algebra.fields import QQ, Field, field_from_json
from ..algebra.matrices import Matrix
from ..algebra.notation import field_words
from ..algebra.validation import MAX_DIMENSION


@dataclass(frozen=True)
class ResidualSystem:
    """x(k+1) = A x(k) + F v(k), r(k) = C x(k) + G v(k), exact over one field.

    A is n x n, F n x m, C p x n, G p x m, of type Matrix over the same field. `ResidualSystem.of` takes nested lists,
    sympy matrices and so on. Raises InvalidInput when shapes or fields do not agree, or n + m + p > 512.
    """

    A: Matrix
    F: Matrix
    C: Matrix
    G: Matrix

    def __post_init__(self) -> None:
        n, m, p = self.A.nrows, self.F.ncols, self.C.nrows
        for name, matrix, shape in (("A", self.A, (n, n)), ("F", self.F, (n, m)), ("C", self.C, (p, n)), ("G", self.G, (p, m))):
            _agree(name, matrix, shape, self.A.field)
        if n + m + p > MAX_DIMENSION:
            raise InvalidInput(f"n + m + p: got {n + m + p}, at most {MAX_DIMENSION} is supported")

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
        """The system with these matrices (nested lists of integers, rational strings, Fractions; sympy matrices).

        n, m, p are needed where a dimension is zero. Raises InvalidInput.
        """
        given = {"A": A, "F": F, "C": C, "G": G}
        n = _dimension("n", n, (A, 0), (A, 1), (F, 0), (C, 1))
        m = _dimension("m", m, (F, 1), (G, 1))
        p = _dimension("p", p, (C, 0), (G, 0))
        if n + m + p > MAX_DIMENSION:
            raise InvalidInput(f"n + m + p: got {n + m + p}, at most {MAX_DIMENSION} is supported")
        shapes = {"A": (n, n), "F": (n, m), "C": (p, n), "G": (p, m)}
        return ResidualSystem(**{k: Matrix.of(given[k], field, shape=shapes[k], where=k) for k in shapes})

    @property
    def field(self) -> Field:
        """The field of the entries."""
        return self.A.field

    @property
    def n(self) -> int:
        """Number of states."""
        return self.A.nrows

    @property
    def m(self) -> int:
        """Number of faults."""
        return self.F.ncols

    @property
    def p(self) -> int:
        """Number of outputs."""
        return self.C.nrows

    @property
    def residual(self) -> ResidualSystem:
        """The system itself: what FaultySystem.residual is for a system with inputs."""
        return self

    @property
    def sizes(self) -> str:
        """How many states, faults and outputs, over which field, in words."""
        return f"{counted(self.n, 'state')}, {counted(self.m, 'fault')}, {counted(self.p, 'output')}, over {field_words(self.field)}"

    def transposed(self) -> ResidualSystem:
        """(A', C', F', G'): its pencil is the transpose, its left minimal indices are the right ones of this system."""
        return ResidualSystem(self.A.transposed(), self.C.transposed(), self.F.transposed(), self.G.transposed())

    def with_faults(self, F: Matrix, G: Matrix) -> ResidualSystem:
        """The system with the same A, C and other fault matrices (n x m', p x m')."""
        return ResidualSystem(self.A, F, self.C, G)

    def to_json(self) -> dict[str, Any]:
        """The dict that exact files hold."""
        result: dict[str, Any] = {} if self.field == QQ else {"field": self.field.to_json()}
        if 0 in (self.n, self.m, self.p):
            result |= {"n": self.n, "m": self.m, "p": self.p}
        return result | {name: getattr(self, name).to_json() for name in "AFCG"}

    def __str__(self) -> str:
        where = "" if self.field == QQ else f" over {self.field}"
        return f"A={self.A}, F={self.F}, C={self.C}, G={self.G}{where}"


@dataclass(frozen=True)
class FaultySystem:
    """A ResidualSystem with inputs: B is n x nu, D is p x nu. Raises InvalidInput when shapes or fields do not agree."""

    residual: ResidualSystem
    B: Matrix
    D: Matrix

    def __post_init__(self) -> None:
        nu = self.B.ncols
        _agree("B", self.B, (self.residual.n, nu), self.residual.field)
        _agree("D", self.D, (self.residual.p, nu), self.residual.field)

    @property
    def field(self) -> Field:
        """The field of the entries."""
        return self.residual.field

    @property
    def nu(self) -> int:
        """Number of inputs."""
        return self.B.ncols

    @property
    def sizes(self) -> str:
        """How many states, faults, outputs and inputs, over which field, in words."""
        one, _, over = self.residual.sizes.rpartition(", over ")
        return f"{one}, {counted(self.nu, 'input')}, over {over}"

    def to_json(self) -> dict[str, Any]:
        """The dict that exact files hold."""
        result = self.residual.to_json()
        if self.nu == 0 or "n" in result:
            result |= {"n": self.residual.n, "m": self.residual.m, "p": self.residual.p, "nu": self.nu}
        return result | {"B": self.B.to_json(), "D": self.D.to_json()}


def System(
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
) -> ResidualSystem | FaultySystem:
    """The exact system x(k+1) = A x + B u + F v, y = C x + D u + G v with n states, m faults v, p outputs and n_u inputs u.

    A is n x n, F n x m, C p x n, G p x m, B n x n_u, D p x n_u: nested lists of integers, strings such as "1/2" and Fractions, or sympy
    matrices. Floats are refused, because a measured float has no exact zeros; `faultspace.exact.from_float_exactly` takes one as it is.
    `field` is "Q", {"prime": 3}, {"minimal_polynomial": ["-2", "0", "1"]} for Q(sqrt 2), or a field of `faultspace.exact`. The sizes n, m
    and p are needed where a dimension is zero. The result is a FaultySystem where B and D are given, else a ResidualSystem without inputs.

    Raises InvalidInput when shapes or fields do not agree, for entries that are not exact, and for one of B and D without the other.

    >>> import faultspace as fs
    >>> print(fs.System(A=[["1/2"]], F=[[1]], C=[[1]], G=[[0]]).sizes)
    1 state, 1 fault, 1 output, over Q
    >>> try:
    ...     fs.System(A=[[0.5]], F=[[1]], C=[[1]], G=[[0]])
    ... except fs.errors.InvalidInput as error:
    ...     print(error)
    A[0][0]: got 0.5, expected a rational string such as "-3/4" (floats are not exact; see from_float_exactly)
    """
    if isinstance(field, (str, Mapping)):
        field = field_from_json(field)
    if (B is None) != (D is None):
        raise InvalidInput("got only one of B and D, expected both or neither")
    system = ResidualSystem.of(A, F, C, G, field=field, n=n, m=m, p=p)
    if B is None:
        return system
    nu = _dimension("n_u", None, (B, 1), (D, 1))
    if nu > MAX_DIMENSION:
        raise InvalidInput(f"n_u: got {nu}, at most {MAX_DIMENSION} is supported")
    return FaultySystem(system, Matrix.of(B, field, shape=(system.n, nu), where="B"), Matrix.of(D, field, shape=(system.p, nu), where="D"))


def counted(count: int, word: str) -> str:
    """The number with the word in its singular or plural: "1 state", "2 states"."""
    return f"{count} {word}{'' if count == 1 else 's'}"


def read_system(data: object, *, where: str = "system") -> ResidualSystem | FaultySystem:
    """The system that the dict of an exact file holds. Raises InvalidInput with one line naming the place."""
    if not isinstance(data, Mapping):
        raise InvalidInput(f"{where}: got {shorten(data)}, expected an object with A, F, C, G")
    unknown = sorted(set(map(str, data)) - {"A", "F", "C", "G", "B", "D", "field", "n", "m", "p", "nu"})
    if unknown:
        raise InvalidInput(f"{where}: unknown key {shorten(unknown[0])}, expected A, F, C, G, B, D, field, n, m, p, nu")
    missing = [key for key in "AFCG" if key not in data]
    if missing:
        raise InvalidInput(f'{where}: key "{missing[0]}" is missing')
    if ("B" in data) != ("D" in data):
        raise InvalidInput(f"{where}: got only one of B and D, expected both or neither")
    if "nu" in data and "B" not in data:
        raise InvalidInput(f"{where}: got nu without B and D")
    field = field_from_json(data.get("field", "Q"))
    try:
        system = _read_residual(data, field)
        if "B" not in data:
            return system
        nu = _dimension("nu", data.get("nu"), (data["B"], 1), (data["D"], 1))
        if nu > MAX_DIMENSION:
            raise InvalidInput(f"nu: got {nu}, at most {MAX_DIMENSION} is supported")
        B = Matrix.of(data["B"], field, shape=(system.n, nu), where="B")
        return FaultySystem(system, B, Matrix.of(data["D"], field, shape=(system.p, nu), where="D"))
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
    """The dyadic rational that a finite float is. Raises InvalidInput for NaN and infinities."""
    if not isinstance(value, (int, float)) or isinstance(value, bool) or value != value or value in (float("inf"), float("-inf")):
        raise InvalidInput(f"{where}: got {shorten(value)}, expected a finite float")
    return Fraction(value)


def _agree(name: str, matrix: Matrix, shape: tuple[int, int], field: Field) -> None:
    if matrix.shape != shape:
        raise InvalidInput(f"{name}: got shape {matrix.nrows} x {matrix.ncols}, expected {shape[0]} x {shape[1]}")
    if matrix.field != field:
        raise InvalidInput(f"{name}: got entries over {matrix.field}, expected {field} as for A")


def _dimension(name: str, given: object, *places: tuple[object, int]) -> int:
    """The stated dimension, or the one that the first matrix with entries shows."""
    if given is not None:
        if type(given) is not int or given < 0:
            raise InvalidInput(f"{name}: got {shorten(given)}, expected an integer >= 0")
        return given
    for entries, axis in places:
        size = _extent(entries, axis)
        if size is not None:
            return size
    raise InvalidInput(f"{name}: every matrix that shows this dimension is empty; say {name}=...")


def _extent(entries: object, axis: int) -> int | None:
    """Rows (axis 0) or columns (axis 1) of nested lists or a matrix; None where an empty list does not tell."""
    if isinstance(entries, (Matrix,)):
        return entries.shape[axis]
    if hasattr(entries, "shape"):
        return int(entries.shape[axis])
    if isinstance(entries, (list, tuple)) and entries:
        if axis == 0:
            return len(entries)
        return len(entries[0]) if isinstance(entries[0], (list, tuple)) else None
    return None
