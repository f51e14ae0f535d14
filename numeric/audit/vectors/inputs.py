"""Inputs that questions are asked with: what drives a model beside a residual, and signals that do not excite.

LONG_WINDOW         block rows of a window that is longer than any of these systems needs
with_input          data whose residual is known
sine_samples        cos(k a), cos a = 3/5: rational and without a period
unexciting_inputs   a constant and a sine
alike_inputs        two inputs of which one is the other, minus twice the other, or the other a sample later
"""

from __future__ import annotations

from fractions import Fraction

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.signals import simulate
from faultspace.exact.system.systems import ResidualSystem

from .rationals import fractions, matrix

LONG_WINDOW = 10


def with_input(r: Matrix, system: ResidualSystem, size: Fraction) -> tuple[Matrix, Matrix]:
    """Return (y, u), where y is r plus the response from rest to u for the model B = F, D = G.

    Channel j of u is size at every (j + 2)nd sample and -size between.
    """
    u = matrix([[size if k % (j + 2) == 0 else -size for j in range(system.m)] for k in range(r.nrows)], system.m)
    return r + simulate(system, Matrix.zero(system.field, system.n, 1), u).residuals, u


def sine_samples(count: int) -> list[Fraction]:
    """The samples are cos(k a) for k = 0 .. count - 1."""
    c, s, result = Fraction(1), Fraction(0), []
    for _ in range(count):
        result.append(c)
        c, s = c * 3 / 5 - s * 4 / 5, c * 4 / 5 + s * 3 / 5
    return result


def unexciting_inputs(samples: int) -> dict[str, Matrix]:
    """Return two inputs of one channel: a constant and a sine, exciting of order one and two."""
    return {"constant": matrix([[Fraction(3, 2)]] * samples, 1), "sine": matrix([[x] for x in sine_samples(samples)], 1)}


def alike_inputs(u: Matrix) -> dict[str, Matrix]:
    """Return two inputs of as many samples as the one given (N, 1), of which the second says nothing that the first has not said."""
    first = [row[0] for row in fractions(u)]
    seconds = {"same": first, "turned": [-2 * x for x in first], "delayed": [Fraction(0), *first[:-1]]}
    return {name: matrix([list(pair) for pair in zip(first, second, strict=True)], 2) for name, second in seconds.items()}
