"""What the makers of vectors share: matrices drawn from a seed, and bounds written with two digits.

drawn, stable    random rational matrices
upward           a bound rounded up
TELLING          how large a bound may be, beside its quantity
"""

from __future__ import annotations

from fractions import Fraction
from random import Random

import numpy as np

from faultspace.exact.algebra.matrices import Matrix

from ..vectors.rationals import matrix

TELLING = 1e-2  # of the quantity's size: a bound above it asks for nothing


def drawn(rng: Random, height: int, width: int, denominator: int) -> Matrix:
    """Return digits over a denominator, none of them zero."""
    digits = [d for d in range(-9, 10) if d]
    return matrix([[Fraction(rng.choice(digits), denominator) for _ in range(width)] for _ in range(height)], width)


def stable(rng: Random, n: int) -> Matrix:
    """Return entries over 16 or a multiple of it, spectral radius below 0.9."""
    entries = [[rng.randint(-12, 12) for _ in range(n)] for _ in range(n)]
    radius = float(np.max(np.abs(np.linalg.eigvals(np.array(entries, dtype=float)))))
    denominator = 16 * max(1, int(np.ceil(radius / 14.4)))
    return matrix([[Fraction(entry, denominator) for entry in row] for row in entries], n)


def upward(value: float) -> float:
    """Return two digits, never below the value: a bound needs no more, and equal programs then write equal files."""
    return float(f"{value * 1.05:.1e}") if value > 0 else 0.0
