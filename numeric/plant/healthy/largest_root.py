"""This tells how large the largest ratio of two sample covariances grows by chance alone: the null law behind a count of faults.

S1 and S0 are means of K1 and K0 outer products x x^* of independent complex Gaussian vectors x of dimension d, all of one covariance. The
roots of det(S1 - l S0) = 0 are then distributed as follows, whatever that covariance [K64]: with b = K1 l / (K0 + K1 l) in (0, 1)

    density of b_1 .. b_d   proportional to prod b_i^(K1-d) (1-b_i)^(K0-d) prod_(i<j) (b_i - b_j)^2,  K1 >= d, K0 >= d

and for K1 < d, where d - K1 roots are zero, the same with (d, K1, K0) replaced by (K1, d, K0 + K1 - d). The largest is below x with
probability det(I - M(x)), M_ij the integral of phi_i phi_j over (x, 1), phi_i the orthonormal Jacobi functions of that weight (the
identity of Andreief). In this basis the determinant is computed without cancellation, where that of incomplete beta functions is not.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy  # its folders are loaded when they are first used

from ....base.arrays import Array

NODES = 300


def largest_root_probability(root: float, dimension: int, over: int, under: int) -> float:
    """Return P(largest root of S1 against S0 <= root): S1 of `over` degrees of freedom, S0 of `under`, at least `dimension`. Source: [K64].

    Raises ValueError for under < dimension, where the ratio is unbounded.
    """
    if under < dimension or min(dimension, over) < 1:
        raise ValueError(
            f"got dimension {dimension}, degrees of freedom {over} over {under}; needed 1 <= dimension <= {under} and {over} >= 1"
        )
    return _below(over * root / (under + over * root), dimension, over, under)


@lru_cache(maxsize=1024)
def largest_root_quantile(chance: float, dimension: int, over: int, under: int) -> float:
    """Return the root that the largest exceeds with probability `chance` in (0, 1); arguments as `largest_root_probability`."""
    if not 0.0 < chance < 1.0:
        raise ValueError(f"chance: got {chance}; needed a probability strictly between 0 and 1")
    largest_root_probability(1.0, dimension, over, under)
    b = float(scipy.optimize.brentq(lambda x: 1.0 - _below(x, dimension, over, under) - chance, 1e-12, 1.0 - 1e-12, xtol=1e-12))
    return under * b / (over * (1.0 - b))


def _below(x: float, dimension: int, over: int, under: int) -> float:
    """Return P(b_max <= x)."""
    if over < dimension:
        dimension, over, under = over, dimension, under + over - dimension
    nodes, weights = _gauss_legendre()
    points = x + (1.0 - x) * (nodes + 1.0) / 2.0
    functions = _jacobi_functions(points, dimension, under - dimension, over - dimension)
    above = (functions * (weights * (1.0 - x) / 2.0)) @ functions.T
    return float(np.clip(np.linalg.det(np.eye(dimension) - above), 0.0, 1.0))


def _jacobi_functions(points: Array, count: int, a: int, c: int) -> Array:
    """Return the first `count` polynomials orthonormal on (0, 1) for (1-b)^a b^c, times the root of that weight: (count, points)."""
    logarithm = scipy.special.xlogy(c, points) + scipy.special.xlog1py(a, -points) - scipy.special.betaln(c + 1, a + 1)
    functions = [np.exp(logarithm / 2.0)]
    before, link = np.zeros_like(points), 0.0
    for k in range(count - 1):
        total = 2 * k + a + c
        middle = (c - a) / (total + 2.0) if k == 0 else (c**2 - a**2) / (total * (total + 2.0))
        following = 4.0 * (k + 1) * (k + 1 + a) * (k + 1 + c) / ((total + 2.0) ** 2 * (total + 3.0))
        following *= 1.0 if k == 0 else (k + 1 + a + c) / (total + 1.0)
        functions.append(((2.0 * points - 1.0 - middle) * functions[-1] - np.sqrt(link) * before) / np.sqrt(following))
        before, link = functions[-2], following
    return np.array(functions)


@lru_cache(maxsize=1)
def _gauss_legendre() -> tuple[Array, Array]:
    """Return nodes and weights on (-1, 1)."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    return nodes, weights
