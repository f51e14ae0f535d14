"""What the exact branch accepts, in one place: the limits and the grammar of a rational.

MAX_DIMENSION       n + m + p may be at most this
MAX_BITS            bits of one numerator or denominator
MAX_FILE_BYTES      bytes of one file
parse_rational      "-?[0-9]+(/[1-9][0-9]*)?" or a Python integer, nothing else
"""

from __future__ import annotations

import re

from flint import fmpq, fmpz

from ...base.errors import InvalidInput, shorten

MAX_DIMENSION = 512
MAX_BITS = 65536
MAX_FILE_BYTES = 64 * 1024 * 1024
MAX_FIELD_DEGREE = 16
_MAX_DIGITS = MAX_BITS * 30103 // 100000 + 1
_RATIONAL = re.compile(r"-?[0-9]+(/[1-9][0-9]*)?", re.ASCII)


def parse_rational(value: object, where: str) -> fmpq:
    """The result is the rational that a string or integer stands for; its length is bounded before it is parsed.

    Raises InvalidInput, naming `where`, for anything else: floats, booleans, exponents, decimal points, a zero denominator.
    """
    if type(value) is int:
        number = value
        if number.bit_length() > MAX_BITS:
            raise InvalidInput(f"{where}: got an integer of {number.bit_length()} bits, at most {MAX_BITS} are allowed")
        return fmpq(number)
    if type(value) is not str:
        hint = " (floats are not exact; see from_float_exactly)" if isinstance(value, float) else ""
        raise InvalidInput(f'{where}: got {shorten(value)}, expected a rational string such as "-3/4"{hint}')
    if len(value) > 2 * _MAX_DIGITS + 2:
        raise InvalidInput(f"{where}: got {len(value)} characters, a numerator or denominator has at most {MAX_BITS} bits")
    if not _RATIONAL.fullmatch(value):
        hint = ' (decimals are written as fractions: "1/2")' if re.fullmatch(r"-?[0-9]*\.[0-9]+", value, re.ASCII) else ""
        raise InvalidInput(f'{where}: got {shorten(value)}, expected a rational string such as "-3/4"{hint}')
    numerator, _, denominator = value.partition("/")
    top, bottom = fmpz(numerator), fmpz(denominator or "1")
    if max(abs(top), bottom).bit_length() > MAX_BITS:
        raise InvalidInput(f"{where}: a numerator or denominator has more than {MAX_BITS} bits")
    return fmpq(top, bottom)
