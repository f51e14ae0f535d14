"""These are the fields that exact linear algebra runs over: Q, GF(p) and Q(a), behind one interface.

    Rationals()                     Q; elements are flint.fmpq
    PrimeField(p)                   GF(p), p a prime below 2^64; elements are flint.nmod
    NumberField((c0, c1, ..., cd))  Q(a), a a root of the irreducible c0 + c1 x + ... + cd x^d; elements are AlgebraicNumber
    Field                           any of the three
    degree                          d = [K : base field], 1 for Q and GF(p)
    block(e)                        the d x d matrix of multiplication by e: row i holds the coordinates of a^i e

A number field costs no algorithm of its own: replacing every entry by its block turns a matrix over Q(a) into a rational one with
the same ranks (times d), products and reduced echelon form, and python-flint does the work.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, ClassVar

import flint
from flint import fmpq, fmpq_poly, fmpz, fmpz_poly, nmod

from ...base.errors import InvalidInput, shorten
from . import pickling as pickling
from .sympy_values import is_rational
from .validation import MAX_FIELD_DEGREE, parse_rational, whole
from .writing import sum_of_powers


def _as_rational(value: object, where: str) -> fmpq:
    """Return the fmpq of an int, rational string, Fraction, sympy rational, fmpz or fmpq. Raises InvalidInput for the rest, floats
    included.
    """
    if isinstance(value, fmpq):
        return value
    if type(value) in (int, str):
        return parse_rational(value, where)
    if isinstance(value, fmpz):
        return fmpq(value)
    if isinstance(value, Fraction) or is_rational(value):
        return fmpq(int(value.numerator), int(value.denominator))
    return parse_rational(value, where)


class _Base:
    """What Q and GF(p) are over themselves: of degree 1."""

    degree: ClassVar[int] = 1

    def block(self, element: Any) -> list[list[Any]]:
        """Return [[element]], the 1 x 1 matrix of multiplication by the element."""
        return [[element]]

    def from_coordinates(self, coordinates: Sequence[Any]) -> Any:
        """Return the element with these coordinates, of which there is one."""
        return coordinates[0]


@dataclass(frozen=True)
class Rationals(_Base):
    """The field Q of the rational numbers, whose elements are of type flint.fmpq.

    `Rationals()` has no arguments, and all of them are equal. Its `element` takes integers, rational strings such as "-3/4", Fractions and
    sympy rationals, and `write` gives the reduced string that exact files hold.

    Raises InvalidInput, in `element`, for anything else, floats included.

    >>> from faultspace.exact import Rationals
    >>> QQ = Rationals()
    >>> QQ.element("2/4"), QQ.write(QQ.element("2/4")), QQ.degree, QQ.characteristic
    (1/2, '1/2', 1, 0)
    """

    characteristic: ClassVar[int] = 0

    def element(self, value: object, where: str = "entry") -> Any:
        """Return the element that `value` stands for (int, rational string, Fraction, sympy Rational, fmpq). Raises InvalidInput."""
        return _as_rational(value, where)

    def write(self, element: Any) -> str:
        """Return the reduced rational string."""
        if type(element) is fmpq and (top := element.p).bit_length() < 60 and (bottom := element.q).bit_length() < 60:
            return str(int(top)) if bottom == 1 else f"{int(top)}/{int(bottom)}"  # as str does below, several times faster
        return str(element)

    def to_json(self) -> object:
        """Return the `field` value of an exact file."""
        return "Q"

    def __str__(self) -> str:
        return "Q"


@dataclass(frozen=True)
class PrimeField(_Base):
    """The field GF(p) of the integers modulo a prime p below 2^64, whose elements are of type flint.nmod.

    `element` takes integers and integer strings, and no fractions; `write` gives the residue in 0..p-1 as a string.

    Raises InvalidInput unless p is a prime below 2^64 (flint aborts the process on a composite modulus), and, in `element`, for fractions,
    floats and elements of another field.

    >>> from faultspace.exact import PrimeField
    >>> field = PrimeField(5)
    >>> field.element(3) / field.element(2), field.write(field.element(-1)), str(field)
    (4, '4', 'GF(5)')
    """

    p: int

    def __post_init__(self) -> None:
        prime = whole(self.p)
        if prime is None or not 2 <= prime < 2**64 or not fmpz(prime).is_prime():
            raise InvalidInput(f"field.prime: got {shorten(self.p)}, expected a prime below 2^64")
        object.__setattr__(self, "p", prime)

    @property
    def characteristic(self) -> int:
        """The characteristic is p."""
        return self.p

    def element(self, value: object, where: str = "entry") -> Any:
        """Return the residue of an int or integer string. Raises InvalidInput for anything else, fractions included."""
        if isinstance(value, nmod):
            if value.modulus() != self.p:
                raise InvalidInput(f"{where}: got an element of GF({value.modulus()}), expected one of GF({self.p})")
            return value
        number = _as_rational(value, where)
        if number.q != 1 or (isinstance(value, str) and "/" in value):
            raise InvalidInput(f"{where}: got {shorten(value)}, expected an integer (the field is GF({self.p}))")
        return nmod(int(number.p % self.p), self.p)

    def write(self, element: Any) -> str:
        """Return the residue in 0..p-1 as a string."""
        return str(int(element))

    def to_json(self) -> object:
        """Return the `field` value of an exact file."""
        return {"prime": self.p}

    def __str__(self) -> str:
        return f"GF({self.p})"


@dataclass(frozen=True, eq=False)
class NumberField:
    """The field Q(a) for a root a of an irreducible polynomial over Q, given by its ascending coefficients, monic or not.

    An element is a rational polynomial in a of degree below d, the degree of the polynomial, which is at most 16; `element` takes a
    rational or a list of its d coordinates, ascending in a. No root is chosen: what is true over Q(a) is true for every root. Two
    polynomials of which one is a multiple of the other name the same field.

    Raises InvalidInput when the degree is not in 1..16 or the polynomial is reducible over Q, and, in `element`, for anything else.

    >>> from faultspace.exact import NumberField
    >>> field = NumberField((-2, 0, 1))
    >>> root = field.element([0, 1])
    >>> str(field), str(root * root), str(field.element(1) / root), field.write(root)
    ('Q(a) with a^2 - 2 = 0', '2', '1/2 a', ['0', '1'])
    """

    minimal_polynomial: tuple[Fraction, ...]
    characteristic: ClassVar[int] = 0

    def __post_init__(self) -> None:
        where = "field.minimal_polynomial"
        given = self.minimal_polynomial
        if not 2 <= len(given) <= MAX_FIELD_DEGREE + 1:
            raise InvalidInput(f"{where}: got degree {len(given) - 1}, expected a degree in 1..{MAX_FIELD_DEGREE}")
        values = [_as_rational(c, where) for c in given]
        if values[-1] == 0:
            raise InvalidInput(f"{where}: the leading coefficient is 0, expected a nonzero one")
        object.__setattr__(self, "minimal_polynomial", tuple(Fraction(int(c.p), int(c.q)) for c in values))
        _, factors = self.integer_polynomial.factor()
        if len(factors) != 1 or factors[0][1] != 1:
            text = sum_of_powers([str(c) for c in self.modulus.coeffs()], "a")
            raise InvalidInput(f"{where}: {text} is reducible over Q, expected an irreducible polynomial")

    def __eq__(self, other: object) -> bool:
        """A polynomial and its multiples name the same field."""
        return isinstance(other, NumberField) and self._monic == other._monic

    def __hash__(self) -> int:
        return hash(self._monic)

    @cached_property
    def _monic(self) -> tuple[Fraction, ...]:
        return tuple(c / self.minimal_polynomial[-1] for c in self.minimal_polynomial)

    @property
    def degree(self) -> int:
        """The degree d of the field is that of the minimal polynomial."""
        return len(self.minimal_polynomial) - 1

    @cached_property
    def modulus(self) -> fmpq_poly:
        """The minimal polynomial as given."""
        return fmpq_poly([fmpq(c.numerator, c.denominator) for c in self.minimal_polynomial])

    @cached_property
    def integer_polynomial(self) -> fmpz_poly:
        """The minimal polynomial times the common denominator of its coefficients."""
        scaled = self.modulus * self.modulus.denom()
        return fmpz_poly([c.p for c in scaled.coeffs()])

    @cached_property
    def _powers(self) -> list[fmpq_poly]:
        x = fmpq_poly([0, 1])
        return [x**i for i in range(self.degree)]

    def element(self, value: object, where: str = "entry") -> Any:
        """Return the element that a rational or a list of d rationals (ascending in a) stands for. Raises InvalidInput."""
        if isinstance(value, AlgebraicNumber) and value.field == self:
            return value
        if isinstance(value, (list, tuple)):
            if len(value) != self.degree:
                raise InvalidInput(f"{where}: got a list of {len(value)} coordinates, expected {self.degree}")
            return AlgebraicNumber(self, fmpq_poly([_as_rational(c, where) for c in value]) % self.modulus)
        try:
            return AlgebraicNumber(self, fmpq_poly([_as_rational(value, where)]) % self.modulus)
        except InvalidInput as error:
            unit = ["0", "1", *["0"] * (self.degree - 2)][: self.degree]
            raise InvalidInput(f"{error}, or a list of its {self.degree} coordinates, ascending in a: a itself is {unit}") from None

    def write(self, element: Any) -> object:
        """Return a rational string where the element is rational, else the list of its d coordinates."""
        coordinates = self.coordinates(element)
        if all(c == 0 for c in coordinates[1:]):
            return str(coordinates[0])
        return [str(c) for c in coordinates]

    def coordinates(self, element: Any) -> list[fmpq]:
        """Return the d rational coordinates of an element, ascending in a."""
        return [element.poly[i] for i in range(self.degree)]

    def block(self, element: Any) -> list[list[Any]]:
        """Return the d x d matrix of multiplication by the element: row i holds the coordinates of a^i times it."""
        if element.poly.degree() <= 0:
            c = element.poly[0]
            return [[c if i == j else fmpq(0) for j in range(self.degree)] for i in range(self.degree)]
        rows = [(power * element.poly) % self.modulus for power in self._powers]
        return [[row[j] for j in range(self.degree)] for row in rows]

    def from_coordinates(self, coordinates: Sequence[Any]) -> Any:
        """Return the element with these d coordinates."""
        return AlgebraicNumber(self, fmpq_poly(list(coordinates)))

    def to_json(self) -> object:
        """Return the `field` value of an exact file."""
        return {"minimal_polynomial": [str(fmpq(c.numerator, c.denominator)) for c in self.minimal_polynomial]}

    def __str__(self) -> str:
        return f"Q(a) with {sum_of_powers([str(c) for c in self.modulus.coeffs()], 'a')} = 0"


@dataclass(frozen=True, eq=False)
class AlgebraicNumber:
    """An element of a NumberField: a rational polynomial in a of degree below d. The field operations are operators."""

    field: NumberField
    poly: fmpq_poly

    def _other(self, other: Any) -> fmpq_poly:
        if not isinstance(other, AlgebraicNumber):
            return fmpq_poly([other])
        if other.field != self.field:
            raise ValueError(f"elements of {self.field} and of {other.field} do not mix, expected one field: build both over the same one")
        return other.poly

    def __add__(self, other: object) -> AlgebraicNumber:
        return AlgebraicNumber(self.field, self.poly + self._other(other))

    def __sub__(self, other: object) -> AlgebraicNumber:
        return AlgebraicNumber(self.field, self.poly - self._other(other))

    def __mul__(self, other: object) -> AlgebraicNumber:
        return AlgebraicNumber(self.field, (self.poly * self._other(other)) % self.field.modulus)

    def __truediv__(self, other: object) -> AlgebraicNumber:
        divisor = self._other(other)
        if not divisor:
            raise ZeroDivisionError("division by zero in a number field")
        _, inverse, _ = divisor.xgcd(self.field.modulus)
        return AlgebraicNumber(self.field, (self.poly * inverse) % self.field.modulus)

    def __neg__(self) -> AlgebraicNumber:
        return AlgebraicNumber(self.field, -self.poly)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, AlgebraicNumber):
            return self.field == other.field and bool(self.poly == other.poly)
        if not isinstance(other, (int, fmpz, fmpq)):
            return NotImplemented
        return bool(self.poly == fmpq_poly([other]))

    def __hash__(self) -> int:
        if self.poly.degree() <= 0:  # equal to a rational number
            return hash(Fraction(int(self.poly[0].p), int(self.poly[0].q)))
        return hash((self.field, str(self.poly)))

    def __str__(self) -> str:
        return sum_of_powers([str(c) for c in self.poly.coeffs()], "a")


Field = Rationals | PrimeField | NumberField
QQ = Rationals()


def field_from_json(value: object) -> Field:
    """Return the field that the `field` value of an exact file names; each field's `to_json` writes what this reads.

    Parameters
    ----------
    value : str or dict
        "Q", a dict with "prime", or one with "minimal_polynomial", a list of rational strings or integers by ascending power.

    Returns
    -------
    Rationals or PrimeField or NumberField

    Raises
    ------
    InvalidInput
        For anything else, for a number that is no prime, and for a polynomial that is reducible over Q.

    Examples
    --------
    >>> from faultspace.exact import field_from_json
    >>> [str(field_from_json(value)) for value in ("Q", {"prime": 3}, {"minimal_polynomial": ["-2", "0", "1"]})]
    ['Q', 'GF(3)', 'Q(a) with a^2 - 2 = 0']
    """
    if value == "Q":
        return QQ
    if isinstance(value, dict) and set(value) == {"prime"}:
        return PrimeField(value["prime"])
    if isinstance(value, dict) and set(value) == {"minimal_polynomial"} and isinstance(value["minimal_polynomial"], list):
        return NumberField(tuple(value["minimal_polynomial"]))
    raise InvalidInput(f'field: got {shorten(value)}, expected "Q", {{"minimal_polynomial": [...]}} or {{"prime": p}}')


def base_matrix(field: Field, rows: int, cols: int, scalars: list[Any]) -> Any:
    """Return the flint matrix of this shape over the base field (Q for number fields)."""
    if isinstance(field, PrimeField):
        return flint.nmod_mat(rows, cols, scalars, field.p)
    return flint.fmpq_mat(rows, cols, scalars)


def base_zero(field: Field, rows: int, cols: int) -> Any:
    """Return the flint matrix of zeros over the base field."""
    return flint.nmod_mat(rows, cols, field.p) if isinstance(field, PrimeField) else flint.fmpq_mat(rows, cols)
