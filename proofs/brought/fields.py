"""The fields that a claim can be asked over, as a file writes them, and the numbers of a box over each.

    read_field      "Q", "GF(q)", "Q(a) with a^2 - 2 = 0", "Q(a) with a^2 - 2 = 0 and 1 < a < 2" -> the field
    in_a            "1 - 1/2 a", a polynomial in a, as its coefficients
    read_entries    the entries of a box
    usual_entries   those where none are stated

What is read is what the answers write. A number field without bounds on a has no root chosen: what is true there is true for each root, and
what asks for the unit circle has no answer there, but over an imaginary quadratic field, whose two roots are conjugate.
"""

from __future__ import annotations

import re
from fractions import Fraction

from flint import fmpz

from ...base.errors import InvalidInput, shorten
from ...exact.algebra.embeddings import RealField
from ...exact.algebra.fields import QQ, AlgebraicNumber, Field, NumberField, PrimeField
from ..quantities.blocks import Number

LARGEST_PRIME, LARGEST_DEGREE, MOST_ENTRIES = 97, 8, 32
RATIONAL = r"-?[0-9]{1,6}(?:/[1-9][0-9]{0,5})?"
WITH_A = re.compile(rf"Q\(a\) with (.{{1,200}}?) = 0(?: and ({RATIONAL}) < a < ({RATIONAL}))?")
TERM = re.compile(r"([+-]) *([0-9]{1,6}(?:/[1-9][0-9]{0,5})?|) *\*? *(a?)(?:\^([0-9]{1,2}))? *")
FORMS = '"Q", "GF(q)", "Q(a) with a^2 - 2 = 0" or "Q(a) with a^2 - 2 = 0 and 1 < a < 2"'


def read_field(given: object) -> Field:
    """Return the field. Raises InvalidInput that begins with `fields`."""
    if given == "Q":
        return QQ
    if found := re.fullmatch(r"GF\(([0-9]{1,9})\)", str(given)):
        prime = int(found[1])
        if prime > LARGEST_PRIME or not fmpz(prime).is_prime():
            raise InvalidInput(f"fields: got {given}, expected GF(q) with a prime q up to {LARGEST_PRIME}")
        return PrimeField(prime)
    found = WITH_A.fullmatch(given) if isinstance(given, str) else None
    if found is None:
        raise InvalidInput(f"fields: got {shorten(given)}, expected {FORMS}")
    try:
        coefficients = in_a(found[1])
        if not 1 < len(coefficients) <= LARGEST_DEGREE + 1:
            raise InvalidInput(f"got the degree {len(coefficients) - 1}, expected 1 to {LARGEST_DEGREE}")
        if found[2] is None:
            return NumberField(coefficients)
        return RealField(coefficients, Fraction(found[2]), Fraction(found[3]))
    except InvalidInput as error:
        raise InvalidInput(f"fields: {shorten(given)}: {error}") from None


def in_a(text: str) -> tuple[Fraction, ...]:
    """Return the coefficients of a polynomial in a, ascending. Raises InvalidInput."""
    compact = text.strip()
    compact = compact if compact[:1] in ("+", "-") else f"+{compact}"
    coefficients: dict[int, Fraction] = {}
    place = 0
    while place < len(compact):
        term = TERM.match(compact, place)
        if term is None or not (term[2] or term[3]) or (term[4] and not term[3]):
            raise InvalidInput(f"got {shorten(text)}, expected a polynomial in a such as a^2 - 1/2 a + 1")
        power = int(term[4] or 1) if term[3] else 0
        coefficients[power] = coefficients.get(power, Fraction(0)) + Fraction(term[1] + (term[2] or "1"))
        place = term.end()
    while coefficients and not coefficients[max(coefficients)]:
        del coefficients[max(coefficients)]
    return tuple(coefficients.get(k, Fraction(0)) for k in range(max(coefficients, default=0) + 1))


def usual_entries(field: Field) -> tuple[Number, ...]:
    """Return -1, 0, 1; all residues between -q/2 and q/2, which over GF(2) are 0 and 1; -a, -1, 0, 1, a over a number field."""
    if isinstance(field, PrimeField):
        return tuple(Fraction(x) for x in range(-((field.p - 1) // 2), field.p // 2 + 1))
    plain = (Fraction(-1), Fraction(0), Fraction(1))
    if not isinstance(field, NumberField):
        return plain
    a = field.from_coordinates([0, 1]) if field.degree > 1 else field.element(-field.modulus[0] / field.modulus[1])
    return _in_order({field.element(x) for x in plain} | {a, -a}, field)


def read_entries(given: object, field: Field) -> tuple[Number, ...]:
    """Return them in order, none twice. Raises InvalidInput that begins with `box.entries`."""
    sample = '"-1/2"' if not isinstance(field, NumberField) else '"1 - 1/2 a"'
    wanted = f"expected a list of at most {MOST_ENTRIES} integers or strings such as {sample}"
    if not isinstance(given, (list, tuple)) or not 1 <= len(given) <= MOST_ENTRIES:
        raise InvalidInput(f"box.entries: got {shorten(given)}, {wanted}")
    found: set[Number] = set()
    for x in given:
        if type(x) is int and abs(x) < 10**6:
            value: Number = Fraction(x)
        elif isinstance(x, str) and re.fullmatch(RATIONAL, x):
            value = Fraction(x)
        elif isinstance(x, str) and "a" in x and isinstance(field, NumberField):
            value = _element(x, field)
        else:
            raise InvalidInput(f"box.entries: got {shorten(x)}, {wanted}")
        if isinstance(field, PrimeField) and isinstance(value, Fraction):
            value = _residue(value, field.p)
        found.add(field.element(value) if isinstance(field, NumberField) else value)
    return _in_order(found, field)


def _element(text: str, field: NumberField) -> AlgebraicNumber:
    try:
        coefficients = in_a(text)
    except InvalidInput as error:
        raise InvalidInput(f"box.entries: {error}") from None
    if len(coefficients) > field.degree:
        raise InvalidInput(f"box.entries: got {shorten(text)} of degree {len(coefficients) - 1}, expected at most {field.degree - 1}")
    found: AlgebraicNumber = field.element([*coefficients, *[Fraction(0)] * field.degree][: field.degree])
    return found


def _residue(value: Fraction, prime: int) -> Fraction:
    if value.denominator % prime == 0:
        raise InvalidInput(f"box.entries: got {value} over GF({prime}), expected denominators that {prime} does not divide")
    residue = value.numerator * pow(value.denominator, -1, prime) % prime
    return Fraction(residue - prime if residue > prime // 2 else residue)


def _in_order(found: set[Number], field: Field) -> tuple[Number, ...]:
    """Return the numbers ascending; those of a number field by their coordinates, the highest power of a first."""
    if not isinstance(field, NumberField):
        return tuple(sorted(found))  # type: ignore[type-var]
    return tuple(sorted(found, key=lambda x: [Fraction(int(c.p), int(c.q)) for c in reversed(field.coordinates(x))]))
