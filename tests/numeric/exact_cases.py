"""Systems and records over Q, and the same correctly rounded: where float answers meet exact ones.

ExactCase       A, B, C, D, x0, u, y over Q
exact_case      a random one without noise or fault, stable, entries of few digits, not all of them dyadic
floats          a rational matrix, each entry correctly rounded
bandpass        u of few effective directions: exact, and with a large condition number of its Hankel matrix
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.signals import simulate
from faultspace.exact.system.systems import ResidualSystem


def floats(matrix: Matrix) -> Any:
    """Return a rational matrix, each entry correctly rounded."""
    return np.array(matrix.to_sympy().tolist(), dtype=float).reshape(matrix.shape)


@dataclass(frozen=True, eq=False)
class ExactCase:
    """The system is x(k+1) = A x + B u, y = C x + D u over Q, with one record u (N, n_u), y (N, p) from x0 (n, 1)."""

    A: Matrix
    B: Matrix
    C: Matrix
    D: Matrix
    x0: Matrix
    u: Matrix
    y: Matrix

    @property
    def n(self) -> int:
        return self.A.nrows

    def data(self) -> tuple[Any, Any]:
        """Return (y, u) in floats."""
        return floats(self.y), floats(self.u)


def matrix(rows: list[list[Any]], width: int) -> Matrix:
    return Matrix.of([[str(entry) for entry in row] for row in rows], shape=(len(rows), width))


def _drawn(rng: Random, height: int, width: int, denominator: int) -> Matrix:
    return matrix([[Fraction(rng.randint(-9, 9), denominator) for _ in range(width)] for _ in range(height)], width)


def stable_state_matrix(rng: Random, n: int) -> Matrix:
    """Return entries over 16 or a multiple of it, spectral radius below 0.9."""
    entries = [[rng.randint(-12, 12) for _ in range(n)] for _ in range(n)]
    radius = float(np.max(np.abs(np.linalg.eigvals(np.array(entries, dtype=float)))))
    denominator = 16 * max(1, int(np.ceil(radius / 14.4)))
    return matrix([[Fraction(entry, denominator) for entry in row] for row in entries], n)


def bandpass(u: Matrix, smoothing: int) -> Matrix:
    """Return running sums of neighbouring samples, `smoothing` times."""
    signal = u
    for _ in range(smoothing):
        rows = range(signal.nrows - 1)
        signal = signal.rows(rows) + signal.rows([k + 1 for k in rows])
    return signal


def exact_case(seed: int, n: int, n_u: int, p: int, *, samples: int = 60, smoothing: int = 0) -> ExactCase:
    """Return a random case; `smoothing` makes the Hankel matrix of u as ill-conditioned as one likes."""
    rng = Random(seed)
    A, B, C, D = stable_state_matrix(rng, n), _drawn(rng, n, n_u, 3), _drawn(rng, p, n, 5), _drawn(rng, p, n_u, 7)
    u = bandpass(_drawn(rng, samples + smoothing, n_u, 3), smoothing)
    x0 = _drawn(rng, n, 1, 1) + matrix([[20]] * n, 1)
    return ExactCase(A, B, C, D, x0, u, simulate(ResidualSystem(A, B, C, D), x0, u).residuals)
