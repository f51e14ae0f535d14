"""These are shorter integer rows for the same windows: rows of one degree become a reduced basis of all integer points of their span.

short_rows    of rows of integers that are triangular by their pivots, as `integer_relations` finds them: any rows of one degree

Such a row is den at its pivot and zero at the pivots of the others, den their common denominator: the rows are a basis of the points of the
lattice whose coordinates at the pivots are multiples of den. A combination of them by integers, over den, is integral iff it is zero modulo
den; these combinations are found one coordinate at a time. An LLL-reduced basis of them is shorter by a factor that grows with the number
of rows: five rows of one degree have numbers of a quarter of the length. The rows are over Q only.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm

from flint import fmpz_mat

Row = list[list[int]]
WORD = 64  # bits; rows of shorter numbers are written and checked no faster


def short_rows(rows: Sequence[Row], pivots: Sequence[int]) -> list[Row]:
    """Return as many rows of the same degrees, ascending, whose combinations with polynomial coefficients over Q are the same."""
    found = list[Row]()
    for length in sorted({len(row) for row in rows}):
        alike = [(row, pivot) for row, pivot in zip(rows, pivots, strict=True) if len(row) == length]
        short = max(abs(x).bit_length() for row, _ in alike for c in row for x in c) <= WORD
        found += [row for row, _ in alike] if short or len(alike) == 1 else _reduced(alike, length)
    return found


def _reduced(alike: Sequence[tuple[Row, int]], length: int) -> list[Row]:
    p, count = len(alike[0][0][0]), len(alike)
    flat, places = [[x for c in row for x in c] for row, _ in alike], [(length - 1) * p + pivot for _, pivot in alike]
    if any(row[place] and row is not own for own, place in zip(flat, places, strict=True) for row in flat):
        return [row for row, _ in alike]  # not triangular: nothing is known of such rows
    den = lcm(*(row[place] for row, place in zip(flat, places, strict=True)))
    full = fmpz_mat([[x * (den // row[place]) for x in row] for row, place in zip(flat, places, strict=True)])
    basis = fmpz_mat(count, count, [int(i == j) for i in range(count) for j in range(count)])
    for j in range(full.ncols()):
        values = [int(x) % den for x in (basis * fmpz_mat(count, 1, [full[i, j] for i in range(count)])).entries()]
        if any(values):
            weight = den << count  # the points beside which den times any row lies are reduced to less than that: their last entry is 0
            table = [[*map(int, row), weight * x] for row, x in zip(basis.tolist(), values, strict=True)]
            reduced = fmpz_mat([*table, [0] * count + [weight * den]]).lll().tolist()
            basis = fmpz_mat([row[:count] for row in reduced if row[count] == 0])
    points = basis * full
    short = fmpz_mat(count, full.ncols(), [int(x) // den for x in points.entries()]).lll()
    return [[[int(x) for x in row[k : k + p]] for k in range(0, len(row), p)] for row in short.tolist()]
