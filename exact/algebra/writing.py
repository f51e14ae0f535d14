"""How a polynomial is written for people: highest power first, signs between the terms.

sum_of_powers      from the texts of its coefficients, by ascending power
"""

from __future__ import annotations

from collections.abc import Sequence


def sum_of_powers(coefficients: Sequence[str], unknown: str) -> str:
    """Return the sum of the coefficients times powers of the unknown; compound coefficients in brackets."""
    terms: list[tuple[str, str]] = []
    for power, coefficient in reversed(list(enumerate(coefficients))):
        if coefficient == "0":
            continue
        name = "" if power == 0 else unknown if power == 1 else f"{unknown}^{power}"
        compound = " " in coefficient
        sign = "-" if coefficient.startswith("-") and not compound else "+"
        size = f"({coefficient})" if compound and (name or terms) else coefficient.removeprefix("-") if sign == "-" else coefficient
        terms.append((sign, name if size == "1" and name else f"{size} {name}".rstrip()))
    if not terms:
        return "0"
    first, *rest = terms
    return ("-" if first[0] == "-" else "") + first[1] + "".join(f" {sign} {term}" for sign, term in rest)
