"""Checks of `identify` under a coloured fault independent of the input: past outputs as instruments show their bias, which stays however
long the record. The limits are exact; the bound is half the bias, so the question is which of the two limits the answer is nearer to.
"""

from __future__ import annotations

from collections.abc import Iterator

from .exact_comparison import poles
from .identification_checks import matrices
from .records import Check, Function, Measurement, Severity
from .vectors import ConsistencyVector, shipped


def checks() -> Iterator[Check]:
    """All of this module."""
    for vector in shipped("consistency"):
        yield _coloured(vector)


def _coloured(vector: ConsistencyVector) -> Check:
    def measure(function: Function) -> Iterator[Measurement]:
        y, u = vector.record()
        A, *_ = matrices(function(y, u, 1, vector.block_rows), 1, 1, 1)
        yield Measurement("pole", abs(poles(A)[0] - float(vector.a)), vector.bound)

    effect = "a fault with memory biases the model, and more data do not help"
    return Check("consistent-under-coloured-fault", "identify", vector.slug, "past-outputs", effect, Severity.SILENT, measure)
