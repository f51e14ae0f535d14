"""Inputs by the reflection coefficients of their spectrum: every value in (-1, 1) gives a stationary input with a rational filter.

    Shaped         numerator and denominator of a scalar filter, ascending in lag
    shaped_input   from reflection coefficients k_1, ..., k_N and the zeros and gain of the Schur function that remains after them

With z = q^-1 the spectrum of u is (1 - |f|^2) / |1 - z f|^2 for a Schur function f, and f is k_1, ..., k_N followed by what remains, by
f_(i-1) = (k_i + z f_i) / (1 + k_i z f_i). Written f_i = p_i / q_i this is p_(i-1) = k_i q_i + z p_i, q_(i-1) = q_i + k_i z p_i, and
|q|^2 - |p|^2 only changes by the factor 1 - k_i^2. What remains is a gain c times a Blaschke product of real zeros b: with |c| < 1 the
spectrum has the factor (1 - b z) ... over 1 - z f, and u = that filter of white noise, up to scale. gain 0: autoregressive of order N.
The covariances of u up to lag i depend on k_1, ..., k_i alone. Source: [S17].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Shaped:
    """A filter makes u = (sum numerator_j q^-j / sum denominator_j q^-j) e; the denominator begins with 1 and is Schur-stable."""

    numerator: tuple[Any, ...]
    denominator: tuple[Any, ...]


def shaped_input(coefficients: Sequence[Any], zeros: Sequence[Any] = (), gain: Any = 0) -> Shaped:
    """Return the input with these reflection coefficients, each in (-1, 1), and the remaining Schur function gain * prod (z - b)/(1 - b
    z)."""
    p, q = [gain], [gain * 0 + 1]
    for b in zeros:
        p, q = _times(p, (-b, 1)), _times(q, (1, -b))
    numerator = q
    for k in reversed(coefficients):
        shifted = [0, *p]
        p, q = _sum([k * x for x in q], shifted), _sum(q, [k * x for x in shifted])
    denominator = _sum(q, [-x for x in (0, *p)])
    return Shaped(tuple(numerator), tuple(denominator))


def _times(first: Sequence[Any], second: Sequence[Any]) -> list[Any]:
    result = [0 * first[0]] * (len(first) + len(second) - 1)
    for i, x in enumerate(first):
        for j, y in enumerate(second):
            result[i + j] = result[i + j] + x * y
    return result


def _sum(first: Sequence[Any], second: Sequence[Any]) -> list[Any]:
    size = max(len(first), len(second))
    return [(first[i] if i < len(first) else 0) + (second[i] if i < len(second) else 0) for i in range(size)]
