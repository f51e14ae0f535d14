"""This is a residual with the A and C of its model, checked once for everything that estimates faults from them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ...data.validation import enough_samples, positive, signal


@dataclass(frozen=True)
class Arguments:
    """The arguments after checking; `longest` is the number of samples of the longest window looked at, `told` how n_v is known."""

    r: Array
    A: Array
    C: Array
    n_v: int | None
    block_rows: int
    longest: int
    told: str = "given"

    @property
    def n(self) -> int:
        """Return the number of states."""
        return int(self.A.shape[0])

    @property
    def p(self) -> int:
        """Return the number of outputs."""
        return int(self.C.shape[0])


def fitting(r: ArrayLike, A: ArrayLike, C: ArrayLike) -> tuple[Array, Array, Array]:
    """Return r (N, p), not zero throughout, A (n, n) and C (p, n) as float arrays. Raises InvalidData where they do not fit."""
    residual, A, C = shaped(r, A, C)
    not_zero(bool(np.any(residual)))
    return residual, A, C


def not_zero(seen: bool) -> None:
    """Raise InvalidData where no sample of r was `seen` to differ from zero."""
    if not seen:
        raise InvalidData("r is zero throughout: nothing is to be learnt from it; has the fault been recorded at all?")


def shaped(r: ArrayLike, A: ArrayLike, C: ArrayLike) -> tuple[Array, Array, Array]:
    """Return what `fitting` returns, for a stretch of r, which may be zero."""
    residual = signal(r, "r")
    A, C = (np.array(matrix, dtype=float, ndmin=2) for matrix in (A, C))
    p, n = residual.shape[1], A.shape[0]
    if A.shape != (n, n) or C.shape != (p, n):
        raise InvalidData(
            f"r, A, C: got shapes {residual.shape}, {A.shape}, {C.shape}; needed (N, p), (n, n), (p, n). "
            "r is time-major: one row a sample, one column a channel"
        )
    if not (np.all(np.isfinite(A)) and np.all(np.isfinite(C))):
        raise InvalidData("A, C: got entries that are NaN or infinite; identify the model again or check its file")
    return residual, A, C


def arguments(r: ArrayLike, A: ArrayLike, C: ArrayLike, n_v: int | None, block_rows: int | None) -> Arguments:
    """Return the arguments as arrays that fit. Raises InvalidData where they do not."""
    residual, A, C = fitting(r, A, C)
    N, p = residual.shape
    n = A.shape[0]
    if n_v is not None and positive(n_v, "n_v") > p:
        raise InvalidData(
            f"n_v: got {n_v} with {counted(p, 'output')}; needed 1 <= n_v <= p (more faults than outputs cannot be told apart)"
        )
    window = n + 1 if block_rows is None else positive(block_rows, "block_rows")
    # Fewer columns than rows would make null rows that are shortage of data, not behaviour.
    enough_samples(N, (p + 1) * window - 1, f"a window of {counted(window, 'block row')} with {counted(p, 'channel')}", residual.shape)
    longest = max(window, min(n + 1, (N + 1) // (p + 1)))
    return Arguments(residual, A, C, n_v, window, longest)
