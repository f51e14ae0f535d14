"""This finds states and faults that no output ever shows, where a few small numbers say them all.

Nulling    states x_1, ..., x_d, faults v_1, ..., v_(d+e), and the states that follow as combinations of the first
nulling    of a system over Q, from its kernel rows modulo a prime; None where the numbers are not small

Where the normal rank is that of G, V*, the states from which some fault keeps the output zero for ever, are the zeros of all states X_j,
j = 1, ..., mu, of the minimal kernel rows, n less the sum of the degrees. A state x of V* is kept there by v_J = -G_IJ^-1 C_I x, in the
notation of `modular_rows`, and faults w that no output tells go with v_J = -G_IJ^-1 G_I w. (Where the normal rank is larger, V* is smaller
than those zeros.) Modulo the prime V* has a basis that is the identity at d places. What is exact has such a basis, too. Where its numbers
are small the residues tell them, and the exact equations are seen to hold; else exact kernel rows serve better, for a basis of V* has
d (n - d) numbers as long as minors. Source: [TSH01].
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isqrt

from flint import fmpq, fmpq_mat

from ..algebra.matrices import Matrix
from ..system.systems import ResidualSystem
from .modular_rows import ModularRows, null_space, placed, selection
from .window_columns import residues


@dataclass(frozen=True)
class Nulling:
    """`states` is d x n, `faults` (d + e) x m, `motion` (d + e) x d: C x_i + G v_i = 0 and A x_i + F v_i is the sum of motion_ij x_j.

    From d on x_i is zero.
    """

    states: Matrix
    faults: Matrix
    motion: Matrix


def nulling(system: ResidualSystem, picture: ResidualSystem, rows: ModularRows) -> Nulling | None:
    """Return them from the system, its image modulo a prime, and the kernel rows of that. None also where the rank of G is too small."""
    if rows.point != "infinity":
        return None
    n, m, prime, reduced = system.n, system.m, picture.field.p, rows.reduced  # type: ignore[union-attr]
    basis = null_space(placed(rows.states, n, prime))
    d, table = basis.nrows(), residues(basis)
    places = [max(j for j, x in enumerate(row) if x) for row in table]
    rest = [j for j in range(m) if j not in reduced.used]
    used, first = selection(reduced.used, m, prime), selection(reduced.chosen, system.p, prime)
    told = (first * picture.C.flint).transpose(), (first * picture.G.flint * selection(rest, m, prime).transpose()).transpose()
    of_states, of_faults = (part * reduced.inverse.transpose() * used for part in (basis * told[0], told[1]))
    inputs = residues(-1 * of_states) + residues(selection(rest, m, prime) - of_faults)
    exact = [_reconstructed(numbers, prime) for numbers in (table, inputs)]
    if exact[0] is None or exact[1] is None:
        return None
    states, faults, e = fmpq_mat(d, n, exact[0]), fmpq_mat(d + len(rest), m, exact[1]), len(rest)
    above = fmpq_mat(d + e, n, exact[0] + [fmpq(0)] * (n * e))
    following = above * system.A.flint.transpose() + faults * system.F.flint.transpose()
    picking = fmpq_mat(n, d)
    for j, place in enumerate(places):
        picking[place, j] = 1
    motion = following * picking
    outputs = above * system.C.flint.transpose() + faults * system.G.flint.transpose()
    if following != motion * states or outputs:
        return None
    field = system.field
    return Nulling(Matrix(field, d, n, states), Matrix(field, d + e, m, faults), Matrix(field, d + e, d, motion))


def _reconstructed(rows: list[list[int]], prime: int) -> list[fmpq] | None:
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
