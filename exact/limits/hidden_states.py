"""This tells which systems of two states a coloured input hides a state of, exactly: u scalar, past = 2, u and v uncorrelated at all lags.

    hides_a_state     whether the limit of PI-MOESP has rank below 2, by a formula and not by that limit
    reflections       the reflection coefficients of u, by Levinson's recursion from its covariances

The limit is O_s Cov(x, Up | Uf). Let gamma_0, gamma_1, ... be the reflection (Schur) coefficients of the spectrum of u, F(z) = 1 + 2 sum
r(l) z^l / r(0), f_0(z) = (F(z) - 1) / (z (F(z) + 1)) and f_(j+1)(z) = (f_j(z) - gamma_j) / (z (1 - gamma_j f_j(z))). Given Uf, the
filters from u(-1), u(-2) to the state have, up to factors that vanish nowhere inside the unit circle, the quotient

    g(z) = 1 / z + gamma_s f_(s+1)(z),

so that for poles a, b of A, (A, B) controllable, the rank is lost iff g(a) = g(b) (for a = b: g'(a) = 0), that is, iff A is regular and
g(A) is a multiple of the identity. If A is singular, g has a pole there and the rank is full. All of this is rational arithmetic in A.
"""

from __future__ import annotations

from typing import Any

from ..algebra.fields import QQ
from ..algebra.matrices import Matrix, rank
from .experiments import Experiment
from .inputs import powers_along_lags
from .lyapunov import solve
from .moments import Covariances


def hides_a_state(experiment: Experiment, known: Covariances) -> bool:
    """This decides by the formula above; `known` are the experiment's covariances. Raises ValueError unless n = past = 2 and nu = 1."""
    A, s = experiment.system.residual.A, experiment.s
    if (A.nrows, experiment.past, experiment.system.nu) != (2, 2, 1):
        raise ValueError("the formula is for two states, one input and a past of two samples")
    if rank(A) < 2:
        return False
    u = known.process.u
    r = [block[0, 0] for block in known.forward(u, u, s + 1)]
    gammas = reflections(r)
    one = Matrix.identity(QQ, 2)
    tail = _times(powers_along_lags(known, A)[0][0], 2 / r[0])  # (F(A) - 1) / A
    f = _quotient(tail, A @ tail + _times(one, 2))
    for gamma in gammas:
        f = _quotient(f - _times(one, gamma), A @ (one - _times(f, gamma)))
    g = solve(A, one) + _times(f, gammas[s])
    return g == _times(one, g[0, 0])


def reflections(r: list[Any]) -> list[Any]:
    """Return gamma_0, ..., gamma_(d-1) from the covariances r(0), ..., r(d) of a scalar signal, whose Toeplitz matrix is positive
    definite.
    """
    past, error, found = [r[0] / r[0]], r[0], []  # past: 1, -a_1, ..., of the best one-step prediction
    for order in range(1, len(r)):
        gamma = sum(weight * r[order - lag] for lag, weight in enumerate(past)) / error
        found.append(gamma)
        longer = [*past, 0 * gamma]
        past = [x - gamma * y for x, y in zip(longer, reversed(longer), strict=True)]
        error *= 1 - gamma * gamma
    return found


def _times(matrix: Matrix, factor: Any) -> Matrix:
    return Matrix(QQ, *matrix.shape, matrix.flint * factor)


def _quotient(one: Matrix, other: Matrix) -> Matrix:
    """Return one other^-1, of two rational functions of the same matrix."""
    return solve(other, one)
