"""This tells how large a fault space can be for a given A and C, whatever the faults.

    observability_indices    nu_1 <= .. <= nu_p of (A, C): rank O_s - rank O_(s-1) of them are at least s
    largest_fault_space      the most that n_z can be for m faults: n + m - (nu_1 + .. + nu_(p-m))

Why. The rows N(q) for which N(q) C (qI - A)^-1 is a polynomial form a free module; it has a row-reduced basis, and the degrees of that are
the observability indices [K80]. The kernel rows of every fault model with these A and C lie in that module, because they also annihilate
the free response. There are p - m of them, independent, so that their degrees eta, put in order, are at least nu_1, .., nu_(p-m), one by
one: a row-reduced basis has the predictable degree property [F75]. With n_z = n + p - sum (eta_i + 1) the bound follows. It is reached:
the columns that the first p - m rows of the basis admit have at least that dimension, and as fault matrices they leave no kernel row
more, since each would cost at least one dimension.

Ranks of floats are decided at half the digits: A and C come out of computations that lose some, and a direction that is nearly dependent
counts as dependent, so that the bound errs on the side of a larger space.
"""

from __future__ import annotations

from itertools import accumulate, pairwise

import numpy as np

from ....base.arrays import Array
from ..ranks.sample_windows import EPS

HALF_THE_DIGITS = float(np.sqrt(EPS))


def observability_indices(A: Array, C: Array) -> tuple[int, ...]:
    """Return nu_1 <= .. <= nu_p of A (n, n) and C (p, n), ranks decided at half the digits; their sum is the number of observed states.

    Neither the basis of the states nor the units of the outputs matter. Source: [K80].
    """
    p, n = int(C.shape[0]), int(C.shape[1])
    if n == 0:
        return (0,) * p
    blocks = np.stack(list(accumulate(range(n - 1), lambda block, _: block @ A, initial=C)))
    sizes = np.linalg.norm(blocks, axis=(0, 2))
    blocks = blocks / np.where(sizes > 0.0, sizes, 1.0)[:, None]
    left, values, _ = np.linalg.svd(blocks.reshape(n * p, n), full_matrices=False)
    # In coordinates of the observed states in which O_n has orthonormal columns.
    orthonormal = left[:, values > HALF_THE_DIGITS * max(float(values[0]), np.finfo(float).tiny)]
    ranks = [int(np.sum(np.linalg.svd(orthonormal[: p * s], compute_uv=False) > HALF_THE_DIGITS)) if s else 0 for s in range(n + 1)]
    steps = [later - before for before, later in pairwise(ranks)]
    # Output i has an index of at least s for as many i as the rank grows by at step s.
    return tuple(sorted(sum(1 for step in steps if step > i) for i in range(p)))


def largest_fault_space(A: Array, C: Array, n_v: int) -> int:
    """Return the most columns that the fault space of n_v <= p independent faults can have with A (n, n), C (p, n). Source: head of the
    module."""
    p, n = C.shape
    return int(n) + n_v - sum(observability_indices(A, C)[: p - n_v])
