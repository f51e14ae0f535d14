"""These are rational matrices as the vectors hold them, and the one way in which they become floats."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from fractions import Fraction
from typing import Any

import numpy as np

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.system.systems import ResidualSystem

from ....base.arrays import Array

ROUNDING = "each rational to the nearest IEEE binary64, ties to even, once"


def matrix(rows: Sequence[Sequence[Any]], width: int) -> Matrix:
    """Return a matrix over Q, from strings, integers or Fractions; `width` for matrices without rows."""
    return Matrix.of([[str(entry) for entry in row] for row in rows], shape=(len(rows), width))


def residual_system(written: Mapping[str, Any]) -> ResidualSystem:
    """Return the system whose matrices A, F, C and G a vector's file holds, each as a list of rows."""
    return ResidualSystem.of(*(written[name] for name in "AFCG"))


def fractions(given: Matrix) -> list[list[Fraction]]:
    """These are the entries as Fractions."""
    return [[Fraction(int(x.p), int(x.q)) for x in row] for row in given.elements()]


def floats(given: Matrix) -> Array:
    """Return each entry correctly rounded; a new array at every call."""
    # Python divides two integers with one rounding, to nearest, ties to even.
    found = np.array([[int(x.p) / int(x.q) for x in row] for row in given.elements()], dtype=np.float64).reshape(given.shape)
    if (kept := _ROUNDED.get()) is not None:
        kept.append((found.copy(), given))
    return found


_ROUNDED: ContextVar[list[tuple[Array, Matrix]] | None] = ContextVar("rounded", default=None)


@contextmanager
def roundings() -> Iterator[list[tuple[Array, Matrix]]]:
    """Keep what `floats` rounds in the body: each array with the matrix that it was."""
    kept: list[tuple[Array, Matrix]] = []
    token = _ROUNDED.set(kept)
    try:
        yield kept
    finally:
        _ROUNDED.reset(token)


def scaled(given: Matrix, factors: Sequence[Fraction]) -> Matrix:
    """Column j is multiplied by factors[j]."""
    exact = [QQ.element(factor) for factor in factors]
    return Matrix.from_elements(QQ, *given.shape, [[x * f for x, f in zip(row, exact, strict=True)] for row in given.elements()])


def signs(seed: int, count: int) -> Array:
    """Return +-1 by bit 63 of the linear congruential generator x := 6364136223846793005 x + 1442695040888963407 mod 2^64 from `seed`."""
    state, result = seed, np.empty(count)
    for k in range(count):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        result[k] = 1.0 if state >> 63 else -1.0
    return result
