"""These are the fields of the certificate format: Q, the prime fields and Q(a), with elements that know + - * / and ==.

Elements are `Fraction` over Q, `Residue` over GF(p), `Algebraic` over Q(a); zero is the one that is false.

    parse_field(json)       FIELD -> Rationals() | PrimeField(p) | NumberField(f); None (absent) is Q
    field.parse(entry)      ENTRY -> element
    field.write(element)    element -> ENTRY, always strings
    field.integer(k), field.zero, field.one
    is_prime(p)             below 2^64
    is_irreducible(field)   whether the "field" is one: the minimal polynomial of Q(a), decided by sympy

Everything malformed raises ValueError. Q(a) takes its minimal polynomial on trust; where that shows, because a zero
divisor is inverted, `NotAField` is raised.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from . import polynomials

Element = Any
Json = Any

MAX_DEGREE = 16
INTEGER = re.compile(r"-?[0-9]+")
RATIONAL = re.compile(r"-?[0-9]+(/[1-9][0-9]*)?")


class NotAField(ValueError):
    """A zero divisor was to be inverted: the minimal polynomial is reducible."""


@dataclass(frozen=True, slots=True)
class Residue:
    """This is an element of the field with `prime` elements, 0 <= value < prime."""

    value: int
    prime: int

    def __bool__(self) -> bool:
        return self.value != 0

    def __neg__(self) -> Residue:
        return Residue(-self.value % self.prime, self.prime)

    def __add__(self, other: Residue) -> Residue:
        return Residue((self.value + other.value) % self.prime, self.prime)

    def __sub__(self, other: Residue) -> Residue:
        return Residue((self.value - other.value) % self.prime, self.prime)

    def __mul__(self, other: Residue) -> Residue:
        return Residue(self.value * other.value % self.prime, self.prime)

    def __truediv__(self, other: Residue) -> Residue:
        if not other:
            raise ZeroDivisionError("division by zero in a prime field")
        return Residue(self.value * pow(other.value, -1, self.prime) % self.prime, self.prime)


@dataclass(frozen=True, slots=True)
class Algebraic:
    """This is an element of Q(a): a polynomial in a, reduced modulo the minimal polynomial.

    Both are tuples of Fractions, ascending; the element's has no trailing zeros.
    """

    coefficients: tuple[Fraction, ...]
    modulus: tuple[Fraction, ...]

    def _reduced(self, coefficients: polynomials.Polynomial) -> Algebraic:
        if len(coefficients) >= len(self.modulus):
            coefficients = polynomials.divide(coefficients, list(self.modulus))[1]
        return Algebraic(tuple(coefficients), self.modulus)

    def __bool__(self) -> bool:
        return bool(self.coefficients)

    def __neg__(self) -> Algebraic:
        return Algebraic(tuple(-c for c in self.coefficients), self.modulus)

    def __add__(self, other: Algebraic) -> Algebraic:
        return self._reduced(polynomials.add(list(self.coefficients), list(other.coefficients)))

    def __sub__(self, other: Algebraic) -> Algebraic:
        return self + -other

    def __mul__(self, other: Algebraic) -> Algebraic:
        return self._reduced(polynomials.multiply(list(self.coefficients), list(other.coefficients)))

    def __truediv__(self, other: Algebraic) -> Algebraic:
        return self * other.inverse()

    def inverse(self) -> Algebraic:
        """The result is 1 / self by Euclid's extended algorithm.

        Raises ZeroDivisionError for zero and NotAField for a zero divisor.
        """
        if not self:
            raise ZeroDivisionError("division by zero in a number field")
        # Invariant: r = u * self modulo f, for (r, u) = (r0, u0) and (r1, u1).
        r0, u0 = list(self.modulus), []
        r1, u1 = list(self.coefficients), [Fraction(1)]
        while r1:
            quotient, remainder = polynomials.divide(r0, r1)
            r0, r1 = r1, remainder
            u0, u1 = u1, polynomials.subtract(u0, polynomials.multiply(quotient, u1))
        if len(r0) != 1:
            raise NotAField("the minimal polynomial is reducible: a zero divisor was to be inverted")
        return self._reduced([c / r0[0] for c in u0])


class Field(ABC):
    """This is a field of the format. Two are the same field when they compare equal."""

    @abstractmethod
    def integer(self, k: int) -> Element:
        """The result is the integer k as an element."""

    @abstractmethod
    def parse(self, entry: Json) -> Element:
        """ENTRY -> element; raises ValueError."""

    @abstractmethod
    def write(self, element: Element) -> Json:
        """The result is the ENTRY of an element, in strings."""

    @abstractmethod
    def to_json(self) -> Json:
        """The result is the FIELD."""

    @property
    def zero(self) -> Element:
        return self.integer(0)

    @property
    def one(self) -> Element:
        return self.integer(1)


@dataclass(frozen=True)
class Rationals(Field):
    """This is the field Q."""

    def integer(self, k: int) -> Fraction:
        return Fraction(k)

    def parse(self, entry: Json) -> Fraction:
        return parse_rational(entry)

    def write(self, element: Element) -> Json:
        return str(element)

    def to_json(self) -> Json:
        return "Q"


@dataclass(frozen=True)
class PrimeField(Field):
    """This is the field with `prime` elements."""

    prime: int

    def integer(self, k: int) -> Residue:
        return Residue(k % self.prime, self.prime)

    def parse(self, entry: Json) -> Residue:
        return self.integer(parse_integer(entry))

    def write(self, element: Element) -> Json:
        return str(element.value)

    def to_json(self) -> Json:
        return {"prime": self.prime}


@dataclass(frozen=True)
class NumberField(Field):
    """This is Q(a) for a root a of the monic polynomial `modulus`, ascending."""

    modulus: tuple[Fraction, ...]

    @property
    def generator(self) -> Algebraic:
        """This is the root a itself."""
        return self._element([Fraction(0), Fraction(1)])

    def integer(self, k: int) -> Algebraic:
        return self._element([Fraction(k)])

    def parse(self, entry: Json) -> Algebraic:
        if not isinstance(entry, list):
            return self._element([parse_rational(entry)])
        if len(entry) != len(self.modulus) - 1:
            raise ValueError(f"an entry over Q(a) has {len(self.modulus) - 1} coefficients (got {len(entry)})")
        return self._element([parse_rational(c) for c in entry])

    def write(self, element: Element) -> Json:
        padded = list(element.coefficients) + [Fraction(0)] * (len(self.modulus) - 1 - len(element.coefficients))
        return [str(c) for c in padded]

    def to_json(self) -> Json:
        return {"minimal_polynomial": [str(c) for c in self.modulus]}

    def _element(self, coefficients: list[Fraction]) -> Algebraic:
        remainder = polynomials.divide(polynomials.trimmed(coefficients), list(self.modulus))[1]
        return Algebraic(tuple(remainder), self.modulus)


def parse_integer(entry: Json) -> int:
    """INTEGER -> int; raises ValueError."""
    if isinstance(entry, int) and not isinstance(entry, bool):
        return entry
    if isinstance(entry, str) and INTEGER.fullmatch(entry):
        return int(entry)
    raise ValueError(f"not an INTEGER: {entry!r}")


def parse_rational(entry: Json) -> Fraction:
    """RATIONAL -> Fraction; raises ValueError."""
    if isinstance(entry, int) and not isinstance(entry, bool):
        return Fraction(entry)
    if isinstance(entry, str) and RATIONAL.fullmatch(entry):
        return Fraction(entry)
    raise ValueError(f"not a RATIONAL: {entry!r}")


def parse_index(entry: Json) -> int:
    """INDEX -> int; raises ValueError."""
    if isinstance(entry, int) and not isinstance(entry, bool) and entry >= 0:
        return entry
    raise ValueError(f"not an INDEX: {entry!r}")


def parse_field(json: Json) -> Field:
    """FIELD -> Field, None (the key is absent) being Q; raises ValueError."""
    if json is None or json == "Q":
        return Rationals()
    if isinstance(json, dict) and set(json) == {"prime"}:
        prime = parse_index(json["prime"])
        if not (prime < 2**64 and is_prime(prime)):
            raise ValueError(f"not a prime below 2^64: {prime}")
        return PrimeField(prime)
    if isinstance(json, dict) and set(json) == {"minimal_polynomial"} and isinstance(json["minimal_polynomial"], list):
        f = [parse_rational(c) for c in json["minimal_polynomial"]]
        if not (2 <= len(f) <= MAX_DEGREE + 1 and f[-1]):
            raise ValueError(f"a minimal polynomial has degree 1 to {MAX_DEGREE} and a nonzero last coefficient")
        # f and its multiples name the same field, so the monic one stands for all.
        return NumberField(tuple(polynomials.monic(f)))
    raise ValueError(f"not a FIELD: {json!r}")


def is_prime(p: int) -> bool:
    """This tells whether p is a prime, for p below 2^64.

    Miller's test; no composite number below 3.3e24 passes it for the first twelve primes.
    """
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
    if p < 2 or any(p % b == 0 for b in bases):
        return p in bases
    odd, twos = p - 1, 0
    while odd % 2 == 0:
        odd, twos = odd // 2, twos + 1
    for b in bases:
        x = pow(b, odd, p)
        if x != 1 and all(pow(x, 2**i, p) != p - 1 for i in range(twos)):
            return False
    return True


def is_irreducible(field: Field) -> bool:
    """This tells whether `field` is a field: it is but for Q(a) with a reducible polynomial, which sympy factors."""
    if not isinstance(field, NumberField):
        return True
    import sympy

    coefficients = [sympy.Rational(c.numerator, c.denominator) for c in reversed(field.modulus)]
    return bool(sympy.Poly(coefficients, sympy.Symbol("x"), domain="QQ").is_irreducible)
