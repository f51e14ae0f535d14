"""How clearly the samples of a residual show its fault space: the singular values of the conditions that the space meets, enclosed.

Rows N, orthonormal, vanish on the windows of s block rows of r. A column [f; g] explains r where N, shifted by each number of samples
within the window, vanishes on its response [0 I; C 0; C A 0; ..] [f; g]: these are the conditions, and the space is their null space. Who
solves them decides a rank twice, that of the windows, which gives N, and that of the conditions. Rounding of the samples turns N by its
norm over the least singular value of the windows at most, and so moves a condition by that times the norm of the response.

conditions_gap    (below the least nonzero singular value of the conditions, above the norm of the response), certified
conditions_clear  whether it stands CLEAR above what rounding makes of it, as those of the windows do
"""

from __future__ import annotations

from fractions import Fraction
from math import sqrt

from faultspace.exact.algebra.matrices import Matrix, beside, left_null_space, solve_left, stacked
from faultspace.exact.structure.signals import hankel
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import observability_matrix

from ..vectors.fault_vectors import CLEAR, channel_units, in_channel_units
from ..vectors.rationals import fractions, scaled
from .fault_records import enclosed_values, singular_values


def conditions_gap(r: Matrix, system: ResidualSystem, block_rows: int) -> tuple[float, float]:
    """Return (below the least nonzero singular value of the conditions, above the norm of the response).

    Channels are in their units, states in the one that makes the largest entry of C one. Where no row vanishes on the windows there are no
    conditions, and the first is infinite.
    """
    p, s = system.p, block_rows
    response = _response(system, [1 / unit for unit in channel_units(r)], s)
    size = enclosed_values(response.transposed() @ response)[1]
    rows = left_null_space(hankel(in_channel_units(r), s))
    if not rows.nrows:
        return float("inf"), size
    gram = rows @ rows.transposed()
    total = Matrix.zero(rows.field, system.n + p, system.n + p)
    for shift in range(s):
        condition = rows.columns(range(shift * p, s * p)) @ response.rows(range((s - shift) * p))
        divided = solve_left(gram, condition.transposed())
        assert divided is not None  # the rows are independent
        total = total + divided @ condition
    return enclosed_values(total)[0], size


def conditions_clear(r: Matrix, system: ResidualSystem, block_rows: int) -> bool:
    """Say whether rounding of the samples leaves no doubt of the dimension of the fault space from windows of so many block rows."""
    least, size = conditions_gap(r, system, block_rows)
    low, high = singular_values(hankel(in_channel_units(r), block_rows))
    return least > CLEAR * sqrt(system.p * block_rows) * high / low * size


def _response(system: ResidualSystem, factors: list[Fraction], block_rows: int) -> Matrix:
    """Return [0 I; C 0; C A 0; ..], block_rows blocks of rows, in the units of `conditions_gap`."""
    n, p = system.n, system.p
    C = scaled(system.C.transposed(), factors).transposed()
    largest = max((abs(x) for row in fractions(C) for x in row), default=Fraction(0)) or Fraction(1)
    unit = scaled(C, [1 / largest] * n)
    later = observability_matrix(ResidualSystem(system.A, system.F, unit, system.G), block_rows - 1)
    first = beside(Matrix.zero(system.field, p, n), Matrix.identity(system.field, p))
    return stacked(first, beside(later, Matrix.zero(system.field, later.nrows, p)))
