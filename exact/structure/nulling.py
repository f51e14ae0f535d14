"""This finds states and faults that no output ever shows, where a few small numbers say them all.

Nulling    states x_1, ..., x_d, faults v_1, ..., v_(d+e), and the states that follow as combinations of the first
nulling    of a system over Q, from the states of its kernel rows modulo a prime; None where the numbers are not small

V*, the states from which some fault keeps the output zero for ever, are the zeros of all X_j, j = 1, ..., mu, of the minimal kernel rows:
n less the sum of the degrees. Modulo the prime V* has a basis that is the identity at d places, and the faults a solution that is zero
where they are free. What is exact has such a basis, too. Where its numbers are small the residues tell them, and the exact equations are
seen to hold; else exact kernel rows serve better, for a basis of V* has d (n - d) numbers as long as minors. Source: [TSH01].
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isqrt

from flint import fmpq, fmpq_mat, nmod_mat

from ..algebra.matrices import Matrix
from ..system.systems import ResidualSystem
from .window_columns import residues

Residues = list[list[int]]


@dataclass(frozen=True)
class Nulling:
    """`states` is d x n, `faults` (d + e) x m, `motion` (d + e) x d: C x_i + G v_i = 0 and A x_i + F v_i is the sum of motion_ij x_j.

    From d on x_i is zero.
    """

    states: Matrix
    faults: Matrix
    motion: Matrix


def nulling(system: ResidualSystem, picture: ResidualSystem, functionals: Residues) -> Nulling | None:
    """Return them from the system, its image modulo a prime, and the X_j of the kernel rows of that."""
    n, m, prime = system.n, system.m, picture.field.p  # type: ignore[union-attr]
    A, F, C, G = (part.flint for part in (picture.A, picture.F, picture.C, picture.G))
    free, basis = _null_space(functionals, n, prime)
    d = len(free)
    V = nmod_mat(d, n, [x for row in basis for x in row], prime)
    chosen = nmod_mat(n, d, prime)
    for j, place in enumerate(free):
        chosen[place, j] = 1
    # (A x + F v) less its part in V*, and C x + G v, are to vanish: rows of unknowns v on the left
    away, feed, moved = chosen * V, F.transpose(), V * A.transpose()
    equations = _beside(feed - feed * away, G.transpose())
    wanted = _beside(moved - moved * away, V * C.transpose())
    kept, faults = _solutions(equations, wanted, prime)
    if faults is None:
        return None
    exact = [_reconstructed(rows, prime) for rows in (residues(V), [*faults, *kept])]
    if exact[0] is None or exact[1] is None:
        return None
    states, inputs = fmpq_mat(d, n, exact[0]), fmpq_mat(d + len(kept), m, exact[1])
    above = fmpq_mat(d + len(kept), n, exact[0] + [fmpq(0)] * (n * len(kept)))
    following = above * system.A.flint.transpose() + inputs * system.F.flint.transpose()
    motion = following * fmpq_mat(n, d, [int(place == i) for i in range(n) for place in free])
    outputs = above * system.C.flint.transpose() + inputs * system.G.flint.transpose()
    if following != motion * states or any(outputs.entries()):
        return None
    field, count = system.field, d + len(kept)
    return Nulling(Matrix(field, d, n, states), Matrix(field, count, m, inputs), Matrix(field, count, d, motion))


def _null_space(functionals: Residues, n: int, prime: int) -> tuple[list[int], Residues]:
    """Return the places of free coordinates, and the basis of the common zeros that is the identity there."""
    reduced, rank = nmod_mat(len(functionals), n, [x for row in functionals for x in row], prime).rref()
    table = residues(reduced)[:rank]
    pivots = [next(j for j, x in enumerate(row) if x) for row in table]
    free = [j for j in range(n) if j not in set(pivots)]
    basis = [[0] * n for _ in free]
    for vector, place in zip(basis, free, strict=True):
        vector[place] = 1
        for row, pivot in zip(table, pivots, strict=True):
            vector[pivot] = -row[place] % prime
    return free, basis


def _beside(left: nmod_mat, right: nmod_mat) -> nmod_mat:
    rows = [a + b for a, b in zip(residues(left), residues(right), strict=True)]
    return nmod_mat(len(rows), left.ncols() + right.ncols(), [x for row in rows for x in row], left.modulus())


def _solutions(equations: nmod_mat, wanted: nmod_mat, prime: int) -> tuple[Residues, Residues | None]:
    """Return a basis of the rows u with u equations = 0, and the rows v with v equations = -wanted that are zero where u are free."""
    m, d = equations.nrows(), wanted.nrows()
    sides = zip(residues(equations.transpose()), residues(-1 * wanted.transpose()), strict=True)
    reduced, rank = nmod_mat(equations.ncols(), m + d, [x for row, other in sides for x in (*row, *other)], prime).rref()
    table = residues(reduced)[:rank]
    pivots = [next(j for j, x in enumerate(row) if x) for row in table]
    if any(pivot >= m for pivot in pivots):
        return [], None
    _, kept = _null_space([row[:m] for row in table], m, prime)
    faults = [[0] * m for _ in range(d)]
    for row, pivot in zip(table, pivots, strict=True):
        for i in range(d):
            faults[i][pivot] = row[m + i]
    return kept, faults


def _reconstructed(rows: Residues, prime: int) -> list[fmpq] | None:
    """Return the entries as the fractions with numerator and denominator up to sqrt(prime / 2) that they may be; None where one is none."""
    bound, known = isqrt(prime // 2), dict[int, fmpq]()
    for x in {x for row in rows for x in row}:
        (a, s), (b, t) = (prime, 0), (x, 1)
        while b > bound:
            (a, s), (b, t) = (b, t), (a % b, s - a // b * t)
        if not 0 < abs(t) <= bound:
            return None
        known[x] = fmpq(b, t)
    return [known[x] for row in rows for x in row]
