"""Systems with planted poles and zeros, exactly: scalar channels, a tall system behind them, another basis over all of it.

A channel has its poles and zeros by construction. A bank of channels, side by side, followed by a tall system that has no zeros has those
of the channels and no others; it is observable where the tall one is. All entries are dyadic, so that floats hold them.

    Bank        channels side by side, as matrices
    channel     one input, one output, the given numerator over the given denominator, in controllable canonical form
    delay       a channel that holds its input back by so many samples
    beside      banks side by side
    series      a bank, and a system that reads its outputs
    tall        a stable system drawn at random, of a given number of states, inputs and outputs
    tall_without_zeros   the same, drawn again until it has neither finite nor infinite zeros
    hidden      the same system in another basis of its states and of its faults
    times       a product of polynomials (ascending coefficients)
    resized     the same system with its faults and outputs in other units
    digits, late, spiked   fault signals: digits at random; after a long silence; with one sample far larger than the others
    factor      z - a;   pair   z^2 - 2 re z + (re^2 + im^2)
    stable      a random rational matrix
    upward      a bound rounded up, with two digits;   TELLING   how large a bound may be, beside its quantity
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from random import Random

import numpy as np

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, stacked
from faultspace.exact.algebra.matrices import beside as columns_beside
from faultspace.exact.structure.record import analyze
from faultspace.exact.system.systems import ResidualSystem

from ..vectors.rationals import fractions, matrix, scaled

Polynomial = Sequence[Fraction]
HALVES = (Fraction(1, 2), Fraction(-1, 2), Fraction(1, 4), Fraction(-1, 4), Fraction(3, 4), Fraction(-3, 4))
DRAWS = 100
SILENCE = 200  # samples: twice as many as the longest record that begins at once
SPIKE = 1000  # times
MEAN = 100
SMALL = 30


def factor(root: Fraction | int) -> list[Fraction]:
    """Return z - root."""
    return [-Fraction(root), Fraction(1)]


def pair(real: Fraction | int, imaginary: Fraction | int) -> list[Fraction]:
    """Return the polynomial with the roots real +- imaginary i."""
    real, imaginary = Fraction(real), Fraction(imaginary)
    return [real**2 + imaginary**2, -2 * real, Fraction(1)]


def times(*factors: Polynomial) -> list[Fraction]:
    """Return the product of the polynomials; 1 where there are none."""
    result = [Fraction(1)]
    for one in factors:
        product = [Fraction(0)] * (len(result) + len(one) - 1)
        for i, a in enumerate(result):
            for j, b in enumerate(one):
                product[i + j] += a * b
        result = product
    return result


def channel(numerator: Polynomial, denominator: Polynomial) -> ResidualSystem:
    """Return numerator / denominator, the denominator monic and of no lower degree."""
    n = len(denominator) - 1
    padded = [*numerator, *([Fraction(0)] * (n + 1 - len(numerator)))]
    direct = padded[n]
    A = [[Fraction(int(j == i + 1)) for j in range(n)] for i in range(n - 1)]
    if n:
        A.append([-a for a in denominator[:n]])
    F = [[Fraction(int(i == n - 1))] for i in range(n)]
    C = [[padded[i] - direct * denominator[i] for i in range(n)]]
    return ResidualSystem(matrix(A, n), matrix(F, 1), matrix(C, n), matrix([[direct]], 1))


def delay(samples: int) -> ResidualSystem:
    """Return z^-samples."""
    return channel([Fraction(1)], times(*[factor(0)] * samples))


def beside(*parts: ResidualSystem) -> ResidualSystem:
    """Return the systems side by side: states, inputs and outputs one after the other."""

    return ResidualSystem(*(reduce(_diagonal, (getattr(one, name) for one in parts)) for name in "AFCG"))


def _diagonal(one: Matrix, other: Matrix) -> Matrix:
    above, below = Matrix.zero(one.field, one.nrows, other.ncols), Matrix.zero(one.field, other.nrows, one.ncols)
    return columns_beside(stacked(one, below), stacked(above, other))


def series(first: ResidualSystem, second: ResidualSystem) -> ResidualSystem:
    """Return the system that reads the outputs of `first` as its faults; states of `first` come first."""
    held = Matrix.zero(first.A.field, first.n, second.n)
    A = columns_beside(stacked(first.A, second.F @ first.C), stacked(held, second.A))
    F, C = stacked(first.F, second.F @ first.G), columns_beside(second.G @ first.C, second.C)
    return ResidualSystem(A, F, C, second.G @ first.G)


def tall(rng: Random, n: int, m: int, p: int) -> ResidualSystem:
    """Return a system with eigenvalues among HALVES, fourths elsewhere; G has rank m where p >= m, most of the time."""
    A = [[rng.choice(HALVES) if j == i else Fraction(rng.randint(-1, 1), 4) if j > i else 0 for j in range(n)] for i in range(n)]
    return ResidualSystem(matrix(A, n), *(drawn_dyadic(rng, *shape) for shape in ((n, m), (p, n), (p, m))))


def tall_without_zeros(rng: Random, n: int, m: int, p: int) -> ResidualSystem:
    """Raises ArithmeticError where DRAWS systems all have zeros, as all square ones with states have."""
    for _ in range(DRAWS):
        found = tall(rng, n, m, p)
        known = analyze(found)
        if known.left_invertible and known.zeta == 0 and known.observable:
            return found
    raise ArithmeticError(f"no system with {n} states, {m} faults and {p} outputs has no zeros among {DRAWS} draws")


def drawn_dyadic(rng: Random, height: int, width: int) -> Matrix:
    """Return entries +-1/2, +-1, +-3/2, +-2."""
    values = [Fraction(d, 2) for d in range(-4, 5) if d]
    return matrix([[rng.choice(values) for _ in range(width)] for _ in range(height)], width)


def hidden(rng: Random, system: ResidualSystem) -> ResidualSystem:
    """Return the system in the states T x and the faults V v, T and V products of a permutation and of shears by +-1."""
    T, inverse = _unimodular(rng, system.n)
    V, _ = _unimodular(rng, system.m)
    return ResidualSystem(T @ system.A @ inverse, T @ system.F @ V, system.C @ inverse, system.G @ V)


def _unimodular(rng: Random, size: int) -> tuple[Matrix, Matrix]:
    """Return an integer matrix of determinant +-1, a shear for each row at most, and its inverse."""
    order = list(range(size))
    rng.shuffle(order)
    there = Matrix.identity(QQ, size).rows(order)
    back = there.transposed()
    for i in range(1, size):
        j, sign = rng.randrange(i), rng.choice((-1, 1))
        shear = matrix([[int(a == b) + sign * int((a, b) == (i, j)) for b in range(size)] for a in range(size)], size)
        undone = matrix([[int(a == b) - sign * int((a, b) == (i, j)) for b in range(size)] for a in range(size)], size)
        there, back = shear @ there, back @ undone
    return there, back


def resized(system: ResidualSystem, faults: Sequence[Fraction], outputs: Sequence[Fraction]) -> ResidualSystem:
    """Return the system with column j of F and G multiplied by faults[j], and row i of C and G by outputs[i]."""
    C, G = (scaled(M.transposed(), outputs).transposed() for M in (system.C, system.G))
    return ResidualSystem(system.A, scaled(system.F, faults), C, scaled(G, faults))


def digits(rng: Random, height: int, width: int, denominator: int = 1) -> Matrix:
    """Return digits over a denominator, none of them zero."""
    values = [Fraction(d, denominator) for d in range(-9, 10) if d]
    return matrix([[rng.choice(values) for _ in range(width)] for _ in range(height)], width)


def late(rng: Random, height: int, width: int) -> Matrix:
    """Return zeros in SILENCE samples, and digits after them."""
    return matrix([[Fraction(0)] * width] * SILENCE + fractions(digits(rng, height, width)), width)


def spiked(rng: Random, height: int, width: int) -> Matrix:
    """Return digits, SPIKE times as large in the sample in the middle."""
    rows = fractions(digits(rng, height, width))
    rows[height // 2] = [SPIKE * x for x in rows[height // 2]]
    return matrix(rows, width)


def about_a_mean(rng: Random, height: int, width: int) -> Matrix:
    """Return digits about MEAN, many times as large as they are."""
    return matrix([[MEAN + x for x in row] for row in fractions(digits(rng, height, width))], width)


def in_unlike_units(rng: Random, height: int, width: int) -> Matrix:
    """Return digits, all columns but the first 2^-SMALL times as large."""
    return matrix([[x / 2 ** (SMALL * (j > 0)) for j, x in enumerate(row)] for row in fractions(digits(rng, height, width))], width)


TELLING = 1e-2  # of the quantity's size: a bound above it asks for nothing


def stable(rng: Random, n: int) -> Matrix:
    """Return entries over 16 or a multiple of it, spectral radius below 0.9."""
    entries = [[rng.randint(-12, 12) for _ in range(n)] for _ in range(n)]
    radius = float(np.max(np.abs(np.linalg.eigvals(np.array(entries, dtype=float)))))
    denominator = 16 * max(1, int(np.ceil(radius / 14.4)))
    return matrix([[Fraction(entry, denominator) for entry in row] for row in entries], n)


def upward(value: float) -> float:
    """Return two digits, never below the value: a bound needs no more, and equal programs then write equal files."""
    return float(f"{value * 1.05:.1e}") if value > 0 else 0.0
