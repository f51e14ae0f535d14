"""Checks on long records with what no model explains: noise, and a fault with memory.

A coloured fault independent of the input: past outputs as instruments show their bias, which stays however long the record. The limits are
exact; the bound is half the bias, so the question is which of the two limits the answer is nearer to.

White noise whose Hankel matrices are, certified, far smaller than the least singular value of the exact ones: n_v and the ranks are there
to be seen, and no threshold of rounding shows them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..records import Check, Function, Measurement, Severity, Sides
from ..vectors.exact_comparison import matched, poles
from ..vectors.recipe_vectors import ConsistencyVector, NoisyVector
from ..vectors.shipped_vectors import shipped
from .faults import compared_count
from .identification import matrices


def checks() -> Iterator[Check]:
    """This yields all checks of the module."""
    for vector in shipped("consistency"):
        yield _coloured(vector)
    for vector in shipped("noisy"):
        yield _noisy(vector)


def _coloured(vector: ConsistencyVector) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        y, u = vector.record()
        n, n_u, p = vector.system.residual.n, vector.system.nu, vector.system.residual.p
        A, *_ = matrices(function(y, u, n, vector.block_rows), n, n_u, p)
        got = poles(A)
        places, off = matched(got, vector.poles)
        sides = Sides("eigenvalues", [got[j] for j in places], list(vector.poles), [vector.bound] * n)
        yield Measurement("poles", float(np.max(off)), vector.bound, sides)

    effect = "under a fault with memory poles off by more than half the bias of past outputs as instruments"
    return Check("consistent-under-coloured-fault", "identify", vector.slug, "past-outputs", effect, Severity.SILENT, measure, nearness=1.0)


def _noisy(vector: NoisyVector) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        yield compared_count("n_v", function(vector.record()), vector.system.m)

    effect = "a wrong number of faults wherever there is any noise, were it a thousandth"
    return Check("fault-dimension-noisy", "fault_dimension", vector.slug, "proposition-3", effect, Severity.SILENT, measure)
