"""These are polynomials in one variable, by the schoolbook, over whatever field their coefficients come from.

A polynomial is a list of field elements by ascending powers without trailing zeros; `[]` is zero.

    trimmed(a)           a without trailing zeros
    degree(a)            -1 for zero
    add, subtract, multiply, divide (quotient, remainder), exact_quotient
    gcd(a, b), monic(a)  greatest common divisors are monic; gcd of zeros is zero
    valuation(a)         the largest power of the variable that divides a (a not zero)
    evaluate(a, x, zero) Horner
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Polynomial = list[Any]


def trimmed(a: Sequence[Any]) -> Polynomial:
    """These are the coefficients without trailing zeros."""
    length = len(a)
    while length and not a[length - 1]:
        length -= 1
    return list(a[:length])


def degree(a: Polynomial) -> int:
    """The result is the degree, -1 for the zero polynomial."""
    return len(a) - 1


def add(a: Polynomial, b: Polynomial) -> Polynomial:
    """The result is a + b."""
    longer, shorter = (a, b) if len(a) >= len(b) else (b, a)
    return trimmed([x + shorter[i] if i < len(shorter) else x for i, x in enumerate(longer)])


def negate(a: Polynomial) -> Polynomial:
    """The result is -a."""
    return [-x for x in a]


def subtract(a: Polynomial, b: Polynomial) -> Polynomial:
    """The result is a - b."""
    return add(a, negate(b))


def multiply(a: Polynomial, b: Polynomial) -> Polynomial:
    """The result is a b."""
    if not a or not b:
        return []
    zero = a[0] - a[0]
    product = [zero] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        if x:
            for j, y in enumerate(b):
                product[i + j] = product[i + j] + x * y
    return trimmed(product)


def divide(a: Polynomial, b: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Quotient and remainder of a by b; raises ZeroDivisionError when b is zero."""
    if not b:
        raise ZeroDivisionError("a polynomial is divided by zero")
    remainder = list(a)
    quotient: Polynomial = []
    for shift in range(len(a) - len(b), -1, -1):
        factor = remainder[shift + len(b) - 1] / b[-1]
        quotient.insert(0, factor)
        for i, y in enumerate(b):
            remainder[shift + i] = remainder[shift + i] - factor * y
    return trimmed(quotient), trimmed(remainder)


def exact_quotient(a: Polynomial, b: Polynomial) -> Polynomial:
    """The result is a / b when b divides a; raises ArithmeticError when it does not."""
    quotient, remainder = divide(a, b)
    if remainder:
        raise ArithmeticError("the division of polynomials leaves a remainder")
    return quotient


def monic(a: Polynomial) -> Polynomial:
    """a over its leading coefficient; zero stays zero."""
    return [x / a[-1] for x in a]


def gcd(a: Polynomial, b: Polynomial) -> Polynomial:
    """The result is the monic greatest common divisor by Euclid's algorithm; zero when both are."""
    while b:
        a, b = b, divide(a, b)[1]
    return monic(a)


def valuation(a: Polynomial) -> int:
    """The result is the largest k such that the k-th power of the variable divides a; raises ValueError for zero."""
    for k, x in enumerate(a):
        if x:
            return k
    raise ValueError("every power divides the zero polynomial")


def evaluate(a: Polynomial, x: Any, zero: Any) -> Any:
    """The result is a(x) by Horner's rule, `zero` being the field's."""
    value = zero
    for coefficient in reversed(a):
        value = value * x + coefficient
    return value
