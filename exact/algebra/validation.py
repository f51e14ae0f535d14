"""What the exact branch accepts, in one place: the limits and the grammar of a rational.

MAX_DIMENSION       n + m + p may be at most this
MAX_BITS            bits of one numerator or denominator
MAX_FILE_BYTES      bytes of one file
MAX_ENTRIES         entries of one matrix: at eight bytes each, before there is a number in them, this is one GiB
whole               an integer of any type as an int, None for what is none
natural             an integer >= 0, or InvalidInput
fits                InvalidInput for a matrix of more entries than MAX_ENTRIES
parse_rational      "-?[0-9]+(/[1-9][0-9]*)?" or an integer, nothing else
"""

from __future__ import annotations

import re
from fractions import Fraction
from numbers import Integral

from flint import fmpq, fmpz

from ...base.errors import InvalidInput, shorten

MAX_DIMENSION = 512
MAX_BITS = 65536
MAX_FILE_BYTES = 64 * 1024 * 1024
MAX_FIELD_DEGREE = 16
MAX_ENTRIES = 2**27
_MAX_DIGITS = MAX_BITS * 30103 // 100000 + 1
_RATIONAL = re.compile(r"-?[0-9]+(/[1-9][0-9]*)?", re.ASCII)
_SCIENTIFIC = re.compile(r"-?[0-9]{1,99}(\.[0-9]{0,99})?[eE][+-]?[0-9]{1,2}", re.ASCII)


def whole(value: object) -> int | None:
    """Return the value as an int where it is an integer, numpy's among them; None for anything else, truth values and floats too."""
    if type(value) is int:
        return value
    return int(value) if isinstance(value, Integral) and not isinstance(value, bool) else None


def natural(value: object, name: str, *, least: int = 0, most: int | None = None) -> int:
    """Return the value where it is an integer from `least` to `most`, and no truth value. Raises InvalidInput, naming `name`."""
    number = whole(value)
    if number is None or number < least or (most is not None and number > most):
        wanted = f">= {least}" if most is None else f"from {least} to {most}"
        raise InvalidInput(f"{name}: got {shorten(value)}, expected an integer {wanted}")
    return number


def fits(rows: int, columns: int, name: str) -> None:
    """Raise InvalidInput for a matrix of more than MAX_ENTRIES entries, before there is one: FLINT ends the process where memory ends."""
    if rows * columns > MAX_ENTRIES:
        raise InvalidInput(f"{name}: got a matrix of {shorten(rows)} x {shorten(columns)}, at most {MAX_ENTRIES} entries are supported")


def parse_rational(value: object, where: str) -> fmpq:
    """Return the rational that a string or integer stands for; its length is bounded before it is parsed.

    Raises InvalidInput, naming `where`, for anything else: floats, booleans, exponents, decimal points, a zero denominator.
    """
    number = None if type(value) is str else whole(value)
    if number is not None:
        if number.bit_length() > MAX_BITS:
            raise InvalidInput(f"{where}: got an integer of {number.bit_length()} bits, at most {MAX_BITS} are allowed")
        return fmpq(number)
    if type(value) is not str:
        raise InvalidInput(f'{where}: got {shorten(value)}, expected a rational string such as "-3/4"{_hint(value)}')
    if len(value) > 2 * _MAX_DIGITS + 2:
        raise InvalidInput(f"{where}: got {len(value)} characters, a numerator or denominator has at most {MAX_BITS} bits")
    if not _RATIONAL.fullmatch(value):
        raise InvalidInput(f'{where}: got {shorten(value)}, expected a rational string such as "-3/4"{_hint(value)}')
    if len(value) < 16 and value.isdecimal():
        return fmpq(int(value))
    numerator, _, denominator = value.partition("/")
    top, bottom = fmpz(numerator), fmpz(denominator or "1")
    if max(abs(top), bottom).bit_length() > MAX_BITS:
        raise InvalidInput(f"{where}: a numerator or denominator has more than {MAX_BITS} bits")
    return fmpq(top, bottom)


def _hint(value: object) -> str:
    """Return what to write instead of a value that is no rational, in brackets; empty where nothing is known of it."""
    if isinstance(value, bool):
        return " (a truth value is no number: write 1 or 0)"
    if isinstance(value, float):
        return " (floats are not exact; see from_float_exactly)"
    if getattr(value, "is_algebraic", False) and getattr(value, "is_irrational", False):  # of sympy, which is not loaded here
        return ' (an irrational number needs a number field: field={"minimal_polynomial": ["-2", "0", "1"]} is that of sqrt(2))'
    if not isinstance(value, str):
        return ""
    if re.fullmatch(r"-?[0-9]+/0+", value, re.ASCII):
        return " (the denominator is zero)"
    if re.fullmatch(r"-?[0-9]*\.[0-9]+", value, re.ASCII):
        return ' (decimals are written as fractions: "1/2")'
    return f' (write "{Fraction(value)}")' if _SCIENTIFIC.fullmatch(value) else ""
