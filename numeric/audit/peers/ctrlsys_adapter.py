"""This calls ctrlsys, SLICOT translated to C: ib01ad and ib01bd (MOESP, Cholesky: SLICOT's usual choice), ab08nd.

identify    ib01bd with METH = "M" and JOB = "A", which promise A, B, C and D by MOESP, after ib01ad with JOBD = "M", which those need
combined    the same with METH = "C": A and C by MOESP, B and D by N4SID, after ib01ad with JOBD = "N"
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import ctrlsys
import numpy as np

from ....base.arrays import Array
from ..adapter import ZeroStructure
from ._promises import coloured, more_block_rows_than_states
from ._slicot import structure_of

SINGULAR = (3, 4, 5)  # of ib01ad: all singular values zero, a rank-deficient least-squares problem: SLICOT's way to decline


def _identified(y: Array, u: Array, order: int, block_rows: int, method: str, for_matrices: str) -> tuple[Any, Any, Any, Any]:
    outputs, inputs = np.asfortranarray(y), np.asfortranarray(u)
    n_u, p = u.shape[1], y.shape[1]
    _, factor, _, warning, info = ctrlsys.ib01ad("M", "C", for_matrices, "O", "N", "N", block_rows, n_u, p, inputs, outputs, 0.0, -1.0)
    if info != 0 or warning in SINGULAR:
        raise ValueError(f"ib01ad: info {info}, warning {warning}")
    A, C, B, D, *_, warning, info = ctrlsys.ib01bd(method, "A", "N", block_rows, order, n_u, p, len(y), np.asfortranarray(factor), 0.0)
    if info != 0 or warning == 4:  # a least-squares problem with a rank-deficient matrix
        raise ValueError(f"ib01bd: info {info}, warning {warning}")
    return A, B, C, D


def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """info other than 0, and warnings that say the problem is singular, are refusals."""
    return _identified(y, u, order, block_rows, "M", "M")


def _combined(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    return _identified(y, u, order, block_rows, "C", "N")


combined = SimpleNamespace(identify=_combined)
NOT_PROMISED = combined.NOT_PROMISED = more_block_rows_than_states("ib01bd: n (int): System order (0 < n < nobr)") | coloured()


def structure(A: Array, F: Array, C: Array, G: Array) -> ZeroStructure:
    """It is called without scaling, at the default tolerance."""
    n, m = len(A), F.shape[1]
    matrices = (np.asfortranarray(M) for M in (A, F, C, G))
    nu, rank, dinfz, _, _, infz, _, _, Af, Bf, info = ctrlsys.ab08nd("N", n, m, len(C), *matrices, 0.0)
    if info != 0:
        raise ValueError(f"ab08nd: info {info}")
    return structure_of(nu, rank, infz[:dinfz], Af, Bf, m)
